//! Maximal sets on meshes whose radius varies, and densities of meshes.

use azulejo_core::Order;
use azulejo_core::psp::DEFAULT_QUOTIENT;
use azulejo_core::psp::adaptive::{self, Density, Radius, Scale, Texture};
use pyo3::prelude::*;

use crate::argument::{amount, callable, maybe_real, natural, order, whole};
use crate::array::{Array, GivenArrays, optional};
use crate::error::invalid;
use crate::mesh::Mesh;
use crate::points::Points;
use crate::psp::PspReport;
use crate::taken;
use crate::watch::Watch;

/// The arguments that both adaptive calls share.
struct Adaptive<'py> {
    order: Order,
    quotient: Option<f64>,
    seed: u64,
    cosine: f64,
    given: GivenArrays<'py, 3>,
    watch: Watch<'py>,
}

impl Adaptive<'_> {
    fn sample(self, py: Python<'_>, mesh: &Mesh, radius: Radius) -> PyResult<Points> {
        let Self { order, quotient, seed, cosine, given, watch } = self;
        let request = adaptive::Options::new(radius)
            .order(order)
            .quotient(quotient.unwrap_or(DEFAULT_QUOTIENT))
            .cosine(cosine)
            .seed(seed)
            .given(given.samples()?);
        let (set, report) =
            watch.run(|context, progress| adaptive::sample(context, &mesh.shared, &request, progress))?;
        Points::adaptive(py, set, mesh.shared.origin())?.with_report(py, PspReport::from(report))
    }
}

/// A maximal set on a mesh whose radius varies: two samples are at least the mean of their radii apart.
///
/// vertex_radii: float32, shape (v,), above 0, in the units of the mesh: the radius at each vertex, interpolated on the
///     triangles.
/// order: "any", or "progressive": every prefix is well spread, and the points have ranks, what the radii are multiplied
///     by for the points up to each.
/// given_clearances: float64, shape (m,), needed where samples are given. The others are those of psp_sample.
///
/// Returns Points with radii and the report PspReport.
#[pyfunction]
#[pyo3(signature = (
    mesh, vertex_radii, *, order="any", quotient=None, seed=0, given_positions=None, given_clearances=None, cosine=None,
    threads=0, progress=None
))]
pub(crate) fn psp_adaptive_sample(
    py: Python<'_>,
    #[pyo3(from_py_with = taken::mesh)] mesh: Mesh,
    vertex_radii: &Bound<'_, PyAny>,
    order: &str,
    #[pyo3(from_py_with = maybe_real::quotient)] quotient: Option<f64>,
    #[pyo3(from_py_with = whole::seed)] seed: i128,
    given_positions: Option<&Bound<'_, PyAny>>,
    given_clearances: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = maybe_real::cosine)] cosine: Option<f64>,
    #[pyo3(from_py_with = whole::threads)] threads: i128,
    #[pyo3(from_py_with = callable::progress)] progress: Option<Py<PyAny>>,
) -> PyResult<Points> {
    let radii = Array::read("vertex_radii", vertex_radii)?;
    let given = GivenArrays::read(given_positions, given_clearances, mesh.shared.origin())?;
    let watch = Watch::new(py, threads, progress)?;
    let order = self::order(order, &[("quotient", quotient)])?;
    let request =
        Adaptive { order, quotient, seed: natural("seed", seed)?, cosine: cosine.unwrap_or(-1.0), given, watch };
    request.sample(py, &mesh, Radius::PerVertex(per_vertex("vertex_radii", &radii, &mesh)?))
}

