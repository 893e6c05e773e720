//! The engine that finds the hits of the projectors, ready for a mesh and a radius: Embree's ray packets (`rays.rs`) or a
//! rasteriser (`raster/`).

use crate::error::Result;
use crate::job::Job;
use crate::mesh::Mesh;
use crate::psp::options::{Engine, ProjectionOptions};
use crate::psp::project::collector::{Collector, Found};
use crate::psp::project::projector::Projector;
use crate::psp::project::raster::Rasteriser;
use crate::psp::project::rays::Rays;

/// A pattern, and what finds its hits on a mesh.
pub(in crate::psp) enum Projection {
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
    pub fn project(&self, job: &Job, projectors: &[Projector; 3], collector: &Collector) -> Result<Found> {
        match self {
            Self::Embree(rays) => rays.project(job, projectors, collector),
            Self::Rasteriser(rasteriser) => rasteriser.project(job, projectors, collector),
        }
    }
}
