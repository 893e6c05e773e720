//! The variants of PSP that are compared.

use std::ops::Range;
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::{self, Priority, ProjectionOptions, Projectors};
use azulejo::{Context, Points, Result};

/// Up to about so many samples a set can be filled in one piece, also on a square: what the library expects, which is
/// rather too many, is just below its limit (`scenes::in_one_piece`).
pub const ONE_PIECE: f64 = 24_200.0;

/// A variant of the sampler.
#[derive(Clone, Copy, PartialEq)]
pub struct Variant {
    pub priority: Priority,
    pub iterations: u32,
    pub maximal: bool,
    /// True if sets are so small that they are filled in one piece.
    pub is_one_piece: bool,
}

impl Variant {
    /// Only filled: darts into what is uncovered.
    pub const FILLED: Self = Self::iterated(Priority::Squareness, 0, true);

    /// The same in one piece, which is unbiased.
    pub const REFERENCE: Self = Self { is_one_piece: true, ..Self::FILLED };

    /// The variants of the comparison of the priorities.
    pub const COMPARED: [Self; 7] = [
        Self::REFERENCE,
        Self::FILLED,
        Self::iterated(Priority::Squareness, 1, true),
        Self::iterated(Priority::Projector, 1, true),
        Self::iterated(Priority::Squareness, 1, false),
        Self::iterated(Priority::Projector, 1, false),
        Self::iterated(Priority::Projector, 20, false),
    ];

    pub const fn iterated(priority: Priority, iterations: u32, maximal: bool) -> Self {
        Self { priority, iterations, maximal, is_one_piece: false }
    }

    pub fn name(self) -> String {
        if self.iterations == 0 {
            return if self.is_one_piece { "filled in one piece (reference)" } else { "filled cube by cube" }
                .to_owned();
        }
        let plural = if self.iterations == 1 { "" } else { "s" };
        let fill = if self.maximal { ", fill" } else { "" };
        format!("{}, {} iteration{plural}{fill}", priority_name(self.priority), self.iterations)
    }

    /// About how many samples its sets have where those of others have `count`.
    pub fn count(self, count: f64) -> f64 {
        if self.is_one_piece { count.min(ONE_PIECE) } else { count }
    }

    /// The seeds of its sets where there are `sets` of others: the reference has seeds of its own, and more of them.
    pub fn seeds(self, sets: u64) -> Range<u64> {
        if self.is_one_piece { 1000..1000 + 4 * sets } else { 0..sets }
    }

    pub fn sample(self, context: &Context, mesh: &Arc<Mesh>, radius: f64, seed: u64) -> Result<Points<3>> {
        let Self { priority, iterations, maximal, .. } = self;
        let options = ProjectionOptions::new(radius).projectors(Projectors::Global).priority(priority).seed(seed);
        Ok(psp::project(context, mesh, &options, iterations, maximal, None)?.0)
    }
}

pub fn priority_name(priority: Priority) -> &'static str {
    match priority {
        Priority::Squareness => "squareness",
        Priority::Projector => "projector",
    }
}
