//! What to sample, and how.

use crate::error::{Error, Result};
use crate::given::Given;
use crate::order::Order;
use crate::setters::setters;
use crate::trace::HAS_EMBREE;

/// Which of an iteration's candidates comes first where two of them are too close. Existing samples come before all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Priority {
    /// That which its projector faces more squarely: there the pattern is stretched less. Finds more samples.
    #[default]
    Squareness,
    /// That of the projector with the lower number (thesis §3.3.2).
    Projector,
}

/// What finds the hits of the projectors. Both find the same ones, up to rounding: points and edges move against each
/// other by up to 2e-7 of the mesh's diagonal, as their projector sees them. A point that near to an edge may fall on
/// the other side, and barycentrics differ by up to this over the height of their triangle.
///
/// The default is Embree, where a build has it ([`HAS_EMBREE`](crate::trace::HAS_EMBREE)).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    /// Packets of rays through the hierarchy of Embree: it takes the longer the more rays there are.
    Embree,
    /// Triangles drawn over the pattern in exact integer arithmetic (thesis §3.4.3): it takes the longer the more
    /// triangles there are. A point on an edge that triangles share hits one of them on either side, never none or
    /// both.
    Rasteriser,
}

impl Engine {
    /// Those that this build has.
    pub const AVAILABLE: &[Self] = if HAS_EMBREE { &[Self::Embree, Self::Rasteriser] } else { &[Self::Rasteriser] };
}

impl Default for Engine {
    fn default() -> Self {
        Self::AVAILABLE[0]
    }
}

/// [`Options::quotient`] by default: 2^(1/8).
pub const DEFAULT_QUOTIENT: f64 = 1.090_507_732_665_257_7;

/// What to sample.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options<'a> {
    /// The smallest distance of two samples, in the units of the mesh; positive and finite, or 0 where there is a count.
    pub radius: f64,
    /// How many samples there are to be, exactly: the radius is found, and [`Report::radius`](super::Report::radius)
    /// says it. 0, the default: as many as the radius gives. Used by [`sample`](super::sample) only.
    pub count: usize,
    /// The order of the samples; by default any. Used by [`sample`](super::sample) only.
    pub order: Order,
    /// In progressive order, the largest ratio of the covering radius of the first samples to their rank, from
    /// [`Order::FIRST_COUNT`] samples on: 1.02 to 1.5, by default 2^(1/8). For fewer it is up to two, or the square of
    /// this if that is more. The smaller, the more levels, each of which takes time.
    pub quotient: f64,
    /// Iterations of three projectors each, 0 and up; `None`, the default, goes by the rule of
    /// [`Options::iterations_by_rule`]. Where no more than 25,000 samples are expected, on the area and along edges longer
    /// than the radius, a set that is only filled is filled in one piece and is unbiased; a larger one is filled cube by
    /// cube and holds up to about 0.8 % more samples than unbiased darts give, at the seams of the cubes. Used by
    /// [`sample`](super::sample) only.
    pub iterations: Option<u32>,
    /// Whether to fill what the projectors leave uncovered. Used by [`sample`](super::sample) only.
    pub maximal: bool,
    /// Selects one of 2^64 sets.
    pub seed: u64,
    /// Which candidates come first.
    pub priority: Priority,
    /// What finds the hits.
    pub engine: Engine,
    /// Samples that stand already: new ones keep their clearances, and cover what is farther than that from all of
    /// them. They are not among the samples that are returned.
    pub given: Given<'a, 3>,
    /// Samples on triangles whose normals have a smaller cosine ignore each other, and so do samples and uncovered
    /// surface: the sides of a thin wall are sampled as if they were far apart. From -1, which is off, to 1, where only
    /// samples with the same normal see each other. The triangles must be wound consistently. Given samples have no
    /// normal: they act on all sides. Not with iterations.
    pub cosine: f64,
}

impl Options<'_> {
    /// A maximal set.
    pub fn new(radius: f64) -> Self {
        Self {
            radius,
            count: 0,
            order: Order::Any,
            quotient: DEFAULT_QUOTIENT,
            iterations: None,
            maximal: true,
            seed: 0,
            priority: Priority::default(),
            engine: Engine::default(),
            given: Given::default(),
            cosine: -1.0,
        }
    }

    /// A set of so many samples.
    pub fn by_count(count: usize) -> Self {
        Self { count, ..Self::new(0.0) }
    }

    /// These options without the samples that are given.
    pub(super) fn without_given(&self) -> Options<'static> {
        let &Self { radius, count, order, quotient, iterations, maximal, seed, priority, engine, given: _, cosine } =
            self;
        let given = Given::default();
        Options { radius, count, order, quotient, iterations, maximal, seed, priority, engine, given, cosine }
    }
}

impl Options<'_> {
    /// These options with another [`iterations`](Self::iterations): a number, or `None`.
    #[must_use]
    pub fn iterations(mut self, iterations: impl Into<Option<u32>>) -> Self {
        self.iterations = iterations.into();
        self
    }

    /// How many iterations [`sample`](super::sample) makes: as many as asked for, and otherwise by a rule. A maximal
    /// set is only filled, on every mesh and with every radius: that is sooner done than an iteration and a fill
    /// of the rest, and no direction is preferred. A set that is not filled gets one iteration.
    pub fn iterations_by_rule(&self) -> u32 {
        self.iterations.unwrap_or(if self.maximal { 0 } else { 1 })
    }

    /// Whether the set is made level by level: its number of samples or their order is asked for.
    pub(super) fn has_levels(&self) -> bool {
        self.count > 0 || self.order == Order::Progressive
    }

    /// Refuses what does not go with levels.
    pub(super) fn check_levels(&self) -> Result<()> {
        let asked = if self.count > 0 { "a count" } else { "progressive order" };
        if self.iterations_by_rule() != 0 {
            let reason = format!("{} are asked for; {asked} is had by filling alone", self.iterations_by_rule());
            return Err(Error::invalid("iterations", reason));
        }
        if !self.maximal {
            return Err(Error::invalid("maximal", format!("is off; {asked} is had by filling alone")));
        }
        if self.count > 0 && self.radius != 0.0 {
            let (count, radius) = (self.count, self.radius);
            return Err(Error::invalid("count", format!("{count} samples and radius {radius} are asked for at once")));
        }
        if self.count > u32::MAX as usize {
            return Err(Error::too_large("count", format!("{}; the limit is {}", self.count, u32::MAX)));
        }
        if self.order == Order::Progressive {
            check_quotient(self.quotient)?;
        }
        Ok(())
    }
}

/// Refuses a quotient that is out of range.
pub(super) fn check_quotient(quotient: f64) -> Result<()> {
    if (1.02..=1.5).contains(&quotient) {
        return Ok(());
    }
    Err(Error::invalid("quotient", format!("{quotient} is not between 1.02 and 1.5")))
}

setters!(Options<'a> {
    radius: f64,
    count: usize,
    order: Order,
    quotient: f64,
    maximal: bool,
    seed: u64,
    priority: Priority,
    engine: Engine,
    given: Given<'a, 3>,
    cosine: f64,
});
