//! Geometry in floats, shared by relaxation and analysis: Delaunay triangulations, circumcircles, frames of domains.

mod delaunay;
mod frame;

pub use delaunay::{Delaunay, Dual, circumradius_squared, scaled_circumcentre};
pub use frame::{Frame, Site, along_strips};
