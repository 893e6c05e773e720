//! What the relaxation methods of the plane share: the torus in integers, the boundary, long waves, constraints, motion.

pub(crate) mod border;
pub(crate) mod constraints;
pub(crate) mod motion;
pub(crate) mod torus;
#[cfg(test)]
pub(crate) mod wandering;
pub(crate) mod waves;
