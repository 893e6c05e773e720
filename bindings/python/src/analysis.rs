//! Measures of any point set.

use azulejo_core::analysis::coverage::{self, Coverage};
use azulejo_core::analysis::distribution::{radial_distribution, radial_distribution_3d};
use azulejo_core::analysis::figures::{Figures, figures_2d};
use azulejo_core::analysis::space::{SpaceFigures, figures_3d};
use azulejo_core::analysis::spacing::{self, nearest_distances_2d, nearest_histogram_2d, spacing_2d};
use azulejo_core::{Context, Domain, Error, Progress};
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::argument::{callable, maybe_pair, maybe_triple, natural, real, whole};
use crate::array::line;
use crate::frame::{Frame, Positions, Rows};
use crate::mesh::Mesh;
use crate::points::Place;
use crate::report::report;
use crate::taken;
use crate::watch::Watch;

/// Points in their domain.
pub(crate) struct MeasuredSet<'py, const N: usize> {
    positions: Rows<'py, N>,
    pub(crate) frame: Frame<N>,
}

/// Points of the plane in their domain.
pub(crate) type PlaneSet<'py> = MeasuredSet<'py, 2>;

/// Points of a cuboid.
pub(crate) type SpaceSet<'py> = MeasuredSet<'py, 3>;

impl<'py> PlaneSet<'py> {
    pub(crate) fn read(
        positions: &Bound<'py, PyAny>,
        min: Option<[f64; 2]>,
        max: Option<[f64; 2]>,
        boundary: Option<&str>,
    ) -> PyResult<Self> {
        let positions = Positions::read("positions", positions)?;
        let frame = Frame::around(&positions, Place::plane, min, max, boundary)?;
        Ok(Self { positions: positions.around(frame.origin)?, frame })
    }
}

impl<'py> SpaceSet<'py> {
    pub(crate) fn in_space(
        positions: &Bound<'py, PyAny>,
        min: Option<[f64; 3]>,
        max: Option<[f64; 3]>,
        boundary: Option<&str>,
    ) -> PyResult<Self> {
        let positions = Positions::read("positions", positions)?;
        let frame = Frame::around(&positions, Place::cuboid, min, max, boundary)?;
        Ok(Self { positions: positions.around(frame.origin)?, frame })
    }
}

impl<const N: usize> MeasuredSet<'_, N> {
    /// The points, relative to the origin of the frame.
    pub(crate) fn points(&self) -> PyResult<&[[f32; N]]> {
        self.positions.get()
    }

    pub(crate) fn run<T: Send>(
        &self,
        watch: Watch,
        call: impl FnOnce(&Context, &Domain<N>, &[[f32; N]], Option<&Progress>) -> Result<T, Error> + Send,
    ) -> PyResult<T> {
        let (points, domain) = (self.points()?, &self.frame.domain);
        watch.run(|context, progress| call(context, domain, points, progress))
    }
}

/// The smallest distance of two points of the plane; infinite for less than two.
///
/// positions: the points, float32, shape (n, 2), in domain_min <= x < domain_max.
/// domain_min, domain_max: the corners of the domain, two numbers each.
/// boundary: "periodic" (distances wrap around) or "bounded".
///     Of positions that are Points the default is their own domain; of arrays it is the periodic unit square.
/// threads: 0 for one per core.
/// progress: called with the fraction that is done, from 0 to 1; if it returns False the call raises Cancelled.
#[pyfunction]
#[pyo3(signature = (
    positions, *, domain_min=None, domain_max=None, boundary=None, threads=0, progress=None
))]
pub(crate) fn plane_smallest_distance(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
    #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
    boundary: Option<&str>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<f64> {
    PlaneSet::read(positions, domain_min, domain_max, boundary)?
        .run(Watch::new(py, threads, progress)?, spacing::smallest_distance_2d)
}

/// The covering radius of points of the plane: the distance of the place that is farthest from all of them, found exactly
/// by the Voronoi diagram. The arguments are those of plane_smallest_distance.
#[pyfunction]
#[pyo3(signature = (
    positions, *, domain_min=None, domain_max=None, boundary=None, threads=0, progress=None
))]
pub(crate) fn plane_covering_radius(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
    #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
    boundary: Option<&str>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<f64> {
    PlaneSet::read(positions, domain_min, domain_max, boundary)?
        .run(Watch::new(py, threads, progress)?, coverage::covering_radius_2d)
}

/// The smallest distance of two points of space; infinite for less than two.
///
/// positions: float32, shape (n, 3). threads, progress: as in plane_smallest_distance.
#[pyfunction]
#[pyo3(signature = (positions, *, threads=0, progress=None))]
pub(crate) fn space_smallest_distance(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<f64> {
    let (positions, ..) = Positions::read("positions", positions)?.centred()?;
    let points = positions.get()?;
    Watch::new(py, threads, progress)?.run(|context, progress| spacing::smallest_distance_3d(context, points, progress))
}

report! {
    /// The covering radius and the gaps of a set.
    CoverageReport {
        /// The distance of the place that is farthest from all samples.
        covering_radius: f64,
        /// The number of gaps: 0 for a set that is maximal, up to the rounding of floats.
        gaps: usize,
    }
}

impl From<Coverage> for CoverageReport {
    fn from(Coverage { farthest, gaps, .. }: Coverage) -> Self {
        Self { covering_radius: farthest, gaps }
    }
}

/// Counts the gaps that points of the plane leave: the connected parts of the domain that are farther than a radius from
/// all points, by more than 6 float spacings at its largest coordinate.
///
/// radius: above 0, in the units of the domain. The others are those of plane_smallest_distance.
///
/// Returns a CoverageReport.
#[pyfunction]
#[pyo3(signature = (
    positions, radius, *, domain_min=None, domain_max=None, boundary=None, threads=0, progress=None
))]
pub(crate) fn plane_coverage(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = real::radius)] radius: f64,
    #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
    #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
    boundary: Option<&str>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<CoverageReport> {
    let set = PlaneSet::read(positions, domain_min, domain_max, boundary)?;
    let coverage = set.run(Watch::new(py, threads, progress)?, |context, domain, points, progress| {
        coverage::coverage_2d(context, domain, points, radius, progress)
    })?;
    Ok(coverage.into())
}

