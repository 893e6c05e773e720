//! Several classes: the matrix of their radii.

use azulejo_core::Classes;
use numpy::PyArray2;
use pyo3::prelude::*;

use crate::argument::real;
use crate::array::{Array, line};
use crate::error::{invalid, raised, raised_as};

/// The argument `radii`.
pub(crate) fn matrix(radii: &Bound<'_, PyAny>) -> PyResult<Classes> {
    let radii = Array::read("radii", radii)?;
    match *radii.shape() {
        [rows, columns] if rows == columns => Classes::new(rows, radii.entries()).map_err(raised),
        ref shape => Err(invalid("radii", format!("its shape is {shape:?}, not [k, k]"))),
    }
}

/// The matrix of Wei's cross radii for classes of these own radii.
///
/// own: float64, shape (k,), 1 to 16 positive numbers.
/// factor: of the cross radii; smaller ones let classes come nearer to each other, 0 makes them independent.
///
/// Returns float64, shape (k, k).
#[pyfunction]
#[pyo3(signature = (own, factor=1.0))]
pub(crate) fn classes_radii(
    py: Python<'_>,
    own: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = real::factor)] factor: f64,
) -> PyResult<Py<PyArray2<f64>>> {
    use numpy::PyArrayMethods;
    let classes = Classes::of_radii(Array::read("own", own)?.line()?, factor)
        .map_err(|error| raised_as(error, "count", "own"))?;
    let count = classes.count();
    Ok(line(py, classes.radii().to_vec()).bind(py).reshape([count, count])?.unbind())
}
