//! Geometry in floats, shared by relaxation and analysis: Delaunay triangulations, circumcircles, and the frame of a domain.

mod circumcircle;
mod delaunay;
mod frame;

pub use circumcircle::{circumcentre, circumradius_squared, scaled_circumcentre};
pub use delaunay::{Delaunay, Dual};
pub use frame::{Frame, Site, along_strips};
