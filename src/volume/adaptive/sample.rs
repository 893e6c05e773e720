//! Adaptive sampling of volumes in one call.

use std::sync::Arc;

use crate::error::Result;
use crate::host::Stopwatch;
use crate::job::{Context, Progress};
use crate::memory;
use crate::mesh::Mesh;
use crate::plane::{Lattice, float_spacing};
use crate::points::{Domain, Points, finest_radius};
use crate::simd::Level;
use crate::volume::InsideOptions as Uniform;
use crate::volume::Report;
use crate::volume::adaptive::blocks::{Blocks, check_largest};
use crate::volume::adaptive::field::{RadiusField, Source};
use crate::volume::adaptive::options::{InsideOptions, Options, Radius};
use crate::volume::adaptive::set::{Ground, maximal};
use crate::volume::body::Body;
use crate::volume::solid::{check_closed, encloses_nothing};

/// The most bytes of memory that a sample takes, with its position and radius in the result.
const BYTES_PER_SAMPLE: f64 = 90.0;

/// The most bytes of the grid and the voxels of a block, which each thread has; and the least number of samples for which another
/// thread is of use.
const BYTES_PER_THREAD: f64 = (8 << 20) as f64;
const SAMPLES_PER_THREAD: f64 = 1000.0;

/// The share of the call that its blocks take.
const BLOCKS: f64 = 0.02;

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
/// [`Error::InvalidArgument`] for bad `smallest`, `largest` and `slope`, for `grid_values` that are not positive and finite and a
/// `grid_size` that is not theirs, for radii below 64 float spacings at the domain's largest coordinate, and for a function that returns a value outside
/// `smallest..=largest`, changes faster than `slope` or between calls (`radius_function`): the latter as far as it is noticed.
/// [`Error::TooLarge`] if the radii require more than 2^32 samples or more than memory holds (`radius_function`), and if they
/// change so fast that it takes too many tests to find out what is covered (`slope`, `grid_values`). [`Error::Cancelled`].
pub fn sample(context: &Context, options: &Options, progress: Option<&Progress>) -> Result<(Points<3>, Report)> {
    let &Options { radius, domain, seed } = options;
    fill(context, &domain, radius, None, seed, progress)
}

/// A maximal set of samples of the inside of a closed mesh ([`Mesh::is_closed`]), each with its own radius.
///
/// As [`sample`], in the box around the mesh, of which the function has to give the radius everywhere. Each sample lies inside
/// ([`Interior::contains`](crate::Interior::contains)). No place inside is farther from every sample than the mean of both
/// radii, with a tolerance of 7 float spacings, unless it is nearer to the surface than sqrt(3)
/// [tolerances](InsideOptions::tolerance) of its radius and four float spacings.
///
/// # Errors
/// Those of [`sample`], and [`Error::InvalidArgument`] for a `mesh` that is not closed or encloses nothing, and for a
/// `tolerance` out of range.
pub fn sample_inside(
    context: &Context,
    mesh: &Arc<Mesh>,
    options: &InsideOptions,
    progress: Option<&Progress>,
) -> Result<(Points<3>, Report)> {
    let &InsideOptions { radius, tolerance, seed } = options;
    Uniform::new(1.0).tolerance(tolerance).check()?;
    check_closed(mesh)?;
    let body = Body::new(mesh, tolerance, 0.0);
    if body.encloses_nothing() {
        return Err(encloses_nothing());
    }
    fill(context, &body.domain, radius, Some(&body), seed, progress)
}

fn fill(
    context: &Context,
    domain: &Domain<3>,
    radius: Radius,
    body: Option<&Body>,
    seed: u64,
    progress: Option<&Progress>,
) -> Result<(Points<3>, Report)> {
    let stopwatch = Stopwatch::start();
    domain.check()?;
    let source = Source::new(domain, radius)?;
    // Radii that floats do not allow are refused by their own name.
    let finest = finest_radius(float_spacing(domain.min.iter().chain(&domain.max)));
    let lattice = &Lattice::of_any_size(domain, finest)?;
    let field = &RadiusField::new(&source, lattice)?;
    let held = memory::available().map_or(f64::INFINITY, |bytes| bytes / BYTES_PER_SAMPLE);
    let limit = f64::from(u32::MAX).min(held);
    if body.is_none() {
        check_largest(lattice, field, limit)?;
    }
    let samples = context.run(progress, |job| {
        let blocks = Blocks::new(&job.part(0.0, BLOCKS), lattice, field, seed, limit)?;
        let expected = blocks.expected;
        let threads = (context.num_threads() as f64).min(expected / SAMPLES_PER_THREAD).max(1.0);
        let bytes = expected * BYTES_PER_SAMPLE + threads * BYTES_PER_THREAD;
        memory::require(bytes, source.argument(), &format!("about {expected:.0} samples"))?;
        let ground = Ground { lattice, field, solid: body.map(Body::solid) };
        maximal(&job.part(BLOCKS, 1.0), ground, &blocks, Level::widest())
    })?;
    let mut points = Points::from(samples.iter().map(|ball| lattice.position(ball.centre)).collect::<Vec<_>>());
    points.radii = samples.iter().map(|ball| ball.radius * lattice.unit()).collect();
    let radius = points.radii.iter().copied().fold(f64::INFINITY, f64::min);
    let covering_radius = field.bounds[1] * lattice.unit();
    Ok((points, Report { radius, covering_radius, seconds: stopwatch.seconds() }))
}
