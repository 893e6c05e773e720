//! The samples accepted so far, and how a set grows: cube by cube.

use std::collections::HashMap;
use std::ops::{AddAssign, Range};

use crate::error::Result;
use crate::index::Binned;
use crate::job::Job;
use crate::math::distance_squared;
use crate::mesh::{Mesh, exact_point};
use crate::points::Points;
use crate::psp::cubes::{Cube, Numbers, SIDE};
use crate::psp::surroundings::Surroundings;

/// A point of the surface.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    pub position: [f32; 3],
    pub triangle: u32,
    pub barycentrics: [f32; 2],
    /// In ordered sets, the distance to the nearest sample that was accepted before (`levels.rs`).
    pub rank: f32,
    /// In sets of several classes, its class (`classes/`); otherwise 0.
    pub class: u8,
}

impl Sample {
    /// The sample at rounded barycentrics: whatever is tested later is tested on the position that is returned.
    pub fn new(mesh: &Mesh, triangle: u32, barycentrics: [f32; 2]) -> Self {
        Self::on(&mesh.corners(triangle), triangle, barycentrics)
    }

    /// The same, where the corners of the triangle are at hand.
    pub fn on(corners: &[[f32; 3]; 3], triangle: u32, barycentrics: [f32; 2]) -> Self {
        let position = exact_point(corners, barycentrics.map(f64::from)).as_vec3().to_array();
        Self { position, triangle, barycentrics, rank: f32::INFINITY, class: 0 }
    }
}

/// Distances are compared as squares in `f64`. The radius used is larger by this share, dozens of units in the last
/// place: the samples keep the radius in whatever order a caller evaluates their distances.
pub const RADIUS_SLACK: f64 = 1e-14;

/// A conflict-free set of samples that only grows.
pub struct SampleSet {
    radius: f64,
    origin: [f64; 3],
    /// In the order in which they were accepted.
    samples: Vec<Sample>,
    /// Which samples each cube has. They lie in it, or not much outside: it is the cube that accepted them.
    cubes: HashMap<Cube, Vec<Range<u32>>>,
    /// How many samples are known by their cubes.
    in_cubes: usize,
}

impl SampleSet {
    /// An empty set. Two samples conflict when they are closer than `radius`, and [`RADIUS_SLACK`].
    pub fn new(mesh: &Mesh, radius: f64) -> Self {
        let origin = mesh.bounds().0.map(f64::from);
        Self { radius: radius * (1.0 + RADIUS_SLACK), origin, samples: Vec::new(), cubes: HashMap::new(), in_cubes: 0 }
    }

    /// A set of samples that do not conflict, which are put in the order of their cubes.
    pub fn of(mesh: &Mesh, radius: f64, samples: &[Sample]) -> Self {
        let (mut set, mut numbers) = (Self::new(mesh, radius), Numbers::new());
        let bins: Vec<usize> =
            samples.iter().map(|sample| numbers.of(set.cube(sample.position.map(f64::from)))).collect();
        let binned =
            Binned::new(numbers.cubes.len(), bins.into_iter().zip(0..).map(|(bin, index): (_, u32)| (bin, index)));
        set.samples = binned.items().iter().map(|&index| samples[index as usize]).collect();
        set
    }

    /// A set of samples that do not conflict, in their order.
    pub fn in_order(mesh: &Mesh, radius: f64, samples: Vec<Sample>) -> Self {
        Self { samples, ..Self::new(mesh, radius) }
    }

    /// The samples, those last that were added last.
    pub fn into_samples(self) -> Vec<Sample> {
        self.samples
    }

    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// The samples in the order in which they were accepted.
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
    #[inline]
    pub fn cube(&self, point: [f64; 3]) -> Cube {
        let per_side = 1.0 / (f64::from(SIDE) * self.radius);
        // The origin is the lowest point of the surface, up to rounding, which truncation ignores.
        Cube([0, 1, 2].map(|axis| ((point[axis] - self.origin[axis]) * per_side) as i32))
    }

    /// Adds what `task` makes of each of the cubes, all of them different, given the number of the cube and the samples
    /// that are there, and returns the sum of its counts.
    ///
    /// The task returns samples that conflict neither with each other nor with any sample in and around the cube, no
    /// farther than a quarter of its side from it. A failed or cancelled job leaves what complete colours have added.
    pub fn grow<C: AddAssign + Default + Send>(
        &mut self,
        job: &Job,
        cubes: &[Cube],
        task: impl Fn(usize, &Self) -> Result<(Vec<Sample>, C)> + Sync,
    ) -> Result<C> {
        self.sort_into_cubes();
        let mut colours: [Vec<usize>; 8] = Default::default();
        (0..).zip(cubes).for_each(|(number, cube)| colours[cube.colour()].push(number));
        let (mut done, mut total) = (0, C::default());
        for members in colours {
            let share = |done: usize| done as f64 / cubes.len().max(1) as f64;
            let part = job.part(share(done), share(done + members.len()));
            let grown = part.map(members.len(), |member| task(members[member], self))?;
            done += members.len();
            for (&number, grown) in members.iter().zip(grown) {
                let (samples, count) = grown?;
                total += count;
                if !samples.is_empty() {
                    let start = self.len();
                    self.samples.extend(samples);
                    let run = start as u32..self.len() as u32;
                    self.cubes.entry(cubes[number]).or_default().push(run);
                }
            }
            self.in_cubes = self.len();
        }
        Ok(total)
    }

    /// Adds samples that conflict neither with each other nor with any other sample.
    pub fn append(&mut self, samples: &mut Vec<Sample>) {
        self.samples.append(samples);
    }

    /// Makes all samples known by their cubes.
    fn sort_into_cubes(&mut self) {
        for number in self.in_cubes..self.len() {
            let cube = self.cube(self.samples[number].position.map(f64::from));
            let (runs, number) = (self.cubes.entry(cube).or_default(), number as u32);
            match runs.last_mut() {
                Some(run) if run.end == number => run.end += 1,
                _ => runs.push(number..number + 1),
            }
        }
        self.in_cubes = self.len();
    }

    /// The samples of a cube and of those that touch it.
    pub fn around(&self, cube: Cube) -> impl Iterator<Item = &Sample> {
        let runs = cube.around().filter_map(|cube| self.cubes.get(&cube)).flatten();
        runs.flat_map(|run| &self.samples[run.start as usize..run.end as usize])
    }

    /// What stands in and around a cube.
    pub fn surroundings(&self, cube: Cube) -> Surroundings {
        let mut surroundings = Surroundings::new(cube, self.origin, self.radius);
        for sample in self.around(cube) {
            if surroundings.may_hold(sample.position) {
                surroundings.add(sample.position);
            }
        }
        surroundings
    }

    /// Takes back all but the first samples.
    pub fn truncate(&mut self, len: usize) {
        self.samples.truncate(len);
        self.in_cubes = self.in_cubes.min(len);
        for runs in self.cubes.values_mut() {
            runs.retain(|run| run.end as usize <= len);
        }
    }

    /// The samples in the order in which they were accepted, with their normals.
    pub fn to_surface_samples(&self, mesh: &Mesh) -> Points<3> {
        surface_samples(mesh, &self.samples)
    }
}

/// Samples with their normals.
pub fn surface_samples(mesh: &Mesh, samples: &[Sample]) -> Points<3> {
    let triangles = samples.iter().map(|sample| sample.triangle).collect();
    mesh.samples(triangles, samples.iter().map(|sample| sample.barycentrics).collect())
}
