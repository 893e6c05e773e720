//! Triangle meshes.

use std::path::PathBuf;
use std::sync::Arc;

use azulejo_core::{Interior, mesh};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;

use crate::argument::{callable, whole};
use crate::array::{Array, line, optional, table};
use crate::error::{invalid, raised};
use crate::frame::{Positions, framed};
use crate::points::Points;
use crate::taken;
use crate::watch::{Watch, unlocked};

/// A triangle mesh, as it comes: open, in parts, wound in any way. Immutable; several threads may use it at once. It can be
/// pickled.
///
/// positions: of the vertices, shape (v, 3), any real numbers, of which float32 is kept, relative to an origin: 0 unless
///     the mesh lies so far from there that rounding would move vertices by more than a millionth of its size.
/// indices: of the triangles' corners, whole numbers of any type, shape (t, 3); faces of more corners become fans of
///     triangles.
/// normals: float32, shape (v, 3), or any number of them with normal_indices. Samples have them interpolated.
/// normal_indices: uint32, shape (t, 3): the normals of the triangles' corners.
/// mask: bool, shape (t,): triangles with False get no samples and need not be covered.
#[pyclass(frozen, module = "azulejo", skip_from_py_object)]
#[derive(Clone)]
pub(crate) struct Mesh {
    pub(crate) shared: Arc<mesh::Mesh>,
}

impl From<mesh::Mesh> for Mesh {
    fn from(mesh: mesh::Mesh) -> Self {
        Self { shared: Arc::new(mesh) }
    }
}

#[pymethods]
impl Mesh {
    #[new]
    #[pyo3(signature = (positions, indices, *, normals=None, normal_indices=None, mask=None))]
    fn new(
        py: Python<'_>,
        positions: &Bound<'_, PyAny>,
        indices: &Bound<'_, PyAny>,
        normals: Option<&Bound<'_, PyAny>>,
        normal_indices: Option<&Bound<'_, PyAny>>,
        mask: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (positions, origin, _) = Positions::read("positions", positions)?.centred()?;
        let positions = positions.get()?.to_vec();
        let indices = taken::triangles(indices)?;
        let made = unlocked(py, || mesh::Mesh::new(positions, indices))?;
        let mut mesh: Self = made.with_origin(origin).into();
        if let Some(normals) = normals {
            mesh = mesh.with_normals(normals, normal_indices)?;
        } else if normal_indices.is_some() {
            return Err(invalid("normal_indices", "there are no normals"));
        }
        if let Some(mask) = mask {
            mesh = mesh.with_mask(py, mask)?;
        }
        Ok(mesh)
    }

