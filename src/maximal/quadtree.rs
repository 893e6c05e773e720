//! The flat quadtree of Ebeida, Mitchell, Patney, Davidson and Owens 2012, "A simple algorithm for maximal
//! Poisson-disk sampling in high dimensions", in the plane and on the lattice.
//!
//! The list of *voxels*, squares of one level, always holds every lattice point that no sample covers. Darts fall
//! exactly uniformly on the voxels' lattice points, so an accepted dart is uniform on what is uncovered. Between
//! rounds of darts voxels are cut and the parts that one sample covers are dropped. Where the paper ends at the
//! precision of floats, the voxels here end as single lattice points: an empty list *proves* maximality.
//!
//! Voxels are cut in sixteen by a coarse test (`sixteenths.rs`) while they are wide, and exactly in four after that.

use super::cells::CellGrid;
use super::sixteenths;
use crate::lattice::Rect;
use crate::rng::Rng;

/// One level of voxels: the cells of a grid, halved `depth` times per axis.
#[derive(Clone, Copy)]
struct Level {
    depth: u32,
    /// The widest voxel, in lattice points.
    widest: [i32; 2],
    /// What voxels are clipped to.
    clip: Rect,
}

impl Level {
    fn is_finest(&self) -> bool {
        self.widest == [1; 2]
    }

    fn next(&self) -> Self {
        Self { depth: self.depth + 1, widest: self.widest.map(|width| (width + 1) / 2), ..*self }
    }

    /// Whether its voxels are cut in sixteen, which are two levels deeper, by the coarse test; otherwise exactly in four.
    fn is_coarse(&self) -> bool {
        self.depth < COARSE_DEPTH && self.widest.into_iter().min() > Some(NARROWEST)
    }

    fn cell(&self, voxel: [i32; 2]) -> [i32; 2] {
        voxel.map(|index| index >> self.depth)
    }

    /// The borders of the sixteenths of a voxel: those of the level two deeper, clipped.
    #[inline(always)] // Small arrays that pass through memory would cost as much as the test that they are for.
    fn quarters(&self, cell: &Rect, voxel: [i32; 2]) -> [[i32; 5]; 2] {
        let mut borders = [[0; 5]; 2];
        for axis in 0..2 {
            let within = 4 * i64::from(voxel[axis] & ((1 << self.depth) - 1));
            let length = i64::from(cell.length(axis));
            for (border, index) in borders[axis].iter_mut().zip(within..) {
                let unclipped = cell.min[axis] + ((length * index) >> (self.depth + 2)) as i32;
                *border = unclipped.max(self.clip.min[axis]).min(self.clip.max[axis]);
            }
        }
        borders
    }

    /// The lattice points of a voxel, given those of its cell. Integer bisection: the halves of a voxel are exactly its
    /// points.
    fn rect(&self, cell: &Rect, voxel: [i32; 2]) -> Rect {
        let within = voxel.map(|index| i64::from(index & ((1 << self.depth) - 1)));
        let border =
            |axis: usize, index: i64| cell.min[axis] + ((i64::from(cell.length(axis)) * index) >> self.depth) as i32;
        let unclipped = Rect {
            min: std::array::from_fn(|axis| border(axis, within[axis])),
            max: std::array::from_fn(|axis| border(axis, within[axis] + 1)),
        };
        unclipped.intersection(&self.clip)
    }
}

/// Voxels shallower than this and wider than [`NARROWEST`] are much wider than the slack of the coarse test.
const COARSE_DEPTH: u32 = 9;

/// The narrowest voxel that is cut in sixteen.
const NARROWEST: i32 = 8;

/// The voxels of a rectangle of lattice points that may be uncovered, by column and row at their level.
pub(crate) struct Quadtree {
    level: Level,
    voxels: Vec<[i32; 2]>,
    /// The memory of the next level's voxels.
    next: Vec<[i32; 2]>,
    /// The memory of the samples near a voxel.
    near: Vec<[i32; 2]>,
}

