//! Sets on meshes that grow, call by call, and are edited.

use std::sync::{RwLock, TryLockError};

use azulejo_core::psp;
use azulejo_core::{Context, Error, Progress};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::argument::{callable, maybe_real, maybe_triple, natural, real, whole};
use crate::array::{Array, GivenArrays};
use crate::edit::{counted, region};
use crate::frame::relative;
use crate::mesh::Mesh;
use crate::points::Points;
use crate::psp::{PspReport, priority, projectors};
use crate::taken;
use crate::watch::{Watch, unlocked};

/// A set of samples on a mesh that grows, call by call: psp_sample makes one and fills it at once. One call at a time may
/// change it; another one, from another thread or from progress, raises RuntimeError.
///
/// mesh, radius, seed, projectors, priority, given_positions, given_clearances, cosine: as in psp_sample. The set is empty
/// at first.
#[pyclass(frozen, module = "azulejo")]
pub(crate) struct Psp {
    /// Of the mesh.
    origin: [f64; 3],
    state: RwLock<State>,
}

/// A set that grows, until its first edit.
enum State {
    Growing(psp::Psp),
    Edited(psp::EditableSet),
    /// While one becomes the other.
    Between,
}

impl State {
    /// The set, to be edited.
    fn editable(&mut self) -> &mut psp::EditableSet {
        *self = match std::mem::replace(self, Self::Between) {
            Self::Growing(psp) => Self::Edited(psp.into_editable()),
            other => other,
        };
        match self {
            Self::Edited(set) => set,
            _ => unreachable!("a panic between the two poisons the lock"),
        }
    }

    fn len(&self) -> usize {
        match self {
            Self::Growing(psp) => psp.len(),
            Self::Edited(set) => set.len(),
            Self::Between => unreachable!("a panic between the two poisons the lock"),
        }
    }

    fn samples(&self) -> azulejo_core::Points<3> {
        match self {
            Self::Growing(psp) => psp.samples(),
            Self::Edited(set) => set.samples(),
            Self::Between => unreachable!("a panic between the two poisons the lock"),
        }
    }
}

impl Psp {
    fn change(
        &self,
        watch: Watch,
        step: impl FnOnce(&mut State, &Context, Option<&Progress>) -> Result<psp::Report, Error> + Send,
    ) -> PyResult<PspReport> {
        let mut state = self.state.try_write().map_err(|error| locked(&error))?;
        let state = &mut *state;
        Ok(watch.run(|context, progress| step(state, context, progress))?.into())
    }

    /// Makes an edit without the interpreter's lock.
    fn edit<T: Send>(
        &self,
        py: Python<'_>,
        step: impl FnOnce(&mut psp::EditableSet) -> Result<T, Error> + Send,
    ) -> PyResult<T> {
        let mut state = self.state.try_write().map_err(|error| locked(&error))?;
        let state = &mut *state;
        unlocked(py, || step(state.editable()))
    }

    /// Samples of an edit, with their ids.
    fn edited(&self, py: Python<'_>, mut samples: azulejo_core::Points<3>) -> PyResult<Points> {
        let ids = std::mem::take(&mut samples.ids);
        Ok(Points::surface(py, samples, self.origin)?.with_ids(py, ids))
    }
}

pub(crate) fn locked<T>(error: &TryLockError<T>) -> PyErr {
    PyRuntimeError::new_err(match error {
        TryLockError::WouldBlock => "the set is in use by another call",
        TryLockError::Poisoned(_) => "an internal error broke the set",
    })
}

