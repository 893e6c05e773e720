//! Sixteen floats at a time, whatever the processor has for it.
//!
//! Code is written once, over a [`Lanes`], and compiled for each level. All operations are those of IEEE 754, none is
//! contracted and sums have one order, so that every level computes the same bits.

/// The number of floats.
pub const LANES: usize = 16;

/// A position in the floats in which samples are returned, and a fourth that is not used: one load in vectors.
pub type Position = [f32; 4];

/// A level of vector instructions. Its value is the proof that the processor has them.
pub trait Lanes: Copy {
    /// Sixteen floats.
    type Floats: Copy;
    /// Sixteen truth values.
    type Mask: Copy;

    fn splat(self, x: f32) -> Self::Floats;
    fn load(self, from: &[f32; LANES]) -> Self::Floats;
    fn store(self, x: Self::Floats, to: &mut [f32; LANES]);
    fn add(self, a: Self::Floats, b: Self::Floats) -> Self::Floats;
    fn sub(self, a: Self::Floats, b: Self::Floats) -> Self::Floats;
    fn mul(self, a: Self::Floats, b: Self::Floats) -> Self::Floats;
    fn div(self, a: Self::Floats, b: Self::Floats) -> Self::Floats;
    fn sqrt(self, x: Self::Floats) -> Self::Floats;
    /// `a` where it is less than `b`, else `b`.
    fn min(self, a: Self::Floats, b: Self::Floats) -> Self::Floats;
    /// `a` where it is more than `b`, else `b`.
    fn max(self, a: Self::Floats, b: Self::Floats) -> Self::Floats;
    /// Where `a` is less than `b`; nowhere for NaN.
    fn less(self, a: Self::Floats, b: Self::Floats) -> Self::Mask;
    /// `x` where the mask is, else 0.
    fn only(self, mask: Self::Mask, x: Self::Floats) -> Self::Floats;
    /// `a` where the mask is, else `b`.
    fn select(self, mask: Self::Mask, a: Self::Floats, b: Self::Floats) -> Self::Floats;
    /// The mask as bits, lane 0 the lowest.
    fn bits(self, mask: Self::Mask) -> u32;
    /// Lanes `k` and `k + 8` are added, of these `k` and `k + 4`, and so on.
    fn sum(self, x: Self::Floats) -> f32;
    /// The least of all, in the order of [`Lanes::sum`].
    fn least(self, x: Self::Floats) -> f32;
    /// The coordinates of those of the positions that are named.
    ///
    /// # Panics
    /// Where a position is named that there is not.
    fn gather(self, positions: &[Position], named: &[u32; LANES]) -> [Self::Floats; 3];
}
