//! Relaxation of point sets.

use azulejo_core::Domain;
use azulejo_core::dcr::{
    self, Convergence, CorrelationOptions, DelaunayOptions, Density, Distribution, Method, Neighbourhood,
    PairCorrelation, Stopped, Thesis, Visits, surface, volume,
};
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::adaptive::DensityArrays;
use crate::analysis::{PlaneSet, SpaceSet};
use crate::argument::{callable, choice, maybe_pair, maybe_real, maybe_triple, maybe_whole, natural, real, whole};
use crate::array::{Array, line};
use crate::error::{invalid, raised};
use crate::frame::{Frame, Positions};
use crate::mesh::Mesh;
use crate::points::Points;
use crate::report::report;
use crate::taken;
use crate::watch::Watch;

report! {
    /// The report of a relaxation.
    DcrReport {
        /// Steps that were made.
        iterations: u32,
        /// Why it stopped: "converged", "steps" (all were made) or "cancelled" (progress returned False).
        stopped: String,
        /// Half of the distance that points moved over the last span of 10 steps, root mean square, in units of d_max.
        motion: f64,
        /// The smallest distance of two points.
        smallest_distance: f64,
        /// That in units of d_max, the distance of neighbours in hexagonal order; with a density, of that at each place.
        rho: f64,
        /// In the plane: the covering radius in units of d_max.
        relative_covering_radius: Option<f64>,
        /// Of several classes: the rho of each, float64, shape (k,), in units of the d_max of its own number of points;
        /// infinite for less than two points. The other figures are those of the union.
        class_rho: Option<Py<PyArray1<f64>>>,
        /// Of several classes: the covering radius of each, float64, shape (k,), in the same units; infinite for no point.
        class_relative_covering_radius: Option<Py<PyArray1<f64>>>,
        /// Of a relaxation to a pair correlation: the root mean square, over frequencies up to 2 sqrt(density), of the
        /// difference of the power and the one wanted, both smoothed over about 1 / reach.
        residual: Option<f64>,
    }
}

impl DcrReport {
    /// The report of all relaxations.
    fn steps(iterations: u32, stopped: Stopped, motion: f64, smallest_distance: f64, rho: f64) -> Self {
        let stopped = match stopped {
            Stopped::Converged => "converged",
            Stopped::Steps => "steps",
            Stopped::Cancelled => "cancelled",
        };
        Self {
            iterations,
            stopped: stopped.to_owned(),
            motion,
            smallest_distance,
            rho,
            relative_covering_radius: None,
            class_rho: None,
            class_relative_covering_radius: None,
            residual: None,
        }
    }
}

impl From<dcr::Report> for DcrReport {
    fn from(report: dcr::Report) -> Self {
        let dcr::Report { iterations, stopped, motion, smallest_distance, rho, relative_covering_radius, .. } = report;
        let relative_covering_radius = Some(relative_covering_radius);
        Self { relative_covering_radius, ..Self::steps(iterations, stopped, motion, smallest_distance, rho) }
    }
}

impl From<volume::Report> for DcrReport {
    fn from(report: volume::Report) -> Self {
        let volume::Report { iterations, stopped, motion, smallest_distance, rho, .. } = report;
        Self::steps(iterations, stopped, motion, smallest_distance, rho)
    }
}

impl From<surface::Report> for DcrReport {
    fn from(report: surface::Report) -> Self {
        let surface::Report { iterations, stopped, motion, smallest_distance, rho, .. } = report;
        Self::steps(iterations, stopped, motion, smallest_distance, rho)
    }
}

const DISTRIBUTIONS: &[(&str, Distribution)] = &[
    ("activeness", Distribution::Activeness),
    ("average", Distribution::Average),
    ("dominant", Distribution::Dominant),
    ("zero", Distribution::Zero),
    ("eighty_twenty", Distribution::EightyTwenty),
];

/// Options with the arguments that every relaxation in the plane has.
fn with_steps(domain: Domain, max_iterations: i128, tolerance: Option<f64>, seed: i128) -> PyResult<DelaunayOptions> {
    let request = DelaunayOptions::new(domain).max_iterations(natural("max_iterations", max_iterations)?);
    let request = request.seed(natural("seed", seed)?);
    Ok(request.tolerance(tolerance.unwrap_or(request.tolerance)))
}

