//! Pairs of near points in space.

use std::ops::Range;

use glam::DVec3;

use crate::error::Result;
use crate::job::{Job, chunks_of};

/// PairGrid are no narrower than this share of the box of all points, so that their numbers stay small.
const NARROWEST: f64 = 1.0 / (1 << 20) as f64;
/// The bits of a cell's number along an axis.
const BITS: u32 = 21;

/// PairGrid whose work is estimated by one task.
const ESTIMATED: usize = 1 << 10;
/// A task tests about so many pairs: it takes some hundredths of a second, however the points are spread.
const TESTS: usize = 1 << 22;

/// The side of the cubes for sets of points among which pairs within a reach are looked for: it must be the same for all
/// of them, or a cube of one set would meet any number of another's. Smaller ones hold fewer points that are too far away,
/// and take longer to be found.
pub(super) fn side(sets: [&[DVec3]; 2], reach: f64) -> f64 {
    let all = || sets.into_iter().flatten().copied();
    let extent = all().reduce(DVec3::max).unwrap_or_default() - all().reduce(DVec3::min).unwrap_or_default();
    (0.5 * reach).max(NARROWEST * extent.max_element())
}

/// Points sorted into cubes.
pub(super) struct PairGrid {
    origin: DVec3,
    side: f64,
    /// The points with their numbers, those of a cell together.
    points: Vec<(u32, DVec3)>,
    /// The cells in order, and where the points of each are.
    cells: Vec<(u64, Range<usize>)>,
}

/// Points that follow each other and are in one cell.
pub(super) type Run = Range<usize>;

impl PairGrid {
    pub fn new(points: &[DVec3], side: f64) -> Self {
        let origin = points.iter().copied().reduce(DVec3::min).unwrap_or_default();
        let mut order: Vec<_> =
            points.iter().zip(0u32..).map(|(&point, i)| (number(place(point, origin, side)), i)).collect();
        order.sort_unstable();
        let mut cells: Vec<(u64, Run)> = Vec::new();
        for (i, &(cell, _)) in order.iter().enumerate() {
            match cells.last_mut() {
                Some((last, run)) if *last == cell => run.end = i + 1,
                _ => cells.push((cell, i..i + 1)),
            }
        }
        let points = order.into_iter().map(|(_, i)| (i, points[i as usize])).collect();
        Self { origin, side, points, cells }
    }

    /// Points, with their numbers.
    pub fn points(&self, run: Run) -> &[(u32, DVec3)] {
        &self.points[run]
    }

    /// The points, divided into runs, and these into tasks that test about as many pairs with `others` each.
    pub fn tasks(&self, job: &Job, others: &Self, reach: f64) -> Result<Vec<Vec<Run>>> {
        let chunks = chunks_of(self.cells.len(), ESTIMATED);
        let runs = job.flat_map(chunks.len(), |chunk| {
            let cells = self.cells[chunks.range(chunk)].iter().flat_map(|(_, run)| {
                let near = others.near(&self.points[run.clone()], reach);
                let near = near.iter().map(|points| points.len()).sum::<usize>().max(1);
                let size = (TESTS / near).max(1);
                run.clone().step_by(size).map(move |start| (start..(start + size).min(run.end), near))
            });
            cells.collect()
        })?;
        let (mut tasks, mut tests): (Vec<Vec<Run>>, usize) = (Vec::new(), TESTS);
        for (run, near) in runs {
            tests = tests.saturating_add(run.len().saturating_mul(near));
            match tasks.last_mut() {
                Some(task) if tests <= TESTS => task.push(run),
                _ => {
                    tests = run.len().saturating_mul(near);
                    tasks.push(vec![run]);
                }
            }
        }
        Ok(tasks)
    }

    /// All points within `reach` of some points, and others, by columns of cells.
    pub fn near(&self, around: &[(u32, DVec3)], reach: f64) -> Vec<&[(u32, DVec3)]> {
        let places = || around.iter().map(|&(_, point)| point);
        let Some((low, high)) = places().reduce(DVec3::min).zip(places().reduce(DVec3::max)) else { return Vec::new() };
        let [low, high] = [low - reach, high + reach].map(|corner| self.place(corner));
        let along = |axis: usize| low[axis].max(0)..=high[axis].min((1 << BITS) - 1);
        let (bottom, top) = (low[2].max(0), high[2].min((1 << BITS) - 1));
        let mut columns = Vec::new();
        for x in along(0) {
            columns.extend(along(1).map(|y| self.column([x, y, bottom], [x, y, top])));
        }
        columns
    }

