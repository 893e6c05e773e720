//! The Delaunay triangulation of a torus or of a bounded rectangle with its mirror images (thesis §4.3.3).
//!
//! The triangulation itself is spade's. It supports neither tori nor mirrors, so it is given the points and their
//! copies in a margin around the domain (thesis §4.4.1 and Fig. 4.12 (b)), which the thesis assumes to be sufficient.
//! Here it is verified: the star of a point is that of the infinite pattern when the circumcircles of its triangles lie
//! where all copies are known. If one does not, the margin is doubled.
//!
//! One whole ring of copies is always enough. Let an empty circle touch a point p of the domain and another site q.
//! Were q more than a period away along an axis, the chord of the circle through p or the one through q would be
//! longer than a period and contain another copy of its point. On mirrored domains the mirror images play that part.

use glam::{DVec2, Vec2};
use spade::handles::{FaceHandle, FixedVertexHandle, PossiblyOuterTag, VertexHandle};
use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation};

use crate::error::Result;
use crate::geometry::{Frame, Site};
use crate::job::{Job, chunks};
use crate::math::square;

/// The first margin, in spacings: slightly more than the diameter of the largest empty circle of a million random
/// points.
const MARGIN: f64 = 4.0;

/// Larger sets are triangulated point by point, which reports progress and can be cancelled. It takes about a quarter
/// longer than spade's bulk load, which does neither.
const BULK: usize = 1 << 17;

/// The number of points that are triangulated between two reports of progress.
const REPORTED: usize = 1 << 12;

impl HasPosition for Site {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        // spade refuses coordinates below 2^-142.
        spade::mitigate_underflow(Point2::new(self.position.x, self.position.y))
    }
}

type Star<'a> = VertexHandle<'a, Site>;

/// The triangulation of the points and of enough of their copies.
pub struct Delaunay {
    triangulation: DelaunayTriangulation<Site>,
    /// The vertex of each point; none for a point that coincides with another.
    vertices: Vec<Option<FixedVertexHandle>>,
}

impl Delaunay {
    /// Triangulates in O(n log n); every original vertex has the star that it has among all copies.
    pub fn new(job: &Job, frame: &Frame, positions: impl Iterator<Item = DVec2> + Clone) -> Result<Self> {
        let (mut margin, mut rest) = (MARGIN, *job);
        loop {
            // The first margin is nearly always enough.
            let attempt = rest.part(0.0, 0.9);
            rest = rest.part(0.9, 1.0);
            let delaunay = Self::within_margin(&attempt.part(0.0, 0.9), frame, positions.clone(), margin)?;
            if delaunay.is_enclosed(&attempt.part(0.9, 1.0), frame, margin)? {
                return Ok(delaunay);
            }
            margin *= 2.0;
        }
    }

    fn within_margin(
        job: &Job,
        frame: &Frame,
        positions: impl Iterator<Item = DVec2> + Clone,
        margin: f64,
    ) -> Result<Self> {
        let count = positions.clone().count();
        let triangulation = triangulate(job, frame.sites(positions, margin))?;
        let mut vertices = vec![None; count];
        for vertex in triangulation.vertices().filter(|vertex| vertex.data().is_original()) {
            vertices[vertex.data().source as usize] = Some(vertex.fix());
        }
        Ok(Self { triangulation, vertices })
    }

    /// The number of points.
    pub fn len(&self) -> usize {
        self.vertices.len()
    }

    /// True if the circumcircles of all triangles at original vertices lie where all copies are known.
    fn is_enclosed(&self, job: &Job, frame: &Frame, margin: f64) -> Result<bool> {
        // Along an axis with a whole ring of copies nothing can be missing.
        let reach = frame.size().map(|length| if margin < length { margin } else { f64::INFINITY });
        let knows = |(centre, radius): (DVec2, f64)| {
            (centre - radius).cmpge(-reach).all() && (centre + radius).cmple(frame.size() + reach).all()
        };
        let star_is_enclosed = |vertex: Star| {
            vertex.out_edges().all(|edge| {
                edge.face().as_inner().is_some_and(|face| {
                    let (centre, radius_squared) = face.circumcircle();
                    knows((DVec2::new(centre.x, centre.y), radius_squared.sqrt()))
                })
            })
        };
        if reach == DVec2::INFINITY {
            return Ok(true);
        }
        let chunks = chunks(self.vertices.len());
        let enclosed = job.map(chunks.len(), |chunk| {
            chunks.range(chunk).filter_map(|point| self.vertex(point)).all(star_is_enclosed)
        })?;
        Ok(enclosed.into_iter().all(|enclosed| enclosed))
    }

