//! Relaxation on triangle meshes: DCR of the plane on a surface (the future work of thesis §4.5).
//!
//! Samples push their neighbours away and are pulled into holes by the constraints of the momentum method in the plane,
//! and with its momentum. The differences:
//!
//! * neighbours are the samples that are reached on the surface without leaving a ball (`near.rs`), seen in
//!   the tangent plane, each at its straight distance through space; the other side of a thin wall has no effect;
//! * each sample finds its Delaunay star among them for itself (`view.rs`): there is no triangulation to be kept;
//! * samples walk straight on, from triangle to triangle (`walk.rs`), so they are on the surface at all times;
//! * at open boundaries neighbours are mirrored, so that samples neither leave nor crowd there;
//! * no two samples get closer to each other through space than the closest two were (`apart.rs`), regardless of the
//!   parts of the surface that they are on;
//! * samples that are clustered on a part of the surface are redistributed before the first step (`spread.rs`);
//! * long waves of the density stay: there is no Fourier transform on a mesh;
//! * where a density is asked for, each sample has its own spacing (`grading.rs`).
//!
//! The surroundings of a sample are listed for several steps (`lists.rs`), and a step (`relaxation.rs`, `moves.rs`)
//! processes sixteen neighbours at a time (`simd/`).
//!
//! Triangles are connected by common edges (`connected.rs`). A crack is a boundary: samples on its two sides are not
//! neighbours, but keep their distance through space.

mod apart;
mod connected;
mod density;
mod grading;
mod lists;
mod moves;
mod near;
mod options;
mod relaxation;
mod remeshing;
mod spread;
mod view;
mod walk;

pub use density::relax_with_density;
pub use options::{Options, Report};
pub use remeshing::{RemeshReport, Triangulation, remesh, triangulate};

use glam::DVec2;

use crate::dcr::relaxation::{Relaxation, Steps, run};
use crate::dcr::surface::apart::Floor;
use crate::dcr::surface::connected::ConnectedMesh;
use crate::dcr::surface::grading::{Even, Grading, smallest_relative};
use crate::dcr::surface::relaxation::SurfaceRelaxation;
use crate::dcr::surface::spread::{along_curve, spread};
use crate::dcr::surface::walk::SurfacePoint;
use crate::error::{Error, Result};
use crate::index::smallest_distance;
use crate::job::{Context, Job, Progress};
use crate::memory;
use crate::mesh::{Mesh, round_barycentrics};
use crate::points::Points;

/// The peak memory for a sample and all of its data.
pub const BYTES_PER_SAMPLE: f64 = 630.0;

/// Relaxes samples on a mesh: sample `i` is the point `barycentrics[i]` of `triangles[i]`, as in [`Points`], and
/// of any density. The samples are returned in their order, each with the triangle that it is on.
///
/// Samples that are clustered on a part of the surface are redistributed before the first step: random points are
/// thrown on the surface, keyed by `seed`, both are sorted along a curve through space, and the sample of each rank is
/// put on the point of that rank. So each connected part receives samples by its area, and samples that were near each
/// other mostly stay so. Samples are clustered if there are more than 64 whose number in a cube of space differs by
/// more than a quarter and by more than 16 times the square root from that for the area in it, and if their smallest
/// distance is below 0.6 `d_max`. If there is not enough space for points as far apart as the nearest samples were, the
/// samples stay in place.
///
/// A cancelled call succeeds: it returns the samples after the last whole step, and its report says that it was
/// cancelled.
///
/// Takes O(triangles) and then, for each step, O(samples) for samples that are spread about evenly. Memory is
/// O(triangles + samples). Progress is reported, and the call cancelled, between steps and while neighbours are
/// searched.
///
/// # Errors
/// [`Error::InvalidArgument`] for triangles that the mesh does not have, that its mask leaves out or that have no area
/// (`triangles`), for barycentrics that are not as many, not finite or outside the triangle by more than rounding
/// (`barycentrics`), and for a `tolerance` that is not at least 0; [`Error::TooLarge`] for more than 2^32 - 1 samples
/// and for a mesh of more than 2^32 / 3 triangles.
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
    relaxed(context, mesh, (triangles, barycentrics), &Even, options, progress)
}

