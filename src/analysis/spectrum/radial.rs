//! Radial mean, anisotropy, contrast and peaks of a periodogram (Ulichney 1988; thesis fig. 1.10).

use crate::analysis::spectrum::Periodogram;
use crate::check;
use crate::error::Result;
use crate::math::hypot;

/// The frequencies of about one length, an annulus of the plane or a shell of space: a point of the radial curves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Annulus {
    /// The number of its frequencies, not counting a frequency and its opposite twice.
    pub count: usize,
    /// The mean length of its frequencies, in units of one over the mean spacing.
    pub frequency: f64,
    /// The mean power; 1 for a Poisson process.
    pub power: f64,
    /// The variance of the power over its squared mean. A single periodogram of an isotropic set has 1 (0 dB),
    /// the mean of n has 1/n; directions that stand out give more.
    pub anisotropy: f64,
}

/// A frequency at which a spectrum stands out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak<const D: usize = 2> {
    /// The frequency along each axis, in units of one over the mean spacing; its opposite is as high.
    pub frequency: [f64; D],
    /// Its power over the mean of its annulus. By chance alone the largest of n frequencies of a single periodogram is
    /// about ln n.
    pub over_mean: f64,
}

/// Annuli of one width, which hold all frequencies out to the largest circle, or ball, of the grid.
pub(super) struct Annuli {
    width: f64,
    /// The radius of the largest circle.
    pub last: f64,
    /// The count of frequencies and the sums of their lengths, powers and squared powers.
    pub sums: Vec<[f64; 4]>,
}

impl Annuli {
    fn index(&self, frequency: f64) -> Option<usize> {
        let index = (frequency / self.width) as usize;
        (frequency <= self.last && index < self.sums.len()).then_some(index)
    }
}

impl<const D: usize> Periodogram<D> {
    /// The radial curves in annuli of `width`, in units of one over the mean spacing, out to the largest circle or ball of
    /// the grid.
    /// Annuli of fewer than two frequencies are left out.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`](crate::Error::InvalidArgument) if `width` is not a positive finite number.
    pub fn radial(&self, width: f64) -> Result<Vec<Annulus>> {
        let annuli = self.annuli(width)?;
        let curve = annuli.sums.iter().filter(|sums| sums[0] >= 2.0).map(|&[count, frequency, power, square]| {
            let mean = power / count;
            let variance = (square - power * mean).max(0.0) / (count - 1.0);
            let anisotropy = if mean > 0.0 { variance / (mean * mean) } else { 0.0 };
            Annulus { count: count as usize, frequency: frequency / count, power: mean, anisotropy }
        });
        Ok(curve.collect())
    }

    /// The scatter of the power about its radial mean: the mean of the anisotropy over all frequencies with a length in
    /// `range`, in units of one over the mean spacing, found in annuli of `width`. 0 if there are none.
    ///
    /// The power of a large set without order over long distances is exponentially distributed about its mean, as that
    /// of a Poisson process is, so a single periodogram has a contrast of 1, up to sqrt(8 / frequencies) by chance. A
    /// set in which parts are repeated has more, though its radial mean may show nothing.
    ///
    /// # Errors
    /// As [`Periodogram::radial`].
    pub fn contrast(&self, width: f64, range: std::ops::Range<f64>) -> Result<f64> {
        let annuli = self.radial(width)?.into_iter().filter(|annulus| range.contains(&annulus.frequency));
        let (count, sum) = annuli.fold((0.0, 0.0), |(count, sum), annulus| {
            let frequencies = annulus.count as f64;
            (count + frequencies, sum + frequencies * annulus.anisotropy)
        });
        Ok(if count > 0.0 { sum / count } else { 0.0 })
    }