    fn vertex(&self, point: usize) -> Option<Star<'_>> {
        self.vertices[point].map(|vertex| self.triangulation.vertex(vertex))
    }

    /// The neighbours of a point, among them copies, and their offsets from it, counter-clockwise.
    pub fn star(&self, point: usize) -> impl Iterator<Item = (Site, DVec2)> {
        let edges = self.vertex(point).into_iter().flat_map(|star| star.out_edges());
        edges.map(|edge| {
            let neighbour = *edge.to().data();
            (neighbour, neighbour.position - edge.from().data().position)
        })
    }

    /// The offsets of the neighbours of a point, counter-clockwise.
    pub fn ring(&self, point: usize) -> impl Iterator<Item = DVec2> {
        self.star(point).map(|(_, offset)| offset)
    }

    /// The points that a point has as neighbours, themselves or as copies, counter-clockwise.
    pub fn neighbours(&self, point: usize) -> impl Iterator<Item = u32> {
        self.star(point).map(|(neighbour, _)| neighbour.source)
    }

    /// The largest distance from the points: the largest circumradius of the triangles that touch one.
    pub fn covering_radius(&self) -> f64 {
        self.circumcircles().map(|(_, radius)| radius).fold(0.0, f64::max)
    }

    /// Centres and radii of the circumcircles of the triangles that touch a point of the domain.
    pub fn circumcircles(&self) -> impl Iterator<Item = (DVec2, f64)> {
        self.triangles().map(|corners| {
            let [a, b, c] = corners.map(|corner| corner.position);
            let (ab, ac) = (b - a, c - a);
            (a + circumcentre(ab, ac), circumradius_squared(ab, ac, b - c).sqrt())
        })
    }

    /// The edges from a point with their duals, those to other points from the first of the two only.
    pub fn duals(&self, point: usize) -> impl Iterator<Item = Dual> {
        let edges = self.vertex(point).into_iter().flat_map(|star| star.out_edges());
        let is_first = move |end: &Site| !end.is_original() || point < end.source as usize;
        edges.filter(move |edge| is_first(edge.to().data())).filter_map(|edge| {
            let circle = |face: FaceHandle<'_, PossiblyOuterTag, Site, (), (), ()>| {
                let (centre, radius_squared) = face.as_inner()?.circumcircle();
                Some((DVec2::new(centre.x, centre.y), radius_squared.sqrt()))
            };
            let circles = [circle(edge.face())?, circle(edge.rev().face())?];
            Some(Dual { ends: [edge.from(), edge.to()].map(|end| end.data().position), circles })
        })
    }

    /// The triangles that touch a point.
    pub fn triangles_at(&self, point: usize) -> impl Iterator<Item = [Site; 3]> {
        let edges = self.vertex(point).into_iter().flat_map(|star| star.out_edges());
        edges.filter_map(|edge| Some(edge.face().as_inner()?.vertices().map(|vertex| *vertex.data())))
    }

    /// The triangles that touch a point of the domain.
    pub fn triangles(&self) -> impl Iterator<Item = [Site; 3]> {
        self.triangulation
            .inner_faces()
            .map(|face| face.vertices().map(|vertex| *vertex.data()))
            .filter(|corners| corners.iter().any(Site::is_original))
    }
}

/// An edge of the triangulation and its dual edge of the Voronoi diagram.
pub struct Dual {
    /// The ends of the edge.
    pub ends: [DVec2; 2],
    /// The circumcircles, centre and radius, of the triangles on its sides: the centres end the dual edge.
    pub circles: [(DVec2, f64); 2],
}

