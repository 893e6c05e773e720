//! The options and the report of a relaxation on a surface.

use crate::dcr::relaxation::{Limits, Stopped};
use crate::error::Result;
use crate::setters::setters;

/// The options of [`relax`](fn@super::relax).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The largest number of steps. 0 returns the samples unchanged, except that those outside their triangle by
    /// rounding are moved to its edge.
    pub max_iterations: u32,
    /// The motion ([`Report::motion`]) at which the set has converged; with 0 all steps are made unless nothing moves
    /// at all.
    pub tolerance: f64,
    /// The key of the moves of samples that coincide, and of the redistribution of clustered ones; used for nothing
    /// else.
    pub seed: u64,
}

impl Default for Options {
    /// At most 100 steps, tolerance 0.0005.
    fn default() -> Self {
        Self { max_iterations: 100, tolerance: 0.0005, seed: 0 }
    }
}

impl Options {
    /// Refuses values out of their range.
    pub fn check(&self) -> Result<()> {
        self.limits().check()
    }

    pub(super) fn limits(&self) -> Limits {
        Limits { max_iterations: self.max_iterations, tolerance: self.tolerance }
    }
}

setters!(Options { max_iterations: u32, tolerance: f64, seed: u64 });

/// The report of [`relax`](fn@super::relax). `d_max = sqrt(2 A / (sqrt(3) N))` is the distance of neighbours in the
/// hexagonal arrangement of as many samples on a plane of the mesh's area A.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// The number of steps made.
    pub iterations: u32,
    /// The reason why the steps ended.
    pub stopped: Stopped,
    /// Half of the distance that samples covered in the last 10 steps, or since the start if there were fewer: root
    /// mean square, in units of `d_max`.
    pub motion: f64,
    /// The smallest straight distance between two of the returned samples, in the units of the mesh, regardless of the
    /// parts of the surface that they are on; infinite for less than two.
    pub smallest_distance: f64,
    /// The smallest distance in units of `d_max`; infinite for less than two samples. It ends lower where parts of the
    /// surface are closer to each other than samples, as on thin blades; `docs/dcr.md` has the values measured on
    /// meshes.
    pub rho: f64,
}
