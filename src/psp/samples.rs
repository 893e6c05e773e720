//! The samples accepted so far, and how a set grows: cube by cube.

use std::collections::HashMap;
use std::ops::{AddAssign, Range};

use crate::error::Result;
use crate::geometry::grid3::distance_squared;
use crate::job::Job;
use crate::mesh::Mesh;
use crate::points::SurfaceSamples;
use crate::psp::buckets::Buckets;
use crate::psp::cubes::{Cube, SIDE};
use crate::psp::surroundings::Surroundings;

/// A point of the surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    pub position: [f32; 3],
    pub triangle: u32,
    pub barycentrics: [f32; 2],
}

impl Sample {
    /// The sample at rounded barycentrics: whatever is tested later is tested on the position that is returned.
    pub fn new(mesh: &Mesh, triangle: u32, barycentrics: [f32; 2]) -> Self {
        Self { position: mesh.point(triangle, barycentrics), triangle, barycentrics }
    }
}

/// A conflict-free set of samples that only grows.
pub(super) struct SampleSet {
    radius: f64,
    origin: [f64; 3],
    /// In the order in which they were accepted.
    samples: Vec<Sample>,
    /// Which samples each cube accepted. They lie in it, or not much outside.
    cubes: HashMap<Cube, Vec<Range<u32>>>,
}

impl SampleSet {
    /// An empty set. Two samples conflict when they are closer than `radius`.
    ///
    /// Distances are compared as squares in `f64`. The radius used is larger by 1e-14, dozens of units in the last place:
    /// the samples keep `radius` in whatever order a caller evaluates their distances.
    pub fn new(mesh: &Mesh, radius: f64) -> Self {
        let origin = mesh.bounds().0.map(f64::from);
        Self { radius: radius * (1.0 + 1e-14), origin, samples: Vec::new(), cubes: HashMap::new() }
    }

    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// The samples in the order in which they were accepted.
    #[cfg(test)]
    pub fn all(&self) -> &[Sample] {
        &self.samples
    }

    /// Whether two points are too close to both be samples; equally, whether a sample covers a point.
    pub fn conflict(&self, a: [f32; 3], b: [f32; 3]) -> bool {
        distance_squared(a, b) < self.radius * self.radius
    }

    /// The radius in use, a little above the one asked for.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The cube that a point is in.
    pub fn cube(&self, point: [f64; 3]) -> Cube {
        let side = f64::from(SIDE) * self.radius;
        // The origin is the lowest point of the surface, up to rounding, which truncation ignores.
        Cube([0, 1, 2].map(|axis| ((point[axis] - self.origin[axis]) / side) as i32))
    }

    /// Adds what `task` makes of each cube's items, given the surroundings of the cube, and returns the sum of its counts.
    ///
    /// The task returns samples that conflict neither with each other nor with anything in the surroundings, no farther than
    /// 8/3 radii from the cube. A failed or cancelled job leaves what complete colours have added.
    pub fn grow<T: Send + Sync, C: AddAssign + Default + Send>(
        &mut self,
        job: &Job,
        buckets: &Buckets<Cube, T>,
        task: impl Fn(Cube, &mut Surroundings, &mut dyn Iterator<Item = &T>) -> (Vec<Sample>, C) + Sync,
    ) -> Result<C> {
        let mut colours: [Vec<usize>; 8] = Default::default();
        (0..buckets.len()).for_each(|bucket| colours[buckets.key(bucket).colour()].push(bucket));
        let (mut done, mut total) = (0, C::default());
        for members in colours {
            let share = |done: usize| done as f64 / buckets.len().max(1) as f64;
            let part = job.part(share(done), share(done + members.len()));
            let grown = part.map(members.len(), |member| {
                let cube = buckets.key(members[member]);
                task(cube, &mut self.surroundings(cube), &mut buckets.items(members[member]))
            })?;
            done += members.len();
            for (&bucket, (samples, count)) in members.iter().zip(grown) {
                total += count;
                if !samples.is_empty() {
                    let start = self.len() as u32;
                    self.samples.extend(samples);
                    let run = start..self.len() as u32;
                    self.cubes.entry(buckets.key(bucket)).or_default().push(run);
                }
            }
        }
        Ok(total)
    }

    /// What stands in and around a cube.
    fn surroundings(&self, cube: Cube) -> Surroundings {
        let mut surroundings = Surroundings::new(cube, self.origin, self.radius);
        for runs in cube.around().filter_map(|cube| self.cubes.get(&cube)) {
            for run in runs {
                for sample in &self.samples[run.start as usize..run.end as usize] {
                    if surroundings.may_hold(sample.position) {
                        surroundings.add(sample.position);
                    }
                }
            }
        }
        surroundings
    }

    /// Takes back all but the first samples.
    pub fn truncate(&mut self, len: usize) {
        self.samples.truncate(len);
        for runs in self.cubes.values_mut() {
            runs.retain(|run| run.end as usize <= len);
        }
    }

    /// The samples in the order in which they were accepted, with their normals.
    pub fn to_surface_samples(&self, mesh: &Mesh) -> SurfaceSamples {
        surface_samples(mesh, &self.samples)
    }
}

/// Samples with their normals.
pub(super) fn surface_samples(mesh: &Mesh, samples: &[Sample]) -> SurfaceSamples {
    let triangles = samples.iter().map(|sample| sample.triangle).collect();
    mesh.samples(triangles, samples.iter().map(|sample| sample.barycentrics).collect())
}
