//! KDRT: massive maximal Poisson-disk sets in the plane, by randomized tiling.
//!
//! Source: Wang 2019, *Techniques on Mining Effective Parallelism For High-Performance Blue-Noise Sampling*, chapter 2
//! (Wang and Suda 2017). One small maximal set, the *pattern*, is made; the domain is cut by a random kd-tree
//! (`divide.rs`); into every leaf a random part of the pattern is laid (`clip.rs`); at the seams conflicts are
//! eliminated (`conquer.rs`) and gaps filled (`fill.rs`). Most samples are copies that nothing needs to look at.
//!
//! The thesis goes through the seams in an order of work. Here every step is a function of the place alone, so that a
//! window of the plane (`plane.rs`) can be made without the rest; this is how threads share the work, and how any part
//! of a plane can be had alone (`window.rs`). A number of samples instead of a radius is `count.rs`; sets that were made
//! apart are glued into one by the same two steps (`merge/`). Each file says where it departs from the thesis.

mod bitmap;
mod blocks;
mod clip;
mod conquer;
mod count;
mod divide;
mod fill;
mod measure;
mod merge;
mod output;
mod plane;
mod stamp;
#[allow(unsafe_code)] // Vector instructions.
mod vectors;
mod window;

use crate::error::{Error, Result};
use crate::job::{Context, Job, Progress};
use crate::plane::lattice::Lattice;
use crate::points::{Boundary, Domain};
use crate::setters::setters;
use crate::{maximal, memory};

use plane::Plane;

pub use count::{CountOptions, CountReport, Counted, sample_count};
pub use measure::{Stages, measure};
pub use merge::{MergeOptions, MergeReport, Piece, merge};
pub use window::{sample_stream, sample_window};

/// The leaf size, in radii, that balances speed and spectrum.
pub const DEFAULT_LEAF_SIZE: f64 = 20.0;

/// The smallest leaf size, in radii: below it the seams of three leaves could act on each other.
pub const MIN_LEAF_SIZE: f64 = 6.0;

/// The most bytes that a sample takes: in its window, in the result, and a part of those windows at work.
const BYTES_PER_SAMPLE: f64 = 24.0;

/// The share of the progress that making the pattern takes.
const PATTERN_SHARE: f64 = 0.05;

/// What to sample.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The smallest centre-to-centre distance, above 0 and at least 64 float spacings at the domain's largest
    /// coordinate. It may exceed the domain: one sample is the result.
    pub radius: f64,
    /// Where to sample: any rectangle, also one thinner than the radius. On a torus whose period is below the radius
    /// a sample does not conflict with its own image.
    pub domain: Domain,
    /// The shortest side of a leaf, in radii: at least [`MIN_LEAF_SIZE`], usually [`DEFAULT_LEAF_SIZE`]. Sides are
    /// random, up to twice this. Larger is faster and less biased at the seams, and needs a larger pattern.
    pub leaf_size: f64,
    /// The same options and seed give the same samples.
    pub seed: u64,
}

impl Options {
    /// This radius on the unit torus, with leaves of [`DEFAULT_LEAF_SIZE`] and seed 0.
    pub fn new(radius: f64) -> Self {
        Self { radius, domain: Domain::unit(Boundary::Periodic), leaf_size: DEFAULT_LEAF_SIZE, seed: 0 }
    }
}

setters!(Options { radius: f64, domain: Domain, leaf_size: f64, seed: u64 });

/// A maximal Poisson-disk set of a rectangle, in parallel.
///
/// * Conflict-free: all distances of the returned floats are at least `radius`, in `f64`, without tolerance. On a torus
///   they wrap with the period `domain.max - domain.min`.
/// * Maximal: no point of the domain is farther from all samples than `radius` + 3 float spacings at the domain's
///   largest coordinate.
/// * `domain.min <= x < domain.max`; the samples come by windows of about 270 radii, in these by leaves.
/// * The same for every number of threads.
/// * Its only bias is at the seams: somewhat more samples than an unbiased set, the fewer the larger the leaves.
///
/// O(n) for n samples, after the making of a pattern, whose side is 10 leaf sizes, but at least 108 radii and at most 200
/// radii or 4 leaf sizes, whichever is longer: about 28,000 samples with leaves of the default size. A domain of
/// less area than the pattern, or narrower than about two of the smallest leaves (13 radii), is not tiled: it is
/// given to [`crate::maximal`], on one thread.
///
/// # Errors
/// [`Error::InvalidArgument`] for an argument out of range or floats too coarse for the radius, [`Error::TooLarge`]
/// above 2^32 samples or the available memory, both before any work; [`Error::Cancelled`].
pub fn sample(context: &Context, options: &Options, progress: Option<&Progress>) -> Result<Vec<[f32; 2]>> {
    let &Options { radius, domain, leaf_size, seed } = options;
    check_leaf_size(leaf_size)?;
    let lattice = Lattice::new(&domain, radius)?;
    context.run(progress, |job| sample_lattice(job, &lattice, leaf_size, seed))
}

/// [`sample`] on a lattice that is at hand.
fn sample_lattice(job: &Job, lattice: &Lattice, leaf_size: f64, seed: u64) -> Result<Vec<[f32; 2]>> {
    if !Plane::is_worthwhile(lattice, leaf_size) {
        return maximal::sample_lattice(job, lattice, seed);
    }
    let expected = lattice.expected_samples();
    memory::require(expected * BYTES_PER_SAMPLE, "radius", &format!("about {expected:.0} samples"))?;
    let plane = Plane::new(&job.part(0.0, PATTERN_SHARE), lattice.clone(), leaf_size, seed)?;
    let windows = plane.windows();
    job.part(PATTERN_SHARE, 1.0).concat(windows.len(), |i| plane.window(&windows[i]))
}

fn check_leaf_size(leaf_size: f64) -> Result<()> {
    if leaf_size.is_finite() && leaf_size >= MIN_LEAF_SIZE {
        return Ok(());
    }
    let reason = format!("{leaf_size:?} is not a finite number of at least {MIN_LEAF_SIZE} (radii)");
    Err(Error::invalid("leaf_size", reason))
}
