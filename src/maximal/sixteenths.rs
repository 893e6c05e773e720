//! The coarse coverage test of a voxel's sixteen parts at once, in `f32` and in a form that compilers vectorise.
//!
//! It drops only what is certainly covered; what it keeps is looked at again by the exact test of `cells.rs`.

/// The share of the squared radius that rounding can add up to, and some more: coordinates are below 5 radii, and each
/// of a handful of operations is off by at most 2^-24 of its result.
const SLACK: f32 = 1e-5;

/// Four by four voxels: bit `4·row + column` of the result says that this one is not empty and no single sample of
/// `near` certainly covers all of its lattice points.
///
/// On each axis voxel `i` has the points from `borders[i]` to before `borders[i + 1]`. Points whose squared distance is
/// below `threshold` conflict.
pub(super) fn uncovered(borders: &[[i32; 5]; 2], near: &[[i32; 2]], threshold: i64) -> u16 {
    // The distance to the farthest point along an axis is the distance to the centre and half the extent.
    let (mut centres, mut extents) = ([[0.0; 16]; 2], [[0.0; 16]; 2]);
    for (axis, borders) in borders.iter().enumerate() {
        for i in 0..16 {
            let part = if axis == 0 { i % 4 } else { i / 4 };
            let (first, last) = ((borders[part] - borders[0]) as f32, (borders[part + 1] - 1 - borders[0]) as f32);
            centres[axis][i] = 0.5 * (first + last);
            extents[axis][i] = 0.5 * (last - first);
        }
    }
    let mut nearest = [f32::MAX; 16];
    for sample in near {
        let (x, y) = ((sample[0] - borders[0][0]) as f32, (sample[1] - borders[1][0]) as f32);
        for i in 0..16 {
            let dx = (x - centres[0][i]).abs() + extents[0][i];
            let dy = (y - centres[1][i]).abs() + extents[1][i];
            let d2 = dx * dx + dy * dy;
            nearest[i] = if d2 < nearest[i] { d2 } else { nearest[i] };
        }
    }
    let limit = threshold as f32 * (1.0 - SLACK);
    let mut open = 0;
    for i in 0..16 {
        // An empty voxel, cut off by a clip, has an extent below zero.
        let is_open = nearest[i] >= limit && extents[0][i] >= 0.0 && extents[1][i] >= 0.0;
        open |= u16::from(is_open) << i;
    }
    open
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::array::from_fn;

    use crate::rng::{Draw, Rng};

    /// Against the exact distances to the four corners of every voxel: what is certainly uncovered is kept, and what is
    /// covered with some room is dropped.
    #[test]
    fn it_says_what_exact_distances_say_except_at_the_very_border() {
        let mut rng = Rng::at(0, Draw::Probe, &[]);
        let mut dropped = 0;
        for radius in [64, 1000, 1 << 16, 1 << 26] {
            for _ in 0..2000 {
                let borders: [[i32; 5]; 2] = from_fn(|_| {
                    let (first, side) = (rng.below(1000) as i32 - 500, rng.below(radius as u64 * 7 / 10) as i32 + 4);
                    from_fn(|i| first + (i64::from(side) * i as i64 / 4) as i32)
                });
                let near: [[i32; 2]; 5] = from_fn(|_| {
                    from_fn(|axis| borders[axis][2] + rng.below(3 * radius as u64) as i32 - 3 * radius / 2)
                });
                let threshold = i64::from(radius).pow(2);
                let open = uncovered(&borders, &near, threshold);
                for (column, row) in (0..4).flat_map(|row| (0..4).map(move |column| (column, row))) {
                    let farthest = |sample: &[i32; 2]| -> i64 {
                        let along = |axis: usize, i: usize| {
                            let ends = [borders[axis][i], borders[axis][i + 1] - 1];
                            ends.map(|end| i64::from(end - sample[axis]).pow(2)).into_iter().max().unwrap()
                        };
                        along(0, column) + along(1, row)
                    };
                    let nearest = near.iter().map(farthest).min().unwrap();
                    let is_open = open >> (4 * row + column) & 1 == 1;
                    assert!(is_open || nearest < threshold);
                    assert!(!is_open || nearest as f64 > threshold as f64 * (1.0 - 2e-5));
                    dropped += u32::from(!is_open);
                }
            }
        }
        assert!(dropped > 10_000);
    }
}
