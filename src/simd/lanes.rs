//! Sixteen floats or integers at a time, or eight of twice the size, with whatever instructions the processor has.
//!
//! Code is written once, over a [`Lanes`], and compiled for each level. All operations are those of IEEE 754, none is
//! contracted and sums have a fixed order, so that every level computes the same bits.

/// The number of lanes, of floats and integers of 32 bits.
pub const LANES: usize = 16;

/// The number of lanes of doubles and of integers of 64 bits.
pub const HALF: usize = LANES / 2;

/// A position as the three floats that are returned for a sample, and a fourth that is not used: one vector load.
pub type Position = [f32; 4];

/// A level of vector instructions. Its value is the proof that the processor has them.
pub trait Lanes: Copy {
    /// Sixteen floats.
    type Floats: Copy;
    /// Sixteen integers.
    type Ints: Copy;
    /// Eight doubles.
    type Doubles: Copy;
    /// Eight integers of 64 bits.
    type Longs: Copy;
    /// Sixteen truth values.
    type Mask: Copy;

    /// True if [`Lanes::permute`] is one instruction.
    const PERMUTES: bool;

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
    fn abs(self, x: Self::Floats) -> Self::Floats;
    /// The mask of the lanes where `a` is less than `b`; false for NaN.
    fn less(self, a: Self::Floats, b: Self::Floats) -> Self::Mask;
    /// The mask of the lanes where `a` is at most `b`; false for NaN.
    fn at_most(self, a: Self::Floats, b: Self::Floats) -> Self::Mask;
    /// `x` where the mask is set, else 0.
    fn only(self, mask: Self::Mask, x: Self::Floats) -> Self::Floats;
    /// `a` where the mask is set, else `b`.
    fn select(self, mask: Self::Mask, a: Self::Floats, b: Self::Floats) -> Self::Floats;
    /// The lanes that are set in both masks.
    fn both(self, a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// The lanes of `x` with these numbers.
    fn permute(self, x: Self::Floats, numbers: &[i32; LANES]) -> Self::Floats;
    /// The mask as bits, lane 0 the lowest.
    fn bits(self, mask: Self::Mask) -> u32;
    /// The sum of all lanes: `k` and `k + 8` are added, of these `k` and `k + 4`, and so on.
    fn sum(self, x: Self::Floats) -> f32;
    /// The least of all, in the order of [`Lanes::sum`].
    fn least(self, x: Self::Floats) -> f32;
    /// The coordinates of the positions with the indices `named`.
    ///
    /// # Panics
    /// Panics if an index is out of range.
    fn gather(self, positions: &[Position], named: &[u32; LANES]) -> [Self::Floats; 3];

    fn splat_int(self, x: i32) -> Self::Ints;
    fn load_ints(self, from: &[i32; LANES]) -> Self::Ints;
    /// Loads eight integers into each half.
    fn load_halves(self, from: [&[i32; HALF]; 2]) -> Self::Ints;
    /// The sums of integers, which wrap around.
    fn add_ints(self, a: Self::Ints, b: Self::Ints) -> Self::Ints;
    fn sub_ints(self, a: Self::Ints, b: Self::Ints) -> Self::Ints;
    fn mul_ints(self, a: Self::Ints, b: Self::Ints) -> Self::Ints;
    fn min_ints(self, a: Self::Ints, b: Self::Ints) -> Self::Ints;
    /// The bits that are set in both.
    fn and_ints(self, a: Self::Ints, b: Self::Ints) -> Self::Ints;
    /// The mask of the lanes where `a` is less than `b`.
    fn less_ints(self, a: Self::Ints, b: Self::Ints) -> Self::Mask;
    /// The nearest floats.
    fn floats(self, x: Self::Ints) -> Self::Floats;
    /// The bits of floats.
    fn float_bits(self, x: Self::Floats) -> Self::Ints;
    /// Stores the integers where the mask is set side by side; the lanes after them are not specified.
    fn compress_ints(self, mask: Self::Mask, x: Self::Ints, to: &mut [i32; LANES]);
    /// Stores the floats where the mask is set side by side, and `rest` after them.
    fn compress(self, mask: Self::Mask, x: Self::Floats, rest: f32, to: &mut [f32; LANES]);

    fn splat_double(self, x: f64) -> Self::Doubles;
    fn load_doubles(self, from: &[f64; HALF]) -> Self::Doubles;
    fn add_doubles(self, a: Self::Doubles, b: Self::Doubles) -> Self::Doubles;
    fn mul_doubles(self, a: Self::Doubles, b: Self::Doubles) -> Self::Doubles;
    /// The nearest floats in the lower eight lanes; those in the others are not specified.
    fn narrow(self, x: Self::Doubles) -> Self::Floats;

    /// The lower eight integers, zero-extended.
    fn widen(self, x: Self::Ints) -> Self::Longs;
    fn store_longs(self, x: Self::Longs, to: &mut [u64; HALF]);
    /// The bits that are set in either.
    fn or_longs(self, a: Self::Longs, b: Self::Longs) -> Self::Longs;
    /// The integers times 2 to the power of `by`, below 64.
    fn shift_longs(self, x: Self::Longs, by: u32) -> Self::Longs;
    /// A bit for each that equals `to`, lane 0 the lowest.
    fn equal_longs(self, x: Self::Longs, to: u64) -> u8;
}
