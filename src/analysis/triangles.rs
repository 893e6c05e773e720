//! Triangle quality of the Delaunay triangulation (thesis §4.4.4 and Fig. 4.21), for remeshing.

use glam::DVec2;

use crate::dcr::delaunay::Delaunay;
use crate::dcr::frame::{Frame, Site};
use crate::error::Result;
use crate::job::Context;
use crate::mesh::exact;
use crate::points::{Boundary, Domain};

/// A triangle of the Delaunay triangulation of a set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// The corners, counter-clockwise, in the units of the domain.
    pub corners: [[f64; 2]; 3],
}

impl Triangle {
    /// A triangle of space, laid into the plane: the first corner at 0, the second on the x axis.
    pub fn in_space(corners: [[f32; 3]; 3]) -> Self {
        let [a, b, c] = corners.map(exact);
        let (x, length) = ((b - a).normalize_or_zero(), (b - a).length());
        let along = (c - a).dot(x);
        Self { corners: [[0.0; 2], [length, 0.0], [along, (c - a - along * x).length()]] }
    }

    /// The area, in the units of the domain.
    pub fn area(&self) -> f64 {
        let [a, b, c] = self.corners.map(DVec2::from_array);
        (b - a).perp_dot(c - a) / 2.0
    }

    /// Whether an angle is above 90 degrees.
    pub fn is_obtuse(&self) -> bool {
        self.cosines().iter().any(|&cosine| cosine < 0.0)
    }

    /// The lengths of the edges.
    pub fn edges(&self) -> [f64; 3] {
        let corners = self.corners.map(DVec2::from_array);
        std::array::from_fn(|i| corners[i].distance(corners[(i + 1) % 3]))
    }

    /// The cosines of the angles.
    fn cosines(&self) -> [f64; 3] {
        let corners = self.corners.map(DVec2::from_array);
        std::array::from_fn(|i| {
            let side = |other: usize| (corners[(i + other) % 3] - corners[i]).normalize_or_zero();
            side(1).dot(side(2))
        })
    }
}

/// The Delaunay triangles of a set, each once. Takes O(n log n).
///
/// On a torus there are twice as many as points, and those that lie across the border reach out of the domain on one of the
/// sides. On a bounded domain those are left out that cross the border when the set is mirrored by it, so there are no
/// slivers along the convex hull.
///
/// Lattices with more than three points on an empty circle have more than one triangulation, which need not be the same on
/// both sides of the torus: there some triangles may be missing and others overlap.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for a domain that is none and for points outside it (`xy`).
pub fn delaunay_triangles(context: &Context, domain: &Domain, points: &[[f32; 2]]) -> Result<Vec<Triangle>> {
    domain.check()?;
    domain.check_points(points)?;
    if points.is_empty() {
        return Ok(Vec::new());
    }
    let frame = Frame::new(*domain, points.len());
    let positions = frame.enter(points);
    let delaunay = context.run(None, |job| Delaunay::new(job, &frame, positions.iter().copied()))?;
    let place = |corner: Site| (DVec2::from_array(domain.min) + corner.position * frame.spacing()).to_array();
    let counted = delaunay.triangles().filter(|corners| is_counted(domain.boundary, corners));
    Ok(counted.map(|corners| Triangle { corners: corners.map(place) }).collect())
}

/// Whether a triangle is the one of its images that counts: on a torus that whose first corner is a point of the domain,
/// first by its number and then by its place, which orders the images of a point in the same way on every side.
fn is_counted(boundary: Boundary, corners: &[Site; 3]) -> bool {
    let order = |a: &&Site, b: &&Site| {
        let by_place = a.position.x.total_cmp(&b.position.x).then(a.position.y.total_cmp(&b.position.y));
        a.source.cmp(&b.source).then(by_place)
    };
    match boundary {
        Boundary::Periodic => corners.iter().min_by(order).is_some_and(Site::is_original),
        Boundary::Bounded => corners.iter().all(Site::is_original),
    }
}

/// What the triangles of a set are like, as [`delaunay_triangles`] gives them. Shares and variations of nothing are 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TriangleStatistics {
    /// The number of triangles.
    pub triangles: u64,
    /// The share of triangles with an angle above 90 degrees.
    pub obtuse: f64,
    /// The share of triangles with an angle below 30 degrees.
    pub below_30_degrees: f64,
    /// The share of angles below 30 degrees.
    pub angles_below_30_degrees: f64,
    /// The mean length of the edges, in the units of the domain.
    pub edge_mean: f64,
    /// The variance of the edge lengths over the square of their mean (CV²).
    pub edge_variation: f64,
    /// The variance of the triangle areas over the square of their mean.
    pub area_variation: f64,
    /// The share of triangles whose area is more than 4 standard deviations from the mean: those of this set.
    pub beyond_4_sigma: f64,
}

/// Measures the Delaunay triangles of a set. Takes O(n log n).
///
/// # Errors
/// As [`delaunay_triangles`].
pub fn triangle_statistics(context: &Context, domain: &Domain, points: &[[f32; 2]]) -> Result<TriangleStatistics> {
    Ok(TriangleStatistics::of(&delaunay_triangles(context, domain, points)?))
}

impl TriangleStatistics {
    /// Measures any triangles, as those of the samples of a surface
    /// ([`dcr::surface::triangulate`](crate::dcr::surface::triangulate)).
    pub fn of(triangles: &[Triangle]) -> Self {
        let [mut areas, mut edges] = [Moments::default(); 2];
        let (mut obtuse, mut sharp, mut sharp_angles) = (0, 0, 0);
        for triangle in triangles {
            areas.add(triangle.area());
            // Inner edges come twice, once with each of their triangles.
            triangle.edges().into_iter().for_each(|edge| edges.add(edge));
            let angles = triangle.cosines().into_iter().filter(|&cosine| cosine > 0.75f64.sqrt()).count();
            obtuse += usize::from(triangle.is_obtuse());
            sharp += usize::from(angles > 0);
            sharp_angles += angles;
        }
        let limit = SIGMAS * areas.variation().sqrt() * areas.mean();
        let outlying = triangles.iter().filter(|triangle| (triangle.area() - areas.mean()).abs() > limit).count();
        let share = |part: usize| part as f64 / triangles.len().max(1) as f64;
        Self {
            triangles: triangles.len() as u64,
            obtuse: share(obtuse),
            below_30_degrees: share(sharp),
            angles_below_30_degrees: share(sharp_angles) / 3.0,
            edge_mean: edges.mean(),
            edge_variation: edges.variation(),
            area_variation: areas.variation(),
            beyond_4_sigma: share(outlying),
        }
    }
}

/// From how many standard deviations on an area is outlying.
const SIGMAS: f64 = 4.0;

/// Sums of a quantity and of its square.
#[derive(Clone, Copy, Default)]
struct Moments {
    count: f64,
    sum: f64,
    squares: f64,
}

impl Moments {
    fn add(&mut self, x: f64) {
        self.count += 1.0;
        self.sum += x;
        self.squares += x * x;
    }

    fn mean(&self) -> f64 {
        if self.count > 0.0 { self.sum / self.count } else { 0.0 }
    }

    /// The variance over the square of the mean.
    fn variation(&self) -> f64 {
        let mean = self.mean();
        if mean > 0.0 { (self.squares / self.count / (mean * mean) - 1.0).max(0.0) } else { 0.0 }
    }
}
