//! A Z-curve through the bounds of a mesh: what is close on the surface is mostly close along it.

use crate::dcr::surface::walk::SurfacePoint;
use crate::mesh::{Mesh, exact};

/// Bits of the curve per axis.
pub(super) const BITS: u32 = 21;

/// The places of points along the curve, in order, with the points' numbers.
pub(super) fn along_curve(mesh: &Mesh, points: &[SurfacePoint]) -> Vec<(u64, u32)> {
    let (low, high) = mesh.bounds();
    let extent = (exact(high) - exact(low)).max_element().max(f64::MIN_POSITIVE);
    let last = f64::from((1u32 << BITS) - 1);
    let along = |point: &SurfacePoint| {
        let place = (point.position(mesh) - exact(low)) / extent * last;
        place.to_array().iter().rev().fold(0, |code, &x| code << 1 | spread_bits(x as u64))
    };
    let mut sorted: Vec<(u64, u32)> = points.iter().map(along).zip(0..).collect();
    sorted.sort_unstable();
    sorted
}

/// The bits of a number of [`BITS`], two zeros after each.
fn spread_bits(x: u64) -> u64 {
    let masks = [
        (32, 0x001f_0000_0000_ffff),
        (16, 0x001f_0000_ff00_00ff),
        (8, 0x100f_00f0_0f00_f00f),
        (4, 0x10c3_0c30_c30c_30c3),
        (2, 0x1249_2492_4924_9249u64),
    ];
    masks.into_iter().fold(x, |x, (shift, mask)| (x | x << shift) & mask)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_spread() {
        for x in [0, 1, 0b101, 0x1f_ffff, 0x12_3456] {
            let expected = (0..BITS).fold(0, |code, bit| code | (x >> bit & 1) << (3 * bit));
            assert_eq!(spread_bits(x), expected);
        }
    }
}