    fn place(&self, point: DVec3) -> [i64; 3] {
        place(point, self.origin, self.side)
    }

    /// The points of cells that follow each other in order; none if the last comes before the first.
    fn column(&self, first: [i64; 3], last: [i64; 3]) -> &[(u32, DVec3)] {
        if last[2] < first[2] {
            return &[];
        }
        let [first, last] = [first, last].map(number);
        let start = self.cells.partition_point(|(cell, _)| *cell < first);
        let count = self.cells[start..].partition_point(|(cell, _)| *cell <= last);
        match &self.cells[start..start + count] {
            [] => &[],
            cells => &self.points[cells[0].1.start..cells[count - 1].1.end],
        }
    }
}

/// The cell of a point. Those that hold points of the set are not negative.
fn place(point: DVec3, origin: DVec3, side: f64) -> [i64; 3] {
    ((point - origin) / side).floor().as_i64vec3().to_array()
}

/// The number of a cell: by x, by y where that is the same, and by z.
fn number([x, y, z]: [i64; 3]) -> u64 {
    ((x << (2 * BITS)) | (y << BITS) | z) as u64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::rng::{Draw, Rng};

    #[test]
    fn every_near_pair_is_found_once() {
        for (reach, stretch) in [(0.3, 1.0), (0.05, 1.0), (5.0, 1.0), (0.1, 1e9)] {
            let mut rng = Rng::at(1, Draw::Probe, &[]);
            // Three clusters, which can be far apart.
            let mut point = || DVec3::new(stretch * rng.below(3) as f64, rng.unit(), rng.unit() + 7.0);
            let (firsts, others): (Vec<_>, Vec<_>) = (0..300).map(|_| (point(), point())).unzip();
            let is_near = |a: DVec3, b: DVec3| a.distance(b) <= reach;
            let side = side([&firsts, &others], reach);
            let (from, to) = (PairGrid::new(&firsts, side), PairGrid::new(&others, side));
            let tasks = Context::new(2).unwrap().run(None, |job| from.tasks(job, &to, reach)).unwrap();
            let mut found = Vec::new();
            for run in tasks.concat() {
                let near = to.near(from.points(run.clone()), reach).concat();
                for &(i, a) in from.points(run) {
                    found.extend(near.iter().filter(|(_, b)| is_near(a, *b)).map(|&(j, _)| (i, j)));
                }
            }
            found.sort_unstable();
            let all = (0..300u32).flat_map(|i| (0..300u32).map(move |j| (i, j)));
            let expected: Vec<_> = all.filter(|&(i, j)| is_near(firsts[i as usize], others[j as usize])).collect();
            assert!(found == expected && !expected.is_empty(), "{reach}: {} of {}", found.len(), expected.len());
        }
        let none = PairGrid::new(&[], 1.0);
        assert!(Context::new(1).unwrap().run(None, |job| none.tasks(job, &none, 1.0)).unwrap().is_empty());
    }

    /// Where all points are in one cell its work is shared, too.
    #[test]
    fn tasks_test_about_as_many_pairs_however_points_are_spread() {
        let points = vec![DVec3::ONE; 10_000];
        let cells = PairGrid::new(&points, 1.0);
        let tasks = Context::new(1).unwrap().run(None, |job| cells.tasks(job, &cells, 1.0)).unwrap();
        assert_eq!(tasks.len(), points.len().div_ceil(TESTS / points.len()));
        assert!(tasks.concat().into_iter().flatten().eq(0..points.len()));
        assert!(tasks.concat().iter().all(|run| run.len() * points.len() <= TESTS));
    }

    /// Found by fuzzing: the few points of a cube were looked for in 10^12 cubes of the others.
    #[test]
    fn a_set_that_is_spread_wide_meets_few_cubes_of_one_that_is_not() {
        let (wide, narrow) = ([DVec3::ZERO, DVec3::new(1.0, 1e13, 0.0)], [DVec3::ZERO, DVec3::ONE]);
        let side = side([&wide, &narrow], 1.0);
        let (from, to) = (PairGrid::new(&wide, side), PairGrid::new(&narrow, side));
        assert_eq!(to.near(from.points(0..1), 1.0).concat().len(), 2);
    }
}
