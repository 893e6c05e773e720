//! The greedy choice among the candidates of a block: those near another chart or block are tested, by their rank; all
//! others are accepted.

use crate::mesh::exact;
use crate::psp::fill::Block;
use crate::psp::options::Priority;
use crate::psp::project::Pass;
use crate::psp::project::candidates::Projected;
use crate::psp::project::local::block::{Candidate, Candidates, NONE};
use crate::psp::project::local::near::Marks;
use crate::psp::project::local::torus::Torus;
use crate::psp::project::rays::TraceSpace;
use crate::psp::set::{Sample, SampleSet, Surroundings};

/// The greedy choice among the candidates of a block, which are traced if there is a space for rays, and their counts.
pub fn choose(
    pass: &Pass,
    block: &Block,
    set: &SampleSet,
    tori: &[Torus],
    space: Option<&TraceSpace>,
) -> (Vec<Sample>, Projected) {
    let radius = set.radius();
    let candidates = Candidates::of(pass, block, radius, tori, space);
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
