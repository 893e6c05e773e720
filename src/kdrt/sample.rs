//! A whole set by its radius: all windows of a tiling.

use std::sync::Arc;

use crate::error::Result;
use crate::job::{Context, Job, Progress};
use crate::kdrt::around::Around;
use crate::kdrt::options::{Options, check_ladder, check_leaf_size};
use crate::kdrt::output::capacity;
use crate::kdrt::progressive::{Progressive, Ranked, require_memory};
use crate::kdrt::tiling::Tiling;
use crate::order::Order;
use crate::plane::lattice::Lattice;
use crate::{maximal, memory};

/// The most bytes that a sample takes: in the result, and a part of those windows at work.
pub(super) const BYTES_PER_SAMPLE: f64 = 16.0;

/// The share of the progress that making the pattern takes.
pub(super) const PATTERN_SHARE: f64 = 0.05;

/// A maximal Poisson-disk set of a rectangle, in parallel.
///
/// * Conflict-free: all distances of the returned floats are at least `radius`, in `f64`, without tolerance. On a torus
///   they wrap with the period `domain.max - domain.min`.
/// * Maximal: no point of the domain is farther from all samples than `radius` + 3 float spacings at the domain's
///   largest coordinate.
/// * `domain.min <= x < domain.max`; the samples come by windows of about 270 radii, in these by leaves; or in
///   [progressive order](Order::Progressive).
/// * The same for every number of threads.
/// * Its only bias is at the seams: somewhat more samples than an unbiased set, the fewer the larger the leaves.
///
/// O(n) for n samples, after the making of a pattern, whose side is 10 leaf sizes, but at least 108 radii and at most 200
/// radii or 4 leaf sizes, whichever is longer: about 28,000 samples with leaves of the default size. A domain of
/// less area than the pattern, or narrower than about two of the smallest leaves (13 radii), is not tiled: it is
/// given to [`crate::maximal`]. In progressive order it takes about fifteen times
/// as long.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for an argument out of range or floats too coarse for the
/// radius, [`Error::TooLarge`](crate::Error::TooLarge) above 2^32 samples or the available memory, both before any work;
/// [`Error::Cancelled`](crate::Error::Cancelled).
pub fn sample(context: &Context, options: &Options, progress: Option<&Progress>) -> Result<Vec<[f32; 2]>> {
    sample_ranked(context, options, progress).map(|ranked| ranked.samples)
}

/// [`sample`] with the ranks of its samples, if the options ask for progressive order.
///
/// # Errors
/// Those of [`sample`].
pub fn sample_ranked(context: &Context, options: &Options, progress: Option<&Progress>) -> Result<Ranked> {
    let &Options { radius, domain, leaf_size, seed, order, quotient, coarsest, given } = options;
    check_leaf_size(leaf_size)?;
    let lattice = Lattice::new(&domain, radius)?;
    given.check()?;
    match order {
        Order::Any => {
            let around = Around::new(&domain, &lattice, radius, &given);
            let samples = context.run(progress, |job| sample_lattice(job, &lattice, leaf_size, seed, around.into()))?;
            Ok(Ranked::in_any_order(samples))
        }
        Order::Progressive => {
            check_ladder(quotient, coarsest, radius)?;
            require_memory(lattice.expected_samples(), "radius")?;
            context.run(progress, |job| {
                let levels = Progressive::new(&job.part(0.0, PATTERN_SHARE), options)?;
                levels.whole(&job.part(PATTERN_SHARE, 1.0))
            })
        }
    }
}

/// [`sample`] on a lattice and around disks that are at hand.
pub(super) fn sample_lattice(
    job: &Job,
    lattice: &Lattice,
    leaf_size: f64,
    seed: u64,
    around: Arc<Around>,
) -> Result<Vec<[f32; 2]>> {
    if !Tiling::is_worthwhile(lattice, leaf_size) {
        return maximal::sample_lattice_around(job, lattice, seed, around.near(&lattice.rect()));
    }
    let expected = lattice.expected_samples();
    memory::require(expected * BYTES_PER_SAMPLE, "radius", &format!("about {expected:.0} samples"))?;
    let tiling = Tiling::new(&job.part(0.0, PATTERN_SHARE), lattice.clone(), leaf_size, seed, around)?;
    let windows = tiling.windows();
    job.part(PATTERN_SHARE, 1.0).concat_about(capacity(expected), windows.len(), |i| tiling.window(&windows[i]))
}
