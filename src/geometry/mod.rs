//! Geometry in floats, shared by relaxation, analysis and mesh sampling: Delaunay triangulations, circumcircles, frames,
//! grids.

pub(crate) mod circumcircle;
pub(crate) mod delaunay;
pub(crate) mod frame;
pub(crate) mod grid2;
pub(crate) mod grid3;
