//! The options of sets of the plane.

use crate::classes::Classes;
use crate::error::{Error, Result};
use crate::given::Given;
use crate::order::{DEFAULT_QUOTIENT, check_quotient};
use crate::points::{Boundary, Domain};
use crate::setters::setters;

/// The leaf size, in radii, that balances speed and spectrum.
pub const DEFAULT_LEAF_SIZE: f64 = 20.0;

/// The smallest leaf size, in radii: below it the seams of three leaves could act on each other.
pub const MIN_LEAF_SIZE: f64 = 6.0;

/// The radii of a set, and with them its order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind<'a> {
    /// One radius, in an arbitrary order: the smallest centre-to-centre distance, above 0 and at least 64 float
    /// spacings at the domain's largest coordinate. It may exceed the domain: one sample is the result.
    Plain(f64),
    /// One radius, in progressive order: every prefix is well spread, and samples have ranks. See [`Progressive`].
    Progressive(f64, Progressive),
    /// Several classes of samples, which have radii of their own.
    ///
    /// Samples of classes i and j are at least [`Classes::radius`]`(i, j)` apart, in `f64` from the returned floats,
    /// without tolerance. For each class i every point of the domain is within `radius(i, j)` + 3 float spacings of
    /// some sample of some class j. Samples are sorted by class; those of a class by y, and by x where y is the same. A
    /// single class has the set and the order of [`Kind::Plain`].
    ///
    /// Classes of larger own radii come first and have the density that they have alone; the others fill what these
    /// leave them. Classes of equal own radii are filled together, by darts of equal rates, and get equal shares. So
    /// two radii that are nearly equal give other shares than two equal ones. Sets that are not tiled are up to 0.5 %
    /// denser than by sequential darts.
    ///
    /// The [clearances](Given::clearances) of given samples have a row for each of them, with a number for each class;
    /// without them, each class keeps its own radius from given samples. Positions within the clearances need no
    /// sample, up to 6 float spacings.
    ///
    /// A torus that is narrower than two fill blocks, about 10 times the largest distance between classes of equal own
    /// radii, is filled by one thread.
    Classes(&'a Classes),
    /// Several classes, each of which is in progressive order: its samples are sorted coarse to fine, and have
    /// [ranks](crate::Points::ranks).
    ///
    /// A set of [`Kind::Classes`] in which the classes of one own radius R are made level by level. A rank is the radius
    /// of a level. The samples of a class up to a rank t are at least t apart, those of classes of equal own radii at
    /// least `radius(i, j)` · t / R. Every point of the domain is within the quotient times `radius(i, j)` · t / R of one
    /// of them, or within `radius(i, j)` of a sample of a class of larger own radius: these keep their distance from the
    /// first level on. For less than [`Order::FIRST_COUNT`](crate::Order::FIRST_COUNT) samples of a class the quotient
    /// is larger, as in [`Progressive`]. So each class can be thinned independently.
    ///
    /// The coarsest radius is that of the first level of each class, at least the largest own radius. The coarse levels
    /// of a class depend on the classes of larger radii within some 30 of their radii: windows of large domains need a
    /// coarsest radius of a few times the largest own one.
    ProgressiveClasses(&'a Classes, Progressive),
}

/// The levels of a progressive order: nested maximal sets, coarse to fine.
///
/// A sample has a rank, rounded down to a float, in the units of the domain. Ranks never rise. The first i samples are
/// at least as far apart as the i-th rank, and no point of the domain is farther from them than the quotient times this
/// rank, up to 6 float spacings at the largest coordinate; for fewer than [`Order::FIRST_COUNT`] samples, than twice
/// the rank, or the square of the quotient times it if that is more. The bound on coverage holds from the samples of
/// the coarsest level on, which all have the rank of the first: its radius, or the diagonal of the domain if that is
/// shorter. In the latter case there is only one of them, and the bound holds for every prefix.
///
/// [`Order::FIRST_COUNT`]: crate::Order::FIRST_COUNT
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Progressive {
    /// The factor by which the radius of each level is longer than that of the next, in
    /// [`QUOTIENTS`](super::QUOTIENTS), usually [`DEFAULT_QUOTIENT`]. A window needs a margin of about 145 radii of
    /// each level at 2^(1/8), 75 at 2^(1/4) and 41 at 2^(1/2).
    pub quotient: f64,
    /// The radius of the coarsest level, at least that of the set; the guarantee on prefixes holds from its samples on.
    /// With infinity, the default, it is the smallest power of two times the radius of the set that reaches over the
    /// domain, so that it holds for every prefix. A shorter one saves work where windows are made of very large
    /// domains.
    ///
    /// Sets with the same coarsest radius share their levels. If the quotient is a root of two, as the default is, and
    /// the radius of one is a power of two times that of another, then it is a prefix of it, bit for bit.
    pub coarsest: f64,
}

impl Progressive {
    /// Levels with the [`DEFAULT_QUOTIENT`] from one that reaches over the domain.
    pub fn new() -> Self {
        Self { quotient: DEFAULT_QUOTIENT, coarsest: f64::INFINITY }
    }

    /// Refuses levels that do not lead to a radius.
    pub(crate) fn check(&self, radius: f64) -> Result<()> {
        let &Self { quotient, coarsest } = self;
        check_quotient(quotient)?;
        if !(coarsest > 0.0 && coarsest >= radius) {
            return Err(Error::invalid("coarsest", format!("{coarsest:?} is not at least the radius {radius:?}")));
        }
        Ok(())
    }
}

impl Default for Progressive {
    fn default() -> Self {
        Self::new()
    }
}

setters!(Progressive { quotient: f64, coarsest: f64 });

/// The options of a set of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options<'a> {
    /// The radii of the set, and its order.
    pub kind: Kind<'a>,
    /// The domain to sample: any rectangle, even one thinner than the radius. On a torus whose period is below the
    /// radius a sample does not conflict with its own image.
    pub domain: Domain,
    /// The shortest side of a leaf, in radii: at least [`MIN_LEAF_SIZE`], usually [`DEFAULT_LEAF_SIZE`]. Sides are
    /// random, up to twice this. Larger leaves are faster and less biased at the seams, and need a larger pattern.
    pub leaf_size: f64,
    /// The same options and seed give the same samples.
    pub seed: u64,
    /// Samples that exist already, anywhere in the plane; on a torus they wrap. New samples are at least the clearance
    /// of each from it, in `f64` from the floats, and every point of the domain is within the radius of a new sample or
    /// the clearance of a given one, up to 6 float spacings at the domain's largest coordinate. Given samples are not
    /// part of the result, and are not compared with each other.
    pub given: Given<'a, 2>,
}

