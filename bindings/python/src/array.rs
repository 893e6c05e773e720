//! numpy arrays in and out.

use azulejo_core::Given;
use numpy::{
    Element, PyArray1, PyArray2, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods, dtype,
};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::IntoPyDict;

use crate::error::invalid;
use crate::frame::{Positions, Rows};

/// Imports numpy. Left to the first array, its absence or Ctrl-C during the import would be a panic.
pub(crate) fn load(py: Python<'_>) -> PyResult<()> {
    py.import("numpy")?;
    // The crate looks up numpy's functions at the first array, and its own book of borrowed arrays at the first one
    // read.
    PyArray1::<f32>::zeros(py, 0, false).try_readonly()?;
    Ok(())
}

/// A type of entries, and what is converted to it.
pub(crate) trait Entry: Element + Copy {
    /// The kinds of numpy's types.
    const KINDS: &str;
    /// The name of the elements in messages.
    const WHAT: &str;
    /// The largest entry, where whole numbers are converted; the smallest is 0.
    const MOST: Option<u64> = None;
}

impl Entry for f32 {
    const KINDS: &str = "fiu";
    const WHAT: &str = "real numbers";
}

impl Entry for f64 {
    const KINDS: &str = "fiu";
    const WHAT: &str = "real numbers";
}

impl Entry for u8 {
    const KINDS: &str = "u";
    const WHAT: &str = "bytes";
    const MOST: Option<u64> = Some(u8::MAX as u64);
}

impl Entry for u32 {
    const KINDS: &str = "iu";
    const WHAT: &str = "whole numbers";
    const MOST: Option<u64> = Some(u32::MAX as u64);
}

impl Entry for u64 {
    const KINDS: &str = "iu";
    const WHAT: &str = "whole numbers";
    const MOST: Option<u64> = Some(u64::MAX);
}

impl Entry for bool {
    const KINDS: &str = "b";
    const WHAT: &str = "True and False";
}

/// An argument that is an array: read in place if it is aligned, C-contiguous and of the right type, a copy otherwise.
/// Arrays must not be changed during the call, which runs without the interpreter's lock.
pub(crate) struct Array<'py, T: Entry> {
    argument: &'static str,
    array: PyReadonlyArrayDyn<'py, T>,
}

impl<'py, T: Entry> Array<'py, T> {
    pub(crate) fn read(argument: &'static str, object: &Bound<'py, PyAny>) -> PyResult<Self> {
        let array = match object.cast::<PyArrayDyn<T>>() {
            Ok(array) if array.is_c_contiguous() && array.is_aligned() => array.clone(),
            _ => converted(argument, object)?,
        };
        Ok(Self { argument, array: array.try_readonly().map_err(|error| invalid(argument, error))? })
    }

    /// All entries, row by row.
    pub(crate) fn entries(&self) -> &[T] {
        self.array.as_slice().expect("the array is contiguous")
    }

    pub(crate) fn shape(&self) -> &[usize] {
        self.array.shape()
    }

    /// An array of n entries.
    pub(crate) fn line(&self) -> PyResult<&[T]> {
        match self.shape() {
            [_] => Ok(self.entries()),
            shape => Err(invalid(self.argument, format!("its shape is {shape:?}, not [n]"))),
        }
    }

    /// An image of height rows, as its pixels, width and height.
    pub(crate) fn image(&self) -> PyResult<(&[T], [usize; 2])> {
        match *self.shape() {
            [height, width] if height > 0 && width > 0 => Ok((self.entries(), [width, height])),
            ref shape => {
                Err(invalid(self.argument, format!("its shape is {shape:?}, not [height, width] with both above 0")))
            }
        }
    }

    /// A grid of layers of rows, as its entries and their numbers along x, y and z.
    pub(crate) fn grid(&self) -> PyResult<(&[T], [usize; 3])> {
        match *self.shape() {
            [z, y, x] if x > 0 && y > 0 && z > 0 => Ok((self.entries(), [x, y, z])),
            ref shape => Err(invalid(self.argument, format!("its shape is {shape:?}, not [z, y, x] with all above 0"))),
        }
    }

    /// An array of n rows of `N`; an empty list is one without rows.
    pub(crate) fn rows<const N: usize>(&self) -> PyResult<&[[T; N]]> {
        match self.shape() {
            [_, columns] if *columns == N => Ok(self.entries().as_chunks().0),
            [0] => Ok(&[]),
            shape => Err(invalid(self.argument, format!("its shape is {shape:?}, not [n, {N}]"))),
        }
    }
}

