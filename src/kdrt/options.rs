//! What to sample.

use crate::error::{Error, Result};
use crate::points::{Boundary, Domain};
use crate::setters::setters;

/// The leaf size, in radii, that balances speed and spectrum.
pub const DEFAULT_LEAF_SIZE: f64 = 20.0;

/// The smallest leaf size, in radii: below it the seams of three leaves could act on each other.
pub const MIN_LEAF_SIZE: f64 = 6.0;

/// What to sample.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The smallest centre-to-centre distance, above 0 and at least 64 float spacings at the domain's largest
    /// coordinate. It may exceed the domain: one sample is the result.
    pub radius: f64,
    /// Where to sample: any rectangle, also one thinner than the radius. On a torus whose period is below the radius
    /// a sample does not conflict with its own image.
    pub domain: Domain,
    /// The shortest side of a leaf, in radii: at least [`MIN_LEAF_SIZE`], usually [`DEFAULT_LEAF_SIZE`]. Sides are
    /// random, up to twice this. Larger is faster and less biased at the seams, and needs a larger pattern.
    pub leaf_size: f64,
    /// The same options and seed give the same samples.
    pub seed: u64,
}

impl Options {
    /// This radius on the unit torus, with leaves of [`DEFAULT_LEAF_SIZE`] and seed 0.
    pub fn new(radius: f64) -> Self {
        Self { radius, domain: Domain::unit(Boundary::Periodic), leaf_size: DEFAULT_LEAF_SIZE, seed: 0 }
    }
}

setters!(Options { radius: f64, domain: Domain, leaf_size: f64, seed: u64 });

pub(super) fn check_leaf_size(leaf_size: f64) -> Result<()> {
    if leaf_size.is_finite() && leaf_size >= MIN_LEAF_SIZE {
        return Ok(());
    }
    let reason = format!("{leaf_size:?} is not a finite number of at least {MIN_LEAF_SIZE} (radii)");
    Err(Error::invalid("leaf_size", reason))
}
