//! The bias of the sets of a sampler: density, and contrast and peaks of their spectra.

use std::collections::BTreeMap;

use azulejo::analysis::spectrum::{Periodogram, periodogram};
use azulejo::{Boundary, Context, Domain, Progress, Result};

use super::{Effort, Sampler, radius};
use azulejo_cli::draw::spectra::FREQUENCY_LIMIT;

/// The annuli of contrast and peaks, and where contrast is measured, in units of sqrt(density).
pub const ANNULUS: f64 = 0.01;
pub const CONTRAST_RANGE: std::ops::Range<f64> = 0.5..2.0;

/// The largest width of a fill block of KDRT and of a cell of the quadtree, in radii.
const BLOCK: f64 = 4.8;
const CELL: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The peak of the spectrum over some frequencies.
#[derive(Default)]
pub struct Peak {
    /// The largest power in the mean spectrum of each group.
    pub power: Vec<f64>,
    /// The largest power over the mean of its annulus, of the same spectra.
    pub over_mean: Vec<f64>,
    /// The mean power over those of the annuli, of each set.
    pub level: Vec<f64>,
}

impl Peak {
    fn add_set(&mut self, spectrum: &Periodogram, waves: &[[i64; 2]]) -> Result<()> {
        let annulus = |frequency: f64| (frequency / ANNULUS) as usize;
        let means: BTreeMap<_, _> =
            spectrum.radial(ANNULUS)?.iter().map(|one| (annulus(one.frequency), one.power)).collect();
        let [along, up] = spectrum.frequency_step();
        let over_mean = |&[column, row]: &[i64; 2]| {
            let mean = means.get(&annulus((column as f64 * along).hypot(row as f64 * up)))?;
            (*mean > 0.0).then(|| power_of(spectrum, [column, row]) / mean)
        };
        let levels: Vec<_> = waves.iter().filter_map(over_mean).collect();
        self.level.push(levels.iter().sum::<f64>() / levels.len().max(1) as f64);
        Ok(())
    }

    fn add_group(&mut self, spectrum: &Periodogram, waves: &[[i64; 2]]) -> Result<()> {
        self.power.push(waves.iter().map(|&wave| power_of(spectrum, wave)).fold(0.0, f64::max));
        self.over_mean.push(spectrum.peak(ANNULUS, waves.iter().copied())?);
        Ok(())
    }
}

/// The statistics of the sets of one sampler.
pub struct Statistics {
    pub sampler: Sampler,
    /// True if the sets are tiled: small ones are not.
    pub is_tiled: bool,
    /// N·r² per area, of each set.
    pub density: Vec<f64>,
    /// The contrast of the periodogram, of each set.
    pub contrast: Vec<f64>,
    /// The peaks on the axes, at the harmonics of the fill blocks and of the cells.
    pub peaks: [Peak; 3],
    /// The mean periodogram of all sets, and its anisotropy.
    pub spectrum: Periodogram,
    pub anisotropy: f64,
    /// The largest difference of the radial mean from that of the reference, in units of power.
    pub difference: f64,
    pub sets: u64,
}

impl Statistics {
    /// Makes and measures the sets. There is no `reference` for the reference itself.
    pub fn measure(
        context: &Context,
        sampler: Sampler,
        effort: &Effort,
        reference: Option<&Periodogram>,
        progress: &Progress,
    ) -> Result<Self> {
        let (domain, radius) = (Domain::unit(Boundary::Periodic), radius(effort.count));
        let half = (FREQUENCY_LIMIT * effort.count.sqrt()) as i64 + 3;
        let harmonics = harmonics(radius, half);
        let sets = effort.groups * effort.sets_per_group;
        let (mut density, mut contrast, mut means) = (vec![], vec![], vec![]);
        let mut peaks: [Peak; 3] = Default::default();
        for group in 0..effort.groups {
            let mut spectra = Vec::new();
            for seed in group * effort.sets_per_group..(group + 1) * effort.sets_per_group {
                let samples = sampler.sample(context, effort.count, seed)?;
                let spectrum = periodogram(context, &domain, &samples, 2 * half as usize + 1, None)?;
                density.push(samples.len() as f64 * radius * radius);
                contrast.push(spectrum.contrast(ANNULUS, CONTRAST_RANGE)?);
                for (peak, waves) in peaks.iter_mut().zip(&harmonics) {
                    peak.add_set(&spectrum, waves)?;
                }
                spectra.push(spectrum);
                _ = progress((seed + 1) as f64 / sets as f64);
            }
            let mean = Periodogram::mean(&spectra)?;
            for (peak, waves) in peaks.iter_mut().zip(&harmonics) {
                peak.add_group(&mean, waves)?;
            }
            means.push(mean);
        }
        let spectrum = Periodogram::mean(&means)?;
        Ok(Self {
            sampler,
            // A set that is not tiled is that of the reference.
            is_tiled: sampler.sample(context, effort.count, 0)? != Sampler::Maximal.sample(context, effort.count, 0)?,
            density,
            contrast,
            peaks,
            anisotropy: spectrum.contrast(ANNULUS, CONTRAST_RANGE)?,
            difference: difference(&spectrum, reference.unwrap_or(&spectrum))?,
            spectrum,
            sets,
        })
    }
}

/// The largest difference of two radial means.
fn difference(a: &Periodogram, b: &Periodogram) -> Result<f64> {
    let [a, b] = [a.radial(ANNULUS)?, b.radial(ANNULUS)?];
    Ok(a.iter().zip(&b).map(|(a, b)| (a.power - b.power).abs()).fold(0.0, f64::max))
}

/// The power at a frequency of the grid, in waves per period.
fn power_of(spectrum: &Periodogram, [column, row]: [i64; 2]) -> f64 {
    let (size, half) = (spectrum.size(), (spectrum.size() / 2) as i64);
    f64::from(spectrum.power()[(row + half) as usize * size + (column + half) as usize])
}

/// The frequencies where the regular parts of KDRT would show, in waves per period: all on the axes, the multiples of
/// the number of fill blocks per side, and of the number of cells.
fn harmonics(radius: f64, half: i64) -> [Vec<[i64; 2]>; 3] {
    let blocks = 2 * (0.5 / (BLOCK * radius)).ceil() as i64;
    let cells = (1.0 / (CELL * radius)).ceil() as i64;
    let multiples = |step: i64| {
        let limit = half / step;
        let half_plane = (0..=limit).flat_map(move |row| (-limit..=limit).map(move |column| [column, row]));
        half_plane.filter(|&[column, row]| row > 0 || column > 0).map(move |wave| wave.map(|k| k * step)).collect()
    };
    [(1..=half).flat_map(|k| [[k, 0], [0, k]]).collect(), multiples(blocks), multiples(cells)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn harmonics_are_multiples_of_what_is_regular_in_half_of_the_plane() {
        let [axes, blocks, cells] = harmonics(0.02, 20);
        assert_eq!((axes.len(), axes[0], axes[39]), (40, [1, 0], [0, 20]));
        // At least 10.4 blocks per side, of which there are 12: an even number.
        assert_eq!(blocks.len(), 1 + 3);
        assert!(blocks.contains(&[-12, 12]) && !blocks.contains(&[0, 0]) && !blocks.contains(&[-12, 0]));
        assert!(cells.is_empty());
        assert!(harmonics(0.02, 71)[2].contains(&[-71, 71]));
    }
}
