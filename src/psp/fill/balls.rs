//! Balls around groups of triangles: where one sample covers the ball, a pass need not look at the triangles, and where it
//! lies in a cube, all of them do.
//!
//! They are kept with the mesh, if triangles that follow each other lie together. Sorting triangles into cubes gains more by
//! them than they cost, and so does the second pass over a mesh that is filled in one piece; the first pass alone would
//! not. What a pass finds open is the same with them and without; cubes use them by mesh and radius alone, whatever is kept.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use glam::Vec3A;

use crate::error::Result;
use crate::job::{Job, chunks_of};
use crate::math::rounded_up;
use crate::mesh::{Mesh, exact};
use crate::psp::fill::triangles::Triangles;

/// A ball, in the unit of the mesh.
#[derive(Clone, Copy, Debug)]
pub(in crate::psp) struct Ball {
    pub centre: [f32; 3],
    pub radius: f32,
}

/// How many balls are looked at to see whether all are worth making.
const PROBES: usize = 64;

/// Groups of triangles per task.
const CHUNK: usize = 1 << 12;

/// A ball around each group of the triangles of a mesh, once there are any.
#[derive(Default)]
pub(in crate::psp) struct Balls {
    /// Whether there was a pass.
    is_second: AtomicBool,
    made: OnceLock<Vec<Ball>>,
}

impl Balls {
    /// The balls, by groups, for a pass over all triangles: none in the first one.
    pub fn for_pass(&self, job: &Job, mesh: &Mesh, triangles: Triangles, largest: f64) -> Result<Option<&[Ball]>> {
        match self.is_second.swap(true, Ordering::Relaxed) {
            true => self.get(job, mesh, triangles, largest),
            false => Ok(None),
        }
    }

    /// The balls, by groups, if half of some, all over the mesh, have this radius at most. That depends on nothing else.
    /// Threads that make them at the same time do not wait for each other, and those of the first one are kept.
    pub fn get(&self, job: &Job, mesh: &Mesh, triangles: Triangles, largest: f64) -> Result<Option<&[Ball]>> {
        if !are_small(mesh, triangles, largest) {
            return Ok(None);
        }
        if self.made.get().is_none() {
            let chunks = chunks_of(triangles.groups(), CHUNK);
            let around = |group: usize| Ball::around(mesh, triangles, group);
            let made = job.map(chunks.len(), |chunk| chunks.range(chunk).map(around).collect::<Vec<_>>())?.concat();
            self.made.get_or_init(|| made);
        }
        Ok(self.made.get().map(Vec::as_slice))
    }
}

/// Whether half of some balls, all over the mesh, have this radius at most.
fn are_small(mesh: &Mesh, triangles: Triangles, largest: f64) -> bool {
    let probes = PROBES.min(triangles.groups());
    let ball = |probe: usize| Ball::around(mesh, triangles, probe * triangles.groups() / probes);
    let small = (0..probes).filter(|&probe| f64::from(ball(probe).radius) <= largest).count();
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

    /// The lowest and the highest coordinates. What lies in the ball lies between them, however they are rounded, since
    /// its coordinates are floats.
    pub fn ends(&self) -> [[f64; 3]; 2] {
        [-1.0, 1.0].map(|side| self.centre.map(|x| f64::from(x) + side * f64::from(self.radius)))
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::job::Context;
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
            let get = |is_pass: bool, largest: f64| {
                let get = if is_pass { Balls::for_pass } else { Balls::get };
                Context::new(1).unwrap().run(None, |job| get(&balls, job, &mesh, triangles, largest)).unwrap()
            };
            assert!(get(true, size).is_none(), "in the first pass");
            assert!(get(true, 1e-3 * size).is_none() && get(false, 1e-3 * size).is_none(), "larger than asked for");
            for is_pass in [true, false] {
                let balls = get(is_pass, size).unwrap();
                assert_eq!(balls.len(), triangles.groups());
                for (group, ball) in balls.iter().enumerate() {
                    let mut corners = triangles.group(group).flat_map(|index| mesh.exact_corners(index as u32));
                    let farthest =
                        corners.clone().map(|corner| corner.distance(exact(ball.centre))).fold(0.0, f64::max);
                    assert!(farthest <= ball.radius.into(), "{ball:?} {farthest}");
                    let [low, high] = ball.ends().map(DVec3::from_array);
                    assert!(corners.all(|corner| low.cmple(corner).all() && corner.cmple(high).all()));
                    assert!(f64::from(ball.radius) <= 2.0 * farthest + 3e-45, "{ball:?} {farthest}");
                }
            }
        }
    }
}
