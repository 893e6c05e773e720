//! Three orthogonal projectors for the whole mesh, and the engine that finds their hits (thesis §3.3).

use crate::error::Result;
use crate::host::Stopwatch;
use crate::job::Job;
use crate::mesh::Mesh;
use crate::psp::options::{Engine, ProjectionOptions};
use crate::psp::project::Pass;
use crate::psp::project::candidates::{Candidates, Collector, Projected, merge};
use crate::psp::project::projector::{self, Frame, Projector};
use crate::psp::project::raster::Rasteriser;
use crate::psp::project::rays::Rays;
use crate::psp::report::Report;
use crate::psp::set::SampleSet;

/// A pattern for three orthogonal projectors through the whole mesh.
pub struct GlobalProjection {
    hits: Hits,
    /// The frame of the last iteration.
    pub frame: Option<Frame>,
}

/// The engine that finds the hits.
enum Hits {
    Embree(Rays),
    Rasteriser(Rasteriser),
}

impl GlobalProjection {
    pub fn new(job: &Job, mesh: &Mesh, options: &ProjectionOptions) -> Result<Self> {
        let ProjectionOptions { radius, seed, .. } = *options;
        let hits = match options.engine.of_global() {
            Engine::Embree => Hits::Embree(Rays::new(job, mesh, radius, seed)?),
            _ => Hits::Rasteriser(Rasteriser::new(job, mesh, radius, seed)?),
        };
        Ok(Self { hits, frame: None })
    }

    /// Collects all hits of three projectors, by cubes.
    pub fn project(&self, job: &Job, projectors: &[Projector; 3], collector: &Collector) -> Result<Candidates> {
        match &self.hits {
            Hits::Embree(rays) => rays.project(job, projectors, collector),
            Hits::Rasteriser(rasteriser) => rasteriser.project(job, projectors, collector),
        }
    }

    /// Makes an iteration.
    pub fn advance(
        &mut self,
        job: &Job,
        pass: &Pass,
        samples: &mut SampleSet,
        report: &mut Report,
    ) -> Result<Projected> {
        let mut stage = Stopwatch::start();
        let &ProjectionOptions { seed, priority, .. } = pass.options;
        let frame = projector::frame(seed, pass.iteration, self.frame);
        let projectors = &Projector::all(frame, seed, pass.iteration);
        let collector = Collector { mesh: pass.mesh, samples, priority, projectors };
        let (candidates, projected) = self.project(&job.part(0.0, 0.6), projectors, &collector)?;
        report.project_seconds += stage.lap();
        merge(&job.part(0.6, 1.0), pass.given, samples, &candidates)?;
        report.merge_seconds += stage.lap();
        self.frame = Some(frame);
        Ok(projected)
    }
}
