//! Conquer, second half (thesis §2.3.3): the gaps that elimination leaves are filled.
//!
//! Departure: the thesis puts a sample at a circumcentre in each gap, again and again, and so prefers the middle of
//! gaps; here a gap is filled by a flat quadtree, uniformly on what is uncovered and until nothing is. Its first level
//! is a bitmap (`bitmap.rs`), in which nearly all gaps are found and closed.

use crate::lattice::Rect;
use crate::maximal::{CellGrid, Quadtree, darts};
use crate::rng::Rng;

use super::bitmap::{Bitmap, Place};
use super::conquer::SeamCells;
use super::output::Output;
use super::stamp::Stamps;

/// A fill block: its lattice points, and the cells that hold them.
pub(super) struct Block {
    pub rect: Rect,
    pub cells: Rect,
}

/// The filling of the blocks of a window, one after the other.
pub(super) struct Filling<'a> {
    stamps: &'a Stamps,
    seams: SeamCells,
    /// The largest distance along an axis at which samples conflict.
    reach: i32,
    quadtree: Quadtree,
    /// The memory of the samples around a block.
    near: Vec<[i32; 2]>,
    /// The memory of its open voxels.
    open: Vec<Place>,
}

impl<'a> Filling<'a> {
    pub fn new(stamps: &'a Stamps, seams: SeamCells, reach: i32) -> Self {
        Self { stamps, seams, reach, quadtree: Quadtree::empty(), near: Vec::new(), open: Vec::new() }
    }

    /// Makes the samples of the grid maximal in `block` and gives the new ones to `output`.
    /// `rng` makes the random numbers of the block.
    pub fn fill(&mut self, grid: &mut CellGrid, block: &Block, rng: impl Fn() -> Rng, output: &mut Output) {
        let Some(marked) = self.seams.marked_in(&block.cells) else { return };
        let mut rng = rng();
        let mut bitmap = Bitmap::of_seams(self.stamps, grid, &self.seams, block);
        let around = grid.points_of(&marked).grown(self.reach);
        bitmap.stamp_all(grid.vectors(), grid.collect(&marked, &around, &mut self.near));
        bitmap.list(&mut self.open);

        let width = Bitmap::widest(grid);
        self.throw(grid, &mut bitmap, width, &mut rng, output);
        self.open.retain(|&place| bitmap.is_open(place));
        if self.open.is_empty() {
            return;
        }
        self.quadtree.restart(grid, width, self.open.iter().map(|&place| bitmap.voxel(grid, place)));
        self.quadtree.refine(grid);
        self.quadtree.fill(grid, &mut rng, |sample| output.push(sample));
    }

    /// The darts of the first level: at voxels of the bitmap, picked from the open ones.
    #[inline(always)]
    fn throw(&mut self, grid: &mut CellGrid, bitmap: &mut Bitmap, width: i32, rng: &mut Rng, output: &mut Output) {
        for _ in 0..darts(self.open.len()) {
            if self.open.is_empty() {
                break;
            }
            let pick = rng.below(self.open.len() as u64) as usize;
            let place = self.open[pick];
            if !bitmap.is_open(place) {
                self.open.swap_remove(pick);
                continue;
            }
            let (cell, rect) = bitmap.voxel(grid, place);
            if let Some(sample) = grid.throw(cell, &rect, width, rng) {
                bitmap.stamp(sample);
                output.push(sample);
            }
        }
    }
}
