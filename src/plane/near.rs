//! The samples near a cell of the grid: the coarse tests, in `f32`, that do nearly all work of the plane.
//!
//! They decide the certain cases; the others are decided in integers by `cells.rs`. All levels of
//! vector instructions give the same bits.

use crate::plane::rect::Rect;
use crate::plane::rows::{LANES, Rows};
use crate::simd::{Lanes, Work};

/// An upper bound of the total rounding error, as a share of the squared radius: coordinates are below 5 radii, and
/// each of a handful of operations is off by at most 2^-24 of its result.
pub const SLACK: f32 = 1e-5;

/// The capacity for samples near a cell. At most 13 cover a part of it (Oler's inequality for points r apart that lie
/// at most r from a square of side r / sqrt(2)), a few more where a torus is so narrow that images of one sample do.
/// Any more are left out.
pub const MOST_NEAR: usize = 16;

/// The number of samples near a cell that are always tested, whether they exist or not; rarely are there more.
const ALWAYS: usize = 4;

/// The coordinate of a missing sample. Its square is a finite float.
pub const FAR: f32 = 1e18;

/// The samples that cover a part of a cell, relative to its corner.
pub struct Near {
    pub origin: [i32; 2],
    /// The first `count` are samples; at least [`ALWAYS`] after them are [`FAR`], so that a few can be tested whether
    /// they exist or not: their number is not predictable. (Vectors of sixteen are written at any offset.)
    pub x: [f32; MOST_NEAR + 2 * LANES],
    pub y: [f32; MOST_NEAR + 2 * LANES],
    pub count: usize,
    /// Squared distances below it are certainly below the threshold.
    pub limit: f32,
}

impl Near {
    /// Memory for the samples near a cell.
    pub fn new() -> Self {
        Self { origin: [0; 2], x: [FAR; MOST_NEAR + 2 * LANES], y: [FAR; MOST_NEAR + 2 * LANES], count: 0, limit: 0.0 }
    }
}

/// Gathers the samples of the rows that are closer than the square root of `threshold` to the lattice points of `cell`.
pub(super) struct Gather<'a> {
    pub near: &'a mut Near,
    pub rows: &'a Rows<'a>,
    pub cell: Rect,
    pub threshold: f32,
}

impl Work for Gather<'_> {
    type Out = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Self { near, rows, cell, threshold } = self;
        (near.origin, near.count) = (cell.min, 0);
        let (zero, threshold) = (lanes.splat(0.0), lanes.splat(threshold));
        let origin = [lanes.splat_int(cell.min[0]), lanes.splat_int(cell.min[1])];
        let end = [lanes.splat((cell.length(0) - 1) as f32), lanes.splat((cell.length(1) - 1) as f32)];
        let mut row = 0;
        while row < rows.count {
            let [xs, ys] = rows.two(lanes, row);
            let x = lanes.floats(lanes.sub_ints(xs, origin[0]));
            let y = lanes.floats(lanes.sub_ints(ys, origin[1]));
            // To the nearest point of the cell.
            let dx = lanes.sub(x, lanes.min(lanes.max(x, zero), end[0]));
            let dy = lanes.sub(y, lanes.min(lanes.max(y, zero), end[1]));
            let covers = lanes.less(lanes.add(lanes.mul(dx, dx), lanes.mul(dy, dy)), threshold);
            let count = near.count;
            lanes.compress(covers, x, FAR, (&mut near.x[count..count + 2 * LANES]).try_into().expect("sixteen places"));
            lanes.compress(covers, y, FAR, (&mut near.y[count..count + 2 * LANES]).try_into().expect("sixteen places"));
            near.count = (near.count + lanes.bits(covers).count_ones() as usize).min(MOST_NEAR);
            row += 2;
        }
    }
}

/// The sixteenths of a voxel, four by four of the given width from its corner on: bit `4·row + column` of the result
/// says that this one is not empty and no single sample certainly covers all of its lattice points.
pub(super) struct Uncovered<'a> {
    pub near: &'a Near,
    pub voxel: &'a Rect,
    pub width: i32,
}

/// The column and the row of each sixteenth.
const SIXTEENTHS: [[i32; 16]; 2] =
    [[0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3], [0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3]];

impl Uncovered<'_> {
    /// The centres and half extents along an axis of the sixteenths.
    #[inline(always)]
    fn parts<L: Lanes>(&self, lanes: L, axis: usize) -> [L::Floats; 2] {
        let [min, max] = [self.voxel.min[axis] - self.near.origin[axis], self.voxel.max[axis] - self.near.origin[axis]];
        let width = lanes.splat_int(self.width);
        let before = lanes.mul_ints(lanes.load_ints(&SIXTEENTHS[axis]), width);
        let first = lanes.add_ints(lanes.splat_int(min), before);
        let end = lanes.min_ints(lanes.add_ints(first, width), lanes.splat_int(max));
        let (first, last) = (lanes.floats(first), lanes.floats(lanes.sub_ints(end, lanes.splat_int(1))));
        let half = lanes.splat(0.5);
        [lanes.mul(half, lanes.add(first, last)), lanes.mul(half, lanes.sub(last, first))]
    }
}

