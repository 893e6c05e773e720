//! Conquer, first half (thesis §2.3.3): where clips meet, conflicts are eliminated.
//!
//! Departure: the point eliminated in a conflict does not depend on the order of work. Leaves are ranked by hash, and a
//! point survives if and only if no *surviving* point of a leaf of higher rank conflicts with it. Going through the
//! leaves by rank, a point that conflicts with nothing inserted before it survives and is never removed again.
//!
//! # The range of decisions
//! The survival of p0 depends on the points p1 of higher rank in conflict with it, theirs on points p2, and so on: a
//! chain whose leaves rise in rank, so that all differ. A chain of five points lies in a square of side 4·reach, which
//! is less than 6 radii, the shortest side of a leaf. On each axis a leaf that meets this square is longer than the
//! square, so it holds one of the two ends of the square's side; it thus holds a corner of the square. Leaves are
//! disjoint, so there are at most four of them and no chain of five points. (A leaf as long as a bounded domain holds
//! the square's side as far as there is one.) Chains end after three hops: knowing all points within 3·reach of p0 is
//! enough.

use crate::kdrt::{
    clip::{Pattern, Row},
    divide::Leaf,
};
use crate::plane::{CellGrid, Lattice, Rect};

/// The width in radii (in lattice units: reaches) of the surroundings of a region that decide which points survive in
/// it.
pub const LONGEST_CHAIN: i32 = 3;

/// The depth inside its leaf, per axis, from which on a point is in no test: gaps lie within 2 reaches of a boundary
/// (see [`SeamCells`]), in cells that may extend a cell farther, and conflicts with a point there reach one more.
pub fn seam_depth(grid: &CellGrid, reach: i32) -> i32 {
    3 * reach + grid.widest_cell()
}

/// Clips the leaves, which are sorted by falling rank. Points that survive in `window`, the grid's rectangle, go to
/// `output`, and into the grid if they are near a seam; those eliminated are returned.
pub fn merge(
    grid: &mut CellGrid,
    pattern: &Pattern,
    leaves: &[Leaf],
    window: &Rect,
    reach: i32,
    output: &mut Output,
) -> Vec<[i32; 2]> {
    let mut eliminated = Vec::new();
    let depth = seam_depth(grid, reach);
    for leaf in leaves {
        // Points removed by disks leave gaps anywhere.
        let deep = if grid.has_obstacles() { Rect { min: [0; 2], max: [0; 2] } } else { leaf.rect.grown(-depth) };
        // Deeper inside than this, no point of another leaf conflicts.
        let inside = leaf.rect.grown(-reach);
        let mut place = |row: &Row, output: &mut Output| {
            for point in row.points().filter(|&point| row.part.contains(point)) {
                if !deep.contains(point) {
                    let cell = grid.cell(point);
                    let conflicts =
                        if inside.contains(point) { grid.is_blocked(cell, point) } else { grid.conflicts(cell, point) };
                    if conflicts {
                        eliminated.push(point);
                        continue;
                    }
                    grid.insert(cell, point);
                }
                output.push(point);
            }
        };
        pattern.rows(leaf, &leaf.rect.intersection(window), |row| {
            if row.is_whole && deep.min[1] <= row.part.min[1] && row.part.max[1] <= deep.max[1] {
                let [left, middle, right] = row.split(deep.min[0], deep.max[0]);
                place(&left, output);
                output.copy(&middle);
                place(&right, output);
            } else {
                place(&row, output);
            }
        });
    }
    eliminated
}

/// The cells of a window in which a lattice point may be uncovered after elimination.
///
/// In the pattern every point is covered, by a sample at most a reach away. If that is missing from the plane, it lay
/// outside the leaf, so the point is within a reach of the leaf's boundary, or it was eliminated. Both are the same for
/// all windows that know the survivors around the cell, so they agree on it.
pub struct SeamCells {
    /// The number of words of a row of cells, each with a bit per cell, plus one.
    stride: usize,
    seam: Vec<u64>,
}

