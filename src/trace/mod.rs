//! Embree behind one small type: a scene of triangles, and every hit on every ray that is sent through it.
//!
//! This is the ray tracing of PSP (thesis §3.3.2), with one departure. The thesis restarts each ray behind its last
//! hit; here a filter records every hit and rejects it, so that one traversal finds them all. That is 1.5 to 1.9 times
//! faster, and a restart loses hits that lie within its epsilon of the last one.
//!
//! Input that Embree does not tolerate is kept out here. Debian builds Embree 3.13 with assertions: a ray that is not
//! finite ends the process. All versions silently drop triangles with bad vertices or indices.
//!
//! A build without the feature `embree` has the same items, and no scene can be made ([`HAS_EMBREE`]).

#[cfg(feature = "embree")]
mod packet;
#[cfg(feature = "embree")]
mod recorder;
#[cfg(feature = "embree")]
mod scene;
#[cfg(feature = "embree")]
mod watch;
#[cfg(all(feature = "embree", target_arch = "x86_64"))]
mod wide;

#[cfg(not(feature = "embree"))]
mod absent;

#[cfg(not(feature = "embree"))]
pub use absent::{HostBuffers, Scene, host_buffers};
#[cfg(feature = "embree")]
pub use scene::{HostBuffers, Scene, host_buffers};

/// True if this build has Embree, the feature `embree`.
pub const HAS_EMBREE: bool = cfg!(feature = "embree");

/// The largest coordinate: Embree ignores geometry that is farther from the origin (its `FLT_LARGE` is 1.844e18).
#[cfg(feature = "embree")]
pub(super) const LARGEST_COORDINATE: f32 = 1e18;

/// A ray that starts at a point and has no end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// The start of the ray.
    pub origin: [f32; 3],
    /// The direction, of any length above zero.
    pub direction: [f32; 3],
}

/// A point where a ray meets a triangle, on either side of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The index of the ray in the call.
    pub ray: u32,
    /// The index of the triangle in the scene.
    pub triangle: u32,
    /// Barycentrics: the hit is `(1 - u - v) * a + u * b + v * c` of the triangle's vertices. They are rounded, and may
    /// lie outside the triangle by a few float spacings.
    pub uv: [f32; 2],
    /// The hit is `origin + t * direction`, and `t` is above zero (infinite, if a float cannot hold it).
    pub t: f32,
}