    /// The largest power at some frequencies, each over the mean power of its annulus of `width`, in units of
    /// sqrt(density). 0 if none of them is in the grid.
    ///
    /// `waves` are counted in columns and rows from frequency 0; those beyond the largest circle of the grid are
    /// skipped. By chance alone the largest of n frequencies of a single periodogram is about ln n.
    ///
    /// # Errors
    /// As [`Periodogram::radial`].
    pub fn peak(&self, width: f64, waves: impl IntoIterator<Item = [i64; D]>) -> Result<f64> {
        let annuli = self.annuli(width)?;
        let over_mean = |wave: [i64; D]| {
            let [count, _, power, _] = annuli.sums[annuli.index(self.frequency(wave))?];
            let mean = power / count;
            (mean > 0.0).then(|| self.at(wave) / mean)
        };
        Ok(waves.into_iter().filter_map(over_mean).fold(0.0, f64::max))
    }

    /// Searches the frequencies with a length in `range`, in units of one over the mean spacing, for the one whose power exceeds
    /// the mean of its annulus of `width` the most: repeated parts and lattices show there. None if it is all 0.
    ///
    /// # Errors
    /// As [`Periodogram::radial`].
    pub fn highest_peak(&self, width: f64, range: std::ops::Range<f64>) -> Result<Option<Peak<D>>> {
        let annuli = self.annuli(width)?;
        let peaks = self.half_space().filter_map(|wave| {
            let frequency = self.frequency(wave);
            let sums = annuli.sums[annuli.index(frequency).filter(|_| range.contains(&frequency))?];
            let mean = sums[2] / sums[0];
            let along = std::array::from_fn(|axis| wave[axis] as f64 * self.frequency_step[axis]);
            (mean > 0.0).then(|| Peak { frequency: along, over_mean: self.at(wave) / mean })
        });
        Ok(peaks.reduce(|highest, peak| if peak.over_mean > highest.over_mean { peak } else { highest }))
    }

    /// The frequencies but 0, in steps along the axes from it: of each and its opposite, whose power is the same, one.
    fn half_space(&self) -> impl Iterator<Item = [i64; D]> + use<D> {
        let (size, last) = (self.size, D - 1);
        let half = size.map(|size| size / 2);
        let count = size[..last].iter().product::<usize>() * (size[last] - half[last]);
        let waves = (0..count).map(move |mut number| {
            std::array::from_fn(|axis| {
                if axis == last {
                    return number as i64;
                }
                let along = number % size[axis];
                number /= size[axis];
                along as i64 - half[axis] as i64
            })
        });
        waves.filter(|wave: &[i64; D]| wave.iter().rev().find(|&&along| along != 0).is_some_and(|&along| along > 0))
    }

    /// The power at a frequency of the grid, in steps along the axes from frequency 0.
    fn at(&self, wave: [i64; D]) -> f64 {
        let place =
            |place: usize, axis: usize| place * self.size[axis] + (wave[axis] + (self.size[axis] / 2) as i64) as usize;
        f64::from(self.power[(0..D).rev().fold(0, place)])
    }

    /// The length of a frequency, in units of one over the mean spacing.
    fn frequency(&self, wave: [i64; D]) -> f64 {
        (0..D).map(|axis| wave[axis] as f64 * self.frequency_step[axis]).fold(0.0, hypot)
    }