/// The array that numpy makes of an object.
pub(crate) fn as_array<'py>(argument: &str, object: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let py = object.py();
    if object.is_none() {
        return Err(PyTypeError::new_err(format!("{argument}: None is no array")));
    }
    let numpy = py.import("numpy")?;
    let made = |name, object: &Bound<'py, PyAny>| {
        numpy.call_method1(name, (object,)).map_err(|error| invalid(argument, error.value(py)))
    };
    if object.hasattr("__array__")? || !object.hasattr("__dlpack__")? {
        return made("asarray", object);
    }
    made("from_dlpack", object)
}

/// The result of `__array__` of an object that stands for an array.
pub(crate) fn standing_for<'py>(
    array: &Bound<'py, PyAny>,
    dtype: Option<Bound<'py, PyAny>>,
    copy: Option<bool>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = array.py();
    let numpy = py.import("numpy")?;
    match copy {
        None => numpy.call_method1("asarray", (array, dtype)),
        Some(copy) => numpy.call_method("array", (array, dtype), Some(&[("copy", copy)].into_py_dict(py)?)),
    }
}

fn converted<'py, T: Entry>(argument: &str, object: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    let py = object.py();
    let array = as_array(argument, object)?;
    let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
    if array.getattr("size")?.extract::<usize>()? > 0 {
        if !T::KINDS.contains(&kind) {
            let reason = format!("{argument}: its type is {}, not {}", array.getattr("dtype")?, T::WHAT);
            return Err(PyTypeError::new_err(reason));
        }
        if let Some(most) = T::MOST {
            for end in ["min", "max"] {
                let entry: i128 = array.call_method0(end)?.extract()?;
                if !(0..=most.into()).contains(&entry) {
                    return Err(invalid(argument, format!("{entry} is not in 0 to {most}")));
                }
            }
        }
    }
    let options = [("order", "C")].into_py_dict(py)?;
    Ok(array.call_method("astype", (dtype::<T>(py),), Some(&options))?.cast_into()?)
}

/// An argument that may be None.
pub(crate) fn optional<'py, T: Entry>(
    argument: &'static str,
    object: Option<&Bound<'py, PyAny>>,
) -> PyResult<Option<Array<'py, T>>> {
    object.map(|object| Array::read(argument, object)).transpose()
}

/// The arguments `given_positions` and `given_clearances`.
pub(crate) struct GivenArrays<'py, const N: usize> {
    positions: Option<Rows<'py, N>>,
    clearances: Option<Array<'py, f64>>,
}

impl<'py, const N: usize> GivenArrays<'py, N> {
    /// Positions in the caller's frame, in which the library has this origin.
    pub(crate) fn read(
        positions: Option<&Bound<'py, PyAny>>,
        clearances: Option<&Bound<'py, PyAny>>,
        origin: [f64; N],
    ) -> PyResult<Self> {
        let around = |positions| Positions::read("given_positions", positions)?.around(origin);
        Ok(Self {
            positions: positions.map(around).transpose()?,
            clearances: optional("given_clearances", clearances)?,
        })
    }

    /// The clearances are n numbers or, where there are classes, n rows of one for each class.
    pub(crate) fn samples(&self) -> PyResult<Given<'_, N>> {
        let positions = self.positions.as_ref().map_or(Ok([].as_slice()), Rows::get)?;
        if let Some(clearances) = &self.clearances
            && clearances.shape().first() != Some(&positions.len())
        {
            let reason = format!("its shape is {:?}, but {} samples are given", clearances.shape(), positions.len());
            return Err(invalid("given_clearances", reason));
        }
        Ok(Given { positions, clearances: self.clearances.as_ref().map(Array::entries) })
    }
}

/// A new array of n rows, which takes over the memory.
pub(crate) fn table<T: Element, const N: usize>(py: Python<'_>, rows: Vec<[T; N]>) -> PyResult<Py<PyArray2<T>>> {
    let shape = [rows.len(), N];
    Ok(PyArray1::from_vec(py, rows.into_flattened()).reshape(shape)?.unbind())
}

/// A new array of n entries, which takes over the memory.
pub(crate) fn line<T: Element>(py: Python<'_>, entries: Vec<T>) -> Py<PyArray1<T>> {
    PyArray1::from_vec(py, entries).unbind()
}

/// [`line()`], or None where the library leaves an array empty because it does not apply.
pub(crate) fn line_if_any<T: Element>(py: Python<'_>, entries: Vec<T>) -> Option<Py<PyArray1<T>>> {
    (!entries.is_empty()).then(|| line(py, entries))
}
