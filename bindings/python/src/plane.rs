//! Maximal sets in the plane.

use azulejo_core::kdrt::{self, CountOptions, Kind, Plane, Progressive};
use azulejo_core::{Classes, Domain, Order, maximal};
use pyo3::prelude::*;

use crate::argument::{amount, callable, maybe_pair, maybe_real, natural, number, one_of, order, pair, real, whole};
use crate::array::GivenArrays;
use crate::classes::matrix;
use crate::error::invalid;
use crate::frame::{Frame, Positions, Rows};
use crate::points::Points;
use crate::report::report;
use crate::watch::{Watch, unlocked};

report! {
    /// The report of kdrt_sample.
    KdrtReport {
        /// No two samples are closer: the radius that was asked for or, for a count, the one that was found.
        radius: f64,
        /// True if no sample can be added. Sets of a count that is not reached exactly by a maximal set are not maximal.
        is_maximal: bool,
    }
}

/// The arguments that all sets of the plane share.
pub(crate) struct Request<'py> {
    domain: Domain,
    leaf_size: f64,
    seed: u64,
    /// Of a progressive order.
    levels: Option<Progressive>,
    given: GivenArrays<'py, 2>,
}

impl<'py> Request<'py> {
    pub(crate) fn new(
        frame: &Frame,
        leaf_size: f64,
        seed: i128,
        (order_name, quotient, coarsest): (&str, Option<f64>, Option<f64>),
        (given_positions, given_clearances): (Option<&Bound<'py, PyAny>>, Option<&Bound<'py, PyAny>>),
    ) -> PyResult<Self> {
        let seed = natural("seed", seed)?;
        let levels = match order(order_name, &[("quotient", quotient), ("coarsest", coarsest)])? {
            Order::Any => None,
            Order::Progressive => {
                let Progressive { quotient: usual, coarsest: longest, .. } = Progressive::new();
                let levels = Progressive::new().quotient(quotient.unwrap_or(usual));
                Some(levels.coarsest(coarsest.unwrap_or(longest)))
            }
        };
        let given = GivenArrays::read(given_positions, given_clearances, frame.origin)?;
        Ok(Self { domain: frame.domain, leaf_size, seed, levels, given })
    }

    pub(crate) fn by_radius(&self, radius: f64) -> PyResult<kdrt::Options<'_>> {
        self.of(self.levels.map_or(Kind::Plain(radius), |levels| Kind::Progressive(radius, levels)))
    }

    /// A set of several classes, which have radii of their own.
    fn by_classes<'a>(&'a self, radius: f64, classes: &'a Classes) -> PyResult<kdrt::Options<'a>> {
        if radius != 0.0 {
            return Err(invalid("radius", format!("{radius:?} is not 0; classes have radii of their own")));
        }
        self.of(self.levels.map_or(Kind::Classes(classes), |levels| Kind::ProgressiveClasses(classes, levels)))
    }

    fn of<'a>(&'a self, kind: Kind<'a>) -> PyResult<kdrt::Options<'a>> {
        let options = kdrt::Options::of(kind).domain(self.domain).leaf_size(self.leaf_size).seed(self.seed);
        Ok(options.given(self.given.samples()?))
    }

    fn by_count(&self, count: u64) -> PyResult<CountOptions> {
        if !self.given.samples()?.positions.is_empty() {
            return Err(invalid("given_positions", "a count does not go with given samples"));
        }
        Ok(CountOptions::new(count).domain(self.domain).leaf_size(self.leaf_size).seed(self.seed).levels(self.levels))
    }
}

