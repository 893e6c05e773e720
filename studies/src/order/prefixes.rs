//! Prefixes of progressive sets of the unit torus, and sets of their number.

use azulejo::analysis::coverage::covering_radius_2d;
use azulejo::analysis::spacing::smallest_distance_2d;
use azulejo::kdrt::{self, CountOptions, Options, Progressive};
use azulejo::{Boundary, Context, Domain, MAXIMAL_DENSITY, Progress, Result};

use super::{Effort, QUOTIENTS, Quotient};
use crate::blue::Blue;
use azulejo_cli::summary::Summary;

/// The prefixes whose spectra are shown, in parts of a set: within an octave of counts, and far below it.
pub const PARTS: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];

/// The numbers of prefixes whose distances are measured, from the first one on.
const PREFIXES: u32 = 50;
const FIRST: f64 = 100.0;

/// The sets of a quotient.
pub struct Prefixes {
    pub quotient: Quotient,
    /// N·r² of the whole set.
    pub density: f64,
    /// The covering radius over the smallest distance, of all prefixes that are measured.
    pub ratio: Summary,
    /// The smallest distance in units of the hexagonal one, of the same prefixes.
    pub rho: Summary,
    /// The spectral figures of the prefixes of [`PARTS`].
    pub blue: Vec<Blue>,
    /// One of the sets.
    pub first: Vec<[f32; 2]>,
}

impl Prefixes {
    /// Measures the sets of all quotients.
    pub fn all(context: &Context, effort: &Effort, progress: &Progress) -> Result<Vec<Self>> {
        let one = |(i, quotient): (usize, Quotient)| {
            _ = progress(i as f64 / QUOTIENTS.len() as f64);
            Self::of(context, quotient, effort)
        };
        QUOTIENTS.into_iter().enumerate().map(one).collect()
    }

    fn of(context: &Context, quotient: Quotient, effort: &Effort) -> Result<Self> {
        let radius = radius(effort.count);
        let levels = Progressive::new().quotient(quotient.value);
        let options = |seed| Options::progressive(radius, levels).seed(seed);
        let set = |seed| Ok(kdrt::sample(context, &options(seed), None)?.positions);
        let sets: Vec<Vec<[f32; 2]>> = (0..effort.sets).map(set).collect::<Result<_>>()?;
        let (mut ratio, mut rho) = (Vec::new(), Vec::new());
        for set in &sets {
            for count in counts(set.len(), PREFIXES) {
                let of = Distances::of(context, &set[..count])?;
                ratio.push(of.ratio);
                rho.push(of.rho);
            }
        }
        let prefixes =
            |&count: &usize| Blue::of(context, &sets.iter().map(|set| set[..count].to_vec()).collect::<Vec<_>>());
        let samples = sets.iter().map(Vec::len).sum::<usize>() as f64 / sets.len() as f64;
        Ok(Self {
            quotient,
            density: samples * radius * radius,
            ratio: Summary::of(&ratio),
            rho: Summary::of(&rho),
            blue: part_counts(effort).iter().map(prefixes).collect::<Result<_>>()?,
            first: sets.into_iter().next().unwrap_or_default(),
        })
    }
}

/// The numbers of samples of [`PARTS`].
pub fn part_counts(effort: &Effort) -> Vec<usize> {
    // The densities of progressive sets are a little lower than those of others.
    PARTS.iter().map(|part| (0.95 * part * effort.count) as usize).collect()
}

/// Sets that were made with the numbers of [`PARTS`].
pub struct Direct {
    /// The covering radius over the smallest distance, of all sets.
    pub ratio: Summary,
    pub rho: Summary,
    pub blue: Vec<Blue>,
}

impl Direct {
    /// Measures sets of all numbers.
    pub fn measure(context: &Context, effort: &Effort) -> Result<Self> {
        let (mut ratio, mut rho, mut blue) = (Vec::new(), Vec::new(), Vec::new());
        for count in part_counts(effort) {
            let set =
                |seed| Ok(kdrt::sample_count(context, &CountOptions::new(count as u64).seed(seed), None)?.0.positions);
            let sets: Vec<Vec<[f32; 2]>> = (0..effort.sets).map(set).collect::<Result<_>>()?;
            for set in &sets {
                let of = Distances::of(context, set)?;
                ratio.push(of.ratio);
                rho.push(of.rho);
            }
            blue.push(Blue::of(context, &sets)?);
        }
        Ok(Self { ratio: Summary::of(&ratio), rho: Summary::of(&rho), blue })
    }
}

/// The smallest distance of a set, and its covering radius.
struct Distances {
    ratio: f64,
    rho: f64,
}

impl Distances {
    fn of(context: &Context, set: &[[f32; 2]]) -> Result<Self> {
        let domain = Domain::unit(Boundary::Periodic);
        let smallest = smallest_distance_2d(context, &domain, set, None)?;
        let hexagonal = (2.0 / (3f64.sqrt() * set.len() as f64)).sqrt();
        Ok(Self { ratio: covering_radius_2d(context, &domain, set, None)? / smallest, rho: smallest / hexagonal })
    }
}

/// So many numbers of samples, evenly on a scale of powers.
pub fn counts(most: usize, numbers: u32) -> impl Iterator<Item = usize> {
    let first = FIRST.min(most as f64);
    let step = (most as f64 / first).powf(1.0 / f64::from(numbers - 1));
    (0..numbers).map(move |i| ((first * step.powi(i as i32)) as usize).min(most))
}

/// The radius of a maximal set of about so many samples.
pub fn radius(count: f64) -> f64 {
    (MAXIMAL_DENSITY / count).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prefixes_reach_from_the_first_count_to_all_samples() {
        let all: Vec<_> = counts(40_000, 50).collect();
        assert_eq!((all.len(), all[0]), (50, 100));
        assert!(all.is_sorted() && all[49] >= 39_990 && all[49] <= 40_000);
        assert!(counts(30, 50).all(|count| count == 30));
    }
}
