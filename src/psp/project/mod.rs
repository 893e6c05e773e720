//! Progressive sample projection (thesis chapter 3): the pattern, the projectors, the engine that finds their hits,
//! ready for a mesh and a radius, and the choice among the candidates.
//!
//! Projectors are local (`local/`) or global (`global.rs`). The engines are Embree's ray packets (`rays.rs`) and a
//! rasteriser (`raster.rs`, `local/block.rs`).

pub mod candidates;
pub mod global;
pub mod local;
mod pattern;
pub mod projector;
mod raster;
mod rays;
mod rule;
#[cfg(test)]
mod tests;

pub use rule::is_sooner_projected;

use crate::error::Result;
use crate::host::Stopwatch;
use crate::job::Job;
use crate::mesh::{Mesh, exact};
use crate::psp::fill::{DENSITY, Measures};
use crate::psp::given::GivenSamples;
use crate::psp::options::{ProjectionOptions, Projectors};
use crate::psp::project::candidates::Projected;
use crate::psp::project::global::GlobalProjection;
use crate::psp::project::local::LocalProjection;
use crate::psp::report::Report;
use crate::psp::set::SampleSet;

/// An iteration over a surface.
pub struct Pass<'a> {
    pub mesh: &'a Mesh,
    pub measures: &'a Measures,
    pub given: &'a GivenSamples,
    pub options: &'a ProjectionOptions<'static>,
    /// The number of iterations before.
    pub iteration: u32,
}

/// A pattern, ready to be projected onto a mesh.
pub enum Projection {
    Local(LocalProjection),
    Global(GlobalProjection),
}

impl Projection {
    /// Makes the pattern, and prepares the mesh for the engine.
    pub fn new(job: &Job, mesh: &Mesh, options: &ProjectionOptions) -> Result<Self> {
        Ok(match options.projectors {
            Projectors::Local => Self::Local(LocalProjection::new(job, mesh, options)?),
            Projectors::Global => Self::Global(GlobalProjection::new(job, mesh, options)?),
        })
    }

    /// Makes an iteration: adds those of its hits that conflict with nothing that was there or comes first.
    ///
    /// A failed or cancelled job adds nothing.
    pub fn advance(&mut self, job: &Job, pass: &Pass, samples: &mut SampleSet, report: &mut Report) -> Result<()> {
        let before = samples.len();
        let Projected { rays, hits, restart_conflicts } = match self {
            Self::Local(local) => {
                let stage = Stopwatch::start();
                let projected = local.advance(job, pass, samples)?;
                report.project_seconds += stage.seconds();
                projected
            }
            Self::Global(global) => global.advance(job, pass, samples, report)?,
        };
        let accepted = (samples.len() - before) as u64;
        report.iterations += 1;
        report.accepted += accepted;
        report.rays += rays;
        report.hits += hits;
        report.restart_conflicts += restart_conflicts;
        report.conflicts += hits - restart_conflicts - accepted;
        Ok(())
    }
}

/// An iteration of global projectors is skipped if it would trace more rays than this for each sample that can lie on the
/// surface. Parts far apart in a large box are hit that rarely. (Filling alone is as fast from 5 rays per sample on,
/// measured on dust, and nearly twice as fast with 27; up to there an iteration that was requested is made.)
const RAYS_PER_SAMPLE: f64 = 20.0;
/// An iteration of no more rays than this is never skipped: its cost is negligible.
const RAYS_ALWAYS: f64 = 1e7;

/// True if iterations are worth their rays for so many expected samples.
pub fn is_worth_projecting(mesh: &Mesh, options: &ProjectionOptions, samples: f64) -> bool {
    let has_few_rays = || expected_rays(mesh, options.radius) <= RAYS_ALWAYS.max(RAYS_PER_SAMPLE * samples);
    mesh.area() > 0.0 && (options.projectors == Projectors::Local || has_few_rays())
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
