//! Samples, and sets of samples of one radius.

mod cubes;
mod lanes;
mod surroundings;
#[allow(unsafe_code)] // Vector instructions.
mod vectors;

pub use cubes::{Cube, Cubes, Growing, Numbers, OctaveCube, SIDE};
pub use surroundings::Surroundings;

use crate::index::Binned;
use crate::math::distance_squared;
use crate::mesh::{Mesh, exact_point};
use crate::points::Points;

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
    /// The sample at rounded barycentrics: all later tests use the position that is returned.
    pub fn new(mesh: &Mesh, triangle: u32, barycentrics: [f32; 2]) -> Self {
        Self::on(&mesh.corners(triangle), triangle, barycentrics)
    }

    /// A sample of which only the position is known.
    pub fn at(position: [f32; 3]) -> Self {
        Self { position, triangle: 0, barycentrics: [0.0; 2], rank: f32::INFINITY, class: 0 }
    }

    /// The sample, on a triangle whose corners are known to the caller.
    pub fn on(corners: &[[f32; 3]; 3], triangle: u32, barycentrics: [f32; 2]) -> Self {
        let position = exact_point(corners, barycentrics.map(f64::from)).as_vec3().to_array();
        Self { triangle, barycentrics, ..Self::at(position) }
    }
}

/// Distances are compared as squares in `f64`. The radius used is larger by this share, dozens of units in the last
/// place: the samples keep the radius in whatever order a caller evaluates their distances.
pub const RADIUS_SLACK: f64 = 1e-14;

/// The cubes of a set with one radius: [`SIDE`] radii wide, or some times that.
pub struct EvenCubes {
    radius: f64,
    side: f64,
    origin: [f64; 3],
}

impl EvenCubes {
    /// The cube that a point is in.
    #[inline]
    fn cube(&self, point: [f64; 3]) -> Cube {
        let per_side = 1.0 / self.side;
        // The origin is the lowest point of the surface, up to rounding, which truncation ignores.
        Cube([0, 1, 2].map(|axis| ((point[axis] - self.origin[axis]) * per_side) as i32))
    }
}

impl Cubes for EvenCubes {
    type Sample = Sample;

    fn cube_of(&self, sample: &Sample) -> OctaveCube {
        self.cube(sample.position.map(f64::from)).into()
    }
}

/// A conflict-free set of samples of one radius.
pub type SampleSet = Growing<EvenCubes>;

impl SampleSet {
    /// An empty set. Two samples conflict when they are closer than `radius`, enlarged by [`RADIUS_SLACK`].
    pub fn new(mesh: &Mesh, radius: f64) -> Self {
        Self::with(mesh, radius, Vec::new())
    }

    /// A set of samples that do not conflict, in their order.
    pub fn with(mesh: &Mesh, radius: f64, samples: Vec<Sample>) -> Self {
        let (radius, origin) = (radius * (1.0 + RADIUS_SLACK), mesh.bounds().0.map(f64::from));
        Self::in_order(EvenCubes { radius, side: f64::from(SIDE) * radius, origin }, samples)
    }

    /// The set's radius and samples after some others, by cubes whose sides are `times` those of the set's, moved by
    /// shares of them.
    pub fn widened(&self, times: f64, shift: [f64; 3], others: impl Iterator<Item = Sample>) -> Self {
        let &EvenCubes { radius, side, origin } = &self.cubes;
        let side = times * side;
        let origin = [0, 1, 2].map(|axis| origin[axis] - shift[axis] * side);
        Self::in_order(EvenCubes { radius, side, origin }, others.chain(self.all().iter().copied()).collect())
    }

    /// A set of samples that do not conflict, which are put in the order of their cubes.
    pub fn of(mesh: &Mesh, radius: f64, samples: &[Sample]) -> Self {
        let (mut set, mut numbers) = (Self::new(mesh, radius), Numbers::new());
        let bins: Vec<usize> =
            samples.iter().map(|sample| numbers.of(set.cube(sample.position.map(f64::from)))).collect();
        let binned =
            Binned::new(numbers.cubes.len(), bins.into_iter().zip(0..).map(|(bin, index): (_, u32)| (bin, index)));
        set.append(&mut binned.items().iter().map(|&index| samples[index as usize]).collect());
        set
    }

    /// True if two points are too close to both be samples; equivalently, if a sample covers a point.
    pub fn conflict(&self, a: [f32; 3], b: [f32; 3]) -> bool {
        distance_squared(a, b) < self.radius() * self.radius()
    }

    /// The radius in use, slightly above the requested one.
    pub fn radius(&self) -> f64 {
        self.cubes.radius
    }

    /// The side of the cubes.
    pub fn side(&self) -> f64 {
        self.cubes.side
    }

    /// The cube that a point is in.
    #[inline]
    pub fn cube(&self, point: [f64; 3]) -> Cube {
        self.cubes.cube(point)
    }

    /// The samples in and around a cube, for a search of neighbours.
    pub fn surroundings(&self, cube: Cube) -> Surroundings {
        let EvenCubes { radius, side, origin } = self.cubes;
        let centre = [0, 1, 2].map(|axis| origin[axis] + (f64::from(cube.0[axis]) + 0.5) * side);
        let mut surroundings = Surroundings::new(centre.into(), 0.5 * side, radius);
        for sample in self.around(cube) {
            if surroundings.may_hold(sample.position) {
                surroundings.add(sample.position);
            }
        }
        surroundings
    }

    /// The samples in the order in which they were accepted, with their normals.
    pub fn to_surface_samples(&self, mesh: &Mesh) -> Points<3> {
        surface_samples(mesh, self.all().iter())
    }
}

/// Samples with their normals.
pub fn surface_samples<'a>(mesh: &Mesh, samples: impl Iterator<Item = &'a Sample> + Clone) -> Points<3> {
    let triangles = samples.clone().map(|sample| sample.triangle).collect();
    mesh.samples(triangles, samples.map(|sample| sample.barycentrics).collect())
}
