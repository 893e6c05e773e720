//! The flat quadtree of a whole domain (`quadtree.rs`), by all threads.
//!
//! A round of darts is one stream of random numbers, whose place in it each dart knows. So many darts are aimed at
//! once, against the samples that were there before; those that hit nothing are then accepted one after the other, in
//! their order, if nothing accepted meanwhile is in their way. The samples are those of darts thrown one by one.

use std::ops::Range;

use crate::error::Result;
use crate::job::{Chunks, Job, chunks_of};
use crate::plane::cells::CellGrid;
use crate::plane::quadtree::{Cutter, Quadtree, Voxel, darts};
use crate::plane::rect::Rect;
use crate::rng::Rng;

/// Darts per cell of a whole domain, before any is cut. After that [`darts()`] says how many.
const DARTS_PER_CELL: usize = 2;

/// The darts of a whole domain that are aimed at once: an eighth as many as there are voxels, so that few of them hit
/// the same place, within these bounds.
const DARTS_AT_ONCE: [usize; 2] = [1 << 12, 1 << 16];

/// The random numbers that a dart takes: one for the voxel, one for the place in it.
const DRAWS_PER_DART: usize = 2;

/// Darts that one task aims, and voxels that one task cuts.
const PER_TASK: usize = 1 << 10;

impl Quadtree {
    /// All cells of the grid.
    pub fn of_all(job: &Job, grid: &CellGrid) -> Result<Self> {
        let [columns, rows] = grid.counts().map(|count| count as usize);
        let nothing = Voxel { rect: Rect { min: [0; 2], max: [0; 2] }, cell: [0; 2] };
        let mut voxels = vec![nothing; columns * rows];
        let rows_per_task = PER_TASK / columns + 1;
        let tasks = voxels.chunks_mut(columns * rows_per_task).enumerate().collect();
        job.map_each(tasks, |(task, voxels): (usize, &mut [Voxel])| {
            for (row, voxels) in (task * rows_per_task..).zip(voxels.chunks_mut(columns)) {
                for (column, voxel) in voxels.iter_mut().enumerate() {
                    let cell = [column as i32, row as i32];
                    *voxel = Voxel { rect: grid.rect(cell), cell };
                }
            }
        })?;
        let mut quadtree = Self::empty();
        quadtree.restart(grid, grid.widest_cell(), std::iter::empty());
        if grid.has_obstacles() {
            voxels.retain(|voxel| !grid.is_hidden(voxel.cell, &voxel.rect));
        }
        quadtree.voxels = voxels;
        Ok(quadtree)
    }

    /// Throws darts and cuts voxels until every lattice point is covered, and shows the new samples to `accepted`. For
    /// whole domains, of which about `expected` samples are the whole progress: a sample is not compared with the other
    /// voxels.
    ///
    /// Threads share the aiming and the cutting. What they aim at once is accepted in the order of the darts, so that
    /// the samples are those of one dart after the other.
    pub fn rain(
        &mut self,
        job: &Job,
        grid: &mut CellGrid,
        rng: &mut Rng,
        expected: f64,
        mut accepted: impl FnMut([i32; 2]),
    ) -> Result<()> {
        let mut count = 0u64;
        let mut remaining = DARTS_PER_CELL * self.len();
        while !self.is_empty() {
            let share = |count: u64| (count as f64 / expected).min(0.99);
            while remaining > 0 {
                let [fewest, most] = DARTS_AT_ONCE;
                let darts = remaining.min((self.len() / 8).clamp(fewest, most));
                let hits = shared(&job.part(share(count), share(count)), chunks_of(darts, PER_TASK), |darts| {
                    self.aim(grid, rng.after((DRAWS_PER_DART * darts.start) as u64), darts.len())
                })?;
                for (cell, point) in hits.into_iter().flatten() {
                    if !grid.conflicts(cell, point) {
                        grid.insert(cell, point);
                        count += 1;
                        accepted(point);
                    }
                }
                *rng = rng.after((DRAWS_PER_DART * darts) as u64);
                remaining -= darts;
            }
            self.refine_shared(&job.part(share(count), share(count)), grid)?;
            remaining = darts(self.len());
        }
        Ok(())
    }

