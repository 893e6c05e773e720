//! The nearest point of a set in the plane, on a torus too, however the points are spread.

use glam::DVec3;

use super::tree::Tree;
use crate::grid2::Grid2;
use crate::points::{Boundary, Domain};

/// The grid is asked within so many mean spacings, a bit farther than the largest hole of most sets; then the tree, whose
/// answer takes longer, but hardly any longer where all points are far away.
const NEAR: f64 = 4.0;

/// Points in a grid, and in a tree for places that are far from all of them.
pub(super) struct Nearest {
    domain: Domain,
    spacing: f64,
    grid: Grid2,
    tree: Tree,
}

impl Nearest {
    /// Takes O(n log n). There must be a point.
    pub fn new(domain: &Domain, points: &[[f32; 2]]) -> Self {
        let spacing = (domain.area() / points.len() as f64).sqrt();
        let grid = Grid2::new(*domain, points.iter().map(|point| point.map(f64::from)), spacing);
        let tree = Tree::of(&points.iter().map(|&[x, y]| [x, y, 0.0]).collect::<Vec<_>>());
        Self { domain: *domain, spacing, grid, tree }
    }

    /// The distance of the nearest point from a place of the domain.
    pub fn distance(&self, place: [f64; 2]) -> f64 {
        let mut reach = self.spacing;
        while reach <= NEAR * self.spacing {
            let mut nearest = f64::INFINITY;
            self.grid.for_each_within(place, reach, |_, _, squared| nearest = nearest.min(squared));
            if nearest < f64::INFINITY {
                return nearest.sqrt();
            }
            reach *= 2.0;
        }
        let turns: &[f64] = match self.domain.boundary {
            Boundary::Periodic => &[0.0, -1.0, 1.0],
            Boundary::Bounded => &[0.0],
        };
        let [width, height] = self.domain.extent();
        let images =
            turns.iter().flat_map(|x| turns.iter().map(move |y| [place[0] + x * width, place[1] + y * height]));
        images.map(|[x, y]| self.tree.nearest(DVec3::new(x, y, 0.0))).fold(f64::INFINITY, f64::min)
    }
}