/// A maximal set on a mesh whose density varies: the radius at a place follows from the density there.
///
/// density: in any unit, 0 or above, float32: shape (v,) for the vertices, interpolated on the triangles, or, with
///     texture, an image of shape (height, width), whose first row lies along v = 0.
/// radius: that of a density of 1, in the units of the mesh. Or:
/// count: about how many samples the whole set has, exactly in progressive order.
/// order: "any", or "progressive": every prefix is well spread, and the points have ranks, radii at density 1. Sets of
///     smaller counts are prefixes, but for their radii.
/// texture: texture coordinates, float32, shape (v, 2) for vertices or (t, 3, 2) for the corners of triangles.
/// The others are those of psp_adaptive_sample.
///
/// Returns Points with radii and the report PspReport.
#[pyfunction]
#[pyo3(signature = (
    mesh, density, *, radius=0.0, count=0.0, texture=None, order="any", quotient=None, seed=0, given_positions=None,
    given_clearances=None, cosine=None, threads=0, progress=None
))]
pub(crate) fn psp_adaptive_with_density(
    py: Python<'_>,
    #[pyo3(from_py_with = taken::mesh)] mesh: Mesh,
    density: &Bound<'_, PyAny>,
    #[pyo3(from_py_with = amount::radius)] radius: f64,
    #[pyo3(from_py_with = amount::count)] count: f64,
    texture: Option<&Bound<'_, PyAny>>,
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
    let given = GivenArrays::read(given_positions, given_clearances, mesh.shared.origin())?;
    let watch = Watch::new(py, threads, progress)?;
    let order = self::order(order, &[("quotient", quotient)])?;
    let request =
        Adaptive { order, quotient, seed: natural("seed", seed)?, cosine: cosine.unwrap_or(-1.0), given, watch };
    request.sample(py, &mesh, density.radius(&mesh)?)
}

/// The arguments `density` and `texture`.
pub(crate) struct DensityArrays<'py> {
    values: Array<'py, f32>,
    texture: Option<Array<'py, f32>>,
}

impl<'py> DensityArrays<'py> {
    pub(crate) fn read(density: &Bound<'py, PyAny>, texture: Option<&Bound<'py, PyAny>>) -> PyResult<Self> {
        Ok(Self { values: Array::read("density", density)?, texture: optional("texture", texture)? })
    }

    /// The density on the mesh.
    pub(crate) fn of(&self, mesh: &Mesh) -> PyResult<Density<'_>> {
        Ok(match &self.texture {
            None => Density::PerVertex(per_vertex("density", &self.values, mesh)?),
            Some(texture) => {
                let (values, [width, height]) = self.values.image()?;
                Density::Image { values, width, height, texture: places(texture)? }
            }
        })
    }
}

/// The arguments `density`, `texture`, `radius` and `count`.
pub(crate) struct MeshDensity<'py> {
    arrays: DensityArrays<'py>,
    scale: Scale,
}

impl<'py> MeshDensity<'py> {
    pub(crate) fn read(
        density: &Bound<'py, PyAny>,
        texture: Option<&Bound<'py, PyAny>>,
        radius: f64,
        count: f64,
    ) -> PyResult<Self> {
        let scale = match (radius == 0.0, count == 0.0) {
            (false, true) => Scale::Radius(radius),
            (true, false) => Scale::Count(count),
            _ => return Err(invalid("radius", "one of radius and count is needed, and not both")),
        };
        Ok(Self { arrays: DensityArrays::read(density, texture)?, scale })
    }

    /// The radius on the mesh that follows from the density.
    pub(crate) fn radius(&self, mesh: &Mesh) -> PyResult<Radius<'_>> {
        Ok(Radius::Density { density: self.arrays.of(mesh)?, scale: self.scale })
    }
}

/// Values of the vertices.
fn per_vertex<'a>(argument: &str, values: &'a Array<'_, f32>, mesh: &Mesh) -> PyResult<&'a [f32]> {
    let (values, vertices) = (values.line()?, mesh.shared.positions().len());
    if values.len() != vertices {
        return Err(invalid(argument, format!("{} numbers for {vertices} vertices", values.len())));
    }
    Ok(values)
}

fn places<'a>(texture: &'a Array<'_, f32>) -> PyResult<Texture<'a>> {
    match texture.shape() {
        [_, 3, 2] => Ok(Texture::PerCorner(texture.entries().as_chunks().0.as_chunks().0)),
        _ => Ok(Texture::PerVertex(texture.rows()?)),
    }
}
