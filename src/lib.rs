//! # azulejo
//!
//! Blue-noise sampling: maximal Poisson-disk sets in the plane and on triangle meshes, and their relaxation.

#![deny(unsafe_code)]

pub mod analysis;
pub mod dcr;
mod error;
mod grid2;
mod grid3;
mod job;
pub mod kdrt;
mod lattice;
pub mod maximal;
mod memory;
pub mod mesh;
mod points;
pub mod psp;
mod rng;
#[allow(unsafe_code)]
pub mod trace;

pub use error::{Error, Result};
pub use job::{Context, Progress};
pub use points::{Boundary, Domain, SurfaceSamples};
