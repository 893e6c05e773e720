//! Geometry in floats, shared by relaxation, analysis and mesh sampling: Delaunay triangulations, frames, grids.

pub(crate) mod counting_sort;
pub(crate) mod delaunay;
pub(crate) mod frame;
pub(crate) mod grid2;
pub(crate) mod grid3;
pub(crate) mod links;
