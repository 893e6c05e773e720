//! Conflict resolution: the greedy choice among candidates, in parallel (thesis §3.3.2, "Compaction").
//!
//! The *greedy choice* goes through the candidates in order of priority and takes each one that no candidate taken before
//! is too close to. It is one well-defined set, and it can be found without going in order: a candidate is out as soon as
//! one rival of higher priority is in, and in as soon as all of them are out. Rounds of this rule, each reading only the
//! verdicts of the round before, end at the greedy choice for any schedule of the tasks.
//!
//! The thesis unrolls the same rule for its three priorities (algorithm 6) and tests the winners against the existing
//! samples afterwards. Here candidates that conflict with existing samples do not come this far: a candidate that is
//! doomed anyway must not eliminate others, which costs about a tenth of the samples of an iteration.

use crate::error::Result;
use crate::grid3::{Grid3, distance_squared};
use crate::job::{Job, chunks_of};

/// Candidates per task.
const CHUNK: usize = 4096;

#[derive(Clone, Copy, PartialEq)]
enum Verdict {
    Open,
    In,
    Out,
}

/// The indices of the greedy choice, ascending. A lower index is a higher priority; closer than `radius` is too close.
///
/// Work and memory are linear while each candidate has a bounded number of rivals.
pub(super) fn greedy(job: &Job, candidates: &[[f32; 3]], radius: f64, origin: [f64; 3]) -> Result<Vec<u32>> {
    let mut grid = Grid3::new(origin, radius);
    for &candidate in candidates {
        grid.insert(candidate);
    }
    let chunks = chunks_of(candidates.len(), CHUNK);
    let rivals = job.part(0.0, 0.8).map(chunks.len(), |chunk| Rivals::of(&grid, radius, chunks.range(chunk)))?;

    let mut verdicts = vec![Verdict::Open; candidates.len()];
    let mut open: Vec<u32> = (0..candidates.len() as u32).collect();
    let mut rest = job.part(0.8, 1.0);
    while !open.is_empty() {
        let chunks = chunks_of(open.len(), CHUNK);
        let decided = rest.part(0.0, 0.5).flat_map(chunks.len(), |chunk| {
            let candidates = &open[chunks.range(chunk)];
            candidates.iter().map(|&index| decide(rivals_of(&rivals, index), &verdicts)).collect()
        })?;
        open.iter().zip(decided).for_each(|(&index, verdict)| verdicts[index as usize] = verdict);
        open.retain(|&index| verdicts[index as usize] == Verdict::Open);
        rest = rest.part(0.5, 1.0);
    }
    Ok((0..candidates.len() as u32).filter(|&index| verdicts[index as usize] == Verdict::In).collect())
}

fn decide(rivals: &[u32], verdicts: &[Verdict]) -> Verdict {
    let mut verdict = Verdict::In;
    for &rival in rivals {
        match verdicts[rival as usize] {
            Verdict::In => return Verdict::Out,
            Verdict::Open => verdict = Verdict::Open,
            Verdict::Out => {}
        }
    }
    verdict
}

/// The rivals of a range of candidates: those too close and of higher priority.
struct Rivals {
    /// The rivals of the k-th candidate of the range end at `ends[k]` in `indices`.
    ends: Vec<u32>,
    indices: Vec<u32>,
}

impl Rivals {
    fn of(grid: &Grid3, radius: f64, range: std::ops::Range<usize>) -> Self {
        let mut rivals = Self { ends: Vec::with_capacity(range.len()), indices: Vec::new() };
        for index in range {
            let position = grid.points()[index];
            let higher = grid.candidates(position.map(f64::from), radius).filter(|&rival| (rival as usize) < index);
            let close = |&rival: &u32| distance_squared(position, grid.points()[rival as usize]) < radius * radius;
            rivals.indices.extend(higher.filter(close));
            rivals.ends.push(rivals.indices.len() as u32);
        }
        rivals
    }
}

fn rivals_of(chunks: &[Rivals], index: u32) -> &[u32] {
    let (chunk, k) = (&chunks[index as usize / CHUNK], index as usize % CHUNK);
    let start = if k == 0 { 0 } else { chunk.ends[k - 1] };
    &chunk.indices[start as usize..chunk.ends[k] as usize]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::rng::{Draw, Rng};

    /// The definition, word by word.
    fn one_after_the_other(candidates: &[[f32; 3]], radius: f64) -> Vec<u32> {
        let mut chosen: Vec<u32> = Vec::new();
        for (index, &candidate) in candidates.iter().enumerate() {
            if !chosen.iter().any(|&c| distance_squared(candidates[c as usize], candidate) < radius * radius) {
                chosen.push(index as u32);
            }
        }
        chosen
    }

    #[test]
    fn finds_the_greedy_choice_on_any_number_of_threads() {
        for (count, radius) in [(0, 0.1), (1, 0.1), (6000, 0.05), (3000, 0.4), (300, 3.0)] {
            let mut rng = Rng::at(4, Draw::Probe, &[count]);
            let point = |_| -> [f32; 3] { std::array::from_fn(|_| rng.unit() as f32) };
            let candidates: Vec<_> = (0..count).map(point).collect();
            for threads in [1, 3] {
                let context = Context::new(threads).unwrap();
                let chosen = context.run(None, |job| greedy(job, &candidates, radius, [0.0; 3])).unwrap();
                assert_eq!(chosen, one_after_the_other(&candidates, radius));
            }
        }
    }

    /// A chain in which each candidate's fate hangs on the one before: as many rounds as candidates.
    #[test]
    fn follows_a_chain_of_rivals_to_its_end() {
        let candidates: Vec<_> = (0..1000).map(|i| [0.9 * i as f32, 0.0, 0.0]).collect();
        let chosen = Context::new(2).unwrap().run(None, |job| greedy(job, &candidates, 1.0, [0.0; 3])).unwrap();
        assert_eq!(chosen, (0..1000).step_by(2).collect::<Vec<_>>());
    }
}
