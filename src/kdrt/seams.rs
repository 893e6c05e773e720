//! The seams of a merge: the part of a domain that maximal pieces leave to be tested.
//!
//! A piece that covers its rectangle still does so where none of its samples is eliminated. A sample is eliminated only
//! by one closer than r that is not of its piece, or of its piece across the seam of a torus, and so only within r of
//! the edge of the rectangle or of a fixed point; what it alone covered is within 2r of there. A block of the fill that
//! lies deeper in a rectangle has no gap, and fills nothing: it is skipped. All others are filled with all that they
//! would see anyway, so that the new samples are the same.

use crate::kdrt::blocks::Blocks;
use crate::plane::{CellAxis, Lattice, Rect};
use crate::points::{Boundary, Domain};

/// The excess of the depth of a gap over twice the reach, in lattice units: four units at most are lost to given points
/// beside the lattice and to periods that are not whole.
const SLACK: i32 = 8;

/// The blocks that may have gaps.
pub struct Seams {
    counts: [i32; 2],
    /// True for each block that may have gaps, row by row.
    open: Vec<bool>,
}

impl Seams {
    /// The seams of maximal sets, given by the corners of their rectangles, and of fixed points, on the lattice with the
    /// radius of new samples.
    pub fn new(
        blocks: &Blocks,
        lattice: &Lattice,
        domain: &Domain,
        rectangles: impl Iterator<Item = [[f64; 2]; 2]>,
        fixed: &[[f32; 2]],
    ) -> Self {
        let counts = blocks.counts();
        let mut seams = Self { counts, open: vec![true; counts[0] as usize * counts[1] as usize] };
        let depth = 2 * lattice.separation.reach + SLACK;
        for [min, max] in rectangles {
            let held = lattice.points_in(&Domain { min, max, boundary: Boundary::Bounded });
            seams.set(&blocks.within(&held.grown(-depth)), false);
        }
        for &point in fixed {
            let [x, y] = lattice.nearest(domain, point);
            let near = Rect { min: [x, y], max: [x + 1, y + 1] }.grown(depth);
            let near = match lattice.boundary {
                Boundary::Periodic => near,
                Boundary::Bounded => near.intersection(&lattice.rect()),
            };
            seams.set(&blocks.holding(&near), true);
        }
        seams
    }

    fn set(&mut self, blocks: &Rect, is_open: bool) {
        for row in blocks.min[1]..blocks.max[1] {
            for column in blocks.min[0]..blocks.max[0] {
                let index = self.index([column, row]);
                self.open[index] = is_open;
            }
        }
    }

    /// The index of a block, or of one of which it is an image.
    fn index(&self, block: [i32; 2]) -> usize {
        let [column, row] = [0, 1].map(|axis: usize| block[axis].rem_euclid(self.counts[axis]) as usize);
        row * self.counts[0] as usize + column
    }

    /// True if a block may have gaps.
    pub fn may_have_gaps(&self, block: [i32; 2]) -> bool {
        self.open[self.index(block)]
    }

    /// For each cell, row by row, whether its points can matter to a block that may have gaps: whether it meets the
    /// square of twice the reach around one. A cell is less than a reach wide.
    pub fn cells(&self, blocks: &Blocks, lattice: &Lattice, axes: &[CellAxis; 2]) -> Vec<bool> {
        let [columns, rows] = axes.each_ref().map(|axis| axis.count() as usize);
        let mut near = vec![false; columns * rows];
        for row in 0..self.counts[1] {
            let mut column = 0;
            while column < self.counts[0] {
                let run =
                    (column..self.counts[0]).take_while(|&column| self.may_have_gaps([column, row])).count() as i32;
                let rect = blocks.rect(&Rect { min: [column, row], max: [column + run, row + 1] });
                column += run + 1;
                if run == 0 {
                    continue;
                }
                for (_, part) in lattice.parts(&rect.grown(2 * lattice.separation.reach)) {
                    let [across, up] = [0, 1].map(|axis: usize| {
                        let [first, last] = [part.min[axis], part.max[axis] - 1];
                        axes[axis].cell(first) as usize..axes[axis].cell(last) as usize + 1
                    });
                    up.for_each(|row| near[row * columns..][across.clone()].fill(true));
                }
            }
        }
        near
    }
}
