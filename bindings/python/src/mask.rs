//! Blue-noise masks.

use azulejo_core::mask::{self, Image, Mask, Options, Pixels};
use numpy::{PyArray1, PyArrayDyn, PyArrayMethods};
use pyo3::prelude::*;

use crate::argument::{callable, natural, real, whole};
use crate::array::{Array, as_array};
use crate::error::{invalid, raised};
use crate::watch::Watch;

/// A blue-noise mask by void and cluster (Ulichney 1993): each pixel of a torus has a rank, and the pixels below any rank are
/// spread evenly and without a pattern. mask_dither makes halftones with it.
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

/// An image in few levels, by ordered dithering. A number v becomes one of the levels beside v * (levels - 1), the upper one
/// where the fraction exceeds 1 - t, t being (rank + 0.5) / pixels. The mask is repeated over the image, and its channels over
/// those of the image. Light adds up only where numbers are linear, which those of sRGB are not.
///
/// ranks: what mask_create returns.
/// image: shape (height, width), or with an axis of the channels behind them; for a mask of space with one of the depth before.
///     Bytes (uint8) from 0 to 255, or numbers, of which 0 to 1 count.
/// levels: 2 to 256.
///
/// Returns the level of each number of the image, uint8, 0 to levels - 1, in the shape of the image.
#[pyfunction]
#[pyo3(signature = (ranks, image, levels=2))]
pub(crate) fn mask_dither(
    py: Python<'_>,
    ranks: &Bound<'_, PyAny>,
    image: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = whole::levels)] levels: i128,
) -> PyResult<Py<PyArrayDyn<u8>>> {
    let mask = mask_of(&Array::read("ranks", ranks)?)?;
    let levels = natural("levels", levels)?;
    let image = as_array("image", image)?;
    let dither = |shape: &[usize], pixels: Pixels| -> PyResult<Py<PyArrayDyn<u8>>> {
        let (size, channels) = match *shape {
            [height, width] if mask.size[2] == 1 => ([width, height, 1], 1),
            [height, width, channels] if mask.size[2] == 1 => ([width, height, 1], channels),
            [depth, height, width] => ([width, height, depth], 1),
            [depth, height, width, channels] if mask.size[2] > 1 => ([width, height, depth], channels),
            _ => {
                let axes = if mask.size[2] == 1 { "[height, width]" } else { "[depth, height, width]" };
                return Err(invalid(
                    "image",
                    format!("its shape is {shape:?}, not {axes}, and channels if there are some"),
                ));
            }
        };
        let out = py.detach(|| mask.dither(&Image { size, channels, pixels }, levels)).map_err(raised)?;
        Ok(PyArray1::from_vec(py, out).reshape(shape)?.unbind())
    };
    if image.cast::<PyArrayDyn<u8>>().is_ok() {
        let bytes = Array::read("image", &image)?;
        dither(bytes.shape(), Pixels::Bytes(bytes.entries()))
    } else {
        let floats = Array::read("image", &image)?;
        dither(floats.shape(), Pixels::Floats(floats.entries()))
    }
}

/// The mask of these ranks. Of three axes the first is that of the channels if the ranks are those of the other two, or else
/// that of the depth.
fn mask_of(ranks: &Array<u32>) -> PyResult<Mask> {
    let most = ranks.entries().iter().max().map_or(0, |&rank| rank as usize + 1);
    let (size, channels) = match *ranks.shape() {
        [height, width] => ([width, height, 1], 1),
        [channels, height, width] if most == height * width => ([width, height, 1], channels),
        [depth, height, width] => ([width, height, depth], 1),
        [channels, depth, height, width] => ([width, height, depth], channels),
        ref shape => return Err(invalid("ranks", format!("their shape is {shape:?}, not that of a mask"))),
    };
    if most == 0 || most != size.iter().product::<usize>() {
        return Err(invalid("ranks", format!("the largest is not the number of pixels of {size:?} - 1")));
    }
    Mask::from_ranks(size, channels, ranks.entries().to_vec()).map_err(raised)
}
