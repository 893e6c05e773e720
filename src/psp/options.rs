//! What to sample, and how.

use crate::setters::setters;

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
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Engine {
    /// Packets of rays through the hierarchy of Embree: it takes the longer the more rays there are.
    #[default]
    Embree,
    /// Triangles drawn over the pattern in exact integer arithmetic (thesis §3.4.3): it takes the longer the more
    /// triangles there are. A point on an edge that triangles share hits one of them on either side, never none or
    /// both.
    Rasteriser,
}

/// What to sample.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The smallest distance of two samples, in the units of the mesh; positive and finite.
    pub radius: f64,
    /// Iterations of three projectors each, 0 and up; `None`, the default, goes by the rule of
    /// [`Options::iterations_by_rule`]. Used by [`sample`](super::sample) only.
    pub iterations: Option<u32>,
    /// Whether to fill what the projectors leave uncovered. Used by [`sample`](super::sample) only.
    pub maximal: bool,
    /// Selects one of 2^64 sets.
    pub seed: u64,
    /// Which candidates come first.
    pub priority: Priority,
    /// What finds the hits.
    pub engine: Engine,
}

impl Options {
    /// A maximal set.
    pub fn new(radius: f64) -> Self {
        Self {
            radius,
            iterations: None,
            maximal: true,
            seed: 0,
            priority: Priority::default(),
            engine: Engine::default(),
        }
    }
}

impl Options {
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
}

setters!(Options { radius: f64, maximal: bool, seed: u64, priority: Priority, engine: Engine });
