//! Adaptive sampling: maximal Poisson-disk samples on triangle meshes whose radius varies (thesis §3.4.4).
//!
//! The radius is given for each vertex of the mesh, or by a function of the position, or follows from a density
//! ([`Radius`]).
//!
//! * *Conflict-free*: two samples are no closer than the mean of their radii, in `f64` from the returned positions and
//!   radii: disks of half the radius around the samples do not overlap. Where the radius changes linearly the mean is
//!   the radius half-way between them, so that locally the set is like one of constant radius.
//! * *Maximal*: no point of the surface is farther from every sample than the mean of the radii of the two. Tolerance:
//!   [`TOLERANCE`](super::TOLERANCE) float spacings at the largest coordinate of the mesh, and the change of the radius
//!   over that distance; with radii of vertices also 2^-22 of the largest difference of two radii on a triangle, for
//!   the rounding of the barycentrics.
//! * *Around given samples* ([`Options::given`]), as [`psp`](super) is.
//! * *Dense*: where the radius changes little from sample to sample there are 0.6966 / radius² samples on an area of 1.
//! * *In progressive order* ([`Options::order`]): every prefix is such a set as well, of larger radii.
//! * *Deterministic*: the samples and their order depend on mesh, radii and seed only.
//!
//! The thesis projects patterns of the smallest radius and thins them, which wastes most rays where radii differ. Here
//! the set is only filled (see `psp/fill/mod.rs`), octave by octave, without Embree.

mod density;
mod field;
mod grid;
mod ground;
mod options;
mod pieces;
mod sample;
mod set;
mod site;

pub use options::{Density, DensityFunction, Options, Radius, RadiusFunction, Scale, Texture};
pub use sample::sample;

// Classes whose radii vary are filled by the same parts (`psp/classes/graded.rs`).
pub(crate) use density::{DensityField, PIECES};
pub(crate) use field::{FirstError, Quota, RadiusBounds, RadiusField, of_function};
pub(crate) use ground::GradedGround;
pub(crate) use pieces::{MeasuredTriangles, checked_samples};
pub(crate) use sample::checked_count;
pub(crate) use set::FARTHEST;
pub(crate) use site::{CubeOfPieces, GradedSite, GradedSurface, fill_octaves};
