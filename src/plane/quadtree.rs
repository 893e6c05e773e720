//! The flat quadtree of Ebeida, Mitchell, Patney, Davidson and Owens 2012, "A simple algorithm for maximal
//! Poisson-disk sampling in high dimensions", in the plane and on the lattice.
//!
//! The list of *voxels*, squares of one level, always holds every lattice point that no sample covers. Darts fall
//! exactly uniformly on the voxels' lattice points, so an accepted dart is uniform on the uncovered part. Between
//! rounds of darts voxels are cut and the parts that one sample covers are dropped. Where the paper ends at the
//! precision of floats, the voxels here end as single lattice points: an empty list *proves* maximality.
//!
//! Voxels are cut in sixteen by a coarse test (`near.rs`) while they are wide, and exactly in four after that.

use std::ops::Range;

use crate::error::Result;
use crate::job::{Chunks, Job, chunks_of};
use crate::plane::{cells::CellGrid, list::List, near::Near, rect::Rect};
use crate::rng::Rng;

/// Voxels wider than this are cut in sixteen by the coarse test, whose slack is negligible at this size; others exactly
/// in four.
const NARROWEST: i32 = 8;

/// The smallest voxels that are cut by the coarse test, as a share of the cell: much wider than its slack.
const DEEPEST: i32 = 1 << 9;

/// A rectangle of lattice points of a cell, some of which may be uncovered.
#[derive(Clone, Copy)]
pub struct Voxel {
    pub rect: Rect,
    pub cell: [i32; 2],
}

/// The voxels of a rectangle of lattice points that may be uncovered. Voxels of one cell are consecutive.
pub(crate) struct Quadtree {
    /// The widest voxel of this level.
    pub width: i32,
    /// The narrowest voxel that the coarse test may cut.
    narrowest: i32,
    pub voxels: Vec<Voxel>,
    /// Working memory for the next level's voxels.
    next: Vec<Voxel>,
    cutter: Cutter,
}

/// The working memory for cutting voxels: the samples near a cell.
pub struct Cutter {
    /// For the coarse test.
    near: Box<Near>,
    /// For the exact test.
    exactly_near: Vec<[i32; 2]>,
}

impl Quadtree {
    /// The given cells of the grid, as far as they lie in `rect`.
    pub fn new(grid: &CellGrid, rect: Rect, cells: impl IntoIterator<Item = [i32; 2]>) -> Self {
        let voxels = cells.into_iter().map(|cell| (cell, grid.rect(cell).intersection(&rect)));
        let mut quadtree = Self::empty();
        let voxels = voxels.filter(|(cell, rect)| !rect.is_empty() && !grid.is_hidden(*cell, rect));
        quadtree.restart(grid, grid.widest_cell(), voxels);
        quadtree
    }

    /// The cells without a sample, as far as they lie in `rect`.
    pub fn of_empty_cells(grid: &CellGrid, rect: Rect) -> Self {
        let cells = grid.cells_of(&rect);
        let cells = (cells.min[1]..cells.max[1]).flat_map(|y| (cells.min[0]..cells.max[0]).map(move |x| [x, y]));
        Self::new(grid, rect, cells.filter(|&cell| grid.sample(cell).is_none()))
    }

    /// No voxels.
    pub fn empty() -> Self {
        Self { width: 1, narrowest: NARROWEST, voxels: Vec::new(), next: Vec::new(), cutter: Cutter::new() }
    }

    /// Drops all voxels and takes the given ones, no wider than `width`, each with its cell.
    pub fn restart(&mut self, grid: &CellGrid, width: i32, voxels: impl Iterator<Item = ([i32; 2], Rect)>) {
        self.width = width;
        self.narrowest = NARROWEST.max(grid.widest_cell() / DEEPEST);
        self.voxels.clear();
        self.voxels.extend(voxels.map(|(cell, rect)| Voxel { rect, cell }));
    }

    /// Drops all voxels, for sixteenths of voxels no wider than `width` ([`Quadtree::add_sixteenths`]).
    #[inline(always)]
    pub fn restart_cut(&mut self, grid: &CellGrid, width: i32) {
        self.restart(grid, part(width), std::iter::empty());
        debug_assert!(width > self.narrowest);
    }