/// Moves points of the plane until they are evenly spread: a blue-noise set without the look of a lattice.
///
/// positions: the points, float32, shape (n, 2), in domain_min <= x < domain_max.
/// domain_min, domain_max, boundary: as in kdrt_sample; default: those of positions that are Points.
/// neighbourhood: "delaunay" (neighbours keep their distance and close holes) or "nearest" (they only repel).
/// method: "momentum", or "thesis" for the algorithm of the thesis.
/// max_iterations: the most steps.
/// tolerance: the motion at which a set has converged, in units of d_max; default: that of the method.
/// seed: 0 to 2**64 - 1. The same arguments and seed give the same bytes.
/// conflict_radius, attraction_radius, step, decay, neighbours, distribution ("activeness", "average", "dominant", "zero",
///     "eighty_twenty"), visits ("both_ends", "one_end"), convergence ("motion", "variance"): of the thesis's method only.
/// threads: 0 for one per core. The result does not depend on it.
/// progress: called with the fraction that is done, from 0 to 1; if it returns False the call returns the state after the
///     last whole step.
///
/// Returns Points, in the order of positions, with the report DcrReport.
#[pyfunction]
#[pyo3(signature = (
    positions, *, domain_min=None, domain_max=None, boundary=None, neighbourhood="delaunay",
    method="momentum", max_iterations=100, tolerance=None, seed=0, conflict_radius=None, attraction_radius=None,
    step=None, decay=None, neighbours=None, distribution=None, visits=None, convergence=None, threads=0, progress=None
))]
pub(crate) fn dcr_relax(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
    #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
    boundary: Option<&str>,
    neighbourhood: &str,
    method: &str,
    #[pyo3(from_py_with = whole::max_iterations)] max_iterations: i128,
    #[pyo3(from_py_with = maybe_real::tolerance)] tolerance: Option<f64>,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    #[pyo3(from_py_with = maybe_real::conflict_radius)] conflict_radius: Option<f64>,
    #[pyo3(from_py_with = maybe_real::attraction_radius)] attraction_radius: Option<f64>,
    #[pyo3(from_py_with = maybe_real::step)] step: Option<f64>,
    #[pyo3(from_py_with = maybe_real::decay)] decay: Option<f64>,
    #[pyo3(from_py_with = maybe_whole::neighbours)] neighbours: Option<i128>,
    distribution: Option<&str>,
    visits: Option<&str>,
    convergence: Option<&str>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let set = PlaneSet::read(positions, domain_min, domain_max, boundary)?;
    let (points, domain) = (set.points()?, set.frame.domain);
    let neighbourhoods = [("delaunay", Neighbourhood::Delaunay), ("nearest", Neighbourhood::Nearest)];
    let neighbourhood = choice("neighbourhood", neighbourhood, &neighbourhoods)?;
    let request = if choice("method", method, &[("momentum", false), ("thesis", true)])? {
        let mut thesis = Thesis::default();
        thesis.conflict_radius = conflict_radius.unwrap_or(thesis.conflict_radius);
        thesis.attraction_radius = attraction_radius.unwrap_or(thesis.attraction_radius);
        thesis.step = step.unwrap_or(thesis.step);
        thesis.decay = decay.unwrap_or(thesis.decay);
        if let Some(count) = neighbours {
            thesis.neighbours = natural("neighbours", count)?;
        }
        if let Some(name) = distribution {
            thesis.distribution = choice("distribution", name, DISTRIBUTIONS)?;
        }
        if let Some(name) = visits {
            let choices = [("both_ends", Visits::BothEnds), ("one_end", Visits::OneEnd)];
            thesis.visits = choice("visits", name, &choices)?;
        }
        if let Some(name) = convergence {
            let choices = [("motion", Convergence::Motion), ("variance", Convergence::Variance)];
            thesis.convergence = choice("convergence", name, &choices)?;
        }
        dcr::Options::thesis(domain, neighbourhood).method(Method::Thesis(thesis))
    } else {
        let of_thesis = [
            ("conflict_radius", conflict_radius.is_some()),
            ("attraction_radius", attraction_radius.is_some()),
            ("step", step.is_some()),
            ("decay", decay.is_some()),
            ("neighbours", neighbours.is_some()),
            ("distribution", distribution.is_some()),
            ("visits", visits.is_some()),
            ("convergence", convergence.is_some()),
        ];
        if let Some((argument, _)) = of_thesis.iter().find(|(_, is_set)| *is_set) {
            return Err(invalid(argument, "is of the method \"thesis\" only"));
        }
        dcr::Options::new(domain, neighbourhood)
    };
    let request = request.max_iterations(natural("max_iterations", max_iterations)?).seed(natural("seed", seed)?);
    let request = request.tolerance(tolerance.unwrap_or(request.tolerance));
    let (relaxed, report) =
        Watch::new(py, threads, progress)?.run(|context, progress| dcr::relax(context, &request, points, progress))?;
    Points::plane(py, relaxed, &set.frame)?.with_report(py, DcrReport::from(report))
}

