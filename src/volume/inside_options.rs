//! The options of sets inside of meshes.

use crate::error::{Error, Result};
use crate::given::Given;
use crate::levels::Amount;
use crate::order::Order;
use crate::points::check_radius;
use crate::setters::setters;
use crate::volume::Options;

/// The tolerances that there are, in radii, and the default.
const TOLERANCES: std::ops::RangeInclusive<f64> = 1.0 / 256.0..=0.5;
const DEFAULT_TOLERANCE: f64 = 1.0 / 16.0;

/// The least thickness of a shell, in radii.
const THINNEST: f64 = 1.0 / 256.0;

/// The samples on the surface of a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Surface {
    /// None: samples lie anywhere inside.
    #[default]
    Open,
    /// A maximal set of the surface comes first, as [`psp::sample`](crate::psp::sample) makes it with the same radius and seed, and the inside is
    /// filled around it. Its samples are the first ones of the result.
    First,
}

/// The options of a set inside of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct InsideOptions<'a> {
    /// The smallest distance of two samples, at least 64 float spacings at the mesh's largest coordinate; or the number of
    /// samples.
    pub amount: Amount,
    /// By default [`Surface::Open`]. [`Surface::First`] needs a radius, and any order.
    pub surface: Surface,
    /// The side, in radii, of the voxels at the surface that may stay open: 1/256 to 1/2, by default 1/16. A quarter of it takes
    /// about one and a half times as long. See [`sample_inside`](super::sample_inside).
    pub tolerance: f64,
    /// If above 0, the domain is a shell: the places inside that are no farther from the surface than this, in the units of the mesh.
    /// At least 1/256 of a radius; by default 0: all of the inside, as from .501 times the smallest side of the box around the mesh on.
    /// See [`sample_inside`](super::sample_inside).
    pub thickness: f64,
    /// The same options and seed give the same samples.
    pub seed: u64,
    /// See [`Options::order`].
    pub order: Order,
    /// See [`Options::quotient`].
    pub quotient: f64,
    /// See [`Options::given`].
    pub given: Given<'a, 3>,
}

impl InsideOptions<'_> {
    /// This radius, anywhere inside, with seed 0, in any order and without given samples.
    pub fn new(radius: f64) -> Self {
        Self::of(Amount::Radius(radius))
    }

    /// So many samples.
    pub fn by_count(count: usize) -> Self {
        Self::of(Amount::Count(count))
    }

    /// [`InsideOptions::new`] or [`InsideOptions::by_count`].
    pub fn of(amount: Amount) -> Self {
        let Options { seed, order, quotient, given, .. } = Options::of(amount);
        let (surface, tolerance, thickness) = (Surface::Open, DEFAULT_TOLERANCE, 0.0);
        Self { amount, surface, tolerance, thickness, seed, order, quotient, given }
    }

    /// Refuses a tolerance, a thickness, given samples and a radius out of range.
    pub(super) fn check(&self) -> Result<()> {
        if !TOLERANCES.contains(&self.tolerance) {
            return Err(Error::invalid("tolerance", format!("{:?} is not from 1/256 to 1/2", self.tolerance)));
        }
        let thickness = self.thickness;
        if !(0.0..f64::INFINITY).contains(&thickness) {
            return Err(Error::invalid("thickness", format!("{thickness:?} is not finite and at least 0")));
        }
        self.given.check()?;
        let Amount::Radius(radius) = self.amount else { return Ok(()) };
        check_radius(radius)?;
        if thickness > 0.0 && thickness < THINNEST * radius {
            let reason =
                format!("{thickness:?} is neither 0 nor at least 1/256 of the radius, {:?}", THINNEST * radius);
            return Err(Error::invalid("thickness", reason));
        }
        Ok(())
    }

    /// The radius of the set of the surface, if that comes first.
    pub(super) fn surface_radius(&self) -> Result<Option<f64>> {
        match (self.surface, self.amount, self.order) {
            (Surface::Open, ..) => Ok(None),
            (Surface::First, Amount::Radius(radius), Order::Any) => Ok(Some(radius)),
            _ => Err(Error::invalid("surface", "samples of the surface come first in any order, with a radius")),
        }
    }
}

setters!(InsideOptions<'a> {
    surface: Surface, tolerance: f64, thickness: f64, seed: u64, order: Order, quotient: f64, given: Given<'a, 3>,
});
