//! Conquer, second half (thesis §2.3.3): the gaps that elimination leaves are filled.
//!
//! Departure: the thesis puts a sample at a circumcentre in each gap, again and again, and so prefers the middle of
//! gaps; here a gap is filled by a flat quadtree, uniformly on what is uncovered and until nothing is. Its first level
//! is a bitmap (`bitmap.rs`), in which nearly all gaps are found and closed.

use crate::plane::{CellGrid, List, Quadtree, darts};
use crate::rng::Rng;

use crate::kdrt::bitmap::{Bitmap, VoxelIndex};
use crate::kdrt::blocks::Block;
use crate::kdrt::conquer::SeamCells;
use crate::kdrt::stamp::Stamps;

/// The filling of the blocks of a window, one after the other.
pub struct Filling<'a> {
    stamps: &'a Stamps,
    seams: SeamCells,
    /// The largest distance along an axis at which samples conflict.
    reach: i32,
    quadtree: Quadtree,
    /// The memory of the samples around a block.
    near: List,
    /// The memory of its open voxels.
    open: Vec<VoxelIndex>,
}

impl<'a> Filling<'a> {
    pub fn new(stamps: &'a Stamps, seams: SeamCells, reach: i32) -> Self {
        Self { stamps, seams, reach, quadtree: Quadtree::empty(), near: List::default(), open: Vec::new() }
    }

    /// [`Filling::fill`] in any vectors.
    #[inline(always)]
    pub fn fill_portable(
        &mut self,
        grid: &mut CellGrid,
        block: &Block,
        rng: impl Fn() -> Rng,
        accepted: &mut impl FnMut(&CellGrid, [i32; 2]),
    ) {
        let Some(marked) = self.seams.marked_in(&block.cells) else { return };
        let mut rng = rng();
        let mut bitmap = Bitmap::of_seams(self.stamps, grid, &self.seams, block);
        let around = grid.points_of(&marked).grown(self.reach);
        grid.collect(&marked, &around, &mut self.near);
        bitmap.stamp_all(&self.near);
        bitmap.list(&marked, &mut self.open);
        if grid.has_obstacles() {
            self.open.retain(|&place| {
                let (cell, voxel) = bitmap.voxel(grid, place);
                !grid.is_hidden(cell, &voxel)
            });
        }

        let width = Bitmap::widest(grid);
        self.throw(grid, &mut bitmap, width, &mut rng, accepted);
        if self.open.is_empty() {
            return;
        }
        self.quadtree.restart_cut(grid, width);
        for &place in &self.open {
            let (cell, voxel) = bitmap.voxel(grid, place);
            self.quadtree.add_sixteenths(grid, &self.near, cell, voxel);
        }
        self.quadtree.fill(grid, &mut rng, accepted);
    }

    /// The darts of the first level: at voxels of the bitmap, picked from the open ones.
    #[inline(always)]
    fn throw(
        &mut self,
        grid: &mut CellGrid,
        bitmap: &mut Bitmap,
        width: i32,
        rng: &mut Rng,
        accepted: &mut impl FnMut(&CellGrid, [i32; 2]),
    ) {
        let mut misses = darts(self.open.len());
        while misses > 0 {
            misses -= 1;
            let pick = rng.below(self.open.len() as u64) as usize;
            let (cell, rect) = bitmap.voxel(grid, self.open[pick]);
            if let Some(sample) = grid.throw_among(&mut self.near, cell, &rect, width, rng) {
                bitmap.stamp(sample);
                accepted(grid, sample);
                bitmap.keep_open(&mut self.open);
                misses = darts(self.open.len());
            }
        }
    }
}