    /// Where so many darts would become samples, with their cells.
    fn aim(&self, grid: &CellGrid, mut rng: Rng, darts: usize) -> Vec<([i32; 2], [i32; 2])> {
        let dart = |_| {
            let pick = rng.below(self.voxels.len() as u64) as usize;
            let Voxel { rect, cell } = self.voxels[pick];
            grid.aim(cell, &rect, self.width, &mut rng).map(|point| (cell, point))
        };
        (0..darts).filter_map(dart).collect()
    }

    /// [`Quadtree::refine`] by all threads.
    fn refine_shared(&mut self, job: &Job, grid: &CellGrid) -> Result<()> {
        let (is_coarse, width) = self.next_level();
        // Where the voxels of a cell begin, from a place on.
        let cell_from = |place: usize| {
            let is_first = |&i: &usize| i == 0 || self.voxels[i].cell != self.voxels[i - 1].cell;
            (place..self.len()).find(is_first).unwrap_or(self.len())
        };
        let parts = shared(job, chunks_of(self.len(), PER_TASK), |range| {
            let mut parts = Vec::new();
            let voxels = &self.voxels[cell_from(range.start)..cell_from(range.end)];
            Cutter::new().cut(grid, voxels, is_coarse, width, &mut parts);
            parts
        })?;
        self.voxels.clear();
        parts.iter().for_each(|part| self.voxels.extend(part));
        self.width = width;
        Ok(())
    }
}

/// [`Job::map`] over chunks; a single one is not worth waking threads for.
fn shared<T: Send>(job: &Job, chunks: Chunks, task: impl Fn(Range<usize>) -> T + Sync) -> Result<Vec<T>> {
    match chunks.len() {
        0 | 1 => {
            job.report(1.0)?;
            Ok((0..chunks.len()).map(|chunk| task(chunks.range(chunk))).collect())
        }
        count => job.map(count, |chunk| task(chunks.range(chunk))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::plane::CellAxis;
    use crate::plane::lattice::Separation;
    use crate::rng::Draw;

    /// Enough cells for several tasks, on a torus and beside one.
    #[test]
    fn rain_is_one_dart_after_the_other() {
        let (axes, size) = ([5_000, 6_100].map(|size| CellAxis::new(size, 70.0)), [5_000, 6_100]);
        let separation = Separation { threshold: 4900, reach: 69 };
        for (torus, threads) in [(false, 1), (false, 3), (true, 1), (true, 3)] {
            let grid = || match torus {
                true => CellGrid::torus(&axes, separation),
                false => CellGrid::new(&axes, &Rect { min: [0; 2], max: size }, separation),
            };
            let rng = Rng::at(7, Draw::Probe, &[]);
            let mut expected = Vec::new();
            let (mut single, mut draws) = (grid(), rng.clone());
            let [columns, rows] = single.counts();
            let cells = (0..rows).flat_map(|y| (0..columns).map(move |x| [x, y]));
            let mut quadtree = Quadtree::new(&single, Rect { min: [0; 2], max: size }, cells);
            let mut remaining = DARTS_PER_CELL * quadtree.len();
            while !quadtree.is_empty() {
                expected.extend((0..remaining).filter_map(|_| quadtree.throw(&mut single, &mut draws)));
                quadtree.refine(&single);
                remaining = darts(quadtree.len());
            }
            let (mut found, mut shared, mut draws) = (Vec::new(), grid(), rng.clone());
            let context = Context::new(threads).unwrap();
            let rain = |job: &Job| {
                let mut quadtree = Quadtree::of_all(job, &shared)?;
                quadtree.rain(job, &mut shared, &mut draws, 1e4, |sample| found.push(sample))
            };
            context.run(None, rain).unwrap();
            assert!(found == expected && found.len() > 3_000);
        }
    }
}
