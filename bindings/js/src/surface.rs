//! Sets on meshes, and their relaxation.

use azulejo::Points;
use azulejo::dcr::surface::{self, RemeshReport};
use azulejo::psp::{FlatOptions, Priority, Projectors, Report};

use crate::answer::{Answer, call};
use crate::memory::rows;
use crate::mesh::{Handle, made};
use crate::surface_varying::density;
use crate::{given, order};

/// The options of a set, as JavaScript lays them out.
#[repr(C)]
pub struct SurfaceOptions {
    radius: f64,
    count: f64,
    progressive: f64,
    quotient: f64,
    cosine: f64,
    /// The number of iterations; below 0, as many as the rule gives.
    iterations: f64,
    maximal: f64,
    global: f64,
    by_projector: f64,
}

/// The projectors and the priority that two flags select.
pub(crate) fn projection(global: bool, by_projector: bool) -> (Projectors, Priority) {
    let projectors = if global { Projectors::Global } else { Projectors::Local };
    (projectors, if by_projector { Priority::Projector } else { Priority::Squareness })
}

/// The samples; the numbers of [`numbers`].
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_sample(
    mesh: &Handle,
    options: &SurfaceOptions,
    seed: u64,
    positions: *const [f32; 3],
    count: usize,
    clearances: *const f64,
    clearance_count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let given = unsafe { given(positions, count, clearances, clearance_count) };
    call(|context, progress| {
        let (projectors, priority) = projection(options.global != 0.0, options.by_projector != 0.0);
        let mut sampling = FlatOptions::new(options.radius)
            .count(options.count as usize)
            .order(order((options.progressive != 0.0).into()))
            .quotient(options.quotient)
            .maximal(options.maximal != 0.0)
            .cosine(options.cosine)
            .seed(seed)
            .projectors(projectors)
            .priority(priority)
            .given(given);
        if options.iterations >= 0.0 {
            sampling = sampling.iterations(Some(options.iterations as u32));
        }
        let (samples, report) = sampling.sample(context, &mesh.0, progress)?;
        Ok(answer(samples).and(numbers(&report)))
    })
}

/// The radius, a bound of the covering radius, rho, the numbers of iterations and darts, and the uncovered shares before and
/// after the fill; -1 where one is not known.
pub(crate) fn numbers(report: &Report) -> Vec<f64> {
    let known = |number: Option<f64>| number.unwrap_or(-1.0);
    vec![
        report.radius,
        known(report.covering_radius),
        report.rho,
        report.iterations.into(),
        report.darts as f64,
        known(report.uncovered_before),
        known(report.uncovered_after),
    ]
}

/// The samples, relaxed to a density if there are values of one; the number of iterations, the reason for stopping, motion,
/// smallest distance and rho.
///
/// # Safety
/// The pointers are valid for reads of so many rows.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_surface_relax(
    mesh: &Handle,
    max_iterations: u32,
    tolerance: f64,
    seed: u64,
    triangles: *const u32,
    count: usize,
    barycentrics: *const [f32; 2],
    barycentric_count: usize,
    width: usize,
    height: usize,
    values: *const f32,
    value_count: usize,
    texture: *const [f32; 2],
    texture_count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (triangles, barycentrics) = unsafe { (rows(triangles, count), rows(barycentrics, barycentric_count)) };
    // SAFETY: likewise.
    let (values, texture) = unsafe { (rows(values, value_count), rows(texture, texture_count)) };
    call(|context, progress| {
        let options = surface::Options::default().max_iterations(max_iterations).tolerance(tolerance).seed(seed);
        let (samples, report) = if values.is_empty() {
            surface::relax(context, &mesh.0, triangles, barycentrics, &options, progress)?
        } else {
            let density = density(mesh, values, [width, height], texture)?;
            surface::relax_with_density(context, &mesh.0, triangles, barycentrics, density, &options, progress)?
        };
        let (iterations, stopped) = (report.iterations.into(), f64::from(report.stopped as u8));
        Ok(answer(samples).and(vec![iterations, stopped, report.motion, report.smallest_distance, report.rho]))
    })
}

/// A mesh of samples: what [`made`] says, and the numbers of triangles, of disputed and left out ones,
/// of edges of the boundary, inside and of more than two triangles, of vertices that are not manifold and of unused ones; the
/// Euler characteristic; the smallest and the largest angle, and the mean of the smallest of each triangle.
///
/// # Safety
/// The pointers are valid for reads of so many rows.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_remesh(
    mesh: &Handle,
    triangles: *const u32,
    count: usize,
    barycentrics: *const [f32; 2],
    barycentric_count: usize,
    out: &mut Option<Box<Handle>>,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (triangles, barycentrics) = unsafe { (rows(triangles, count), rows(barycentrics, barycentric_count)) };
    call(|context, progress| {
        let (remeshed, report) = surface::remesh(context, &mesh.0, triangles, barycentrics, progress)?;
        let RemeshReport { triangles, disputed, left_out, quality, .. } = report;
        let counts = [
            triangles,
            disputed,
            left_out,
            quality.boundary_edges,
            quality.inner_edges,
            quality.non_manifold_edges,
            quality.non_manifold_vertices,
            quality.unused_vertices,
        ];
        let angles = [quality.smallest_angle, quality.largest_angle, quality.mean_smallest_angle];
        let counts = counts.into_iter().map(|count| count as f64).chain([quality.euler as f64]);
        Ok(made(remeshed, out).and(counts.chain(angles).collect::<Vec<f64>>()))
    })
}

/// The answer with every column that samples have on a mesh, their ranks, and the interpolated normals of a mesh with normals.
pub(crate) fn answer(samples: Points<3>) -> Answer {
    let Points { positions, normals, triangles, barycentrics, ranks, interpolated_normals, .. } = samples;
    let answer = Answer::default().and(positions).and(normals).and(triangles).and(barycentrics).and(ranks);
    answer.and(interpolated_normals)
}
