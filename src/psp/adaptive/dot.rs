//! Samples as they matter to each other.

use crate::math::distance_squared;
use crate::psp::facing::Facing;

/// A sample as others see it.
#[derive(Clone, Copy, Debug)]
pub struct Dot {
    pub position: [f32; 3],
    pub radius: f64,
    /// The normal of its triangle, where normals matter.
    pub normal: [f32; 3],
}

impl Dot {
    /// How far two samples must be apart: the mean of their radii. It is larger by 1e-14, dozens of units in the last
    /// place, so that it is kept in whatever order a caller evaluates distances.
    fn distance(a: f64, b: f64) -> f64 {
        0.5 * (1.0 + 1e-14) * (a + b)
    }

    /// How far two samples are apart, as a multiple of the mean of their radii.
    pub fn ratio(&self, other: &Self) -> f64 {
        distance_squared(self.position, other.position).sqrt() / (0.5 * (self.radius + other.radius))
    }

    /// Whether two samples are too close to each other.
    pub fn conflicts(&self, other: &Self, facing: Facing) -> bool {
        let distance = Self::distance(self.radius, other.radius);
        distance_squared(self.position, other.position) < distance * distance && facing.sees(self.normal, other.normal)
    }
}
