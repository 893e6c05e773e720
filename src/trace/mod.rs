//! Embree behind one small type: a scene of triangles, and every hit on every ray that is sent through it.
//!
//! This is the ray tracing of PSP (thesis §3.3.2), with one departure. The thesis restarts each ray behind its last
//! hit; here a filter records every hit and rejects it, so that one traversal finds them all. That is 1.5 to 1.9 times
//! faster, and a restart loses hits that lie within its epsilon of the last one.
//!
//! All that can go wrong in Embree is kept out here. Debian builds Embree 3.13 with assertions: a ray that is not finite
//! ends the process. All versions drop triangles with bad vertices or indices without a word.
//!
//! A build without the feature `embree` has the same items, and no scene can be made ([`HAS_EMBREE`]).

#[cfg(feature = "embree")]
mod build;
#[cfg(feature = "embree")]
mod host;
#[cfg(feature = "embree")]
mod layout;
#[cfg(feature = "embree")]
mod packet;
mod ray;
#[cfg(feature = "embree")]
mod recorder;
#[cfg(feature = "embree")]
mod scene;
#[cfg(feature = "embree")]
mod settle;
#[cfg(feature = "embree")]
mod watch;
#[cfg(all(feature = "embree", target_arch = "x86_64"))]
mod wide;

#[cfg(not(feature = "embree"))]
mod absent;

#[cfg(not(feature = "embree"))]
pub use absent::{HostBuffers, Scene, host_buffers};
#[cfg(feature = "embree")]
pub use host::{HostBuffers, host_buffers};
pub use ray::{Hit, Ray};
#[cfg(feature = "embree")]
pub use scene::Scene;

/// Whether this build has Embree, the feature `embree`.
pub const HAS_EMBREE: bool = cfg!(feature = "embree");
