//! Local projectors: the projection of thesis §3.3 made local by the idea of §3.4, which divides, conquers and merges.
//!
//! The surface is divided into blocks, cubes of space, and each of them into charts, cones of normals (`charts.rs`). Each
//! chart has a plane with a turn and an offset of its own into one planar maximal pattern (`torus.rs`), whose points are
//! projected along the axis of the chart (`projector.rs`, `block.rs`). Within a chart nothing is to be merged: distances
//! on the plane are kept. So only candidates near another chart or block are tested (`near.rs`); the larger charts come
//! first.
//!
//! Departs from the thesis, which projects three patterns through the whole mesh: there every place is seen three times,
//! mostly at a slant, and everything has to be merged.

mod block;
mod charts;
mod near;
mod projector;
#[cfg(test)]
mod tests;
mod torus;

use std::sync::Arc;

use crate::error::Result;
use crate::job::Job;
use crate::mesh::{Mesh, exact};
use crate::psp::fill::{Block, Blocks};
use crate::psp::options::{Engine, Priority, ProjectionOptions};
use crate::psp::project::Pass;
use crate::psp::project::candidates::Projected;
use crate::psp::project::local::block::{Candidate, Candidates, NONE, Plane, View};
use crate::psp::project::local::charts::Charts;
use crate::psp::project::local::near::Marks;
use crate::psp::project::local::projector::LocalProjector;
use crate::psp::project::local::torus::Torus;
use crate::psp::project::rays::TraceSpace;
use crate::psp::set::{Sample, SampleSet, Surroundings};
use crate::rng::{Draw, Rng};

/// The side of a block in cubes of a set.
const CUBES: f64 = 2.0;
/// The least distance of a hit from the edges of its triangle, in diagonals of the mesh's box.
pub const TOLERANCE: f64 = 1e-6;

/// The pattern of local projectors, and the mesh for rays if these are the engine.
pub struct LocalProjection {
    torus: Torus,
    space: Option<Arc<TraceSpace>>,
}

impl LocalProjection {
    pub fn new(job: &Job, mesh: &Mesh, options: &ProjectionOptions) -> Result<Self> {
        let space = match options.engine {
            Engine::Embree => Some(TraceSpace::of(&job.part(0.0, 0.7), mesh)?),
            Engine::Rasteriser | Engine::Auto => None,
        };
        Ok(Self { torus: Torus::new(&job.part(0.7, 1.0), options.seed)?, space })
    }

    /// Projects the pattern, and adds what conflicts with nothing that was there or comes first.
    pub fn advance(&self, job: &Job, pass: &Pass, samples: &mut SampleSet) -> Result<Projected> {
        let given = pass.given.alike();
        let mut rng = Rng::at(pass.options.seed, Draw::Charts, &[pass.iteration.into()]);
        let shift = [(); 3].map(|()| rng.unit());
        // Given samples of the same radius keep others away like the set's own.
        let mut wide = samples.widened(CUBES, shift, given.iter().map(|&position| Sample::at(position)));
        let blocks = Blocks::new(&job.part(0.0, 0.1), pass.mesh, pass.measures, &wide, None)?;
        let choose = |number: usize, set: &SampleSet| Ok(self.block(pass, &blocks.block(pass.measures, number), set));
        let projected = wide.grow(&job.part(0.1, 1.0), &blocks.cubes, choose)?;
        samples.append(&mut wide.into_samples().split_off(given.len() + samples.len()));
        Ok(projected)
    }

    /// The samples of a block.
    fn block(&self, pass: &Pass, block: &Block, set: &SampleSet) -> (Vec<Sample>, Projected) {
        let radius = set.radius();
        let [low, high] = block.extent.corners().map(exact);
        let centre = 0.5 * low + 0.5 * high;
        let charts = Charts::new(pass.mesh, block, centre, 1.0 / radius);
        // Hits are moved by the rounding of their barycentrics and positions.
        let moved = 2.0 * pass.mesh.float_spacing() / radius + charts.longest * 2f64.powi(-22);
        let unit = 1.0 + moved + 1e-9;
        let (box_low, box_high) = pass.mesh.bounds();
        let tolerance = TOLERANCE * exact(box_low).distance(exact(box_high)) / (radius * unit);
        let reach = 0.5 * (high - low).length() / radius + 1.0;
        let view = View { centre, radius, reach };
        let traced = self.space.as_deref().map(|space| (space, &view));
        let mut candidates = Candidates::default();
        let mut last = vec![NONE; self.torus.len()];
        for (chart, &axis) in charts.axes.iter().enumerate() {
            let [x, y, z] = block.cube.key();
            let mut rng = Rng::at(pass.options.seed, Draw::Charts, &[pass.iteration.into(), x, y, z, chart as u64]);
            let plane = Plane {
                mesh: pass.mesh,
                torus: &self.torus,
                projector: LocalProjector::new(axis, 1.0 / unit, &mut rng),
                tolerance,
                pieces: &block.items.pieces,
                facets: charts.facets(chart).collect(),
            };
            candidates.add(&plane, chart, &mut last, traced);
        }
        choose(pass, block, set, &candidates)
    }
}

/// The greedy choice among the candidates of a block, and the counts of them.
fn choose(pass: &Pass, block: &Block, set: &SampleSet, candidates: &Candidates) -> (Vec<Sample>, Projected) {
    let radius = set.radius();
    let mut marks = Marks::new(&block.extent, radius);
    let [low, high] = block.extent.corners().map(exact);
    let mut surroundings = Surroundings::new(0.5 * low + 0.5 * high, 0.5 * (high - low).max_element(), radius);
    for candidate in &candidates.all {
        marks.add(candidate.sample.position, candidate.chart);
    }
    for sample in set.around(block.cube).filter(|sample| block.extent.is_in_reach(sample.position, radius)) {
        marks.add_sample(sample.position);
        surroundings.add(sample.position);
    }
    let mut is_repeated = vec![false; candidates.all.len()];
    for (number, candidate) in candidates.all.iter().enumerate().filter(|(_, c)| c.before != NONE) {
        is_repeated[number] = true;
        is_repeated[candidate.before as usize] = true;
    }
    let mut accepted = Vec::with_capacity(candidates.all.len());
    let mut contested = Vec::new();
    for ((number, candidate), is_repeated) in (0..).zip(&candidates.all).zip(is_repeated) {
        let position = candidate.sample.position;
        if pass.given.obstacles.reject(position) {
            continue;
        }
        if is_repeated || marks.is_near_another(position, candidate.chart) {
            contested.push(u64::from(candidate.rank) << 32 | number);
        } else {
            accepted.push(candidate.sample);
        }
    }
    if pass.options.priority == Priority::Squareness {
        contested.sort_unstable();
    }
    let mut restart_conflicts = 0;
    for number in contested {
        let Candidate { sample, before, .. } = candidates.all[number as u32 as usize];
        if surroundings.rejects(sample.position) {
            let before = candidates.all.get(before as usize);
            let on_ray = before.is_some_and(|before| set.conflict(before.sample.position, sample.position));
            restart_conflicts += u64::from(on_ray);
        } else {
            surroundings.add(sample.position);
            accepted.push(sample);
        }
    }
    let hits = candidates.all.len() as u64;
    (accepted, Projected { rays: candidates.rays, hits, restart_conflicts })
}
