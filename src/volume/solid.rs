//! Sets of the inside of a mesh.

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::given::Given;
use crate::host::Stopwatch;
use crate::job::{Context, Progress};
use crate::levels::Amount;
use crate::mesh::Mesh;
use crate::order::Order;
use crate::points::{Points, check_radius};
use crate::psp;
use crate::setters::setters;
use crate::volume::body::Body;
use crate::volume::{Options, fill};

/// The tolerances that there are, in radii, and the default.
const TOLERANCES: std::ops::RangeInclusive<f64> = 1.0 / 256.0..=0.5;
const DEFAULT_TOLERANCE: f64 = 1.0 / 16.0;

/// The share of the work for samples of the surface.
const OF_SURFACE: f64 = 0.2;

/// The samples on the surface of a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Surface {
    /// None: samples lie anywhere inside.
    #[default]
    Open,
    /// A maximal set of the surface comes first, as [`psp::sample`] makes it with the same radius and seed, and the inside is
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
    /// How near to the surface places may stay open, in radii: 1/256 to 1/2, by default 1/16. A quarter of it takes about one and a
    /// half times as long. See [`sample_inside`].
    pub tolerance: f64,
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
        Self { amount, surface: Surface::Open, tolerance: DEFAULT_TOLERANCE, seed, order, quotient, given }
    }
}

setters!(InsideOptions<'a> {
    surface: Surface, tolerance: f64, seed: u64, order: Order, quotient: f64, given: Given<'a, 3>,
});

/// The report of [`sample_inside`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct InsideReport {
    /// No two samples are nearer: the radius of the options, or that of the set of a count.
    pub radius: f64,
    /// No place inside that is deeper than `depth` is farther from all samples, and outside of all given ones, up to the tolerance
    /// of [`sample`](super::sample): the radius, or of a count up to 1.1 times it, in progressive order the quotient times it.
    pub covering_radius: f64,
    /// The greatest depth at which places can be open: sqrt(3) times the tolerance and a few float spacings.
    pub depth: f64,
    /// The number of samples of the surface, which come first.
    pub surface_samples: usize,
    /// True if the mesh is closed, so that it is exactly known what is inside ([`Interior::contains`](crate::Interior::contains)).
    pub is_closed: bool,
    /// Wall time in seconds.
    pub seconds: f64,
}

/// A maximal Poisson-disk set of the inside of a mesh.
///
/// * Inside: each sample is, by [`Interior::contains`](crate::Interior::contains), but those of the surface.
/// * Conflict-free: all distances of the returned floats are at least `radius`, in `f64`, without tolerance.
/// * Maximal: no place inside is farther than `radius` + 7 float spacings at the mesh's largest coordinate from all samples, unless
///   it is nearer to the surface than the report's `depth`. Near holes of a mesh that is not closed the surface is where the winding
///   number is 1/2, up to .04.
///
/// About [`MAXIMAL_DENSITY_IN_SPACE`](crate::MAXIMAL_DENSITY_IN_SPACE) samples per cubed radius, and more beside the surface. All else is as for
/// [`sample`](super::sample): order, count, ranks, given samples. The prefix of a progressive set leaves places open at the surface
/// that are less deep than sqrt(3) tolerances of its own covering radius.
///
/// O(n) for n samples and O(t log t) for t triangles, the latter once for a mesh: [`Interior::of`](crate::Interior::of).
///
/// # Errors
/// [`Error::InvalidArgument`] for an option out of range, also for [`Surface::First`] with a count or in progressive order, and for
/// a count where there is no place inside; [`Error::TooLarge`] above 2^32 samples or the available memory; [`Error::Cancelled`].
pub fn sample_inside(
    context: &Context,
    mesh: &Arc<Mesh>,
    options: &InsideOptions,
    progress: Option<&Progress>,
) -> Result<(Points<3>, InsideReport)> {
    let stopwatch = Stopwatch::start();
    let &InsideOptions { amount, surface, tolerance, seed, order, quotient, given } = options;
    if !TOLERANCES.contains(&tolerance) {
        let reason = format!("{tolerance:?} is not from 1/256 to 1/2");
        return Err(Error::invalid("tolerance", reason));
    }
    given.check()?;
    if let Amount::Radius(radius) = amount {
        check_radius(radius)?;
    }
    let mut positions = Vec::new();
    if surface == Surface::First {
        let (Amount::Radius(radius), Order::Any) = (amount, order) else {
            let reason = "samples of the surface come first in any order, with a radius";
            return Err(Error::invalid("surface", reason));
        };
        let options = psp::Options::new(radius).seed(seed).given(given);
        let part = progress.map(|progress| move |share: f64| progress(OF_SURFACE * share));
        let part = part.as_ref().map(|part| part as &Progress);
        positions = psp::sample(context, mesh, &options, part)?.0.positions;
    }
    let surface_samples = positions.len();
    let (all, clearances) = beside(&given, &positions, amount);
    let around = Given { positions: &all, clearances: clearances.as_deref() };
    let around = if surface_samples == 0 { given } else { around };

    let body = Body::new(mesh, tolerance);
    let options = Options::of(amount).domain(body.domain).seed(seed).order(order).quotient(quotient).given(around);
    let from = if surface == Surface::First { OF_SURFACE } else { 0.0 };
    let rest = progress.map(|progress| move |share: f64| progress(from + (1.0 - from) * share));
    let rest = rest.as_ref().map(|rest| rest as &Progress);
    let (mut points, [radius, covering_radius]) = fill(context, &options, Some(&body), rest)?;
    if surface_samples > 0 {
        positions.append(&mut points.positions);
        points.positions = positions;
    }
    let (depth, is_closed, seconds) = (body.depth(covering_radius), body.is_closed(), stopwatch.seconds());
    Ok((points, InsideReport { radius, covering_radius, depth, surface_samples, is_closed, seconds }))
}

/// Given samples with those of the surface, and the clearances of all, if some are not the radius.
fn beside(given: &Given<3>, surface: &[[f32; 3]], amount: Amount) -> (Vec<[f32; 3]>, Option<Vec<f64>>) {
    let Amount::Radius(radius) = amount else {
        return Default::default();
    };
    let clearances = given.clearances.map(|clearances| [clearances, &vec![radius; surface.len()]].concat());
    ([given.positions, surface].concat(), clearances)
}
