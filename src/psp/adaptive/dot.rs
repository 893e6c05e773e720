//! Samples as they matter to each other.

use crate::geometry::grid3::distance_squared;
use crate::mesh::exact;

/// A sample as others see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dot {
    pub position: [f32; 3],
    pub radius: f64,
    /// The normal of its triangle, where normals matter.
    pub normal: [f32; 3],
}

/// Which samples conflict with each other.
#[derive(Clone, Copy)]
pub(super) struct ConflictRule {
    /// Samples whose normals have a smaller cosine ignore each other, unless the normals are the same; -1: none do.
    pub cosine: f64,
}

impl ConflictRule {
    /// How far two samples must be apart: the mean of their radii. It is larger by 1e-14, dozens of units in the last
    /// place, so that it is kept in whatever order a caller evaluates distances.
    fn distance(a: f64, b: f64) -> f64 {
        0.5 * (1.0 + 1e-14) * (a + b)
    }

    /// Whether normals matter at all.
    pub fn asks_normals(self) -> bool {
        self.cosine > -1.0
    }

    /// Whether two samples with these normals matter to each other. Those of one triangle do: the square of a rounded
    /// normal can be below a cosine of 1, and a triangle would be sampled without end.
    pub fn sees(self, a: [f32; 3], b: [f32; 3]) -> bool {
        !self.asks_normals() || a == b || exact(a).dot(exact(b)) >= self.cosine
    }

    pub fn conflict(self, a: &Dot, b: &Dot) -> bool {
        let distance = Self::distance(a.radius, b.radius);
        distance_squared(a.position, b.position) < distance * distance && self.sees(a.normal, b.normal)
    }
}
