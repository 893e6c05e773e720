//! The data of samples on which their conflicts depend.

use crate::math::distance_squared;
use crate::psp::fragment::Facing;

/// A sample as other samples are tested against it.
#[derive(Clone, Copy, Debug)]
pub struct Dot {
    pub position: [f32; 3],
    pub radius: f64,
    /// The normal of its triangle, where normals matter.
    pub normal: [f32; 3],
}

impl Dot {
    /// The least distance that two samples keep: the mean of their radii. It is larger by 1e-14, dozens of units in the
    /// last place, so that it is kept in whatever order a caller evaluates distances.
    fn distance(a: f64, b: f64) -> f64 {
        0.5 * (1.0 + 1e-14) * (a + b)
    }

    /// The distance of two samples, as a multiple of the mean of their radii.
    pub fn ratio(&self, other: &Self) -> f64 {
        distance_squared(self.position, other.position).sqrt() / (0.5 * (self.radius + other.radius))
    }

    /// True if two samples are too close to each other.
    pub fn conflicts(&self, other: &Self, facing: Facing) -> bool {
        let distance = Self::distance(self.radius, other.radius);
        distance_squared(self.position, other.position) < distance * distance && facing.sees(self.normal, other.normal)
    }
}