impl Quadtree {
    /// The given cells of the grid, as far as they lie in `rect`.
    pub fn new(grid: &CellGrid, rect: Rect, cells: Vec<[i32; 2]>) -> Self {
        let widest = cells.iter().fold([1; 2], |widest, &cell| {
            let rect = grid.rect(cell);
            std::array::from_fn(|axis| rect.length(axis).max(widest[axis]))
        });
        let level = Level { depth: 0, widest, clip: rect };
        Self { level, voxels: cells, next: Vec::new(), near: Vec::new() }
    }

    /// Drops all voxels and takes those that [`Quadtree::push_gaps`] will add, as far as they lie in `rect`.
    pub fn restart(&mut self, rect: Rect) {
        self.voxels.clear();
        self.level = Level { depth: 2, widest: [1; 2], clip: rect };
    }

    /// Adds the sixteenths of an empty cell that may have uncovered points. Voxels must not have been cut since the
    /// restart.
    pub fn push_gaps(&mut self, grid: &CellGrid, cell: [i32; 2]) {
        let rect = grid.rect(cell);
        let whole = Level { depth: 0, ..self.level };
        let near = grid.samples_near(cell, &mut self.near);
        let open = sixteenths::uncovered(&whole.quarters(&rect, cell), near, grid.threshold);
        push_sixteenths(&mut self.voxels, cell, open);
        if open != 0 {
            self.level.widest = [0, 1].map(|axis: usize| self.level.widest[axis].max((rect.length(axis) + 3) / 4));
        }
    }

    /// How many voxels are left.
    pub fn len(&self) -> usize {
        self.voxels.len()
    }

    /// Whether every lattice point is covered.
    pub fn is_empty(&self) -> bool {
        self.voxels.is_empty()
    }

    /// Throws darts and shows those that became samples to `accepted`.
    pub fn throw(&mut self, grid: &mut CellGrid, rng: &mut Rng, darts: usize, mut accepted: impl FnMut([i32; 2])) {
        let level = self.level;
        for _ in 0..darts {
            if self.voxels.is_empty() {
                break;
            }
            let pick = rng.below(self.voxels.len() as u64) as usize;
            let voxel = self.voxels[pick];
            let cell = level.cell(voxel);
            if grid.sample(cell).is_some() {
                self.voxels.swap_remove(pick);
                continue;
            }
            // Every voxel gets the widest one's share of darts; those beyond its own end are void.
            let rect = level.rect(&grid.rect(cell), voxel);
            let point = std::array::from_fn(|axis| rect.min[axis] + rng.below(level.widest[axis] as u64) as i32);
            if rect.contains(point) && !grid.conflicts(cell, point) {
                grid.insert(cell, point);
                self.voxels.swap_remove(pick);
                accepted(point);
            }
        }
    }

    /// Cuts the voxels in parts and drops those that one sample covers. Single lattice points are not cut.
    pub fn refine(&mut self, grid: &CellGrid) {
        let level = self.level;
        self.next.clear();
        // Voxels of one cell mostly follow each other and have their neighbours in common.
        for voxels in self.voxels.chunk_by(|&a, &b| level.cell(a) == level.cell(b)) {
            let cell = level.cell(voxels[0]);
            let near = grid.samples_near(cell, &mut self.near);
            let cell = grid.rect(cell);
            if level.is_coarse() {
                for &voxel in voxels {
                    let open = sixteenths::uncovered(&level.quarters(&cell, voxel), near, grid.threshold);
                    push_sixteenths(&mut self.next, voxel, open);
                }
            } else {
                refine_exactly(grid, near, &level, &cell, voxels, &mut self.next);
            }
        }
        self.level = match level {
            _ if level.is_coarse() => level.next().next(),
            _ if level.is_finest() => level,
            _ => level.next(),
        };
        std::mem::swap(&mut self.voxels, &mut self.next);
    }
}

