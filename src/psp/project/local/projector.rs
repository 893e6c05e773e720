//! A local projector: the plane of a chart with its turn and its offset into the pattern, and triangles as it sees them.
//!
//! A point of the pattern hits a triangle if it lies inside it, as the projector sees both, and not nearer to one of its
//! edges than a tolerance. What is that near is a hit for no engine, since there alone they could differ.

use glam::{DVec2, DVec3};

use crate::math::direction;
use crate::psp::project::local::torus::PATTERNS;
use crate::rng::{Draw, Rng};

/// The shift of all blocks in an iteration, in their sides.
pub fn shift_of_blocks(seed: u64, iteration: u32) -> [f64; 3] {
    let mut rng = Rng::at(seed, Draw::Charts, &[iteration.into()]);
    [(); 3].map(|()| rng.unit())
}

/// A plane that carries a pattern.
pub struct LocalProjector {
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    offset: DVec2,
    scale: f64,
    /// The number of its pattern.
    pub pattern: usize,
}

impl LocalProjector {
    /// The plane across the axis of a chart, at its place: the iteration, the cube and its number.
    pub fn at(seed: u64, place: &[u64], axis: DVec3, scale: f64) -> Self {
        Self::new(axis, scale, &mut Rng::at(seed, Draw::Charts, place))
    }

    /// A plane across an axis, turned and moved at random, that shows lengths at a scale.
    fn new(axis: DVec3, scale: f64, rng: &mut Rng) -> Self {
        let (right, up) = axis.any_orthonormal_pair();
        let (right, up) = (scale * right, scale * up);
        let turn = direction(std::f64::consts::TAU * rng.unit());
        let offset = 1024.0 * DVec2::new(rng.unit(), rng.unit());
        let (right, up) = (turn.x * right + turn.y * up, turn.x * up - turn.y * right);
        Self { right, up, forward: axis, offset, scale, pattern: rng.below(PATTERNS as u64) as usize }
    }

    /// The axis.
    pub fn forward(&self) -> DVec3 {
        self.forward
    }

    /// The point above a place, on the plane through the origin.
    pub fn lift(&self, place: DVec2) -> DVec3 {
        let DVec2 { x, y } = (place - self.offset) / (self.scale * self.scale);
        x * self.right + y * self.up
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hits_are_the_points_that_keep_the_tolerance_from_all_edges() {
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        let (mut hits, mut nothing) = (0, 0);
        for round in 0..20_000 {
            let tolerance = [0.0, 1e-6, 0.1, 1.0][round % 4];
            let mut place = || 10.0 * DVec2::new(rng.unit(), rng.unit());
            let (corners, point) = ([place(), place(), place()], place());
            let distance = |from: DVec2, to: DVec2| (to - from).perp_dot(point - from) / (to - from).length();
            let [a, b, c] = corners;
            let turn = (b - a).perp_dot(c - a).signum();
            let depth = [(a, b), (b, c), (c, a)].map(|(from, to)| turn * distance(from, to));
            let depth = depth.into_iter().fold(f64::INFINITY, f64::min);
            let Some(seen) = SeenTriangle::new(corners, tolerance) else {
                assert!(depth < tolerance + 1e-9);
                nothing += 1;
                continue;
            };
            match seen.barycentrics(point) {
                Some(barycentrics) => {
                    assert!(depth > tolerance - 1e-9);
                    assert!(seen.at(barycentrics).distance(point) < 1e-9);
                    hits += 1;
                }
                None => assert!(depth < tolerance + 1e-9, "{depth} {tolerance}"),
            }
        }
        assert!(hits > 500 && nothing > 100, "{hits} {nothing}");
        assert!(SeenTriangle::new([DVec2::ZERO, DVec2::ONE, 2.0 * DVec2::ONE], 0.0).is_none());
    }

    #[test]
    fn a_projector_never_makes_distances_longer() {
        let mut rng = Rng::at(2, Draw::Probe, &[]);
        for _ in 0..2000 {
            let mut place = |size: f64| size * (DVec3::new(rng.unit(), rng.unit(), rng.unit()) - 0.5);
            let (axis, a, b) = (place(1.0).normalize(), place(50.0), place(50.0));
            let projector = LocalProjector::new(axis, 0.75, &mut rng);
            let (seen, true_distance) = (projector.see(a).distance(projector.see(b)), a.distance(b));
            let across = (b - a).reject_from(axis).length();
            assert!((seen - 0.75 * across).abs() < 1e-9 && seen <= 0.75 * true_distance + 1e-9);
            let lifted = projector.lift(projector.see(a));
            assert!(projector.see(lifted).distance(projector.see(a)) < 1e-9 && lifted.dot(axis).abs() < 1e-9);
        }
    }
}