/// Moves points of several classes until they are spread more evenly, all together and each class by itself, such as those
/// of kdrt_sample_classes. They cannot be as even as the points of one class alone, and no distance between points of two
/// classes is promised.
///
/// positions: the points, float32, shape (n, 2), in domain_min <= x < domain_max.
/// classes: the class of each point, uint32, shape (n,), at most 15.
/// The others are those of dcr_relax. About 2.5 times its time.
///
/// Returns Points with classes, in the order of positions, and the report DcrReport, which has class_rho and
/// class_relative_covering_radius for the classes up to the highest.
#[pyfunction]
#[pyo3(signature = (
    positions, classes, *, domain_min=None, domain_max=None, boundary=None, max_iterations=100,
    tolerance=None, seed=0, threads=0, progress=None
))]
pub(crate) fn dcr_relax_classes(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    classes: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
    #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
    boundary: Option<&str>,
    #[pyo3(from_py_with = whole::max_iterations)] max_iterations: i128,
    #[pyo3(from_py_with = maybe_real::tolerance)] tolerance: Option<f64>,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let set = PlaneSet::read(positions, domain_min, domain_max, boundary)?;
    let classes = Array::read("classes", classes)?;
    let (points, classes) = (set.points()?, classes.line()?);
    let request = with_steps(set.frame.domain, max_iterations, tolerance, seed)?;
    let (samples, report, each) = Watch::new(py, threads, progress)?
        .run(|context, progress| dcr::relax_classes(context, &request, points, classes, progress))?;
    let report = DcrReport {
        class_rho: Some(line(py, each.iter().map(|class| class.rho).collect())),
        class_relative_covering_radius: Some(line(
            py,
            each.iter().map(|class| class.relative_covering_radius).collect(),
        )),
        ..report.into()
    };
    Points::plane(py, samples, &set.frame)?.with_classes(py, classes.to_vec()).with_report(py, report)
}

/// Makes the pair correlation g(r) of sets with a radial mean of the power, for dcr_relax_to_correlation (Heck et al.
/// 2013).
///
/// power: float64, shape (n,), 0 or above: the power in bins of equal width from frequency 0 to highest, in units of
///     sqrt(density); beyond them it is 1. [0.0] is step noise.
/// highest: where the last bin ends.
/// reach, bins: g is evaluated in the middles of so many bins of equal width from 0 to reach, in units of d_max.
///
/// Returns float64, shape (bins,).
#[pyfunction]
#[pyo3(signature = (power, highest, *, reach=12.0, bins=480))]
pub(crate) fn dcr_correlation_of_power(
    py: Python<'_>,
    power: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = real::highest)] highest: f64,
    #[pyo3(from_py_with = real::reach)] reach: f64,
    #[pyo3(from_py_with = whole::bins)] bins: i128,
) -> PyResult<Py<PyArray1<f64>>> {
    let power = Array::<f64>::read("power", power)?;
    let made = PairCorrelation::of_power(highest, power.line()?, reach, natural("bins", bins)?);
    Ok(line(py, made.map_err(raised)?.values().to_vec()))
}

