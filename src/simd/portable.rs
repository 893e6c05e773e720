//! [`Lanes`] without vector instructions, for every processor: arrays, of which compilers make vectors where they can.

use crate::simd::lanes::{HALF, LANES, Lanes, Position};

/// The level that every processor has.
#[derive(Clone, Copy)]
pub struct Portable;

#[inline(always)]
fn each<T: Copy + Default, const N: usize>(of: impl Fn(usize) -> T) -> [T; N] {
    let mut lanes = [T::default(); N];
    let mut k = 0;
    while k < N {
        lanes[k] = of(k);
        k += 1;
    }
    lanes
}

#[inline(always)]
fn folded(mut x: [f32; LANES], two: impl Fn(f32, f32) -> f32) -> f32 {
    let mut half = LANES / 2;
    while half > 0 {
        let mut k = 0;
        while k < half {
            x[k] = two(x[k], x[k + half]);
            k += 1;
        }
        half /= 2;
    }
    x[0]
}

/// Stores the lanes that are set in the mask side by side, and returns their number.
#[inline(always)]
fn compressed<T: Copy>(mask: [u32; LANES], x: [T; LANES], to: &mut [T; LANES]) -> usize {
    let (mut count, mut k) = (0, 0);
    while k < LANES {
        // Stored always, and counted only if it is set in the mask: which lanes are is not predictable.
        to[count] = x[k];
        count += (mask[k] & 1) as usize;
        k += 1;
    }
    count
}

impl Lanes for Portable {
    type Floats = [f32; LANES];
    type Ints = [i32; LANES];
    type Doubles = [f64; HALF];
    type Longs = [u64; HALF];
    /// All bits of a lane, or none.
    type Mask = [u32; LANES];

    const PERMUTES: bool = false;

    #[inline(always)]
    fn splat(self, x: f32) -> [f32; LANES] {
        [x; LANES]
    }
    #[inline(always)]
    fn load(self, from: &[f32; LANES]) -> [f32; LANES] {
        *from
    }
    #[inline(always)]
    fn store(self, x: [f32; LANES], to: &mut [f32; LANES]) {
        *to = x;
    }
    #[inline(always)]
    fn add(self, a: [f32; LANES], b: [f32; LANES]) -> [f32; LANES] {
        each(|k| a[k] + b[k])
    }
    #[inline(always)]
    fn sub(self, a: [f32; LANES], b: [f32; LANES]) -> [f32; LANES] {
        each(|k| a[k] - b[k])
    }
    #[inline(always)]
    fn mul(self, a: [f32; LANES], b: [f32; LANES]) -> [f32; LANES] {
        each(|k| a[k] * b[k])
    }
    #[inline(always)]
    fn div(self, a: [f32; LANES], b: [f32; LANES]) -> [f32; LANES] {
        each(|k| a[k] / b[k])
    }
    #[inline(always)]
    fn sqrt(self, x: [f32; LANES]) -> [f32; LANES] {
        each(|k| x[k].sqrt())
    }
    #[inline(always)]
    fn min(self, a: [f32; LANES], b: [f32; LANES]) -> [f32; LANES] {
        each(|k| if a[k] < b[k] { a[k] } else { b[k] })
    }
    #[inline(always)]
    fn max(self, a: [f32; LANES], b: [f32; LANES]) -> [f32; LANES] {
        each(|k| if a[k] > b[k] { a[k] } else { b[k] })
    }
    #[inline(always)]
    fn abs(self, x: [f32; LANES]) -> [f32; LANES] {
        each(|k| x[k].abs())
    }
    #[inline(always)]
    fn less(self, a: [f32; LANES], b: [f32; LANES]) -> [u32; LANES] {
        each(|k| if a[k] < b[k] { u32::MAX } else { 0 })
    }
    #[inline(always)]
    fn at_most(self, a: [f32; LANES], b: [f32; LANES]) -> [u32; LANES] {
        each(|k| if a[k] <= b[k] { u32::MAX } else { 0 })
    }
    #[inline(always)]
    fn only(self, mask: [u32; LANES], x: [f32; LANES]) -> [f32; LANES] {
        each(|k| f32::from_bits(mask[k] & x[k].to_bits()))
    }
    #[inline(always)]
    fn select(self, mask: [u32; LANES], a: [f32; LANES], b: [f32; LANES]) -> [f32; LANES] {
        each(|k| f32::from_bits((mask[k] & a[k].to_bits()) | (!mask[k] & b[k].to_bits())))
    }
    #[inline(always)]
    fn both(self, a: [u32; LANES], b: [u32; LANES]) -> [u32; LANES] {
        each(|k| a[k] & b[k])
    }
    #[inline(always)]
    fn permute(self, x: [f32; LANES], numbers: &[i32; LANES]) -> [f32; LANES] {
        each(|k| x[numbers[k] as usize % LANES])
    }
    #[inline(always)]
    fn bits(self, mask: [u32; LANES]) -> u32 {
        let mut bits = 0;
        let mut k = 0;
        while k < LANES {
            bits |= mask[k] & (1 << k);
            k += 1;
        }
        bits
    }
    #[inline(always)]
    fn sum(self, x: [f32; LANES]) -> f32 {
        folded(x, |a, b| a + b)
    }
    #[inline(always)]
    fn least(self, x: [f32; LANES]) -> f32 {
        folded(x, |a, b| if a < b { a } else { b })
    }
    #[inline(always)]
    fn gather(self, positions: &[Position], named: &[u32; LANES]) -> [[f32; LANES]; 3] {
        let mut gathered = [[0.0; LANES]; 3];
        let mut k = 0;
        while k < LANES {
            let [x, y, z, _] = positions[named[k] as usize];
            (gathered[0][k], gathered[1][k], gathered[2][k]) = (x, y, z);
            k += 1;
        }
        gathered
    }

