//! Triangle meshes.

use std::path::PathBuf;
use std::sync::Arc;

use azulejo_core::mesh;
use numpy::PyArray2;
use pyo3::prelude::*;

use crate::array::{Array, optional, table};
use crate::error::{invalid, raised};
use crate::points::Points;

/// A triangle mesh, as it comes: open, in parts, wound in any way. Immutable; several threads may use it at once.
///
/// positions: of the vertices, float32, shape (v, 3); other real numbers are rounded.
/// indices: of the triangles' corners, uint32, shape (t, 3); other whole numbers are converted.
/// normals: float32, shape (v, 3), or any number of them with normal_indices. Samples have them interpolated.
/// normal_indices: uint32, shape (t, 3): the normals of the triangles' corners.
/// mask: bool, shape (t,): triangles with False get no samples and need not be covered.
#[pyclass(frozen, module = "azulejo")]
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
        let positions = Array::<f32>::read("positions", positions)?.rows()?.to_vec();
        let indices = Array::<u32>::read("indices", indices)?.rows()?.to_vec();
        let mut mesh: Self = py.detach(|| mesh::Mesh::new(positions, indices)).map_err(raised)?.into();
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
        Ok(py.detach(|| mesh::Mesh::load(path)).map_err(raised)?.into())
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
        Ok(py.detach(|| mesh::Mesh::clone(&self.shared).with_mask(mask)).map_err(raised)?.into())
    }

    /// The mesh with its vertices moved: float32, shape (v, 3). Its triangles and mask stay, its normals do not.
    fn deform(&self, py: Python<'_>, positions: &Bound<'_, PyAny>) -> PyResult<Self> {
        let positions = Array::<f32>::read("positions", positions)?.rows()?.to_vec();
        Ok(py.detach(|| self.shared.deformed(positions)).map_err(raised)?.into())
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
        let samples = py.detach(|| self.shared.samples_at(triangles, barycentrics)).map_err(raised)?;
        Points::surface(py, samples)
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

    /// A copy of the positions of the vertices, float32, shape (v, 3).
    #[getter]
    fn positions(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f32>>> {
        table(py, self.shared.positions().to_vec())
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

    /// The area that the mask does not leave out, in square units of the mesh.
    #[getter]
    fn area(&self) -> f64 {
        self.shared.area()
    }

    fn __repr__(&self) -> String {
        format!("<azulejo.Mesh: {} vertices, {} triangles>", self.vertex_count(), self.triangle_count())
    }
}
