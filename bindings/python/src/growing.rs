//! Sets on meshes that grow, call by call.

use std::sync::{RwLock, TryLockError};

use azulejo_core::psp;
use azulejo_core::{Context, Error, Progress};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::argument::natural;
use crate::array::GivenArrays;
use crate::error::raised;
use crate::mesh::Mesh;
use crate::points::Points;
use crate::psp::{PspReport, priority};
use crate::watch::Watch;

/// A set of samples on a mesh that grows, call by call: psp_sample makes one and fills it at once. One call at a time may
/// change it; another one, from another thread or from progress, raises RuntimeError.
///
/// mesh, radius, seed, priority, given_positions, given_clearances, cosine: as in psp_sample. The set is empty at first.
#[pyclass(frozen, module = "azulejo")]
pub(crate) struct Psp {
    state: RwLock<psp::Psp>,
}

impl Psp {
    fn change(
        &self,
        watch: Watch,
        step: impl FnOnce(&mut psp::Psp, &Context, Option<&Progress>) -> Result<psp::Report, Error> + Send,
    ) -> PyResult<PspReport> {
        let mut state = self.state.try_write().map_err(|error| locked(&error))?;
        let state = &mut *state;
        Ok(watch.run(|context, progress| step(state, context, progress))?.into())
    }
}

fn locked<T>(error: &TryLockError<T>) -> PyErr {
    PyRuntimeError::new_err(match error {
        TryLockError::WouldBlock => "the set is in use by another call",
        TryLockError::Poisoned(_) => "an internal error broke the set",
    })
}

#[pymethods]
impl Psp {
    #[new]
    #[pyo3(signature = (
        mesh, radius, *, seed=0, priority="squareness", given_positions=None, given_clearances=None, cosine=-1.0
    ))]
    fn new(
        py: Python<'_>,
        mesh: &Mesh,
        radius: f64,
        seed: i128,
        priority: &str,
        given_positions: Option<&Bound<'_, PyAny>>,
        given_clearances: Option<&Bound<'_, PyAny>>,
        cosine: f64,
    ) -> PyResult<Self> {
        let given = GivenArrays::read(given_positions, given_clearances)?;
        let request = psp::ProjectionOptions::new(radius)
            .seed(natural("seed", seed)?)
            .priority(self::priority(priority)?)
            .given(given.samples()?)
            .cosine(cosine);
        let set = py.detach(|| psp::Psp::new(&mesh.shared, &request)).map_err(raised)?;
        Ok(Self { state: RwLock::new(set) })
    }

    /// Adds samples by iterations of projection, each along three orthogonal directions of a random frame. Two calls add
    /// what one with the sum of their iterations adds. Refused with a cosine above -1.
    ///
    /// None are made where the box of the mesh is out of all proportion to its surface.
    /// threads, progress: as in psp_sample. After Cancelled the set holds what was finished, and can still grow.
    ///
    /// Returns a PspReport of this call.
    #[pyo3(signature = (iterations, *, threads=0, progress=None))]
    fn advance(
        &self,
        py: Python<'_>,
        iterations: i128,
        threads: i128,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<PspReport> {
        let iterations = natural("iterations", iterations)?;
        let watch = Watch::new(py, threads, progress)?;
        self.change(watch, |set, context, progress| set.advance(context, iterations, progress))
    }

    /// Adds samples until the set is maximal.
    ///
    /// threads, progress: as in advance().
    ///
    /// Returns a PspReport of this call.
    #[pyo3(signature = (*, threads=0, progress=None))]
    fn fill(&self, py: Python<'_>, threads: i128, progress: Option<Py<PyAny>>) -> PyResult<PspReport> {
        self.change(Watch::new(py, threads, progress)?, psp::Psp::fill)
    }

    /// A copy of the set as it is, as Points, in the order in which samples were accepted.
    fn points(&self, py: Python<'_>) -> PyResult<Points> {
        let state = self.state.try_read().map_err(|error| locked(&error))?;
        let state = &*state;
        Points::surface(py, py.detach(|| state.samples()))
    }
}
