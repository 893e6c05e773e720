//! Maximal sets of cuboids.

use azulejo_core::volume::{self, ClassesOptions, Options};
use pyo3::prelude::*;

use crate::argument::{
    amount, amount_of, callable, maybe_real, maybe_triple, natural, number, one_of, order, real, whole,
};
use crate::array::GivenArrays;
use crate::classes::matrix;
use crate::frame::Frame;
use crate::points::Points;
use crate::report::report;
use crate::watch::Watch;

report! {
    /// The report of volume_sample.
    VolumeReport {
        /// No two samples are closer: the radius that was asked for or, for a count, the one that was found.
        radius: f64,
        /// No place of the cuboid is farther from all samples, and outside of all given ones: the radius, or for a count up to
        /// 1.1 times it; in progressive order the quotient times it.
        covering_radius: f64,
        /// Wall time in seconds.
        seconds: f64,
    }
}

impl From<volume::Report> for VolumeReport {
    fn from(report: volume::Report) -> Self {
        let volume::Report { radius, covering_radius, seconds, .. } = report;
        Self { radius, covering_radius, seconds }
    }
}

/// A maximal Poisson-disk set of a cuboid or torus in space: no two samples are closer than a radius, and no place is
/// farther from all of them. Time grows in proportion to the samples.
///
/// radius: the smallest distance of two samples, above 0, in the units of the domain. Or:
/// count: the number of samples, which is met exactly; the radius is found.
/// domain_min, domain_max: the corners of the cuboid, three numbers each; samples lie in min <= x < max. Default: the unit
///     cube. Positions are float32, or float64 in a domain that lies farther from the origin than 1024 times its size.
/// boundary: "periodic" (distances wrap around) or "bounded".
/// seed: 0 to 2**64 - 1. The same arguments and seed give the same bytes.
/// order: "any", or "progressive": every prefix is well spread, and the points have ranks.
/// quotient: of a progressive order: every prefix of 100 samples and more covers within this times its last rank, 1.02 to
///     1.5; default 2**(1/8).
/// given_positions: float32, shape (m, 3): samples that stay and are not returned.
/// given_clearances: float64, shape (m,): how far new samples are from each at least; default: the radius. Needed with a
///     count.
/// leaf_size: in radii, at least 6: the set is tiled by copies of a small one, which is faster with leaves of 20 radii and
///     more. Default 0: it is not. Neither with a count nor in progressive order.
/// threads: 0 for one per core. The samples do not depend on it.
/// progress: called with the fraction that is done, from 0 to 1; if it returns False the call raises Cancelled.
///
/// Returns Points with the report VolumeReport.
#[pyfunction]
#[pyo3(signature = (
    radius=0.0, *, count=0, domain_min=None, domain_max=None, boundary="periodic", seed=0, order="any", quotient=None,
    given_positions=None, given_clearances=None, leaf_size=0.0, threads=0, progress=None
))]
pub(crate) fn volume_sample(
    py: Python<'_>,
    #[pyo3(from_py_with = amount::radius)] radius: f64,
    #[pyo3(from_py_with = number::count)] count: i128,
    #[pyo3(from_py_with = maybe_triple::domain_min)] domain_min: Option<[f64; 3]>,
    #[pyo3(from_py_with = maybe_triple::domain_max)] domain_max: Option<[f64; 3]>,
    boundary: &str,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    order: &str,
    #[pyo3(from_py_with = maybe_real::quotient)] quotient: Option<f64>,
    given_positions: Option<&Bound<'_, PyAny>>,
    given_clearances: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = real::leaf_size)] leaf_size: f64,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let frame = Frame::new(domain_min, domain_max, boundary)?;
    one_of(radius, count, frame.domain.extent(), "domain")?;
    let given = GivenArrays::read(given_positions, given_clearances, frame.origin)?;
    let request = Options::of(amount_of(radius, count)?);
    let request = request
        .domain(frame.domain)
        .seed(natural("seed", seed)?)
        .order(self::order(order, &[("quotient", quotient)])?)
        .quotient(quotient.unwrap_or(request.quotient))
        .given(given.samples()?)
        .leaf_size(leaf_size);
    let (samples, report) =
        Watch::new(py, threads, progress)?.run(|context, progress| volume::sample(context, &request, progress))?;
    Points::cuboid(py, samples, &frame)?.with_report(py, VolumeReport::from(report))
}

/// Samples of several classes in a cuboid or torus in space: samples of classes i and j are at least radii[i, j] apart, and no
/// class can take another sample. Classes of larger own radii come first; those of equal ones get about equal shares.
///
/// radii: float64, shape (k, k), symmetric; see classes_radii.
/// given_clearances: float64, shape (m, k): one for each class; default: their own radii.
/// The others are those of volume_sample.
///
/// Returns Points with classes, sorted by class.
#[pyfunction]
#[pyo3(signature = (
    radii, *, domain_min=None, domain_max=None, boundary="periodic", seed=0, given_positions=None, given_clearances=None,
    threads=0, progress=None
))]
pub(crate) fn volume_sample_classes(
    py: Python<'_>,
    radii: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = maybe_triple::domain_min)] domain_min: Option<[f64; 3]>,
    #[pyo3(from_py_with = maybe_triple::domain_max)] domain_max: Option<[f64; 3]>,
    boundary: &str,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    given_positions: Option<&Bound<'_, PyAny>>,
    given_clearances: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let classes = matrix(radii)?;
    let frame = Frame::new(domain_min, domain_max, boundary)?;
    let given = GivenArrays::read(given_positions, given_clearances, frame.origin)?;
    let request = ClassesOptions::default().domain(frame.domain).seed(natural("seed", seed)?).given(given.samples()?);
    let samples = Watch::new(py, threads, progress)?
        .run(|context, progress| volume::sample_classes(context, &request, &classes, progress))?;
    let classes = samples.classes.clone();
    Ok(Points::cuboid(py, samples, &frame)?.with_classes(py, classes))
}
