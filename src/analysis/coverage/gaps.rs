//! The gaps of a set in the plane, counted by its Voronoi diagram.
//!
//! Away from its nearest point one gets, ever farther from all of them, to an edge of the Voronoi diagram, and along it to
//! one of its vertices. So each connected part of the uncovered places has a vertex in it, a circumcentre of a Delaunay
//! triangle, and two vertices are in one part when edges without a covered place lead from one to the other. An edge is
//! nearest to its two points half-way between them, where it crosses their connection, or else at an end.
//!
//! In a bounded domain the mirror images of the points are never nearer than the points, so that the diagram of all of
//! them, which the border divides, is the one inside.

use glam::DVec2;

use super::groups::Groups;
use crate::dcr::delaunay::{Delaunay, Dual};
use crate::dcr::frame::Frame;
use crate::error::Result;
use crate::grid2::Grid2;
use crate::job::Context;
use crate::points::Domain;

/// Circumcentres closer than this, in mean spacings, are one: copies of one on the other side of a torus, and those of
/// more than three points on one circle.
const SAME: f64 = 1e-6;

/// The number of connected parts of the domain farther than `radius` from all points, of which there is at least one.
pub(super) fn count(context: &Context, domain: &Domain, points: &[[f32; 2]], radius: f64) -> Result<usize> {
    let frame = Frame::new(*domain, points.len());
    let positions = frame.enter(points);
    let radius = radius / frame.spacing();
    let delaunay = context.run(None, |job| Delaunay::new(job, &frame, positions.iter().copied()))?;
    let mut vertices: Vec<[f64; 2]> = Vec::new();
    let mut links = Vec::new();
    for dual in delaunay.duals() {
        let uncovered = dual.circles.map(|(_, reach)| reach > radius);
        let first = vertices.len() as u32;
        for ((centre, _), uncovered) in std::iter::zip(dual.circles, uncovered) {
            if uncovered {
                vertices.push(frame.fold(centre).to_array());
            }
        }
        if uncovered == [true, true] && (dual.half_length() > radius || !dual.crosses_its_edge()) {
            links.push([first, first + 1]);
        }
    }
    let mut gaps = Groups::new(vertices.len());
    links.iter().for_each(|&[a, b]| gaps.link(a, b));
    let [width, height] = frame.size().to_array();
    let torus = Domain { min: [0.0; 2], max: [width, height], boundary: domain.boundary };
    let grid = Grid2::new(torus, vertices.iter().copied(), 1.0);
    for &(vertex, place) in grid.entries() {
        grid.for_each_within(place, SAME, |other, _, _| gaps.link(vertex, other));
    }
    Ok(gaps.count())
}

impl Dual {
    /// Half of the length of the Delaunay edge.
    fn half_length(&self) -> f64 {
        0.5 * self.ends[0].distance(self.ends[1])
    }

    /// Whether the Voronoi edge crosses the Delaunay edge: whether its ends are on different sides.
    fn crosses_its_edge(&self) -> bool {
        let side = |(centre, _): (DVec2, f64)| (self.ends[1] - self.ends[0]).perp_dot(centre - self.ends[0]);
        side(self.circles[0]) * side(self.circles[1]) <= 0.0
    }
}