/// Moves points of a periodic domain until their pair correlation g(r), and with it the radial mean of their power, is the
/// one wanted: general spectra (thesis eq. 4.3, 4.4; Heck et al. 2013). Uniform random points are a good start.
///
/// positions: the points, float32, shape (n, 2), in domain_min <= x < domain_max.
/// correlation: g, float64, shape (bins,), in bins of equal width from distance 0 to reach, in units of d_max: of
///     plane_radial_distribution (times (n - 1) / n for n points, to be matched to the last) or dcr_correlation_of_power.
/// tolerance: the residual at which a set has converged; default 0.005. The others are those of dcr_relax.
///
/// Returns Points, in the order of positions, with the report DcrReport, which has the residual: of the states, the one
/// with the least. Where no set has the correlation, all steps are made, and stopped is "steps".
#[pyfunction]
#[pyo3(signature = (
    positions, correlation, reach, *, domain_min=None, domain_max=None, boundary=None, max_iterations=100,
    tolerance=None, seed=0, threads=0, progress=None
))]
pub(crate) fn dcr_relax_to_correlation(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    correlation: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = real::reach)] reach: f64,
    #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
    #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
    boundary: Option<&str>,
    #[pyo3(from_py_with = whole::max_iterations)] max_iterations: i128,
    #[pyo3(from_py_with = maybe_real::tolerance)] tolerance: Option<f64>,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let set = PlaneSet::read(positions, domain_min, domain_max, boundary)?;
    let correlation = Array::<f64>::read("correlation", correlation)?;
    let target = PairCorrelation::new(reach, correlation.line()?).map_err(raised)?;
    let points = set.points()?;
    let request = CorrelationOptions::new(set.frame.domain).max_iterations(natural("max_iterations", max_iterations)?);
    let request = request.seed(natural("seed", seed)?);
    let request = request.tolerance(tolerance.unwrap_or(request.tolerance));
    let (relaxed, report) = Watch::new(py, threads, progress)?
        .run(|context, progress| dcr::relax_to_correlation(context, &request, points, &target, progress))?;
    let report = DcrReport { residual: Some(report.residual), ..report.set.into() };
    Points::plane(py, relaxed, &set.frame)?.with_report(py, report)
}

/// The upper corner of the domain over which an image is laid: where no corner is given, it has the proportions of the
/// image, and its longer side is 1.
fn upper_corner(min: Option<[f64; 2]>, max: Option<[f64; 2]>, size: [usize; 2]) -> Option<[f64; 2]> {
    let [width, height] = size.map(|pixels| pixels as f64);
    let whole = [width, height].map(|length| length / width.max(height));
    max.or(if min.is_none() { Some(whole) } else { None })
}

/// Moves points of the plane until they are spread as a density wants: stippling.
///
/// positions: the points, float32, shape (n, 2), such as those of dcr_scatter.
/// density: an image, float32, shape (height, width), 0 or above and not 0 everywhere, laid over the domain; its first
///     row lies along domain_min[1].
/// domain_min, domain_max: default: those of positions that are Points; else as in dcr_scatter. The others are those of
///     dcr_relax.
///
/// Returns Points, in the order of positions, with the report DcrReport.
#[pyfunction]
#[pyo3(signature = (
    positions, density, *, domain_min=None, domain_max=None, boundary=None, max_iterations=100,
    tolerance=None, seed=0, threads=0, progress=None
))]
pub(crate) fn dcr_relax_density(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    density: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
    #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
    boundary: Option<&str>,
    #[pyo3(from_py_with = whole::max_iterations)] max_iterations: i128,
    #[pyo3(from_py_with = maybe_real::tolerance)] tolerance: Option<f64>,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let density = Array::read("density", density)?;
    let (values, [width, height]) = density.image()?;
    let has_domain = positions.cast::<Points>().is_ok_and(|points| points.get().place.plane().is_some());
    let domain_max = if has_domain { domain_max } else { upper_corner(domain_min, domain_max, [width, height]) };
    let set = PlaneSet::read(positions, domain_min, domain_max, boundary)?;
    let points = set.points()?;
    let request = with_steps(set.frame.domain, max_iterations, tolerance, seed)?;
    let (relaxed, report) = Watch::new(py, threads, progress)?.run(|context, progress| {
        dcr::relax_with_density(context, &request, &Density::Image { values, width, height }, points, progress)
    })?;
    Points::plane(py, relaxed, &set.frame)?.with_report(py, DcrReport::from(report))
}