    /// Takes the sixteenths of a voxel of a cell that no sample covers. All samples that could cover them are listed.
    #[inline(always)]
    pub fn add_sixteenths(&mut self, grid: &CellGrid, list: &List, cell: [i32; 2], voxel: Rect) {
        grid.gather_among(list, voxel, &mut self.cutter.near);
        let open = grid.uncovered(&self.cutter.near, &voxel, self.width);
        add_parts(grid, &Voxel { rect: voxel, cell }, self.width, open, &mut self.voxels);
    }

    /// The number of voxels left.
    pub fn len(&self) -> usize {
        self.voxels.len()
    }

    /// True if every lattice point is covered.
    pub fn is_empty(&self) -> bool {
        self.voxels.is_empty()
    }

    /// Throws a dart and adds it to the grid if it becomes a sample. There must be voxels left.
    #[inline(always)]
    pub fn throw(&mut self, grid: &mut CellGrid, rng: &mut Rng) -> Option<[i32; 2]> {
        let pick = rng.below(self.voxels.len() as u64) as usize;
        let Voxel { rect, cell } = self.voxels[pick];
        grid.throw(cell, &rect, self.width, rng)
    }

    /// Drops the voxels that a new sample covers, as far as the coarse test is certain of it.
    #[inline(always)]
    fn prune(&mut self, grid: &CellGrid, sample: [i32; 2]) {
        let limit = grid.certain();
        let mut left = 0;
        for i in 0..self.voxels.len() {
            let voxel = self.voxels[i];
            let [dx, dy] = [0, 1].map(|axis: usize| {
                let ends = [sample[axis] - voxel.rect.min[axis], voxel.rect.max[axis] - 1 - sample[axis]];
                ends[0].max(ends[1]) as f32
            });
            // Written unconditionally, kept only if it is open: a branch would not be predictable.
            self.voxels[left] = voxel;
            left += usize::from(dx * dx + dy * dy >= limit);
        }
        self.voxels.truncate(left);
    }

    /// Throws darts and cuts voxels until every lattice point is covered, and shows each new sample to `accepted`, with
    /// the grid as it is then. For few voxels: a new sample is compared with all of them. ([`Quadtree::fill_domain`] is
    /// for whole domains.)
    #[inline(always)]
    pub fn fill(&mut self, grid: &mut CellGrid, rng: &mut Rng, mut accepted: impl FnMut(&CellGrid, [i32; 2])) {
        while !self.is_empty() {
            let mut misses = darts(self.len());
            while misses > 0 {
                misses -= 1;
                if let Some(sample) = self.throw(grid, rng) {
                    self.prune(grid, sample);
                    accepted(grid, sample);
                    misses = darts(self.len());
                }
            }
            self.refine(grid);
        }
    }

    /// Cuts the voxels in parts and drops the parts that one sample covers. Single lattice points are not cut.
    #[inline(always)]
    pub fn refine(&mut self, grid: &CellGrid) {
        let (is_coarse, width) = self.next_level();
        self.next.clear();
        self.cutter.cut(grid, &self.voxels, is_coarse, width, &mut self.next);
        self.width = width;
        std::mem::swap(&mut self.voxels, &mut self.next);
    }

    /// The next cut of the voxels: true if it is by the coarse test, and the width of the parts.
    #[inline(always)]
    pub fn next_level(&self) -> (bool, i32) {
        let is_coarse = self.width > self.narrowest;
        (is_coarse, if is_coarse { part(self.width) } else { (self.width + 1) / 2 })
    }
}

impl Cutter {
    pub fn new() -> Self {
        Self { near: Box::new(Near::new()), exactly_near: Vec::new() }
    }

    /// Cuts voxels by the coarse or the exact test in parts of the given width, and appends the parts that no sample
    /// covers.
    #[inline(always)]
    pub fn cut(&mut self, grid: &CellGrid, voxels: &[Voxel], is_coarse: bool, width: i32, open: &mut Vec<Voxel>) {
        for voxels in voxels.chunk_by(|a, b| a.cell == b.cell) {
            let cell = voxels[0].cell;
            if grid.sample(cell).is_some() {
                continue;
            }
            if is_coarse {
                grid.gather(cell, &mut self.near);
                for voxel in voxels {
                    add_parts(grid, voxel, width, grid.uncovered(&self.near, &voxel.rect, width), open);
                }
            } else {
                let near = grid.samples_near(cell, &mut self.exactly_near);
                let quarters = voxels.iter().flat_map(|voxel| quarters(voxel.rect, width));
                let quarters = quarters.filter(|rect| !grid.covers(near, rect) && !grid.is_hidden(cell, rect));
                open.extend(quarters.map(|rect| Voxel { rect, cell }));
            }
        }
    }
}

