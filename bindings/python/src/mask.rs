//! Blue-noise masks.

use azulejo_core::mask::{self, Options};
use numpy::{PyArray1, PyArrayDyn, PyArrayMethods};
use pyo3::prelude::*;

use crate::argument::{callable, natural, real, whole};
use crate::watch::Watch;

/// A blue-noise mask by void and cluster (Ulichney 1993): each pixel of a torus has a rank, and the pixels below any rank are
/// spread evenly and without a pattern. An image is dithered by comparing it with the mask, repeated like a tile:
/// `image > (ranks + 0.5) / ranks.size`.
///
/// width, height: the pixels along x and y, 2 to 1024, and up to 64 with a depth above 1.
/// depth: 1 for a mask of the plane; up to 64 for one of space, whose slices are not masks of the plane.
/// channels: the number of independent masks, 1 to 64. One does not depend on the others.
/// seed: 0 to 2**64 - 1. The same arguments and seed give the same bytes.
/// sigma: the standard deviation, in pixels, of the Gaussian by which voids and clusters are found, 0.5 to 4.
/// threads: 0 for one per core; they share the channels. The mask does not depend on it.
/// progress: called with the fraction that is done, from 0 to 1; if it returns False the call raises Cancelled.
///
/// Returns the ranks, uint32: shape (height, width), with an axis of the depth before it if that is above 1, and one of the
/// channels before all if there are several. Each rank from 0 to the number of pixels - 1 occurs once in a channel.
#[pyfunction]
#[pyo3(signature = (width, height, *, depth=1, channels=1, seed=0, sigma=1.5, threads=0, progress=None))]
pub(crate) fn mask_create(
    py: Python<'_>,
    #[pyo3(from_py_with = whole::width)] width: i128,
    #[pyo3(from_py_with = whole::height)] height: i128,
    #[pyo3(from_py_with = whole::depth)] depth: i128,
    #[pyo3(from_py_with = whole::channels)] channels: i128,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    #[pyo3(from_py_with = real::sigma)] sigma: f64,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Py<PyArrayDyn<u32>>> {
    let options = Options::new(natural("width", width)?, natural("height", height)?)
        .depth(natural("depth", depth)?)
        .channels(natural("channels", channels)?)
        .seed(natural("seed", seed)?)
        .sigma(sigma);
    let (mask, _) =
        Watch::new(py, threads, progress)?.run(|context, progress| mask::create(context, &options, progress))?;
    let [width, height, depth] = mask.size;
    let outer = [mask.channels, depth].into_iter().filter(|&length| length > 1);
    let shape: Vec<usize> = outer.chain([height, width]).collect();
    Ok(PyArray1::from_vec(py, mask.ranks).reshape(shape)?.unbind())
}
