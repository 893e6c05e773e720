//! Random points on a surface, uniform by area.

use crate::index::Weights;
use crate::mesh::Mesh;
use crate::rng::{Draw, Rng};

/// A mesh from which points are drawn uniformly by area.
pub(super) struct AreaSampler<'a> {
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