/// The number of darts that are thrown at so many voxels before they are cut. Where voxels are pruned by every new
/// sample: the number of misses in a row; in a gap most darts become samples, and most samples close it.
pub(crate) fn darts(voxels: usize) -> usize {
    voxels.div_ceil(2)
}

/// The width of the parts when a voxel is cut in four along each axis.
fn part(width: i32) -> i32 {
    (width + 3) / 4
}

/// Appends the sixteenths of a voxel, as wide as given, whose bit is set in `open`, unless they are hidden.
#[inline(always)]
fn add_parts(grid: &CellGrid, &Voxel { rect, cell }: &Voxel, width: i32, mut open: u16, voxels: &mut Vec<Voxel>) {
    while open != 0 {
        let i = open.trailing_zeros() as i32;
        open &= open - 1;
        let min = [rect.min[0] + i % 4 * width, rect.min[1] + i / 4 * width];
        let part = Rect { min, max: [0, 1].map(|axis: usize| (min[axis] + width).min(rect.max[axis])) };
        if !grid.is_hidden(cell, &part) {
            voxels.push(Voxel { rect: part, cell });
        }
    }
}

/// The quarters of a voxel, as wide as given; the voxel itself if it is no wider.
fn quarters(voxel: Rect, width: i32) -> impl Iterator<Item = Rect> {
    let corners = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[x, y]| [voxel.min[0] + x * width, voxel.min[1] + y * width]);
    let rects = corners.map(|min| Rect { min, max: min.map(|x| x + width) }.intersection(&voxel));
    rects.into_iter().filter(|rect| !rect.is_empty())
}

// # Darts
//
// Darts: points thrown at voxels, which become samples if nothing conflicts with them.

impl CellGrid {
    /// Throws a dart at a voxel of a cell and adds it if it becomes a sample. Every voxel gets the share of darts of
    /// one as wide as `width`; those beyond its own end are discarded.
    #[inline(always)]
    pub fn throw(&mut self, cell: [i32; 2], voxel: &Rect, width: i32, rng: &mut Rng) -> Option<[i32; 2]> {
        let point = self.aim(cell, voxel, width, rng)?;
        self.insert(cell, point);
        Some(point)
    }

    /// The position at which a dart of [`CellGrid::throw`] would become a sample; none if it would not.
    #[inline(always)]
    pub fn aim(&self, cell: [i32; 2], voxel: &Rect, width: i32, rng: &mut Rng) -> Option<[i32; 2]> {
        dart(voxel, width, rng).filter(|&point| !self.conflicts(cell, point))
    }

    /// [`CellGrid::throw`] where all samples that could conflict with it are listed; it is added to the list, too.
    #[inline(always)]
    pub fn throw_among(
        &mut self,
        list: &mut List,
        cell: [i32; 2],
        voxel: &Rect,
        width: i32,
        rng: &mut Rng,
    ) -> Option<[i32; 2]> {
        let point = dart(voxel, width, rng)?;
        if self.conflicts_among(&list.rows(), point) || self.is_blocked(cell, point) {
            return None;
        }
        self.insert(cell, point);
        list.push(point);
        Some(point)
    }
}

/// A point of a square as wide as `width` in the corner of a voxel, if it lies in the voxel.
#[inline(always)]
fn dart(voxel: &Rect, width: i32, rng: &mut Rng) -> Option<[i32; 2]> {
    let [x, y] = rng.pair_below(width as u32);
    let point = [voxel.min[0] + x as i32, voxel.min[1] + y as i32];
    voxel.contains(point).then_some(point)
}

// # Whole domains
//
// The flat quadtree of a whole domain (`quadtree.rs`), by all threads.
//
// A round of darts is one stream of random numbers, in which each dart has a known position. So many darts are aimed at
// once, against the samples that were there before; those without conflict are then accepted one after the other, in
// their order, if they do not conflict with samples accepted meanwhile. The samples are those of darts thrown one by
// one.

