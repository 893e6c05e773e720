//! The neighbourhood of the `K` nearest points (thesis §4.3.4), for repulsion only.
//!
//! Neighbours beyond the conflict radius exert no force, so none is looked for: of the `K` nearest only those closer
//! than the conflict radius are known here.

use glam::DVec2;

use super::frame::{Frame, Site};
use super::links::{Link, Links};
use crate::error::Result;
use crate::grid2::Grid2;
use crate::job::{Job, chunks};
use crate::points::{Boundary, Domain};

/// The points and their copies in a grid, and how far the neighbourhood of each point reaches.
pub(super) struct Nearest {
    sites: Vec<Site>,
    grid: Grid2,
    radius: f64,
    /// The squared distance of each point's `K`-th nearest neighbour, a little more, and infinite if that is beyond
    /// `radius`. Who is as far as the `K`-th belongs to the neighbourhood too: ties are not broken.
    reach: Vec<f64>,
}

impl Nearest {
    /// The neighbourhoods of `count` neighbours closer than `radius`, which is at most 1. Takes O(n) for sets without
    /// clusters.
    pub(super) fn new(
        job: &Job,
        frame: &Frame,
        positions: impl ExactSizeIterator<Item = DVec2> + Clone,
        radius: f64,
        count: usize,
    ) -> Result<Self> {
        let points = chunks(positions.len());
        let sites = frame.sites(positions, radius);
        let max = (frame.size() + radius).to_array();
        let around = Domain { min: [-radius; 2], max, boundary: Boundary::Bounded };
        let grid = Grid2::new(around, sites.iter().map(|site| site.position.to_array()), radius);
        let reach = job.flat_map(points.len(), |chunk| {
            let mut nearest = Vec::new();
            points.range(chunk).map(|point| reach(&grid, &sites, point, radius, count, &mut nearest)).collect()
        })?;
        Ok(Self { sites, grid, radius, reach })
    }
}

/// What distances that would be equal without rounding may differ by, in spacings: those from a point to the copy of
/// another, and from the other to the copy of the point.
const ROUNDING: f64 = 1e-9;

/// The squared reach of a neighbourhood; `nearest` is memory to work in.
fn reach(grid: &Grid2, sites: &[Site], point: usize, radius: f64, count: usize, nearest: &mut Vec<f64>) -> f64 {
    nearest.clear();
    grid.for_each_within(sites[point].position.to_array(), radius, |site, _, squared| {
        if site as usize != point {
            nearest.push(squared);
        }
    });
    if nearest.len() < count {
        return f64::INFINITY;
    }
    (nearest.select_nth_unstable_by(count - 1, f64::total_cmp).1.sqrt() + ROUNDING).powi(2)
}

impl Links for Nearest {
    fn for_each(&self, point: usize, mut visit: impl FnMut(Link)) {
        self.grid.for_each_within(self.sites[point].position.to_array(), self.radius, |site, offset, squared| {
            let other = self.sites[site as usize].source;
            let (outgoing, incoming) = (squared <= self.reach[point], squared <= self.reach[other as usize]);
            if site as usize != point && (outgoing || incoming) {
                visit(Link { other, offset: DVec2::from_array(offset), outgoing, incoming });
            }
        });
    }
}