    #[inline(always)]
    fn splat_int(self, x: i32) -> [i32; LANES] {
        [x; LANES]
    }
    #[inline(always)]
    fn load_ints(self, from: &[i32; LANES]) -> [i32; LANES] {
        *from
    }
    #[inline(always)]
    fn load_halves(self, from: [&[i32; HALF]; 2]) -> [i32; LANES] {
        each(|k| from[k / HALF][k % HALF])
    }
    #[inline(always)]
    fn add_ints(self, a: [i32; LANES], b: [i32; LANES]) -> [i32; LANES] {
        each(|k| a[k].wrapping_add(b[k]))
    }
    #[inline(always)]
    fn sub_ints(self, a: [i32; LANES], b: [i32; LANES]) -> [i32; LANES] {
        each(|k| a[k].wrapping_sub(b[k]))
    }
    #[inline(always)]
    fn mul_ints(self, a: [i32; LANES], b: [i32; LANES]) -> [i32; LANES] {
        each(|k| a[k].wrapping_mul(b[k]))
    }
    #[inline(always)]
    fn min_ints(self, a: [i32; LANES], b: [i32; LANES]) -> [i32; LANES] {
        each(|k| a[k].min(b[k]))
    }
    #[inline(always)]
    fn and_ints(self, a: [i32; LANES], b: [i32; LANES]) -> [i32; LANES] {
        each(|k| a[k] & b[k])
    }
    #[inline(always)]
    fn less_ints(self, a: [i32; LANES], b: [i32; LANES]) -> [u32; LANES] {
        each(|k| if a[k] < b[k] { u32::MAX } else { 0 })
    }
    #[inline(always)]
    fn floats(self, x: [i32; LANES]) -> [f32; LANES] {
        each(|k| x[k] as f32)
    }
    #[inline(always)]
    fn float_bits(self, x: [f32; LANES]) -> [i32; LANES] {
        each(|k| x[k].to_bits().cast_signed())
    }
    #[inline(always)]
    fn compress_ints(self, mask: [u32; LANES], x: [i32; LANES], to: &mut [i32; LANES]) {
        compressed(mask, x, to);
    }
    #[inline(always)]
    fn compress(self, mask: [u32; LANES], x: [f32; LANES], rest: f32, to: &mut [f32; LANES]) {
        let count = compressed(mask, x, to);
        to[count..].fill(rest);
    }

    #[inline(always)]
    fn splat_double(self, x: f64) -> [f64; HALF] {
        [x; HALF]
    }
    #[inline(always)]
    fn load_doubles(self, from: &[f64; HALF]) -> [f64; HALF] {
        *from
    }
    #[inline(always)]
    fn add_doubles(self, a: [f64; HALF], b: [f64; HALF]) -> [f64; HALF] {
        each(|k| a[k] + b[k])
    }
    #[inline(always)]
    fn mul_doubles(self, a: [f64; HALF], b: [f64; HALF]) -> [f64; HALF] {
        each(|k| a[k] * b[k])
    }
    #[inline(always)]
    fn narrow(self, x: [f64; HALF]) -> [f32; LANES] {
        each(|k| x[k % HALF] as f32)
    }

    #[inline(always)]
    fn widen(self, x: [i32; LANES]) -> [u64; HALF] {
        each(|k| u64::from(x[k].cast_unsigned()))
    }
    #[inline(always)]
    fn store_longs(self, x: [u64; HALF], to: &mut [u64; HALF]) {
        *to = x;
    }
    #[inline(always)]
    fn or_longs(self, a: [u64; HALF], b: [u64; HALF]) -> [u64; HALF] {
        each(|k| a[k] | b[k])
    }
    #[inline(always)]
    fn shift_longs(self, x: [u64; HALF], by: u32) -> [u64; HALF] {
        each(|k| x[k] << by)
    }
    #[inline(always)]
    fn equal_longs(self, x: [u64; HALF], to: u64) -> u8 {
        (0..HALF).fold(0, |bits, k| bits | u8::from(x[k] == to) << k)
    }
}
