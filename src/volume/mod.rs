//! Maximal Poisson-disk sets of cuboids, and of the inside of meshes.
//!
//! Source: Ebeida et al. 2012, "A simple algorithm for maximal Poisson-disk sampling in high dimensions", whose voxels are
//! divided until a sample covers them, in blocks. The domain is cut by a random kd-tree into *blocks* (`blocks.rs`), which
//! are filled in an order of random colours, each around its neighbours (`set.rs`): first darts on all blocks, then rounds on
//! what is open (`fill.rs`). A block has a list of the balls that touch each of its cells (`grid.rs`), in which darts and
//! *voxels*, the parts of cells (`voxels.rs`), are tested by vectors; the end is a search in integers (`search.rs`).
//!
//! On request cuboids are tiled first, as the plane is by KDRT (`tiling.rs`): parts of a pattern are laid into the leaves of
//! another kd-tree (`clip.rs`), and only what is exposed at their faces is filled (`exposed.rs`).
//!
//! All positions are points of the integer lattice of the plane, with a third axis (`plane/lattice.rs`).

pub mod adaptive;
mod blocks;
mod body;
mod classes;
mod clip;
mod distances;
mod exposed;
mod fill;
mod grid;
mod inside;
mod inside_options;
mod obstacles;
mod ranks;
mod search;
mod set;
mod shape;
mod shell;
mod solid;
mod space;
mod tiling;
mod voxels;

use crate::error::{Error, Result};
use crate::given::{Given, WITH_A_COUNT};
use crate::host::Stopwatch;
use crate::job::{Context, Job, Progress};
pub use crate::levels::Amount;
use crate::levels::{self, LevelOptions, Levelled, Levels, Ranked};
use crate::math::hypot;
use crate::memory;
use crate::order::{DEFAULT_QUOTIENT, Order, check_quotient};
use crate::plane::{GivenDisks, Lattice, float_spacing};
use crate::points::{Boundary, Domain, MAXIMAL_DENSITY_IN_SPACE, Points, check_radius, finest_radius};
use crate::setters::setters;
use crate::volume::set::{Sample, Set};
use body::Body;
pub use classes::{ClassesOptions, sample_classes};
use clip::pattern_bytes;
pub use inside_options::{InsideOptions, Surface};
pub use solid::{InsideReport, sample_inside};
use space::Space;
use tiling::is_worthwhile;

/// The most bytes of memory that a sample takes, with its position in the result: lattice points, also those of a pass
/// before they are put to the others, and positions.
const BYTES_PER_SAMPLE: f64 = 27.0;

/// The same for samples in progressive order or of an exact count, and of both.
const BYTES_PER_RANKED_SAMPLE: f64 = 62.0;
const BYTES_PER_FIRST_SAMPLE: f64 = 72.0;

/// The most bytes that a given sample takes: its ball, in its bin, and both while they are sorted.
const BYTES_PER_GIVEN: f64 = 96.0;

/// The same in a block, with images on a torus; and the number of samples of the sets that are about one block.
const BYTES_PER_GIVEN_OF_BLOCK: f64 = 230.0;
const SAMPLES_OF_BLOCK: f64 = 15_000.0;

/// The most bytes of the grid and the voxels of a block, which each thread has; and of the balls of its cells.
const BYTES_PER_THREAD: f64 = (4 << 20) as f64;
const BYTES_PER_THREAD_AROUND: f64 = (10 << 20) as f64;

/// The least number of samples for which another thread is of use.
const SAMPLES_PER_THREAD: f64 = 1000.0;

/// The smallest [`leaf_size`](Options::leaf_size), in radii: of smaller leaves more would be filled than copied.
pub const MIN_LEAF_SIZE: f64 = 6.0;

/// The radii by which a bounded cuboid has as many samples as one that is longer by so much and has no boundary.
const BEYOND: f64 = 0.7;

/// The ratio of the radius within which any sample covers a cuboid to its diagonal: above 1 by more than rounding.
const TOP: f64 = 1.001;

