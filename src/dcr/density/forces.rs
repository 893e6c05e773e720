//! What neighbours do to a point where the spacing varies: the constraints of the best method, with lengths in units of
//! the mean spacing of those who are concerned, and displacements in the point's own.

use glam::Vec2;

use crate::dcr::spread::constraints::{Constraints, Force};

/// A neighbour: the way to it, and its local spacing.
#[derive(Clone, Copy)]
pub(super) struct Neighbour {
    pub(super) offset: Vec2,
    pub(super) spacing: f32,
}

/// The force on a point with this spacing by the neighbours on a ring around it, in counter-clockwise order.
pub(super) fn force(constraints: &Constraints, spacing: f32, ring: &[Neighbour]) -> Force {
    let (mut sum, mut room) = (Vec2::ZERO, f32::INFINITY);
    let Some(&(mut before)) = ring.last() else { return Force { sum, room } };
    for &neighbour in ring {
        let offset = neighbour.offset / (0.5 * (spacing + neighbour.spacing));
        sum += constraints.push(offset, offset.length_squared());
        let (a, b) = (before.offset, neighbour.offset);
        let mean = (spacing + before.spacing + neighbour.spacing) / 3.0;
        sum += pull(constraints, a / mean, b / mean);
        let longest = a.length_squared().max(b.length_squared()).max(a.distance_squared(b));
        room = room.min(a.perp_dot(b).max(0.0) / longest.sqrt());
        before = neighbour;
    }
    Force { sum: spacing * sum, room }
}

/// The force by the triangle of a point and two neighbours.
fn pull(constraints: &Constraints, a: Vec2, b: Vec2) -> Vec2 {
    let area = a.perp_dot(b);
    // The circumradius is the product of the edges over twice this area.
    let edges = a.length_squared() * b.length_squared() * a.distance_squared(b);
    let is_hole = edges > (2.0 * constraints.coverage_radius * area).powi(2);
    if is_hole { constraints.pull(a, b, area) } else { Vec2::ZERO }
}
