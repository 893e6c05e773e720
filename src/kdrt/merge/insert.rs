//! Insertion: what the survivors leave uncovered is filled, by the blocks and phases of KDRT (`blocks.rs`).
//!
//! As a plane, a domain is filled by windows of blocks that share nothing: each makes what it must know of its
//! surroundings itself. Which cells have gaps is not known beforehand, as pieces promise nothing but to be
//! conflict-free: all are tested.

use crate::error::Result;
use crate::job::Job;
use crate::plane::lattice::Lattice;
use crate::plane::rect::Rect;
use crate::plane::{CellGrid, Quadtree};
use crate::points::Boundary;
use crate::rng::{Draw, Rng};

use crate::kdrt::blocks::{Blocks, PHASES};
use crate::kdrt::merge::WIDENING;
use crate::kdrt::merge::given::Given;
use crate::kdrt::tiling::{WINDOW_BLOCKS, cut};

/// The samples that make the survivors maximal.
pub fn insert(job: &Job, given: &Given, survives: &[bool], lattice: &Lattice, seed: u64) -> Result<Vec<[f32; 2]>> {
    let lattice = lattice.widened(WIDENING);
    let gaps = Gaps { given, survives, lattice: &lattice };
    if !Blocks::fit(&lattice) {
        return gaps.fill_torus(job, Rng::at(seed, Draw::Darts, &[]));
    }
    let blocks = Blocks::new(&lattice, seed);
    let windows = cut(&Rect { min: [0; 2], max: blocks.counts() }, WINDOW_BLOCKS);
    job.flat_map(windows.len(), |i| gaps.fill_window(&blocks, &windows[i]))
}

struct Gaps<'a> {
    given: &'a Given<'a>,
    survives: &'a [bool],
    /// With the radius that new samples keep.
    lattice: &'a Lattice,
}

impl Gaps<'_> {
    /// Fills a rectangle of blocks, and as much around it as is necessary to do this as any other window would.
    fn fill_window(&self, blocks: &Blocks, window: &Rect) -> Vec<[f32; 2]> {
        let separation = self.lattice.separation;
        let known = blocks.rect(&blocks.grown(window, PHASES[0].1)).grown(separation.reach);
        let known = match self.lattice.boundary {
            Boundary::Periodic => known,
            Boundary::Bounded => known.intersection(&self.lattice.rect()),
        };
        let mut grid = CellGrid::new(&self.given.axes, &known, separation);
        self.survivors_in(&known, |point| grid.insert(grid.cell(point), point));

        let (inside, mut samples) = (blocks.rect(window), Vec::new());
        for (parity, margin) in PHASES {
            let phase = blocks.grown(window, margin);
            let columns: Vec<_> = blocks.of_parity(&phase, 0, parity[0]).collect();
            let rows = blocks.of_parity(&phase, 1, parity[1]);
            for ((row, y), &(column, x)) in rows.flat_map(|row| columns.iter().map(move |column| (row, column))) {
                let rect = Rect { min: [x[0], y[0]], max: [x[1], y[1]] };
                let (mut quadtree, mut rng) = (Quadtree::of_empty_cells(&grid, rect), blocks.rng([column, row]));
                quadtree.fill(&mut grid, &mut rng, |_, sample| {
                    if inside.contains(sample) {
                        samples.push(self.lattice.position(sample));
                    }
                });
            }
        }
        samples
    }

    /// Fills a torus that is too narrow for blocks, as a whole.
    fn fill_torus(&self, job: &Job, mut rng: Rng) -> Result<Vec<[f32; 2]>> {
        let all = self.lattice.rect();
        let mut grid = CellGrid::torus(&self.given.axes, self.lattice.separation);
        self.survivors_in(&all, |point| grid.insert(grid.cell(point), point));
        let mut samples = Vec::new();
        let accepted = |sample| samples.push(self.lattice.position(sample));
        let expected = self.lattice.expected_samples();
        Quadtree::of_empty_cells(&grid, all).rain(job, &mut grid, &mut rng, expected, accepted)?;
        Ok(samples)
    }

    /// Visits the lattice points of the survivors in `rect`; on a torus all their images there.
    fn survivors_in(&self, rect: &Rect, mut visit: impl FnMut([i32; 2])) {
        let size = self.lattice.size;
        let turns = |axis: usize| rect.min[axis].div_euclid(size[axis])..=(rect.max[axis] - 1).div_euclid(size[axis]);
        for turn in turns(1).flat_map(|y| turns(0).map(move |x| [x * size[0], y * size[1]])) {
            let part = rect.translated(turn.map(|x| -x)).intersection(&self.lattice.rect());
            for place in self.given.places_in(&part).filter(|&place| self.survives[place]) {
                let point = self.given.lattice_point(self.given.sites()[place].position);
                if part.contains(point) {
                    visit([point[0] + turn[0], point[1] + turn[1]]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::Domain;

    /// Gaps of all sizes: the survivors are thinned more and more from left to right.
    #[test]
    fn every_partition_into_windows_inserts_the_same_samples() {
        for (seed, boundary) in [Boundary::Periodic, Boundary::Bounded, Boundary::Periodic].into_iter().enumerate() {
            let domain = Domain { min: [0.3, -0.4], max: [1.3, 0.8], boundary };
            let lattice = Lattice::new(&domain, 0.0137).unwrap();
            let context = crate::job::Context::new(1).unwrap();
            let mut samples = context.run(None, |job| crate::maximal::sample_lattice(job, &lattice, 1)).unwrap();
            let mut rng = Rng::at(seed as u64, Draw::Probe, &[]);
            samples.retain(|sample| rng.unit() > 1.1 * (f64::from(sample[0]) - 0.3));
            let sets = [&samples[..]];
            let given = context.run(None, |job| Given::new(job, domain, &lattice, 0.0137, &sets)).unwrap();

            let lattice = lattice.widened(WIDENING);
            let gaps = Gaps { given: &given, survives: &vec![true; samples.len()], lattice: &lattice };
            let blocks = Blocks::new(&lattice, seed as u64);
            let inserted = |side| {
                let windows = cut(&Rect { min: [0; 2], max: blocks.counts() }, side);
                let mut inserted: Vec<_> =
                    windows.iter().flat_map(|window| gaps.fill_window(&blocks, window)).collect();
                inserted.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
                inserted
            };
            let whole = inserted(WINDOW_BLOCKS);
            assert!(whole.len() > 1000);
            for side in [1, 2, 5] {
                assert!(inserted(side) == whole, "{side} blocks, seed {seed}");
            }
        }
    }
}
