//! Random points on a surface, uniform by area.

use crate::mesh::Mesh;
use crate::rng::{Draw, Rng};

/// A mesh from which points are drawn uniformly by area.
pub(super) struct AreaSampler<'a> {
    mesh: &'a Mesh,
    /// The area of the triangles up to and with each.
    areas: Vec<f64>,
}

impl<'a> AreaSampler<'a> {
    pub fn new(mesh: &'a Mesh) -> Self {
        let add = |sum: &mut f64, triangle| {
            *sum += mesh.triangle_area(triangle);
            Some(*sum)
        };
        Self { mesh, areas: (0..mesh.triangles().len() as u32).scan(0.0, add).collect() }
    }

    /// The point of this number among those of a seed.
    pub fn probe(&self, seed: u64, number: u64) -> [f32; 3] {
        let mut rng = Rng::at(seed, Draw::Probe, &[number]);
        let area = rng.unit() * self.areas[self.areas.len() - 1];
        let triangle = self.areas.partition_point(|&sum| sum <= area).min(self.areas.len() - 1);
        // The square root makes the triangle's tip as dense as its base (Turk 1990).
        let (along, across) = (rng.unit().sqrt(), rng.unit());
        self.mesh.point(triangle as u32, [(along * (1.0 - across)) as f32, (along * across) as f32])
    }
}
