//! Samples of a mesh that are relaxed on it, and the mesh of them.

use std::ptr::{null, null_mut};

use azulejo_c::mesh::*;
use azulejo_c::mesh_density::azulejo_mesh_density_init;
use azulejo_c::remesh::{azulejo_dcr_remesh, azulejo_dcr_remesh_report_init};
use azulejo_c::surface::*;

use crate::calls::{Arrays, Out, Owned, Patience, array, context, create, report};
use crate::input::Input;
use crate::surface::Corners;

/// Samples anywhere, some on edges and on each other, walk over the mesh, with and without a density.
pub(crate) fn relax(mesh: &Owned<azulejo_mesh>, corners: &Corners, input: &mut Input) {
    let patience = Patience::new(if input.one_in(4) { input.below(20) } else { u32::MAX });
    let values: Vec<f32> =
        (0..mesh.read(azulejo_mesh_vertex_count)).map(|_| f32::from(input.below(4) as u8) / 3.0).collect();
    let mut density = report(azulejo_mesh_density_init);
    (density.vertex_values, density.vertex_count) = (values.as_ptr(), values.len());
    let has_density = input.one_in(3);
    let options = azulejo_dcr_surface_options {
        struct_size: size_of::<azulejo_dcr_surface_options>() as u32,
        max_iterations: input.below(12),
        tolerance: if input.one_in(8) { input.number() } else { -1.0 },
        seed: input.any(),
        progress: Some(Patience::tell),
        progress_user: patience.user(),
        density: if has_density { &raw const density } else { null() },
    };
    let count = input.below(40) as usize;
    let hostile = input.one_in(8);
    let triangles: Vec<u32> = (0..count)
        .map(|_| if hostile { input.any::<u8>().into() } else { input.below(corners.0.len().max(1) as u32) })
        .collect();
    let sides = |input: &mut Input| {
        let [u, v] = [0; 2].map(|_| f32::from(input.any::<u8>() / 15) / 17.0);
        if hostile {
            [input.coordinate(), v]
        } else if u + v > 1.0 {
            [1.0 - u, 1.0 - v]
        } else {
            [u, v]
        }
    };
    let barycentrics: Vec<[f32; 2]> = (0..count).map(|_| sides(input)).collect();
    let (start, uv) = (triangles.as_ptr(), barycentrics.as_ptr().cast());
    // SAFETY: the options have the size in their `struct_size`, and so are the arrays.
    let call = |out: Out<_>| unsafe {
        azulejo_dcr_surface_relax(context(), mesh.get(), &options, start, uv, count, out, null_mut())
    };
    let Some(points) = create(call) else { return };
    let set = Arrays::of(&points);
    assert_eq!(set.triangles.len(), count);
    corners.check(&set);
    // Hostile samples may be moved onto their triangles first; a density may bring samples closer.
    if !hostile && !has_density {
        let start: Vec<[f32; 3]> = triangles.iter().zip(&barycentrics).map(|(&t, &at)| corners.place(t, at)).collect();
        let (before, after) = (smallest(&start), smallest(set.positions.as_chunks::<3>().0));
        assert!(after >= before, "relaxed to {after}, from {before}");
    }
    remesh(mesh, &set);
}

/// The triangles of samples are a mesh of which no edge has two triangles on one side, as the report states.
fn remesh(mesh: &Owned<azulejo_mesh>, set: &Arrays) {
    let count = set.triangles.len();
    let mut told = report(azulejo_dcr_remesh_report_init);
    let (start, uv) = (set.triangles.as_ptr(), set.barycentrics.as_ptr());
    // SAFETY: the arrays have as many elements as samples.
    let call = |out: Out<_>| unsafe { azulejo_dcr_remesh(context(), mesh.get(), start, uv, count, out, &mut told) };
    let Some(made) = create(call) else { return };
    // SAFETY: the header says how long the array is; the mesh is borrowed.
    let indices = unsafe { array(made.read(azulejo_mesh_indices), 3 * made.read(azulejo_mesh_triangle_count)) };
    assert_eq!(made.read(azulejo_mesh_vertex_count), count);
    let mut edges: Vec<[u32; 2]> =
        indices.as_chunks::<3>().0.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
    edges.sort_unstable();
    assert!(edges.windows(2).all(|pair| pair[0] != pair[1]), "an edge has two triangles on one side");
    let inner = edges.iter().filter(|[a, b]| edges.binary_search(&[*b, *a]).is_ok()).count();
    assert_eq!((told.triangles, told.inner_edges), (indices.len() as u64 / 3, inner as u64 / 2));
    assert_eq!(told.boundary_edges, (edges.len() - inner) as u64);
}

/// The smallest distance of two positions.
fn smallest(positions: &[[f32; 3]]) -> f64 {
    let square = |a: [f32; 3], b: [f32; 3]| (0..3).map(|i| (f64::from(a[i]) - f64::from(b[i])).powi(2)).sum::<f64>();
    let of = |i: usize| positions[..i].iter().map(move |&other| square(positions[i], other));
    (0..positions.len()).flat_map(of).fold(f64::INFINITY, f64::min).sqrt()
}
