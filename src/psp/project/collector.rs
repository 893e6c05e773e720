//! What becomes of the hits of the projectors: all of them are candidates. The conflicts among the hits of one ray keep the
//! name of the thesis, *restart conflicts*.

use crate::error::Result;
use crate::index::Buckets;
use crate::job::Job;
use crate::mesh::{Mesh, exact, round_barycentrics};
use crate::psp::cubes::Cube;
use crate::psp::merge::Candidate;
use crate::psp::options::Priority;
use crate::psp::project::projector::Projector;
use crate::psp::samples::{Sample, SampleSet};
use crate::trace::Hit;

/// How finely the squareness of a hit is resolved.
const RANKS: f64 = 1e6;

/// Counts of what some projectors met.
#[derive(Clone, Copy, Default)]
pub(in crate::psp) struct Projected {
    pub rays: u64,
    pub hits: u64,
    pub restart_conflicts: u64,
}

/// Candidates by cubes, and counts.
pub(in crate::psp) type Found = (Buckets<Cube, Candidate>, Projected);

/// Makes candidates of hits.
pub(in crate::psp) struct Collector<'a> {
    pub mesh: &'a Mesh,
    pub samples: &'a SampleSet,
    pub priority: Priority,
    pub projectors: &'a [Projector; 3],
}

impl Collector<'_> {
    /// Runs tasks that hand over what they find: the number of a projector, of its rays, and their hits in the order of
    /// [`Scene::all_hits`](crate::trace::Scene::all_hits), all those of a ray at once.
    pub fn collect(
        &self,
        job: &Job,
        tasks: usize,
        task: impl Fn(usize, &mut dyn FnMut(usize, usize, &[Hit])) + Sync,
    ) -> Result<Found> {
        let (candidates, parts) = Buckets::collect(job, tasks, |index, add| {
            let mut projected = Projected::default();
            task(index, &mut |projector, rays, hits| {
                projected.rays += rays as u64;
                projected.hits += hits.len() as u64;
                projected.restart_conflicts += self.add_all(projector, hits, add);
            });
            projected
        })?;
        let all = parts.iter().fold(Projected::default(), |all, part| Projected {
            rays: all.rays + part.rays,
            hits: all.hits + part.hits,
            restart_conflicts: all.restart_conflicts + part.restart_conflicts,
        });
        Ok((candidates, all))
    }

    /// Adds all hits to the candidates, and counts those that conflict with an earlier one on the same ray.
    fn add_all(&self, projector: usize, hits: &[Hit], add: &mut dyn FnMut(Cube, Candidate)) -> u64 {
        let direction = self.projectors[projector].forward;
        let (mut kept, mut restart_conflicts): (Vec<[f32; 3]>, _) = (Vec::new(), 0);
        for on_ray in hits.chunk_by(|a, b| a.ray == b.ray) {
            kept.clear();
            for hit in on_ray {
                let sample = Sample::new(self.mesh, hit.triangle, round_barycentrics(hit.uv.map(f64::from)));
                if kept.iter().any(|&earlier| self.samples.conflict(earlier, sample.position)) {
                    restart_conflicts += 1;
                } else {
                    kept.push(sample.position);
                }
                let squareness = || exact(self.mesh.normal(hit.triangle)).dot(direction).abs();
                let rank = match self.priority {
                    Priority::Squareness => ((1.0 - squareness()) * RANKS) as u32,
                    Priority::Projector => projector as u32,
                };
                add(self.samples.cube(sample.position.map(f64::from)), Candidate { sample, rank });
            }
        }
        restart_conflicts
    }
}
