//! What to sample.

use std::ops::RangeInclusive;

use crate::error::{Error, Result};
use crate::given::Given;
use crate::order::Order;
use crate::points::{Boundary, Domain};
use crate::setters::setters;

/// The leaf size, in radii, that balances speed and spectrum.
pub const DEFAULT_LEAF_SIZE: f64 = 20.0;

/// The smallest leaf size, in radii: below it the seams of three leaves could act on each other.
pub const MIN_LEAF_SIZE: f64 = 6.0;

/// The quotient of the levels of a progressive order that balances speed and spread, 2^(1/8).
pub const DEFAULT_QUOTIENT: f64 = 1.090_507_732_665_257_7;

/// The quotients that a progressive order may have.
pub const QUOTIENTS: RangeInclusive<f64> = 1.02..=1.5;

/// What to sample.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options<'a> {
    /// The smallest centre-to-centre distance, above 0 and at least 64 float spacings at the domain's largest
    /// coordinate. It may exceed the domain: one sample is the result. Must be 0 where there are classes, which have
    /// radii of their own.
    pub radius: f64,
    /// Where to sample: any rectangle, also one thinner than the radius. On a torus whose period is below the radius
    /// a sample does not conflict with its own image.
    pub domain: Domain,
    /// The shortest side of a leaf, in radii: at least [`MIN_LEAF_SIZE`], usually [`DEFAULT_LEAF_SIZE`]. Sides are
    /// random, up to twice this. Larger is faster and less biased at the seams, and needs a larger pattern.
    pub leaf_size: f64,
    /// The same options and seed give the same samples.
    pub seed: u64,
    /// The order of the samples. In progressive order every prefix is well spread, and sets have ranks: see [`Ranked`].
    ///
    /// [`Ranked`]: super::Ranked
    pub order: Order,
    /// Of a progressive order: how many times longer the radius of each level is than that of the next, in
    /// [`QUOTIENTS`], usually [`DEFAULT_QUOTIENT`]. Every prefix of at least [`Order::FIRST_COUNT`] samples covers the
    /// domain within this times its last rank; smaller ones within twice that rank, or the square of the quotient times
    /// it if that is more. A window needs a margin of about 145 radii of each level at 2^(1/8), 75 at 2^(1/4) and 41 at
    /// 2^(1/2).
    pub quotient: f64,
    /// Of a progressive order: the radius of the coarsest level, at least `radius`; what is said of prefixes holds from
    /// its samples on. With infinity, the default, it is the smallest power of two times `radius` that reaches over the
    /// domain, so that it holds for every prefix. A shorter one saves work where windows are made of very large
    /// domains.
    ///
    /// Sets with the same coarsest radius share their levels. If `quotient` is a root of two, as the default is, and
    /// the radius of one is a power of two times that of another, then it is a prefix of it, bit for bit.
    pub coarsest: f64,
    /// Samples that stand already, anywhere in the plane; on a torus they wrap. New samples are at least the clearance
    /// of each from it, in `f64` from the floats, and every point of the domain is within the radius of a new sample or
    /// the clearance of a given one, up to 6 float spacings at the domain's largest coordinate. Given samples are not
    /// part of the result, and are compared with each other in no way.
    pub given: Given<'a, 2>,
}

impl Options<'_> {
    /// This radius on the unit torus, with leaves of [`DEFAULT_LEAF_SIZE`], seed 0, in any order and
    /// around nothing.
    pub fn new(radius: f64) -> Self {
        Self {
            radius,
            domain: Domain::unit(Boundary::Periodic),
            leaf_size: DEFAULT_LEAF_SIZE,
            seed: 0,
            order: Order::Any,
            quotient: DEFAULT_QUOTIENT,
            coarsest: f64::INFINITY,
            given: Given::default(),
        }
    }
}

setters!(Options<'a> {
    radius: f64,
    domain: Domain,
    leaf_size: f64,
    seed: u64,
    order: Order,
    quotient: f64,
    coarsest: f64,
    given: Given<'a, 2>,
});

/// Refuses what is no progressive order.
pub(super) fn check_ladder(quotient: f64, coarsest: f64, radius: f64) -> Result<()> {
    if !QUOTIENTS.contains(&quotient) {
        let (least, most) = (QUOTIENTS.start(), QUOTIENTS.end());
        return Err(Error::invalid("quotient", format!("{quotient:?} is not in {least} to {most}")));
    }
    if !(coarsest > 0.0 && coarsest >= radius) {
        return Err(Error::invalid("coarsest", format!("{coarsest:?} is not at least the radius {radius:?}")));
    }
    Ok(())
}

pub(super) fn check_leaf_size(leaf_size: f64) -> Result<()> {
    if leaf_size.is_finite() && leaf_size >= MIN_LEAF_SIZE {
        return Ok(());
    }
    let reason = format!("{leaf_size:?} is not a finite number of at least {MIN_LEAF_SIZE} (radii)");
    Err(Error::invalid("leaf_size", reason))
}
