//! What the relaxation methods share: the torus in integers, the mirror boundary, long waves, heaps, constraints, flips,
//! motion.

pub(super) mod boundary;
pub(super) mod constraints;
pub(super) mod curve;
pub(super) mod flips;
pub(super) mod heaps;
pub(super) mod level;
pub(super) mod memory;
pub(super) mod neighbours;
pub(super) mod torus;
#[cfg(test)]
pub(super) mod wandering;
pub(super) mod waves;