/// A maximal Poisson-disk set of a rectangle or torus: no two samples are closer than a radius, and no place is farther
/// from all of them. Time grows in proportion to the samples.
///
/// radius: the smallest distance of two samples, above 0, in the units of the domain. Or:
/// count: the number of samples, which is met exactly; the radius is found. Twice the work.
/// domain_min, domain_max: the corners of the domain, two numbers each; samples lie in min <= x < max. Default: the unit
///     square. Positions are float32, or float64 in a domain that lies farther from the origin than 1024 times its size.
/// boundary: "periodic" (distances wrap around) or "bounded".
/// leaf_size: in radii, at least 6. Larger is faster and less biased.
/// seed: 0 to 2**64 - 1. The same arguments and seed give the same bytes.
/// order: "any", or "progressive": every prefix is well spread, and the points have ranks.
/// quotient, coarsest: of a progressive order, the ratio of the radii of its levels (1.02 to 1.5, default 2**(1/8)) and the
///     radius of the coarsest level (default: so large that it reaches over the domain).
/// given_positions: float32, shape (m, 2): samples that stay and are not returned.
/// given_clearances: float64, shape (m,): how far new samples are from each at least; default: the radius.
/// threads: 0 for one per core. The samples do not depend on it.
/// progress: called with the fraction that is done, from 0 to 1; if it returns False the call raises Cancelled.
///
/// Returns Points with the report KdrtReport.
#[pyfunction]
#[pyo3(signature = (
    radius=0.0, *, count=0, domain_min=None, domain_max=None, boundary="periodic", leaf_size=20.0, seed=0,
    order="any", quotient=None, coarsest=None, given_positions=None, given_clearances=None, threads=0, progress=None
))]
pub(crate) fn kdrt_sample(
    py: Python<'_>,
    #[pyo3(from_py_with = amount::radius)] radius: f64,
    #[pyo3(from_py_with = number::count)] count: i128,
    #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
    #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
    boundary: &str,
    #[pyo3(from_py_with = real::leaf_size)] leaf_size: f64,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    order: &str,
    #[pyo3(from_py_with = maybe_real::quotient)] quotient: Option<f64>,
    #[pyo3(from_py_with = maybe_real::coarsest)] coarsest: Option<f64>,
    given_positions: Option<&Bound<'_, PyAny>>,
    given_clearances: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let frame = Frame::new(domain_min, domain_max, boundary)?;
    one_of(radius, count, frame.domain.extent(), "domain")?;
    let given = (given_positions, given_clearances);
    let request = Request::new(&frame, leaf_size, seed, (order, quotient, coarsest), given)?;
    let watch = Watch::new(py, threads, progress)?;
    match natural("count", count)? {
        0 => {
            let request = request.by_radius(radius)?;
            let set = watch.run(|context, progress| kdrt::sample(context, &request, progress))?;
            Points::plane(py, set, &frame)?.with_report(py, KdrtReport { radius, is_maximal: true })
        }
        _ if radius != 0.0 => Err(invalid("count", format!("{count}, and radius {radius}; one of them must be 0"))),
        count => {
            let request = request.by_count(count)?;
            let (set, done) = watch.run(|context, progress| kdrt::sample_count(context, &request, progress))?;
            let report = KdrtReport { radius: done.radius, is_maximal: done.is_maximal };
            Points::plane(py, set, &frame)?.with_report(py, report)
        }
    }
}

/// The samples of kdrt_sample in a window, without the rest of the plane: the same bytes.
///
/// window_min, window_max: the corners, two numbers each, inside the domain. The others are those of kdrt_sample.
#[pyfunction]
#[pyo3(signature = (
    window_min, window_max, radius, *, domain_min=None, domain_max=None, boundary="periodic",
    leaf_size=20.0, seed=0, order="any", quotient=None, coarsest=None, given_positions=None, given_clearances=None,
    threads=0, progress=None
))]
pub(crate) fn kdrt_sample_window(
    py: Python<'_>,
    #[pyo3(from_py_with = pair::window_min)] window_min: [f64; 2],
    #[pyo3(from_py_with = pair::window_max)] window_max: [f64; 2],
    #[pyo3(from_py_with = real::radius)] radius: f64,
    #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
    #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
    boundary: &str,
    #[pyo3(from_py_with = real::leaf_size)] leaf_size: f64,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    order: &str,
    #[pyo3(from_py_with = maybe_real::quotient)] quotient: Option<f64>,
    #[pyo3(from_py_with = maybe_real::coarsest)] coarsest: Option<f64>,
    given_positions: Option<&Bound<'_, PyAny>>,
    given_clearances: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let frame = Frame::new(domain_min, domain_max, boundary)?;
    let given = (given_positions, given_clearances);
    let request = Request::new(&frame, leaf_size, seed, (order, quotient, coarsest), given)?;
    let request = request.by_radius(radius)?;
    let (min, max) = (frame.local(window_min), frame.local(window_max));
    let set = Watch::new(py, threads, progress)?
        .run(|context, progress| kdrt::sample_window(context, &request, min, max, progress))?;
    Points::plane(py, set, &frame)
}