/// The number of darts per cell of a whole domain, before any is cut. After that, [`darts()`] gives their number.
const DARTS_PER_CELL: usize = 2;

/// The darts of a whole domain that are aimed at once: an eighth as many as there are voxels, so that few of them
/// conflict with each other, within these bounds.
const DARTS_AT_ONCE: [usize; 2] = [1 << 12, 1 << 16];

/// The number of random numbers that a dart takes: one for the voxel, one for the position in it.
const DRAWS_PER_DART: usize = 2;

/// The number of darts that one task aims, and of voxels that one task cuts.
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
    /// Threads share the aiming and the cutting. Darts aimed at once are accepted in their order, so that the samples
    /// are those of one dart after the other.
    pub fn fill_domain(
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

    /// The positions at which so many darts would become samples, with their cells.
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
        // The index, from `place` on, at which the voxels of a cell begin.
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

/// [`Job::map`] over chunks; a single chunk is not worth waking threads for.
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
    use crate::plane::{CellAxis, lattice::Separation};
    use crate::rng::Draw;

    fn grid(size: [i32; 2]) -> CellGrid {
        let axes = size.map(|size| CellAxis::new(size, 70.0));
        CellGrid::new(&axes, &Rect { min: [0; 2], max: size }, Separation { threshold: 4900, reach: 69 })
    }

    fn all_cells(grid: &CellGrid) -> Vec<[i32; 2]> {
        let [columns, rows] = grid.counts();
        (0..rows).flat_map(|y| (0..columns).map(move |x| [x, y])).collect()
    }

    /// In an empty grid nothing is dropped: at every level each lattice point is in exactly one voxel.
    #[test]
    fn voxels_of_every_level_hold_each_lattice_point_once() {
        let grid = grid([211, 130]);
        let clip = Rect { min: [13, 20], max: [200, 101] };
        let mut quadtree = Quadtree::new(&grid, clip, all_cells(&grid));
        loop {
            let mut held = vec![0; 211 * 130];
            for &Voxel { rect, cell } in &quadtree.voxels {
                assert!((0..2).all(|axis| rect.length(axis) <= quadtree.width));
                assert_eq!(rect.intersection(&grid.rect(cell)), rect);
                for (y, x) in (rect.min[1]..rect.max[1]).flat_map(|y| (rect.min[0]..rect.max[0]).map(move |x| (y, x))) {
                    held[(y * 211 + x) as usize] += 1;
                }
            }
            for (place, held) in held.into_iter().enumerate() {
                let inside = clip.contains([place as i32 % 211, place as i32 / 211]);
                assert_eq!(held, i32::from(inside));
            }
            if quadtree.width == 1 {
                break;
            }
            quadtree.refine(&grid);
        }
    }

    #[test]
    fn first_darts_are_uniform_at_every_level() {
        let size = [57, 61];
        for level in 0..4 {
            let mut histogram = vec![0u32; 57 * 61];
            let mut rng = Rng::at(level, Draw::Probe, &[]);
            for _ in 0..100_000 {
                let mut grid = grid(size);
                let mut quadtree = Quadtree::new(&grid, Rect { min: [0; 2], max: size }, all_cells(&grid));
                (0..level).for_each(|_| quadtree.refine(&grid));
                let mut first = None;
                while first.is_none() {
                    first = quadtree.throw(&mut grid, &mut rng);
                }
                let [x, y] = first.unwrap();
                histogram[(y * 57 + x) as usize] += 1;
            }
            let expected = 100_000.0 / histogram.len() as f64;
            let chi2: f64 = histogram.iter().map(|&count| (f64::from(count) - expected).powi(2) / expected).sum();
            let freedom = histogram.len() as f64 - 1.0;
            assert!((chi2 - freedom).abs() < 5.0 * (2.0 * freedom).sqrt(), "chi2 {chi2} of {freedom} at level {level}");
        }
    }

    /// Enough cells for several tasks, on a torus and on a bounded domain.
    #[test]
    fn filling_a_domain_is_one_dart_after_the_other() {
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
            let fill = |job: &Job| {
                let mut quadtree = Quadtree::of_all(job, &shared)?;
                quadtree.fill_domain(job, &mut shared, &mut draws, 1e4, |sample| found.push(sample))
            };
            context.run(None, fill).unwrap();
            assert!(found == expected && found.len() > 3_000);
        }
    }
}
