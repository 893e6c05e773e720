//! The common part of the fuzz targets. They call the C ABI as a hostile C program does, check what the header promises
//! for a success, and ask every refusal for its message. A panic ends the target, also where the library would catch
//! it.

pub mod arrays;
pub mod calls;
mod coverage;
pub mod deformed;
#[path = "../../tests/all/common/disks.rs"]
pub mod disks;
pub mod files;
pub mod input;
mod mesh_density;
pub mod plane;
pub mod relaxation;
pub mod surface;
mod surface_relaxation;
#[path = "../../tests/all/common/tolerance.rs"]
pub mod tolerance;
pub mod varying;
#[path = "../../tests/all/common/volume_oracle.rs"]
pub mod volume_oracle;

pub use azulejo_c as c;
use tolerance::float_spacing;
// The oracles of the tests know the crate by this name.
extern crate azulejo_core as azulejo;
