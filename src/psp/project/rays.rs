//! Projection by ray packets: the pattern's points become rays, filtered by the bounding box (thesis §3.4.3) and traced
//! through the whole mesh by Embree (§3.3.2).
//!
//! Departs from the thesis in how a ray continues after its first hit: one traversal that collects all hits, instead of
//! restarted rays. It finds the same hits, without an epsilon.
//!
//! Rays live in *trace space*, where the mesh's box is centred at the origin and has a diagonal of 1: Embree's
//! precision depends on the size of the scene. Only triangle and barycentrics come back from there.

use std::sync::Arc;

use glam::DVec3;

use crate::error::Result;
use crate::job::Job;
use crate::mesh::{Mesh, exact};
use crate::psp::project::candidates::{Candidates, Collector};
use crate::psp::project::pattern::RayPattern;
use crate::psp::project::projector::Projector;
use crate::trace::{Hit, Ray, Scene};

/// The box is widened by this (trace space), so that a rounded ray along its side is not lost.
const BOX_MARGIN: f64 = 1e-6;
/// Distance of the projectors from the centre (trace space), outside the mesh.
const DISTANCE: f64 = 1.0;
/// The largest number of tasks, however many repetitions of the pattern a projector needs.
const MAX_TASKS: u64 = 1 << 16;

/// A mesh in trace space and the pattern that is projected onto it.
pub struct Rays {
    space: Arc<TraceSpace>,
    pattern: RayPattern,
    /// The radius (trace space).
    radius: f64,
}

/// A mesh in trace space. It is kept with the mesh.
pub struct TraceSpace {
    /// The triangles that are to be sampled, and no others.
    scene: Scene,
    /// The numbers in the mesh of the triangles of the scene, unless these are all.
    numbers: Option<Vec<u32>>,
    /// The centre of the mesh's box, and the factor from lengths of the mesh to those in trace space.
    centre: DVec3,
    scale: f64,
    /// Half the size of the mesh's box (trace space), widened.
    half_box: DVec3,
    /// The rays of a packet.
    width: usize,
}

/// The repetitions of the pattern that meet the projection of the box on a projector.
struct Repetitions {
    /// Half the size of the projection, in radii.
    half: [f64; 2],
    /// The lowest repetition on each axis, and the number of them.
    first: [i64; 2],
    count: [u64; 2],
}

impl Rays {
    /// Builds the scene, if the mesh does not have one yet, and the pattern.
    pub fn new(job: &Job, mesh: &Mesh, radius: f64, seed: u64) -> Result<Self> {
        let space = TraceSpace::of(&job.part(0.0, 0.5), mesh)?;
        let radius = radius * space.scale;
        Ok(Self { space, pattern: RayPattern::new(&job.part(0.5, 1.0), 1.0 / radius, seed)?, radius })
    }

    /// Traces three projectors and collects all hits.
    pub fn project(&self, job: &Job, projectors: &[Projector; 3], collector: &Collector) -> Result<Candidates> {
        let repetitions = projectors.each_ref().map(|projector| self.repetitions(projector));
        // A unit is one chunk of one repetition of the pattern on one projector.
        let chunks = self.pattern.chunks() as u64;
        let ends = repetitions.iter().scan(0, |end, repetitions| {
            *end += repetitions.count[0] * repetitions.count[1] * chunks;
            Some(*end)
        });
        let ends: Vec<u64> = ends.collect();
        let units = ends[2];
        let units_per_task = units.div_ceil(MAX_TASKS).max(1);
        let tasks = units.div_ceil(units_per_task) as usize;
        collector.collect(job, tasks, |task, take| {
            let mut hits = Vec::new();
            let first = task as u64 * units_per_task;
            for unit in first..units.min(first + units_per_task) {
                let axis = ends.partition_point(|&end| end <= unit);
                let start = if axis == 0 { 0 } else { ends[axis - 1] };
                let (repetition, chunk) = ((unit - start) / chunks, (unit - start) % chunks);
                let rays = self.rays(&projectors[axis], &repetitions[axis], repetition, chunk as usize);
                hits.clear();
                self.space.all_hits(&rays, &mut hits);
                take(axis, rays.len(), &hits);
            }
        })
    }

