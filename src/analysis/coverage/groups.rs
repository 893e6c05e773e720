//! Gaps of three dimensions: uncovered places, grouped by their distances.

use std::collections::HashMap;

use crate::analysis::coverage::gaps::DisjointSets;
use crate::error::{Error, Result};
use crate::job::Job;
use crate::math::square;
use crate::memory;

/// Uncovered places within this share of the radius are of one gap; fragments are cut until none is half as long.
pub(super) const LINK: f64 = 0.5;
/// Gaps are seen if they are deeper than this share of the radius.
pub(super) const DEPTH: f64 = 1e-6;
/// No more uncovered fragments than this are kept.
const MAX_UNCOVERED: usize = 1 << 26;
/// The number of places, or cells of them, that are grouped between two reports.
const PLACES: u32 = 2048;

/// The most uncovered fragments that are kept, and that memory holds at so many bytes each, in its cell and its group.
pub(super) fn most_uncovered(bytes: f64) -> usize {
    memory::available().map_or(MAX_UNCOVERED, |available| MAX_UNCOVERED.min((available / bytes) as usize))
}

/// Refuses so many uncovered fragments.
pub(super) fn check_count(uncovered: usize, most: usize) -> Result<()> {
    if uncovered < most {
        Ok(())
    } else {
        Err(Error::too_large("radius", format!("leaves more than {most} fragments uncovered")))
    }
}

/// The groups of `count` places of which each is within `reach` of another one.
///
/// Places are sorted into cells in which any two are near, however many they are. One near pair links all places of two
/// cells.
pub(super) fn group(job: &Job, count: usize, place: impl Fn(u32) -> [f64; 3], reach: f64) -> Result<DisjointSets> {
    let side = reach / 3f64.sqrt() * (1.0 - 1e-9);
    // Whole numbers, of which 0 has one form.
    let cell = |place: [f64; 3]| place.map(|x| (x / side).floor() + 0.0);
    let key = |cell: [f64; 3]| cell.map(f64::to_bits);
    let mut groups = DisjointSets::new(count);
    let mut cells: HashMap<[u64; 3], Vec<u32>> = HashMap::new();
    for id in 0..count as u32 {
        if id % PLACES == 0 {
            job.report(0.5 * f64::from(id) / count as f64)?;
        }
        let members = cells.entry(key(cell(place(id)))).or_default();
        members.first().into_iter().for_each(|&first| groups.link(first, id));
        members.push(id);
    }
    let are_near = |a: u32, b: u32| {
        let [a, b] = [place(a), place(b)];
        (0..3).map(|axis| square(a[axis] - b[axis])).sum::<f64>() <= reach * reach
    };
    for (done, members) in cells.values().enumerate() {
        if done % PLACES as usize == 0 {
            job.report(0.5 + 0.5 * done as f64 / cells.len() as f64)?;
        }
        let [x, y, z] = cell(place(members[0]));
        for step in 0..5 * 5 * 5 {
            let [i, j, k] = [step / 25, step / 5 % 5, step % 5].map(|step| f64::from(step) - 2.0);
            let Some(others) = cells.get(&key([x + i + 0.0, y + j + 0.0, z + k + 0.0])) else { continue };
            if !groups.are_linked(members[0], others[0])
                && members.iter().any(|&a| others.iter().any(|&b| are_near(a, b)))
            {
                groups.link(members[0], others[0]);
            }
        }
    }
    Ok(groups)
}
