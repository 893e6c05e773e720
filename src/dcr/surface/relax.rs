//! Relaxation of samples on a mesh.

use crate::dcr::relaxation::{Limits, Steps, run};
use crate::dcr::surface::apart::Floor;
use crate::dcr::surface::connected::ConnectedMesh;
use crate::dcr::surface::curve::along_curve;
use crate::dcr::surface::options::{Options, Report};
use crate::dcr::surface::relaxation::SurfaceRelaxation;
use crate::dcr::surface::samples::{check, enter, hexagonal_distance, leave};
use crate::dcr::surface::spread::spread;
use crate::dcr::surface::walk::SurfacePoint;
use crate::error::Result;
use crate::index::smallest_distance;
use crate::job::{Context, Job, Progress};
use crate::memory;
use crate::mesh::{Mesh, round_barycentrics};
use crate::points::Points;

/// Memory for a sample and all that is known of it, at the peak.
const BYTES_PER_SAMPLE: f64 = 600.0;

/// Relaxes samples on a mesh: sample `i` is the point `barycentrics[i]` of `triangles[i]`, as in [`Points`], and
/// of any density. The samples are returned in their order, each with the triangle that it is on.
///
/// Samples that are heaped on a part of the surface are dealt out before the first step: random points are thrown on
/// the surface, keyed by `seed`, both are sorted along a curve through space, and the sample of each rank is put on the
/// point of that rank. So each connected part receives samples by its area, and samples that were near each other
/// mostly stay so. Heaped are more than 64 samples whose number in a cube of space differs by more than a quarter and by
/// more than 16 times the square root from what the area in it asks for, and whose smallest distance is below 0.6
/// `d_max`. If there is no room for points as far apart as the nearest samples were, these stay where they are.
///
/// A cancelled call succeeds: it returns the samples after the last whole step, and says so in its report.
///
/// Takes O(triangles) and then, for each step, O(samples) for samples that are spread about evenly. Memory is
/// O(triangles + samples). Progress is reported, and the call cancelled, between steps and while neighbours are
/// searched.
///
/// # Errors
/// [`Error::InvalidArgument`] for triangles that the mesh does not have, that its mask leaves out or that have no area
/// (`triangles`), for barycentrics that are not as many, not finite or outside the triangle by more than rounding
/// (`barycentrics`), and for a `tolerance` that is not at least 0; [`Error::TooLarge`] for more than 2^32 - 1 samples and
/// for a mesh of more than 2^32 / 3 triangles.
pub fn relax(
    context: &Context,
    mesh: &Mesh,
    triangles: &[u32],
    barycentrics: &[[f32; 2]],
    options: &Options,
    progress: Option<&Progress>,
) -> Result<(Points<3>, Report)> {
    check(mesh, triangles, barycentrics)?;
    options.check()?;
    memory::require(BYTES_PER_SAMPLE * triangles.len() as f64, "triangles", &format!("{} points", triangles.len()))?;
    let connected = ConnectedMesh::new(mesh)?;
    let spacing = hexagonal_distance(mesh, triangles.len());
    let places = enter(triangles, barycentrics);
    let mut set = context.run(None, |job| begin(job, &connected, spacing, &places, options))?;
    let limits = Limits { max_iterations: options.max_iterations, tolerance: options.tolerance };
    run(
        context,
        limits,
        &mut set,
        progress,
        |_| {},
        |job, set, Steps { iterations, stopped, motion }| {
            let samples = match iterations {
                0 => {
                    let on_triangle = |&uv: &[f32; 2]| round_barycentrics(uv.map(f64::from));
                    mesh.samples(triangles.to_vec(), barycentrics.iter().map(on_triangle).collect())
                }
                _ => leave(mesh, &set.places()),
            };
            let smallest_distance = set.smallest_distance(job)?;
            let rho = smallest_distance / spacing;
            Ok((samples, Report { iterations, stopped, motion, smallest_distance, rho }))
        },
    )
}

/// The set before the first step: no two samples will get closer to each other than the closest two are now, and those
/// that are heaped are dealt out.
fn begin<'a>(
    job: &Job,
    connected: &'a ConnectedMesh<'a>,
    spacing: f64,
    places: &[SurfacePoint],
    options: &Options,
) -> Result<SurfaceRelaxation<'a>> {
    let mesh = connected.mesh;
    // Along the curve what is near is found in the cache.
    let ordered = along_curve(mesh, places).into_iter().map(|(_, i)| places[i as usize].position(mesh));
    let positions: Vec<_> = ordered.map(|position| position.as_vec3().to_array()).collect();
    let floor = Floor::new(smallest_distance(job, &positions)?);
    let dealt = match options.max_iterations {
        0 => None,
        _ => spread(job, mesh, places, floor, spacing, options.seed)?,
    };
    SurfaceRelaxation::new(job, connected, spacing, floor, dealt.as_deref().unwrap_or(places), options.seed)
}