/// Counts the gaps that points of a cuboid leave, beyond 6 float spacings at its largest coordinate, and finds the covering
/// radius. Uncovered places that are within half of the radius of each other are of one gap.
///
/// positions: the points, float32, shape (n, 3), in domain_min <= x < domain_max. radius: above 0, in the units of the domain.
/// domain_min, domain_max: the corners of the domain, three numbers each.
/// boundary: "periodic" (distances wrap around) or "bounded".
///     Of positions that are Points the default is their own domain; of arrays it is the periodic unit cube.
/// threads, progress: as in plane_smallest_distance.
///
/// Returns a CoverageReport.
#[pyfunction]
#[pyo3(signature = (
    positions, radius, *, domain_min=None, domain_max=None, boundary=None, threads=0, progress=None
))]
pub(crate) fn space_coverage(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = real::radius)] radius: f64,
    #[pyo3(from_py_with = maybe_triple::domain_min)] domain_min: Option<[f64; 3]>,
    #[pyo3(from_py_with = maybe_triple::domain_max)] domain_max: Option<[f64; 3]>,
    boundary: Option<&str>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<CoverageReport> {
    let set = MeasuredSet::in_space(positions, domain_min, domain_max, boundary)?;
    let coverage = set.run(Watch::new(py, threads, progress)?, |context, domain, points, progress| {
        coverage::coverage_3d(context, domain, points, radius, progress)
    })?;
    Ok(coverage.into())
}

report! {
    /// Spacing, conflicts and covering radius of points of a cuboid.
    SpaceReport {
        /// The number of points.
        count: usize,
        /// The smallest distance of two points.
        smallest_distance: f64,
        /// The mean distance of a point to its nearest neighbour.
        mean_distance: f64,
        /// The number of pairs of points that are nearer to each other than the radius.
        conflicts: u64,
        /// The distance of neighbours if as many points stood in the densest packing.
        packed_distance: f64,
        /// The smallest distance in units of packed_distance.
        rho: f64,
        /// The distance of the place that is farthest from all points.
        covering_radius: f64,
        /// The covering radius in units of packed_distance.
        relative_covering_radius: f64,
    }
}

impl From<SpaceFigures> for SpaceReport {
    fn from(figures: SpaceFigures) -> Self {
        Self {
            count: figures.count,
            smallest_distance: figures.smallest,
            mean_distance: figures.mean,
            conflicts: figures.conflicts,
            packed_distance: figures.packed,
            rho: figures.rho(),
            covering_radius: figures.covering_radius,
            relative_covering_radius: figures.relative_covering_radius(),
        }
    }
}

