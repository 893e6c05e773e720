//! Sets of samples as Python sees them.

use numpy::{PyArray1, PyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyIterator, PyTuple};
use pyo3::{PyClass, PyClassInitializer, PyTypeCheck};

use crate::array::{Array, Entry, line, line_if_any, standing_for, table};
use crate::error::invalid;
use crate::frame::{Frame, Rows, in_frame};

/// The ground on which samples lie.
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

    /// The domain of samples of a cuboid.
    pub(crate) fn cuboid(self) -> Option<Frame<3>> {
        match self {
            Self::Cuboid(frame) => Some(frame),
            _ => None,
        }
    }
}

/// Samples. len() is their number n; numpy.asarray() gives their positions. What does not apply is None.
///
/// points[i] is the position of one sample, and iteration goes over all; points[:100], points[mask] and points[indices] are
/// Points with all that is known of these samples. Points can be copied and pickled.
#[pyclass(frozen, module = "azulejo")]
pub(crate) struct Points {
    /// Positions, shape (n, 2) in the plane or (n, 3) in space, in the units of the domain or mesh: float32, or float64
    /// where the domain or mesh has an origin that is not 0, which is then added to local_positions.
    #[pyo3(get)]
    positions: Py<PyAny>,
    /// The positions relative to origin, float32, shape (n, 2) or (n, 3): what radii and gaps hold for to the last bit.
    #[pyo3(get)]
    pub(crate) local_positions: Py<PyAny>,
    /// The origin of local_positions, float64, shape (2,) or (3,): 0 unless the domain or mesh lies so far from
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
    /// The radius of each sample if radii vary, float64, shape (n,), in the units of the mesh or domain.
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
            ids: _,       // see with_ids
            instances: _, // no call of Python makes any
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

    /// Samples inside a mesh with this origin.
    pub(crate) fn solid(py: Python<'_>, samples: azulejo_core::Points<3>, origin: [f64; 3]) -> PyResult<Self> {
        let surface = Self::surface(py, samples, origin)?;
        Ok(Self { normals: None, triangles: None, barycentrics: None, ..surface })
    }

    /// Samples of a call whose radius varies: an empty set has radii too.
    pub(crate) fn adaptive(py: Python<'_>, mut samples: azulejo_core::Points<3>, origin: [f64; 3]) -> PyResult<Self> {
        let radii = std::mem::take(&mut samples.radii);
        Ok(Self { radii: Some(line(py, radii)), ..Self::surface(py, samples, origin)? })
    }

    /// Samples of a volume whose radius varies: an empty set has radii too.
    pub(crate) fn with_radii(self, py: Python<'_>, radii: Vec<f64>) -> Self {
        Self { radii: Some(line(py, radii)), ..self }
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
        standing_for(self.positions.bind(py), dtype, copy)
    }

    /// The positions as a DLPack capsule, which torch.from_dlpack() and others take.
    #[pyo3(signature = (**options))]
    fn __dlpack__<'py>(&self, py: Python<'py>, options: Option<&Bound<'py, PyDict>>) -> PyResult<Bound<'py, PyAny>> {
        self.positions.bind(py).call_method("__dlpack__", (), options)
    }

    fn __dlpack_device__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.positions.bind(py).call_method0("__dlpack_device__")
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        self.positions.bind(py).try_iter()
    }

    /// Of a number the position of one sample. Of a slice, or an array of numbers or truth values, Points with all that is
    /// known of these samples, but for the report. Of a tuple, positions[key].
    fn __getitem__(&self, py: Python<'_>, key: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        let rows = self.local_positions.bind(py).get_item(key)?;
        let is_rows = !key.is_instance_of::<PyTuple>() && rows.getattr("ndim")?.extract::<usize>()? == 2;
        if !is_rows {
            return Ok(self.positions.bind(py).get_item(key)?.unbind());
        }
        let part = Self {
            positions: if self.has_origin { part_of(py, &self.positions, key)? } else { rows.clone().unbind() },
            local_positions: rows.clone().unbind(),
            origin: self.origin.clone_ref(py),
            has_origin: self.has_origin,
            place: self.place,
            normals: part_of_any(py, self.normals.as_ref(), key)?,
            interpolated_normals: part_of_any(py, self.interpolated_normals.as_ref(), key)?,
            triangles: part_of_any(py, self.triangles.as_ref(), key)?,
            barycentrics: part_of_any(py, self.barycentrics.as_ref(), key)?,
            radii: part_of_any(py, self.radii.as_ref(), key)?,
            ranks: part_of_any(py, self.ranks.as_ref(), key)?,
            classes: part_of_any(py, self.classes.as_ref(), key)?,
            ids: part_of_any(py, self.ids.as_ref(), key)?,
            report: None,
            count: rows.len()?,
        };
        Ok(Py::new(py, part)?.into_any())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyDict>,))> {
        let known = PyDict::new(py);
        known.set_item("local_positions", &self.local_positions)?;
        known.set_item("origin", &self.origin)?;
        known.set_item("domain", self.domain_min().zip(self.domain_max()).zip(self.boundary()))?;
        known.set_item("normals", &self.normals)?;
        known.set_item("interpolated_normals", &self.interpolated_normals)?;
        known.set_item("triangles", &self.triangles)?;
        known.set_item("barycentrics", &self.barycentrics)?;
        known.set_item("radii", &self.radii)?;
        known.set_item("ranks", &self.ranks)?;
        known.set_item("classes", &self.classes)?;
        known.set_item("ids", &self.ids)?;
        known.set_item("report", &self.report)?;
        Ok((py.import("azulejo")?.getattr("_points")?, (known,)))
    }

    /// The number of samples, their ground, and the names of their arrays.
    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let place = match self.place {
            Place::Plane(frame) => format!("in {}", frame.shown()),
            Place::Cuboid(frame) => format!("in {}", frame.shown()),
            Place::Mesh => "on a mesh".to_owned(),
        };
        let columns = [
            ("interpolated normals", self.interpolated_normals.is_some()),
            ("radii", self.radii.is_some()),
            ("ranks", self.ranks.is_some()),
            ("classes", self.classes.is_some()),
            ("ids", self.ids.is_some()),
        ];
        let known: Vec<_> = columns.into_iter().filter_map(|(name, is_known)| is_known.then_some(name)).collect();
        let known = if known.is_empty() { String::new() } else { format!(", with {}", known.join(", ")) };
        let report = match &self.report {
            Some(report) => format!("; {}", report.bind(py).repr()?),
            None => String::new(),
        };
        Ok(format!("<azulejo.Points: {} {place}{known}{report}>", self.count))
    }
}

