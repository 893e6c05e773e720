//! Some points of a cloud, far from each other.

use azulejo_core::Centred;
use azulejo_core::thin::{self as core, Options};
use numpy::{PyArray1, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyIterator;

use crate::argument::{amount, callable, natural, number, order, whole};
use crate::array::{line, line_if_any, standing_for};
use crate::error::invalid;
use crate::frame::Positions;
use crate::watch::Watch;

/// Points that thin() selected; len() is their number n, and cloud[selection] are the points. It can be copied and pickled.
#[pyclass(frozen, module = "azulejo")]
pub(crate) struct Selection {
    /// Their indices in the cloud, uint32, shape (n,).
    #[pyo3(get)]
    indices: Py<PyArray1<u32>>,
    /// In progressive order: the distance of each from the nearest of those before it, float32, shape (n,); infinite for
    /// the first. None in any other order.
    #[pyo3(get)]
    ranks: Option<Py<PyArray1<f32>>>,
    count: usize,
}

#[pymethods]
impl Selection {
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
        standing_for(self.indices.bind(py), dtype, copy)
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        self.indices.bind(py).try_iter()
    }

    /// indices[key].
    fn __getitem__<'py>(&self, key: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        self.indices.bind(key.py()).as_any().get_item(key)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, SelectionParts)> {
        let parts = (self.indices.clone_ref(py), self.ranks.as_ref().map(|ranks| ranks.clone_ref(py)));
        Ok((py.import("azulejo")?.getattr("_selection")?, parts))
    }

    fn __repr__(&self) -> String {
        let ranks = if self.ranks.is_some() { ", with ranks" } else { "" };
        format!("<azulejo.Selection: {}{ranks}>", self.count)
    }
}

/// Indices and ranks.
type SelectionParts = (Py<PyArray1<u32>>, Option<Py<PyArray1<f32>>>);

/// A Selection as pickle takes it apart.
#[pyfunction]
#[pyo3(signature = (indices, ranks))]
pub(crate) fn _selection(py: Python<'_>, indices: Py<PyArray1<u32>>, ranks: Option<Py<PyArray1<f32>>>) -> Selection {
    Selection { count: indices.bind(py).len(), indices, ranks }
}

/// Selects points of a cloud that are far from each other and near to all the others.
///
/// positions: shape (n, 2) or (n, 3), any real numbers. Doubles are rounded to float32 near an origin of their own, and
///     the radius is lengthened by what that moved a pair at most: distances of the doubles are kept.
/// radius: the least distance of selected points; in any order, each point is kept that no kept one of lower index is
///     nearer to. 0 sets none.
/// count: the number of points to select, farthest-first. 0 sets none.
/// order: "any" (indices ascend) or "progressive" (farthest-first: each next point is the farthest from those before).
/// seed: 0 to 2**64 - 1, selects the first point.
/// threads: 0 for one per core. The result does not depend on it.
/// progress: called with the fraction that is done, from 0 to 1; if it returns False the call raises Cancelled.
///
/// Returns a Selection.
#[pyfunction]
#[pyo3(signature = (positions, *, radius=0.0, count=0, order="any", seed=0, threads=0, progress=None))]
pub(crate) fn thin(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = amount::radius)] radius: f64,
    #[pyo3(from_py_with = number::count)] count: i128,
    order: &str,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Selection> {
    let positions = Positions::read("positions", positions)?;
    let order = self::order(order, &[])?;
    let request = Options::default().count(natural("count", count)?).order(order).seed(natural("seed", seed)?);
    let watch = Watch::new(py, threads, progress)?;
    let core::Selection { indices, ranks, .. } = match positions.shape(py)?[..] {
        [_, 2] => select::<2>(positions, radius, request, watch)?,
        [_, 3] | [0] => select::<3>(positions, radius, request, watch)?,
        ref shape => return Err(invalid("positions", format!("its shape is {shape:?}, not [n, 2] or [n, 3]"))),
    };
    Ok(Selection { count: indices.len(), indices: line(py, indices), ranks: line_if_any(py, ranks) })
}

/// Selects points that are the radius apart as the caller gave them.
fn select<const N: usize>(
    positions: Positions,
    radius: f64,
    request: Options,
    watch: Watch,
) -> PyResult<core::Selection> {
    let (rows, _, rounding) = positions.centred::<N>()?;
    let points = rows.get()?;
    let request = request.radius(Centred::<N>::lengthened(radius, rounding));
    watch.run(|context, progress| core::thin(context, &request, points, progress))
}
