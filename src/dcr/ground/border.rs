//! The border of a bounded domain, where it is more than a mirror.
//!
//! Mirror images (thesis Fig. 4.12 (b)) close the stars of points at the border, and holes there are found exactly: the
//! circle through two points and their images has its centre on the border, at the place that is farthest from all. But
//! images that push like points keep the set half a conflict radius away. It then stands in rows along the border, like
//! a crystal along a wall, finds them late, and covers the border badly. So the border differs from a mirror by three things:
//!
//! * A point's own image is no other point, and pushes only to keep the two from meeting.
//! * Points now stand nearer to the border, on disks that are partly outside. The density that is constant for the long
//!   waves (`waves.rs`) would leave them too sparse: the border is given a few points more.
//! * In the end the constraints have the points along the border to themselves. A point too many there is one too many in
//!   its image as well. Waves push it and its neighbours apart by 0.05 to 0.1 spacings, constraints take five steps to bring
//!   them back, and so it goes on: two points were left in conflict in three of a hundred sets of 1,000.

use glam::Vec2;

use crate::dcr::Neighbourhood;
use crate::dcr::ground::constraints::{Constraints, STIFFENING};
use crate::dcr::ground::torus::{Place, Torus};

/// The distance, in spacings, below which a point and its own image push each other: enough to keep triangles between them
/// from getting flat, in which points would have no room to move.
const MEETING: f32 = 0.25;

/// The points, per spacing of the border, that there are more than a constant density gives. Delaunay neighbours: the less,
/// the evener is the density, but without them the outermost spacing is 8 % sparser than the inside. Nearest: with less,
/// there are wider holes.
const EXCESS: f64 = 0.06;
const EXCESS_OF_NEAREST: f64 = 0.13;

/// The depth, in spacings, of the strip that is left to the constraints: about the length of the finest waves that are
/// removed in the end.
const STRIP: f32 = 4.0;

/// The border of a domain that stands on a torus beside its mirror images.
#[derive(Clone, Copy)]
pub(in crate::dcr) struct Border {
    torus: Torus,
    neighbourhood: Neighbourhood,
}

impl Border {
    /// None for a periodic domain.
    pub(crate) fn new(torus: &Torus, neighbourhood: Neighbourhood) -> Option<Self> {
        (torus.copies() > 1).then_some(Self { torus: *torus, neighbourhood })
    }

    /// The force on a point, from that by all neighbours of which its own images were some.
    pub(crate) fn force(&self, constraints: &Constraints, place: Place, sum: Vec2) -> Vec2 {
        Self::force_by_images(constraints, self.torus.own_images(place), sum)
    }

    /// The same, given the ways to its own images.
    pub(in crate::dcr) fn force_by_images(constraints: &Constraints, images: [Vec2; 2], sum: Vec2) -> Vec2 {
        let meeting = Constraints { conflict_radius: MEETING, ..*constraints };
        let mut force = sum;
        for image in images {
            let (squared, outwards) = (image.length_squared(), image.normalize_or_zero());
            force -= constraints.push(image, squared);
            // By symmetry a point on the border is not pushed out, but of a neighbour and its image the triangulation may
            // have only one for a neighbour.
            let held = 1.0 - (image.length() / MEETING).min(1.0);
            force -= held * force.dot(outwards).max(0.0) * outwards;
            force += meeting.push(image, squared);
        }
        force
    }

    /// Once constraints are stiff, takes the drift from points along the border; not where constraints are blind for holes.
    pub(crate) fn calm(&self, iterations: u32, places: &[Place], drift: &mut [Vec2]) {
        if self.neighbourhood == Neighbourhood::Nearest || iterations < STIFFENING {
            return;
        }
        for (drift, &place) in drift.iter_mut().zip(places) {
            if self.torus.own_images(place).iter().any(|image| image.length() < 2.0 * STRIP) {
                *drift = Vec2::ZERO;
            }
        }
    }

    /// The Fourier sum of the points that the border has more than a constant density gives, for so many waves along the
    /// axes of the torus. They stand evenly on the borders and those of the images: along each axis on two lines, at 0 and
    /// at half the period.
    pub(crate) fn wave(&self, turns: [i64; 2]) -> f64 {
        let size = self.torus.frame.size();
        let excess = self.excess();
        let lines = |axis: usize| {
            let sees_them = turns[1 - axis] == 0 && turns[axis] % 2 == 0;
            // Two lines, and on each of them the excess of both of its sides.
            if sees_them { 2.0 * 2.0 * excess * size[1 - axis] } else { 0.0 }
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
    use std::f64::consts::TAU;

    use super::*;
    use crate::points::{Boundary, Domain};

    fn domain(boundary: Boundary) -> Domain {
        Domain { min: [0.0; 2], max: [3.0, 1.0], boundary }
    }

    #[test]
    fn only_bounded_domains_have_a_border() {
        assert!(Border::new(&Torus::new(domain(Boundary::Periodic), 100), Neighbourhood::Delaunay).is_none());
    }

    /// What is left of the push of a point's own image, against the distance from each side.
    #[test]
    fn images_push_when_they_are_about_to_meet() {
        let torus = Torus::new(domain(Boundary::Bounded), 100);
        let border = Border::new(&torus, Neighbourhood::Delaunay).unwrap();
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
                let pushed = border.force(&constraints, place, constraints.push(image, image.length_squared()));
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
            Border::new(&torus, neighbourhood).unwrap().calm(iterations, &places, &mut drift);
            drift
        };
        let moved = vec![Vec2::X; 16];
        assert_eq!(drifts(Neighbourhood::Delaunay, 60), [vec![Vec2::ZERO; 8], moved[8..].to_vec()].concat());
        assert_eq!(drifts(Neighbourhood::Delaunay, 59), moved);
        assert_eq!(drifts(Neighbourhood::Nearest, 60), moved);
    }

    /// Against the sum over points that stand on the lines.
    #[test]
    fn the_wave_of_the_excess_is_that_of_points_on_the_border() {
        let torus = Torus::new(domain(Boundary::Bounded), 100);
        let border = Border::new(&torus, Neighbourhood::Delaunay).unwrap();
        let count = 60;
        let places = (0..count).flat_map(|i| {
            let along = f64::from(i) / f64::from(count);
            [0.0, 0.5].map(|line| [([line, along], 1), ([along, line], 0)])
        });
        let places: Vec<_> = places.flatten().collect();
        for turns in [[0, 1], [0, 2], [0, -2], [4, 0], [3, 0], [2, 2], [-5, 1]] {
            let wave = |&([x, y], length): &([f64; 2], usize)| {
                let weight = 2.0 * border.excess() * torus.frame.size()[length] / f64::from(count);
                weight * (TAU * (x * turns[0] as f64 + y * turns[1] as f64)).cos()
            };
            let sum: f64 = places.iter().map(wave).sum();
            assert!((border.wave(turns) - sum).abs() < 1e-9, "{turns:?}: {} {sum}", border.wave(turns));
        }
    }
}
