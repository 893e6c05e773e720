//! The neighbourhoods along which the thesis's forces act.

use glam::DVec2;

use crate::error::Result;
use crate::geometry::{Delaunay, Frame, Site};
use crate::index::Grid2;
use crate::job::{Job, chunks};
use crate::math::square;
use crate::points::{Boundary, Domain};

/// A constraint between a point and one of its neighbours, as seen from the point.
pub struct Link {
    /// The neighbour, or the point that the neighbour is a copy of.
    pub other: u32,
    /// The offset of the neighbour, in spacings.
    pub offset: DVec2,
    /// True if the neighbour is in the neighbourhood of the point.
    pub outgoing: bool,
    /// True if the point is in the neighbourhood of the neighbour.
    pub incoming: bool,
}

/// The neighbours of all points, for one state of the set.
pub trait Links: Sync {
    /// Visits every link of a point, always in the same order.
    fn for_each(&self, point: usize, visit: impl FnMut(Link));
}

/// The links between Delaunay neighbours.
pub struct DelaunayLinks {
    delaunay: Delaunay,
    boundary: Boundary,
}

impl DelaunayLinks {
    /// Triangulates the points of a frame, in O(n log n).
    pub fn new(job: &Job, frame: &Frame, positions: impl Iterator<Item = DVec2> + Clone) -> Result<Self> {
        Ok(Self { delaunay: Delaunay::new(job, frame, positions)?, boundary: frame.boundary() })
    }
}

impl Links for DelaunayLinks {
    /// On a bounded domain a point is linked across the boundary to its own mirror image only: an edge to the image of
    /// another point would cross the mirrored edge, so it is but an arbitrary diagonal of a symmetric cell.
    fn for_each(&self, point: usize, mut visit: impl FnMut(Link)) {
        for (site, offset) in self.delaunay.star(point) {
            let is_mirrored = self.boundary == Boundary::Bounded && !site.is_original();
            let is_own_image = site.source as usize == point && site.side.contains(&0);
            if !is_mirrored || is_own_image {
                visit(Link { other: site.source, offset, outgoing: true, incoming: true });
            }
        }
    }
}

// The neighbourhood of the `K` nearest points (thesis §4.3.4), for repulsion only.
//
// Neighbours beyond the conflict radius exert no force, so of the `K` nearest only those within it are found.

/// The points and their copies in a grid.
pub struct SiteGrid {
    sites: Vec<Site>,
    grid: Grid2,
    radius: f64,
}

impl SiteGrid {
    /// For searches up to `radius`. Takes O(n).
    pub fn new(frame: &Frame, positions: impl ExactSizeIterator<Item = DVec2> + Clone, radius: f64) -> Self {
        let sites = frame.sites(positions, radius);
        let max = (frame.size() + radius).to_array();
        let around = Domain { min: [-radius; 2], max, boundary: Boundary::Bounded };
        let grid = Grid2::new(around, sites.iter().map(|site| site.position.to_array()), radius);
        Self { sites, grid, radius }
    }

    /// Visits all other sites within the radius of a point, with offsets and squared distances.
    pub fn for_each(&self, point: usize, mut visit: impl FnMut(&Site, DVec2, f64)) {
        self.grid.for_each_within(self.sites[point].position.to_array(), self.radius, |site, offset, squared| {
            if site as usize != point {
                visit(&self.sites[site as usize], DVec2::from_array(offset), squared);
            }
        });
    }
}

/// The links between nearest points, found anew.
pub struct NearestLinks {
    around: SiteGrid,
    /// The squared distance of each point's `K`-th nearest neighbour, a little more, and infinite if that is beyond
    /// the radius. A point as far as the `K`-th belongs to the neighbourhood too: ties are not broken.
    reach: Vec<f64>,
}

impl NearestLinks {
    /// The neighbourhoods of `count` neighbours closer than `radius`, which is at most 1. Takes O(n) for sets without
    /// clusters.
    pub fn new(
        job: &Job,
        frame: &Frame,
        positions: impl ExactSizeIterator<Item = DVec2> + Clone,
        radius: f64,
        count: usize,
    ) -> Result<Self> {
        let points = chunks(positions.len());
        let around = SiteGrid::new(frame, positions, radius);
        let reach = job.flat_map(points.len(), |chunk| {
            let mut nearest = Vec::new();
            let within = |point| {
                nearest.clear();
                around.for_each(point, |_, _, squared| nearest.push(squared));
                reach(&mut nearest, count)
            };
            points.range(chunk).map(within).collect()
        })?;
        Ok(Self { around, reach })
    }
}

