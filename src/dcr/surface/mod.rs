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
//! * long waves of the density stay: there is no Fourier transform on a mesh.
//!
//! The surroundings of a sample are listed for several steps (`lists.rs`), and a step (`relaxation.rs`, `moves.rs`)
//! processes sixteen neighbours at a time (`simd/`).
//!
//! Triangles are connected by common edges (`connected.rs`). A crack is a boundary: samples on its two sides are not
//! neighbours, but keep their distance through space.

mod apart;
mod connected;
mod lists;
mod moves;
mod near;
mod relaxation;
mod remeshing;
mod spread;
mod view;
mod walk;

pub use remeshing::{RemeshReport, Triangulation, remesh, triangulate};

use glam::DVec2;

use crate::dcr::relaxation::{Limits, Steps, Stopped, run};
use crate::dcr::surface::apart::Floor;
use crate::dcr::surface::connected::ConnectedMesh;
use crate::dcr::surface::relaxation::SurfaceRelaxation;
use crate::dcr::surface::spread::{along_curve, spread};
use crate::dcr::surface::walk::SurfacePoint;
use crate::error::{Error, Result};
use crate::index::smallest_distance;
use crate::job::{Context, Job, Progress};
use crate::memory;
use crate::mesh::{Mesh, round_barycentrics};
use crate::points::Points;
use crate::setters::setters;

/// The options of [`relax`](fn@super::relax).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The largest number of steps. 0 returns the samples unchanged, except that those outside their triangle by
    /// rounding are moved to its edge.
    pub max_iterations: u32,
    /// The motion ([`Report::motion`]) at which the set has converged; with 0 all steps are made unless nothing moves
    /// at all.
    pub tolerance: f64,
    /// The key of the moves of samples that coincide, and of the redistribution of clustered ones; used for nothing
    /// else.
    pub seed: u64,
}

impl Default for Options {
    /// At most 100 steps, tolerance 0.0005.
    fn default() -> Self {
        Self { max_iterations: 100, tolerance: 0.0005, seed: 0 }
    }
}

impl Options {
    /// Refuses values out of their range.
    pub fn check(&self) -> Result<()> {
        if !(0.0..).contains(&self.tolerance) {
            return Err(Error::invalid("tolerance", format!("{} is not at least 0", self.tolerance)));
        }
        Ok(())
    }
}

setters!(Options { max_iterations: u32, tolerance: f64, seed: u64 });

/// The report of [`relax`](fn@super::relax). `d_max = sqrt(2 A / (sqrt(3) N))` is the distance of neighbours in the
/// hexagonal arrangement of as many samples on a plane of the mesh's area A.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// The number of steps made.
    pub iterations: u32,
    /// The reason why the steps ended.
    pub stopped: Stopped,
    /// Half of the distance that samples covered in the last 10 steps, or since the start if there were fewer: root
    /// mean square, in units of `d_max`.
    pub motion: f64,
    /// The smallest straight distance between two of the returned samples, in the units of the mesh, regardless of the
    /// parts of the surface that they are on; infinite for less than two.
    pub smallest_distance: f64,
    /// The smallest distance in units of `d_max`; infinite for less than two samples. It ends lower where parts of the
    /// surface are closer to each other than samples, as on thin blades; `docs/dcr.md` has the values measured on
    /// meshes.
    pub rho: f64,
}

/// The peak memory for a sample and all of its data.
const BYTES_PER_SAMPLE: f64 = 630.0;

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
/// that are clustered are redistributed.
fn begin<'a>(
    job: &Job,
    connected: &'a ConnectedMesh<'a>,
    spacing: f64,
    places: &[SurfacePoint],
    options: &Options,
) -> Result<SurfaceRelaxation<'a>> {
    let mesh = connected.mesh;
    // Along the curve, data of near samples are in the cache.
    let ordered = along_curve(mesh, places).into_iter().map(|(_, i)| places[i as usize].position(mesh));
    let positions: Vec<_> = ordered.map(|position| position.as_vec3().to_array()).collect();
    let floor = Floor::new(smallest_distance(job, &positions)?);
    let placed = match options.max_iterations {
        0 => None,
        _ => spread(job, mesh, places, floor, spacing, options.seed)?,
    };
    SurfaceRelaxation::new(job, connected, spacing, floor, placed.as_deref().unwrap_or(places), options.seed)
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
