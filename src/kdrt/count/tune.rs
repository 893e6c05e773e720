//! Tuning: small places of a maximal set are made anew until it has the wanted number of samples.
//!
//! After the idea of disk tuning (Ebeida et al. 2016), which the thesis leaves as future work: what is taken out and
//! put back keeps the set conflict-free and maximal, and changes its size by chance.
//!
//! A round cuts the domain into plots (`plots.rs`), makes some of them anew, each alone, and takes over what brings the
//! number of samples nearer to the wanted one.

use std::cmp::Reverse;

use crate::error::Result;
use crate::job::{Job, chunks_of};
use crate::math::power;
use crate::plane::lattice::Lattice;
use crate::plane::rect::Rect;
use crate::plane::{CellAxis, CellGrid, Quadtree};
use crate::rng::{Draw, Rng, hash};

use crate::kdrt::count::plots::{Plot, Plots};

/// Rounds until a set is given up; three are mostly enough.
const ROUNDS: u64 = 24;

/// How often a plot is made anew until its number of samples changes as wanted.
const TRIES: u64 = 6;

/// Plots that are made anew for a sample that is missing or too many, and some more.
const PLOTS_PER_SAMPLE: f64 = 2.0;
const MORE_PLOTS: f64 = 16.0;

/// Samples that one task asks for their plot.
const SAMPLES_PER_TASK: usize = 1 << 16;

/// The change of a plot: of which samples, by their index, the places are replaced by which new ones.
struct Change {
    removed: Vec<usize>,
    added: Vec<[i32; 2]>,
}

impl Change {
    fn difference(&self) -> i64 {
        self.added.len() as i64 - self.removed.len() as i64
    }

    /// Whether it brings the number of samples nearer to one that is `missing` away, and not beyond.
    fn helps(&self, missing: i64) -> bool {
        let difference = self.difference();
        difference.signum() == missing.signum() && difference.abs() <= missing.abs()
    }
}

/// Brings a maximal set to `count` samples, or as near as it gets in [`ROUNDS`].
pub fn tune(job: &Job, lattice: &Lattice, samples: &mut Vec<[f32; 2]>, count: u64, seed: u64) -> Result<()> {
    for round in 0..ROUNDS {
        let mut missing = count as i64 - samples.len() as i64;
        if missing == 0 {
            break;
        }
        let job = job.part(1.0 - power(0.5, round as u32), 1.0 - power(0.5, round as u32 + 1));
        let mut superfluous = Vec::new();
        for change in changes(&job, lattice, samples, missing, hash(seed, Draw::Tune, &[round]))? {
            if change.helps(missing) {
                missing -= change.difference();
                replace(lattice, samples, change, &mut superfluous);
            }
        }
        superfluous.sort_unstable_by_key(|&index| Reverse(index));
        for index in superfluous {
            samples.swap_remove(index);
        }
    }
    Ok(())
}

/// Puts the new samples in the places of those removed, and at the end if they are more; what is left to be removed is
/// `superfluous`.
fn replace(lattice: &Lattice, samples: &mut Vec<[f32; 2]>, change: Change, superfluous: &mut Vec<usize>) {
    let common = change.removed.len().min(change.added.len());
    for (&index, &point) in change.removed.iter().zip(&change.added) {
        samples[index] = lattice.position(point);
    }
    samples.extend(change.added[common..].iter().map(|&point| lattice.position(point)));
    superfluous.extend(&change.removed[common..]);
}

/// Changes that help, in plots chosen at random and in random order.
fn changes(job: &Job, lattice: &Lattice, samples: &[[f32; 2]], missing: i64, seed: u64) -> Result<Vec<Change>> {
    let plots = Plots::new(lattice, Rng::at(seed, Draw::Tune, &[]));
    let wanted = missing.unsigned_abs() as f64 * PLOTS_PER_SAMPLE + MORE_PLOTS;
    let limit = (wanted / plots.len() as f64 * u64::MAX as f64) as u64;
    // Plots by their random number: those below the limit are chosen.
    let mut chosen: Vec<(u64, usize)> =
        (0..plots.len()).map(|plot| (hash(seed, Draw::Tune, &[plot as u64]), plot)).collect();
    chosen.retain(|&(number, _)| number <= limit);
    chosen.sort_unstable();

    let members = members(job, lattice, samples, &plots, &chosen)?;
    let make = |i: usize| {
        let (number, plot) = chosen[i];
        let anew = |attempt| {
            resample(lattice, &plots.get(plot), samples, &members[i], Rng::at(number, Draw::Tune, &[attempt]))
        };
        (0..TRIES).map(anew).find(|change| change.helps(missing))
    };
    Ok(job.part(0.3, 1.0).map(chosen.len(), make)?.into_iter().flatten().collect())
}

/// The samples in each of the chosen plots, by their indices.
fn members(
    job: &Job,
    lattice: &Lattice,
    samples: &[[f32; 2]],
    plots: &Plots,
    chosen: &[(u64, usize)],
) -> Result<Vec<Vec<usize>>> {
    let mut place = vec![u32::MAX; plots.len()];
    chosen.iter().zip(0..).for_each(|(&(_, plot), i)| place[plot] = i);
    let chunks = chunks_of(samples.len(), SAMPLES_PER_TASK);
    let found = job.part(0.0, 0.3).flat_map(chunks.len(), |chunk| {
        let place = |index: usize| (place[plots.holding(lattice.point(samples[index]))], index);
        chunks.range(chunk).map(place).filter(|&(place, _)| place != u32::MAX).collect()
    })?;
    let mut members = vec![Vec::new(); chosen.len()];
    found.into_iter().for_each(|(place, index)| members[place as usize].push(index));
    Ok(members)
}

/// Takes the samples out of the hole of a plot, which has the given members, and fills it.
fn resample(lattice: &Lattice, plot: &Plot, samples: &[[f32; 2]], members: &[usize], mut rng: Rng) -> Change {
    let &Lattice { radius, separation, .. } = lattice;
    let mut change = Change { removed: Vec::new(), added: Vec::new() };
    let hole = plot.hole();
    if hole.is_empty() {
        return change;
    }
    // A torus of its own for the plot, with a margin behind it so that nothing meets over the seam.
    let length = plot.axes.map(|axis| if axis.is_circle { axis.length } else { axis.length + separation.reach + 1 });
    let mut grid = CellGrid::torus(&length.map(|length| CellAxis::new(length, radius)), separation);
    for &index in members {
        let point = plot.inward(lattice.point(samples[index]));
        if hole.contains(point) {
            change.removed.push(index);
        } else {
            grid.insert(grid.cell(point), point);
        }
    }
    let within = Rect { min: [0; 2], max: plot.axes.map(|axis| axis.length) };
    let open = hole.grown(separation.reach).intersection(&within);
    let cells = grid.cells_of(&open);
    let all = (cells.min[1]..cells.max[1]).flat_map(|y| (cells.min[0]..cells.max[0]).map(move |x| [x, y]));
    let empty: Vec<_> = all.filter(|&cell| grid.sample(cell).is_none()).collect();
    let mut quadtree = Quadtree::new(&grid, open, empty);
    quadtree.fill(&mut grid, &mut rng, |_, point| change.added.push(plot.outward(point)));
    #[cfg(test)]
    grid.sanity_check();
    change
}
