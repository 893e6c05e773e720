//! Projection by rasterisation, the equivalent of ray tracing that thesis §3.4.3 describes: each triangle is drawn over the
//! projectors, and the points of the pattern that it covers are its hits.
//!
//! Corners and points are rounded to an integer lattice, 2^-30 of the projector's width, in which all is exact: adjacent
//! triangles have no gap and no overlap, and a hit does not depend on the machine's vectors or on an Embree. All triangles
//! of a tile of the projector are drawn by one task; so no counters are shared, which the thesis finds irregular.

mod drawing;
mod lattice;
mod rasteriser;
#[cfg(test)]
mod tests;
mod tiles;
mod triangle;

pub(in crate::psp) use rasteriser::Rasteriser;
