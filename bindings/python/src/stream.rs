//! Planes that are passed on part by part.

use std::ops::ControlFlow;

use azulejo_core::kdrt::Plane;
use pyo3::prelude::*;

use crate::argument::{callable, called, maybe_pair, real, whole};
use crate::frame::{Frame, framed};
use crate::plane::Request;
use crate::watch::{Watch, ask, flow};

/// The share of the progress that the plane takes.
const PATTERN_SHARE: f64 = 0.05;

/// Makes the set of kdrt_sample and passes it on part by part, in its order, instead of keeping it: for sets of any size.
/// Memory is that of a few parts per thread.
///
/// visit: called with each part, float32, shape (n, 2): windows of at most about 50,000 samples, the same for any number
///     of threads. If it returns False the call raises Cancelled; what it raises passes through. Meanwhile other threads
///     make the next parts. A domain that is too small to be tiled is one part.
/// The others are those of kdrt_sample.
#[pyfunction]
#[pyo3(signature = (
    visit, radius, *, domain_min=None, domain_max=None, boundary="periodic", leaf_size=20.0, seed=0,
    given_positions=None, given_clearances=None, threads=0, progress=None
))]
pub(crate) fn kdrt_stream(
    py: Python<'_>,
    #[pyo3(from_py_with = called::visit)] visit: Py<PyAny>,
    #[pyo3(from_py_with = real::radius)] radius: f64,
    #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
    #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
    boundary: &str,
    #[pyo3(from_py_with = real::leaf_size)] leaf_size: f64,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    given_positions: Option<&Bound<'_, PyAny>>,
    given_clearances: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<()> {
    let frame = Frame::new(domain_min, domain_max, boundary)?;
    let given = (given_positions, given_clearances);
    let request = Request::new(&frame, leaf_size, seed, ("any", None, None), given)?;
    let request = request.by_radius(radius)?;
    let mut failed = None;
    let done = Watch::new(py, threads, progress)?.run(|context, progress| {
        let pass = |part: &[[f32; 2]]| {
            flow(Python::attach(|py| ask(py, &visit, framed(py, part.to_vec(), frame.origin)?)), &mut failed)
        };
        let part = |from: f64, to: f64| {
            move |done: f64| progress.map_or(ControlFlow::Continue(()), |tell| tell(from + (to - from) * done))
        };
        let plane = Plane::new(context, &request, Some(&part(0.0, PATTERN_SHARE)))?;
        plane.stream(context, pass, Some(&part(PATTERN_SHARE, 1.0)))
    });
    failed.map_or(done, Err)
}