/// Measures points of a cuboid: spacing, conflicts and covering radius.
///
/// radius: pairs of points that are nearer are conflicts; 0 counts none. The others are those of space_coverage.
///
/// Returns a SpaceReport.
#[pyfunction]
#[pyo3(signature = (
    positions, radius=0.0, *, domain_min=None, domain_max=None, boundary=None, threads=0, progress=None
))]
pub(crate) fn space_measure(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = real::radius)] radius: f64,
    #[pyo3(from_py_with = maybe_triple::domain_min)] domain_min: Option<[f64; 3]>,
    #[pyo3(from_py_with = maybe_triple::domain_max)] domain_max: Option<[f64; 3]>,
    boundary: Option<&str>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<SpaceReport> {
    let set = MeasuredSet::in_space(positions, domain_min, domain_max, boundary)?;
    let figures = set.run(Watch::new(py, threads, progress)?, |context, domain, points, progress| {
        figures_3d(context, domain, points, radius, progress)
    })?;
    Ok(figures.into())
}

/// Counts the gaps that samples leave on a mesh, by straight distance and beyond 6 float spacings at its largest
/// coordinate, and finds the covering radius.
///
/// mesh: a Mesh. positions: the samples, float32, shape (n, 3). radius: above 0, in the units of the mesh.
/// threads, progress: as in plane_smallest_distance.
///
/// Returns a CoverageReport.
#[pyfunction]
#[pyo3(signature = (mesh, positions, radius, *, threads=0, progress=None))]
pub(crate) fn mesh_coverage(
    py: Python<'_>,
    #[pyo3(from_py_with = taken::mesh)] mesh: Mesh,
    positions: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = real::radius)] radius: f64,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<CoverageReport> {
    let positions = Positions::read("positions", positions)?.around(mesh.shared.origin())?;
    let points = positions.get()?;
    let coverage = Watch::new(py, threads, progress)?
        .run(|context, progress| coverage::surface_coverage(context, &mesh.shared, points, radius, progress))?;
    Ok(coverage.into())
}

/// The share of random points of a mesh that is farther than a radius from all samples: fast, but no proof of coverage.
///
/// probes: the number of random points. seed: 0 to 2**64 - 1. The others are those of mesh_coverage.
#[pyfunction]
#[pyo3(signature = (mesh, positions, radius, *, probes=100000, seed=0, threads=0, progress=None))]
pub(crate) fn mesh_uncovered_fraction(
    py: Python<'_>,
    #[pyo3(from_py_with = taken::mesh)] mesh: Mesh,
    positions: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = real::radius)] radius: f64,
    #[pyo3(from_py_with = whole::probes)] probes: i128,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<f64> {
    let positions = Positions::read("positions", positions)?.around(mesh.shared.origin())?;
    let points = positions.get()?;
    let (probes, seed) = (natural("probes", probes)?, natural("seed", seed)?);
    Watch::new(py, threads, progress)?.run(|context, progress| {
        coverage::surface_uncovered_fraction(context, &mesh.shared, points, radius, probes, seed, progress)
    })
}

report! {
    /// Spacing, order and triangles of points of the plane.
    PlaneReport {
        /// The number of points.
        count: usize,
        /// The smallest distance of two points.
        smallest_distance: f64,
        /// The mean distance of a point to its nearest neighbour.
        mean_distance: f64,
        /// d_max, the distance of neighbours if as many points stood in hexagonal order.
        hexagonal_distance: f64,
        /// The smallest distance in units of d_max.
        rho: f64,
        /// The distance of the place that is farthest from all points.
        covering_radius: f64,
        /// The bond order psi6: 1 for a hexagonal lattice.
        bond_order: f64,
        /// The number of Delaunay triangles.
        triangles: u64,
        /// The share of them that is obtuse.
        obtuse: f64,
        /// The share of them whose smallest angle is below 30 degrees.
        below_30_degrees: f64,
        /// The share of all angles that is below 30 degrees.
        angles_below_30_degrees: f64,
        /// The mean length of their edges.
        edge_mean: f64,
        /// The variance of the lengths over their squared mean.
        edge_variation: f64,
        /// The variance of the areas over their squared mean.
        area_variation: f64,
        /// The share of triangles whose area is farther than 4 standard deviations from the mean.
        beyond_4_sigma: f64,
    }
}

