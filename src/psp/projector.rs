//! Projectors: three orthogonal planes of parallel rays, turned at random from iteration to iteration (thesis §3.3.1 and
//! §3.3.3), filtered by the bounding box (§3.4.3) and traced through the whole mesh.
//!
//! Departs from the thesis in how a ray goes on behind its first hit: one traversal that collects all hits, instead of
//! restarted rays. It finds the same hits, without an epsilon. The conflicts among the hits of a ray keep their name,
//! *restart conflicts*.
//!
//! Rays live in *trace space*, where the mesh's box is centred at the origin and has a diagonal of 1: Embree's precision
//! depends on the size of the scene. Only triangle and barycentrics come back from there.

use glam::{DMat3, DQuat, DVec3};

use crate::error::Result;
use crate::job::{Context, Job};
use crate::mesh::{Mesh, exact, round_barycentrics};
use crate::psp::blocks::{Block, Groups};
use crate::psp::merge::Candidate;
use crate::psp::pattern::Pattern;
use crate::psp::samples::{Sample, SampleSet};
use crate::rng::{Draw, Rng};
use crate::trace::{Hit, Ray, Scene};

/// Two axes of successive iterations are too near each other above this cosine: 20 degrees.
const NEAREST_AXES: f64 = 0.94;
/// The box is widened by this (trace space), so that a rounded ray along its side is not lost.
const BOX_MARGIN: f64 = 1e-6;
/// Distance of the projectors from the centre (trace space), outside the mesh.
const DISTANCE: f64 = 1.0;
/// How finely the squareness of a hit is told.
const RANKS: f64 = 1e6;
/// No more tasks than this, however many repetitions of the pattern a projector needs.
const MAX_TASKS: u64 = 1 << 16;

/// A mesh in trace space and the pattern that is projected onto it.
pub(super) struct Projection {
    /// The triangles that are to be sampled, and no others.
    scene: Scene,
    /// Their numbers in the mesh.
    numbers: Vec<u32>,
    pattern: Pattern,
    /// Half the size of the mesh's box (trace space).
    half_box: DVec3,
    /// The radius (trace space).
    radius: f64,
}

/// Counts of what some rays met.
#[derive(Default)]
pub(super) struct Projected {
    pub rays: u64,
    pub hits: u64,
    pub restart_conflicts: u64,
}

/// A plane of parallel rays.
struct Projector {
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    /// How far the pattern is shifted on the torus, in radii.
    shift: [f64; 2],
    /// Half the size of the box's shadow on the plane, in radii.
    half: [f64; 2],
    /// The repetitions of the pattern that meet the shadow: the lowest on each axis, and how many.
    first: [i64; 2],
    repetitions: [u64; 2],
}

impl Projection {
    /// Builds the scene and the pattern.
    pub fn new(context: &Context, mesh: &Mesh, radius: f64, seed: u64) -> Result<Self> {
        let (low, high) = mesh.bounds();
        let (low, high) = (exact(low), exact(high));
        let (centre, scale) = (0.5 * (low + high), (high - low).length().recip());
        // Vertices that no triangle uses can be anywhere; a clamp keeps them from upsetting Embree.
        let normalise = |&position: &[f32; 3]| {
            ((exact(position) - centre) * scale).clamp(DVec3::NEG_ONE, DVec3::ONE).as_vec3().to_array()
        };
        let normalised: Vec<_> = mesh.positions().iter().map(normalise).collect();
        let numbers: Vec<_> = mesh.sampled_triangles().collect();
        let triangles: Vec<_> = numbers.iter().map(|&number| mesh.triangles()[number as usize]).collect();
        Ok(Self {
            scene: Scene::new(&normalised, &triangles, context.num_threads())?,
            numbers,
            pattern: Pattern::new(context, 1.0 / (radius * scale), seed)?,
            half_box: 0.5 * scale * (high - low) + BOX_MARGIN,
            radius: radius * scale,
        })
    }

    /// Traces the three projectors of an iteration and collects all hits, by blocks.
    pub fn project(
        &self,
        job: &Job,
        frame: DMat3,
        mesh: &Mesh,
        samples: &SampleSet,
        mut shift: impl FnMut(usize) -> [f64; 2],
    ) -> Result<(Groups<Block, Candidate>, Projected)> {
        let projectors = [0, 1, 2].map(|axis| self.projector(frame, axis, shift(axis)));
        // A unit is one chunk of one repetition of the pattern on one projector.
        let chunks = self.pattern.chunks() as u64;
        let ends = projectors.iter().scan(0, |end, projector| {
            *end += projector.repetitions[0] * projector.repetitions[1] * chunks;
            Some(*end)
        });
        let ends: Vec<u64> = ends.collect();
        let units = ends[2];
        let units_per_task = units.div_ceil(MAX_TASKS).max(1);
        let tasks = units.div_ceil(units_per_task) as usize;
        let (candidates, parts) = Groups::collect(job, tasks, |task, add| {
            let mut projected = Projected::default();
            let first = task as u64 * units_per_task;
            for unit in first..units.min(first + units_per_task) {
                let axis = ends.partition_point(|&end| end <= unit);
                let start = if axis == 0 { 0 } else { ends[axis - 1] };
                let (repetition, chunk) = ((unit - start) / chunks, (unit - start) % chunks);
                let rays = self.rays(&projectors[axis], repetition, chunk as usize);
                self.trace(&rays, mesh, samples, add, &mut projected);
            }
            projected
        })?;

        let mut all = Projected::default();
        for part in parts {
            all.rays += part.rays;
            all.hits += part.hits;
            all.restart_conflicts += part.restart_conflicts;
        }
        Ok((candidates, all))
    }

