//! The variants of PSP that are compared.

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::{self, Options, Priority};
use azulejo::{Context, Result, SurfaceSamples};

/// How a set is made.
#[derive(Clone, Copy, PartialEq)]
pub struct Variant {
    pub priority: Priority,
    pub iterations: u32,
    pub maximal: bool,
}

impl Variant {
    /// Only filled: darts into what is uncovered.
    pub const REFERENCE: Self = Self { priority: Priority::Squareness, iterations: 0, maximal: true };

    /// The variants of the comparison of the priorities.
    pub const COMPARED: [Self; 6] = [
        Self::REFERENCE,
        Self::iterated(Priority::Squareness, 1, true),
        Self::iterated(Priority::Projector, 1, true),
        Self::iterated(Priority::Squareness, 1, false),
        Self::iterated(Priority::Projector, 1, false),
        Self::iterated(Priority::Projector, 20, false),
    ];

    pub const fn iterated(priority: Priority, iterations: u32, maximal: bool) -> Self {
        Self { priority, iterations, maximal }
    }

    pub fn name(self) -> String {
        if self.iterations == 0 {
            return "reference (fill only)".to_owned();
        }
        let plural = if self.iterations == 1 { "" } else { "s" };
        let fill = if self.maximal { ", fill" } else { "" };
        format!("{}, {} iteration{plural}{fill}", priority_name(self.priority), self.iterations)
    }

    pub fn sample(self, context: &Context, mesh: &Arc<Mesh>, radius: f64, seed: u64) -> Result<SurfaceSamples> {
        let Self { priority, iterations, maximal } = self;
        let options = Options::new(radius).priority(priority).iterations(iterations).maximal(maximal).seed(seed);
        Ok(psp::sample(context, mesh, &options, None)?.0)
    }
}

pub fn priority_name(priority: Priority) -> &'static str {
    match priority {
        Priority::Squareness => "squareness",
        Priority::Projector => "projector",
    }
}
