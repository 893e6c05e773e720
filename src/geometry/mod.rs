//! Geometry in floats, shared by relaxation, analysis and mesh sampling: Delaunay triangulations, circumcircles, frames,
//! grids, and the counting sort behind grids and lists of neighbours.

pub(crate) mod circumcircle;
pub(crate) mod counting_sort;
pub(crate) mod delaunay;
pub(crate) mod frame;
pub(crate) mod grid2;
pub(crate) mod grid3;
