//! Adaptive sampling in one call: a set that is filled at once, or level by level.
//!
//! Levels are maximal sets at ever smaller scales, each around the samples of those before (`psp/levels.rs`). A level is
//! filled with all radii multiplied by its scale, and earlier samples count with theirs at this scale. So distances are
//! measured by the mean of two relative radii, and the properties of levels of one radius hold.

use crate::error::{Error, Result};
use crate::host::Stopwatch;
use crate::job::{Context, Job, Progress};
use crate::math::square;
use crate::mesh::Mesh;
use crate::order::{Order, check_quotient};
use crate::points::{Points, check_radius, check_resolution, finest_radius};
use crate::psp::adaptive::density::DensityField;
use crate::psp::adaptive::field::{Quota, RadiusField};
use crate::psp::adaptive::options::{Options, Radius, Scale};
use crate::psp::adaptive::pieces::{BYTES_PER_RANKED_SAMPLE, BYTES_PER_SAMPLE, MeasuredTriangles, checked_samples};
use crate::psp::adaptive::site::{GradedSurface, OneKind, fill_octaves};
use crate::psp::fill::FillOptions;
use crate::psp::fragment::Facing;
use crate::psp::given::Obstacles;
use crate::psp::levels::{self, LevelOptions, Levelled, LevelledSet, Levels, NAMES, SurfaceSample, check_work, top};
use crate::psp::report::Report;
use crate::psp::set::Sample;

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
    let is_ordered = options.order == Order::Progressive;
    if is_ordered {
        check_quotient(options.quotient)?;
    }
    let mut count = None;
    if let Radius::Density { scale, .. } = options.radius {
        count = checked_count(scale, options.order)?;
    }
    let density = DensityField::of(mesh, options.radius)?;
    let stated = match density {
        Some(_) => None,
        None => Some(RadiusField::new(mesh, options.radius, None, 1.0)?),
    };
    options.given.require_clearances("are required where the radius varies")?;
    let obstacles = &Obstacles::of(mesh, options.given)?;
    let found = context.run(progress, |job| {
        let (density, unit) = match &density {
            Some((density, scale)) => (Some(density), density.unit(&job.part(0.0, 0.02), *scale)?),
            None => (None, 1.0),
        };
        // Levels multiply all radii, at density 1 as well. A level does not depend on where the set ends. So neither
        // does the region where a density requires no samples.
        let (unit, last, finest) = match (density, options.order) {
            (_, Order::Any) => (unit, 1.0, 1.0),
            (None, Order::Progressive) => (1.0, 1.0, 1.0),
            (Some(density), Order::Progressive) => {
                (1.0, unit, (1.0 + 1e-12) * finest_radius(mesh.float_spacing()) * density.largest.sqrt())
            }
        };
        let field = match stated {
            Some(field) => field,
            None => RadiusField::new(mesh, options.radius, density.map(|density| (density, unit)), finest)?,
        };
        if is_ordered && count.is_none() {
            let least = last * field.least();
            check_resolution("density", least, mesh.float_spacing(), "the largest coordinate of the mesh")?;
        }
        let bytes = if is_ordered { BYTES_PER_RANKED_SAMPLE } else { BYTES_PER_SAMPLE };
        let estimate = checked_samples(&job.part(0.02, 0.05), mesh, &field.at_scale(last), bytes)?;
        let triangles = if is_ordered {
            MeasuredTriangles::kept(&job.part(0.05, 0.06), mesh, &field)?
        } else {
            MeasuredTriangles::of(mesh)
        };
        let surface = ScaledSurface { mesh, field, facing, obstacles, triangles, last, estimate };
        if !is_ordered {
            let (samples, darts) = surface.complete(job, FillOptions::from_nothing(options.seed), last, &[])?;
            return Ok(LevelledSet { samples, radius: last, covering_radius: last, darts });
        }
        let (job, levels) = (&job.part(0.06, 1.0), Levels::new(surface, options.seed));
        match count {
            None => levels::by_radius(job, levels, options.quotient, last),
            Some(count) => levels::by_count(job, levels, options.quotient, count, finest),
        }
    })?;
    let radii = found.samples.iter().map(|(_, relative)| found.radius * relative).collect();
    let mut report = Report::of_fill(found.samples.len(), found.darts, &stopwatch);
    if is_ordered {
        (report.radius, report.covering_radius) = (found.radius, Some(found.covering_radius));
    }
    Ok((Points { radii, ..found.to_points(mesh, options.order) }, report))
}

/// The count that is requested in progressive order, which must be whole. Refuses a scale out of its range.
pub fn checked_count(scale: Scale, order: Order) -> Result<Option<usize>> {
    match scale {
        Scale::Radius(radius) => check_radius(radius).map(|()| None),
        Scale::Count(count) if !(count > 0.0 && count.is_finite()) => {
            Err(Error::invalid("count", format!("{count:?} is not a positive finite number")))
        }
        Scale::Count(_) if order == Order::Any => Ok(None),
        Scale::Count(count) if count.fract() == 0.0 && count <= f64::from(u32::MAX) => Ok(Some(count as usize)),
        Scale::Count(count) => {
            let reason = format!("{count:?} is not a whole number up to {}, which progressive order needs", u32::MAX);
            Err(Error::invalid("count", reason))
        }
    }
}

/// A surface whose radius varies, at any scale.
struct ScaledSurface<'a> {
    mesh: &'a Mesh,
    field: RadiusField<'a>,
    facing: Facing,
    obstacles: &'a Obstacles,
    triangles: MeasuredTriangles<'a>,
    /// The scale at which the set is expected to be complete, and the approximate number of samples.
    last: f64,
    estimate: f64,
}

impl SurfaceSample for (Sample, f64) {
    fn sample(&self) -> &Sample {
        &self.0
    }

    fn sample_mut(&mut self) -> &mut Sample {
        &mut self.0
    }
}

impl ScaledSurface<'_> {
    /// The samples with those that a fill at this scale adds, and the number of darts.
    fn complete(
        &self,
        job: &Job,
        options: FillOptions,
        scale: f64,
        samples: &[(Sample, f64)],
    ) -> Result<(Vec<(Sample, f64)>, u64)> {
        let &Self { mesh, facing, obstacles, ref triangles, last, estimate, .. } = self;
        let (field, quota) = (&self.field.at_scale(scale), &Quota::new(self.expected(scale).max(estimate), mesh));
        let surface = GradedSurface { mesh, field, quota, facing, triangles, finest: last };
        let site = OneKind { surface, obstacles, largest_rank: options.largest_rank };
        let (set, darts) = fill_octaves(job, &site, options, samples)?;
        Ok((set.into_samples(), darts))
    }
}

impl Levelled for ScaledSurface<'_> {
    type Sample = (Sample, f64);

    const DIMENSION: u32 = 2;

    const NAMES: [&'static str; 2] = NAMES;

    fn top(&self) -> f64 {
        top(self.mesh) / self.field.least()
    }

    fn expected(&self, scale: f64) -> f64 {
        self.estimate * square(self.last / scale)
    }

    fn check_work(&self, scale: f64, count: usize) -> Result<()> {
        check_work(!self.obstacles.is_empty(), self.expected(scale), count)
    }

    fn fill(
        &self,
        job: &Job,
        options: LevelOptions,
        scale: f64,
        samples: &[Self::Sample],
    ) -> Result<(Vec<Self::Sample>, u64)> {
        self.complete(job, FillOptions::of_level(options), scale, samples)
    }
}
