//! Maximal sets of several classes on meshes.

use azulejo_core::psp::adaptive::Radius;
use azulejo_core::psp::{self, DEFAULT_QUOTIENT};
use azulejo_core::{Classes, Order};
use pyo3::prelude::*;

use crate::adaptive::MeshDensity;
use crate::argument::{amount, callable, maybe_real, natural, order, whole};
use crate::array::{Array, GivenArrays, optional};
use crate::classes::matrix;
use crate::mesh::Mesh;
use crate::points::Points;
use crate::psp::PspReport;
use crate::taken;
use crate::watch::Watch;

/// The arguments that both calls share.
struct InClasses<'py> {
    classes: Classes,
    masks: Option<Array<'py, u32>>,
    order: Order,
    quotient: Option<f64>,
    seed: u64,
    given: GivenArrays<'py, 3>,
    cosine: Option<f64>,
}

impl<'py> InClasses<'py> {
    fn read(
        mesh: &Mesh,
        radii: &Bound<'py, PyAny>,
        masks: Option<&Bound<'py, PyAny>>,
        (order_name, quotient): (&str, Option<f64>),
        seed: i128,
        (given_positions, given_clearances): (Option<&Bound<'py, PyAny>>, Option<&Bound<'py, PyAny>>),
        cosine: Option<f64>,
    ) -> PyResult<Self> {
        Ok(Self {
            classes: matrix(radii)?,
            masks: optional("masks", masks)?,
            order: order(order_name, &[("quotient", quotient)])?,
            quotient,
            seed: natural("seed", seed)?,
            given: GivenArrays::read(given_positions, given_clearances, mesh.shared.origin())?,
            cosine,
        })
    }

    /// The samples; where a radius is the unit of those of the classes, with this radius at each.
    fn sample(self, watch: Watch, mesh: &Mesh, unit: Option<Radius>) -> PyResult<Points> {
        let py = watch.py();
        let masks = self.masks.as_ref().map(Array::line).transpose()?;
        let request = psp::ClassOptions::default()
            .order(self.order)
            .quotient(self.quotient.unwrap_or(DEFAULT_QUOTIENT))
            .seed(self.seed)
            .given(self.given.samples()?)
            .cosine(self.cosine.unwrap_or(-1.0))
            .unit(unit);
        let (mut samples, report) = watch.run(|context, progress| {
            psp::sample_classes(context, &mesh.shared, &request, &self.classes, masks, progress)
        })?;
        let (classes, origin) = (std::mem::take(&mut samples.classes), mesh.shared.origin());
        let points = match unit {
            None => Points::surface(py, samples, origin),
            Some(_) => Points::adaptive(py, samples, origin),
        }?;
        points.with_classes(py, classes).with_report(py, PspReport::from(report))
    }
}

/// A maximal set of several classes on a mesh: samples of the classes i and j are at least radii[i][j] apart, and for each
/// class i every place is within radii[i][j] of some sample of some class j.
///
/// radii: symmetric, float64, shape (k, k) with k from 1 to 16; classes_radii() makes such matrices.
/// masks: uint32, shape (t,): of each triangle the classes that it takes, bit i for class i; default: all.
/// given_clearances: float64, shape (m, k). The others are those of psp_sample.
///
/// order: in progressive order each class is sorted coarse to fine, and the points have ranks.
///
/// Returns Points with classes and the report PspReport.
#[pyfunction]
#[pyo3(signature = (
    mesh, radii, *, masks=None, order="any", quotient=None, seed=0, given_positions=None, given_clearances=None,
    cosine=None, threads=0, progress=None
))]
pub(crate) fn psp_sample_classes(
    py: Python<'_>,
    #[pyo3(from_py_with = taken::mesh)] mesh: Mesh,
    radii: &Bound<'_, PyAny>,
    masks: Option<&Bound<'_, PyAny>>,
    order: &str,
    #[pyo3(from_py_with = maybe_real::quotient)] quotient: Option<f64>,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    given_positions: Option<&Bound<'_, PyAny>>,
    given_clearances: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = maybe_real::cosine)] cosine: Option<f64>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let given = (given_positions, given_clearances);
    let request = InClasses::read(&mesh, radii, masks, (order, quotient), seed, given, cosine)?;
    request.sample(Watch::new(py, threads, progress)?, &mesh, None)
}

/// A maximal set of several classes on a mesh whose density varies: the radii of the classes are multiples of a local radius,
/// which follows from the density as in psp_adaptive_with_density. Samples of the classes i and j are at least radii[i][j]
/// times the mean of their local radii apart. So all classes follow the density, with the shares that they have without one.
///
/// radii: as in psp_sample_classes; with radius=1 those at density 1.
/// density, texture: as in psp_adaptive_with_density.
/// radius: the local radius at density 1. Or:
/// count: about how many samples a class of radius 1 would have by itself.
/// given_clearances: float64, shape (m, k), lengths in the units of the mesh, needed where samples are given.
/// The others are those of psp_sample_classes.
///
/// order: in progressive order ranks, over the own radius of the class, are what all local radii are multiplied by.
///
/// Returns Points with classes, the local radii as radii, and the report PspReport.
#[pyfunction]
#[pyo3(signature = (
    mesh, radii, density, *, radius=0.0, count=0.0, texture=None, masks=None, order="any", quotient=None, seed=0,
    given_positions=None, given_clearances=None, cosine=None, threads=0, progress=None
))]
pub(crate) fn psp_classes_with_density(
    py: Python<'_>,
    #[pyo3(from_py_with = taken::mesh)] mesh: Mesh,
    radii: &Bound<'_, PyAny>,
    density: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = amount::radius)] radius: f64,
    #[pyo3(from_py_with = amount::count)] count: f64,
    texture: Option<&Bound<'_, PyAny>>,
    masks: Option<&Bound<'_, PyAny>>,
    order: &str,
    #[pyo3(from_py_with = maybe_real::quotient)] quotient: Option<f64>,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    given_positions: Option<&Bound<'_, PyAny>>,
    given_clearances: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = maybe_real::cosine)] cosine: Option<f64>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let density = MeshDensity::read(density, texture, radius, count)?;
    let given = (given_positions, given_clearances);
    let request = InClasses::read(&mesh, radii, masks, (order, quotient), seed, given, cosine)?;
    request.sample(Watch::new(py, threads, progress)?, &mesh, Some(density.radius(&mesh)?))
}
