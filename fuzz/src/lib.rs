//! What the fuzz targets share. They call the C ABI as a hostile C program does, check what the header promises for a
//! success, and ask every refusal for its message. A panic ends the target, also where the library would catch it.

pub mod arrays;
pub mod calls;
pub mod deformed;
pub mod files;
pub mod input;
mod mesh_density;
pub mod relaxation;
pub mod surface;
mod surface_relaxation;
mod varying;
mod varying_coverage;

pub use azulejo_c as c;