impl SeamCells {
    pub fn new(grid: &CellGrid, leaves: &[Leaf], eliminated: &[[i32; 2]], reach: i32) -> Self {
        let [width, height] = grid.counts();
        let stride = width as usize / 64 + 2;
        let mut cells = Self { stride, seam: vec![0; stride * height as usize] };
        for leaf in leaves {
            let all = grid.cells_of(&leaf.rect);
            // A cell cut by the boundary of the inner rectangle is not inside it.
            let inside = grid.cells_of(&leaf.rect.grown(-reach)).grown(-1);
            if inside.is_empty() {
                cells.mark(&all);
                continue;
            }
            cells.mark(&Rect { max: [all.max[0], inside.min[1]], ..all });
            cells.mark(&Rect { min: [all.min[0], inside.max[1]], ..all });
            cells.mark(&Rect { max: [inside.min[0], all.max[1]], ..all });
            cells.mark(&Rect { min: [inside.max[0], all.min[1]], ..all });
        }
        for &[x, y] in eliminated {
            let disk = Rect { min: [x, y], max: [x + 1, y + 1] }.grown(reach);
            cells.mark(&grid.cells_of(&disk));
        }
        cells.unmark_hidden(grid);
        cells
    }

    /// All cells of a window, where nothing is known about coverage.
    pub fn all(grid: &CellGrid) -> Self {
        let [width, height] = grid.counts();
        let stride = width as usize / 64 + 2;
        let mut cells = Self { stride, seam: vec![0; stride * height as usize] };
        cells.mark(&Rect { min: [0; 2], max: [width, height] });
        cells.unmark_hidden(grid);
        cells
    }

    /// Unmarks the cells that a disk covers.
    fn unmark_hidden(&mut self, grid: &CellGrid) {
        for [x, y] in grid.hidden_cells() {
            self.seam[y * self.stride + x / 64] &= !(1 << (x % 64));
        }
    }

    fn mark(&mut self, cells: &Rect) {
        let mut first = cells.min[0];
        while first < cells.max[0] {
            let (word, bit) = (first as usize / 64, first % 64);
            let count = (64 - bit).min(cells.max[0] - first);
            let bits = u64::MAX >> (64 - count) << bit;
            for y in cells.min[1]..cells.max[1] {
                self.seam[y as usize * self.stride + word] |= bits;
            }
            first += count;
        }
    }

    /// The bounding rectangle of the marked cells of a rectangle less than 64 cells wide, if there are any.
    pub fn marked_in(&self, cells: &Rect) -> Option<Rect> {
        let (mut columns, mut rows) = (0, [i32::MAX, 0]);
        for row in cells.min[1]..cells.max[1] {
            let marks = self.in_row(row, cells.min[0], cells.max[0]);
            if marks != 0 {
                (columns, rows) = (columns | marks, [rows[0].min(row), row + 1]);
            }
        }
        let (first, end) = (columns.trailing_zeros() as i32, 64 - columns.leading_zeros() as i32);
        (columns != 0).then(|| Rect { min: [cells.min[0] + first, rows[0]], max: [cells.min[0] + end, rows[1]] })
    }

    /// The marks of a row from column `first` to before `end`, less than 64 of them, one per bit.
    pub fn in_row(&self, row: i32, first: i32, end: i32) -> u64 {
        let (word, bit) = (row as usize * self.stride + first as usize / 64, first % 64);
        let bits = self.seam[word] >> bit | self.seam[word + 1] << 1 << (63 - bit);
        bits & !(u64::MAX << (end - first))
    }
}

// # The samples of a window
//
// The samples of a window, as floats in the order in which they are found.

/// The number of samples to reserve memory for where an unbiased set would have `expected`: seams make a set up to 2 %
/// denser; that much again is for chance.
pub fn capacity(expected: f64) -> usize {
    (expected * 1.04) as usize
}

/// Collects the samples that lie in a rectangle.
pub struct Output<'a> {
    lattice: &'a Lattice,
    rect: Rect,
    samples: Vec<[f32; 2]>,
}

impl<'a> Output<'a> {
    /// An empty collection for the samples in `rect`.
    pub fn new(lattice: &'a Lattice, rect: Rect) -> Self {
        Self { lattice, rect, samples: Vec::with_capacity(capacity(lattice.samples_in(&rect))) }
    }

    /// Adds a sample if it lies in the rectangle.
    pub fn push(&mut self, sample: [i32; 2]) {
        if self.rect.contains(sample) {
            self.samples.push(self.lattice.position(sample));
        }
    }

    /// Adds the samples of a row of the pattern that lie in the rectangle. The row must be whole.
    pub fn copy(&mut self, row: &Row) {
        let inside = self.rect.intersection(&row.part);
        if inside == row.part {
            self.samples.extend(row.points().map(|point| self.lattice.position(point)));
        } else if !inside.is_empty() {
            row.points().for_each(|point| self.push(point));
        }
    }

    /// The number of samples so far.
    #[cfg(feature = "stages")]
    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// The samples.
    pub fn finish(self) -> Vec<[f32; 2]> {
        self.samples
    }
}
