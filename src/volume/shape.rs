//! The shape that is filled: a whole cuboid, or what of it lies inside a mesh (`inside.rs`).

use crate::simd::Lanes;
use crate::volume::grid::Grid;
use crate::volume::search::Centre;
use crate::volume::voxels::{Level, Voxel};

/// Voxels of a shape.
#[derive(Default)]
pub struct Voxels {
    /// Those that lie in it.
    pub inside: Vec<Voxel>,
    /// Those that may lie partly in it.
    pub cut: Vec<Voxel>,
}

impl Voxels {
    pub fn len(&self) -> usize {
        self.inside.len() + self.cut.len()
    }

    /// One of them, and true if it is cut.
    #[inline(always)]
    pub fn get(&self, number: usize) -> (Voxel, bool) {
        let inside = self.inside.len();
        if number < inside { (self.inside[number], false) } else { (self.cut[number - inside], true) }
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub fn clear(&mut self) {
        self.inside.clear();
        self.cut.clear();
    }
}

/// The shape of a block.
pub trait Shape {
    /// Is told the cells of the grid, before balls are listed in them.
    fn begin(&mut self, _: &Grid) {}

    /// False if a ball touches no cell that has part in the shape: it need not be listed.
    #[inline(always)]
    fn needs(&self, _: &Grid, _: Centre) -> bool {
        true
    }

    /// The cells of a grid that have part in it, from those that are open.
    fn cells<L: Lanes>(&mut self, lanes: L, grid: &Grid, open: Vec<Voxel>) -> Voxels;

    /// The parts of a cut voxel, of those with a bit in `open`, that lie in the shape, and those that are cut and not too
    /// small to matter. Shapes of whole cells have no cut voxels.
    #[inline(always)]
    fn parts<L: Lanes>(&mut self, _: L, _: &Grid, _: &Level, _: Voxel, open: u64) -> [u64; 2] {
        [open, 0]
    }

    /// True if a lattice point of the domain, one of a cut voxel, lies in the shape.
    #[inline(always)]
    fn holds(&self, _: Centre) -> bool {
        true
    }
}

/// All of a block.
pub struct Whole;

impl Shape for Whole {
    #[inline(always)]
    fn cells<L: Lanes>(&mut self, _: L, _: &Grid, open: Vec<Voxel>) -> Voxels {
        Voxels { inside: open, cut: Vec::new() }
    }
}
