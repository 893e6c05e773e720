//! Progressive sample projection (thesis chapter 3): the pattern, the projectors, the engine that finds their hits,
//! ready for a mesh and a radius, and the choice among the candidates.
//!
//! The engines are Embree's ray packets (`rays.rs`) and a rasteriser (`raster.rs`).

pub mod candidates;
mod pattern;
pub mod projector;
mod raster;
mod rays;
#[cfg(test)]
mod tests;

use crate::error::Result;
use crate::job::Job;
use crate::mesh::{Mesh, exact};
use crate::psp::fill::DENSITY;
use crate::psp::options::{Engine, ProjectionOptions};
use crate::psp::project::candidates::{Candidates, Collector};
use crate::psp::project::projector::Projector;
use crate::psp::project::raster::Rasteriser;
use crate::psp::project::rays::Rays;

/// A pattern, and the engine that finds its hits on a mesh.
pub enum Projection {
    Embree(Rays),
    Rasteriser(Rasteriser),
}

impl Projection {
    /// Makes the pattern, and prepares the mesh for the engine.
    pub fn new(job: &Job, mesh: &Mesh, options: &ProjectionOptions) -> Result<Self> {
        let ProjectionOptions { radius, seed, .. } = *options;
        Ok(match options.engine {
            Engine::Embree => Self::Embree(Rays::new(job, mesh, radius, seed)?),
            Engine::Rasteriser => Self::Rasteriser(Rasteriser::new(job, mesh, radius, seed)?),
        })
    }

    /// Collects all hits of three projectors, by cubes.
    pub fn project(&self, job: &Job, projectors: &[Projector; 3], collector: &Collector) -> Result<Candidates> {
        match self {
            Self::Embree(rays) => rays.project(job, projectors, collector),
            Self::Rasteriser(rasteriser) => rasteriser.project(job, projectors, collector),
        }
    }
}

/// An iteration is skipped if it would trace more rays than this for each sample that can lie on the surface. Parts far
/// apart in a large box are hit that rarely. (Filling alone is as fast from 5 rays per sample on, measured on dust, and
/// nearly twice as fast with 27; up to there an iteration that was requested is made.)
const RAYS_PER_SAMPLE: f64 = 20.0;
/// An iteration of no more rays than this is never skipped: its cost is negligible.
const RAYS_ALWAYS: f64 = 1e7;

/// True if iterations are worth their rays for so many expected samples.
pub fn is_worth_projecting(mesh: &Mesh, radius: f64, samples: f64) -> bool {
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
