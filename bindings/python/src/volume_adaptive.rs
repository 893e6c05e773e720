//! Maximal sets of cuboids, and of the inside of meshes, whose radius varies.

use azulejo_core::volume::adaptive::{self, InsideOptions, Options, Radius};
use pyo3::prelude::*;

use crate::argument::{callable, maybe_triple, natural, real, whole};
use crate::array::Array;
use crate::error::invalid;
use crate::frame::Frame;
use crate::points::Points;
use crate::taken;
use crate::volume::VolumeReport;
use crate::watch::Watch;

/// The side of voxels at a surface, in radii, that may stay open if nothing is said.
const TOLERANCE: f64 = 0.0625;

/// A maximal set of a cuboid, or of the inside of a mesh, whose radius varies: two samples are at least the mean of their
/// radii apart, and no place is farther from all of them than the mean of its radius and that of the sample.
///
/// grid_values: float32, shape (z, y, x), above 0: the radius on a grid over the cuboid, or over the box around the mesh, linear
///     between its points along each axis; the first and the last along an axis lie on the faces.
/// mesh: the mesh, as that of volume_sample_inside; default: a cuboid.
/// domain_min, domain_max, boundary: of the cuboid, as in volume_sample. Not with a mesh.
/// tolerance: with a mesh, as in volume_sample_inside.
/// seed: 0 to 2**64 - 1. The same arguments and seed give the same bytes.
/// threads: 0 for one per core. The samples do not depend on it.
/// progress: called with the fraction that is done, from 0 to 1; if it returns False the call raises Cancelled.
///
/// Returns Points with radii and the report VolumeReport, with the least radius of a sample and the largest on the grid.
#[pyfunction]
#[pyo3(signature = (
    grid_values, *, mesh=None, domain_min=None, domain_max=None, boundary="periodic", tolerance=0.0625, seed=0, threads=0,
    progress=None
))]
pub(crate) fn volume_adaptive_sample(
    py: Python<'_>,
    grid_values: &Bound<'_, PyAny>,
    mesh: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = maybe_triple::domain_min)] domain_min: Option<[f64; 3]>,
    #[pyo3(from_py_with = maybe_triple::domain_max)] domain_max: Option<[f64; 3]>,
    boundary: &str,
    #[pyo3(from_py_with = real::tolerance)] tolerance: f64,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let grid = Array::read("grid_values", grid_values)?;
    let (values, size) = grid.grid()?;
    let (radius, seed) = (Radius::Grid { values, size }, natural("seed", seed)?);
    let watch = Watch::new(py, threads, progress)?;
    let Some(mesh) = mesh else {
        if tolerance != TOLERANCE {
            return Err(invalid("tolerance", format!("{tolerance} has no effect without a mesh")));
        }
        let frame = Frame::new(domain_min, domain_max, boundary)?;
        let request = Options::new(radius).domain(frame.domain).seed(seed);
        let (mut samples, report) = watch.run(|context, progress| adaptive::sample(context, &request, progress))?;
        let radii = std::mem::take(&mut samples.radii);
        return Points::cuboid(py, samples, &frame)?.with_radii(py, radii).with_report(py, VolumeReport::from(report));
    };
    let mesh = taken::mesh(mesh)?;
    for (name, is_given) in [
        ("domain_min", domain_min.is_some()),
        ("domain_max", domain_max.is_some()),
        ("boundary", boundary != "periodic"),
    ] {
        if is_given {
            return Err(invalid(name, "has no effect with a mesh"));
        }
    }
    let request = InsideOptions::new(radius).tolerance(tolerance).seed(seed);
    let (mut samples, report) =
        watch.run(|context, progress| adaptive::sample_inside(context, &mesh.shared, &request, progress))?;
    let radii = std::mem::take(&mut samples.radii);
    Points::solid(py, samples, mesh.shared.origin())?.with_radii(py, radii).with_report(py, VolumeReport::from(report))
}
