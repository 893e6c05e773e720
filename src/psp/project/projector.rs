//! Projectors: three orthogonal planes that carry the pattern, turned at random from iteration to iteration (thesis §3.3.1
//! and §3.3.3), and what becomes of their hits on the mesh.
//!
//! The hits are found by one of two engines: Embree's ray packets (`rays.rs`) or a rasteriser (`raster/`). All hits of all
//! points are candidates. The conflicts among those of a point keep the name of the thesis, *restart conflicts*.

use glam::{DMat3, DQuat, DVec3};

use crate::error::Result;
use crate::job::Job;
use crate::mesh::{Mesh, exact, round_barycentrics};
use crate::psp::blocks::{Block, Groups};
use crate::psp::merge::Candidate;
use crate::psp::project::raster::Rasteriser;
use crate::psp::project::rays::Rays;
use crate::psp::samples::{Sample, SampleSet};
use crate::psp::{Engine, Options, Priority};
use crate::rng::{Draw, Rng};
use crate::trace::Hit;

/// Two axes of successive iterations are too near each other above this cosine: 20 degrees.
const NEAREST_AXES: f64 = 0.94;
/// How finely the squareness of a hit is told.
const RANKS: f64 = 1e6;

/// A pattern, and what finds its hits on a mesh.
pub(crate) enum Projection {
    Embree(Rays),
    Rasteriser(Rasteriser),
}

impl Projection {
    /// Makes the pattern, and prepares the mesh for the engine.
    pub fn new(job: &Job, mesh: &Mesh, options: &Options) -> Result<Self> {
        let Options { radius, seed, .. } = *options;
        Ok(match options.engine {
            Engine::Embree => Self::Embree(Rays::new(job, mesh, radius, seed)?),
            Engine::Rasteriser => Self::Rasteriser(Rasteriser::new(job, mesh, radius, seed)?),
        })
    }

    /// Collects all hits of three projectors, by blocks.
    pub fn project(&self, job: &Job, projectors: &[Projector; 3], collector: &Collector) -> Result<Found> {
        match self {
            Self::Embree(rays) => rays.project(job, projectors, collector),
            Self::Rasteriser(rasteriser) => rasteriser.project(job, projectors, collector),
        }
    }
}

/// A plane through the centre of the mesh that carries the pattern along its normal.
pub(crate) struct Projector {
    pub right: DVec3,
    pub up: DVec3,
    pub forward: DVec3,
    /// How far the pattern is shifted on the torus, as a share of its side.
    shift: [f64; 2],
}

impl Projector {
    /// The three projectors of an iteration.
    pub fn all(frame: DMat3, seed: u64, iteration: u32) -> [Self; 3] {
        [0, 1, 2].map(|axis| {
            let [right, up, forward] = [1, 2, 0].map(|step| frame.col((axis + step) % 3));
            let mut rng = Rng::at(seed, Draw::Shift, &[iteration.into(), axis as u64]);
            Self { right, up, forward, shift: [rng.unit(), rng.unit()] }
        })
    }

    /// Where the corner of the pattern lies that has this side.
    pub fn shift(&self, side: f64) -> [f64; 2] {
        self.shift.map(|share| share * side)
    }
}

/// Counts of what some projectors met.
#[derive(Clone, Copy, Default)]
pub(crate) struct Projected {
    pub rays: u64,
    pub hits: u64,
    pub restart_conflicts: u64,
}

/// Candidates by blocks, and counts.
pub(crate) type Found = (Groups<Block, Candidate>, Projected);

/// Makes candidates of hits.
pub(crate) struct Collector<'a> {
    pub mesh: &'a Mesh,
    pub samples: &'a SampleSet,
    pub priority: Priority,
    pub projectors: &'a [Projector; 3],
}