/// Adds the sixteenths of a voxel whose bit is set in `open`.
fn push_sixteenths(voxels: &mut Vec<[i32; 2]>, voxel: [i32; 2], mut open: u16) {
    while open != 0 {
        let i = open.trailing_zeros() as i32;
        voxels.push([4 * voxel[0] + i % 4, 4 * voxel[1] + i / 4]);
        open &= open - 1;
    }
}

/// Adds the quarters of the voxels of one cell that no single sample covers; at the finest level the voxels.
fn refine_exactly(
    grid: &CellGrid,
    near: &[[i32; 2]],
    level: &Level,
    cell: &Rect,
    voxels: &[[i32; 2]],
    open: &mut Vec<[i32; 2]>,
) {
    for &voxel in voxels.iter().filter(|&&voxel| !grid.covers(near, &level.rect(cell, voxel))) {
        if level.is_finest() {
            open.push(voxel);
            continue;
        }
        let quarters = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[x, y]| [2 * voxel[0] + x, 2 * voxel[1] + y]);
        open.extend(quarters.into_iter().filter(|&quarter| !grid.covers(near, &level.next().rect(cell, quarter))));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::maximal::CellAxis;
    use crate::rng::Draw;

    fn grid(size: [i32; 2]) -> CellGrid {
        let axes = size.map(|size| CellAxis::new(size, 70.0));
        CellGrid::new(&axes, &Rect { min: [0; 2], max: size }, 4900, 69)
    }

    fn all_cells(grid: &CellGrid) -> Vec<[i32; 2]> {
        let [columns, rows] = grid.counts();
        (0..rows).flat_map(|y| (0..columns).map(move |x| [x, y])).collect()
    }

    /// In an empty grid nothing is dropped: at every level each lattice point is in exactly one voxel.
    #[test]
    fn voxels_of_every_level_hold_each_lattice_point_once() {
        let grid = grid([211, 130]);
        let clip = Rect { min: [13, 20], max: [200, 101] };
        let mut quadtree = Quadtree::new(&grid, clip, all_cells(&grid));
        loop {
            let mut held = vec![0; 211 * 130];
            for &voxel in &quadtree.voxels {
                let rect = quadtree.level.rect(&grid.rect(quadtree.level.cell(voxel)), voxel);
                assert!((0..2).all(|axis| rect.length(axis) <= quadtree.level.widest[axis]));
                for (y, x) in (rect.min[1]..rect.max[1]).flat_map(|y| (rect.min[0]..rect.max[0]).map(move |x| (y, x))) {
                    held[(y * 211 + x) as usize] += 1;
                }
            }
            for (place, held) in held.into_iter().enumerate() {
                let inside = clip.contains([place as i32 % 211, place as i32 / 211]);
                assert_eq!(held, i32::from(inside));
            }
            if quadtree.level.is_finest() {
                break;
            }
            quadtree.refine(&grid);
        }
    }

    #[test]
    fn first_darts_are_uniform_at_every_level() {
        let size = [57, 61];
        for level in 0..4 {
            let mut histogram = vec![0u32; 57 * 61];
            let mut rng = Rng::at(level, Draw::Probe, &[]);
            for _ in 0..100_000 {
                let mut grid = grid(size);
                let mut quadtree = Quadtree::new(&grid, Rect { min: [0; 2], max: size }, all_cells(&grid));
                (0..level).for_each(|_| quadtree.refine(&grid));
                let mut first = None;
                while first.is_none() {
                    quadtree.throw(&mut grid, &mut rng, 1, |sample| first = Some(sample));
                }
                let [x, y] = first.unwrap();
                histogram[(y * 57 + x) as usize] += 1;
            }
            let expected = 100_000.0 / histogram.len() as f64;
            let chi2: f64 = histogram.iter().map(|&count| (f64::from(count) - expected).powi(2) / expected).sum();
            let freedom = histogram.len() as f64 - 1.0;
            assert!((chi2 - freedom).abs() < 5.0 * (2.0 * freedom).sqrt(), "chi2 {chi2} of {freedom} at level {level}");
        }
    }
}