/// A maximal set of several classes: samples of the classes i and j are at least radii[i][j] apart, and for each class
/// i every place is within radii[i][j] of some sample of some class j.
///
/// radii: symmetric, float64, shape (k, k) with k from 1 to 16; classes_radii() makes such matrices.
/// order, quotient, coarsest: in progressive order each class is sorted coarse to fine, and the points have ranks.
/// given_clearances: float64, shape (m, k). The others are those of kdrt_sample.
///
/// Returns Points with classes.
#[pyfunction]
#[pyo3(signature = (
    radii, *, domain_min=None, domain_max=None, boundary="periodic", leaf_size=20.0, seed=0, order="any",
    quotient=None, coarsest=None, given_positions=None, given_clearances=None, threads=0, progress=None
))]
pub(crate) fn kdrt_sample_classes(
    py: Python<'_>,
    radii: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
    #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
    boundary: &str,
    #[pyo3(from_py_with = real::leaf_size)] leaf_size: f64,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    order: &str,
    #[pyo3(from_py_with = maybe_real::quotient)] quotient: Option<f64>,
    #[pyo3(from_py_with = maybe_real::coarsest)] coarsest: Option<f64>,
    given_positions: Option<&Bound<'_, PyAny>>,
    given_clearances: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let classes = matrix(radii)?;
    let frame = Frame::new(domain_min, domain_max, boundary)?;
    let given = (given_positions, given_clearances);
    let request = Request::new(&frame, leaf_size, seed, (order, quotient, coarsest), given)?;
    let request = request.by_classes(0.0, &classes)?;
    let set = Watch::new(py, threads, progress)?.run(|context, progress| kdrt::sample(context, &request, progress))?;
    Points::classified(py, set, &frame)
}

/// A plane whose pattern is made once, for many windows of it.
///
/// radius, or radii of several classes as in kdrt_sample_classes. The others are those of kdrt_sample.
#[pyclass(frozen, module = "azulejo")]
pub(crate) struct KdrtPlane {
    plane: Plane,
    frame: Frame,
    has_classes: bool,
}

#[pymethods]
impl KdrtPlane {
    #[new]
    #[pyo3(signature = (
        radius=0.0, *, radii=None, domain_min=None, domain_max=None, boundary="periodic", leaf_size=20.0,
        seed=0, order="any", quotient=None, coarsest=None, given_positions=None, given_clearances=None, threads=0,
        progress=None
    ))]
    fn new(
        py: Python<'_>,
        #[pyo3(from_py_with = amount::radius)] radius: f64,
        radii: Option<&Bound<'_, PyAny>>,
        #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
        #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
        boundary: &str,
        #[pyo3(from_py_with = real::leaf_size)] leaf_size: f64,
        #[pyo3(from_py_with = whole::seed)] seed: i128,
        order: &str,
        #[pyo3(from_py_with = maybe_real::quotient)] quotient: Option<f64>,
        #[pyo3(from_py_with = maybe_real::coarsest)] coarsest: Option<f64>,
        given_positions: Option<&Bound<'_, PyAny>>,
        given_clearances: Option<&Bound<'_, PyAny>>,
        #[pyo3(from_py_with = whole::threads)] threads: i128,
        #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let frame = Frame::new(domain_min, domain_max, boundary)?;
        let given = (given_positions, given_clearances);
        let request = Request::new(&frame, leaf_size, seed, (order, quotient, coarsest), given)?;
        let watch = Watch::new(py, threads, progress)?;
        let classes = radii.map(matrix).transpose()?;
        let request = match &classes {
            None => request.by_radius(radius)?,
            Some(classes) => request.by_classes(radius, classes)?,
        };
        let plane = watch.run(|context, progress| Plane::new(context, &request, progress))?;
        Ok(Self { plane, frame, has_classes: classes.is_some() })
    }

    fn __repr__(&self) -> String {
        let classes = if self.has_classes { ", of several classes" } else { "" };
        format!("<azulejo.KdrtPlane: {}{classes}>", self.frame.shown())
    }

    /// The samples in a window, on the calling thread: the same as in the set of kdrt_sample, to the byte.
    ///
    /// window_min, window_max: the corners, two numbers each, inside the domain. Several threads may make windows at
    /// once.
    fn window(&self, py: Python<'_>, window_min: [f64; 2], window_max: [f64; 2]) -> PyResult<Points> {
        let (min, max) = (self.frame.local(window_min), self.frame.local(window_max));
        let set = unlocked(py, || self.plane.window(min, max))?;
        if self.has_classes { Points::classified(py, set, &self.frame) } else { Points::plane(py, set, &self.frame) }
    }
}

