//! Projection: a planar pattern is projected along three orthogonal directions through the mesh, and all hits on all rays are
//! candidates (thesis §3.2 and §3.3).

pub(super) mod collector;
mod pattern;
pub(super) mod projection;
pub(super) mod projector;
mod raster;
mod rays;
