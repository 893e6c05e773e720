//! The boundary of a bounded domain: a mirror with three exceptions.
//!
//! Mirror images (thesis Fig. 4.12 (b)) close the stars of points at the boundary, and holes there are found exactly:
//! the circle through two points and their images has its centre on the boundary, at the position farthest from all.
//! But images that push like points keep the set half a conflict radius away. It then forms rows along the boundary,
//! like a crystal along a wall, converges late, and covers the boundary badly. The exceptions:
//!
//! * A point's own image pushes only to keep the two from meeting.
//! * So points are nearer to the boundary, on disks that are partly outside. A density that is constant for the long
//!   waves (`torus/waves.rs`) would leave them too sparse: the density wanted at the boundary is a little higher.
//! * In the last steps only the constraints move the points along the boundary. A surplus point there is a surplus in
//!   its image as well: waves push it and its neighbours apart by 0.05 to 0.1 spacings, constraints need five steps to
//!   move them back, and this repeats. Two points were left in conflict in three of a hundred sets of 1,000.

use glam::Vec2;

use crate::dcr::law::{Constraints, Neighbourhood, STIFFENING};
use crate::dcr::torus::{Torus, TorusPoint};

/// The distance, in spacings, below which a point and its own image push each other: enough to keep triangles between
/// them from getting flat, in which points could not move.
const MEETING: f32 = 0.25;

/// The points, per spacing of the boundary, in excess of a constant density. Delaunay neighbours: the lower, the more
/// even is the density, but with 0 the outermost spacing is 8 % sparser than the inside. Nearest: a lower excess widens
/// holes.
const EXCESS: f64 = 0.06;
const EXCESS_OF_NEAREST: f64 = 0.13;

/// The depth, in spacings, of the strip in which only constraints act: about the length of the finest waves that are
/// removed in the last steps.
const STRIP: f32 = 4.0;

/// The boundary of a domain that is on a torus together with its mirror images.
#[derive(Clone, Copy)]
pub struct MirrorBoundary {
    torus: Torus,
    neighbourhood: Neighbourhood,
}

impl MirrorBoundary {
    /// None for a periodic domain.
    pub fn new(torus: &Torus, neighbourhood: Neighbourhood) -> Option<Self> {
        (torus.copies() > 1).then_some(Self { torus: *torus, neighbourhood })
    }

    /// The force on a point, from the sum by all neighbours, its own images among them.
    pub fn force(&self, constraints: &Constraints, place: TorusPoint, sum: Vec2) -> Vec2 {
        Self::force_by_images(constraints, self.torus.own_images(place), sum)
    }

    /// The force on a point, given the offsets to its own images.
    pub fn force_by_images(constraints: &Constraints, images: [Vec2; 2], sum: Vec2) -> Vec2 {
        let meeting = Constraints { conflict_radius: MEETING, ..*constraints };
        let mut force = sum;
        for image in images {
            let (squared, outwards) = (image.length_squared(), image.normalize_or_zero());
            force -= constraints.push(image, squared);
            // By symmetry a point on the boundary is not pushed out, but of a neighbour and its image the triangulation
            // may have only one for a neighbour.
            let held = 1.0 - (image.length() / MEETING).min(1.0);
            force -= held * force.dot(outwards).max(0.0) * outwards;
            force += meeting.push(image, squared);
        }
        force
    }

    /// Once constraints are stiff, removes the drift of points along the boundary; not with nearest neighbours, whose
    /// constraints do not see holes.
    pub fn calm(&self, iterations: u32, places: &[TorusPoint], drift: &mut [Vec2]) {
        if self.neighbourhood == Neighbourhood::Nearest || iterations < STIFFENING {
            return;
        }
        for (drift, &place) in drift.iter_mut().zip(places) {
            if self.torus.own_images(place).iter().any(|image| image.length() < 2.0 * STRIP) {
                *drift = Vec2::ZERO;
            }
        }
    }

    /// The Fourier sum of the excess points for these numbers of waves along the axes of the torus. They are spread
    /// evenly over the boundary and those of the images: along each axis on two lines, at 0 and at half the period.
    pub fn wave(&self, turns: [i64; 2]) -> f64 {
        let size = self.torus.frame.size();
        let excess = self.excess();
        let lines = |axis: usize| {
            let is_constant_along = turns[1 - axis] == 0 && turns[axis] % 2 == 0;
            // Two lines, each with the excess of both of its sides.
            if is_constant_along { 2.0 * 2.0 * excess * size[1 - axis] } else { 0.0 }
        };
        lines(0) + lines(1)
    }

