//! Conquer, second half (thesis §2.3.3): the gaps that elimination leaves are filled.
//!
//! Departure: the thesis puts a sample at a circumcentre in each gap, again and again, and so prefers the middle of
//! gaps; here a gap is filled by the flat quadtree, uniformly on what is uncovered and until nothing is.

use crate::lattice::Rect;
use crate::maximal::{CellGrid, Quadtree};
use crate::rng::Rng;

use super::conquer::SeamCells;

/// Gaps are small: voxels are cut to a quarter of a cell's side before the first dart is thrown.
const FIRST_LEVEL: u32 = 2;

/// Makes the samples of the grid maximal in `block`, a rectangle of lattice points.
pub(super) fn fill(grid: &mut CellGrid, seams: &SeamCells, block: &Rect, mut rng: Rng) {
    let mut quadtree = Quadtree::new(grid, *block, empty_cells(grid, seams, block));
    for _ in 0..FIRST_LEVEL {
        quadtree.refine(grid);
    }
    while !quadtree.is_empty() {
        quadtree.throw(grid, &mut rng, quadtree.len());
        quadtree.refine(grid);
    }
}

/// The cells of a block that can have gaps: those without a sample near a seam.
fn empty_cells(grid: &CellGrid, seams: &SeamCells, block: &Rect) -> Vec<[i32; 2]> {
    let cells = grid.cells_of(block);
    (cells.min[1]..cells.max[1])
        .flat_map(|y| (cells.min[0]..cells.max[0]).map(move |x| [x, y]))
        .filter(|&cell| seams.contains(cell) && grid.sample(cell).is_none())
        .collect()
}