/// Measures points of the plane: spacing, covering radius, bond order and Delaunay triangles.
///
/// The arguments are those of plane_smallest_distance. Returns a PlaneReport.
#[pyfunction]
#[pyo3(signature = (
    positions, *, domain_min=None, domain_max=None, boundary=None, threads=0, progress=None
))]
pub(crate) fn plane_measure(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
    #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
    boundary: Option<&str>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<PlaneReport> {
    let set = PlaneSet::read(positions, domain_min, domain_max, boundary)?;
    let Figures { nearest, covering_radius, bond_order, triangles, .. } =
        set.run(Watch::new(py, threads, progress)?, figures_2d)?;
    let spacing = spacing_2d(&set.frame.domain, &nearest);
    Ok(PlaneReport {
        count: nearest.len(),
        smallest_distance: spacing.smallest,
        mean_distance: spacing.mean,
        hexagonal_distance: spacing.hexagonal,
        rho: if nearest.is_empty() { f64::INFINITY } else { spacing.smallest / spacing.hexagonal },
        covering_radius,
        bond_order,
        triangles: triangles.triangles,
        obtuse: triangles.obtuse,
        below_30_degrees: triangles.below_30_degrees,
        angles_below_30_degrees: triangles.angles_below_30_degrees,
        edge_mean: triangles.edge_mean,
        edge_variation: triangles.edge_variation,
        area_variation: triangles.area_variation,
        beyond_4_sigma: triangles.beyond_4_sigma,
    })
}

/// The histogram of the distances of points of the plane to their nearest neighbours.
///
/// reach: where the last bin ends, above 0, in units of d_max. bins: their number, 1 to 65536.
/// The others are those of plane_smallest_distance.
///
/// Returns uint64, shape (bins,).
#[pyfunction]
#[pyo3(signature = (
    positions, reach, bins, *, domain_min=None, domain_max=None, boundary=None, threads=0, progress=None
))]
pub(crate) fn plane_nearest_histogram(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = real::reach)] reach: f64,
    #[pyo3(from_py_with = whole::bins)] bins: i128,
    #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
    #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
    boundary: Option<&str>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Py<PyArray1<u64>>> {
    let set = PlaneSet::read(positions, domain_min, domain_max, boundary)?;
    let bins = natural("bins", bins)?;
    let histogram = set.run(Watch::new(py, threads, progress)?, |context, domain, points, progress| {
        // Bad bins are refused before any work.
        nearest_histogram_2d(domain, &[], reach, bins)?;
        let nearest = nearest_distances_2d(context, domain, points, progress)?;
        nearest_histogram_2d(domain, &nearest, reach, bins)
    })?;
    Ok(line(py, histogram))
}

/// The radial distribution function of points of the plane, also called pair correlation: the density of other points at a
/// distance from a point, over the mean density. 1 for a Poisson process.
///
/// positions: at least 2 points.
/// reach: where the last bin ends, in units of d_max, at most half of the domain's width or height.
/// bins: their number, 1 to 65536. The others are those of plane_smallest_distance.
///
/// Returns float64, shape (bins,).
#[pyfunction]
#[pyo3(signature = (
    positions, reach, bins, *, domain_min=None, domain_max=None, boundary=None, threads=0, progress=None
))]
pub(crate) fn plane_radial_distribution(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = real::reach)] reach: f64,
    #[pyo3(from_py_with = whole::bins)] bins: i128,
    #[pyo3(from_py_with = maybe_pair::domain_min)] domain_min: Option<[f64; 2]>,
    #[pyo3(from_py_with = maybe_pair::domain_max)] domain_max: Option<[f64; 2]>,
    boundary: Option<&str>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Py<PyArray1<f64>>> {
    let set = PlaneSet::read(positions, domain_min, domain_max, boundary)?;
    let bins = natural("bins", bins)?;
    let distribution = set.run(Watch::new(py, threads, progress)?, |context, domain, points, progress| {
        radial_distribution(context, domain, points, reach, bins, progress)
    })?;
    Ok(line(py, distribution.density()))
}

/// The radial distribution function of points of a cuboid, in units of packed_distance.
///
/// positions: at least 2 points.
/// reach: where the last bin ends, at most half of the shortest side of the cuboid.
/// bins: their number, 1 to 65536. The others are those of space_coverage.
///
/// Returns float64, shape (bins,).
#[pyfunction]
#[pyo3(signature = (
    positions, reach, bins, *, domain_min=None, domain_max=None, boundary=None, threads=0, progress=None
))]
pub(crate) fn space_radial_distribution(
    py: Python<'_>,
    positions: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = real::reach)] reach: f64,
    #[pyo3(from_py_with = whole::bins)] bins: i128,
    #[pyo3(from_py_with = maybe_triple::domain_min)] domain_min: Option<[f64; 3]>,
    #[pyo3(from_py_with = maybe_triple::domain_max)] domain_max: Option<[f64; 3]>,
    boundary: Option<&str>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Py<PyArray1<f64>>> {
    let set = MeasuredSet::in_space(positions, domain_min, domain_max, boundary)?;
    let bins = natural("bins", bins)?;
    let distribution = set.run(Watch::new(py, threads, progress)?, |context, domain, points, progress| {
        radial_distribution_3d(context, domain, points, reach, bins, progress)
    })?;
    Ok(line(py, distribution.density()))
}
