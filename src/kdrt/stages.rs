//! The work and the time of each stage of KDRT (thesis table 2.2 and fig. 2.13), for benchmarks and studies: not a part
//! of the API.

use std::hint::black_box;
use std::time::{Duration, Instant};

use crate::error::{Error, Result};
use crate::job::Context;
use crate::plane::{Lattice, Rect};

use crate::kdrt::clip::Pattern;
use crate::kdrt::options::{Kind, Options, check_leaf_size};
use crate::kdrt::tiling::Tiling;

pub use crate::kdrt::divide::Fixed;

/// The work and the time of each stage of KDRT, on one thread.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stages {
    /// Samples of the result.
    pub samples: u64,
    /// Points of the pattern laid in leaves.
    pub clipped: u64,
    /// Points laid near seams, which were tested.
    pub tested: u64,
    /// Points laid near seams that were eliminated.
    pub eliminated: u64,
    /// Samples that fill gaps.
    pub filled: u64,
    /// Making the pattern.
    pub pattern: Duration,
    /// Finding the leaves.
    pub divide: Duration,
    /// Laying the pattern in the leaves.
    pub clip: Duration,
    /// Eliminating conflicts.
    pub eliminate: Duration,
    /// Filling gaps.
    pub fill: Duration,
    /// Writing the samples.
    pub output: Duration,
}

/// Measures the stages of [`sample`](super::sample) on one thread, on the set that it would make.
///
/// Clipping is interleaved with elimination; it is measured by clipping a second time, and elimination as the
/// difference. A domain that is not tiled is all pattern.
///
/// # Errors
/// Those of [`sample`](super::sample).
pub fn measure(options: &Options) -> Result<Stages> {
    let (radius, &Options { domain, leaf_size, seed, .. }) = (radius(options)?, options);
    check_leaf_size(leaf_size)?;
    let lattice = Lattice::new(&domain, radius)?;
    let (context, mut stages) = (Context::new(1)?, Stages::default());
    if !Tiling::is_worthwhile(&lattice, leaf_size) {
        let samples = timed(&mut stages.pattern, || crate::kdrt::sample(&context, options, None))?;
        return Ok(Stages { samples: samples.len() as u64, ..stages });
    }
    let tiling = timed(&mut stages.pattern, || {
        context.run(None, |job| Tiling::new(job, lattice, leaf_size, seed, Default::default()))
    })?;
    let mut all = Vec::new();
    for window in tiling.windows() {
        let samples = measure_window(&tiling, &window, &mut stages);
        timed(&mut stages.output, || all.extend_from_slice(&samples));
    }
    stages.samples = all.len() as u64;
    Ok(stages)
}

/// A set made otherwise than by [`sample`](super::sample), and the time that it took.
#[derive(Clone, Debug, PartialEq)]
pub struct Varied {
    /// The samples.
    pub samples: Vec<[f32; 2]>,
    /// Making the pattern.
    pub pattern: Duration,
    /// Everything else.
    pub tiling: Duration,
}

/// Samples with a pattern of another side, in radii, or less randomness (thesis §2.5.2), in parallel. With the side and
/// the randomness of [`sample`](super::sample) it makes the same set.
///
/// # Errors
/// Those of [`sample`](super::sample); [`Error::InvalidArgument`] for a pattern with a side of less than two leaf sizes
/// or more than the domain's.
pub fn sample_varied(context: &Context, options: &Options, pattern_side: f64, fixed: Fixed) -> Result<Varied> {
    let (radius, &Options { domain, leaf_size, seed, .. }) = (radius(options)?, options);
    check_leaf_size(leaf_size)?;
    let lattice = Lattice::new(&domain, radius)?;
    let longest = domain.extent().into_iter().fold(f64::INFINITY, f64::min) / radius;
    if !(2.0 * leaf_size..=longest).contains(&pattern_side) {
        let reason = format!("{pattern_side:?} is not in {:?} to {longest:?} (radii)", 2.0 * leaf_size);
        return Err(Error::invalid("pattern_side", reason));
    }
    let (mut pattern, mut tiled) = (Duration::ZERO, Duration::ZERO);
    let samples = context.run(None, |job| {
        let mut tiling = timed(&mut pattern, || {
            let side = (pattern_side * lattice.radius).ceil() as i32;
            Pattern::new(job, &lattice, side, seed).map(|pattern| {
                Tiling::with_pattern(pattern.into(), lattice.clone(), leaf_size, seed, Default::default())
            })
        })?;
        tiling.fix(fixed);
        timed(&mut tiled, || {
            let windows = tiling.windows();
            job.concat_about(lattice.expected_samples() as usize, windows.len(), |i| tiling.window(&windows[i]))
        })
    })?;
    Ok(Varied { samples, pattern, tiling: tiled })
}

