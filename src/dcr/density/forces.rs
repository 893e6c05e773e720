//! Forces where the spacing varies: the constraints of the momentum method, with distances in units of the mean spacing
//! of the two points, circumradii in units of the spacing that the density at the centre asks for, and displacements in
//! units of the point's own spacing.
//!
//! Holes are judged by the density itself because a spacing whose growth is limited is too small beside edges: with it,
//! holes would pull dots out of dark areas, and the error of tone is three to ten times as large.

use glam::Vec2;

use crate::dcr::ground::constraints::{Constraints, Force};
use crate::geometry::scaled_circumcentre;
use crate::math::square;

/// A neighbour in the ring around a point: its offset and its local spacing.
#[derive(Clone, Copy)]
pub(super) struct RingPoint {
    pub(super) offset: Vec2,
    pub(super) spacing: f32,
}

/// The force on a point, in units of its spacing, by the neighbours in the ring around it, in counter-clockwise order;
/// `density_at` gives the density, in units of the mean, at an offset from the point.
pub(super) fn force(
    constraints: &Constraints,
    spacing: f32,
    ring: &[RingPoint],
    density_at: impl Fn(Vec2) -> f32,
) -> Force {
    let (mut sum, mut clearance) = (Vec2::ZERO, f32::INFINITY);
    let Some(&(mut before)) = ring.last() else { return Force { sum, clearance } };
    for &neighbour in ring {
        let offset = neighbour.offset / (0.5 * (spacing + neighbour.spacing));
        sum += constraints.push(offset, offset.length_squared());
        let (a, b) = (before.offset, neighbour.offset);
        let (area, longest) = (a.perp_dot(b), a.length_squared().max(b.length_squared()).max(a.distance_squared(b)));
        clearance = clearance.min(area.max(0.0) / longest.sqrt());
        sum += pull(constraints, spacing.min(before.spacing).min(neighbour.spacing), a, b, &density_at);
        before = neighbour;
    }
    Force { sum, clearance }
}

/// The force by the triangle of a point and two neighbours, the least of whose spacings is given: none unless its
/// circumradius is too large for the spacing at its centre.
fn pull(constraints: &Constraints, least: f32, a: Vec2, b: Vec2, density_at: impl Fn(Vec2) -> f32) -> Vec2 {
    let area = a.perp_dot(b);
    // The circumradius is the product of the edges over twice this area.
    let edges = a.length_squared() * b.length_squared() * a.distance_squared(b);
    if edges <= square(2.0 * least * constraints.coverage_radius * area) {
        return Vec2::ZERO;
    }
    let centre = scaled_circumcentre(a, b) / (2.0 * area);
    if !centre.is_finite() {
        return Vec2::ZERO;
    }
    let scale = density_at(centre).sqrt();
    if scale * centre.length() > constraints.coverage_radius {
        constraints.pull(scale * a, scale * b, scale * scale * area)
    } else {
        Vec2::ZERO
    }
}
