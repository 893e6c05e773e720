//! What to sample, and how.

use crate::setters::setters;

/// The number of iterations after which a maximal set is finished soonest: what the projectors do not find is filled.
/// (10^9 cycles to the end, a million samples, for 0, 1, 2, 3: 12.5, 6.8, 8.9, 11.0 on the bunny, 15.8, 11.1, 14.2, 17.2 on
/// the dragon, of which 1 and 5 are those of loading it.)
pub const DEFAULT_ITERATIONS: u32 = 1;

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
    /// Triangles drawn over the pattern in exact integer arithmetic (thesis §3.4.3): it takes the longer the more triangles
    /// there are. A point on an edge that triangles share hits one of them on either side, never none or both.
    Rasteriser,
}

/// What to sample.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The smallest distance of two samples, in the units of the mesh; positive and finite.
    pub radius: f64,
    /// Iterations of three projectors each, 0 and up. Used by [`sample`](super::sample) only.
    pub iterations: u32,
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
    /// A maximal set, by the default number of iterations.
    pub fn new(radius: f64) -> Self {
        Self {
            radius,
            iterations: DEFAULT_ITERATIONS,
            maximal: true,
            seed: 0,
            priority: Priority::default(),
            engine: Engine::default(),
        }
    }
}

setters!(Options { radius: f64, iterations: u32, maximal: bool, seed: u64, priority: Priority, engine: Engine });
