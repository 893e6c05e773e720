//! A local projector: the plane of a chart with its turn and its offset into the pattern, and triangles as it sees them.
//!
//! A point of the pattern hits a triangle if it lies inside it, as the projector sees both, and not nearer to one of its
//! edges than a tolerance. What is that near is a hit for no engine, since there alone they could differ.

use glam::{DVec2, DVec3};

use crate::math::direction;
use crate::rng::Rng;

/// A plane that carries the pattern.
pub struct LocalProjector {
    right: DVec3,
    up: DVec3,
    offset: DVec2,
}

impl LocalProjector {
    /// A plane across an axis, turned and moved at random, that shows lengths at a scale.
    pub fn new(axis: DVec3, scale: f64, rng: &mut Rng) -> Self {
        let (right, up) = axis.any_orthonormal_pair();
        let (right, up) = (scale * right, scale * up);
        let turn = direction(std::f64::consts::TAU * rng.unit());
        let offset = 1024.0 * DVec2::new(rng.unit(), rng.unit());
        Self { right: turn.x * right + turn.y * up, up: turn.x * up - turn.y * right, offset }
    }

    /// The place of a point on the plane.
    #[inline]
    pub fn see(&self, point: DVec3) -> DVec2 {
        DVec2::new(self.right.dot(point), self.up.dot(point)) + self.offset
    }
}

/// A triangle on the plane of a projector.
pub struct SeenTriangle {
    pub corners: [DVec2; 3],
    /// Twice the area, with the sign of its turn.
    area: f64,
    /// The least weights of the three corners in a hit.
    least: [f64; 3],
}

impl SeenTriangle {
    /// A triangle whose hits keep a distance from its edges; `None` if that leaves nothing of it.
    #[inline]
    pub fn new(corners: [DVec2; 3], tolerance: f64) -> Option<Self> {
        let [a, b, c] = corners;
        let area = (b - a).perp_dot(c - a);
        let per_area = tolerance / area.abs();
        let least = [(c - b).length() * per_area, (a - c).length() * per_area, (b - a).length() * per_area];
        // Not a number, where the area is 0.
        (least[0] + least[1] + least[2] < 1.0).then_some(Self { corners, area: area.recip(), least })
    }

    /// The weights of the second and third corner in a point; none unless it is a hit.
    #[inline]
    pub fn barycentrics(&self, point: DVec2) -> Option<[f64; 2]> {
        let [a, b, c] = self.corners;
        let from = point - a;
        let u = from.perp_dot(c - a) * self.area;
        let v = (b - a).perp_dot(from) * self.area;
        let is_hit = (u > self.least[1]) & (v > self.least[2]) & (1.0 - u - v > self.least[0]);
        is_hit.then_some([u, v])
    }

    /// The point with these barycentrics.
    pub fn at(&self, [u, v]: [f64; 2]) -> DVec2 {
        let [a, b, c] = self.corners;
        a + u * (b - a) + v * (c - a)
    }
}
