//! Triangle quality of the Delaunay triangulation (thesis §4.4.4 and Fig. 4.21), for remeshing.

use glam::DVec2;

use crate::dcr::delaunay::Delaunay;
use crate::dcr::frame::{Frame, Site};
use crate::error::Result;
use crate::job::Context;
use crate::points::{Boundary, Domain};

/// What the triangles of a set are like. On a torus there are twice as many as points; on a bounded domain those count
/// that do not cross the border when the set is mirrored by it, so there are no slivers along the convex hull.
///
/// Shares and variations of nothing are 0. Lattices with more than three points on an empty circle have more than one
/// triangulation, which need not be the same on both sides of the torus: there the figures are of a mixture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TriangleStatistics {
    /// The number of triangles.
    pub triangles: u64,
    /// The share of triangles with an angle above 90 degrees.
    pub obtuse: f64,
    /// The share of triangles with an angle below 30 degrees.
    pub below_30_degrees: f64,
    /// The mean length of the edges.
    pub edge_mean: f64,
    /// The variance of the edge lengths over the square of their mean (CV²).
    pub edge_variation: f64,
    /// The variance of the triangle areas over the square of their mean.
    pub area_variation: f64,
}

/// Measures the Delaunay triangles of a set. Takes O(n log n).
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for a domain that is none and for points outside it (`xy`).
pub fn triangle_statistics(context: &Context, domain: &Domain, points: &[[f32; 2]]) -> Result<TriangleStatistics> {
    domain.check()?;
    domain.check_points(points)?;
    if points.is_empty() {
        return Ok(TriangleStatistics::default());
    }
    let frame = Frame::new(*domain, points.len());
    let positions = frame.enter(points);
    let delaunay = context.run(None, |job| Delaunay::new(job, &frame, positions.iter().copied()))?;

    let (mut obtuse, mut sharp) = (0.0, 0.0);
    let (mut areas, mut edges) = (Moments::default(), Moments::default());
    for corners in delaunay.triangles() {
        let weight = weight(domain.boundary, &corners);
        let corners = corners.map(|corner| corner.position);
        let cosines = cosines(corners);
        obtuse += weight * f64::from(cosines.iter().any(|&cosine| cosine < 0.0));
        sharp += weight * f64::from(cosines.iter().any(|&cosine| cosine > 0.75f64.sqrt()));
        areas.add((corners[1] - corners[0]).perp_dot(corners[2] - corners[0]) / 2.0, weight);
        // Inner edges come twice, once with each of their triangles.
        (0..3).for_each(|i| edges.add(corners[i].distance(corners[(i + 1) % 3]), weight));
    }
    let share = |part: f64| if areas.weight > 0.0 { part / areas.weight } else { 0.0 };
    Ok(TriangleStatistics {
        triangles: areas.weight.round() as u64,
        obtuse: share(obtuse),
        below_30_degrees: share(sharp),
        edge_mean: edges.mean() * frame.spacing(),
        edge_variation: edges.variation(),
        area_variation: areas.variation(),
    })
}

/// How much a triangle counts: on a torus each comes once for every corner that is a point and not a copy.
fn weight(boundary: Boundary, corners: &[Site; 3]) -> f64 {
    let originals = corners.iter().filter(|corner| corner.is_original()).count();
    match boundary {
        Boundary::Periodic => originals as f64 / 3.0,
        Boundary::Bounded => f64::from(originals == 3),
    }
}

/// The cosines of the angles.
fn cosines(corners: [DVec2; 3]) -> [f64; 3] {
    std::array::from_fn(|i| {
        let side = |other: usize| (corners[(i + other) % 3] - corners[i]).normalize_or_zero();
        side(1).dot(side(2))
    })
}

/// Weighted sums of a quantity and of its square.
#[derive(Default)]
struct Moments {
    weight: f64,
    sum: f64,
    squares: f64,
}

impl Moments {
    fn add(&mut self, x: f64, weight: f64) {
        self.weight += weight;
        self.sum += weight * x;
        self.squares += weight * x * x;
    }

    fn mean(&self) -> f64 {
        if self.weight > 0.0 { self.sum / self.weight } else { 0.0 }
    }

    /// The variance over the square of the mean.
    fn variation(&self) -> f64 {
        let mean = self.mean();
        if mean > 0.0 { (self.squares / self.weight / (mean * mean) - 1.0).max(0.0) } else { 0.0 }
    }
}