/// The options of a set of a cuboid.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options<'a> {
    /// The smallest centre-to-centre distance, above 0 and at least 64 float spacings at the domain's largest
    /// coordinate, which may exceed the domain: one sample is the result. Or the number of samples.
    pub amount: Amount,
    /// The cuboid to sample, even one that is thinner than the radius. On a torus whose period is below the radius a
    /// sample does not conflict with its own image.
    pub domain: Domain<3>,
    /// The same options and seed give the same samples.
    pub seed: u64,
    /// The order of the samples; by default any.
    pub order: Order,
    /// In progressive order, the largest ratio of the covering radius of the first samples to their rank, from
    /// [`Order::FIRST_COUNT`] samples on: 1.02 to 1.5, by default 2^(1/8). For fewer it is up to two, or the square of
    /// this if that is more. The smaller it is, the more levels there are, each of which takes time.
    pub quotient: f64,
    /// Samples that exist already, anywhere in space; on a torus they wrap. New samples are at least the clearance of each
    /// from it, in `f64` from the floats, and every point of the domain is within the radius of a new sample or the clearance
    /// of a given one, up to 7 float spacings at the domain's largest coordinate. Given samples are not part of the result,
    /// and are not compared with each other. With a count they must have clearances.
    pub given: Given<'a, 3>,
    /// The shortest side of a leaf, in radii: at least [`MIN_LEAF_SIZE`], or 0, the default, for a set that is not tiled. A
    /// tiled set consists of copies of a small one, laid into leaves with random sides up to twice this, with its gaps filled
    /// (Wang 2019). Larger leaves are faster and less biased, and need a larger pattern: docs/design/volume.md has the
    /// figures. Refused with a count and in progressive order.
    pub leaf_size: f64,
}

impl Options<'_> {
    /// This radius on the unit torus, with seed 0, in any order and without given samples.
    pub fn new(radius: f64) -> Self {
        Self::of(Amount::Radius(radius))
    }

    /// So many samples on the unit torus.
    pub fn by_count(count: usize) -> Self {
        Self::of(Amount::Count(count))
    }

    /// [`Options::new`] or [`Options::by_count`].
    pub fn of(amount: Amount) -> Self {
        let (domain, given) = (Domain::unit(Boundary::Periodic), Given::default());
        Self { amount, domain, seed: 0, order: Order::Any, quotient: DEFAULT_QUOTIENT, given, leaf_size: 0.0 }
    }
}

setters!(Options<'a> { domain: Domain<3>, seed: u64, order: Order, quotient: f64, given: Given<'a, 3>, leaf_size: f64 });

/// The report of [`sample`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// No two samples are nearer: the radius of the options, or that of the set of a count.
    pub radius: f64,
    /// No point of the domain is farther from all samples, and outside of all given ones, up to the tolerance of [`sample`]:
    /// the radius, or of a count up to 1.1 times it, in progressive order the quotient times it.
    pub covering_radius: f64,
    /// Wall time in seconds.
    pub seconds: f64,
}

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
/// With a [`leaf_size`](Options::leaf_size) the set is tiled: just as free of conflicts and as maximal, faster with leaves of
/// 20 radii and more, up to 1 % denser, and with more power at low frequencies. A cuboid that is smaller than the pattern, of
/// 34.5 radii or two leaf sizes along each axis, or along an axis shorter than a leaf, on a torus than two, is not tiled.
///
/// With [`Amount::Count`] the set has exactly so many samples, and the report has the radius and a bound of the covering
/// radius, at most 1.1 times the radius where no samples are given and there are more than a handful.
///
/// In [`Order::Progressive`] the samples are sorted coarse to fine, and have [ranks](Points::ranks), the first ones infinite.
/// For every prefix, from the first sample on: no two samples of it are nearer than the rank of its last one, and every point
/// of the domain is within [`Options::quotient`] times this rank of a sample of it, up to 9 float spacings at the domain's
/// largest coordinate. A set of fewer samples is a prefix of a set of more, of the same domain with the same quotient and
/// seed, to the bit. Sets of two radii share the levels above both: all samples with a rank of at least the quotient times
/// the larger radius.
///
/// # Errors
/// [`Error::InvalidArgument`] for an option out of range or floats too coarse for the radius, and for a count of 0 or of
/// more than floats or given samples leave room for; [`Error::TooLarge`] above 2^32 samples or the available memory, both
/// before any work; [`Error::Cancelled`].
pub fn sample(context: &Context, options: &Options, progress: Option<&Progress>) -> Result<(Points<3>, Report)> {
    let stopwatch = Stopwatch::start();
    let (points, [radius, covering_radius]) = fill(context, options, None, progress)?;
    Ok((points, Report { radius, covering_radius, seconds: stopwatch.seconds() }))
}