/// The radius of a set without layers.
fn radius(options: &Options) -> Result<f64> {
    match options.kind {
        Kind::Plain(radius) => Ok(radius),
        _ => Err(Error::invalid("kind", "only sets of one radius in any order have stages")),
    }
}

fn measure_window(tiling: &Tiling, window: &Rect, stages: &mut Stages) -> Vec<[f32; 2]> {
    let (known, held) = (tiling.surroundings(window), tiling.rect(window));
    let leaves = timed(&mut stages.divide, || tiling.leaves(&known));
    let mut clip = Duration::ZERO;
    timed(&mut clip, || black_box(tiling.clip(&known, &leaves)));
    let mut merge = Duration::ZERO;
    let merged = timed(&mut merge, || tiling.merge(tiling.lattice(), &known, window, &leaves));
    stages.clip += clip;
    stages.eliminate += merge.saturating_sub(clip);

    let survivors = merged.output.len() as u64;
    let eliminated = merged.eliminated.iter().filter(|&&point| held.contains(point)).count() as u64;
    stages.clipped += survivors + eliminated;
    stages.tested += merged.grid.samples_in(&held).count() as u64 + eliminated;
    stages.eliminated += eliminated;
    let samples = timed(&mut stages.fill, || tiling.fill(window, &leaves, merged));
    stages.filled += samples.len() as u64 - survivors;
    samples
}

