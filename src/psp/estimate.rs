//! Estimates of samples, memory and rays, before any work is done.

use crate::error::{Error, Result};
use crate::mesh::{Mesh, exact};
use crate::points::{check_radius, check_resolution};
use crate::psp::fill::measures::{DENSITY, Measures};

/// Peak memory per sample, twice the measured amount (bunny with three million samples: 110 bytes when a fill starts
/// from nothing, 145 with an iteration, the returned samples included): scattered samples take more.
const BYTES_PER_SAMPLE: f64 = 300.0;

/// An iteration is skipped if it would trace more rays than this for each sample that can lie on the surface. Parts far
/// apart in a large box are hit that rarely. (Filling alone is as fast from 5 rays per sample on, measured on dust, and
/// nearly twice as fast with 27; up to there an iteration that was requested is made.)
const RAYS_PER_SAMPLE: f64 = 20.0;
/// An iteration of no more rays than this is never skipped: its cost is negligible.
const RAYS_ALWAYS: f64 = 1e7;

/// Refuses so many samples if they need more memory than there is.
pub(super) fn require_memory(samples: f64, argument: &'static str, what: &str) -> Result<()> {
    crate::memory::require(samples * BYTES_PER_SAMPLE, argument, what)
}

/// Refuses a radius that is out of range on a mesh.
pub(super) fn check_radius_on(mesh: &Mesh, radius: f64) -> Result<()> {
    check_radius(radius)?;
    check_resolution("radius", radius, mesh.float_spacing(), "the largest coordinate of the mesh")
}

/// An upper estimate of the number of samples of a radius. Refuses a radius that is out of range or requires too many.
pub(super) fn checked_estimate(mesh: &Mesh, measures: &Measures, radius: f64) -> Result<f64> {
    check_radius(radius)?;
    let estimate = measures.expected_samples(mesh, radius);
    if estimate > u32::MAX as f64 {
        let reason = format!("{radius:?} asks for about {estimate:.3e} samples; the limit is {}", u32::MAX);
        return Err(Error::too_large("radius", reason));
    }
    check_resolution("radius", radius, mesh.float_spacing(), "the largest coordinate of the mesh")?;
    require_memory(estimate, "radius", &format!("about {estimate:.3e} samples"))?;
    Ok(estimate)
}

/// True if iterations are worth their rays for so many expected samples.
pub(super) fn is_worth_projecting(mesh: &Mesh, radius: f64, samples: f64) -> bool {
    mesh.area() > 0.0 && expected_rays(mesh, radius) <= RAYS_ALWAYS.max(RAYS_PER_SAMPLE * samples)
}

/// The cost of an iteration in rays: one for each pattern point in the projection of the mesh's box, and a sixteenth
/// for each point that has to be examined for them.
///
/// The projections on three orthogonal planes are largest along the diagonals of a cube, sqrt(3) times its three sides.
fn expected_rays(mesh: &Mesh, radius: f64) -> f64 {
    let (low, high) = mesh.bounds();
    let diagonal = exact(high) - exact(low);
    let [a, b, c] = diagonal.to_array();
    let (shadows, projectors) = (3f64.sqrt() * (a * b + b * c + c * a), 3.0 * diagonal.length_squared());
    DENSITY * (shadows + projectors / 16.0) / (radius * radius)
}
