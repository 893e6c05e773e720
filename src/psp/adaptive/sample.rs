//! Adaptive sampling in one call.

use crate::error::{Error, Result};
use crate::host::Stopwatch;
use crate::job::{Context, Job, Progress};
use crate::mesh::Mesh;
use crate::order::Order;
use crate::points::{Points, check_radius};
use crate::psp::adaptive::density::DensityField;
use crate::psp::adaptive::field::{Quota, RadiusField};
use crate::psp::adaptive::levels::ordered;
use crate::psp::adaptive::options::{Options, Radius, Scale};
use crate::psp::adaptive::pieces::checked_samples;
use crate::psp::adaptive::site::GradedSurface;
use crate::psp::fill::FillOptions;
use crate::psp::fragment::Facing;
use crate::psp::given::{Obstacles, require_clearances};
use crate::psp::levels::LevelledSet;
use crate::psp::options::check_quotient;
use crate::psp::report::Report;
use crate::psp::samples::{Sample, surface_samples};

/// A maximal set of samples, each with its own radius ([`Points::radii`]): in the order in which they were accepted, or
/// in progressive order.
///
/// Time grows with the samples and the triangles, and with the square of the change of the radius over one radius. The
/// report counts no iterations, rays and hits.
///
/// In [`Order::Progressive`] the samples are sorted coarse to fine, and have [ranks](Points::ranks). A rank is a factor
/// of all radii; for a [density](Radius::Density), the radius at density 1. For every prefix, from the first sample on:
/// two samples are no closer than the mean of their radii times the rank of its last one, and no place is farther from
/// all of its samples than the mean of the two radii times [`Options::quotient`] times this rank, up to the tolerance
/// of a set of these radii. (With fewer than [`Order::FIRST_COUNT`] samples it is as
/// [`psp::Options::quotient`](crate::psp::Options::quotient) says.) The radius of a place is that of the caller; that
/// of a sample is the returned one over [`Report::radius`]. Returned radii can be below those of the density where it
/// falls by a factor of more than 16 within a few radii of the level that added the sample.
///
/// The whole set is maximal at the caller's radii, or has exactly as many samples as [`Scale::Count`] asks for. For a
/// density, a set of fewer samples is a prefix of a set of more, equal to the bit except for the radii, which are those
/// of the whole set; and sets of two radii at density 1 share the levels above both. Some
/// `log(diagonal / smallest radius) / log(quotient)` levels visit all triangles and call the function, if there is one.
/// At jumps of the radius, early samples of the larger radius leave fewer beside them than in a set in any order.
///
/// # Errors
/// [`Error::InvalidArgument`] for radii that are not positive and finite (`vertex_radii`), not one for each vertex
/// (`vertex_count`), or below 64 float spacings at the largest coordinate of the mesh; for bad `smallest`, `largest`
/// and `slope`; for a function that returns a value outside `smallest..=largest` or changes faster than `slope`
/// (`radius`); for a `cosine` outside -1 to 1; in progressive order for a `quotient` out of range, and for a `count`
/// that is not whole or more than float precision allows on the mesh; for [`given`](Options::given) samples out of
/// range, by their index, or without clearances (`given_clearances`). [`Error::TooLarge`] if the radii would require
/// more than 2^32 samples, or more than memory holds, and if they change so fast that it takes thousands of tests per
/// sample to determine coverage (`slope`, `vertex_radii`). [`Error::Cancelled`] by the progress callback.
pub fn sample(
    context: &Context,
    mesh: &Mesh,
    options: &Options,
    progress: Option<&Progress>,
) -> Result<(Points<3>, Report)> {
    let stopwatch = Stopwatch::start();
    let facing = Facing::new(options.cosine)?;
    if options.order == Order::Progressive {
        check_quotient(options.quotient)?;
    }
    let density = match options.radius {
        Radius::Density { density, scale } => {
            check_scale(scale)?;
            Some(DensityField::new(mesh, density)?)
        }
        _ => None,
    };
    require_clearances(options.given, "are required where the radius varies")?;
    let obstacles = Obstacles::of(mesh, options.given)?;
    let make = match options.order {
        Order::Any => filled,
        Order::Progressive => ordered,
    };
    let found = context.run(progress, |job| make(job, mesh, options, density.as_ref(), facing, &obstacles))?;
    let radii = found.samples.iter().map(|(_, relative)| found.radius * relative).collect();
    let samples: Vec<Sample> = found.samples.iter().map(|&(sample, _)| sample).collect();
    let mut report = Report::of_fill(samples.len(), found.darts, &stopwatch);
    let mut set = Points { radii, ..surface_samples(mesh, &samples) };
    if options.order == Order::Progressive {
        set.ranks = samples.iter().map(|sample| sample.rank).collect();
        (report.radius, report.coverage) = (found.radius, Some(found.coverage));
    }
    Ok((set, report))
}

/// A set that is filled at once.
fn filled(
    job: &Job,
    mesh: &Mesh,
    options: &Options,
    density: Option<&DensityField>,
    facing: Facing,
    obstacles: &Obstacles,
) -> Result<LevelledSet<(Sample, f64)>> {
    let density = match (density, options.radius) {
        (Some(density), Radius::Density { scale, .. }) => Some((density, density.unit(&job.part(0.0, 0.02), scale)?)),
        _ => None,
    };
    let field = &RadiusField::new(mesh, options.radius, density, 1.0)?;
    let quota = &Quota::new(checked_samples(&job.part(0.02, 0.05), mesh, field)?, mesh);
    let surface = GradedSurface { mesh, field, quota, facing, obstacles, finest: 1.0 };
    let (set, darts) = surface.fill(job, FillOptions::from_nothing(options.seed), &[])?;
    Ok(LevelledSet { samples: set.into_samples(), radius: 1.0, coverage: 1.0, darts })
}

fn check_scale(scale: Scale) -> Result<()> {
    match scale {
        Scale::Radius(radius) => check_radius(radius),
        Scale::Count(count) if count > 0.0 && count.is_finite() => Ok(()),
        Scale::Count(count) => Err(Error::invalid("count", format!("{count:?} is not a positive finite number"))),
    }
}
