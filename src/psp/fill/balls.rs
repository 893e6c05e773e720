//! Balls around groups of triangles: where one sample covers the ball, a pass need not look at the triangles.
//!
//! They are kept with the mesh from its second pass on, which gains more by them than they cost, if triangles that follow
//! each other lie together. One pass alone would not. What a pass finds open is the same with them and without.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use glam::Vec3A;

use crate::mesh::{Mesh, exact, rounded_up};
use crate::psp::fill::triangles::Triangles;

/// A ball, in the unit of the mesh.
#[derive(Clone, Copy, Debug)]
pub(in crate::psp) struct Ball {
    pub centre: [f32; 3],
    pub radius: f32,
}

/// How many balls are looked at to see whether all are worth making, ...
const PROBES: usize = 64;
/// ... and which part of a sample's radius half of them may have at most.
const LARGEST: f64 = 0.5;

/// A ball around each group of the triangles of a mesh, once there are any.
#[derive(Default)]
pub(in crate::psp) struct Balls {
    /// Whether there was a pass.
    is_second: AtomicBool,
    /// Whether a thread makes them, or has made them.
    is_begun: AtomicBool,
    made: OnceLock<Vec<Ball>>,
}

impl Balls {
    /// The balls, by groups, for a pass at a radius: none in the first one. No thread waits while another one makes them.
    pub fn get(&self, mesh: &Mesh, triangles: Triangles, radius: f64) -> Option<&[Ball]> {
        let is_second = self.is_second.swap(true, Ordering::Relaxed);
        if is_second && self.made.get().is_none() && are_small(mesh, triangles, radius) {
            let is_begun = self.is_begun.swap(true, Ordering::Relaxed);
            let balls = || (0..triangles.groups()).map(|group| Ball::around(mesh, triangles, group)).collect();
            return (!is_begun).then(|| self.made.get_or_init(balls).as_slice());
        }
        self.made.get().map(Vec::as_slice)
    }
}

/// Whether balls are small beside the radius: half of some, all over the mesh.
fn are_small(mesh: &Mesh, triangles: Triangles, radius: f64) -> bool {
    let probes = PROBES.min(triangles.groups());
    let ball = |probe: usize| Ball::around(mesh, triangles, probe * triangles.groups() / probes);
    let small = (0..probes).filter(|&probe| f64::from(ball(probe).radius) <= LARGEST * radius).count();
    2 * small >= probes
}

impl Ball {
    /// The ball around the box of a group.
    fn around(mesh: &Mesh, triangles: Triangles, group: usize) -> Self {
        let (mut low, mut high) = (Vec3A::INFINITY, Vec3A::NEG_INFINITY);
        for index in triangles.group(group) {
            let [a, b, c] = mesh.corners(triangles.at(index)).map(Vec3A::from_array);
            low = low.min(a.min(b.min(c)));
            high = high.max(a.max(b.max(c)));
        }
        // Halved first: their sum may be no float.
        let centre = (0.5 * low + 0.5 * high).to_array();
        let [from_low, from_high] = [low, high].map(|end| (exact(end.to_array()) - exact(centre)).abs());
        // Beyond the roundings of squares, sums and root.
        let radius = from_low.max(from_high).length() * (1.0 + 1e-15);
        Self { centre, radius: rounded_up(radius) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    /// Of all sizes that floats have, and down to points.
    #[test]
    fn each_ball_holds_its_group_and_not_much_more() {
        let mut rng = Rng::at(6, Draw::Probe, &[]);
        for size in [1e-44, 1e-20, 1.0, 3e38] {
            let positions: Vec<[f32; 3]> = (0..300)
                .map(|i| [(); 3].map(|()| (size * (0.5 + i as f64 / 700.0 - 0.1 * rng.unit())) as f32))
                .collect();
            let mesh = Mesh::new(positions, (0..100).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).unwrap();
            let (balls, triangles) = (Balls::default(), Triangles::All(100));
            assert!(balls.get(&mesh, triangles, size).is_none(), "in the first pass");
            assert!(balls.get(&mesh, triangles, 1e-3 * size).is_none(), "larger than samples");
            for _ in 0..2 {
                let balls = balls.get(&mesh, triangles, size).unwrap();
                assert_eq!(balls.len(), triangles.groups());
                for (group, ball) in balls.iter().enumerate() {
                    let corners = triangles.group(group).flat_map(|index| mesh.exact_corners(index as u32));
                    let farthest = corners.map(|corner| corner.distance(exact(ball.centre))).fold(0.0, f64::max);
                    assert!(farthest <= ball.radius.into(), "{ball:?} {farthest}");
                    assert!(f64::from(ball.radius) <= 2.0 * farthest + 3e-45, "{ball:?} {farthest}");
                }
            }
        }
    }
}