/// The entries of an array that a key selects.
fn part_of<T: PyTypeCheck>(py: Python<'_>, array: &Py<T>, key: &Bound<'_, PyAny>) -> PyResult<Py<T>> {
    Ok(array.bind(py).as_any().get_item(key)?.cast_into::<T>()?.unbind())
}

/// [`part_of`] of an array, if there is one.
fn part_of_any<T: PyTypeCheck>(
    py: Python<'_>,
    array: Option<&Py<T>>,
    key: &Bound<'_, PyAny>,
) -> PyResult<Option<Py<T>>> {
    array.map(|array| part_of(py, array, key)).transpose()
}

/// The corners of a domain, and the name of its boundary.
type Corners = ((Vec<f64>, Vec<f64>), String);

/// Points as pickle takes them apart.
#[pyfunction]
pub(crate) fn _points(py: Python<'_>, known: &Bound<'_, PyDict>) -> PyResult<Points> {
    fn of<'py, T: for<'a> FromPyObject<'a, 'py>>(known: &Bound<'py, PyDict>, name: &str) -> PyResult<T> {
        let item = known.get_item(name)?.ok_or_else(|| invalid("known", format!("{name} is not there")))?;
        item.extract().map_err(Into::into)
    }
    let local: Py<PyArray2<f32>> = of(known, "local_positions")?;
    let origin: Py<PyArray1<f64>> = of(known, "origin")?;
    let place = match of::<Option<Corners>>(known, "domain")? {
        None => Place::Mesh,
        Some(((min, max), boundary)) => match min.len() {
            2 => Place::Plane(restored(py, &min, &max, &boundary, &origin)?),
            _ => Place::Cuboid(restored(py, &min, &max, &boundary, &origin)?),
        },
    };
    let axes = local.bind(py).shape()[1];
    let (positions, has_origin) = match axes {
        2 => restored_positions::<2>(py, &local, &origin)?,
        _ => restored_positions::<3>(py, &local, &origin)?,
    };
    Ok(Points {
        positions,
        count: local.bind(py).shape()[0],
        local_positions: local.into_any(),
        origin,
        has_origin,
        place,
        normals: of(known, "normals")?,
        interpolated_normals: of(known, "interpolated_normals")?,
        triangles: of(known, "triangles")?,
        barycentrics: of(known, "barycentrics")?,
        radii: of(known, "radii")?,
        ranks: of(known, "ranks")?,
        classes: of(known, "classes")?,
        ids: of(known, "ids")?,
        report: of(known, "report")?,
    })
}

fn corner<const N: usize>(numbers: &[f64]) -> PyResult<[f64; N]> {
    numbers.try_into().map_err(|_| invalid("known", format!("{} coordinates, not {N}", numbers.len())))
}

fn restored<const N: usize>(
    py: Python<'_>,
    min: &[f64],
    max: &[f64],
    boundary: &str,
    origin: &Py<PyArray1<f64>>,
) -> PyResult<Frame<N>> {
    let origin = corner(&origin.extract::<Vec<f64>>(py)?)?;
    Frame::with_origin(corner(min)?, corner(max)?, boundary, origin)
}

/// Positions in the caller's frame, and whether that has another origin.
fn restored_positions<const N: usize>(
    py: Python<'_>,
    local: &Py<PyArray2<f32>>,
    origin: &Py<PyArray1<f64>>,
) -> PyResult<(Py<PyAny>, bool)> {
    let origin = corner::<N>(&origin.extract::<Vec<f64>>(py)?)?;
    Ok((in_frame(local.bind(py), origin)?, origin != [0.0; N]))
}