/// The unbiased maximal set that the others are measured by; slower than kdrt_sample. The arguments are those of
/// kdrt_sample.
#[pyfunction]
#[pyo3(signature = (
    radius, *, domain_min=None, domain_max=None, boundary="periodic", seed=0, threads=0, progress=None
))]
pub(crate) fn maximal_sample(
    py: Python<'_>,
    #[pyo3(from_py_with = real::radius)] radius: f64,
    #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
    #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
    boundary: &str,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let frame = Frame::new(domain_min, domain_max, boundary)?;
    let request = maximal::Options::new(radius).domain(frame.domain).seed(natural("seed", seed)?);
    let samples =
        Watch::new(py, threads, progress)?.run(|context, progress| maximal::sample(context, &request, progress))?;
    Points::plane(py, samples, &frame)
}

report! {
    /// The report of kdrt_merge.
    KdrtMergeReport {
        /// Samples of the pieces that were kept.
        kept: usize,
        /// Samples of the pieces that were too close to others.
        eliminated: usize,
        /// Samples that were added in gaps.
        inserted: usize,
    }
}

/// Merges sets that were made separately into one that is maximal in the domain.
///
/// pieces: a sequence of (positions, min, max): samples, float32, shape (n, 2), and the corners of the rectangle they fill.
/// fixed: float32, shape (m, 2), or None: points of the domain that must stay; they are the first of the result.
/// maximal_pieces: True if the pieces are known to be maximal sets of the radius, at least farther than it from their
///     edges, as kdrt_sample, kdrt_sample_window and maximal_sample make them: then only their seams are tested, which takes
///     a fraction of the time and gives the same samples.
/// The others are those of kdrt_sample.
///
/// Returns Points with the report KdrtMergeReport.
#[pyfunction]
#[pyo3(signature = (
    pieces, radius, *, fixed=None, domain_min=None, domain_max=None, boundary="periodic", seed=0, maximal_pieces=false,
    threads=0, progress=None
))]
pub(crate) fn kdrt_merge<'py>(
    py: Python<'py>,
    pieces: Vec<(Bound<'py, PyAny>, [f64; 2], [f64; 2])>,
    #[pyo3(from_py_with = real::radius)] radius: f64,
    fixed: Option<&Bound<'py, PyAny>>,
    #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
    #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
    boundary: &str,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    maximal_pieces: bool,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let frame = Frame::new(domain_min, domain_max, boundary)?;
    let request = kdrt::MergeOptions::new(radius)
        .domain(frame.domain)
        .seed(natural("seed", seed)?)
        .maximal_pieces(maximal_pieces);
    let around = |argument, positions| Positions::read(argument, positions)?.around::<2>(frame.origin);
    let arrays: Vec<_> = pieces.iter().map(|(positions, ..)| around("pieces", positions)).collect::<PyResult<_>>()?;
    let pieces: Vec<_> = arrays
        .iter()
        .zip(&pieces)
        .map(|(positions, &(_, min, max))| {
            Ok(kdrt::Piece { samples: positions.get()?, min: frame.local(min), max: frame.local(max) })
        })
        .collect::<PyResult<_>>()?;
    let fixed = fixed.map(|fixed| around("fixed", fixed)).transpose()?;
    let fixed = fixed.as_ref().map_or(Ok([].as_slice()), Rows::get)?;
    let (merged, kdrt::MergeReport { kept, eliminated, inserted, .. }) = Watch::new(py, threads, progress)?
        .run(|context, progress| kdrt::merge(context, &request, &pieces, fixed, progress))?;
    Points::plane(py, merged, &frame)?.with_report(py, KdrtMergeReport { kept, eliminated, inserted })
}
