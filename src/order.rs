//! The order of a set, and the ratio of the levels of a progressive one.

use std::ops::RangeInclusive;

use crate::error::{Error, Result};
use crate::math::log2;

/// The quotient of the levels of a progressive order that balances speed and spread, 2^(1/8).
pub const DEFAULT_QUOTIENT: f64 = 1.090_507_732_665_257_7;

/// The quotients that a progressive order may have.
pub const QUOTIENTS: RangeInclusive<f64> = 1.02..=1.5;

/// The order of the points of a set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// The fastest order.
    #[default]
    Any,
    /// Coarse to fine: every prefix is a well-spread set, too. Each point has a rank, a distance; ranks never rise, and
    /// the points up to any of them are at least its rank apart.
    Progressive,
}

impl Order {
    /// Prefixes of a progressive set with at least this many samples cover within the quotient of its options times
    /// their last rank; smaller ones within twice the last rank, or the square of the quotient times it if that is
    /// more.
    pub const FIRST_COUNT: usize = 100;
}

/// Refuses a quotient that is out of range.
pub fn check_quotient(quotient: f64) -> Result<()> {
    if QUOTIENTS.contains(&quotient) {
        return Ok(());
    }
    let (least, most) = (QUOTIENTS.start(), QUOTIENTS.end());
    Err(Error::invalid("quotient", format!("{quotient:?} is not in {least} to {most}")))
}

/// The number of steps of a quotient between the first levels of a progressive order: down to a half, at least two.
///
/// One sample of a torus leaves the largest gap at the centre of its period, two leave them half way between each
/// other, and so on. Levels that add a few samples each, or double them as those of √2 do, put them in such places,
/// and all that follow inherit a lattice along the axes: 12 decibels of anisotropy were measured.
pub(crate) fn first_stride(quotient: f64) -> u32 {
    // The logarithm of a root of two is rounded.
    ((log2(quotient).recip() + 1e-9) as u32).max(2)
}
