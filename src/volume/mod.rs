//! Maximal Poisson-disk sets of cuboids.
//!
//! Source: Ebeida et al. 2012, "A simple algorithm for maximal Poisson-disk sampling in high dimensions", whose voxels are
//! divided until a sample covers them, in blocks. The domain is cut by a random kd-tree into *blocks* (`blocks.rs`), which
//! are filled in an order of random colours, each around its neighbours (`set.rs`): first darts on all blocks, then rounds on
//! what is open (`fill.rs`). A block has a list of the balls that touch each of its cells (`grid.rs`), in which darts and
//! *voxels*, the parts of cells (`voxels.rs`), are tested by vectors; the end is a search in integers (`search.rs`).
//!
//! All positions are points of the integer lattice of the plane, with a third axis (`plane/lattice.rs`).

mod blocks;
mod fill;
mod grid;
mod obstacles;
mod search;
mod set;
mod voxels;

use crate::error::{Error, Result};
use crate::given::Given;
use crate::job::{Context, Progress};
use crate::memory;
use crate::plane::{GivenDisks, Lattice};
use crate::points::{Boundary, Domain, MAXIMAL_DENSITY_IN_SPACE, Points, check_radius};
use crate::setters::setters;
use crate::simd::Level;
use crate::volume::set::Set;

/// The most bytes of memory that a sample takes, with its position in the result: lattice points, also those of a pass
/// before they are put to the others, and positions.
const BYTES_PER_SAMPLE: f64 = 27.0;

/// The most bytes that a given sample takes: its ball, in its bin, and both while they are sorted.
const BYTES_PER_GIVEN: f64 = 96.0;

/// The most bytes of the grid and the voxels of a block, which each thread has.
const BYTES_PER_THREAD: f64 = (4 << 20) as f64;

/// The least number of samples for which another thread is of use.
const SAMPLES_PER_THREAD: f64 = 1000.0;

/// The radii by which a bounded cuboid has as many samples as one that is longer by so much and has no boundary.
const BEYOND: f64 = 0.7;

/// The options of a set of a cuboid.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options<'a> {
    /// The smallest centre-to-centre distance, above 0 and at least 64 float spacings at the domain's largest
    /// coordinate. It may exceed the domain: one sample is the result.
    pub radius: f64,
    /// The cuboid to sample, even one that is thinner than the radius. On a torus whose period is below the radius a
    /// sample does not conflict with its own image.
    pub domain: Domain<3>,
    /// The same options and seed give the same samples.
    pub seed: u64,
    /// Samples that exist already, anywhere in space; on a torus they wrap. New samples are at least the clearance of each
    /// from it, in `f64` from the floats, and every point of the domain is within the radius of a new sample or the clearance
    /// of a given one, up to 7 float spacings at the domain's largest coordinate. Given samples are not part of the result,
    /// and are not compared with each other.
    pub given: Given<'a, 3>,
}

impl Options<'_> {
    /// This radius on the unit torus, with seed 0 and no given samples.
    pub fn new(radius: f64) -> Self {
        Self { radius, domain: Domain::unit(Boundary::Periodic), seed: 0, given: Given::default() }
    }
}

setters!(Options<'a> { radius: f64, domain: Domain<3>, seed: u64, given: Given<'a, 3> });

/// A maximal Poisson-disk set of a cuboid.
///
/// * Conflict-free: all distances of the returned floats are at least `radius`, in `f64`, without tolerance. On a torus
///   they wrap with the period `domain.max - domain.min`.
/// * Maximal: no point of the domain is farther from all samples than `radius` + 3.5 float spacings at the domain's
///   largest coordinate.
/// * `domain.min <= x < domain.max`; the order is by blocks of 9 to 18 radii.
///
/// A torus has about [`MAXIMAL_DENSITY_IN_SPACE`] samples per cubed radius, up to 0.3 % more than by darts that are thrown one
/// after the other; a bounded cuboid has more, as samples stand on its faces. O(n) for n samples, and the same samples for
/// every number of threads.
///
/// # Errors
/// [`Error::InvalidArgument`] for a radius or domain out of range or floats too coarse for the radius,
/// [`Error::TooLarge`] above 2^32 samples or the available memory, both before any work; [`Error::Cancelled`].
pub fn sample(context: &Context, options: &Options, progress: Option<&Progress>) -> Result<Points<3>> {
    let &Options { radius, domain, seed, given } = options;
    domain.check()?;
    check_radius(radius)?;
    given.check()?;
    let expected = expected_samples(&domain, radius);
    if expected > f64::from(u32::MAX) {
        let limit = f64::from(u32::MAX);
        let reason = format!("{radius:?} asks for about {expected:.2e} samples, above the limit of {limit:.2e}");
        return Err(Error::too_large("radius", reason));
    }
    let lattice = Lattice::of_any_size(&domain, radius)?;
    let threads = (context.num_threads() as f64).min(expected / SAMPLES_PER_THREAD);
    let bytes =
        expected * BYTES_PER_SAMPLE + threads * BYTES_PER_THREAD + given.positions.len() as f64 * BYTES_PER_GIVEN;
    memory::require(bytes, "radius", &format!("about {expected:.0} samples"))?;
    let given = GivenDisks::new(&domain, &lattice, radius, &given);
    let set = context.run(progress, |job| Set::new(job, &lattice, &given, seed, Level::widest()))?;
    Ok(set.into_positions().into())
}

/// The approximate number of samples; at least one.
fn expected_samples(domain: &Domain<3>, radius: f64) -> f64 {
    let beyond = if domain.boundary == Boundary::Bounded { BEYOND } else { 0.0 };
    let volume: f64 = domain.extent().into_iter().map(|side| side / radius + beyond).product();
    (MAXIMAL_DENSITY_IN_SPACE * volume).max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(radius: f64, size: [f64; 3], boundary: Boundary) -> (f64, f64) {
        let options = Options::new(radius).domain(Domain { min: [0.0; 3], max: size, boundary });
        let samples = sample(&Context::new(1).unwrap(), &options, None).unwrap();
        (samples.len() as f64, expected_samples(&options.domain, radius))
    }

    #[test]
    fn the_number_of_samples_is_as_expected() {
        for (boundary, tolerance) in [(Boundary::Periodic, 0.01), (Boundary::Bounded, 0.03)] {
            let (found, expected) = count(0.05, [1.0, 0.8, 1.1], boundary);
            assert!((found / expected - 1.0).abs() < tolerance, "{boundary:?}: {found} of {expected}");
        }
        assert_eq!(count(3.0, [1.0, 0.5, 0.2], Boundary::Periodic), (1.0, 1.0));
    }

    #[test]
    fn more_samples_than_can_be_held_are_refused() {
        let context = Context::new(1).unwrap();
        let refused = |radius: f64, max: f64| {
            let domain = Domain { min: [0.0; 3], max: [max; 3], boundary: Boundary::Bounded };
            sample(&context, &Options::new(radius).domain(domain), None).unwrap_err().to_string()
        };
        assert!(refused(1e-4, 1.0).starts_with("radius: 0.0001 asks for about 7.34e11 samples"));
        // Also where floats are too coarse.
        assert!(refused(1e-9, 1.0).starts_with("radius: 1e-9 asks for about 7.34e26 samples"));
        assert!(refused(f64::NAN, 1.0).starts_with("radius: NaN is not a positive"));
        assert!(refused(0.1, 0.0).starts_with("domain_max: [0] is 0, not above domain_min"));
    }
}
