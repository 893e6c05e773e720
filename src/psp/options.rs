//! The options of the calls: a type for each, with the fields that the call reads. Flat interfaces have one list of
//! options for several calls ([`FlatOptions`]), not all of which can be combined: that is refused here, and only here.

use crate::error::{Error, Result};
use crate::given::Given;
use crate::levels::Amount;
use crate::order::Order;
pub use crate::order::{DEFAULT_QUOTIENT, check_quotient};
use crate::psp::adaptive::Radius;
use crate::setters::setters;
use crate::trace::HAS_EMBREE;

/// The order of an iteration's candidates: of two that are too close the first one is kept. Existing samples come
/// before all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Priority {
    /// By how squarely their projector faces them: there the pattern is stretched less. Finds more samples.
    #[default]
    Squareness,
    /// By the number of their projector (thesis §3.3.2).
    Projector,
}

/// The projectors of an iteration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Projectors {
    /// A projector for each chart: a part of the surface that lies in one cube, 48 radii wide, and faces about one
    /// direction. An iteration takes a fraction of the time of a maximal set and finds most of its samples, where
    /// triangles are not many for each sample.
    #[default]
    Local,
    /// Three orthogonal projectors for the whole mesh (thesis §3.3.1).
    Global,
}

/// The engine that finds the hits of the projectors.
///
/// With [local projectors](Projectors::Local) all engines give the same samples, to the bit, on every machine: Embree
/// only says on which triangles a hit can be, and a point of the pattern that is nearer than a millionth of the mesh's
/// diagonal to an edge of a triangle, as its projector sees them, does not hit it.
///
/// With [global ones](Projectors::Global) Embree and the rasteriser have the same hits up to rounding: points and edges
/// move against each other by up to 2e-7 of the mesh's diagonal, as their projector sees them. A point that near to an
/// edge may fall on the other side, and barycentrics differ by up to this over the height of their triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Engine {
    /// By cost: the rasteriser for local projectors, which took the least time on every mesh measured, from a triangle for
    /// thousands of samples to two hundred for each; for global ones Embree, where a build has it
    /// ([`HAS_EMBREE`](crate::trace::HAS_EMBREE)).
    #[default]
    Auto,
    /// Packets of rays through the hierarchy of Embree: the time grows with the number of rays.
    Embree,
    /// Triangles drawn over the pattern (thesis §3.4.3): the time grows with the number of triangles. With global
    /// projectors in exact integer arithmetic: a point on an edge that triangles share hits one of them on either side,
    /// never none or both.
    Rasteriser,
}

impl Engine {
    /// The engines that this build can be asked for by name.
    pub const AVAILABLE: &[Self] = if HAS_EMBREE { &[Self::Embree, Self::Rasteriser] } else { &[Self::Rasteriser] };

    /// The engine of global projectors.
    pub(super) fn of_global(self) -> Self {
        if self == Self::Auto { Self::AVAILABLE[0] } else { self }
    }
}

/// The options of [`sample`](super::sample).
///
/// If no more than 25,000 samples are expected, on the area and along edges longer than the radius, a set is filled in
/// one piece and is unbiased; a larger one is filled cube by cube and holds up to about 0.8 % more samples than
/// unbiased darts give, at the seams of the cubes, or is [projected](Options::projected) first.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options<'a> {
    /// The radius or the number of samples.
    pub amount: Amount,
    /// The order of the samples; by default any.
    pub order: Order,
    /// In progressive order, the largest ratio of the covering radius of the first samples to their rank, from
    /// [`Order::FIRST_COUNT`] samples on: 1.02 to 1.5, by default 2^(1/8). For fewer it is up to two, or the square of
    /// this if that is more. The smaller it is, the more levels there are, each of which takes time.
    pub quotient: f64,
    /// Selects one of 2^64 sets.
    pub seed: u64,
    /// Existing samples: new ones keep their clearances, and cover the surface that is farther than that from all of
    /// them. They are not among the samples that are returned. With a count they must have clearances.
    pub given: Given<'a, 3>,
    /// Samples on triangles whose normals have a smaller cosine ignore each other, and so do samples and uncovered
    /// surface: the sides of a thin wall are sampled as if they were far apart. From -1, which is off, to 1, where only
    /// samples with the same normal interact. The triangles must be wound consistently. Given samples have no normal:
    /// they act on all sides.
    pub cosine: f64,
    /// True, the default, if an iteration of [local projectors](Projectors::Local) precedes the fill of a set of more
    /// than about 25,000 samples, in any order, where that takes less time: by a rule of mesh, radius and given samples
    /// (docs/design/surface.md). False: all samples are darts. Those in progressive order, and of a count beside given
    /// samples, always are.
    pub projected: bool,
}

