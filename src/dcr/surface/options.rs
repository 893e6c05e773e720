//! The options and the report of relaxation on meshes.

use crate::dcr::relaxation::Stopped;
use crate::error::{Error, Result};
use crate::setters::setters;

/// The options of [`relax`](fn@super::relax).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The largest number of steps. 0 returns the samples as they are, but moves those that rounding has put outside
    /// their triangle to its edge.
    pub max_iterations: u32,
    /// The motion ([`Report::motion`]) at which the set has converged; 0 makes all steps unless nothing moves at all.
    pub tolerance: f64,
    /// Where samples that coincide are moved, and where heaped samples are dealt out; used for nothing else.
    pub seed: u64,
}

impl Default for Options {
    /// At most 100 steps, tolerance 0.0005.
    fn default() -> Self {
        Self { max_iterations: 100, tolerance: 0.0005, seed: 0 }
    }
}

impl Options {
    /// Refuses what is out of its range.
    pub(super) fn check(&self) -> Result<()> {
        if !(0.0..).contains(&self.tolerance) {
            return Err(Error::invalid("tolerance", format!("{} is not at least 0", self.tolerance)));
        }
        Ok(())
    }
}

setters!(Options { max_iterations: u32, tolerance: f64, seed: u64 });

/// What [`relax`](fn@super::relax) did. `d_max = sqrt(2 A / (sqrt(3) N))` is the distance of neighbours in the hexagonal
/// arrangement of as many samples on a plane of the mesh's area A.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// The number of steps made.
    pub iterations: u32,
    /// Why there were no more.
    pub stopped: Stopped,
    /// Half of the distance that samples covered in the last 10 steps, or since the start if there were fewer: root mean
    /// square, in units of `d_max`.
    pub motion: f64,
    /// The smallest straight distance between two of the returned samples, in the units of the mesh, on whatever parts
    /// of the surface they are; infinite for less than two.
    pub smallest_distance: f64,
    /// The smallest distance in units of `d_max`; infinite for less than two samples. It ends lower where parts of the
    /// surface are closer to each other than samples, as on thin blades; `docs/dcr.md` has what meshes reach.
    pub rho: f64,
}
