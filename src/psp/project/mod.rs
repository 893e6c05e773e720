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
use crate::mesh::Mesh;
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
