//! How unbiased the sets of a sampler are: their density, and contrast and peaks of their spectra.

use azulejo::analysis::spectrum::{Periodogram, periodogram};
use azulejo::{Boundary, Context, Domain, Progress, Result};

use super::{Effort, Sampler, radius};
use azulejo_cli::draw::spectra::FREQUENCY_LIMIT;
use azulejo_cli::summary::Summary;

/// Groups of sets, in each of which spectra are averaged: the largest value of a few such means is known to chance.
pub const GROUPS: u64 = 5;

/// The annuli of contrast and peaks, and where contrast is measured, in units of sqrt(density).
pub const ANNULUS: f64 = 0.01;
pub const CONTRAST_RANGE: std::ops::Range<f64> = 0.5..2.0;

/// The largest width of a fill block of KDRT and of a cell of the quadtree, in radii.
const BLOCK: f64 = 4.8;
const CELL: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The largest of some frequencies.
pub struct Peak {
    /// By power.
    pub power: Summary,
    /// By power over the mean of the annulus.
    pub over_mean: Summary,
}

impl Peak {
    fn of(spectra: &[Periodogram], waves: &[[i64; 2]]) -> Result<Self> {
        let power = |spectrum: &Periodogram| waves.iter().map(|&wave| power_of(spectrum, wave)).fold(0.0, f64::max);
        let over_mean = spectra.iter().map(|spectrum| spectrum.peak(ANNULUS, waves.iter().copied()));
        Ok(Self {
            power: Summary::of(&spectra.iter().map(power).collect::<Vec<_>>()),
            over_mean: Summary::of(&over_mean.collect::<Result<Vec<_>>>()?),
        })
    }
}

/// What the sets of one sampler are like.
pub struct Statistics {
    pub sampler: Sampler,
    /// Whether the sets are made of tiles: small ones are not.
    pub is_tiled: bool,
    /// N·r² per area, of all sets.
    pub density: Summary,
    /// The contrast of the periodogram, of all sets.
    pub contrast: Summary,
    /// The peaks of the mean periodograms of the groups on the axes, the harmonics of the fill blocks and of the cells.
    pub peaks: [Peak; 3],
    /// The mean periodogram of all sets, and its anisotropy.
    pub spectrum: Periodogram,
    pub anisotropy: f64,
    /// How far the radial mean is from that of the reference at most, in units of power.
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
        let sets = GROUPS * effort.sets_per_group;
        let (mut densities, mut contrasts, mut means) = (vec![], vec![], vec![]);
        for group in 0..GROUPS {
            let mut spectra = Vec::new();
            for seed in group * effort.sets_per_group..(group + 1) * effort.sets_per_group {
                let samples = sampler.sample(context, effort.count, seed)?;
                let spectrum = periodogram(context, &domain, &samples, 2 * half as usize + 1, None)?;
                densities.push(samples.len() as f64 * radius * radius);
                contrasts.push(spectrum.contrast(ANNULUS, CONTRAST_RANGE)?);
                spectra.push(spectrum);
                _ = progress((seed + 1) as f64 / sets as f64);
            }
            means.push(Periodogram::mean(&spectra)?);
        }
        let [axes, blocks, cells] = harmonics.map(|waves| Peak::of(&means, &waves));
        let spectrum = Periodogram::mean(&means)?;
        Ok(Self {
            sampler,
            // What is not tiled is given to the reference as it is.
            is_tiled: sampler.sample(context, effort.count, 0)? != Sampler::Maximal.sample(context, effort.count, 0)?,
            density: Summary::of(&densities),
            contrast: Summary::of(&contrasts),
            peaks: [axes?, blocks?, cells?],
            anisotropy: spectrum.contrast(ANNULUS, CONTRAST_RANGE)?,
            difference: difference(&spectrum, reference.unwrap_or(&spectrum))?,
            spectrum,
            sets,
        })
    }
}

/// How far two radial means are apart at most.
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
