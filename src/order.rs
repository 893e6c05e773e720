//! The order of a set.

use crate::math::log2;

/// The order of the points of a set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// Whatever is fastest.
    #[default]
    Any,
    /// Coarse to fine: the first points are a well-spread set as well, whatever their number. Each point has a rank, a
    /// distance; ranks never rise, and the points up to any of them are at least its rank apart.
    Progressive,
}

impl Order {
    /// Prefixes of a progressive set with at least this many samples cover within the quotient of its options times
    /// their last rank; smaller ones within twice the last rank, or the square of the quotient times it if that is
    /// more.
    pub const FIRST_COUNT: usize = 100;
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