impl Collector<'_> {
    /// Runs tasks that hand over what they find: the number of a projector, of its rays, and their hits in the order of
    /// [`Scene::all_hits`](crate::trace::Scene::all_hits), all those of a ray at once.
    pub fn collect(
        &self,
        job: &Job,
        tasks: usize,
        task: impl Fn(usize, &mut dyn FnMut(usize, usize, &[Hit])) + Sync,
    ) -> Result<Found> {
        let (candidates, parts) = Groups::collect(job, tasks, |index, add| {
            let mut projected = Projected::default();
            task(index, &mut |projector, rays, hits| {
                projected.rays += rays as u64;
                projected.hits += hits.len() as u64;
                projected.restart_conflicts += self.add_all(projector, hits, add);
            });
            projected
        })?;
        let all = parts.iter().fold(Projected::default(), |all, part| Projected {
            rays: all.rays + part.rays,
            hits: all.hits + part.hits,
            restart_conflicts: all.restart_conflicts + part.restart_conflicts,
        });
        Ok((candidates, all))
    }

    /// Adds all hits to the candidates, and counts those that conflict with an earlier one on the same ray.
    fn add_all(&self, projector: usize, hits: &[Hit], add: &mut dyn FnMut(Block, Candidate)) -> u64 {
        let direction = self.projectors[projector].forward;
        let (mut kept, mut restart_conflicts): (Vec<[f32; 3]>, _) = (Vec::new(), 0);
        for on_ray in hits.chunk_by(|a, b| a.ray == b.ray) {
            kept.clear();
            for hit in on_ray {
                let sample = Sample::new(self.mesh, hit.triangle, round_barycentrics(hit.uv.map(f64::from)));
                if kept.iter().any(|&earlier| self.samples.conflict(earlier, sample.position)) {
                    restart_conflicts += 1;
                } else {
                    kept.push(sample.position);
                }
                let squareness = || exact(self.mesh.normal(hit.triangle)).dot(direction).abs();
                let rank = match self.priority {
                    Priority::Squareness => ((1.0 - squareness()) * RANKS) as u32,
                    Priority::Projector => projector as u32,
                };
                add(self.samples.block(sample.position.map(f64::from)), Candidate { sample, rank });
            }
        }
        restart_conflicts
    }
}

/// The frame of an iteration: a uniformly random rotation none of whose axes is near one of the frame before. Near
/// projectors find little that is new (thesis §3.3.3).
pub(crate) fn frame(seed: u64, iteration: u32, previous: Option<DMat3>) -> DMat3 {
    let mut attempt = 0;
    loop {
        let frame = rotation(Rng::at(seed, Draw::Rotation, &[iteration.into(), attempt]));
        let near = |other: DMat3| (other.transpose() * frame).to_cols_array().iter().any(|x| x.abs() > NEAREST_AXES);
        if !previous.is_some_and(near) {
            return frame;
        }
        attempt += 1;
    }
}

/// A uniformly random rotation: a uniformly random unit quaternion (Shoemake 1992).
fn rotation(mut rng: Rng) -> DMat3 {
    let share = rng.unit();
    let (sin1, cos1) = (std::f64::consts::TAU * rng.unit()).sin_cos();
    let (sin2, cos2) = (std::f64::consts::TAU * rng.unit()).sin_cos();
    let (a, b) = ((1.0 - share).sqrt(), share.sqrt());
    DMat3::from_quat(DQuat::from_xyzw(a * sin1, a * cos1, b * sin2, b * cos2).normalize())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_orthonormal_random_and_apart_from_the_one_before() {
        let mut previous = None;
        let mut mean = DVec3::ZERO;
        for iteration in 0..2000 {
            let frame = frame(3, iteration, previous);
            assert!((frame * frame.transpose()).abs_diff_eq(DMat3::IDENTITY, 1e-12));
            if let Some(previous) = previous {
                let cosines = DMat3::transpose(&previous) * frame;
                assert!(cosines.to_cols_array().iter().all(|x| x.abs() <= NEAREST_AXES));
            }
            mean += frame.x_axis / 2000.0;
            previous = Some(frame);
        }
        assert!(mean.length() < 0.05, "{mean}");
    }
}
