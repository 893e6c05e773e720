//! Candidates: all hits of the projectors, and the greedy choice among them (thesis §3.3.2, "Compaction").
//!
//! The conflicts among the hits of one ray keep the name of the thesis, *restart conflicts*.
//!
//! The candidates of a cube are taken in order of priority, each one unless a sample is too close that existed before
//! or was taken before. The thesis orders them by the number of the projector, and tests the winners against the
//! existing samples afterwards. Here existing samples come first: a candidate that will be rejected anyway must not
//! eliminate others. Among the candidates those come first that their projector faces most squarely: there its pattern,
//! which is maximal in the plane, is stretched least. (Or, by option, those of the lower projector, as in the thesis.)

use std::ops::AddAssign;

use crate::error::Result;
use crate::index::Buckets;
use crate::job::Job;
use crate::mesh::{Mesh, exact, round_barycentrics};
use crate::psp::given::GivenSamples;
use crate::psp::options::Priority;
use crate::psp::project::projector::Projector;
use crate::psp::set::{Cube, Sample, SampleSet};
use crate::trace::Hit;

/// The resolution of the squareness of a hit.
const RANKS: f64 = 1e6;

/// The rank of a hit by the cosine between the normal and the direction that it is projected along.
pub fn rank(cosine: f64) -> u32 {
    ((1.0 - cosine.abs()) * RANKS) as u32
}

/// The counts of rays and hits of some projectors.
#[derive(Clone, Copy, Default)]
pub struct Projected {
    pub rays: u64,
    pub hits: u64,
    pub restart_conflicts: u64,
}

/// The candidates of three projectors by cubes, and the counts of rays and hits.
pub type Candidates = (Buckets<Cube, Candidate>, Projected);

/// Turns hits into candidates.
pub struct Collector<'a> {
    pub mesh: &'a Mesh,
    pub samples: &'a SampleSet,
    pub priority: Priority,
    pub projectors: &'a [Projector; 3],
}

impl AddAssign for Projected {
    fn add_assign(&mut self, part: Self) {
        self.rays += part.rays;
        self.hits += part.hits;
        self.restart_conflicts += part.restart_conflicts;
    }
}

impl Collector<'_> {
    /// Runs tasks that pass on their results: the number of a projector, the number of its rays, and their hits in the
    /// order of [`Scene::all_hits`](crate::trace::Scene::all_hits), all those of a ray at once.
    pub fn collect(
        &self,
        job: &Job,
        tasks: usize,
        task: impl Fn(usize, &mut dyn FnMut(usize, usize, &[Hit])) + Sync,
    ) -> Result<Candidates> {
        let (candidates, parts) = Buckets::collect(job, tasks, |index, add| {
            let mut projected = Projected::default();
            task(index, &mut |projector, rays, hits| {
                projected.rays += rays as u64;
                projected.hits += hits.len() as u64;
                projected.restart_conflicts += self.add_all(projector, hits, add);
            });
            projected
        })?;
        let mut all = Projected::default();
        parts.into_iter().for_each(|part| all += part);
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
                let cosine = || exact(self.mesh.normal(hit.triangle)).dot(direction);
                let rank = match self.priority {
                    Priority::Squareness => rank(cosine()),
                    Priority::Projector => projector as u32,
                };
                add(self.samples.cube(sample.position.map(f64::from)), Candidate { sample, rank });
            }
        }
        restart_conflicts
    }
}

/// A point that a projector found.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    pub sample: Sample,
    /// The rank: the lowest comes first; among equals, the one that was found first.
    pub rank: u32,
}

