//! What is near a place of the grid: the coarse tests, in `f32`, that nearly all work of the plane goes through.
//!
//! They say what is certain; what they leave open is decided in integers by `cells.rs`. The code here is plain and
//! portable. [`Vectors`](super::vectors::Vectors) picks, once for a grid, the same functions in the widest vectors of the processor (`vectors.rs`),
//! whose results are the same to the bit: no sum has another order, no rounding is left out.

use crate::lattice::Rect;

/// The share of the squared radius that rounding can add up to, and some more: coordinates are below 5 radii, and each
/// of a handful of operations is off by at most 2^-24 of its result.
pub(super) const SLACK: f32 = 1e-5;

/// The cells of a row that are read together: at least as many as conflicts can reach over.
pub(super) const LANES: usize = 8;

/// At most 13 samples cover something of a cell (Oler's inequality for points r apart that lie at most r from a square of
/// side r / sqrt(2)), a few more where a torus is so narrow that images of one sample do. Any more are left out.
pub(super) const MOST_NEAR: usize = 16;

/// A coordinate of no sample. Its square is a float.
pub(super) const FAR: f32 = 1e18;

/// The rows of cells around a place in which samples can conflict with its points. What lies in a row beyond the reach
/// of conflicts is read too; it is what it is, and cannot conflict. The place of a cell without sample is far away.
pub(super) struct Rows<'a> {
    /// The x and the y of the samples of all cells.
    pub samples: [&'a [i32]; 2],
    /// Where the first row begins.
    pub first: usize,
    /// From one row to the next.
    pub stride: usize,
    /// How many rows.
    pub count: usize,
}

impl<'a> Rows<'a> {
    /// The x and the y of each row.
    pub fn iter(&self) -> impl Iterator<Item = [&'a [i32; LANES]; 2]> {
        (0..self.count).map(|row| {
            let start = self.first + row * self.stride;
            self.samples.map(|samples| samples[start..start + LANES].try_into().expect("eight cells"))
        })
    }

    /// The squared distance from a point to the nearest sample of the rows.
    pub fn nearest(&self, point: [i32; 2]) -> f32 {
        let mut nearest = [f32::MAX; LANES];
        for [xs, ys] in self.iter() {
            for lane in 0..LANES {
                let (dx, dy) = ((xs[lane] - point[0]) as f32, (ys[lane] - point[1]) as f32);
                nearest[lane] = nearest[lane].min(dx * dx + dy * dy);
            }
        }
        nearest.into_iter().fold(f32::MAX, f32::min)
    }
}

/// The samples that cover something of a cell, as seen from its corner.
pub(super) struct Near {
    pub origin: [i32; 2],
    /// The first `count` are samples; the eight after them are [`FAR`], so that a few can be tested whether they are there
    /// or not. How many there are is not predictable.
    pub x: [f32; MOST_NEAR + LANES],
    pub y: [f32; MOST_NEAR + LANES],
    pub count: usize,
    /// Squared distances below it are certainly below the threshold.
    pub limit: f32,
}

impl Near {
    /// Memory for what is near a cell.
    pub fn new() -> Self {
        Self { origin: [0; 2], x: [FAR; MOST_NEAR + LANES], y: [FAR; MOST_NEAR + LANES], count: 0, limit: 0.0 }
    }

    /// Adds the samples of the rows that are closer than the square root of `threshold` to the lattice points of `cell`.
    pub fn gather(&mut self, rows: &Rows, cell: &Rect, threshold: f32) {
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