    fn repetitions(&self, projector: &Projector) -> Repetitions {
        let (side, shift) = (self.pattern.side, projector.shift(self.pattern.side));
        let half = [projector.right, projector.up].map(|axis| self.space.half_box.dot(axis.abs()) / self.radius);
        let repetition = |x: f64, axis: usize| ((x - shift[axis]) / side).floor() as i64;
        let first = [0, 1].map(|axis| repetition(-half[axis], axis));
        let count = [0, 1].map(|axis| (repetition(half[axis], axis) - first[axis] + 1) as u64);
        Repetitions { half, first, count }
    }

    /// The rays of a chunk of the pattern that meet the box.
    fn rays(&self, projector: &Projector, repetitions: &Repetitions, repetition: u64, chunk: usize) -> Vec<Ray> {
        let (column, row) = (repetition % repetitions.count[0], repetition / repetitions.count[0]);
        let (side, shift) = (self.pattern.side, projector.shift(self.pattern.side));
        let offset = [(0, column), (1, row)]
            .map(|(axis, step)| shift[axis] + (repetitions.first[axis] + step as i64) as f64 * side);
        let inverse = projector.forward.recip();
        let points = self.pattern.chunk(chunk, offset, repetitions.half);
        let on_plane = points.map(|[x, y]| self.radius * (x * projector.right + y * projector.up));
        let meets_box = on_plane.filter(|&point| {
            // The distances at which the ray enters and leaves the three pairs of planes (Kay and Kajiya 1986).
            let (a, b) = ((-self.space.half_box - point) * inverse, (self.space.half_box - point) * inverse);
            a.min(b).max_element() <= a.max(b).min_element()
        });
        let ray = |point: DVec3| Ray {
            origin: (point - DISTANCE * projector.forward).as_vec3().to_array(),
            direction: projector.forward.as_vec3().to_array(),
        };
        meets_box.map(ray).collect()
    }
}

impl TraceSpace {
    /// The mesh in trace space, built if it was not yet.
    pub fn of(job: &Job, mesh: &Mesh) -> Result<Arc<Self>> {
        mesh.kept(|| job.report(0.0), || Self::new(job, mesh))
    }

    /// A ray from a point of the mesh's space.
    pub fn ray(&self, start: DVec3, direction: DVec3) -> Ray {
        let origin = ((start - self.centre) * self.scale).as_vec3().to_array();
        Ray { origin, direction: direction.as_vec3().to_array() }
    }

    /// Builds the scene.
    fn new(job: &Job, mesh: &Mesh) -> Result<Self> {
        let (low, high) = mesh.bounds();
        let (low, high) = (exact(low), exact(high));
        let (centre, scale) = (0.5 * (low + high), (high - low).length().recip());
        // Vertices that no triangle uses can be anywhere; a clamp keeps them harmless to Embree.
        let normalise = |&position: &[f32; 3]| {
            ((exact(position) - centre) * scale).clamp(DVec3::NEG_ONE, DVec3::ONE).as_vec3().to_array()
        };
        let normalised: Vec<_> = mesh.positions().iter().map(normalise).collect();
        let build = |triangles: &[[u32; 3]]| Scene::build(job, &normalised, triangles, job.context().num_threads());
        let numbers: Option<Vec<_>> = mesh.is_masked().then(|| mesh.sampled_triangles().collect());
        let scene = match &numbers {
            None => build(mesh.triangles())?,
            Some(numbers) => {
                let triangles: Vec<_> = numbers.iter().map(|&number| mesh.triangles()[number as usize]).collect();
                build(&triangles)?
            }
        };
        let width = scene.packet_width();
        Ok(Self { scene, numbers, centre, scale, half_box: 0.5 * scale * (high - low) + BOX_MARGIN, width })
    }

    /// The mesh in trace space, built anew, for packets of so many rays: 1, 4, 8 or 16.
    #[cfg(test)]
    pub fn with_packets(job: &Job, mesh: &Mesh, width: usize) -> Result<Self> {
        Ok(Self { width, ..Self::new(job, mesh)? })
    }

    /// Appends every hit on every ray, with the numbers of the mesh's triangles.
    pub fn all_hits(&self, rays: &[Ray], hits: &mut Vec<Hit>) {
        let first = hits.len();
        self.scene.all_hits_in_packets(self.width, rays, hits);
        if let Some(numbers) = &self.numbers {
            hits[first..].iter_mut().for_each(|hit| hit.triangle = numbers[hit.triangle as usize]);
        }
    }
}