/// Random points of a density, for dcr_relax_density to start from.
///
/// density: as in dcr_relax_density. count: their number.
/// domain_min, domain_max: default: a domain in the proportions of the image, from 0 0, whose longer side is 1.
/// The others are those of kdrt_sample.
#[pyfunction]
#[pyo3(signature = (
    density, count, *, domain_min=None, domain_max=None, boundary="periodic", seed=0, threads=0,
    progress=None
))]
pub(crate) fn dcr_scatter(
    py: Python<'_>,
    density: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = whole::count)] count: i128,
    #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
    #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
    boundary: &str,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let density = Array::read("density", density)?;
    let (values, [width, height]) = density.image()?;
    let domain_max = upper_corner(domain_min, domain_max, [width, height]);
    let frame = Frame::new(domain_min, domain_max, boundary)?;
    let (count, seed) = (natural("count", count)?, natural("seed", seed)?);
    let samples = Watch::new(py, threads, progress)?.run(|context, progress| {
        dcr::scatter(context, &frame.domain, &Density::Image { values, width, height }, count, seed, progress)
    })?;
    Points::plane(py, samples, &frame)
}

/// Moves samples along a mesh until they are evenly spread, or as dense as a density asks for. Without one their smallest distance
/// does not fall.
///
/// mesh: a Mesh.
/// triangles, barycentrics: where the samples are, uint32, shape (n,), and float32, shape (n, 2), as in Points.
/// density, texture: as in psp_adaptive_with_density; default: the same everywhere. No sample ends where the density is 0.
/// The others are those of dcr_relax.
///
/// Returns Points, in the order of the samples, with the report DcrReport. With a density its rho is the least distance over the
/// mean of the distances d_max that the density asks for at the two samples.
#[pyfunction]
#[pyo3(signature = (
    mesh, triangles, barycentrics, *, density=None, texture=None, max_iterations=100, tolerance=None, seed=0, threads=0,
    progress=None
))]
pub(crate) fn dcr_surface_relax(
    py: Python<'_>,
    #[pyo3(from_py_with = taken::mesh)] mesh: Mesh,
    triangles: &Bound<'_, PyAny>,
    barycentrics: &Bound<'_, PyAny>,
    density: Option<&Bound<'_, PyAny>>,
    texture: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = whole::max_iterations)] max_iterations: i128,
    #[pyo3(from_py_with = maybe_real::tolerance)] tolerance: Option<f64>,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let arrays = density.map(|density| DensityArrays::read(density, texture)).transpose()?;
    if arrays.is_none() && texture.is_some() {
        return Err(invalid("texture", "is given without a density"));
    }
    let density = arrays.as_ref().map(|arrays| arrays.of(&mesh)).transpose()?;
    let (triangles, barycentrics) = (Array::read("triangles", triangles)?, Array::read("barycentrics", barycentrics)?);
    let (triangles, barycentrics) = (triangles.line()?, barycentrics.rows()?);
    let mut request = surface::Options::default()
        .max_iterations(natural("max_iterations", max_iterations)?)
        .seed(natural("seed", seed)?);
    request = request.tolerance(tolerance.unwrap_or(request.tolerance));
    let (relaxed, report) = Watch::new(py, threads, progress)?.run(|context, progress| match density {
        None => surface::relax(context, &mesh.shared, triangles, barycentrics, &request, progress),
        Some(density) => {
            let mesh = &mesh.shared;
            surface::relax_with_density(context, mesh, triangles, barycentrics, density, &request, progress)
        }
    })?;
    Points::surface(py, relaxed, mesh.shared.origin())?.with_report(py, DcrReport::from(report))
}

