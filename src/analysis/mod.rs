//! Analysis: the properties of a set of samples, whatever its source.
//!
//! Nothing else in the library depends on these modules; they are here so that every guarantee can be checked. They
//! are written for clarity and tested against brute force.

pub mod bonds;
pub mod coverage;
pub mod differential;
pub mod distribution;
pub mod facing;
pub mod figures;
pub mod space;
pub mod spacing;
pub mod spectrum;
pub mod triangles;

use crate::index::Weights;
use crate::mesh::Mesh;
use crate::rng::{Draw, Rng};

/// The most bytes per point of a set of the plane that is triangulated, with its triangles and distances.
const BYTES_PER_TRIANGULATED_POINT: f64 = 440.0;

/// A mesh from which points are drawn uniformly by area.
struct AreaSampler<'a> {
    mesh: &'a Mesh,
    areas: Weights,
}

impl<'a> AreaSampler<'a> {
    pub fn new(mesh: &'a Mesh) -> Self {
        let triangles = 0..mesh.triangles().len() as u32;
        Self { mesh, areas: Weights::new(triangles.map(|triangle| mesh.triangle_area(triangle)).collect()) }
    }

    /// The point of this number among those of a seed.
    pub fn probe(&self, seed: u64, number: u64) -> [f32; 3] {
        let mut rng = Rng::at(seed, Draw::Probe, &[number]);
        let triangle = self.areas.pick(&mut rng);
        self.mesh.point(triangle, rng.in_triangle().map(|x| x as f32))
    }
}