/// The squares of the distances along an axis from `x` to the farthest points of the sixteenths: the distance to the
/// centre and half the extent.
#[inline(always)]
fn farthest<L: Lanes>(lanes: L, x: f32, [centres, extents]: [L::Floats; 2]) -> L::Floats {
    let farthest = lanes.add(lanes.abs(lanes.sub(lanes.splat(x), centres)), extents);
    lanes.mul(farthest, farthest)
}

impl Work for Uncovered<'_> {
    type Out = u16;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> u16 {
        let (columns, rows) = (self.parts(lanes, 0), self.parts(lanes, 1));
        let mut nearest = lanes.splat(f32::MAX);
        let count = self.near.count.max(ALWAYS);
        for (&x, &y) in self.near.x[..count].iter().zip(&self.near.y[..count]) {
            nearest = lanes.min(nearest, lanes.add(farthest(lanes, x, columns), farthest(lanes, y, rows)));
        }
        let zero = lanes.splat(0.0);
        let is_far = lanes.at_most(lanes.splat(self.near.limit), nearest);
        // A part beyond the end of the voxel has an extent below zero.
        let is_part = lanes.both(lanes.at_most(zero, columns[1]), lanes.at_most(zero, rows[1]));
        lanes.bits(lanes.both(is_far, is_part)) as u16
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::array::from_fn;

    use crate::plane::list::{Collect, List};
    use crate::plane::rows::Nearest;
    use crate::rng::{Draw, Rng};
    use crate::simd::{Level, run};

    const RADII: [i32; 4] = [64, 1000, 1 << 16, 1 << 22];

    /// Five rows of cells with a sample in every third, and positions beyond them.
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

    /// Against exact distances: parts that are certainly uncovered are kept, parts covered with some margin are
    /// dropped.
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
                assert!(
                    (f64::from(run(Level::widest(), Nearest { rows: &rows(&samples), point })) / exact as f64 - 1.0)
                        .abs()
                        < 1e-6
                );

                let mut near = Near::new();
                near.limit = threshold as f32 * (1.0 - SLACK);
                run(
                    Level::widest(),
                    Gather { near: &mut near, rows: &rows(&samples), cell, threshold: threshold as f32 },
                );
                if near.count == MOST_NEAR {
                    continue; // Random points stand closer than samples do.
                }
                let (voxel, width) = random_voxel(&mut rng, side);
                let open = run(Level::widest(), Uncovered { near: &near, voxel: &voxel, width });
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

    /// No voxel is covered without a sample, nor by samples gathered before.
    #[test]
    fn where_no_sample_is_nothing_is_covered() {
        let cell = Rect { min: [0; 2], max: [500; 2] };
        let mut empty = List::default();
        empty.clear(0);
        empty.end();
        for level in Level::available() {
            let (mut near, limit) = (Near::new(), 1e6);
            near.limit = limit;
            let everywhere = [vec![250; 5 * LANES], vec![250; 5 * LANES]];
            run(level, Gather { near: &mut near, rows: &rows(&everywhere), cell, threshold: limit });
            assert_eq!(run(level, Uncovered { near: &near, voxel: &cell, width: 125 }), 0);
            run(level, Gather { near: &mut near, rows: &empty.rows(), cell, threshold: limit });
            assert_eq!(near.count, 0);
            assert_eq!(run(level, Uncovered { near: &near, voxel: &cell, width: 125 }), u16::MAX);
        }
    }

    #[test]
    fn all_vectors_give_the_same_bits() {
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        for level in Level::available() {
            for radius in RADII {
                let (threshold, side) = ((radius as f32).powi(2), radius / 2);
                let cell = Rect { min: [0; 2], max: [side, side - 3] };
                for _ in 0..2000 {
                    let samples = random_rows(&mut rng, radius);
                    let rows = rows(&samples);
                    let point = from_fn(|_| rng.below(2 * radius as u64) as i32 - radius);
                    let nearest = |level| run(level, Nearest { rows: &rows, point });
                    assert_eq!(nearest(level), nearest(Level::Portable));

                    let (voxel, width) = random_voxel(&mut rng, side);
                    let gather = |level| {
                        let mut near = Near::new();
                        near.limit = threshold;
                        run(level, Gather { near: &mut near, rows: &rows, cell, threshold });
                        let uncovered = run(level, Uncovered { near: &near, voxel: &voxel, width });
                        let filled = near.count.max(ALWAYS);
                        (near.count, near.x[..filled].to_vec(), near.y[..filled].to_vec(), uncovered)
                    };
                    assert_eq!(gather(level), gather(Level::Portable));

                    let rect = Rect { min: [-radius; 2], max: [point[0].max(0), radius] };
                    let (rows, width) = (Rows { count: 2, ..rows }, rng.below(20) as usize);
                    let cells = (0..2).flat_map(|row| row * LANES..row * LANES + width);
                    let all = cells.map(|cell| [samples[0][cell], samples[1][cell]]).filter(|&at| rect.contains(at));
                    let all: Vec<_> = all.collect();
                    let mut list = List::default();
                    list.clear(40);
                    run(level, Collect { rows: &rows, width, rect: &rect, list: &mut list });
                    let collected = list.x[..list.count].iter().zip(&list.y[..list.count]);
                    assert_eq!(collected.map(|(&x, &y)| [x, y]).collect::<Vec<_>>(), all);
                }
            }
        }
    }
}