#[pymethods]
impl Psp {
    #[new]
    #[pyo3(signature = (
        mesh, radius, *, seed=0, projectors="local", priority="squareness", given_positions=None,
        given_clearances=None, cosine=None
    ))]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = taken::mesh)] mesh: Mesh,
        #[pyo3(from_py_with = real::radius)] radius: f64,
        #[pyo3(from_py_with = whole::seed)] seed: i128,
        projectors: &str,
        priority: &str,
        given_positions: Option<&Bound<'_, PyAny>>,
        given_clearances: Option<&Bound<'_, PyAny>>,
        #[pyo3(from_py_with = maybe_real::cosine)] cosine: Option<f64>,
    ) -> PyResult<Self> {
        let origin = mesh.shared.origin();
        let given = GivenArrays::read(given_positions, given_clearances, origin)?;
        let request = psp::ProjectionOptions::new(radius)
            .seed(natural("seed", seed)?)
            .projectors(self::projectors(projectors)?)
            .priority(self::priority(priority)?)
            .given(given.samples()?)
            .cosine(cosine.unwrap_or(-1.0));
        let set = unlocked(py, || psp::Psp::new(&mesh.shared, &request))?;
        Ok(Self { origin, state: RwLock::new(State::Growing(set)) })
    }

    /// Adds samples by iterations of projection, each with other projectors. Two calls add
    /// what one with the sum of their iterations adds. Refused with a cosine above -1.
    ///
    /// None are made by global projectors where the box of the mesh is out of all proportion to its surface.
    /// threads, progress: as in psp_sample. After Cancelled the set holds what was finished, and can still grow.
    ///
    /// Returns a PspReport of this call.
    #[pyo3(signature = (iterations, *, threads=0, progress=None))]
    fn advance(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = whole::iterations)] iterations: i128,
        #[pyo3(from_py_with = whole::threads)] threads: i128,
        #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
    ) -> PyResult<PspReport> {
        let iterations = natural("iterations", iterations)?;
        let watch = Watch::new(py, threads, progress)?;
        self.change(watch, |state, context, progress| match state {
            State::Growing(set) => set.advance(context, iterations, progress),
            _ => Err(Error::InvalidArgument {
                argument: "iterations",
                reason: "of a set that has been edited, which makes no more".to_owned(),
            }),
        })
    }

    /// Adds samples until the set is maximal.
    ///
    /// threads, progress: as in advance().
    ///
    /// Returns a PspReport of this call.
    #[pyo3(signature = (*, threads=0, progress=None))]
    fn fill(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = whole::threads)] threads: i128,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<PspReport> {
        self.change(Watch::new(py, threads, progress)?, |state, context, progress| match state {
            State::Growing(set) => set.fill(context, progress),
            _ => {
                let set = state.editable();
                set.refill(context, set.seed(), progress).map(|(_, report)| report)
            }
        })
    }

    fn __len__(&self) -> PyResult<usize> {
        Ok(self.state.try_read().map_err(|error| locked(&error))?.len())
    }

    fn __repr__(&self) -> String {
        format!("<azulejo.Psp: {} on a mesh>", counted(self.__len__().ok()))
    }

    /// A copy of the set as it is, as Points, in the order in which samples were accepted; of a set that has been edited
    /// by rising ids.
    fn points(&self, py: Python<'_>) -> PyResult<Points> {
        let state = self.state.try_read().map_err(|error| locked(&error))?;
        let state = &*state;
        let samples = py.detach(|| state.samples());
        if matches!(state, State::Edited(_)) {
            self.edited(py, samples)
        } else {
            Points::surface(py, samples, self.origin)
        }
    }

    /// Erases the samples in a ball, a box, or what both have in common, and returns them as Points with ids. From the
    /// first edit on the set makes no more iterations, and every sample has an id, 0, 1, 2 and so on for those that stand
    /// then: it keeps it, with all its bytes, until it is erased, and no other sample ever gets it.
    ///
    /// centre, radius: of the ball, three numbers and one; default: no ball.
    /// min, max: the corners of the box, three numbers each; default: no box. With neither all samples are erased.
    ///
    /// To undo a stroke of a brush, erase_ids() what refill() added, and restore() what this call erased. To redo it,
    /// erase the same region and refill with the same seed.
    #[pyo3(signature = (centre=None, radius=None, *, min=None, max=None))]
    fn erase(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = maybe_triple::centre)] centre: Option<[f64; 3]>,
        #[pyo3(from_py_with = maybe_real::radius)] radius: Option<f64>,
        #[pyo3(from_py_with = maybe_triple::min)] min: Option<[f64; 3]>,
        #[pyo3(from_py_with = maybe_triple::max)] max: Option<[f64; 3]>,
    ) -> PyResult<Points> {
        let local = |place: Option<_>| place.map(|place| relative(place, self.origin));
        let region = region(local(centre), radius, local(min), local(max))?;
        self.edited(py, self.edit(py, |set| set.erase(&region))?)
    }

    /// Erases samples by their ids, uint64, shape (n,), and returns them as Points.
    fn erase_ids(&self, py: Python<'_>, ids: &Bound<'_, PyAny>) -> PyResult<Points> {
        let ids = Array::<u64>::read("ids", ids)?;
        let ids = ids.line()?;
        self.edited(py, self.edit(py, |set| set.erase_ids(ids))?)
    }

    /// Puts Points back that an edit of this set erased, with their ids and all their bytes. Refused if one is too close
    /// to a sample or a given sample by now.
    fn restore(&self, py: Python<'_>, points: &Points) -> PyResult<()> {
        let points = points.samples(py)?;
        self.edit(py, |set| set.restore(&points))
    }

    /// Adds given samples, as in psp_sample, to those that the set was made with; samples that are too close to one are
    /// erased. Returns the id of the first of them, which the others follow, and the erased Points.
    #[pyo3(signature = (given_positions, given_clearances=None))]
    fn add_given(
        &self,
        py: Python<'_>,
        given_positions: &Bound<'_, PyAny>,
        given_clearances: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<(u64, Points)> {
        let given = GivenArrays::read(Some(given_positions), given_clearances, self.origin)?;
        let given = given.samples()?;
        let (first, erased) = self.edit(py, |set| set.add_given(given))?;
        Ok((first, self.edited(py, erased)?))
    }

    /// Removes given samples by their ids, uint64, shape (n,): 0, 1, 2 and so on for those that the set was made with.
    fn remove_given(&self, py: Python<'_>, ids: &Bound<'_, PyAny>) -> PyResult<()> {
        let ids = Array::<u64>::read("ids", ids)?;
        let ids = ids.line()?;
        self.edit(py, |set| set.remove_given(ids))
    }

    /// Makes the set maximal again after edits; looks only where they can have left gaps. What stands stays as it is.
    ///
    /// seed: 0 to 2**64 - 1. The same edits and seed add the same samples.
    /// threads, progress: as in advance(). After Cancelled nothing is added.
    ///
    /// Returns the new samples as Points with ids and the report PspReport.
    #[pyo3(signature = (seed=0, *, threads=0, progress=None))]
    fn refill(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = whole::seed)] seed: i128,
        #[pyo3(from_py_with = whole::threads)] threads: i128,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Points> {
        let seed = natural("seed", seed)?;
        let watch = Watch::new(py, threads, progress)?;
        let mut state = self.state.try_write().map_err(|error| locked(&error))?;
        let state = &mut *state;
        let (added, report) = watch.run(|context, progress| state.editable().refill(context, seed, progress))?;
        self.edited(py, added)?.with_report(py, PspReport::from(report))
    }
}