impl<'a> Options<'a> {
    /// One radius in an arbitrary order, on the unit torus, with leaves of [`DEFAULT_LEAF_SIZE`], seed 0 and no given
    /// samples.
    pub fn new(radius: f64) -> Self {
        Self::of(Kind::Plain(radius))
    }

    /// [`Options::new`] in progressive order.
    pub fn progressive(radius: f64, levels: Progressive) -> Self {
        Self::of(Kind::Progressive(radius, levels))
    }

    /// [`Options::new`] with several classes instead of a radius.
    pub fn classes(classes: &'a Classes) -> Self {
        Self::of(Kind::Classes(classes))
    }

    /// [`Options::new`] with these radii in this order.
    pub fn of(kind: Kind<'a>) -> Self {
        Self {
            kind,
            domain: Domain::unit(Boundary::Periodic),
            leaf_size: DEFAULT_LEAF_SIZE,
            seed: 0,
            given: Given::default(),
        }
    }
}

setters!(Options<'a> {
    kind: Kind<'a>,
    domain: Domain,
    leaf_size: f64,
    seed: u64,
    given: Given<'a, 2>,
});

/// Refuses leaves whose seams could act on each other.
pub fn check_leaf_size(leaf_size: f64) -> Result<()> {
    if leaf_size.is_finite() && leaf_size >= MIN_LEAF_SIZE {
        return Ok(());
    }
    let reason = format!("{leaf_size:?} is not a finite number of at least {MIN_LEAF_SIZE} (radii)");
    Err(Error::invalid("leaf_size", reason))
}