    fn excess(&self) -> f64 {
        match self.neighbourhood {
            Neighbourhood::Delaunay => EXCESS,
            Neighbourhood::Nearest => EXCESS_OF_NEAREST,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use std::f64::consts::TAU;

    use crate::points::{Boundary, Domain};

    fn domain(boundary: Boundary) -> Domain {
        Domain { min: [0.0; 2], max: [3.0, 1.0], boundary }
    }

    #[test]
    fn only_bounded_domains_have_a_boundary() {
        assert!(MirrorBoundary::new(&Torus::new(domain(Boundary::Periodic), 100), Neighbourhood::Delaunay).is_none());
    }

    /// The remaining push of a point's own image, against the distance from each side.
    #[test]
    fn images_push_when_they_are_about_to_meet() {
        let torus = Torus::new(domain(Boundary::Bounded), 100);
        let boundary = MirrorBoundary::new(&torus, Neighbourhood::Delaunay).unwrap();
        let constraints = Constraints { conflict_radius: 0.862, coverage_radius: 0.66, push: 0.4, pull: 0.2 };
        let spacing = torus.frame.spacing();
        for depth in [0.02, 0.1, 0.2, 0.4, 0.5] {
            let near = (depth * spacing) as f32;
            for (point, inwards) in [
                ([near, 0.5], Vec2::X),
                ([3.0 - near, 0.5], -Vec2::X),
                ([1.0, near], Vec2::Y),
                ([1.0, 1.0 - near], -Vec2::Y),
            ] {
                let place = torus.enter(&[point, [1.5, 0.6], [1.4, 0.3]], 0)[0];
                let image = -2.0 * depth as f32 * inwards;
                let pushed = boundary.force(&constraints, place, constraints.push(image, image.length_squared()));
                let expected = 0.4 * (1.0 - 2.0 * depth as f32 / MEETING).max(0.0) * inwards;
                assert!(pushed.distance(expected) < 1e-4, "{point:?}: {pushed}, not {expected}");
            }
        }
    }

    #[test]
    fn waves_leave_the_strip_to_stiff_constraints() {
        let torus = Torus::new(domain(Boundary::Bounded), 1000);
        let spacing = torus.frame.spacing() as f32;
        let depths = [0.1, 3.9, 4.1, 6.0].map(|depth| depth * spacing);
        let points = depths.map(|depth| [[depth, 0.5], [3.0 - depth, 0.5], [1.5, depth], [1.5, 1.0 - depth]]);
        let places = torus.enter(points.as_flattened(), 0);
        let drifts = |neighbourhood, iterations| {
            let mut drift = vec![Vec2::X; places.len()];
            MirrorBoundary::new(&torus, neighbourhood).unwrap().calm(iterations, &places, &mut drift);
            drift
        };
        let moved = vec![Vec2::X; 16];
        assert_eq!(drifts(Neighbourhood::Delaunay, 60), [vec![Vec2::ZERO; 8], moved[8..].to_vec()].concat());
        assert_eq!(drifts(Neighbourhood::Delaunay, 59), moved);
        assert_eq!(drifts(Neighbourhood::Nearest, 60), moved);
    }

    /// Against the sum over points on the lines.
    #[test]
    fn the_wave_of_the_excess_is_that_of_points_on_the_boundary() {
        let torus = Torus::new(domain(Boundary::Bounded), 100);
        let boundary = MirrorBoundary::new(&torus, Neighbourhood::Delaunay).unwrap();
        let count = 60;
        let places = (0..count).flat_map(|i| {
            let along = f64::from(i) / f64::from(count);
            [0.0, 0.5].map(|line| [([line, along], 1), ([along, line], 0)])
        });
        let places: Vec<_> = places.flatten().collect();
        for turns in [[0, 1], [0, 2], [0, -2], [4, 0], [3, 0], [2, 2], [-5, 1]] {
            let wave = |&([x, y], length): &([f64; 2], usize)| {
                let weight = 2.0 * boundary.excess() * torus.frame.size()[length] / f64::from(count);
                weight * (TAU * (x * turns[0] as f64 + y * turns[1] as f64)).cos()
            };
            let sum: f64 = places.iter().map(wave).sum();
            assert!((boundary.wave(turns) - sum).abs() < 1e-9, "{turns:?}: {} {sum}", boundary.wave(turns));
        }
    }
}