/// A set of a cuboid, or of a body in it, with its radius and covering radius.
fn fill(
    context: &Context,
    options: &Options,
    body: Option<&Body>,
    progress: Option<&Progress>,
) -> Result<(Points<3>, [f64; 2])> {
    let &Options { amount, domain, seed, order, quotient, given, leaf_size } = options;
    domain.check()?;
    given.check()?;
    check_leaf_size(leaf_size, amount, order)?;
    if order == Order::Progressive {
        check_quotient(quotient)?;
    }
    let finest = finest_radius(float_spacing(domain.min.iter().chain(&domain.max)));
    let bytes_per_sample = match (amount, order) {
        (Amount::Radius(_), Order::Any) => BYTES_PER_SAMPLE,
        (Amount::Count(_), Order::Progressive) => BYTES_PER_FIRST_SAMPLE,
        _ => BYTES_PER_RANKED_SAMPLE,
    };
    let mut beside = body.map_or(0.0, |body| body.bytes);
    let (lattice, is_tiled) = match amount {
        Amount::Radius(radius) => {
            let expected = checked_samples(&domain, body, radius)?;
            // Before the memory: the radius that floats allow.
            let lattice = Lattice::of_any_size(&domain, radius)?;
            let is_tiled = leaf_size > 0.0 && is_worthwhile(&lattice, leaf_size);
            beside += if is_tiled { pattern_bytes(leaf_size) } else { 0.0 };
            require(context, expected, bytes_per_sample, &given, beside, "radius")?;
            (lattice, is_tiled)
        }
        Amount::Count(count) => {
            check_count(count, &given)?;
            require(context, count as f64, bytes_per_sample, &given, beside, "count")?;
            (Lattice::of_any_size(&domain, finest)?, false)
        }
    };
    // Beside a count each given sample has a clearance.
    let radius = if let Amount::Radius(radius) = amount { radius } else { finest };
    let (has_given, given) = (!given.positions.is_empty(), GivenDisks::new(&domain, &lattice, radius, &given));
    let space = Space { lattice: &lattice, given: &given, solid: body.map(Body::solid) };
    if let (Amount::Radius(radius), Order::Any) = (amount, order) {
        let leaf_size = is_tiled.then_some(leaf_size);
        let set = context.run(progress, |job| Set::maximal(job, space, leaf_size, seed))?;
        return Ok((set.into_positions().into(), [radius; 2]));
    }
    let cuboid = Cuboid { has_given, domain, body, space };
    let levels = Levels::new(cuboid, seed);
    let found = context.run(progress, |job| match (amount, order) {
        (Amount::Radius(radius), _) => levels::by_radius(job, levels, quotient, radius),
        (Amount::Count(count), Order::Progressive) => levels::by_count(job, levels, quotient, count, finest),
        (Amount::Count(count), Order::Any) => levels::exactly(job, levels, count, finest),
    })?;
    let mut points =
        Points::from(found.samples.iter().map(|sample| lattice.position(sample.point)).collect::<Vec<_>>());
    if order == Order::Progressive {
        points.ranks = found.samples.iter().map(|sample| sample.rank).collect();
    }
    Ok((points, [found.radius, found.covering_radius]))
}

/// The approximate number of samples of a radius; refuses one out of range, and more samples than can be indexed.
fn checked_samples(domain: &Domain<3>, body: Option<&Body>, radius: f64) -> Result<f64> {
    check_radius(radius)?;
    let (expected, limit) = (expected_samples(domain, body, radius), f64::from(u32::MAX));
    if expected > limit {
        let reason = format!("{radius:?} asks for about {expected:.2e} samples, above the limit of {limit:.2e}");
        return Err(Error::too_large("radius", reason));
    }
    Ok(expected)
}

/// Refuses a leaf size that is neither 0 nor a size, and one beside a count or a progressive order: their levels are filled.
fn check_leaf_size(leaf_size: f64, amount: Amount, order: Order) -> Result<()> {
    if leaf_size == 0.0 {
        return Ok(());
    }
    let reason = match (amount, order) {
        _ if !(leaf_size.is_finite() && leaf_size >= MIN_LEAF_SIZE) => {
            format!("{leaf_size:?} is neither 0 nor a finite number of at least {MIN_LEAF_SIZE} (radii)")
        }
        (Amount::Count(_), _) => format!("{leaf_size:?} has no effect with a count"),
        (_, Order::Progressive) => format!("{leaf_size:?} has no effect in progressive order"),
        _ => return Ok(()),
    };
    Err(Error::invalid("leaf_size", reason))
}

