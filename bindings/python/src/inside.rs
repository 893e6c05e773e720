//! Maximal sets of the inside of meshes.

use azulejo_core::volume::{self, InsideOptions, Surface};
use pyo3::prelude::*;

use crate::argument::{amount, amount_of, callable, choice, maybe_real, natural, number, one_of, order, real, whole};
use crate::array::GivenArrays;
use crate::mesh::Mesh;
use crate::points::Points;
use crate::report::report;
use crate::taken;
use crate::watch::Watch;

report! {
    /// The report of volume_sample_inside.
    VolumeInsideReport {
        /// No two samples are closer: the radius that was asked for or, for a count, the one that was found.
        radius: f64,
        /// No place inside that is deeper than `depth` is farther from all samples, and outside of all given ones: the radius,
        /// or for a count mostly up to 1.1 times it; in progressive order the quotient times it.
        covering_radius: f64,
        /// The greatest distance from the surface, and from the inner border of a shell, at which places inside can be open.
        depth: f64,
        /// The number of samples of the surface, which come first.
        surface_samples: u64,
        /// Wall time in seconds.
        seconds: f64,
    }
}

impl From<volume::InsideReport> for VolumeInsideReport {
    fn from(report: volume::InsideReport) -> Self {
        let volume::InsideReport { radius, covering_radius, depth, surface_samples, seconds, .. } = report;
        Self { radius, covering_radius, depth, surface_samples: surface_samples as u64, seconds }
    }
}

/// A maximal Poisson-disk set of the inside of a mesh: no two samples are closer than a radius, and no place inside is
/// farther from all of them, unless it is nearer to the surface than the report's depth. Time grows in proportion to the
/// samples.
///
/// mesh: a Mesh; or what has vertices and faces, as of trimesh, Open3D and PyVista; or a tuple (vertices, faces). Holes, whose
///     edges an odd number of triangles shares, are closed by caps, about where the generalised winding number is 1/2. Caps count as
///     surface, but have no samples of it. The direction of triangles matters for the place of caps only.
/// radius: the smallest distance of two samples, above 0, in the units of the mesh. Or:
/// count: the number of samples, which is met exactly; the radius is found.
/// surface: "open": samples lie anywhere inside; or "first": a maximal set of the surface comes first, and the inside is filled
///     around it. That takes a radius, and any order.
/// tolerance: places inside may stay open that are nearer to the surface than sqrt(3) times this many radii, 1/256 to 1/2.
/// thickness: only places that are no farther from the surface than this, in the units of the mesh, at least 1/256 of a radius; 0 for
///     all of the inside.
/// seed: 0 to 2**64 - 1. The same arguments and seed give the same bytes.
/// order: "any", or "progressive": every prefix is well spread, and the points have ranks.
/// quotient: of a progressive order: every prefix of 100 samples and more covers within this times its last rank, 1.02 to
///     1.5; default 2**(1/8).
/// given_positions: float32, shape (m, 3): samples that stay and are not returned.
/// given_clearances: float64, shape (m,): how far new samples are from each at least; default: the radius. Needed with a
///     count.
/// threads: 0 for one per core. The samples do not depend on it.
/// progress: called with the fraction that is done, from 0 to 1; if it returns False the call raises Cancelled.
///
/// Returns Points with the report VolumeInsideReport. They have no normals and triangles, also those of the surface.
#[pyfunction]
#[pyo3(signature = (
    mesh, radius=0.0, *, count=0, surface="open", tolerance=0.0625, thickness=0.0, seed=0, order="any", quotient=None,
    given_positions=None, given_clearances=None, threads=0, progress=None
))]
pub(crate) fn volume_sample_inside(
    py: Python<'_>,
    #[pyo3(from_py_with = taken::mesh)] mesh: Mesh,
    #[pyo3(from_py_with = amount::radius)] radius: f64,
    #[pyo3(from_py_with = number::count)] count: i128,
    surface: &str,
    #[pyo3(from_py_with = real::tolerance)] tolerance: f64,
    #[pyo3(from_py_with = real::thickness)] thickness: f64,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    order: &str,
    #[pyo3(from_py_with = maybe_real::quotient)] quotient: Option<f64>,
    given_positions: Option<&Bound<'_, PyAny>>,
    given_clearances: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let (low, high) = mesh.shared.bounds();
    one_of(radius, count, (0..3).map(|axis| f64::from(high[axis]) - f64::from(low[axis])), "mesh")?;
    let given = GivenArrays::read(given_positions, given_clearances, mesh.shared.origin())?;
    let request = InsideOptions::of(amount_of(radius, count)?);
    let request = request
        .surface(choice("surface", surface, &[("open", Surface::Open), ("first", Surface::First)])?)
        .tolerance(tolerance)
        .thickness(thickness)
        .seed(natural("seed", seed)?)
        .order(self::order(order, &[("quotient", quotient)])?)
        .quotient(quotient.unwrap_or(request.quotient))
        .given(given.samples()?);
    let (samples, report) = Watch::new(py, threads, progress)?
        .run(|context, progress| volume::sample_inside(context, &mesh.shared, &request, progress))?;
    Points::solid(py, samples, mesh.shared.origin())?.with_report(py, VolumeInsideReport::from(report))
}
