//! Blue-noise sampling: maximal Poisson-disk sets in the plane, on triangle meshes and in space, and their relaxation.
//!
//! | module | what it makes | source |
//! |---|---|---|
//! | [`kdrt`] | massive maximal Poisson-disk sets in the plane | thesis ch. 2 |
//! | [`psp`] | Poisson-disk samples on triangle meshes, maximal if wanted | thesis ch. 3 |
//! | [`dcr`] | a point set, in the plane, on a mesh or in a cuboid, relaxed by distance constraints | thesis ch. 4 |
//! | [`mod@thin`] | some points of a cloud, far from each other and near to all the others | Gonzalez 1985 |
//! | [`volume`] | maximal Poisson-disk sets of cuboids and of the inside of meshes | Ebeida et al. 2012 |
//! | [`mask`] | blue-noise masks: images of ranks, for dithering and for a sample per pixel | Ulichney 1993 |
//! | [`maximal`] | the unbiased set that the others are measured by | Ebeida et al. 2012 |
//! | [`analysis`] | spacing, coverage, spectra, distances, triangles and bond order of any set | |
//!
//! The thesis is Wang Tong, *Techniques on Mining Effective Parallelism For High-Performance Blue-Noise Sampling*,
//! University of Tokyo, 2019. Each file says which section it is and where it departs.
//!
//! # Guarantees
//! * *Conflict-free*: no two samples are closer than the radius, in `f64` from the returned floats, without tolerance.
//! * *Maximal*: no point of the domain is farther from every sample than the radius and a few float spacings at the
//!   largest coordinate; each sampler says how many.
//! * *Deterministic*: the same options and seed give the same bytes, for any number of threads and order of calls.
//!
//! # Conventions
//! * The *radius* is the smallest distance from centre to centre, everywhere.
//! * Every long call takes a [`Context`], the threads that it may use, and an optional [`Progress`] callback, which
//!   can cancel it. It runs to its end before it returns, and can be made from several threads at once.
//! * Arguments are checked before work starts; an [`Error`] names the argument and its value.
//!
//! ```
//! use azulejo::{Boundary, Context, Domain, kdrt};
//!
//! let context = Context::new(0)?;
//! let domain = Domain::unit(Boundary::Periodic);
//! let options = kdrt::Options::new(0.01).domain(domain).seed(7);
//! let samples = kdrt::sample(&context, &options, None)?;
//! assert!(samples.len() > 6_800);
//! # Ok::<(), azulejo::Error>(())
//! ```

#![deny(unsafe_code)]
// Elementary functions are those of math.rs; tests may use any.
#![cfg_attr(not(test), deny(clippy::disallowed_methods))]
#![cfg_attr(test, allow(clippy::disallowed_methods))]

pub mod analysis;
mod centred;
mod check;
mod classes;
pub mod dcr;
mod editable;
mod error;
mod geometry;
mod given;
mod host;
mod index;
mod interior;
mod job;
pub mod kdrt;
mod kept;
mod levels;
pub mod mask;
mod math;
pub mod maximal;
mod memory;
pub mod mesh;
mod order;
mod plane;
mod points;
pub mod psp;
mod region;
mod rng;
mod setters;
#[allow(unsafe_code)] // Vector instructions.
mod simd;
pub mod thin;
#[allow(unsafe_code)]
pub mod trace;
pub mod volume;

pub use centred::Centred;
pub use classes::Classes;
pub use editable::EditableSet;
pub use error::{Error, Result};
pub use given::Given;
pub use interior::Interior;
pub use job::{Context, Progress};
pub use order::Order;
pub use points::{Boundary, Domain, MAXIMAL_DENSITY, MAXIMAL_DENSITY_IN_SPACE, Points};
pub use region::Region;

/// The code blocks of the README are compiled with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