/// The triangulation of sites.
fn triangulate(job: &Job, mut sites: Vec<Site>) -> Result<DelaunayTriangulation<Site>> {
    const ACCEPTED: &str = "sites are finite and neither too large nor too small for spade";
    if sites.len() <= BULK {
        return Ok(DelaunayTriangulation::bulk_load(sites).expect(ACCEPTED));
    }
    job.report(0.0)?;
    along_columns(&mut sites);
    job.report(0.1)?;
    let mut triangulation = DelaunayTriangulation::with_capacity(sites.len(), 3 * sites.len(), 2 * sites.len());
    let (count, mut last) = (sites.len() as f64, None);
    for (sites, done) in sites.chunks(REPORTED).zip(1..) {
        for &site in sites {
            let inserted = match last {
                Some(last) => triangulation.insert_with_hint(site, last),
                None => triangulation.insert(site),
            };
            last = Some(inserted.expect(ACCEPTED));
        }
        job.report((0.1 + 0.9 * (done * REPORTED) as f64 / count).min(1.0))?;
    }
    Ok(triangulation)
}

/// Orders sites so that each is near the one before, however they are spread: up and down columns of equally many.
fn along_columns(sites: &mut [Site]) {
    sites.sort_unstable_by(|a, b| a.position.x.total_cmp(&b.position.x).then(a.position.y.total_cmp(&b.position.y)));
    let size = (2.0 * sites.len() as f64).sqrt().ceil() as usize;
    for (column, sites) in sites.chunks_mut(size.max(1)).enumerate() {
        sites
            .sort_unstable_by(|a, b| a.position.y.total_cmp(&b.position.y).then(a.position.x.total_cmp(&b.position.x)));
        if column % 2 == 1 {
            sites.reverse();
        }
    }
}

/// The centre.
fn circumcentre(a: DVec2, b: DVec2) -> DVec2 {
    (b.length_squared() * a.perp() - a.length_squared() * b.perp()) / (2.0 * a.perp_dot(b))
}

/// The centre in single precision, times `2 a × b`: the caller divides, as the triangle may have no area.
#[inline(always)]
pub fn scaled_circumcentre(a: Vec2, b: Vec2) -> Vec2 {
    b.length_squared() * a.perp() - a.length_squared() * b.perp()
}

