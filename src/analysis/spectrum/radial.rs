//! Radial mean and anisotropy of a periodogram (Ulichney 1988; thesis fig. 1.10).

use super::Periodogram;
use crate::error::{Error, Result};

/// The frequencies of about one length: a point of the radial curves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Annulus {
    /// The mean length of its frequencies, in units of sqrt(density).
    pub frequency: f64,
    /// The mean power; 1 for a Poisson process.
    pub power: f64,
    /// The variance of the power over its squared mean. A single periodogram of an isotropic set has 1 (0 dB),
    /// the mean of n has 1/n; directions that stand out give more.
    pub anisotropy: f64,
}

impl Periodogram {
    /// The radial curves in annuli of `width`, in units of sqrt(density), out to the largest circle of the grid.
    /// Annuli of fewer than two frequencies, not counting a frequency and its opposite twice, are left out.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] if `width` is not a positive finite number.
    pub fn radial(&self, width: f64) -> Result<Vec<Annulus>> {
        if !(width > 0.0 && width.is_finite()) {
            return Err(Error::invalid("width", format!("{width} is not a positive finite number")));
        }
        let half = (self.size / 2) as i64;
        let last = (self.size as i64 - 1 - half) as f64 * self.frequency_step[0].min(self.frequency_step[1]);
        let annulus = |frequency: f64| (frequency / width) as usize;
        let mut annuli = vec![[0.0; 4]; annulus(last.min(width * 1e6)) + 1];
        for row in 0..(self.size as i64 - half) {
            for column in -half..(self.size as i64 - half) {
                let [x, y] = [column as f64 * self.frequency_step[0], row as f64 * self.frequency_step[1]];
                let frequency = x.hypot(y);
                if frequency > last || (row == 0 && column <= 0) {
                    continue;
                }
                let power = self.power[((row + half) * self.size as i64 + column + half) as usize] as f64;
                let terms = [1.0, frequency, power, power * power];
                if let Some(sums) = annuli.get_mut(annulus(frequency)) {
                    (0..4).for_each(|i| sums[i] += terms[i]);
                }
            }
        }
        let curve = annuli.iter().filter(|sums| sums[0] >= 2.0).map(|&[count, frequency, power, square]| {
            let mean = power / count;
            let variance = (square - power * mean).max(0.0) / (count - 1.0);
            let anisotropy = if mean > 0.0 { variance / (mean * mean) } else { 0.0 };
            Annulus { frequency: frequency / count, power: mean, anisotropy }
        });
        Ok(curve.collect())
    }
}
