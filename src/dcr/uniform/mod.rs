//! The momentum method at a constant density: push, pull, and long waves removed.
//!
//! It keeps from the thesis: neighbours in conflict repel each other, neighbourhoods are Delaunay stars or nearest
//! points, all points move at once by the forces that they gather. What is newer, or measured here:
//!
//! * holes attract, not long edges (`ground/constraints.rs`);
//! * points have momentum instead of activeness: alternating forces cancel out, steady ones add up;
//! * the density's long waves are removed directly, every few steps (`ground/waves.rs`), and in the first steps finer
//!   ones;
//! * the boundary of a bounded domain is a mirror in which points do not see themselves (`ground/boundary.rs`);
//! * constraints grow stiffer: soft ones let the set stay irregular while it spreads, stiff ones leave no violations;
//! * points that block each other for good are kicked, and those that flat triangles jam move as if in no mesh;
//! * the triangulation is kept and repaired by flips (`flip_mesh`). Where it cannot be, with a few points or large
//!   holes, it is built anew in every step.

mod cells;
mod classes;
mod flip_mesh;
mod gather;
mod relaxation;
mod rings;
mod stars;
mod tiles;
#[allow(unsafe_code)] // Vector instructions.
mod vectors;

pub(super) use classes::ClassRelaxation;
pub(super) use relaxation::UniformRelaxation;
