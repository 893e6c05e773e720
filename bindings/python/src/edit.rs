//! Sets of the plane that are edited.

use std::sync::RwLock;

use azulejo_core::kdrt::EditableSet;
use azulejo_core::{Error, Region};
use pyo3::prelude::*;

use crate::argument::{callable, maybe_pair, maybe_real, natural, real, whole};
use crate::array::{Array, GivenArrays};
use crate::error::invalid;
use crate::frame::{Frame, Positions, Rows};
use crate::growing::locked;
use crate::plane::Request;
use crate::points::{Place, Points};
use crate::watch::{Watch, unlocked};

/// A set of the plane that is edited. One call at a time may change it; another one, from another thread or from
/// progress, raises RuntimeError.
///
/// radius, domain_min, domain_max, boundary, leaf_size, seed, given_positions, given_clearances: as in kdrt_sample, whose
///     set it begins with. Or:
/// positions: float32, shape (n, 2): any set of the domain, in which no two are closer than the radius. The first refill
///     looks for gaps everywhere.
///
/// Every sample has an id, at first 0, 1, 2 and so on: it keeps it, with all its bytes, until it is erased, and no other
/// sample ever gets it.
#[pyclass(frozen, module = "azulejo")]
pub(crate) struct Plane {
    set: RwLock<EditableSet>,
    frame: Frame,
}

impl Plane {
    /// Makes an edit without the interpreter's lock.
    fn edit<T: Send>(
        &self,
        py: Python<'_>,
        step: impl FnOnce(&mut EditableSet) -> Result<T, Error> + Send,
    ) -> PyResult<T> {
        let mut set = self.set.try_write().map_err(|error| locked(&error))?;
        let set = &mut *set;
        unlocked(py, || step(set))
    }

    /// Samples of an edit, with their ids.
    fn edited(&self, py: Python<'_>, mut samples: azulejo_core::Points<2>) -> PyResult<Points> {
        let ids = std::mem::take(&mut samples.ids);
        Ok(Points::plane(py, samples, &self.frame)?.with_ids(py, ids))
    }
}

/// The number of samples of a set as text; that of one which another call changes is not known.
pub(crate) fn counted(samples: Option<usize>) -> String {
    samples.map_or_else(|| "in use".to_owned(), |samples| samples.to_string())
}

/// The region of a ball and a box, of which either may be missing; in the plane at height 0.
pub(crate) fn region<const N: usize>(
    centre: Option<[f64; N]>,
    radius: Option<f64>,
    min: Option<[f64; N]>,
    max: Option<[f64; N]>,
) -> PyResult<Region> {
    let mut region = Region::EVERYWHERE;
    match (centre, radius) {
        (Some(centre), Some(radius)) => {
            region.centre[..N].copy_from_slice(&centre);
            region.radius = radius;
        }
        (None, None) => (),
        (Some(_), None) => return Err(invalid("radius", "None, but there is a centre")),
        (None, Some(_)) => return Err(invalid("centre", "None, but there is a radius")),
    }
    if let Some(min) = min {
        region.min[..N].copy_from_slice(&min);
    }
    if let Some(max) = max {
        region.max[..N].copy_from_slice(&max);
    }
    Ok(region)
}

#[pymethods]
impl Plane {
    #[new]
    #[pyo3(signature = (
        radius, positions=None, *, domain_min=None, domain_max=None, boundary=None, leaf_size=20.0, seed=0,
        given_positions=None, given_clearances=None, threads=0, progress=None
    ))]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = real::radius)] radius: f64,
        positions: Option<&Bound<'_, PyAny>>,
        #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
        #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
        boundary: Option<&str>,
        #[pyo3(from_py_with = real::leaf_size)] leaf_size: f64,
        #[pyo3(from_py_with = whole::seed)] seed: i128,
        given_positions: Option<&Bound<'_, PyAny>>,
        given_clearances: Option<&Bound<'_, PyAny>>,
        #[pyo3(from_py_with = whole::threads)] threads: i128,
        #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let positions = positions.map(|positions| Positions::read("positions", positions)).transpose()?;
        let frame = match &positions {
            Some(positions) => Frame::around(positions, Place::plane, domain_min, domain_max, boundary)?,
            None => Frame::new(domain_min, domain_max, boundary.unwrap_or("periodic"))?,
        };
        let given = (given_positions, given_clearances);
        let request = Request::new(&frame, leaf_size, seed, ("any", None, None), given)?;
        let request = request.by_radius(radius)?;
        let watch = Watch::new(py, threads, progress)?;
        let positions = positions.map(|positions| positions.around(frame.origin)).transpose()?;
        let positions = positions.as_ref().map(Rows::get).transpose()?;
        let set = watch.run(|context, progress| match positions {
            None => EditableSet::sample(context, &request, progress),
            Some(positions) => EditableSet::of(&request, positions),
        })?;
        Ok(Self { set: RwLock::new(set), frame })
    }

    fn __len__(&self) -> PyResult<usize> {
        Ok(self.set.try_read().map_err(|error| locked(&error))?.len())
    }

    fn __repr__(&self) -> String {
        format!("<azulejo.Plane: {} in {}>", counted(self.__len__().ok()), self.frame.shown())
    }

    /// A copy of the set as it is, as Points, by rising ids.
    fn points(&self, py: Python<'_>) -> PyResult<Points> {
        let set = self.set.try_read().map_err(|error| locked(&error))?;
        let set = &*set;
        self.edited(py, py.detach(|| set.samples()))
    }

    /// Erases the samples in a disk, a rectangle, or what both have in common, and returns them as Points. On a torus both
    /// may reach over the seam.
    ///
    /// centre, radius: of the disk, two numbers and one; default: no disk.
    /// min, max: the corners of the rectangle, two numbers each; default: no rectangle. With neither all samples are
    ///     erased.
    ///
    /// To undo a stroke of a brush, erase_ids() what refill() added, and restore() what this call erased. To redo it,
    /// erase the same region and refill with the same seed.
    #[pyo3(signature = (centre=None, radius=None, *, min=None, max=None))]
    fn erase(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = maybe_pair::centre)] centre: Option<[f64; 2]>,
        #[pyo3(from_py_with = maybe_real::radius)] radius: Option<f64>,
        #[pyo3(from_py_with = maybe_pair::min)] min: Option<[f64; 2]>,
        #[pyo3(from_py_with = maybe_pair::max)] max: Option<[f64; 2]>,
    ) -> PyResult<Points> {
        let local = |place: Option<_>| place.map(|place| self.frame.local(place));
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

    /// Adds given samples, as in kdrt_sample, to those that the set was made with; samples that are too close to one are
    /// erased. Returns the id of the first of them, which the others follow, and the erased Points.
    #[pyo3(signature = (given_positions, given_clearances=None))]
    fn add_given(
        &self,
        py: Python<'_>,
        given_positions: &Bound<'_, PyAny>,
        given_clearances: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<(u64, Points)> {
        let given = GivenArrays::read(Some(given_positions), given_clearances, self.frame.origin)?;
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
    /// threads, progress: as in kdrt_sample. After Cancelled nothing is added.
    ///
    /// Returns the new samples as Points.
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
        let mut set = self.set.try_write().map_err(|error| locked(&error))?;
        let set = &mut *set;
        self.edited(py, watch.run(|context, progress| set.refill(context, seed, progress))?)
    }
}
