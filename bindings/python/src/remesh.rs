//! Remeshing: the mesh of the triangles of samples.

use azulejo_core::dcr::surface::{RemeshReport, remesh};
use pyo3::prelude::*;

use crate::argument::{callable, whole};
use crate::array::Array;
use crate::mesh::Mesh;
use crate::report::report;
use crate::taken;
use crate::watch::Watch;

report! {
    /// The mesh that dcr_remesh returns: a surface if non_manifold_vertices is 0, and a closed one if boundary_edges is 0
    /// too.
    DcrRemeshReport {
        /// Triangles of the mesh.
        triangles: u64,
        /// The number of triangles that are not in the Delaunay stars of all three corners.
        disputed: u64,
        /// Triangles of stars that are not in the mesh, because they do not go with others.
        left_out: u64,
        /// Edges with one triangle: the boundary.
        boundary_edges: u64,
        /// Edges with two triangles.
        inner_edges: u64,
        /// Edges with more than two: always 0.
        non_manifold_edges: u64,
        /// Samples whose triangles are not all connected by edges at the sample.
        non_manifold_vertices: u64,
        /// Samples without a triangle.
        unused_vertices: u64,
        /// Vertices - edges + triangles, without unused vertices: 2 for a sphere, 0 for a torus, 1 for a disk.
        euler: i64,
        /// The smallest angle of all triangles, in degrees.
        smallest_angle: f64,
        /// The largest angle of all triangles, in degrees.
        largest_angle: f64,
        /// The mean over all triangles of their smallest angle, in degrees.
        mean_smallest_angle: f64,
    }
}

impl From<RemeshReport> for DcrRemeshReport {
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
        }
    }
}

/// Makes a mesh whose vertices are samples of another mesh, spread about evenly as those of maximal and relaxed sets
/// are: remeshing, to more triangles or to fewer. No edge has more than two triangles, and two at an edge are wound
/// alike.
///
/// Samples that resolve the features of a closed surface, wound alike everywhere, give a closed surface of the same
/// topology. Where they do not, as on thin blades, there are holes. Relaxed samples give the better angles.
///
/// mesh: a Mesh.
/// triangles, barycentrics: where the samples are, uint32, shape (n,), and float32, shape (n, 2), as in Points.
/// threads: 0 for one per core. The result does not depend on it.
/// progress: called with the fraction that is done, from 0 to 1; if it returns False the call raises Cancelled.
///
/// Returns a Mesh, whose vertex i is sample i, and a DcrRemeshReport.
#[pyfunction]
#[pyo3(signature = (mesh, triangles, barycentrics, *, threads=0, progress=None))]
pub(crate) fn dcr_remesh(
    py: Python<'_>,
    #[pyo3(from_py_with = taken::mesh)] mesh: Mesh,
    triangles: &Bound<'_, PyAny>,
    barycentrics: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<(Mesh, DcrRemeshReport)> {
    let (triangles, barycentrics) = (Array::read("triangles", triangles)?, Array::read("barycentrics", barycentrics)?);
    let (triangles, barycentrics) = (triangles.line()?, barycentrics.rows()?);
    let (made, report) = Watch::new(py, threads, progress)?
        .run(|context, progress| remesh(context, &mesh.shared, triangles, barycentrics, progress))?;
    Ok((made.into(), report.into()))
}