    /// Sums up the power in annuli.
    pub(super) fn annuli(&self, width: f64) -> Result<Annuli> {
        check::positive("width", width)?;
        let last = self.reach;
        let count = (last.min(width * 1e6) / width) as usize + 1;
        let mut annuli = Annuli { width, last, sums: vec![[0.0; 4]; count] };
        for wave in self.half_space() {
            let frequency = self.frequency(wave);
            if let Some(index) = annuli.index(frequency) {
                let power = self.at(wave);
                let terms = [1.0, frequency, power, power * power];
                (0..4).for_each(|i| annuli.sums[index][i] += terms[i]);
            }
        }
        Ok(annuli)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::spectrum::periodogram;
    use crate::job::Context;
    use crate::points::{Boundary, Domain};
    use crate::rng::{Draw, Rng};

    fn spectrum(points: &[[f32; 2]], size: usize) -> Periodogram {
        periodogram(&Context::new(1).unwrap(), &Domain::unit(Boundary::Periodic), points, size, None).unwrap()
    }

    fn random_points(seed: u64, count: usize) -> Vec<[f32; 2]> {
        let mut rng = Rng::at(seed, Draw::Probe, &[]);
        (0..count).map(|_| [rng.unit() as f32, rng.unit() as f32]).collect()
    }

    #[test]
    fn a_poisson_process_has_contrast_one_and_repeated_parts_of_one_have_more() {
        let poisson = spectrum(&random_points(1, 5000), 200);
        let contrast = poisson.contrast(0.02, 0.2..1.3).unwrap();
        assert!((contrast - 1.0).abs() < 0.06, "{contrast}");
        // Laid at random 50 times, the same part scales the exponential distribution by an exponential one:
        // the mean of its square is 2 · 2, its variance 3.
        let part = random_points(2, 100);
        let places = random_points(3, 50);
        let image = |place: &[f32; 2]| {
            let place = *place;
            part.iter()
                .map(move |point| [0, 1].map(|axis| (place[axis] + 0.1 * point[axis]).fract()))
                .collect::<Vec<_>>()
        };
        let repeated = spectrum(&places.iter().flat_map(image).collect::<Vec<_>>(), 200);
        let contrast = repeated.contrast(0.02, 0.2..1.3).unwrap();
        assert!((2.2..4.0).contains(&contrast), "{contrast}");
        assert_eq!(poisson.contrast(0.02, 7.0..9.0).unwrap(), 0.0);
    }

    #[test]
    fn the_mean_of_n_periodograms_has_the_contrast_of_one_over_n() {
        let spectra: Vec<_> = (0..8).map(|seed| spectrum(&random_points(seed, 2000), 120)).collect();
        let contrast = Periodogram::mean(&spectra).unwrap().contrast(0.02, 0.2..1.3).unwrap();
        assert!((contrast * 8.0 - 1.0).abs() < 0.1, "{contrast}");
    }

    /// Columns of points at regular places, each at random in its column's height.
    #[test]
    fn columns_are_peaks_on_their_axis_and_nowhere_else() {
        let mut points = random_points(5, 4000);
        points.iter_mut().enumerate().for_each(|(i, point)| point[0] = (i % 40) as f32 / 40.0);
        let spectrum = spectrum(&points, 160);
        let multiples = |step: i64| (1..80 / step).map(move |k| k * step);
        let columns = spectrum.peak(0.05, multiples(40).map(|column| [column, 0])).unwrap();
        let mean = 1.0 + 4000.0 / std::f64::consts::PI / (0.632 * 0.05 * 4000.0);
        assert!(columns > 0.5 * 4000.0 / mean, "{columns}");
        let rows = spectrum.peak(0.05, multiples(1).map(|row| [0, row])).unwrap();
        assert!((2.0..12.0).contains(&rows), "{rows}");
        assert_eq!(spectrum.peak(0.05, [[3, 0], [500, 0], [70, 70]]).unwrap(), spectrum.peak(0.05, [[-3, 0]]).unwrap());
        assert_eq!(spectrum.peak(0.05, []).unwrap(), 0.0);
        let highest = spectrum.highest_peak(0.05, 0.1..1.2).unwrap().unwrap();
        assert_eq!(highest.over_mean, spectrum.peak(0.05, [[40, 0]]).unwrap());
        assert!((highest.frequency[0].abs() - 40.0 / 4000f64.sqrt()).abs() < 1e-9 && highest.frequency[1] == 0.0);
        let low = spectrum.highest_peak(0.05, 0.1..0.5).unwrap().unwrap();
        assert!((5.0..20.0).contains(&low.over_mean) && spectrum.highest_peak(0.05, 7.0..9.0).unwrap().is_none());
        assert!(spectrum.peak(0.0, []).is_err() && spectrum.contrast(f64::NAN, 0.0..1.0).is_err());
    }
}