/// Refuses a count that is 0 or cannot be indexed, and given samples without clearances beside it.
fn check_count(count: usize, given: &Given<3>) -> Result<()> {
    if count == 0 {
        return Err(Error::invalid("count", "0 is not at least 1"));
    }
    if count > u32::MAX as usize {
        return Err(Error::too_large("count", format!("{count}; the limit is {}", u32::MAX)));
    }
    given.require_clearances(WITH_A_COUNT)
}

/// Refuses more samples than can be held beside given ones and so many bytes.
fn require(
    context: &Context,
    samples: f64,
    bytes: f64,
    given: &Given<3>,
    beside: f64,
    argument: &'static str,
) -> Result<()> {
    let threads = (context.num_threads() as f64).min(samples / SAMPLES_PER_THREAD);
    let given = given.positions.len() as f64;
    let bytes_per_given = BYTES_PER_GIVEN + BYTES_PER_GIVEN_OF_BLOCK * (SAMPLES_OF_BLOCK / samples).min(1.0);
    let bytes_per_thread = BYTES_PER_THREAD + if given > 0.0 { BYTES_PER_THREAD_AROUND } else { 0.0 };
    let bytes = samples * bytes + given * bytes_per_given + threads.max(1.0) * bytes_per_thread + beside;
    memory::require(bytes, argument, &format!("about {samples:.0} samples"))
}

/// A cuboid, or a body in it, that is filled level by level.
struct Cuboid<'a> {
    domain: Domain<3>,
    body: Option<&'a Body>,
    /// Its lattice is of any radius.
    space: Space<'a>,
    has_given: bool,
}

impl Ranked for Sample {
    type Place = [i32; 3];

    fn rank(&self) -> f32 {
        self.rank
    }

    fn place(&self) -> [i32; 3] {
        self.point
    }
}

impl Levelled for Cuboid<'_> {
    type Sample = Sample;

    const DIMENSION: u32 = 3;

    const NAMES: [&'static str; 2] = ["domain", "domain"];

    fn top(&self) -> f64 {
        let [x, y, z] = self.domain.extent();
        TOP * hypot(hypot(x, y), z)
    }

    fn expected(&self, radius: f64) -> f64 {
        expected_samples(&self.domain, self.body, radius)
    }

    fn check_work(&self, radius: f64, count: usize) -> Result<()> {
        let expected = self.expected(radius);
        if !self.has_given || expected <= f64::from(u32::MAX) {
            return Ok(());
        }
        let reason = format!("{count} samples beside the given ones: on the whole domain about {expected:.3e} samples");
        Err(Error::too_large("count", reason))
    }

    fn no_place(&self, count: usize) -> Error {
        match self.body {
            Some(body) if !self.has_given => body.encloses_nothing(),
            _ => levels::covered_by_given(count, Self::NAMES[1]),
        }
    }

    fn fill(&self, job: &Job, options: LevelOptions, radius: f64, samples: &[Sample]) -> Result<(Vec<Sample>, u64)> {
        let lattice = self.space.lattice.with_radius(radius);
        let mut space = Space { lattice: &lattice, ..self.space };
        // A body that is thinner than the tolerance of a large radius takes more attempts, each of which gets half of the
        // progress that is left.
        let mut done = if space.solid.is_some() && samples.is_empty() { 0.5 } else { 1.0 };
        let mut added = Set::added(&job.part(0.0, done), space, options, samples)?;
        while let Some(solid) = &mut space.solid
            && samples.is_empty()
            && added.is_empty()
            && solid.refine()
        {
            let next = 0.5 * (1.0 + done);
            added = Set::added(&job.part(done, next), space, options, samples)?;
            done = next;
        }
        let mut all = Vec::with_capacity(samples.len() + added.len());
        all.extend_from_slice(samples);
        all.extend(added);
        // Darts are not counted.
        Ok((all, 0))
    }
}

/// The approximate number of samples; at least one.
fn expected_samples(domain: &Domain<3>, body: Option<&Body>, radius: f64) -> f64 {
    if let Some(body) = body {
        return body.expected_samples(radius);
    }
    let beyond = if domain.boundary == Boundary::Bounded { BEYOND } else { 0.0 };
    let volume: f64 = domain.extent().into_iter().map(|side| side / radius + beyond).product();
    (MAXIMAL_DENSITY_IN_SPACE * volume).max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(radius: f64, size: [f64; 3], boundary: Boundary) -> (f64, f64) {
        let options = Options::new(radius).domain(Domain { min: [0.0; 3], max: size, boundary });
        let (samples, _) = sample(&Context::new(1).unwrap(), &options, None).unwrap();
        (samples.len() as f64, expected_samples(&options.domain, None, radius))
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
