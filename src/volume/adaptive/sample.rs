//! Adaptive sampling of volumes in one call.

use std::sync::Arc;

use crate::error::Result;
use crate::host::Stopwatch;
use crate::job::{Context, Progress};
use crate::mesh::Mesh;
use crate::points::Points;
use crate::volume::adaptive::complete::complete;
use crate::volume::adaptive::options::{InsideOptions, Options};
use crate::volume::body::Body;
use crate::volume::{InsideOptions as Uniform, Report};

/// A maximal set of samples of a cuboid, each with its own radius ([`Points::radii`]), the values of the function at the returned
/// floats. They are sorted by blocks.
///
/// * Conflict-free: the distance of two samples, on a torus of their nearest images, is at least the mean of their radii, computed in
///   `f64` from the returned floats and radii, without tolerance.
/// * Maximal: no place of the domain is farther from every sample than the mean of its radius and that of the sample, up to 3.5 float
///   spacings at the domain's largest coordinate and the change of the radius over that distance.
/// * `domain.min <= x < domain.max`.
///
/// About [`MAXIMAL_DENSITY_IN_SPACE`](crate::MAXIMAL_DENSITY_IN_SPACE) times the integral of 1 / radius³, some percent more where
/// radii change by a tenth of themselves within a radius. The report has the least radius of a sample, and the largest radius
/// that the function may have, no more than four times the diagonal of the domain. O(n) for n samples where the slope is below
/// about 1. The same samples for every number of threads.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for bad `smallest`, `largest` and `slope`, for `grid_values` that are not positive and finite and a
/// `grid_size` that is not theirs, for radii below 64 float spacings at the domain's largest coordinate, and for a function that returns a value outside
/// `smallest..=largest`, changes faster than `slope` or between calls (`radius_function`): the latter as far as it is noticed.
/// [`Error::TooLarge`](crate::Error::TooLarge) if the radii require more than 2^32 samples or more than memory holds (`radius_function`), and if they
/// change so fast that it takes too many tests to find out what is covered (`slope`, `grid_values`). [`Error::Cancelled`](crate::Error::Cancelled).
pub fn sample(context: &Context, options: &Options, progress: Option<&Progress>) -> Result<(Points<3>, Report)> {
    let (stopwatch, &Options { radius, domain, seed }) = (Stopwatch::start(), options);
    let (points, bounds) = complete(context, &domain, radius, None, seed, progress)?;
    Ok((points, report(bounds, &stopwatch)))
}

/// A maximal set of samples of the inside of a mesh, each with its own radius. Holes are closed as in
/// [`volume::sample_inside`](crate::volume::sample_inside).
///
/// As [`sample`], in the box around the mesh, of which the function has to give the radius everywhere. Each sample lies inside
/// ([`Interior::contains`](crate::Interior::contains) of the mesh with its caps). No place inside is farther from every sample than the mean of both
/// radii, with a tolerance of 7 float spacings, unless it is nearer to the surface than sqrt(3)
/// [tolerances](InsideOptions::tolerance) of its radius and four float spacings.
///
/// # Errors
/// Those of [`sample`], and [`Error::InvalidArgument`](crate::Error::InvalidArgument) for a `mesh` that encloses nothing, and for a
/// `tolerance` out of range.
pub fn sample_inside(
    context: &Context,
    mesh: &Arc<Mesh>,
    options: &InsideOptions,
    progress: Option<&Progress>,
) -> Result<(Points<3>, Report)> {
    let (stopwatch, &InsideOptions { radius, tolerance, seed }) = (Stopwatch::start(), options);
    Uniform::new(1.0).tolerance(tolerance).check()?;
    let body = Body::new(mesh, tolerance, 0.0)?;
    let (points, bounds) = complete(context, &body.domain, radius, Some(&body), seed, progress)?;
    Ok((points, report(bounds, &stopwatch)))
}

fn report([radius, covering_radius]: [f64; 2], stopwatch: &Stopwatch) -> Report {
    Report { radius, covering_radius, seconds: stopwatch.seconds() }
}
