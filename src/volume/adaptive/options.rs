//! The options of sets of volumes whose radius varies.

use crate::points::{Boundary, Domain};
use crate::psp::adaptive::RadiusFunction;
use crate::setters::setters;
use crate::volume::InsideOptions as Uniform;

/// The radius as it varies over a volume. Radii larger than four times the diagonal of the domain are reduced to that.
#[derive(Clone, Copy)]
pub enum Radius<'a> {
    /// A radius for each position.
    Function {
        /// Gives the radius at a position of the domain, on a torus in its first period; for a sample, at the floats that are
        /// returned. Some 60 calls for each sample, from several threads at once, unless the context has only one.
        at: &'a RadiusFunction<'a>,
        /// The least radius that it gives: above 0, and at least 64 float spacings at the domain's largest coordinate.
        smallest: f64,
        /// The largest radius that it gives.
        largest: f64,
        /// The largest change of the radius per unit of distance: 0 or above. It need not hold across the seam of a torus.
        /// Coverage is proved with it, so it must hold; if a violation is found, the call fails. The work grows with its cube
        /// from about 1 on, and may be too much, which is refused. At most `smallest` / 24 per float spacing.
        slope: f64,
    },
    /// Values on a grid over the domain, or over the box around the mesh, linear between them along each axis: the first and
    /// the last along an axis lie on the faces of the domain. The steepest place decides how much work all others are.
    Grid {
        /// Positive and finite; x is the fastest, then y. Values that are not below 64 float spacings.
        values: &'a [f32],
        /// The number of values along x, y and z; at least 1 each. One is for the whole axis.
        size: [usize; 3],
    },
}

/// The options of [`sample`](super::sample).
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct Options<'a> {
    /// The radius in the domain.
    pub radius: Radius<'a>,
    /// The cuboid to sample, even one that is thinner than the radius. On a torus whose period is below the radius a sample does
    /// not conflict with its own image.
    pub domain: Domain<3>,
    /// Selects one of 2^64 sets.
    pub seed: u64,
}

impl<'a> Options<'a> {
    /// These radii on the unit torus, with seed 0.
    pub fn new(radius: Radius<'a>) -> Self {
        Self { radius, domain: Domain::unit(Boundary::Periodic), seed: 0 }
    }
}

setters!(Options<'a> { domain: Domain<3>, seed: u64 });

/// The options of [`sample_inside`](super::sample_inside).
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct InsideOptions<'a> {
    /// The radius in the box around the mesh.
    pub radius: Radius<'a>,
    /// The side of the voxels at the surface that may stay open, in radii of the place: 1/256 to 1/2, by default 1/16.
    pub tolerance: f64,
    /// Selects one of 2^64 sets.
    pub seed: u64,
}

impl<'a> InsideOptions<'a> {
    /// These radii with the default tolerance and seed 0.
    pub fn new(radius: Radius<'a>) -> Self {
        Self { radius, tolerance: Uniform::new(1.0).tolerance, seed: 0 }
    }
}

setters!(InsideOptions<'a> { tolerance: f64, seed: u64 });
