//! The nearest point of a set in the plane, on a torus too, however the points are spread.

use glam::DVec3;

use crate::error::Result;
use crate::index::Grid2;
use crate::index::PointTree;
use crate::job::Job;
use crate::points::{Boundary, Domain};

/// The grid is asked within so many mean spacings, a bit farther than the largest hole of most sets; then the tree, whose
/// answer takes longer, but hardly any longer where all points are far away.
const NEAR: f64 = 4.0;

/// Points in a grid, and in a tree for places that are far from all of them.
pub(super) struct Nearest {
    domain: Domain,
    spacing: f64,
    grid: Grid2,
    tree: PointTree,
}

impl Nearest {
    /// Takes O(n log n). There must be a point.
    pub fn new(job: &Job, domain: &Domain, points: &[[f32; 2]]) -> Result<Self> {
        let spacing = (domain.area() / points.len() as f64).sqrt();
        let grid = Grid2::new(*domain, points.iter().map(|point| point.map(f64::from)), spacing);
        let tree = PointTree::of(job, &points.iter().map(|&[x, y]| [x, y, 0.0]).collect::<Vec<_>>())?;
        Ok(Self { domain: *domain, spacing, grid, tree })
    }

    /// The offset from a place of the domain to the nearest point.
    pub fn offset(&self, place: [f64; 2]) -> [f64; 2] {
        let mut reach = self.spacing;
        while reach <= NEAR * self.spacing {
            let (mut nearest, mut least) = (None, f64::INFINITY);
            self.grid.for_each_within(place, reach, |_, offset, squared| {
                if squared < least {
                    (nearest, least) = (Some(offset), squared);
                }
            });
            if let Some(offset) = nearest {
                return offset;
            }
            reach *= 2.0;
        }
        let turns: &[f64] = match self.domain.boundary {
            Boundary::Periodic => &[0.0, -1.0, 1.0],
            Boundary::Bounded => &[0.0],
        };
        let [width, height] = self.domain.extent();
        let images = turns.iter().flat_map(|x| turns.iter().map(move |y| [x * width, y * height]));
        let offsets = images.filter_map(|turn| {
            let image = DVec3::new(place[0] + turn[0], place[1] + turn[1], 0.0);
            Some(self.tree.nearest_point(image)? - image)
        });
        let nearest = offsets.min_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        nearest.expect("there is a point").truncate().to_array()
    }
}
