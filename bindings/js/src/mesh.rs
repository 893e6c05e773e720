//! Meshes of triangles, with their normals and masks, and moved.

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::{Error, Interior};

use crate::answer::{Answer, call};
use crate::memory::{optional, rows};
use crate::surface::answer;

/// The object behind JavaScript's `Mesh`.
pub struct Handle(pub Arc<Mesh>);

/// The handle of a mesh, in `out`; the answer has its area and its numbers of vertices and triangles.
pub(crate) fn made(mesh: Mesh, out: &mut Option<Box<Handle>>) -> Answer {
    let numbers = vec![mesh.area(), mesh.positions().len() as f64, mesh.triangles().len() as f64];
    *out = Some(Box::new(Handle(Arc::new(mesh))));
    Answer::default().and(numbers)
}

/// A mesh of triangles: what [`made`] says.
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
    call(|_, _| Ok(made(Mesh::new(positions.to_vec(), triangles.to_vec())?, out)))
}

/// A mesh from the bytes of a file, whose name tells the format: what [`made`] says.
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
    call(|_, _| Ok(made(Mesh::parse(String::from_utf8_lossy(name).as_ref(), bytes)?, out)))
}

/// A mesh with normals, a mask, or both, in place of those that it may have; what is null stays. What [`made`] says.
///
/// # Safety
/// The pointers are null, or to arguments of these sizes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_with(
    mesh: &Handle,
    normals: *const [f32; 3],
    normal_count: usize,
    normal_indices: *const [u32; 3],
    normal_index_count: usize,
    mask: *const u8,
    mask_count: usize,
    out: &mut Option<Box<Handle>>,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (normals, mask) = unsafe { (optional(normals, normal_count), optional(mask, mask_count)) };
    // SAFETY: likewise.
    let normal_indices = unsafe { optional(normal_indices, normal_index_count) };
    call(|_, _| {
        let mut mesh = Mesh::clone(&mesh.0);
        mesh = match (normals, normal_indices) {
            (Some(normals), indices) => mesh.with_normals(normals.to_vec(), indices.map(<[_]>::to_vec))?,
            (None, None) => mesh,
            (None, Some(_)) => {
                let reason = "there are no normals".to_owned();
                return Err(Error::InvalidArgument { argument: "normal_indices", reason });
            }
        };
        if let Some(mask) = mask {
            mesh = mesh.with_mask(mask.iter().map(|&is_sampled| is_sampled != 0).collect())?;
        }
        Ok(made(mesh, out))
    })
}

/// A mesh with its vertices moved: what [`made`] says.
///
/// # Safety
/// `positions` is valid for reads of `count` positions.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_deform(
    mesh: &Handle,
    positions: *const [f32; 3],
    count: usize,
    out: &mut Option<Box<Handle>>,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let positions = unsafe { rows(positions, count) };
    call(|_, _| Ok(made(mesh.0.deformed(positions.to_vec())?, out)))
}

/// The samples at places of a mesh.
///
/// # Safety
/// The pointers are valid for reads of so many rows.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_points(
    mesh: &Handle,
    triangles: *const u32,
    count: usize,
    barycentrics: *const [f32; 2],
    barycentric_count: usize,
) -> i32 {
    // SAFETY: guaranteed by the caller.
    let (triangles, barycentrics) = unsafe { (rows(triangles, count), rows(barycentrics, barycentric_count)) };
    call(|_, _| Ok(answer(mesh.0.samples_at(triangles, barycentrics)?)))
}

/// The positions and triangles of a mesh, its origin, and its normals, their indices and its mask, which may be empty.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_mesh_arrays(mesh: &Handle) -> i32 {
    let mesh = &mesh.0;
    let flat = |rows: &[[u32; 3]]| rows.as_flattened().to_vec();
    call(|_, _| {
        let answer = Answer::default().and(mesh.positions().to_vec()).and(flat(mesh.triangles()));
        let answer = answer.and(mesh.origin().to_vec()).and(normals(mesh));
        let mask = mesh.mask().unwrap_or_default().iter().map(|&is_sampled| u8::from(is_sampled));
        Ok(answer.and(flat(mesh.normal_indices().unwrap_or_default())).and(mask.collect::<Vec<u8>>()))
    })
}

fn normals(mesh: &Mesh) -> Vec<[f32; 3]> {
    if mesh.has_normals() { mesh.normals().to_vec() } else { Vec::new() }
}

/// True for a mesh with an inside that is decided without error.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_mesh_is_closed(mesh: &Handle) -> i32 {
    call(|_, _| Ok(Answer::default().and(vec![u8::from(mesh.0.is_closed())])))
}

/// For each position 1 if it is inside the mesh, else 0.
///
/// # Safety
/// `positions` is valid for reads of `count` positions.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_contains(mesh: &Handle, positions: *const [f32; 3], count: usize) -> i32 {
    // SAFETY: guaranteed by the caller.
    let positions = unsafe { rows(positions, count) };
    call(|context, progress| {
        let inside = Interior::of(&mesh.0).contains_each(context, positions, progress)?;
        Ok(Answer::default().and(inside.into_iter().map(u8::from).collect::<Vec<u8>>()))
    })
}

/// Frees a mesh.
#[unsafe(no_mangle)]
pub extern "C" fn azulejo_mesh_free(mesh: Option<Box<Handle>>) {
    drop(mesh);
}
