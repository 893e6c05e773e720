//! Conquer, first half (thesis §2.3.3): where clips meet, conflicts are eliminated.
//!
//! Departure: which point of a conflict goes does not depend on the order of work. Leaves are ranked by hash, and a
//! point survives if and only if no *surviving* point of a leaf of higher rank conflicts with it. Going through the
//! leaves by rank, a point that conflicts with nothing inserted before it survives and is never taken back.
//!
//! # How far away a decision can come from
//! Whether p0 survives depends on the points p1 in conflict with it, of higher rank, whether these do on p2, and so
//! on: a chain whose leaves rise in rank, so that all differ. A chain of five points lies in a square of side 4·reach,
//! which is less than 6 radii, the shortest side of a leaf. On each axis a leaf that meets this square is longer than
//! the square, so it holds one of the two ends of the square's side; it thus holds a corner of the square. Leaves are
//! disjoint, so there are at most four of them and no chain of five points. (A leaf as long as a bounded domain holds
//! the square's side as far as there is one.) Chains end after three hops: knowing all points within 3·reach of p0 is
//! enough.

use crate::lattice::Rect;
use crate::maximal::CellGrid;

use super::clip::Pattern;
use super::divide::Leaf;

/// How many radii (in lattice units: reaches) around a region decide which points survive in it.
pub(super) const LONGEST_CHAIN: i32 = 3;

/// Clips the leaves, which are sorted by falling rank, and inserts what survives in `window`, the grid's rectangle.
pub(super) fn merge(grid: &mut CellGrid, pattern: &Pattern, leaves: &[Leaf], window: &Rect, reach: i32) {
    for leaf in leaves {
        // Deeper inside than this no other leaf's point conflicts.
        let inside = leaf.rect.grown(-reach);
        for point in pattern.clip(leaf, &leaf.rect.intersection(window)) {
            let cell = grid.cell(point);
            if inside.contains(point) || !grid.conflicts(cell, point) {
                grid.insert(cell, point);
            }
        }
    }
}

/// The cells of a window in which a lattice point may be uncovered after elimination.
///
/// In the pattern every point is covered, by a sample at most a reach away. If that is missing from the plane, it lay
/// outside the leaf or was eliminated within a reach of the leaf's border: the point is within two of it. This depends
/// on the leaves alone, so every window that holds a cell agrees on it.
pub(super) struct SeamCells {
    width: i32,
    seam: Vec<bool>,
}

impl SeamCells {
    pub fn new(grid: &CellGrid, leaves: &[Leaf], reach: i32) -> Self {
        let [width, height] = grid.counts();
        let mut seam = vec![false; width as usize * height as usize];
        for leaf in leaves {
            let cells = grid.cells_of(&leaf.rect);
            // A cell that the border of the inner rectangle cuts is not inside of it.
            let inside = grid.cells_of(&leaf.rect.grown(-2 * reach)).grown(-1);
            for y in cells.min[1]..cells.max[1] {
                for x in cells.min[0]..cells.max[0] {
                    seam[(y * width + x) as usize] |= !inside.contains([x, y]);
                }
            }
        }
        Self { width, seam }
    }

    pub fn contains(&self, [x, y]: [i32; 2]) -> bool {
        self.seam[(y * self.width + x) as usize]
    }
}