    /// The projector along an axis of the frame. `shift` is a share of the pattern's side.
    fn projector(&self, frame: DMat3, axis: usize, shift: [f64; 2]) -> Projector {
        let [right, up, forward] = [1, 2, 0].map(|step| frame.col((axis + step) % 3));
        let side = self.pattern.side;
        let shift = shift.map(|share| share * side);
        let half = [right, up].map(|direction| self.half_box.dot(direction.abs()) / self.radius);
        let repetition = |x: f64, axis: usize| ((x - shift[axis]) / side).floor() as i64;
        let first = [0, 1].map(|axis| repetition(-half[axis], axis));
        let repetitions = [0, 1].map(|axis| (repetition(half[axis], axis) - first[axis] + 1) as u64);
        Projector { right, up, forward, shift, half, first, repetitions }
    }

    /// The rays of a chunk of the pattern that meet the box.
    fn rays(&self, projector: &Projector, repetition: u64, chunk: usize) -> Vec<Ray> {
        let (column, row) = (repetition % projector.repetitions[0], repetition / projector.repetitions[0]);
        let offset = [(0, column), (1, row)].map(|(axis, step)| {
            projector.shift[axis] + (projector.first[axis] + step as i64) as f64 * self.pattern.side
        });
        let inverse = projector.forward.recip();
        let points = self.pattern.chunk(chunk, offset, projector.half);
        let on_plane = points.map(|[x, y]| self.radius * (x * projector.right + y * projector.up));
        let meets_box = on_plane.filter(|&point| {
            // Where the ray enters and leaves the three pairs of planes (Kay and Kajiya 1986).
            let (a, b) = ((-self.half_box - point) * inverse, (self.half_box - point) * inverse);
            a.min(b).max_element() <= a.max(b).min_element()
        });
        let ray = |point: DVec3| Ray {
            origin: (point - DISTANCE * projector.forward).as_vec3().to_array(),
            direction: projector.forward.as_vec3().to_array(),
        };
        meets_box.map(ray).collect()
    }

    /// Traces rays, adds their hits to the candidates and counts them.
    fn trace(
        &self,
        rays: &[Ray],
        mesh: &Mesh,
        samples: &SampleSet,
        add: &mut dyn FnMut(Block, Candidate),
        projected: &mut Projected,
    ) {
        let mut hits: Vec<Hit> = Vec::with_capacity(2 * rays.len());
        self.scene.all_hits(rays, &mut hits);
        projected.rays += rays.len() as u64;
        projected.hits += hits.len() as u64;
        let mut kept: Vec<[f32; 3]> = Vec::new();
        for on_ray in hits.chunk_by(|a, b| a.ray == b.ray) {
            kept.clear();
            let direction = rays[on_ray[0].ray as usize].direction;
            for hit in on_ray {
                let triangle = self.numbers[hit.triangle as usize];
                let sample = Sample::new(mesh, triangle, round_barycentrics(hit.uv.map(f64::from)));
                if kept.iter().any(|&earlier| samples.conflict(earlier, sample.position)) {
                    projected.restart_conflicts += 1;
                } else {
                    kept.push(sample.position);
                }
                let squareness = exact(mesh.normal(triangle)).dot(exact(direction)).abs();
                let rank = ((1.0 - squareness) * RANKS) as u32;
                add(samples.block(sample.position.map(f64::from)), Candidate { sample, rank });
            }
        }
    }
}

/// The frame of an iteration: a uniformly random rotation none of whose axes is near one of the frame before. Near
/// projectors find little that is new (thesis §3.3.3).
pub(super) fn frame(seed: u64, iteration: u32, previous: Option<DMat3>) -> DMat3 {
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

/// The shift of a projector's pattern, as a share of its side on both axes.
pub(super) fn shift(seed: u64, iteration: u32, projector: usize) -> [f64; 2] {
    let mut rng = Rng::at(seed, Draw::Shift, &[iteration.into(), projector as u64]);
    [rng.unit(), rng.unit()]
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
