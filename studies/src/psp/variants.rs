//! The variants of PSP that are compared.

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::{self, Options, Order};
use azulejo::{Context, Result, SurfaceSamples};

/// How a set is made.
#[derive(Clone, Copy, PartialEq)]
pub struct Variant {
    pub order: Order,
    pub iterations: u32,
    pub maximal: bool,
}

impl Variant {
    /// Only filled: darts into what is uncovered.
    pub const REFERENCE: Self = Self { order: Order::Squareness, iterations: 0, maximal: true };

    /// Those of the comparison of the orders.
    pub const COMPARED: [Self; 6] = [
        Self::REFERENCE,
        Self::iterated(Order::Squareness, 1, true),
        Self::iterated(Order::Projector, 1, true),
        Self::iterated(Order::Squareness, 1, false),
        Self::iterated(Order::Projector, 1, false),
        Self::iterated(Order::Projector, 20, false),
    ];

    pub const fn iterated(order: Order, iterations: u32, maximal: bool) -> Self {
        Self { order, iterations, maximal }
    }

    pub fn name(self) -> String {
        if self.iterations == 0 {
            return "reference (fill only)".to_owned();
        }
        let plural = if self.iterations == 1 { "" } else { "s" };
        let fill = if self.maximal { ", fill" } else { "" };
        format!("{}, {} iteration{plural}{fill}", order_name(self.order), self.iterations)
    }

    pub fn sample(self, context: &Context, mesh: &Arc<Mesh>, radius: f64, seed: u64) -> Result<SurfaceSamples> {
        let Self { order, iterations, maximal } = self;
        let options = Options { order, iterations, maximal, seed, ..Options::new(radius) };
        Ok(psp::sample(context, mesh, &options, None)?.0)
    }
}

pub fn order_name(order: Order) -> &'static str {
    match order {
        Order::Squareness => "squareness",
        Order::Projector => "projector",
    }
}
