//! Sets on meshes, and their relaxation.

use std::sync::Arc;

use azulejo::Points;
use azulejo::dcr::surface;
use azulejo::mesh::Mesh;
use azulejo::psp::FlatOptions;

use crate::answer::{Answer, call};
use crate::memory::rows;
use crate::{given, order};

/// The object behind JavaScript's `Mesh`.
pub struct Handle(pub Arc<Mesh>);

/// A mesh of triangles; the handle is in `out`, the area in the answer.
///
/// # Safety
/// The pointers are to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_create(
    positions: *const [f32; 3],
    vertex_count: usize,
    indices: *const [u32; 3],
    triangle_count: usize,
    out: &mut Option<Box<Handle>>,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (positions, triangles) = unsafe { (rows(positions, vertex_count), rows(indices, triangle_count)) };
    call(|_| {
        let mesh = Mesh::new(positions.to_vec(), triangles.to_vec())?;
        let area = vec![mesh.area()];
        *out = Some(Box::new(Handle(Arc::new(mesh))));
        Ok(Answer::default().and(area))
    })
}

/// A mesh from the bytes of a file, whose name tells the format; the handle is in `out`, the area in the answer.
///
/// # Safety
/// The pointers are valid for reads of so many bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_parse(
    name: *const u8,
    name_length: usize,
    bytes: *const u8,
    length: usize,
    out: &mut Option<Box<Handle>>,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (name, bytes) = unsafe { (rows(name, name_length), rows(bytes, length)) };
    call(|_| {
        let mesh = Mesh::parse(String::from_utf8_lossy(name).as_ref(), bytes)?;
        let area = vec![mesh.area()];
        *out = Some(Box::new(Handle(Arc::new(mesh))));
        Ok(Answer::default().and(area))
    })
}

/// The positions and triangles of a mesh, and its origin.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_mesh_arrays(mesh: &Handle) -> i32 {
    let mesh = &mesh.0;
    let indices: Vec<u32> = mesh.triangles().as_flattened().to_vec();
    call(|_| Ok(Answer::default().and(mesh.positions().to_vec()).and(indices).and(mesh.origin().to_vec())))
}

/// Frees a mesh.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_mesh_free(mesh: Option<Box<Handle>>) {
    drop(mesh);
}

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
}

/// The samples; the radius and a bound of the covering radius, -1 where none is known.
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
    call(|context| {
        let mut sampling = FlatOptions::new(options.radius)
            .count(options.count as usize)
            .order(order((options.progressive != 0.0).into()))
            .quotient(options.quotient)
            .maximal(options.maximal != 0.0)
            .cosine(options.cosine)
            .seed(seed)
            .given(given);
        if options.iterations >= 0.0 {
            sampling = sampling.iterations(Some(options.iterations as u32));
        }
        let (samples, report) = sampling.sample(context, &mesh.0, None)?;
        Ok(answer(samples).and(vec![report.radius, report.covering_radius.unwrap_or(-1.0)]))
    })
}

/// The relaxed samples; the number of iterations, the reason for stopping, motion, smallest distance and rho.
///
/// # Safety
/// The pointers are valid for reads of `count` rows.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_surface_relax(
    mesh: &Handle,
    max_iterations: u32,
    tolerance: f64,
    seed: u64,
    triangles: *const u32,
    barycentrics: *const [f32; 2],
    count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (triangles, barycentrics) = unsafe { (rows(triangles, count), rows(barycentrics, count)) };
    call(|context| {
        let options = surface::Options::default().max_iterations(max_iterations).tolerance(tolerance).seed(seed);
        let (samples, report) = surface::relax(context, &mesh.0, triangles, barycentrics, &options, None)?;
        let (iterations, stopped) = (report.iterations.into(), f64::from(report.stopped as u8));
        Ok(answer(samples).and(vec![iterations, stopped, report.motion, report.smallest_distance, report.rho]))
    })
}

/// The answer with every column that all samples have, and their ranks.
pub(crate) fn answer(samples: Points<3>) -> Answer {
    let Points { positions, normals, triangles, barycentrics, ranks, .. } = samples;
    Answer::default().and(positions).and(normals).and(triangles).and(barycentrics).and(ranks)
}
