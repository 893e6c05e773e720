//! Meshes whose vertices are moved, and places of theirs.

use azulejo_c::mesh::*;

use crate::calls::{Arrays, Out, Owned, create};
use crate::input::Input;
use crate::surface::Corners;

/// Moves the vertices of a mesh anywhere, and evaluates places on it and off it as the header says.
pub fn deform(mesh: &Owned<azulejo_mesh>, input: &mut Input) {
    let count = mesh.read(azulejo_mesh_vertex_count) + usize::from(input.one_in(32));
    let padding = input.below(3) as usize;
    let stride = 3 + padding;
    let floats: Vec<f32> = (0..stride * count).map(|_| input.coordinate()).collect();
    let bytes = if input.one_in(32) { input.below(14) as usize } else { 4 * stride };
    // SAFETY: where the stride is accepted it is at most that of the array.
    let make = |out: Out<_>| unsafe { azulejo_mesh_deform(mesh.get(), floats.as_ptr(), count, bytes, out) };
    let Some(moved) = create(make) else { return };
    let triangles = moved.read(azulejo_mesh_triangle_count);
    assert_eq!((moved.read(azulejo_mesh_vertex_count), triangles), (count, mesh.read(azulejo_mesh_triangle_count)));
    // A mask may leave out all that has an area.
    assert!(moved.read(azulejo_mesh_area) > 0.0 || mesh.read(azulejo_mesh_area) == 0.0);
    assert_eq!(moved.read(azulejo_mesh_has_normals), 0);
    places(&moved, triangles, input);
}

fn places(mesh: &Owned<azulejo_mesh>, triangles: usize, input: &mut Input) {
    let places = input.below(20) as usize;
    let triangle = |input: &mut Input| if input.one_in(64) { input.any() } else { input.below(triangles as u32) };
    let of: Vec<u32> = (0..places).map(|_| triangle(input)).collect();
    let at: Vec<[f32; 2]> = (0..places).map(|_| [input.coordinate(), input.coordinate()]).collect();
    // SAFETY: both arrays have the given lengths.
    let make = |out: Out<_>| unsafe { azulejo_mesh_points(mesh.get(), of.as_ptr(), at.as_ptr().cast(), places, out) };
    let Some(points) = create(make) else { return };
    let (corners, set) = (Corners::of(mesh), Arrays::of(&points));
    assert_eq!((set.triangles, set.barycentrics), (&of[..], at.as_flattened()));
    for (i, (&triangle, &barycentrics)) in of.iter().zip(&at).enumerate() {
        assert_eq!(set.positions[3 * i..3 * i + 3], corners.place(triangle, barycentrics), "place {i}");
    }
    assert_eq!(set.normals.len(), 3 * places);
    assert!(set.normals.iter().all(|x| x.abs() <= 1.0001), "{:?}", set.normals);
}
