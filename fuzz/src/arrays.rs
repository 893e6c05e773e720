//! Arrays of all kinds, of which meshes are made, with normals and masks of all kinds.

use azulejo_c::mesh::*;

use crate::calls::{Owned, create};
use crate::input::Input;

/// A mesh, if the arrays are accepted.
pub fn mesh(input: &mut Input) -> Option<Owned<azulejo_mesh>> {
    let mut mesh = make(input)?;
    if input.one_in(4) {
        let other = with_normals(&mesh, input)?;
        mesh = other;
    }
    if input.one_in(4) {
        let count = mesh.read(azulejo_mesh_triangle_count) + usize::from(input.one_in(16));
        let mask: Vec<u8> = (0..count).map(|_| input.any::<u8>() & 1).collect();
        // SAFETY: the mask has this length.
        let other = create(|out| unsafe { azulejo_mesh_with_mask(mesh.get(), mask.as_ptr(), count, out) })?;
        mesh = other;
    }
    Some(mesh)
}

/// Vertices at any stride, the last one without a gap behind it; indices that are mostly in range.
fn make(input: &mut Input) -> Option<Owned<azulejo_mesh>> {
    let vertices = input.rows::<3>(40);
    let stride = if input.one_in(32) { input.any::<u8>() as usize } else { 12 + 4 * input.below(4) as usize };
    let mut floats = vec![f32::NAN; (stride / 4).max(3) * vertices.len().saturating_sub(1) + 3];
    vertices.iter().enumerate().for_each(|(i, vertex)| floats[i * (stride / 4).max(3)..][..3].copy_from_slice(vertex));
    let count = input.below(40) as usize;
    let indices: Vec<u32> = (0..3 * count).map(|_| index(input, vertices.len())).collect();
    let indices = if count == 0 { std::ptr::null() } else { indices.as_ptr() };
    // SAFETY: where the stride is accepted it is that of the array, whose size is as told; so is that of the indices.
    create(|out| unsafe { azulejo_mesh_create(floats.as_ptr(), vertices.len(), stride, indices, count, out) })
}

fn index(input: &mut Input, count: usize) -> u32 {
    if input.one_in(128) { input.any() } else { u32::from(input.any::<u8>()) % count.max(1) as u32 }
}

fn with_normals(mesh: &Owned<azulejo_mesh>, input: &mut Input) -> Option<Owned<azulejo_mesh>> {
    let by_vertex = input.one_in(2);
    let count = if by_vertex { mesh.read(azulejo_mesh_vertex_count) } else { input.below(20) as usize };
    let normals: Vec<f32> = (0..3 * count).map(|_| input.coordinate()).collect();
    let triangles = if by_vertex { 0 } else { mesh.read(azulejo_mesh_triangle_count) };
    let indices: Vec<u32> = (0..3 * triangles).map(|_| index(input, count)).collect();
    let indices = if by_vertex { std::ptr::null() } else { indices.as_ptr() };
    // SAFETY: the arrays are as long as that.
    create(|out| unsafe { azulejo_mesh_with_normals(mesh.get(), normals.as_ptr(), count, 12, indices, triangles, out) })
}
