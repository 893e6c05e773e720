//! Maximal sets on meshes.

use azulejo_core::psp::{self, DEFAULT_QUOTIENT, Priority, Projectors};
use pyo3::prelude::*;

use crate::argument::{
    amount, callable, choice, maybe_real, maybe_whole, natural, number, one_of, order, truth, whole,
};
use crate::array::GivenArrays;
use crate::mesh::Mesh;
use crate::points::Points;
use crate::report::report;
use crate::taken;
use crate::watch::Watch;

report! {
    /// The report of a psp_ call.
    PspReport {
        /// No two samples are closer: the radius that was asked for or, for a count, the one that was found. 0 where radii
        /// vary; in progressive order then what they are multiplied by: 1, or for a density the radius at density 1.
        radius: f64,
        /// Every place of the surface is so near to a sample; None where that is not known.
        covering_radius: Option<f64>,
        /// The radius over the distance of neighbours if as many samples stood in hexagonal order on the mesh's area.
        rho: f64,
        /// Samples of the set after the call.
        samples: u64,
        /// Samples that the call added.
        accepted: u64,
        /// Iterations of projection that were made.
        iterations: u32,
        /// Darts that were thrown at uncovered surface.
        darts: u64,
        /// The share of the area that was uncovered before the fill; None without one.
        uncovered_before: Option<f64>,
        /// The share that is uncovered after it.
        uncovered_after: Option<f64>,
        /// Wall time in seconds.
        seconds: f64,
    }
}

impl From<psp::Report> for PspReport {
    fn from(report: psp::Report) -> Self {
        let psp::Report { radius, covering_radius, rho, samples, accepted, iterations, darts, .. } = report;
        let psp::Report { uncovered_before, uncovered_after, seconds, .. } = report;
        Self {
            radius,
            covering_radius,
            rho,
            samples,
            accepted,
            iterations,
            darts,
            uncovered_before,
            uncovered_after,
            seconds,
        }
    }
}

/// A maximal Poisson-disk set on a mesh, by straight distance: no two samples are closer than a radius, and no place of the
/// surface is farther from all of them. Time grows in proportion to the samples and triangles.
///
/// mesh: a Mesh; or what has vertices and faces, as of trimesh, Open3D and PyVista; or a tuple (vertices, faces).
/// radius: the smallest distance of two samples, above 0, in the units of the mesh. Or:
/// count: the number of samples, which is met exactly; the radius is found.
/// order: "any", or "progressive": every prefix is well spread, and the points have ranks.
/// quotient: of a progressive order, the ratio of the radii of its levels, 1.02 to 1.5; default 2**(1/8).
/// iterations: of projection before the set is filled; default: 1 where that takes less time or the set is not maximal,
///     otherwise 0. With 0 all samples are darts.
/// maximal: whether to fill what projection leaves.
/// seed: 0 to 2**64 - 1. The same arguments and seed give the same bytes.
/// projectors: which project the patterns of an iteration: one for each part of the mesh that faces about one direction
///     ("local"), or three for the whole mesh ("global").
/// priority: which of two candidates of an iteration is kept, that of the projector which it faces more squarely
///     ("squareness"), or of the earlier one ("projector").
/// given_positions: float32, shape (m, 3): samples that stay and are not returned.
/// given_clearances: float64, shape (m,): how far new samples are from each at least; default: the radius.
/// cosine: samples on triangles whose normals have a smaller cosine ignore each other: for thin walls. Default: -1, off.
/// threads: 0 for one per core. The samples do not depend on it.
/// progress: called with the fraction that is done, from 0 to 1; if it returns False the call raises Cancelled.
///
/// Returns Points with the report PspReport.
#[pyfunction]
#[pyo3(signature = (
    mesh, radius=0.0, *, count=0, order="any", quotient=None, iterations=None, maximal=true, seed=0,
    projectors="local", priority="squareness", given_positions=None, given_clearances=None, cosine=None, threads=0,
    progress=None
))]
pub(crate) fn psp_sample(
    py: Python<'_>,
    #[pyo3(from_py_with = taken::mesh)] mesh: Mesh,
    #[pyo3(from_py_with = amount::radius)] radius: f64,
    #[pyo3(from_py_with = number::count)] count: i128,
    order: &str,
    #[pyo3(from_py_with = maybe_real::quotient)] quotient: Option<f64>,
    #[pyo3(from_py_with = maybe_whole::iterations)] iterations: Option<i128>,
    #[pyo3(from_py_with = truth::maximal)] maximal: bool,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    projectors: &str,
    priority: &str,
    given_positions: Option<&Bound<'_, PyAny>>,
    given_clearances: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = maybe_real::cosine)] cosine: Option<f64>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let (low, high) = mesh.shared.bounds();
    let sides = (0..3).map(|axis| f64::from(high[axis]) - f64::from(low[axis]));
    one_of(radius, count, sides, "mesh")?;
    let given = GivenArrays::read(given_positions, given_clearances, mesh.shared.origin())?;
    let iterations = iterations.map(|iterations| natural::<u32>("iterations", iterations)).transpose()?;
    let request = psp::FlatOptions::new(radius)
        .count(natural("count", count)?)
        .order(self::order(order, &[("quotient", quotient)])?)
        .quotient(quotient.unwrap_or(DEFAULT_QUOTIENT))
        .iterations(iterations)
        .maximal(maximal)
        .seed(natural("seed", seed)?)
        .projectors(self::projectors(projectors)?)
        .priority(self::priority(priority)?)
        .given(given.samples()?)
        .cosine(cosine.unwrap_or(-1.0));
    let (samples, report) =
        Watch::new(py, threads, progress)?.run(|context, progress| request.sample(context, &mesh.shared, progress))?;
    Points::surface(py, samples, mesh.shared.origin())?.with_report(py, PspReport::from(report))
}

pub(crate) fn projectors(name: &str) -> PyResult<Projectors> {
    choice("projectors", name, &[("local", Projectors::Local), ("global", Projectors::Global)])
}

pub(crate) fn priority(name: &str) -> PyResult<Priority> {
    choice("priority", name, &[("squareness", Priority::Squareness), ("projector", Priority::Projector)])
}
