//! Relaxation on triangle meshes: what DCR does in the plane, done on a surface (the future work of thesis §4.5).
//!
//! Samples push their neighbours away and are pulled into holes by the constraints of the momentum method in the plane,
//! and with its momentum. What differs:
//!
//! * neighbours are the samples that are reached on the surface without leaving a ball (`near.rs`, `flood.rs`), seen in
//!   the tangent plane, each at its straight distance through space; the other side of a thin wall has no effect;
//! * each sample finds its Delaunay star among them for itself (`view.rs`): there is no triangulation to be kept;
//! * samples walk straight on, from triangle to triangle (`walk.rs`), so they are on the surface at all times;
//! * at open boundaries neighbours are mirrored, so that samples neither leave nor crowd there;
//! * no two samples get closer to each other through space than the closest two were (`apart.rs`), on whatever parts of
//!   the surface they are;
//! * samples that are heaped on a part of the surface are dealt out anew before the first step (`spread.rs`);
//! * long waves of the density stay: there is no Fourier transform on a mesh.
//!
//! What is near a sample is listed for several steps (`neighbourhoods.rs`), and a step (`relaxation.rs`, `gather.rs`)
//! works on sixteen neighbours at a time (`simd/`).
//!
//! Triangles are connected by common edges (`connected.rs`). A crack is a boundary: samples on its two sides are not
//! neighbours, but keep their distance through space.

mod apart;
mod cells;
mod connected;
mod curve;
mod flood;
mod forces;
mod gather;
mod lists;
mod local;
mod near;
mod neighbourhoods;
mod options;
mod patches;
mod relax;
mod relaxation;
mod remeshing;
mod samples;
mod spread;
mod triangles;
mod view;
mod walk;
mod welding;

pub use options::{Options, Report};
pub use relax::relax;
pub use remeshing::{RemeshReport, remesh};
pub use triangles::{Triangulation, triangulate};