/// Moves points of a cuboid until they are evenly spread.
///
/// positions: the points, float32, shape (n, 3), in domain_min <= x < domain_max; or Points, which have a domain of their own.
/// domain_min, domain_max: the corners; default the unit cube. boundary: "periodic" or "bounded".
/// sliding: bool, shape (n,): True for each point that moves along the surface; default: none. No point is fixed and sliding.
/// max_iterations: the largest number of steps; the forces of a step depend on it.
/// tolerance: the motion at which the set has converged; default 0.001.
/// The others are those of dcr_relax.
///
/// Returns Points, in the order of positions, with the report DcrReport, whose unit d_max is the distance of neighbours in the
/// densest packing, (sqrt(2) volume / n)^(1/3).
#[pyfunction]
#[pyo3(signature = (
    positions, *, domain_min=None, domain_max=None, boundary=None, max_iterations=100, tolerance=None, seed=0, threads=0,
    progress=None
))]
pub(crate) fn volume_relax(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = maybe_triple::domain_min)] domain_min: Option<[f64; 3]>,
    #[pyo3(from_py_with = maybe_triple::domain_max)] domain_max: Option<[f64; 3]>,
    boundary: Option<&str>,
    #[pyo3(from_py_with = whole::max_iterations)] max_iterations: i128,
    #[pyo3(from_py_with = maybe_real::tolerance)] tolerance: Option<f64>,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let set = SpaceSet::in_space(positions, domain_min, domain_max, boundary)?;
    let points = set.points()?;
    let request = volume::Options::new(set.frame.domain)
        .max_iterations(natural("max_iterations", max_iterations)?)
        .seed(natural("seed", seed)?);
    let request = request.tolerance(tolerance.unwrap_or(request.tolerance));
    let (relaxed, report) = Watch::new(py, threads, progress)?
        .run(|context, progress| volume::relax(context, &request, points, progress))?;
    Points::cuboid(py, relaxed.into(), &set.frame)?.with_report(py, DcrReport::from(report))
}

/// Moves points inside a mesh until they are evenly spread. None leaves the inside, of which caps close holes as in
/// volume_sample_inside.
///
/// mesh: as in volume_sample_inside. An even number of triangles must share each edge.
/// positions: the points, float32, shape (n, 3), inside the mesh; those that are fixed only in the box around it, those that slide
///     on its surface.
/// fixed: bool, shape (n,): True for each point that stays where it is, such as the samples of the surface, which are the first
///     ones of volume_sample_inside(surface="first"); default: none. Points that move keep their distance from them.
/// max_iterations: the largest number of steps; the forces of a step depend on it.
/// tolerance: the motion at which the set has converged; default 0.001.
/// The others are those of dcr_relax.
///
/// Returns Points, in the order of positions, with the report DcrReport, whose unit d_max is the distance of neighbours in the
/// densest packing, (sqrt(2) volume / n)^(1/3). Points that are clustered are not redistributed.
#[pyfunction]
#[pyo3(signature = (
    mesh, positions, *, fixed=None, sliding=None, max_iterations=100, tolerance=None, seed=0, threads=0, progress=None
))]
pub(crate) fn volume_relax_inside(
    py: Python<'_>,
    #[pyo3(from_py_with = taken::mesh)] mesh: Mesh,
    positions: &Bound<'_, PyAny>,
    fixed: Option<&Bound<'_, PyAny>>,
    sliding: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = whole::max_iterations)] max_iterations: i128,
    #[pyo3(from_py_with = maybe_real::tolerance)] tolerance: Option<f64>,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let positions = Positions::read("positions", positions)?.around(mesh.shared.origin())?;
    let points = positions.get()?;
    let flags = |name, flags: Option<&Bound<'_, PyAny>>| {
        let Some(flags) = flags else { return Ok(Vec::new()) };
        let flags = Array::<bool>::read(name, flags)?.line()?.to_vec();
        if flags.len() != points.len() {
            return Err(invalid(name, format!("has {} entries for {} points", flags.len(), points.len())));
        }
        Ok(flags)
    };
    let (fixed, sliding) = (flags("fixed", fixed)?, flags("sliding", sliding)?);
    let request = volume::InsideOptions::default()
        .max_iterations(natural("max_iterations", max_iterations)?)
        .seed(natural("seed", seed)?)
        .fixed(&fixed)
        .sliding(&sliding);
    let request = request.tolerance(tolerance.unwrap_or(request.tolerance));
    let (relaxed, report) = Watch::new(py, threads, progress)?
        .run(|context, progress| volume::relax_inside(context, &mesh.shared, &request, points, progress))?;
    Points::solid(py, relaxed.into(), mesh.shared.origin())?.with_report(py, DcrReport::from(report))
}
