//! Rays and their hits.

/// Embree leaves out what is farther from the origin (its `FLT_LARGE` is 1.844e18).
#[cfg(feature = "embree")]
pub(super) const LARGEST_COORDINATE: f32 = 1e18;

/// A ray that starts at a point and has no end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: [f32; 3],
    /// Where it goes: of any length above zero.
    pub direction: [f32; 3],
}

/// A point where a ray meets a triangle, on either side of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The index of the ray among those that were traced.
    pub ray: u32,
    /// The index of the triangle in the scene.
    pub triangle: u32,
    /// Barycentrics: the hit is `(1 - u - v) * a + u * b + v * c` of the triangle's vertices. They are rounded, and may
    /// lie outside the triangle by a few float spacings.
    pub uv: [f32; 2],
    /// The hit is `origin + t * direction`, and `t` is above zero (infinite, if a float cannot hold it).
    pub t: f32,
}
