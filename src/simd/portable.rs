//! [`Lanes`] without vector instructions, for every processor: arrays, of which compilers make vectors where they can.

use crate::simd::lanes::{LANES, Lanes, Position};

/// The level that every processor has.
#[derive(Clone, Copy)]
pub struct Portable;

#[inline(always)]
fn each(of: impl Fn(usize) -> f32) -> [f32; LANES] {
    let mut lanes = [0.0; LANES];
    let mut k = 0;
    while k < LANES {
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

impl Lanes for Portable {
    type Floats = [f32; LANES];
    /// All bits of a lane, or none.
    type Mask = [u32; LANES];

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
    fn less(self, a: [f32; LANES], b: [f32; LANES]) -> [u32; LANES] {
        let mut mask = [0; LANES];
        let mut k = 0;
        while k < LANES {
            mask[k] = if a[k] < b[k] { u32::MAX } else { 0 };
            k += 1;
        }
        mask
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
}
