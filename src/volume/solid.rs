//! Sets of the inside of a mesh.

use std::sync::Arc;

use crate::error::Result;
use crate::given::Given;
use crate::host::Stopwatch;
use crate::job::{Context, Progress};
use crate::mesh::Mesh;
use crate::points::Points;
use crate::psp;
use crate::volume::body::Body;
use crate::volume::inside_options::InsideOptions;
use crate::volume::{Options, fill};

/// The share of the work for samples of the surface.
const OF_SURFACE: f64 = 0.2;

/// The report of [`sample_inside`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct InsideReport {
    /// No two samples are nearer: the radius of the options, or that of the set of a count.
    pub radius: f64,
    /// No place inside that is deeper than `depth`, and in a shell less deep than its thickness by more than that, is farther
    /// from all samples, and outside of all given ones, up to the tolerance of [`sample`](super::sample): the radius, or of a
    /// count up to 1.1 times it, in progressive order the quotient times it.
    pub covering_radius: f64,
    /// The greatest depth at which places can be open: sqrt(3) times the tolerance and a few float spacings. In a shell, whose tolerance
    /// is a quarter of the thickness at most, also the greatest distance from its inner border.
    pub depth: f64,
    /// The number of samples of the surface, which come first.
    pub surface_samples: usize,
    /// Wall time in seconds.
    pub seconds: f64,
}

/// A maximal Poisson-disk set of the inside of a mesh.
///
/// The holes of a mesh that is not closed ([`Mesh::is_closed`]) get caps: each ring of edges that an odd number of triangles shares is
/// filled by triangles whose vertices lie, where one is near, on the level 1/2 of the generalised winding number. The inside is that of
/// the mesh with its caps, without tolerance; what is said of the surface below, but for the samples on it, is said of the caps as well.
/// At holes that are about flat all samples wind more than .47; where heights of a rim jump from vertex to vertex some wind .34 that are
/// no farther from it than two of its edges. A flat sheet and a triangle that shares no edge are their own caps, and enclose nothing.
///
/// * Inside: each sample is, without rounding, by [`Interior::contains`](crate::Interior::contains) of the mesh with its caps, but those of
///   the surface.
/// * Conflict-free: all distances of the returned floats are at least `radius`, in `f64`, without tolerance.
/// * Maximal: no place inside is farther than `radius` + 7 float spacings at the mesh's largest coordinate from all samples, unless
///   it is nearer to the surface than the report's `depth`.
///
/// With a [thickness](InsideOptions::thickness) the domain is the shell of the inside along the surface. The square of the distance of each
/// sample from the nearest triangle is, computed in `f64` from the returned floats, at most that of the thickness; samples of the
/// surface lie on it up to rounding. Places may also stay open that are nearer to the inner border than `depth`. The tolerance is a quarter
/// of the thickness at most, but no less than 1/1024 radius: for a count that is so small that `depth` is half the thickness or more,
/// nothing is promised to be covered.
///
/// About [`MAXIMAL_DENSITY_IN_SPACE`](crate::MAXIMAL_DENSITY_IN_SPACE) samples per cubed radius, and more beside the surface. All else is as for
/// [`sample`](super::sample): order, count, ranks, given samples. The prefix of a progressive set leaves places open at the surface
/// that are less deep than sqrt(3) tolerances of its own covering radius.
///
/// O(n) for n samples and O(t log t) for t triangles, the latter once for a mesh: [`Interior::of`](crate::Interior::of). Caps,
/// of up to 10^4 triangles each, are also made once: the five of the Stanford bunny in some 0.15 s.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for a `mesh` that encloses nothing and for an option out of range, also for
/// [`Surface::First`](crate::volume::Surface::First) with a count or in progressive order, and for a count where given samples
/// leave no place; [`Error::TooLarge`](crate::Error::TooLarge) above 2^32 samples or the available memory;
/// [`Error::Cancelled`](crate::Error::Cancelled).
pub fn sample_inside(
    context: &Context,
    mesh: &Arc<Mesh>,
    options: &InsideOptions,
    progress: Option<&Progress>,
) -> Result<(Points<3>, InsideReport)> {
    let stopwatch = Stopwatch::start();
    options.check()?;
    let body = Body::new(mesh, options.tolerance, options.thickness)?;
    let (surface_radius, mut positions) = (options.surface_radius()?, Vec::new());
    let &InsideOptions { amount, seed, order, quotient, given, .. } = options;
    if let Some(radius) = surface_radius {
        let options = psp::Options::new(radius).seed(seed).given(given);
        let part = progress.map(|progress| move |share: f64| progress(OF_SURFACE * share));
        let part = part.as_ref().map(|part| part as &Progress);
        positions = psp::sample(context, mesh, &options, part)?.0.positions;
    }
    let surface_samples = positions.len();
    let (all, clearances) = beside(&given, &positions, surface_radius.unwrap_or_default());
    let around = Given { positions: &all, clearances: clearances.as_deref() };
    let around = if surface_samples == 0 { given } else { around };

    let options = Options::of(amount).domain(body.domain).seed(seed).order(order).quotient(quotient).given(around);
    let from = surface_radius.map_or(0.0, |_| OF_SURFACE);
    let rest = progress.map(|progress| move |share: f64| progress(from + (1.0 - from) * share));
    let rest = rest.as_ref().map(|rest| rest as &Progress);
    let (mut points, [radius, covering_radius]) = fill(context, &options, Some(&body), rest)?;
    if points.is_empty() && around.positions.is_empty() && body.seems_empty() {
        return Err(body.encloses_nothing());
    }
    if surface_samples > 0 {
        positions.append(&mut points.positions);
        points.positions = positions;
    }
    let (depth, seconds) = (body.depth(covering_radius), stopwatch.seconds());
    Ok((points, InsideReport { radius, covering_radius, depth, surface_samples, seconds }))
}

/// Given samples with those of the surface, and the clearances of all, if some are not the radius.
fn beside(given: &Given<3>, surface: &[[f32; 3]], radius: f64) -> (Vec<[f32; 3]>, Option<Vec<f64>>) {
    if surface.is_empty() {
        return Default::default();
    }
    let clearances = given.clearances.map(|clearances| [clearances, &vec![radius; surface.len()]].concat());
    ([given.positions, surface].concat(), clearances)
}
