//! Sets of samples as Python sees them.

use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::IntoPyDict;
use pyo3::{PyClass, PyClassInitializer};

use crate::array::{Array, Entry, line, line_if_any, table};
use crate::error::invalid;
use crate::frame::{Frame, Rows, in_frame};

/// What samples lie in or on.
#[derive(Clone, Copy)]
pub(crate) enum Place {
    Plane(Frame),
    Cuboid(Frame<3>),
    Mesh,
}

impl Place {
    /// The domain of samples of the plane.
    pub(crate) fn plane(self) -> Option<Frame> {
        match self {
            Self::Plane(frame) => Some(frame),
            _ => None,
        }
    }
}

/// Samples. len() is their number n; numpy.asarray() gives their positions. What does not apply is None.
#[pyclass(frozen, module = "azulejo")]
pub(crate) struct Points {
    /// Positions, shape (n, 2) in the plane or (n, 3) in space, in the units of the domain or mesh: float32, or float64
    /// where the domain or mesh has an origin that is not 0, which is then added to local_positions.
    #[pyo3(get)]
    positions: Py<PyAny>,
    /// The positions relative to origin, float32, shape (n, 2) or (n, 3): what radii and gaps hold for to the last bit.
    #[pyo3(get)]
    pub(crate) local_positions: Py<PyAny>,
    /// What local_positions are relative to, float64, shape (2,) or (3,): 0 unless the domain or mesh lies so far from
    /// there that float32 would be too coarse.
    #[pyo3(get)]
    origin: Py<PyArray1<f64>>,
    pub(crate) has_origin: bool,
    pub(crate) place: Place,
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
    pub(crate) fn plane(py: Python<'_>, points: impl Into<azulejo_core::Points<2>>, frame: &Frame) -> PyResult<Self> {
        Self::inside(py, points.into(), frame, Place::Plane(*frame))
    }

    /// Samples of a cuboid.
    pub(crate) fn cuboid(py: Python<'_>, points: azulejo_core::Points<3>, frame: &Frame<3>) -> PyResult<Self> {
        Self::inside(py, points, frame, Place::Cuboid(*frame))
    }

    /// Samples of a domain.
    fn inside<const N: usize>(
        py: Python<'_>,
        points: azulejo_core::Points<N>,
        frame: &Frame<N>,
        place: Place,
    ) -> PyResult<Self> {
        let azulejo_core::Points { positions, ranks, classes, .. } = points;
        let count = positions.len();
        let local = table(py, positions)?;
        Ok(Self {
            positions: in_frame(local.bind(py), frame.origin)?,
            local_positions: local.into_any(),
            origin: line(py, frame.origin.to_vec()),
            has_origin: frame.origin != [0.0; N],
            place,
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
    pub(crate) fn classified(py: Python<'_>, points: azulejo_core::Points<2>, frame: &Frame) -> PyResult<Self> {
        let classes = points.classes.clone();
        Ok(Self::plane(py, points, frame)?.with_classes(py, classes))
    }

    /// Samples of a mesh with this origin.
    pub(crate) fn surface(py: Python<'_>, samples: azulejo_core::Points<3>, origin: [f64; 3]) -> PyResult<Self> {
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
        let count = positions.len();
        let local = table(py, positions)?;
        Ok(Self {
            count,
            positions: in_frame(local.bind(py), origin)?,
            local_positions: local.into_any(),
            origin: line(py, origin.to_vec()),
            has_origin: origin != [0.0; 3],
            place: Place::Mesh,
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
    pub(crate) fn adaptive(py: Python<'_>, mut samples: azulejo_core::Points<3>, origin: [f64; 3]) -> PyResult<Self> {
        let radii = std::mem::take(&mut samples.radii);
        Ok(Self { radii: Some(line(py, radii)), ..Self::surface(py, samples, origin)? })
    }

    /// Samples of a set that is edited: an empty set has ids too.
    pub(crate) fn with_ids(self, py: Python<'_>, ids: Vec<u64>) -> Self {
        Self { ids: Some(line(py, ids)), ..self }
    }

    /// The samples of a set that is edited, as the library takes them.
    pub(crate) fn samples<const N: usize>(&self, py: Python<'_>) -> PyResult<azulejo_core::Points<N>> {
        let barycentrics = self.barycentrics.as_ref().map(|rows| rows.bind(py).as_any());
        Ok(azulejo_core::Points {
            positions: self.local(py)?.get()?.to_vec(),
            triangles: entries(py, self.triangles.as_ref())?,
            barycentrics: match barycentrics {
                Some(rows) => Array::read("points", rows)?.rows()?.to_vec(),
                None => Vec::new(),
            },
            ids: entries(py, self.ids.as_ref())?,
            ..Default::default()
        })
    }

    /// The positions relative to the origin.
    pub(crate) fn local<'py, const N: usize>(&self, py: Python<'py>) -> PyResult<Rows<'py, N>> {
        let array = Array::read("points", self.local_positions.bind(py))?;
        array.rows::<N>()?;
        Ok(Rows::InPlace(array))
    }

    /// The origin.
    pub(crate) fn origin<const N: usize>(&self, py: Python<'_>) -> PyResult<[f64; N]> {
        let origin = self.origin.bind(py).as_any();
        let entries = Array::<f64>::read("points", origin)?;
        <[f64; N]>::try_from(entries.entries())
            .map_err(|_| invalid("points", format!("they do not have {N} coordinates")))
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
    /// In the plane and in cuboids: the lower corner of the domain, two or three numbers.
    #[getter]
    fn domain_min(&self) -> Option<Vec<f64>> {
        match self.place {
            Place::Plane(frame) => Some(frame.whole.min.to_vec()),
            Place::Cuboid(frame) => Some(frame.whole.min.to_vec()),
            Place::Mesh => None,
        }
    }

    /// In the plane and in cuboids: the upper corner of the domain, two or three numbers.
    #[getter]
    fn domain_max(&self) -> Option<Vec<f64>> {
        match self.place {
            Place::Plane(frame) => Some(frame.whole.max.to_vec()),
            Place::Cuboid(frame) => Some(frame.whole.max.to_vec()),
            Place::Mesh => None,
        }
    }

    /// In the plane and in cuboids: "periodic" or "bounded".
    #[getter]
    fn boundary(&self) -> Option<&'static str> {
        match self.place {
            Place::Plane(frame) => Some(frame.boundary()),
            Place::Cuboid(frame) => Some(frame.boundary()),
            Place::Mesh => None,
        }
    }

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
