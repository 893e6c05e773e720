//! Remeshing: the mesh of the triangles of samples.

use std::sync::Arc;

use azulejo_core::dcr::surface::{RemeshReport, remesh};

use crate::boundary::{Out, rows};
use crate::context::azulejo_context;
use crate::growing::{self, Growing, Output, growing};
use crate::handles;
use crate::mesh::azulejo_mesh;
use crate::progress::Watch;
use crate::status::azulejo_status;

/// The report of azulejo_dcr_remesh. The mesh is a manifold if `non_manifold_vertices` is 0, closed
/// if `boundary_edges` is 0 too, and wound alike at each edge.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_dcr_remesh_report {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// Always 0.
    pub reserved: u32,
    /// The triangles of the mesh.
    pub triangles: u64,
    /// Those that not all of their three corners have in their Delaunay stars.
    pub disputed: u64,
    /// Those of stars that are not in the mesh.
    pub left_out: u64,
    /// The edges with one triangle, which are the boundary.
    pub boundary_edges: u64,
    /// The edges with two triangles.
    pub inner_edges: u64,
    /// The edges with more than two triangles: always 0.
    pub non_manifold_edges: u64,
    /// The samples whose triangles are not all connected by edges at the sample.
    pub non_manifold_vertices: u64,
    /// The samples without a triangle.
    pub unused_vertices: u64,
    /// Vertices - edges + triangles, all of them used: 2 for a sphere, 0 for a torus, 1 for a disk.
    pub euler: i64,
    /// The smallest angle of all triangles, in degrees.
    pub smallest_angle: f64,
    /// The largest angle of all triangles, in degrees.
    pub largest_angle: f64,
    /// The mean of the triangles' smallest angles, in degrees.
    pub mean_smallest_angle: f64,
}

growing!(azulejo_dcr_remesh_report requires triangles {
    reserved: 0,
    triangles: 0,
    disputed: 0,
    left_out: 0,
    boundary_edges: 0,
    inner_edges: 0,
    non_manifold_edges: 0,
    non_manifold_vertices: 0,
    unused_vertices: 0,
    euler: 0,
    smallest_angle: 0.0,
    largest_angle: 0.0,
    mean_smallest_angle: 0.0,
});

impl From<RemeshReport> for azulejo_dcr_remesh_report {
    fn from(RemeshReport { triangles, disputed, left_out, quality, .. }: RemeshReport) -> Self {
        Self {
            triangles,
            disputed,
            left_out,
            boundary_edges: quality.boundary_edges,
            inner_edges: quality.inner_edges,
            non_manifold_edges: quality.non_manifold_edges,
            non_manifold_vertices: quality.non_manifold_vertices,
            unused_vertices: quality.unused_vertices,
            euler: quality.euler,
            smallest_angle: quality.smallest_angle,
            largest_angle: quality.largest_angle,
            mean_smallest_angle: quality.mean_smallest_angle,
            ..Self::DEFAULT
        }
    }
}

/// Writes zeros and the size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_remesh_report_init(
    report: *mut azulejo_dcr_remesh_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}

/// Makes a mesh whose vertices are samples of another mesh (thesis fig. 1.12): remeshing, to more
/// triangles or to fewer. The samples must be spread about evenly, as maximal and, with better
/// angles, relaxed sets are. Triangles are those of the samples' Delaunay stars that go together.
///
/// Samples that resolve the features of a closed surface, wound alike everywhere, give a closed
/// manifold of the same topology; elsewhere, as on thin blades, there are holes. Triangles do not
/// cross open boundaries: the new boundary is that of the outermost samples.
///
/// triangles, barycentrics: as for azulejo_dcr_surface_relax.
///
/// out: the new mesh. Vertex i is sample i, also if it has no triangle; triangles are wound as
/// those of the old mesh under their corners.
///
/// O(n log n) time and O(n) memory in samples and triangles.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for samples that form no triangle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_remesh(
    context: *const azulejo_context,
    mesh: *const azulejo_mesh,
    triangles: *const u32,
    barycentrics: *const f32,
    count: usize,
    out: *mut *mut azulejo_mesh,
    report: *mut azulejo_dcr_remesh_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let mesh = unsafe { handles::get("mesh", mesh) }?.shared.clone();
        // SAFETY: handed on from the caller.
        let report = unsafe { Output::optional("report", report)? };
        // SAFETY: likewise.
        let triangles = unsafe { rows::<u32, 1>("triangles", triangles, "count", count) }?.as_flattened();
        // SAFETY: likewise.
        let barycentrics = unsafe { rows::<f32, 2>("barycentrics", barycentrics, "count", count) }?;
        let (made, done) =
            context.run(Watch::NONE, |context, progress| remesh(context, &mesh, triangles, barycentrics, progress))?;
        if let Some(report) = report {
            report.write(done);
        }
        Ok(azulejo_mesh { shared: Arc::new(made) })
    })
}
