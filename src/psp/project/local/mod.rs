//! Local projectors: the projection of thesis §3.3 made local by the idea of §3.4, which divides, conquers and merges.
//!
//! The surface is divided into blocks, cubes of space, and each of them into charts, cones of normals (`charts.rs`). Each
//! chart has a plane with a turn and an offset of its own into one of two planar maximal patterns (`torus.rs`), whose points are
//! projected along the axis of the chart (`projector.rs`, `block.rs`). Within a chart nothing is to be merged: hits are as
//! far apart as their points on the plane, at least. So only candidates near another chart or block are tested
//! (`choice.rs`, `near.rs`).
//!
//! Departs from the thesis, which projects three patterns through the whole mesh: there every place is seen three times,
//! mostly at a slant, and everything has to be merged.

mod block;
mod charts;
mod choice;
#[cfg(test)]
mod engines;
mod near;
mod projector;
#[cfg(test)]
mod tests;
mod torus;

use std::sync::Arc;

use crate::error::Result;
use crate::job::Job;
use crate::mesh::Mesh;
use crate::psp::fill::Blocks;
use crate::psp::options::{Engine, ProjectionOptions};
use crate::psp::project::Pass;
use crate::psp::project::candidates::Projected;
use crate::psp::project::local::choice::choose;
use crate::psp::project::local::torus::{PATTERNS, Torus};
use crate::psp::project::rays::TraceSpace;
use crate::psp::set::{Sample, SampleSet};

/// The side of a block in cubes of a set.
const CUBES: f64 = 2.0;

/// The patterns of local projectors, and the mesh for rays if these are the engine.
pub struct LocalProjection {
    tori: Arc<[Torus; PATTERNS]>,
    space: Option<Arc<TraceSpace>>,
}

impl LocalProjection {
    pub fn new(job: &Job, mesh: &Mesh, options: &ProjectionOptions) -> Result<Self> {
        let space = match options.engine {
            Engine::Embree => Some(TraceSpace::of(&job.part(0.0, 0.7), mesh)?),
            Engine::Rasteriser | Engine::Auto => None,
        };
        Ok(Self { tori: Torus::kept(&job.part(0.7, 1.0))?, space })
    }

    /// Projects the pattern, and adds what conflicts with nothing that was there or comes first.
    pub fn advance(&self, job: &Job, pass: &Pass, samples: &mut SampleSet) -> Result<Projected> {
        let given = pass.given.alike();
        let shift = projector::shift_of_blocks(pass.options.seed, pass.iteration);
        // Given samples of the same radius keep others away like the set's own.
        let mut wide = samples.widened(CUBES, shift, given.iter().map(|&position| Sample::at(position)));
        let blocks = Blocks::new(&job.part(0.0, 0.1), pass.mesh, pass.measures, &wide, None)?;
        let choose = |number: usize, set: &SampleSet| {
            let block = blocks.block(pass.measures, number);
            Ok(choose(pass, &block, set, &self.tori[..], self.space.as_deref()))
        };
        let projected = wide.grow(&job.part(0.1, 1.0), &blocks.cubes, choose)?;
        samples.append(&mut wide.into_samples().split_off(given.len() + samples.len()));
        Ok(projected)
    }
}
