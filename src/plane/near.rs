//! What is near a place of the grid: the coarse tests, in `f32`, that nearly all work of the plane goes through.
//!
//! They say what is certain; what they leave open is decided in integers by `cells.rs`. The code here is plain and
//! portable. [`Level`](crate::simd::Level) picks, once for a grid, the same functions in the widest vectors of the
//! processor, whose results are the same to the bit: no sum has another order, no rounding is left out.

use crate::plane::rect::Rect;

use crate::plane::rows::{LANES, Rows};

/// The share of the squared radius that rounding can add up to, and some more: coordinates are below 5 radii, and each
/// of a handful of operations is off by at most 2^-24 of its result.
pub const SLACK: f32 = 1e-5;

/// At most 13 samples cover something of a cell (Oler's inequality for points r apart that lie at most r from a square of
/// side r / sqrt(2)), a few more where a torus is so narrow that images of one sample do. Any more are left out.
pub const MOST_NEAR: usize = 16;

/// As many samples near a cell are tested whether they are there or not; seldom are there more.
#[cfg_attr(not(target_arch = "x86_64"), allow(dead_code))]
pub const ALWAYS: usize = 4;

/// A coordinate of no sample. Its square is a float.
pub const FAR: f32 = 1e18;

/// The samples that cover something of a cell, as seen from its corner.
pub struct Near {
    pub origin: [i32; 2],
    /// The first `count` are samples; [`ALWAYS`] and more after them are [`FAR`], so that a few can be tested whether they
    /// are there or not. How many there are is not predictable. (Vectors of sixteen are written from any place on.)
    pub x: [f32; MOST_NEAR + 2 * LANES],
    pub y: [f32; MOST_NEAR + 2 * LANES],
    pub count: usize,
    /// Squared distances below it are certainly below the threshold.
    pub limit: f32,
}

impl Near {
    /// Memory for what is near a cell.
    pub fn new() -> Self {
        Self { origin: [0; 2], x: [FAR; MOST_NEAR + 2 * LANES], y: [FAR; MOST_NEAR + 2 * LANES], count: 0, limit: 0.0 }
    }

    /// Takes the samples of the rows that are closer than the square root of `threshold` to the lattice points of `cell`.
    pub fn gather(&mut self, rows: &Rows, cell: Rect, threshold: f32) {
        (self.origin, self.count) = (cell.min, 0);
        let [width, height] = [0, 1].map(|axis| (cell.length(axis) - 1) as f32);
        for [xs, ys] in rows.iter() {
            for (x, y) in xs.iter().zip(ys) {
                let (x, y) = ((x - self.origin[0]) as f32, (y - self.origin[1]) as f32);
                // To the nearest point of the cell.
                let (dx, dy) = (x - x.max(0.0).min(width), y - y.max(0.0).min(height));
                if dx * dx + dy * dy < threshold && self.count < MOST_NEAR {
                    (self.x[self.count], self.y[self.count]) = (x, y);
                    self.count += 1;
                }
            }
        }
        self.x[self.count..self.count + LANES].fill(FAR);
        self.y[self.count..self.count + LANES].fill(FAR);
    }

    /// The sixteenths of a voxel, four by four of the given width from its corner on: bit `4·row + column` of the result
    /// says that this one is not empty and no single sample certainly covers all of its lattice points.
    pub fn uncovered(&self, voxel: &Rect, width: i32) -> u16 {
        let mut open = 0;
        for i in 0..16 {
            // The distance to the farthest point along an axis is the distance to the centre and half the extent.
            let (mut centre, mut extent) = ([0.0; 2], [0.0; 2]);
            for axis in 0..2 {
                let first = voxel.min[axis] - self.origin[axis] + [i % 4, i / 4][axis] * width;
                let last = (first + width).min(voxel.max[axis] - self.origin[axis]) - 1;
                centre[axis] = 0.5 * (first as f32 + last as f32);
                extent[axis] = 0.5 * (last as f32 - first as f32);
            }
            let farthest = |(x, y): (&f32, &f32)| {
                let (dx, dy) = ((x - centre[0]).abs() + extent[0], (y - centre[1]).abs() + extent[1]);
                dx * dx + dy * dy
            };
            let nearest = self.x[..self.count].iter().zip(&self.y[..self.count]).map(farthest).fold(f32::MAX, f32::min);
            // One beyond the end of the voxel has an extent below zero.
            let is_open = nearest >= self.limit && extent[0] >= 0.0 && extent[1] >= 0.0;
            open |= u16::from(is_open) << i;
        }
        open
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::array::from_fn;

    use crate::plane::list::List;
    use crate::rng::{Draw, Rng};
    use crate::simd::Level;

    const RADII: [i32; 4] = [64, 1000, 1 << 16, 1 << 22];

    /// Five rows of cells with a sample in every third, and somewhere beyond them.
    fn random_rows(rng: &mut Rng, radius: i32) -> [Vec<i32>; 2] {
        let mut rows = [vec![], vec![]];
        for _ in 0..5 * LANES {
            let is_sample = rng.below(3) == 0;
            for row in &mut rows {
                row.push(if is_sample { rng.below(6 * radius as u64) as i32 - 3 * radius } else { -(1 << 29) });
            }
        }
        rows
    }

    fn rows(samples: &[Vec<i32>; 2]) -> Rows<'_> {
        Rows { samples: [&samples[0], &samples[1]], first: 0, stride: LANES, count: 5 }
    }

    fn square([x, y]: [i32; 2]) -> i64 {
        i64::from(x).pow(2) + i64::from(y).pow(2)
    }

