//! The flat quadtree of Ebeida, Mitchell, Patney, Davidson and Owens 2012, "A simple algorithm for maximal
//! Poisson-disk sampling in high dimensions", in the plane and on the lattice.
//!
//! The list of *voxels*, squares of one level, always holds every lattice point that no sample covers. Darts fall
//! exactly uniformly on the voxels' lattice points, so an accepted dart is uniform on what is uncovered. Between
//! rounds of darts voxels that one sample covers are dropped and the others are cut in four. Where the paper ends at
//! the precision of floats, the voxels here end as single lattice points: an empty list *proves* maximality.

use super::cells::CellGrid;
use crate::lattice::Rect;
use crate::rng::Rng;

/// The voxels of a rectangle of lattice points that may be uncovered.
pub(crate) struct Quadtree {
    rect: Rect,
    /// Voxels are the cells of a grid, halved this many times per axis.
    level: u32,
    /// Column and row at this level.
    voxels: Vec<[i32; 2]>,
    /// The widest voxel of this level, in lattice points.
    widest: [i32; 2],
}

impl Quadtree {
    /// The given cells of the grid, as far as they lie in `rect`.
    pub fn new(grid: &CellGrid, rect: Rect, cells: Vec<[i32; 2]>) -> Self {
        let widest = cells.iter().fold([1; 2], |widest, &cell| {
            let rect = grid.rect(cell);
            std::array::from_fn(|axis| rect.length(axis).max(widest[axis]))
        });
        Self { rect, level: 0, voxels: cells, widest }
    }

    /// How many voxels are left.
    pub fn len(&self) -> usize {
        self.voxels.len()
    }

    /// Whether every lattice point is covered.
    pub fn is_empty(&self) -> bool {
        self.voxels.is_empty()
    }

    fn cell(&self, voxel: [i32; 2]) -> [i32; 2] {
        voxel.map(|index| index >> self.level)
    }

    /// The lattice points of a voxel. Integer bisection of the cell: the halves of a voxel are exactly its points.
    fn rect(&self, grid: &CellGrid, voxel: [i32; 2]) -> Rect {
        let cell = grid.rect(self.cell(voxel));
        let border = |axis: usize, index: i64| {
            let within = index - (i64::from(voxel[axis] >> self.level) << self.level);
            cell.min[axis] + ((i64::from(cell.length(axis)) * within) >> self.level) as i32
        };
        let unclipped = Rect {
            min: std::array::from_fn(|axis| border(axis, i64::from(voxel[axis]))),
            max: std::array::from_fn(|axis| border(axis, i64::from(voxel[axis]) + 1)),
        };
        unclipped.intersection(&self.rect)
    }

    /// Throws darts and gives how many became samples.
    pub fn throw(&mut self, grid: &mut CellGrid, rng: &mut Rng, darts: usize) -> usize {
        let mut accepted = 0;
        for _ in 0..darts {
            if self.voxels.is_empty() {
                break;
            }
            let pick = rng.below(self.voxels.len() as u64) as usize;
            let voxel = self.voxels[pick];
            let cell = self.cell(voxel);
            if grid.sample(cell).is_some() {
                self.voxels.swap_remove(pick);
                continue;
            }
            // Every voxel gets the widest one's share of darts; those beyond its own end are void.
            let rect = self.rect(grid, voxel);
            let point = std::array::from_fn(|axis| rect.min[axis] + rng.below(self.widest[axis] as u64) as i32);
            if rect.contains(point) && !grid.conflicts(cell, point) {
                grid.insert(cell, point);
                self.voxels.swap_remove(pick);
                accepted += 1;
            }
        }
        accepted
    }

    /// Drops the voxels that one sample covers.
    pub fn prune(&mut self, grid: &CellGrid) {
        let mut voxels = std::mem::take(&mut self.voxels);
        voxels.retain(|&voxel| !grid.covers(self.cell(voxel), &self.rect(grid, voxel)));
        self.voxels = voxels;
    }

    /// Cuts every voxel in four and drops those of the quarters that one sample covers. Single lattice points stay.
    pub fn refine(&mut self, grid: &CellGrid) {
        if self.widest == [1; 2] {
            return;
        }
        let parents = std::mem::take(&mut self.voxels);
        self.level += 1;
        self.widest = self.widest.map(|width| (width + 1) / 2);
        for [x, y] in parents {
            for voxel in [[2 * x, 2 * y], [2 * x + 1, 2 * y], [2 * x, 2 * y + 1], [2 * x + 1, 2 * y + 1]] {
                if !grid.covers(self.cell(voxel), &self.rect(grid, voxel)) {
                    self.voxels.push(voxel);
                }
            }
        }
    }
}
