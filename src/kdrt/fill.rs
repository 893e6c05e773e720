//! Conquer, second half (thesis §2.3.3): the gaps that elimination leaves are filled.
//!
//! Departure: the thesis puts a sample at a circumcentre in each gap, again and again, and so prefers the middle of
//! gaps; here a gap is filled by the flat quadtree, uniformly on what is uncovered and until nothing is.

use crate::lattice::Rect;
use crate::maximal::{CellGrid, Quadtree};
use crate::rng::Rng;

use super::conquer::SeamCells;
use super::output::Output;

const DARTS: (usize, usize) = (1, 2);

/// Makes the samples of the grid maximal in `block`, a rectangle of lattice points, and gives the new ones to `output`.
/// `quadtree` is the memory for the work.
pub(super) fn fill(
    grid: &mut CellGrid,
    quadtree: &mut Quadtree,
    seams: &SeamCells,
    block: &Rect,
    mut rng: Rng,
    output: &mut Output,
) {
    quadtree.restart(*block, grid);
    let cells = grid.cells_of(block);
    for y in cells.min[1]..cells.max[1] {
        for cell in seams.in_row(y, cells.min[0], cells.max[0]) {
            if grid.sample(cell).is_none() {
                quadtree.push_gaps(grid, cell);
            }
        }
    }
    while !quadtree.is_empty() {
        for _ in 0..(quadtree.len() * DARTS.0).div_ceil(DARTS.1) {
            if quadtree.is_empty() {
                break;
            }
            if let Some(sample) = quadtree.throw(grid, &mut rng) {
                quadtree.prune(grid, sample);
                output.push(sample);
            }
        }
        quadtree.refine(grid);
    }
}