    /// A part of a cell at the origin, and the width of its sixteenths.
    fn random_voxel(rng: &mut Rng, cell: i32) -> (Rect, i32) {
        let min = from_fn(|_| rng.below(cell as u64) as i32);
        let max = from_fn(|axis| min[axis] + 1 + rng.below((cell - min[axis]) as u64) as i32);
        let width = (max[0] - min[0]).max(max[1] - min[1]) + rng.below(4) as i32;
        (Rect { min, max }, (width + 3) / 4)
    }

    /// Against exact distances: what is certainly uncovered is kept, what is covered with some margin is dropped.
    #[test]
    fn the_coarse_tests_say_what_exact_distances_say_except_at_the_very_border() {
        let mut rng = Rng::at(0, Draw::Probe, &[]);
        let mut dropped = 0;
        for radius in RADII {
            let (threshold, side) = (i64::from(radius).pow(2), radius / 2);
            let cell = Rect { min: [0; 2], max: [side; 2] };
            for _ in 0..2000 {
                let samples = random_rows(&mut rng, radius);
                let all: Vec<[i32; 2]> = (0..5 * LANES).map(|i| [samples[0][i], samples[1][i]]).collect();

                let point = from_fn(|_| rng.below(side as u64) as i32);
                let exact = all.iter().map(|&[x, y]| square([x - point[0], y - point[1]])).min().unwrap();
                assert!((f64::from(rows(&samples).nearest(point)) / exact as f64 - 1.0).abs() < 1e-6);

                let mut near = Near::new();
                near.limit = threshold as f32 * (1.0 - SLACK);
                near.gather(&rows(&samples), cell, threshold as f32);
                if near.count == MOST_NEAR {
                    continue; // Random points stand closer than samples do.
                }
                let (voxel, width) = random_voxel(&mut rng, side);
                let open = near.uncovered(&voxel, width);
                for (column, row) in (0..4).flat_map(|row| (0..4).map(move |column| (column, row))) {
                    let min = [voxel.min[0] + column * width, voxel.min[1] + row * width];
                    let part = Rect { min, max: min.map(|x| x + width) }.intersection(&voxel);
                    let is_open = open >> (4 * row + column) & 1 == 1;
                    if part.is_empty() {
                        assert!(!is_open);
                        continue;
                    }
                    let farthest = |&sample: &[i32; 2]| {
                        let along = |axis: usize| {
                            (sample[axis] - part.min[axis]).abs().max((part.max[axis] - 1 - sample[axis]).abs())
                        };
                        square([along(0), along(1)])
                    };
                    let nearest = all.iter().map(farthest).min().unwrap();
                    assert!(is_open || nearest < threshold);
                    assert!(!is_open || nearest as f64 > threshold as f64 * (1.0 - 3e-5));
                    dropped += u32::from(!is_open);
                }
            }
        }
        assert!(dropped > 10_000);
    }

    /// Also not what was gathered before.
    #[test]
    fn where_no_sample_is_nothing_is_covered() {
        let cell = Rect { min: [0; 2], max: [500; 2] };
        let mut empty = List::default();
        empty.clear(0);
        empty.end();
        for vectors in Level::available() {
            let (mut near, limit) = (Near::new(), 1e6);
            near.limit = limit;
            let everywhere = [vec![250; 5 * LANES], vec![250; 5 * LANES]];
            vectors.gather(&mut near, &rows(&everywhere), cell, limit);
            assert_eq!(vectors.uncovered(&near, &cell, 125), 0);
            vectors.gather(&mut near, &empty.rows(), cell, limit);
            assert_eq!((near.count, vectors.uncovered(&near, &cell, 125)), (0, u16::MAX));
        }
    }

    #[test]
    fn all_vectors_give_the_same_bits() {
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        for vectors in Level::available() {
            for radius in RADII {
                let (threshold, side) = ((radius as f32).powi(2), radius / 2);
                let cell = Rect { min: [0; 2], max: [side, side - 3] };
                for _ in 0..2000 {
                    let samples = random_rows(&mut rng, radius);
                    let rows = rows(&samples);
                    let point = from_fn(|_| rng.below(2 * radius as u64) as i32 - radius);
                    assert_eq!(vectors.nearest(&rows, point), rows.nearest(point));

                    let [mut found, mut expected] = [Near::new(), Near::new()];
                    (found.limit, expected.limit) = (threshold, threshold);
                    vectors.gather(&mut found, &rows, cell, threshold);
                    expected.gather(&rows, cell, threshold);
                    assert_eq!(found.count, expected.count);
                    let (voxel, width) = random_voxel(&mut rng, side);
                    assert_eq!(vectors.uncovered(&found, &voxel, width), expected.uncovered(&voxel, width));
                    let (count, filled) = (expected.count, expected.count.max(ALWAYS));
                    assert_eq!(found.x[..count], expected.x[..count]);
                    assert_eq!(found.y[..count], expected.y[..count]);
                    assert!(count == MOST_NEAR || found.x[count..filled].iter().all(|&x| x == FAR));

                    let rect = Rect { min: [-radius; 2], max: [point[0].max(0), radius] };
                    let (rows, width) = (Rows { count: 2, ..rows }, rng.below(20) as usize);
                    let [found, expected] = [vectors, Level::Portable].map(|vectors| {
                        let mut list = List::default();
                        list.clear(40);
                        vectors.collect(&rows, width, &rect, &mut list);
                        [list.x[..list.count].to_vec(), list.y[..list.count].to_vec()]
                    });
                    assert_eq!(found, expected);
                }
            }
        }
    }
}
