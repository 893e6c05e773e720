//! Embree behind one small type: a scene of triangles, and every hit on every ray that is sent through it.
//!
//! This is the ray tracing of PSP (thesis §3.3.2), with one departure. The thesis restarts each ray behind its last
//! hit; here a filter records every hit and rejects it, so that one traversal finds them all. That is 1.5 to 1.9 times
//! faster, and a restart loses hits that lie within its epsilon of the last one.
//!
//! All that can go wrong in Embree is kept out here. Debian builds Embree 3.13 with assertions: a ray that is not finite
//! ends the process. All versions drop triangles with bad vertices or indices without a word.

mod build;
mod host;
mod layout;
mod packet;
mod ray;
mod recorder;
mod scene;
mod settle;
mod watch;
#[cfg(target_arch = "x86_64")]
mod wide;

pub use host::{HostBuffers, host_buffers};
pub use ray::{Hit, Ray};
pub use scene::Scene;