    /// Reads an OBJ, PLY or STL file, with its normals. Raises OSError, or ValueError if the file is broken.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        Ok(unlocked(py, || mesh::Mesh::load(path))?.into())
    }

    /// The mesh with normals, as in Mesh(); shares everything else with this one.
    #[pyo3(signature = (normals, normal_indices=None))]
    fn with_normals(&self, normals: &Bound<'_, PyAny>, normal_indices: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let normals = Array::<f32>::read("normals", normals)?.rows()?.to_vec();
        let indices = optional::<u32>("normal_indices", normal_indices)?;
        let indices = indices.map(|indices| Ok::<_, PyErr>(indices.rows()?.to_vec())).transpose()?;
        Ok(mesh::Mesh::clone(&self.shared).with_normals(normals, indices).map_err(raised)?.into())
    }

    /// The mesh with a mask, as in Mesh(); shares everything else with this one.
    fn with_mask(&self, py: Python<'_>, mask: &Bound<'_, PyAny>) -> PyResult<Self> {
        let mask = Array::<bool>::read("mask", mask)?.line()?.to_vec();
        Ok(unlocked(py, || mesh::Mesh::clone(&self.shared).with_mask(mask))?.into())
    }

    /// The mesh with its vertices moved: positions as in Mesh(). Its triangles and mask stay, its normals do not.
    fn deform(&self, py: Python<'_>, positions: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (positions, origin, _) = Positions::read("positions", positions)?.centred()?;
        let positions = positions.get()?.to_vec();
        Ok(unlocked(py, || self.shared.deformed(positions))?.with_origin(origin).into())
    }

    /// The points at places of the surface, such as those of samples on a mesh that was deformed since.
    ///
    /// triangles: uint32, shape (n,). barycentrics: float32, shape (n, 2), as in Points.
    fn points(
        &self,
        py: Python<'_>,
        triangles: &Bound<'_, PyAny>,
        barycentrics: &Bound<'_, PyAny>,
    ) -> PyResult<Points> {
        let (triangles, barycentrics) =
            (Array::read("triangles", triangles)?, Array::read("barycentrics", barycentrics)?);
        let (triangles, barycentrics) = (triangles.line()?, barycentrics.rows()?);
        let samples = unlocked(py, || self.shared.samples_at(triangles, barycentrics))?;
        Points::surface(py, samples, self.shared.origin())
    }

    /// The number of vertices, v.
    #[getter]
    fn vertex_count(&self) -> usize {
        self.shared.positions().len()
    }

    /// The number of triangles, t.
    #[getter]
    fn triangle_count(&self) -> usize {
        self.shared.triangles().len()
    }

    /// A copy of the positions of the vertices, shape (v, 3): float32, or float64 where the origin is not 0.
    #[getter]
    fn positions(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        framed(py, self.shared.positions().to_vec(), self.shared.origin())
    }

    /// A copy of the positions relative to the origin, float32, shape (v, 3).
    #[getter]
    fn local_positions(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f32>>> {
        table(py, self.shared.positions().to_vec())
    }

    /// The place that the library's float32 positions are relative to, float64, shape (3,): 0 unless the mesh was made, or
    /// read from a file of text or doubles, so far from there that float32 would be too coarse. Samples have it too, as
    /// points.origin, and all positions that are passed in or out are in the frame of the caller.
    #[getter]
    fn origin(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        line(py, self.shared.origin().to_vec())
    }

    /// A copy of the indices of the triangles' corners, uint32, shape (t, 3).
    #[getter]
    fn indices(&self, py: Python<'_>) -> PyResult<Py<PyArray2<u32>>> {
        table(py, self.shared.triangles().to_vec())
    }

    /// True if the mesh carries normals.
    #[getter]
    fn has_normals(&self) -> bool {
        self.shared.has_normals()
    }

    /// A copy of the normals, float32, shape (n, 3): of the vertices, or those that normal_indices names; None without.
    #[getter]
    fn normals(&self, py: Python<'_>) -> PyResult<Option<Py<PyArray2<f32>>>> {
        self.has_normals().then(|| table(py, self.shared.normals().to_vec())).transpose()
    }

    /// A copy of the normals of the triangles' corners, uint32, shape (t, 3); None if they are those of the vertices.
    #[getter]
    fn normal_indices(&self, py: Python<'_>) -> PyResult<Option<Py<PyArray2<u32>>>> {
        self.shared.normal_indices().map(|indices| table(py, indices.to_vec())).transpose()
    }

    /// A copy of the mask, bool, shape (t,); None without one.
    #[getter]
    fn mask(&self, py: Python<'_>) -> Option<Py<PyArray1<bool>>> {
        self.shared.mask().map(|mask| line(py, mask.to_vec()))
    }

    /// The area that the mask does not leave out, in square units of the mesh.
    #[getter]
    fn area(&self) -> f64 {
        self.shared.area()
    }

    /// True if an even number of triangles shares each edge, so that the mesh has an inside, whatever the direction of its
    /// triangles and their intersections. Vertices at one place are one.
    #[getter]
    fn is_closed(&self) -> bool {
        self.shared.is_closed()
    }

    /// For each position whether it is inside the mesh: bool, shape (n,).
    ///
    /// Inside of a closed mesh are the points whose ray along +x crosses an odd number of triangles, without rounding. In any
    /// other mesh the generalised winding number is at least 1/2, or at most -1/2, up to .02 if the boundary has more than 2,048
    /// edges.
    ///
    /// positions: shape (n, 3). threads: 0 takes one per core. progress: called with the share that is done, 0 to 1; False
    ///     cancels.
    #[pyo3(signature = (positions, *, threads=0, progress=None))]
    fn contains(
        &self,
        py: Python<'_>,
        positions: &Bound<'_, PyAny>,
        #[pyo3(from_py_with = whole::threads)] threads: i128,
        #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
    ) -> PyResult<Py<PyArray1<bool>>> {
        let positions = Positions::read("positions", positions)?.around(self.shared.origin())?;
        let points = positions.get()?;
        let inside = Watch::new(py, threads, progress)?
            .run(|context, progress| Interior::of(&self.shared).contains_each(context, points, progress))?;
        Ok(line(py, inside))
    }

    /// The mesh itself, which does not change.
    fn __copy__(mesh: Py<Self>) -> Py<Self> {
        mesh
    }

    fn __deepcopy__(mesh: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        mesh
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, MeshParts)> {
        let parts = (
            self.local_positions(py)?,
            self.origin(py),
            self.indices(py)?,
            self.normals(py)?,
            self.normal_indices(py)?,
            self.mask(py),
        );
        Ok((py.import("azulejo")?.getattr("_mesh")?, parts))
    }

    fn __repr__(&self) -> String {
        let normals = if self.has_normals() { ", with normals" } else { "" };
        let masked = match self.shared.mask() {
            Some(mask) => format!(", {} of them masked", mask.iter().filter(|&&is_sampled| !is_sampled).count()),
            None => String::new(),
        };
        format!(
            "<azulejo.Mesh: {} vertices, {} triangles{masked}{normals}>",
            self.vertex_count(),
            self.triangle_count()
        )
    }
}

/// Positions, their origin, indices, normals and their indices, and a mask.
type MeshParts = (
    Py<PyArray2<f32>>,
    Py<PyArray1<f64>>,
    Py<PyArray2<u32>>,
    Option<Py<PyArray2<f32>>>,
    Option<Py<PyArray2<u32>>>,
    Option<Py<PyArray1<bool>>>,
);

/// A Mesh as pickle takes it apart.
#[pyfunction]
#[pyo3(signature = (local_positions, origin, indices, normals, normal_indices, mask))]
pub(crate) fn _mesh(
    py: Python<'_>,
    local_positions: &Bound<'_, PyAny>,
    origin: [f64; 3],
    indices: &Bound<'_, PyAny>,
    normals: Option<&Bound<'_, PyAny>>,
    normal_indices: Option<&Bound<'_, PyAny>>,
    mask: Option<&Bound<'_, PyAny>>,
) -> PyResult<Mesh> {
    let mesh = Mesh::new(py, local_positions, indices, normals, normal_indices, mask)?;
    Ok(mesh::Mesh::clone(&mesh.shared).with_origin(origin).into())
}