/// The square of the radius, of the triangle with the edges `a`, `b` and `a - b`: the product of the edges over four
/// times the area.
pub fn circumradius_squared(a: DVec2, b: DVec2, opposite: DVec2) -> f64 {
    let edges = a.length_squared() * b.length_squared() * opposite.length_squared();
    edges / (4.0 * square(a.perp_dot(b)))
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;
    use std::ops::ControlFlow;

    use super::*;
    use crate::error::Error;
    use crate::job::Context;
    use crate::points::{Boundary, Domain};
    use crate::rng::{Draw, Rng};

    /// Sites in a square and in a small part of it, some of them twice.
    #[test]
    fn point_by_point_gives_what_all_at_once_does() {
        let mut rng = Rng::at(2, Draw::Probe, &[]);
        let mut site = |source: u32| {
            let size = if source.is_multiple_of(2) { 1.0 } else { 1e-3 };
            Site { position: size * DVec2::new(rng.unit(), rng.unit()), source, side: [0, 0] }
        };
        let mut sites: Vec<_> = (0..BULK as u32).map(&mut site).collect();
        sites.extend_from_within(..100);
        let all_at_once = DelaunayTriangulation::<Site>::bulk_load(sites.clone()).unwrap();
        let stopped = Cell::new(0);
        let stop = |_| {
            stopped.set(stopped.get() + 1);
            if stopped.get() == 20 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let context = Context::new(1).unwrap();
        let cancelled = context.run(Some(&stop), |job| triangulate(job, sites.clone()));
        assert!(matches!(cancelled, Err(Error::Cancelled)));
        let one_by_one = context.run(None, |job| triangulate(job, sites)).unwrap();
        let triangles = |of: &DelaunayTriangulation<Site>| {
            let corner = |vertex: VertexHandle<Site>| vertex.data().position.to_array().map(f64::to_bits);
            let mut triangles: Vec<_> = of.inner_faces().map(|face| face.vertices().map(corner)).collect();
            triangles.iter_mut().for_each(|corners| corners.sort_unstable());
            triangles.sort_unstable();
            triangles
        };
        assert!(triangles(&one_by_one) == triangles(&all_at_once));
    }

    /// Sets that are easy, clustered, thin, and so small that a point is a neighbour of its own copies.
    fn cases(boundary: Boundary) -> Vec<(Frame, Vec<DVec2>)> {
        let mut cases = Vec::new();
        for (count, width, cluster) in [
            (200, 1.0, 1.0),
            (60, 30.0, 1.0),
            (60, 1.0, 0.05),
            (60, 20.0, 0.02),
            (1, 1.0, 1.0),
            (2, 1.0, 1.0),
            (3, 5.0, 1.0),
        ] {
            let domain = Domain { min: [0.0; 2], max: [width, 1.0], boundary };
            let frame = Frame::new(domain, count);
            let mut rng = Rng::at(1, Draw::Probe, &[count as u64]);
            let points = (0..count).map(|_| frame.fold(cluster * frame.size() * DVec2::new(rng.unit(), rng.unit())));
            cases.push((frame, points.collect()));
        }
        cases
    }

    fn build(frame: &Frame, points: &[DVec2]) -> Delaunay {
        Context::new(1).unwrap().run(None, |job| Delaunay::new(job, frame, points.iter().copied())).unwrap()
    }

    /// Every copy of the points in two rings around the domain.
    fn two_rings(frame: &Frame, points: &[DVec2]) -> Vec<DVec2> {
        let along = |axis: usize, x: f64, ring: i32| match (frame.boundary(), ring % 2 == 0) {
            (Boundary::Bounded, false) => f64::from(ring + 1) * frame.size()[axis] - x,
            _ => f64::from(ring) * frame.size()[axis] + x,
        };
        let rings = || (-2..=2).flat_map(|i| (-2..=2).map(move |j| (i, j)));
        points.iter().flat_map(|p| rings().map(|(i, j)| DVec2::new(along(0, p.x, i), along(1, p.y, j)))).collect()
    }

    #[test]
    fn no_copy_lies_in_a_circumcircle() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            for (frame, points) in cases(boundary) {
                let copies = two_rings(&frame, &points);
                for corners in build(&frame, &points).triangles() {
                    let [a, b, c] = corners.map(|corner| corner.position);
                    let area = (b - a).perp_dot(c - a);
                    assert!(area > 0.0);
                    for &p in &copies {
                        let [a, b, c] = [a - p, b - p, c - p];
                        let lifted = a.length_squared() * b.perp_dot(c)
                            + b.length_squared() * c.perp_dot(a)
                            + c.length_squared() * a.perp_dot(b);
                        let size = a.length_squared().max(b.length_squared()).max(c.length_squared());
                        assert!(lifted <= 1e-11 * size * size, "{p} in the circle of {corners:?}", corners = [a, b, c]);
                    }
                }
            }
        }
    }

    #[test]
    fn stars_close_and_edges_are_mutual() {
        // The copies of a single point form rectangles, of which either diagonal may be an edge, or none at the point.
        for (frame, points) in cases(Boundary::Periodic).into_iter().filter(|(_, points)| points.len() > 1) {
            let delaunay = build(&frame, &points);
            let mut links = Vec::new();
            for point in 0..points.len() {
                links.extend(delaunay.star(point).map(|(other, offset)| (point as u32, other.source, offset)));
            }
            // Euler on the torus: three edges per point, each seen from both ends.
            assert_eq!(links.len(), 6 * points.len());
            for &(from, to, offset) in &links {
                let back = |&(f, t, o): &(u32, u32, DVec2)| (f, t) == (to, from) && (o + offset).length() < 1e-9;
                assert_eq!(links.iter().filter(|link| back(link)).count(), 1);
            }
        }
    }

    #[test]
    fn all_corners_are_as_far_from_the_centre_as_the_radius_says() {
        for (a, b) in [(DVec2::X, DVec2::Y), (DVec2::new(3.0, -1.0), DVec2::new(0.5, 2.0)), (DVec2::Y, DVec2::X)] {
            let centre = circumcentre(a, b);
            let radius = circumradius_squared(a, b, a - b).sqrt();
            for corner in [DVec2::ZERO, a, b] {
                assert!((corner.distance(centre) - radius).abs() < 1e-12);
            }
            let scaled = scaled_circumcentre(a.as_vec2(), b.as_vec2()).as_dvec2() / (2.0 * a.perp_dot(b));
            assert!(scaled.distance(centre) < 1e-6);
        }
    }
}