impl Options<'_> {
    /// A set of this radius.
    pub fn new(radius: f64) -> Self {
        Self::of(Amount::Radius(radius))
    }

    /// A set of so many samples.
    pub fn by_count(count: usize) -> Self {
        Self::of(Amount::Count(count))
    }

    fn of(amount: Amount) -> Self {
        let (order, given) = (Order::Any, Given::default());
        Self { amount, order, quotient: DEFAULT_QUOTIENT, seed: 0, given, cosine: -1.0, projected: true }
    }
}

setters!(Options<'a> {
    order: Order,
    quotient: f64,
    seed: u64,
    given: Given<'a, 3>,
    cosine: f64,
    projected: bool,
});

/// The options of [`Psp`](super::Psp) and of [`project`](super::project).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ProjectionOptions<'a> {
    /// The smallest distance of two samples, in the units of the mesh; positive and finite.
    pub radius: f64,
    /// Selects one of 2^64 sets.
    pub seed: u64,
    /// The projectors of each iteration.
    pub projectors: Projectors,
    /// The candidates that come first.
    pub priority: Priority,
    /// The engine that finds the hits.
    pub engine: Engine,
    /// As in [`Options::given`].
    pub given: Given<'a, 3>,
    /// As in [`Options::cosine`], for [`Psp::fill`](super::Psp::fill). Projection does not distinguish sides:
    /// iterations require -1.
    pub cosine: f64,
}

impl ProjectionOptions<'_> {
    /// Sets of this radius.
    pub fn new(radius: f64) -> Self {
        let (priority, engine, given) = (Priority::default(), Engine::default(), Given::default());
        Self { radius, seed: 0, projectors: Projectors::default(), priority, engine, given, cosine: -1.0 }
    }

    /// These options without the given samples.
    pub(crate) fn without_given(&self) -> ProjectionOptions<'static> {
        let &Self { radius, seed, projectors, priority, engine, given: _, cosine } = self;
        ProjectionOptions { radius, seed, projectors, priority, engine, given: Given::default(), cosine }
    }
}

setters!(ProjectionOptions<'a> {
    seed: u64,
    projectors: Projectors,
    priority: Priority,
    engine: Engine,
    given: Given<'a, 3>,
    cosine: f64,
});

/// The options of [`sample_region`](super::sample_region).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RegionOptions<'a> {
    /// The smallest distance of two samples, in the units of the mesh; positive and finite.
    pub radius: f64,
    /// Selects one of 2^64 sets.
    pub seed: u64,
    /// As in [`Options::given`].
    pub given: Given<'a, 3>,
    /// As in [`Options::cosine`].
    pub cosine: f64,
}

impl RegionOptions<'_> {
    /// Sets of this radius.
    pub fn new(radius: f64) -> Self {
        Self { radius, seed: 0, given: Given::default(), cosine: -1.0 }
    }
}

setters!(RegionOptions<'a> { seed: u64, given: Given<'a, 3>, cosine: f64 });

/// The options of [`sample_instances`](super::sample_instances), which are those of a region. Samples of different
/// instances act on all sides, whatever the cosine.
pub type InstanceOptions<'a> = RegionOptions<'a>;

/// All options of sets of one radius or count, for interfaces without types: C, Python, JavaScript and the command line.
/// In Rust, [`Options`] and [`ProjectionOptions`] say the same, and cannot be combined wrongly.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct FlatOptions<'a> {
    /// The radius; 0 where there is a count.
    pub radius: f64,
    /// The number of samples; 0, the default: as many as the radius gives.
    pub count: usize,
    /// The order; by default any. Progressive order, like a count, requires a set that is only filled.
    pub order: Order,
    /// As [`Options::quotient`].
    pub quotient: f64,
    /// The number of iterations before the fill. `None`, the default: 1 of local projectors where that takes less time
    /// ([`Options::projected`]) or the set is not maximal, otherwise 0. With 0 all samples are darts.
    pub iterations: Option<u32>,
    /// True, the default, if the surface that the projectors leave uncovered is filled.
    pub maximal: bool,
    /// Selects one of 2^64 sets.
    pub seed: u64,
    /// As [`ProjectionOptions::projectors`].
    pub projectors: Projectors,
    /// As [`ProjectionOptions::priority`].
    pub priority: Priority,
    /// As [`ProjectionOptions::engine`].
    pub engine: Engine,
    /// As [`Options::given`].
    pub given: Given<'a, 3>,
    /// As [`Options::cosine`].
    pub cosine: f64,
}

