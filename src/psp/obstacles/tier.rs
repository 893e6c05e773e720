//! Obstacles of similar clearances, by the cells that their balls touch.

use glam::DVec3;

use crate::index::Binned;
use crate::mesh::{Mesh, exact};
use crate::psp::fill::grid::{any_cell, each_cell};
use crate::psp::fill::space::{Place, Space, key};
use crate::psp::fill::table::Table;
use crate::psp::obstacles::{CROWD, OCTAVES, Obstacle};

/// How much the cells of a ball are found too large, as a share: rounding adds less.
const SLACK: f64 = 1e-6;

/// By how much cells become larger.
const GROWTH: f64 = (1 << OCTAVES) as f64;

/// Obstacles whose clearances are below an end. Cells are at least twice as large as that.
pub(super) struct Tier {
    pub end: f64,
    space: Space,
    /// The number of each cell that has obstacles, from 1 on.
    cells: Table<u32>,
    /// The obstacles of the cell with number 0, which has none, and of all others.
    obstacles: Binned<Obstacle>,
}

/// Whether a cell has more obstacles than it should, on average, where cells are twice as large as `size`.
pub(super) fn is_crowded(mesh: &Mesh, size: f64, obstacles: &[Obstacle]) -> bool {
    let (space, mut cells, mut count) = (Space::new(mesh, size), Table::<bool>::new(), 0);
    let (low, high) = mesh.bounds();
    for obstacle in obstacles {
        let inside = obstacle.centre.clamp(exact(low), exact(high)).as_vec3().to_array();
        let is_known = cells.entry(key(space.cell(space.place(inside))));
        count += usize::from(!std::mem::replace(is_known, true));
    }
    obstacles.len() > CROWD * count
}

impl Tier {
    pub fn new(mesh: &Mesh, end: f64, obstacles: &[Obstacle]) -> Self {
        let (low, high) = mesh.bounds();
        let (mut size, largest) = (end, exact(low).distance(exact(high)));
        while size < largest && !is_crowded(mesh, GROWTH * size, obstacles) {
            size *= GROWTH;
        }
        let space = Space::new(mesh, size);
        let bounds = [space.place(low), space.place(high)];
        let (mut cells, mut count, mut listed) = (Table::<u32>::new(), 0, Vec::new());
        for &obstacle in obstacles {
            each_cell(cells_of(&space, bounds, obstacle), |cell| {
                let number = cells.entry(key(cell));
                if *number == 0 {
                    count += 1;
                    *number = count;
                }
                listed.push((*number as usize, obstacle));
            });
        }
        let obstacles = Binned::new(count as usize + 1, listed.iter().copied());
        Self { end, space, cells, obstacles }
    }

    /// How many obstacles all cells list.
    pub fn listed(&self) -> usize {
        self.obstacles.items().len()
    }

    /// The obstacles whose balls can hold a position of the mesh.
    #[inline]
    pub fn at(&self, position: [f32; 3]) -> &[Obstacle] {
        self.of_cell(self.space.cell(self.space.place(position)))
    }

    #[inline]
    fn of_cell(&self, cell: [u32; 3]) -> &[Obstacle] {
        self.obstacles.bin(self.cells.get(key(cell)) as usize)
    }

    /// Whether a test holds for the obstacles of a cell in which there may be some that cover a sixteenth of a fragment.
    pub fn any_cell(&self, corners: [DVec3; 3], mut test: impl FnMut(&[Obstacle]) -> bool) -> bool {
        let [a, b, c] = corners;
        // Most fragments lie in one cell.
        let [low, high] = [a.min(b).min(c), a.max(b).max(c)].map(|end| end.as_vec3().to_array());
        let [low, high] = [low, high].map(|end| self.space.cell(self.space.place(end)));
        if low == high {
            return test(self.of_cell(low));
        }
        any_cell(&self.space, corners.map(|corner| self.space.scaled(corner)), |cell| test(self.of_cell(cell)))
    }
}

/// The lowest and the highest cell that the part of a ball inside of the mesh's box touches, where all that is asked for is.
///
/// Rounding is monotone, as for [`Space::cells_around`].
fn cells_of(space: &Space, [low, high]: [Place; 2], obstacle: Obstacle) -> [[u32; 3]; 2] {
    let (centre, reach) = (space.scaled(obstacle.centre), obstacle.reach * f64::from(space.scale()) * (1.0 + SLACK));
    let corner = |by: f64| {
        let end = (centre + by).as_vec3().to_array();
        space.cell([0, 1, 2].map(|axis| end[axis].clamp(low[axis], high[axis])))
    };
    [corner(-reach), corner(reach)]
}
