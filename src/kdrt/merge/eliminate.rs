//! Elimination: of two given points in conflict one goes.
//!
//! The sets are ranked by hash, the fixed points before all; in a set, which can meet itself over the seam of a torus,
//! points are ranked as they come. A point survives if and only if no *surviving* point of higher rank conflicts with
//! it, as in `conquer.rs`. Rectangles may be thin, so chains of such decisions have no bound; they are followed through
//! all of the domain, but they have links only where sets meet.

use crate::error::Result;
use crate::job::{Job, chunks_of};
use crate::rng::{Draw, hash};

use crate::kdrt::merge::given::Given;

/// Cells per task.
const CELLS: usize = 1 << 14;

/// For each of the given points, in the order of its sites, whether it survives.
pub fn survivors(job: &Job, given: &Given, seed: u64) -> Result<Vec<bool>> {
    let ranks = ranks(given.set_count(), seed);
    let rank = |site: usize| (ranks[given.sites()[site].set as usize], given.sites()[site].index);
    let chunks = chunks_of(given.cells(), CELLS);
    let links = job.map(chunks.len(), |i| {
        let mut links = Vec::new();
        let mut visit = |site, other| {
            if rank(other) < rank(site) {
                links.push((site, other));
            }
        };
        chunks.range(i).try_for_each(|cell| given.conflicts(cell, &mut visit)).map(|()| links)
    })?;
    let mut links = links.into_iter().collect::<Result<Vec<_>>>()?.concat();

    // When a point's turn comes, all that could eliminate it are decided.
    links.sort_unstable_by_key(|&(site, _)| rank(site));
    let mut survives = vec![true; given.sites().len()];
    for (site, other) in links {
        survives[site] &= !survives[other];
    }
    Ok(survives)
}

/// The place of each set in the order of falling rank.
fn ranks(sets: usize, seed: u64) -> Vec<u32> {
    let mut order: Vec<usize> = (1..sets).collect();
    order.sort_by_key(|&set| hash(seed, Draw::Priority, &[set as u64]));
    let mut ranks = vec![0; sets];
    for (rank, set) in (1..).zip(order) {
        ranks[set] = rank;
    }
    ranks
}