/// The rounding, in spacings, by which equal distances may differ: that from a point to the copy of another, and that
/// from the other to the copy of the point.
const ROUNDING: f64 = 1e-9;

/// The squared reach of a neighbourhood of `count` points, by the squared distances of all within the radius.
pub fn reach(squared: &mut [f64], count: usize) -> f64 {
    if squared.len() < count {
        return f64::INFINITY;
    }
    square(squared.select_nth_unstable_by(count - 1, f64::total_cmp).1.sqrt() + ROUNDING)
}

impl Links for NearestLinks {
    fn for_each(&self, point: usize, mut visit: impl FnMut(Link)) {
        self.around.for_each(point, |&Site { source: other, .. }, offset, squared| {
            let (outgoing, incoming) = (squared <= self.reach[point], squared <= self.reach[other as usize]);
            if outgoing || incoming {
                visit(Link { other, offset, outgoing, incoming });
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::job::Context;
    use crate::rng::{Draw, Rng};

    /// On a mirrored square there are links to own images, and none to those of other points.
    #[test]
    fn links_are_mutual_and_cross_the_boundary_to_own_images_only() {
        let frame = Frame::new(Domain::unit(Boundary::Bounded), 200);
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        let points: Vec<_> = (0..200).map(|_| frame.size() * DVec2::new(rng.unit(), rng.unit())).collect();
        let links = |job: &Job| DelaunayLinks::new(job, &frame, points.iter().copied());
        let links = Context::new(1).unwrap().run(None, links).unwrap();
        let (mut inside, mut own) = (Vec::new(), 0);
        for (point, &position) in points.iter().enumerate() {
            links.for_each(point, |link| {
                if link.other as usize == point {
                    let image = position + link.offset;
                    assert!(image.cmplt(DVec2::ZERO).any() || image.cmpgt(frame.size()).any());
                    own += 1;
                } else {
                    assert!((points[link.other as usize] - position).distance(link.offset) < 1e-9);
                    inside.push((point as u32, link.other));
                }
            });
        }
        assert!(own > 20 && inside.iter().all(|&(from, to)| inside.contains(&(to, from))));
    }

    /// All sites by distance, then the definition of the neighbourhood.
    #[test]
    fn links_are_those_of_the_nearest_sites() {
        for (count, width, boundary) in [
            (80, 1.0, Boundary::Periodic),
            (80, 1.0, Boundary::Bounded),
            (30, 12.0, Boundary::Periodic),
            (2, 1.0, Boundary::Bounded),
        ] {
            let domain = Domain { min: [0.0; 2], max: [width, 1.0], boundary };
            let frame = Frame::new(domain, count);
            let mut rng = Rng::at(2, Draw::Probe, &[]);
            let points: Vec<_> =
                (0..count).map(|_| frame.fold(frame.size() * DVec2::new(rng.unit(), rng.unit()))).collect();
            let sites = frame.sites(points.iter().copied(), 1.0);
            for (neighbours, radius) in [(1, 0.95), (3, 0.95), (6, 0.5), (6, 1.0), (1000, 1.0)] {
                let around = |point: usize| {
                    let distance = |site: &Site| site.position.distance(points[point]);
                    let others = sites.iter().filter(|site| !(site.is_original() && site.source as usize == point));
                    let mut around: Vec<_> = others.map(|site| (distance(site), site.source)).collect();
                    around.sort_by(|a, b| a.0.total_cmp(&b.0));
                    around.into_iter().filter(|&(distance, _)| distance <= radius).collect::<Vec<_>>()
                };
                let reach = |point: usize| around(point).get(neighbours - 1).map_or(f64::INFINITY, |&(d, _)| d + 1e-9);
                let run = |job: &Job| NearestLinks::new(job, &frame, points.iter().copied(), radius, neighbours);
                let nearest = Context::new(1).unwrap().run(None, run).unwrap();
                for point in 0..count {
                    let mut found = Vec::new();
                    nearest.for_each(point, |link| {
                        found.push((link.offset.length(), link.other, link.outgoing, link.incoming));
                    });
                    found.sort_by(|a, b| a.0.total_cmp(&b.0));
                    let mut expected = around(point)
                        .into_iter()
                        .map(|(distance, other)| (other, distance <= reach(point), distance <= reach(other as usize)));
                    let expected: Vec<_> =
                        expected.by_ref().filter(|&(_, outgoing, incoming)| outgoing || incoming).collect();
                    let found: Vec<_> =
                        found.into_iter().map(|(_, other, outgoing, incoming)| (other, outgoing, incoming)).collect();
                    assert_eq!(found, expected);
                }
            }
        }
    }
}