/// Adds the time of a piece of work to `total`.
fn timed<T>(total: &mut Duration, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = work();
    *total += start.elapsed();
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::spectrum::{Periodogram, periodogram};
    use crate::kdrt::clip::pattern_side;
    use crate::maximal;
    use crate::points::{Boundary, Domain};

    #[test]
    fn the_stages_make_the_set_that_sampling_makes() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            for (radius, leaf_size) in [(0.004, 20.0), (0.007, 6.0), (0.2, 20.0)] {
                let options = Options::new(radius).domain(Domain::unit(boundary)).leaf_size(leaf_size).seed(3);
                let stages = measure(&options).unwrap();
                let samples = crate::kdrt::sample(&Context::new(1).unwrap(), &options, None).unwrap();
                assert_eq!(stages.samples, samples.len() as u64);
                if stages.clipped > 0 {
                    assert_eq!(stages.samples, stages.clipped - stages.eliminated + stages.filled);
                    assert!(stages.eliminated < stages.tested && stages.tested < stages.clipped);
                }
                assert_eq!(stages.clipped > 0, radius < 0.1);
            }
        }
    }

    #[test]
    fn a_set_is_varied_by_what_is_asked_for_only() {
        let (context, domain) = (Context::new(1).unwrap(), Domain::unit(Boundary::Periodic));
        let options = Options::new(0.004).domain(domain).leaf_size(10.0).seed(3);
        let varied = |side, fixed| sample_varied(&context, &options, side, fixed).unwrap().samples;
        let samples = crate::kdrt::sample(&context, &options, None).unwrap().positions;
        assert_eq!(varied(pattern_side(10.0), Fixed::Nothing), samples);
        for (side, fixed) in [(60.0, Fixed::Nothing), (108.0, Fixed::Splits), (108.0, Fixed::Clips)] {
            assert_ne!(varied(side, fixed), samples);
        }
        assert!(sample_varied(&context, &options, 19.0, Fixed::Nothing).is_err());
        assert!(sample_varied(&context, &options, 251.0, Fixed::Nothing).is_err());
    }

    // Each source of randomness in KDRT has its use (thesis §2.5.2 and fig. 2.20). Without random splits the seams lie
    // on a regular grid, whose harmonics peak in the spectrum. Without random clips all leaves show the same points,
    // and the spectrum is speckled as that of a single leaf: its contrast is high.

    /// Leaves along a side where every split is in the middle, and their side in radii.
    const LEAVES: i64 = 16;
    const LEAF: f64 = 24.0;

    /// Sets of each kind.
    const SEEDS: std::ops::Range<u64> = 0..6;

    /// Contrast and peaks of a kind of set.
    #[derive(Debug)]
    struct Figures {
        /// The mean contrast of the sets.
        contrast: f64,
        /// The largest peak of their mean spectrum on the harmonics, along the axes, of the grid of leaves that are
        /// split in the middle.
        peak: f64,
    }

    /// The figures of sets of about 100,000 samples.
    fn figures(sample: impl Fn(&Context, f64, u64) -> Result<Vec<[f32; 2]>>) -> Figures {
        let (domain, context) = (Domain::unit(Boundary::Periodic), Context::new(1).unwrap());
        let spectrum = |seed| {
            let samples = sample(&context, 1.0 / (LEAF * LEAVES as f64), seed).unwrap();
            periodogram(&context, &domain, &samples, 960, None).unwrap()
        };
        let spectra: Vec<_> = SEEDS.map(spectrum).collect();
        let contrasts = spectra.iter().map(|spectrum| spectrum.contrast(0.01, 0.5..1.5).unwrap());
        let harmonics = (1..480 / LEAVES).flat_map(|k| [[k * LEAVES, 0], [0, k * LEAVES]]);
        Figures {
            contrast: contrasts.sum::<f64>() / spectra.len() as f64,
            peak: Periodogram::mean(&spectra).unwrap().peak(0.01, harmonics).unwrap(),
        }
    }

    /// A set of the unbiased sampler.
    fn reference(context: &Context, radius: f64, seed: u64) -> Result<Vec<[f32; 2]>> {
        let options = maximal::Options::new(radius).seed(seed);
        Ok(maximal::sample(context, &options, None)?.positions)
    }

    /// The figures of planes with leaves of at least 20 radii, in which one part is not random.
    fn figures_of_planes(fixed: Fixed) -> Figures {
        figures(|context, radius, seed| {
            let varied = sample_varied(context, &Options::new(radius).seed(seed), pattern_side(20.0), fixed)?;
            assert!(varied.samples.len() > 100_000);
            Ok(varied.samples)
        })
    }

    /// Powers are about exponentially distributed. The contrast of a set, of 320,000 of them, has therefore a standard
    /// error of 2 / sqrt(320,000), which is 0.0036; the mean of six 0.0015, and the difference of two means 0.0021. The
    /// largest of the 58 harmonics' means of six exceeds 3.05 once in 67 times.
    #[test]
    fn with_both_randomnesses_a_plane_is_like_the_unbiased_reference() {
        let (reference, tiling) = (figures(reference), figures_of_planes(Fixed::Nothing));
        // Four standard errors; and two of them above the 0.004 by which the pattern's repetition raises the contrast.
        assert!((reference.contrast - 1.0).abs() < 0.006, "{reference:?}");
        assert!((tiling.contrast - reference.contrast).abs() < 0.008, "{tiling:?} {reference:?}");
        assert!(reference.peak < 3.05 && tiling.peak < 3.05, "{tiling:?} {reference:?}");
    }

    #[test]
    fn without_random_splits_the_grid_of_leaves_peaks() {
        let tiling = figures_of_planes(Fixed::Splits);
        assert!(tiling.peak > 12.0, "{tiling:?}");
    }

    #[test]
    fn without_random_clips_the_spectrum_is_speckled() {
        let tiling = figures_of_planes(Fixed::Clips);
        assert!(tiling.contrast > 2.0, "{tiling:?}");
    }
}
