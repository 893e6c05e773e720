//! Sets of samples as Python sees them.

use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::IntoPyDict;
use pyo3::{PyClass, PyClassInitializer};

use crate::array::{Array, Entry, line, line_if_any, table};

/// Samples. len() is their number n; numpy.asarray() gives their positions. What does not apply is None.
#[pyclass(frozen, module = "azulejo")]
pub(crate) struct Points {
    /// Positions, float32, shape (n, 2) in the plane or (n, 3) on meshes, in the units of the domain or mesh.
    #[pyo3(get)]
    positions: Py<PyAny>,
    /// On meshes: unit normals of the samples' triangles, float32, shape (n, 3).
    #[pyo3(get)]
    normals: Option<Py<PyArray2<f32>>>,
    /// On meshes with normals: these, interpolated to the samples, float32, shape (n, 3).
    #[pyo3(get)]
    interpolated_normals: Option<Py<PyArray2<f32>>>,
    /// On meshes: the triangle of each sample, uint32, shape (n,).
    #[pyo3(get)]
    triangles: Option<Py<PyArray1<u32>>>,
    /// On meshes: u, v of each sample, float32, shape (n, 2): it lies at (1 - u - v) a + u b + v c.
    #[pyo3(get)]
    barycentrics: Option<Py<PyArray2<f32>>>,
    /// Where radii vary: the radius of each sample, float64, shape (n,), in the units of the mesh.
    #[pyo3(get)]
    radii: Option<Py<PyArray1<f64>>>,
    /// In progressive order: the rank of each sample, a distance, float32, shape (n,). The samples up to one are at least
    /// its rank apart.
    #[pyo3(get)]
    ranks: Option<Py<PyArray1<f32>>>,
    /// Of several classes: the class of each sample, uint32, shape (n,).
    #[pyo3(get)]
    classes: Option<Py<PyArray1<u32>>>,
    /// Of sets that are edited: the id of each sample, uint64, shape (n,).
    #[pyo3(get)]
    ids: Option<Py<PyArray1<u64>>>,
    /// The report of the call.
    #[pyo3(get)]
    report: Option<Py<PyAny>>,
    count: usize,
}

impl Points {
    pub(crate) fn plane(py: Python<'_>, points: impl Into<azulejo_core::Points<2>>) -> PyResult<Self> {
        let azulejo_core::Points { positions, ranks, classes, .. } = points.into();
        let count = positions.len();
        Ok(Self {
            positions: table(py, positions)?.into_any(),
            normals: None,
            interpolated_normals: None,
            triangles: None,
            barycentrics: None,
            radii: None,
            ranks: line_if_any(py, ranks),
            classes: line_if_any(py, classes),
            ids: None,
            report: None,
            count,
        })
    }

    /// Samples of the plane that have classes even if there are none of them.
    pub(crate) fn classified(py: Python<'_>, points: azulejo_core::Points<2>) -> PyResult<Self> {
        let classes = points.classes.clone();
        Ok(Self::plane(py, points)?.with_classes(py, classes))
    }

    pub(crate) fn surface(py: Python<'_>, samples: azulejo_core::Points<3>) -> PyResult<Self> {
        let azulejo_core::Points {
            positions,
            normals,
            triangles,
            barycentrics,
            interpolated_normals,
            ranks,
            classes,
            radii,
            ids: _, // see with_ids
        } = samples;
        let has_normals = !interpolated_normals.is_empty();
        Ok(Self {
            count: positions.len(),
            positions: table(py, positions)?.into_any(),
            normals: Some(table(py, normals)?),
            interpolated_normals: has_normals.then(|| table(py, interpolated_normals)).transpose()?,
            triangles: Some(line(py, triangles)),
            barycentrics: Some(table(py, barycentrics)?),
            radii: line_if_any(py, radii),
            ranks: line_if_any(py, ranks),
            classes: line_if_any(py, classes),
            ids: None,
            report: None,
        })
    }

    /// Samples of a call whose radius varies: an empty set has radii too.
    pub(crate) fn adaptive(py: Python<'_>, mut samples: azulejo_core::Points<3>) -> PyResult<Self> {
        let radii = std::mem::take(&mut samples.radii);
        Ok(Self { radii: Some(line(py, radii)), ..Self::surface(py, samples)? })
    }

    /// Samples of a set that is edited: an empty set has ids too.
    pub(crate) fn with_ids(self, py: Python<'_>, ids: Vec<u64>) -> Self {
        Self { ids: Some(line(py, ids)), ..self }
    }

    /// The samples of a set that is edited, as the library takes them.
    pub(crate) fn samples<const N: usize>(&self, py: Python<'_>) -> PyResult<azulejo_core::Points<N>> {
        let barycentrics = self.barycentrics.as_ref().map(|rows| rows.bind(py).as_any());
        Ok(azulejo_core::Points {
            positions: Array::read("points", self.positions.bind(py))?.rows()?.to_vec(),
            triangles: entries(py, self.triangles.as_ref())?,
            barycentrics: match barycentrics {
                Some(rows) => Array::read("points", rows)?.rows()?.to_vec(),
                None => Vec::new(),
            },
            ids: entries(py, self.ids.as_ref())?,
            ..Default::default()
        })
    }

    pub(crate) fn with_classes(self, py: Python<'_>, classes: Vec<u32>) -> Self {
        Self { classes: Some(line(py, classes)), ..self }
    }

    pub(crate) fn with_report<R: PyClass + Into<PyClassInitializer<R>>>(
        self,
        py: Python<'_>,
        report: R,
    ) -> PyResult<Self> {
        Ok(Self { report: Some(Py::new(py, report)?.into_any()), ..self })
    }
}

/// The entries of an array, if there is one.
fn entries<T: Entry>(py: Python<'_>, array: Option<&Py<PyArray1<T>>>) -> PyResult<Vec<T>> {
    array.map_or(Ok(Vec::new()), |array| Ok(Array::read("points", array.bind(py).as_any())?.line()?.to_vec()))
}

#[pymethods]
impl Points {
    fn __len__(&self) -> usize {
        self.count
    }

    #[pyo3(signature = (dtype=None, copy=None))]
    fn __array__<'py>(
        &self,
        py: Python<'py>,
        dtype: Option<Bound<'py, PyAny>>,
        copy: Option<bool>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (numpy, positions) = (py.import("numpy")?, self.positions.bind(py));
        match copy {
            None => numpy.call_method1("asarray", (positions, dtype)),
            Some(copy) => numpy.call_method("array", (positions, dtype), Some(&[("copy", copy)].into_py_dict(py)?)),
        }
    }

    fn __repr__(&self) -> String {
        format!("<azulejo.Points: {}>", self.count)
    }
}