/// Relaxes samples that have been checked.
pub fn relaxed<G: Grading>(
    context: &Context,
    mesh: &Mesh,
    (triangles, barycentrics): (&[u32], &[[f32; 2]]),
    grading: &G,
    options: &Options,
    progress: Option<&Progress>,
) -> Result<(Points<3>, Report)> {
    let connected = ConnectedMesh::new(mesh)?;
    let spacing = hexagonal_distance(mesh, triangles.len());
    let places = enter(triangles, barycentrics);
    let mut set = context.run(None, |job| begin(job, &connected, grading, spacing, &places, options))?;
    run(
        context,
        options.limits(),
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
            // In the order of the curve, data of near samples are in the cache.
            let positions: Vec<_> = set.positions().map(|[x, y, z, _]| [x, y, z]).collect();
            let smallest_distance = smallest_distance(job, &positions)?;
            let rho = match G::VARIES {
                true => smallest_among(job, mesh, grading, spacing, &set.places())?,
                false => smallest_distance,
            } / spacing;
            Ok((samples, Report { iterations, stopped, motion, smallest_distance, rho }))
        },
    )
}

/// The set before the first step: no two samples will get closer to each other than the closest two are now, and those
/// that are clustered, or where none are wanted, are redistributed.
fn begin<'a, G: Grading>(
    job: &Job,
    connected: &'a ConnectedMesh<'a>,
    grading: &'a G,
    spacing: f64,
    places: &[SurfacePoint],
    options: &Options,
) -> Result<SurfaceRelaxation<'a, G>> {
    let mesh = connected.mesh;
    let mut floor = Floor::new(smallest_among(job, mesh, grading, spacing, places)?);
    let placed = match options.max_iterations {
        0 => None,
        _ => spread(job, mesh, grading, places, floor, spacing, options.seed)?,
    };
    grading.check()?;
    if let Some(placed) = placed.as_ref().filter(|_| G::VARIES) {
        floor = Floor::new(smallest_among(job, mesh, grading, spacing, placed)?);
    }
    let places = placed.as_deref().unwrap_or(places);
    SurfaceRelaxation::new(job, connected, grading, spacing, floor, places, options.seed)
}

/// The smallest distance of two samples through space, over the mean of their grades; infinite for less than two.
fn smallest_among<G: Grading>(
    job: &Job,
    mesh: &Mesh,
    grading: &G,
    spacing: f64,
    places: &[SurfacePoint],
) -> Result<f64> {
    // Along the curve, data of near samples are in the cache.
    let ordered = along_curve(mesh, places).into_iter().map(|(_, i)| grading.position(mesh, places[i as usize]));
    if G::VARIES {
        let low = mesh.bounds().0.map(f64::from).into();
        return smallest_relative(job, grading, low, spacing, &ordered.collect::<Vec<_>>());
    }
    smallest_distance(job, &ordered.map(|[x, y, z, _]| [x, y, z]).collect::<Vec<_>>())
}

/// The distance of neighbours in the hexagonal arrangement of as many samples on the area of the mesh.
pub fn hexagonal_distance(mesh: &Mesh, count: usize) -> f64 {
    (2.0 * mesh.area() / (3f64.sqrt() * count.max(1) as f64)).sqrt()
}

/// Refuses points that are not on the mesh.
pub fn check(mesh: &Mesh, triangles: &[u32], barycentrics: &[[f32; 2]]) -> Result<()> {
    let count = mesh.triangles().len();
    if triangles.len() > u32::MAX as usize {
        return Err(Error::too_large("triangles", format!("{} samples; the limit is {}", triangles.len(), u32::MAX)));
    }
    if barycentrics.len() != triangles.len() {
        let reason = format!("there are {}, and {} triangles", barycentrics.len(), triangles.len());
        return Err(Error::invalid("barycentrics", reason));
    }
    for (i, &triangle) in triangles.iter().enumerate() {
        if triangle as usize >= count {
            return Err(Error::invalid("triangles", format!("[{i}] is {triangle}, and the mesh has {count}")));
        }
        if mesh.triangle_area(triangle) <= 0.0 {
            let reason = if mesh.is_sampled(triangle) { "has no area" } else { "is left out by the mesh's mask" };
            return Err(Error::invalid("triangles", format!("[{i}] is {triangle}, which {reason}")));
        }
    }
    crate::check::barycentrics(barycentrics)
}

/// The points of samples.
pub fn enter(triangles: &[u32], barycentrics: &[[f32; 2]]) -> Vec<SurfacePoint> {
    triangles.iter().zip(barycentrics).map(point).collect()
}

fn point((&triangle, &uv): (&u32, &[f32; 2])) -> SurfacePoint {
    let [u, v] = round_barycentrics(uv.map(f64::from)).map(f64::from);
    SurfacePoint { triangle, uv: DVec2::new(u, v) }
}

/// The points as samples, by rounded barycentrics.
pub fn leave(mesh: &Mesh, points: &[SurfacePoint]) -> Points<3> {
    let triangles = points.iter().map(|point| point.triangle).collect();
    mesh.samples(triangles, points.iter().map(|point| round_barycentrics(point.uv.into())).collect())
}
