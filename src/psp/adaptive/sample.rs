//! Adaptive sampling in one call.

use crate::error::{Error, Result};
use crate::host::Stopwatch;
use crate::job::{Context, Job, Progress, chunks_of};
use crate::memory;
use crate::mesh::Mesh;
use crate::points::{MAXIMAL_DENSITY, SurfaceSamples, check_radius};
use crate::psp::adaptive::density::DensityField;
use crate::psp::adaptive::field::RadiusField;
use crate::psp::adaptive::fill::fill;
use crate::psp::adaptive::limits::Quota;
use crate::psp::adaptive::options::Options;
use crate::psp::adaptive::radius::{Radius, Scale};
use crate::psp::estimate::{expected_samples_of, longest_edge};
use crate::psp::facing::Facing;
use crate::psp::fill::region::parts_up_to;
use crate::psp::fragment::{Fragment, Shape};
use crate::psp::given::obstacles;
use crate::psp::pieces::slice;
use crate::psp::report::Report;
use crate::psp::samples::surface_samples;

/// Samples and their radii.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct AdaptiveSamples {
    /// In the order in which they were accepted.
    pub samples: SurfaceSamples,
    /// The radius of each sample.
    pub radii: Vec<f64>,
}

/// Triangles per task of the estimate.
const CHUNK: usize = 1 << 13;
/// On how many pieces of the surface the number of samples is estimated, about and at most.
const ESTIMATES: f64 = 1e5;
/// Memory per sample at the peak.
const BYTES_PER_SAMPLE: f64 = 800.0;

/// A maximal set of samples, each with its own radius.
///
/// Time grows with the samples and the triangles, and with the square of how much the radius changes along a radius.
/// The report counts no iterations, rays and hits.
///
/// # Errors
/// [`Error::InvalidArgument`] for radii that are not positive and finite (`vertex_radii`), not one for each vertex
/// (`vertex_count`), or below 64 float spacings at the largest coordinate of the mesh; for bad `smallest`, `largest` and
/// `slope`; for a function that gives what is not in `smallest..=largest` or changes faster than `slope` (`radius`);
/// for a `cosine` outside -1 to 1; for [`given`](Options::given) samples out of range, by their index, or without
/// clearances (`given_clearances`). [`Error::TooLarge`] where the radii would ask for more than 2^32 samples, or more than
/// memory holds, and where they change so fast that it takes thousands of looks per sample to find out what is covered
/// (`slope`, `vertex_radii`). [`Error::Cancelled`] by the progress callback.
pub fn sample(
    context: &Context,
    mesh: &Mesh,
    options: &Options,
    progress: Option<&Progress>,
) -> Result<(AdaptiveSamples, Report)> {
    let stopwatch = Stopwatch::start();
    let facing = Facing::new(options.cosine)?;
    let density = match options.radius {
        Radius::Density { density, scale } => {
            check_scale(scale)?;
            Some(DensityField::new(mesh, density)?)
        }
        _ => None,
    };
    let obstacles = obstacles(mesh, options.given)?;
    let (set, darts) = context.run(progress, |job| {
        let density = match (&density, options.radius) {
            (Some(density), Radius::Density { scale, .. }) => {
                Some((density, unit(&job.part(0.0, 0.02), density, scale)?))
            }
            _ => None,
        };
        let field = RadiusField::new(mesh, options.radius, density)?;
        let quota = Quota::new(require(&job.part(0.02, 0.05), mesh, &field)?, mesh);
        fill(job, mesh, &field, &quota, facing, &obstacles, options.seed)
    })?;
    let (samples, radii): (Vec<_>, Vec<_>) = set.samples.into_iter().unzip();
    let accepted = samples.len() as u64;
    let seconds = stopwatch.seconds();
    let conflicts = darts - accepted;
    let report = Report { samples: accepted, accepted, darts, conflicts, seconds, ..Report::default() };
    let samples = surface_samples(mesh, &samples);
    Ok((AdaptiveSamples { samples, radii }, report))
}

fn check_scale(scale: Scale) -> Result<()> {
    match scale {
        Scale::Radius(radius) => check_radius(radius),
        Scale::Count(count) if count > 0.0 && count.is_finite() => Ok(()),
        Scale::Count(count) => Err(Error::invalid("count", format!("{count:?} is not a positive finite number"))),
    }
}

/// The radius at density 1.
fn unit(job: &Job, density: &DensityField, scale: Scale) -> Result<f64> {
    match scale {
        Scale::Radius(radius) => Ok(radius),
        Scale::Count(count) => {
            let integral = density.integral(job)?;
            if integral > 0.0 {
                Ok((MAXIMAL_DENSITY * integral / count).sqrt())
            } else {
                Err(Error::invalid("density", "0 everywhere on the mesh; there is no place for a sample"))
            }
        }
    }
}

/// Estimates the samples and refuses radii that ask for more than can be indexed or held. They are counted on pieces of the
/// surface, each as if it had the radius of its centre: those of the area, and those along what is longer than the radius.
fn require(job: &Job, mesh: &Mesh, field: &RadiusField) -> Result<f64> {
    // Needles have next to no area: their lengths bound the pieces as well.
    let lengths: f64 = mesh.sampled_triangles().map(|triangle| longest_edge(mesh, triangle)).sum();
    // Nor is anything learned from pieces that are shorter than every radius.
    let longest = (4.0 * mesh.area() / ESTIMATES).sqrt().max(lengths / ESTIMATES).max(field.all().least);
    let chunks = chunks_of(mesh.triangles().len(), CHUNK);
    let estimates = job.map(chunks.len(), |chunk| {
        let (mut slices, mut estimate) = (Vec::new(), 0.0);
        for triangle in chunks.range(chunk).map(|triangle| triangle as u32) {
            let area = mesh.triangle_area(triangle);
            let mut count = |piece: &Fragment, shape: &Shape, area: f64| {
                estimate += expected_samples_of(field.centre(piece, shape), area, shape.longest);
            };
            let whole = Fragment::whole(triangle);
            let shape = whole.shape(mesh);
            if area > 0.0 && shape.longest <= longest {
                count(&whole, &shape, area);
            } else if area > 0.0 {
                slice(mesh, triangle, longest, &mut slices);
                for slice in slices.drain(..) {
                    parts_up_to(mesh, &slice, longest)
                        .for_each(|part| count(&part, &part.shape(mesh), part.area(mesh)));
                }
            }
        }
        estimate
    })?;
    let estimate: f64 = estimates.iter().sum();
    field.check()?;
    let (argument, all) = (field.argument(), field.all());
    if estimate > f64::from(u32::MAX) {
        let [least, largest] = [all.least, all.largest];
        let reason =
            format!("{least:?} to {largest:?} asks for about {estimate:.3e} samples; the limit is {}", u32::MAX);
        return Err(Error::too_large(argument, reason));
    }
    memory::require(estimate * BYTES_PER_SAMPLE, argument, &format!("about {estimate:.3e} samples"))?;
    Ok(estimate)
}
