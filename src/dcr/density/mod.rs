//! Density: relaxation of sets that are denser here than there, as stippling needs them (thesis §4.2.3).
//!
//! The thesis says that its radii are to be multiplied by a map of the user's, without further detail. Here:
//!
//! * The *local spacing* follows from the density, as 1 / sqrt(density) (`raster.rs`). The distance of two points is
//!   measured in the mean of their spacings, as `psp::adaptive` does, a hole by the density itself (`forces.rs`).
//! * Constraints between neighbours only relax the points locally. The number of points that the density asks for in a
//!   region is achieved by removing long waves of the excess, whose lengths scale with the local spacing (`octaves.rs`).
//!
//! All else is that of the momentum method: momentum, constraints that grow stiffer, a boundary in which points do not
//! see themselves, a mesh that is kept (`half_edge_mesh.rs`), also where wide areas have no points (`anchors.rs`). The
//! boundary has no excess of points, which would show as a frame.

mod anchors;
mod forces;
mod half_edge_mesh;
mod octaves;
mod raster;
mod relax;
mod relaxation;
mod source;

pub use relax::{relax_with_density, scatter};
pub use source::{Density, DensityFunction};
