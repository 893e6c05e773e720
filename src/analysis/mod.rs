//! Analysis: what a set of samples is like, whoever made it.
//!
//! Nothing else in the library depends on these modules; they are here so that every guarantee can be checked. They
//! are written for clarity and tested against brute force.

pub mod bonds;
pub mod coverage;
pub mod differential;
pub mod distribution;
pub mod facing;
pub mod figures;
mod probes;
pub mod spacing;
pub mod spectrum;
pub mod triangles;

use crate::error::{Error, Result};

/// Refuses positions that are not finite.
fn check_positions(positions: &[[f32; 3]]) -> Result<()> {
    match positions.iter().position(|position| position.iter().any(|x| !x.is_finite())) {
        None => Ok(()),
        Some(index) => {
            let reason = format!("position {index} is {:?}, not finite", positions[index]);
            Err(Error::invalid("positions", reason))
        }
    }
}