impl<'a> FlatOptions<'a> {
    /// A maximal set of this radius.
    pub fn new(radius: f64) -> Self {
        Self {
            radius,
            count: 0,
            order: Order::Any,
            quotient: DEFAULT_QUOTIENT,
            iterations: None,
            maximal: true,
            seed: 0,
            projectors: Projectors::default(),
            priority: Priority::default(),
            engine: Engine::default(),
            given: Given::default(),
            cosine: -1.0,
        }
    }

    /// The call that these options ask for. Refuses those that cannot be combined.
    pub(super) fn request(&self) -> Result<Request<'a>> {
        let &Self { radius, count, order, quotient, seed, given, cosine, maximal, .. } = self;
        let iterations = self.iterations;
        if count > 0 || order == Order::Progressive {
            self.check_levels()?;
            let options = if count > 0 { Options::by_count(count) } else { Options::new(radius) };
            let options = options.order(order).quotient(quotient).seed(seed).given(given).cosine(cosine);
            return Ok(Request::Levels(options.projected(iterations.is_none())));
        }
        if iterations == Some(0) && !maximal {
            // A C struct of zeros, filled without its _init, would be an empty set and a success.
            return Err(Error::invalid("iterations", "0 with maximal off makes no samples"));
        }
        Ok(Request::Project { options: self.projection(), iterations, maximal })
    }

    fn projection(&self) -> ProjectionOptions<'a> {
        let &Self { radius, seed, projectors, priority, engine, given, cosine, .. } = self;
        ProjectionOptions { radius, seed, projectors, priority, engine, given, cosine }
    }

    /// Refuses options that cannot be combined with a count or progressive order.
    fn check_levels(&self) -> Result<()> {
        let asked = if self.count > 0 { "count" } else { "progressive order" };
        if let Some(iterations @ 1..) = self.iterations {
            return Err(Error::invalid("iterations", format!("{iterations}; {asked} requires iterations = 0")));
        }
        if !self.maximal {
            return Err(Error::invalid("maximal", format!("is off; {asked} requires a maximal set")));
        }
        if self.count > 0 && self.radius != 0.0 {
            let (count, radius) = (self.count, self.radius);
            return Err(Error::invalid("count", format!("{count} with radius {radius}; give one of the two")));
        }
        Ok(())
    }
}

setters!(FlatOptions<'a> {
    count: usize,
    order: Order,
    quotient: f64,
    iterations: Option<u32>,
    maximal: bool,
    seed: u64,
    projectors: Projectors,
    priority: Priority,
    engine: Engine,
    given: Given<'a, 3>,
    cosine: f64,
});

/// The calls of flat options.
pub(super) enum Request<'a> {
    /// [`sample`](super::sample), of a count or in progressive order.
    Levels(Options<'a>),
    /// [`project`](super::project), or where no iterations are given the rule of `sample`.
    Project { options: ProjectionOptions<'a>, iterations: Option<u32>, maximal: bool },
}

/// The options of [`sample_classes`](super::sample_classes).
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct ClassOptions<'a> {
    /// Selects one of 2^64 sets.
    pub seed: u64,
    /// Existing samples. They keep each class's own radius clear, or have clearances row by row: for each sample one
    /// for each class.
    pub given: Given<'a, 3>,
    /// As in [`Options::cosine`].
    pub cosine: f64,
    /// The order of the samples of each class.
    pub order: Order,
    /// As in [`Options::quotient`].
    pub quotient: f64,
    /// The lengths of which the radii of the classes are multiples, if they vary over the surface: by a density, for example.
    /// Two samples keep the mean of their units. [`Scale::Count`](crate::psp::adaptive::Scale::Count) is about the
    /// number of samples that a class of radius 1 would have alone. Given samples then need clearances. `None`, the
    /// default: 1 everywhere.
    pub unit: Option<Radius<'a>>,
}

impl Default for ClassOptions<'_> {
    fn default() -> Self {
        let (given, order) = (Given::default(), Order::Any);
        Self { seed: 0, given, cosine: -1.0, order, quotient: DEFAULT_QUOTIENT, unit: None }
    }
}

setters!(ClassOptions<'a> {
    seed: u64,
    given: Given<'a, 3>,
    cosine: f64,
    order: Order,
    quotient: f64,
    unit: Option<Radius<'a>>,
});