/// Adds the greedy choice among the candidates around given samples, and returns the number of samples added.
///
/// A failed or cancelled job adds nothing.
pub fn merge(
    job: &Job,
    given: &GivenSamples,
    samples: &mut SampleSet,
    candidates: &Buckets<Cube, Candidate>,
) -> Result<u64> {
    let before = samples.len();
    let cubes: Vec<Cube> = (0..candidates.len()).map(|bucket| candidates.key(bucket)).collect();
    let merged = samples.grow(job, &cubes, |bucket, samples| {
        let mut surroundings = samples.surroundings(cubes[bucket]);
        let given = given.near(cubes[bucket]);
        let candidates: Vec<_> = candidates.items(bucket).filter(|new| !given.reject(new.sample.position)).collect();
        let mut order: Vec<u64> = (0..).zip(&candidates).map(|(i, c)| u64::from(c.rank) << 32 | i).collect();
        order.sort_unstable();
        let mut accepted = Vec::with_capacity(candidates.len());
        for index in order {
            let sample = candidates[index as u32 as usize].sample;
            if !surroundings.rejects(sample.position) {
                surroundings.add(sample.position);
                accepted.push(sample);
            }
        }
        let count = accepted.len() as u64;
        Ok((accepted, count))
    });
    if merged.is_err() {
        samples.truncate(before);
    }
    merged
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::given::Given;
    use crate::job::Context;
    use crate::mesh::Mesh;
    use crate::psp::fragment::Facing;
    use crate::rng::{Draw, Rng};

    /// A hundred sheets above each other: candidates everywhere in space.
    fn sheets() -> Arc<Mesh> {
        let sheet = |z: u32| [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|[x, y]| [x, y, z as f32 * 0.01]);
        let triangles = (0..100).map(|z| [3 * z, 3 * z + 1, 3 * z + 2]).collect();
        Arc::new(Mesh::new((0..100).flat_map(sheet).collect(), triangles).unwrap())
    }

    fn none_given(mesh: &Mesh, samples: &SampleSet) -> GivenSamples {
        GivenSamples::new(mesh, Given::default(), samples.radius(), samples, Facing::ANY).unwrap()
    }

    fn candidate(mesh: &Mesh, rng: &mut Rng) -> Candidate {
        let (u, v) = (rng.unit() as f32, rng.unit() as f32);
        let barycentrics = if u + v < 1.0 { [u, v] } else { [0.5 * u, 0.5 * v] };
        Candidate { sample: Sample::new(mesh, rng.below(100) as u32, barycentrics), rank: rng.below(5) as u32 }
    }

    /// The set after each of a few merges.
    fn grown(mesh: &Mesh, radius: f64, threads: usize) -> Vec<Vec<Sample>> {
        let mut samples = SampleSet::new(mesh, radius);
        let given = none_given(mesh, &samples);
        let context = Context::new(threads).unwrap();
        let merge_round = |round: u64| {
            context.run(None, |job| {
                let place = |sample: &Sample| samples.cube(sample.position.map(f64::from));
                let (candidates, _) = Buckets::collect(job, 10, |task, add| {
                    let mut rng = Rng::at(1, Draw::Probe, &[round, task as u64]);
                    (0..300).map(|_| candidate(mesh, &mut rng)).for_each(|new| add(place(&new.sample), new));
                })?;
                let before = samples.len() as u64;
                let added = merge(job, &given, &mut samples, &candidates)?;
                assert_eq!(samples.len() as u64, before + added);
                // The greedy choice leaves no candidate without a conflict.
                for new in (0..candidates.len()).flat_map(|bucket| candidates.items(bucket)) {
                    let place = new.sample.position;
                    assert!(samples.all().iter().any(|sample| samples.conflict(sample.position, place)));
                }
                Ok(samples.all().to_vec())
            })
        };
        (0..3).map(merge_round).collect::<Result<_>>().unwrap()
    }

    #[test]
    fn a_set_grows_free_of_conflicts_until_all_candidates_conflict_on_any_number_of_threads() {
        let mesh = sheets();
        for radius in [0.01, 0.03, 0.2, 3.0] {
            let (one, three) = (grown(&mesh, radius, 1), grown(&mesh, radius, 3));
            let last = SampleSet::new(&mesh, radius);
            for (sets, others) in one.windows(2).zip(&three[1..]) {
                let positions = |set: &[Sample]| set.iter().map(|sample| sample.position).collect::<Vec<_>>();
                let (before, after) = (positions(&sets[0]), positions(&sets[1]));
                assert_eq!(after[..before.len()], before);
                assert_eq!(after, positions(others), "depends on the threads");
                for (i, &a) in after.iter().enumerate() {
                    assert!(!after[..i].iter().any(|&b| last.conflict(a, b)));
                }
            }
        }
    }

    #[test]
    fn a_lower_rank_comes_first_then_the_older_then_the_earlier() {
        let mesh = sheets();
        let mut samples = SampleSet::new(&mesh, 0.1);
        let given = none_given(&mesh, &samples);
        let at = |u: f32, rank| Candidate { sample: Sample::new(&mesh, 0, [u, 0.0]), rank };
        let mut merge_these = |candidates: &[Candidate]| -> Vec<f32> {
            let merged = Context::new(1).unwrap().run(None, |job| {
                let add_all = |_, add: &mut dyn FnMut(Cube, Candidate)| {
                    candidates.iter().for_each(|&candidate| add(Cube([0; 3]), candidate));
                };
                merge(job, &given, &mut samples, &Buckets::collect(job, 1, add_all)?.0)
            });
            merged.unwrap();
            samples.all().iter().map(|sample| sample.position[0]).collect()
        };
        assert_eq!(merge_these(&[at(0.30, 2), at(0.35, 1), at(0.42, 1)]), [0.35]);
        assert_eq!(merge_these(&[at(0.44, 0), at(0.70, 1), at(0.75, 1)]), [0.35, 0.70]);
    }
}
