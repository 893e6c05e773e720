//! What to sample.

use crate::given::Given;
use crate::order::Order;
use crate::psp::adaptive::radius::Radius;
use crate::psp::options::DEFAULT_QUOTIENT;
use crate::setters::setters;

/// What to sample.
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct Options<'a> {
    /// The radius on the surface. Radii larger than four times the diagonal of the mesh's box are taken as that, those of
    /// vertices before they are interpolated.
    pub radius: Radius<'a>,
    /// Samples on triangles whose normals have a smaller cosine ignore each other, and so do samples and uncovered
    /// surface: the sides of a thin wall are sampled as if they were far apart. From -1, which is off, to 1, where only
    /// samples with the same normal see each other. The triangles must be wound consistently.
    pub cosine: f64,
    /// Selects one of 2^64 sets.
    pub seed: u64,
    /// Samples that stand already, each with its clearance: there is no radius that could stand for it. They act on all
    /// sides of a thin wall.
    pub given: Given<'a, 3>,
    /// The order of the samples; by default any.
    pub order: Order,
    /// In progressive order, the largest ratio of the covering radius of the first samples to their rank: see
    /// [`psp::Options::quotient`](crate::psp::Options::quotient).
    pub quotient: f64,
}

impl<'a> Options<'a> {
    /// No sample ignores others; any order.
    pub fn new(radius: Radius<'a>) -> Self {
        let given = Given::default();
        Self { radius, cosine: -1.0, seed: 0, given, order: Order::Any, quotient: DEFAULT_QUOTIENT }
    }
}

setters!(Options<'a> { cosine: f64, seed: u64, given: Given<'a, 3>, order: Order, quotient: f64 });
