//! Pairs of near points in space.

use std::ops::Range;

use glam::DVec3;

/// Cells are no narrower than this share of the box of all points, so that their numbers stay small.
const NARROWEST: f64 = 1.0 / (1 << 20) as f64;

/// The side of the cubes for sets of points among which pairs within a reach are looked for: it must be the same for all
/// of them, or a cube of one set would meet any number of another's.
pub(super) fn side(sets: [&[DVec3]; 2], reach: f64) -> f64 {
    let all = || sets.into_iter().flatten().copied();
    let extent = all().reduce(DVec3::max).unwrap_or_default() - all().reduce(DVec3::min).unwrap_or_default();
    reach.max(NARROWEST * extent.max_element())
}

/// Points sorted into cubes.
pub(super) struct Cells {
    origin: DVec3,
    side: f64,
    /// The points with their numbers, those of a cell together.
    points: Vec<(u32, DVec3)>,
    /// The cells in order, and where the points of each are.
    cells: Vec<([i64; 3], Range<usize>)>,
}

impl Cells {
    pub fn new(points: &[DVec3], side: f64) -> Self {
        let origin = points.iter().copied().reduce(DVec3::min).unwrap_or_default();
        let mut points: Vec<_> = (0..).zip(points.iter().copied()).collect();
        points.sort_by_cached_key(|&(_, point)| cell(point, origin, side));
        let mut cells: Vec<([i64; 3], Range<usize>)> = Vec::new();
        for (i, &(_, point)) in points.iter().enumerate() {
            let cell = cell(point, origin, side);
            match cells.last_mut() {
                Some((last, run)) if *last == cell => run.end = i + 1,
                _ => cells.push((cell, i..i + 1)),
            }
        }
        Self { origin, side, points, cells }
    }

    /// The number of cells.
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// The points of a cell, with their numbers.
    pub fn points(&self, cell: usize) -> &[(u32, DVec3)] {
        &self.points[self.cells[cell].1.clone()]
    }

    /// All points within the reach of some points that are in one cube, and others.
    pub fn near(&self, around: &[(u32, DVec3)]) -> Vec<(u32, DVec3)> {
        let places = || around.iter().map(|&(_, point)| point);
        let (Some(low), Some(high)) = (places().reduce(DVec3::min), places().reduce(DVec3::max)) else {
            return Vec::new();
        };
        let [low, high] = [low - self.side, high + self.side].map(|corner| cell(corner, self.origin, self.side));
        let range = |axis: usize| low[axis]..=high[axis];
        let columns = range(0).flat_map(|x| range(1).map(move |y| [x, y]));
        columns.flat_map(|[x, y]| self.column([x, y, low[2]], [x, y, high[2]])).copied().collect()
    }

    /// The points of cells that follow each other in order.
    fn column(&self, first: [i64; 3], last: [i64; 3]) -> &[(u32, DVec3)] {
        let start = self.cells.partition_point(|(cell, _)| *cell < first);
        let count = self.cells[start..].partition_point(|(cell, _)| *cell <= last);
        match &self.cells[start..start + count] {
            [] => &[],
            cells => &self.points[cells[0].1.start..cells[count - 1].1.end],
        }
    }
}

fn cell(point: DVec3, origin: DVec3, side: f64) -> [i64; 3] {
    ((point - origin) / side).floor().as_i64vec3().to_array()
}

#[cfg(test)]
mod tests {
    use super::*;
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
            let (from, to) = (Cells::new(&firsts, side), Cells::new(&others, side));
            let mut found = Vec::new();
            for cell in 0..from.len() {
                let near = to.near(from.points(cell));
                for &(i, a) in from.points(cell) {
                    found.extend(near.iter().filter(|&&(_, b)| is_near(a, b)).map(|&(j, _)| (i, j)));
                }
            }
            found.sort_unstable();
            let all = (0..300u32).flat_map(|i| (0..300u32).map(move |j| (i, j)));
            let expected: Vec<_> = all.filter(|&(i, j)| is_near(firsts[i as usize], others[j as usize])).collect();
            assert!(found == expected && !expected.is_empty(), "{reach}: {} of {}", found.len(), expected.len());
        }
        assert_eq!(Cells::new(&[], 1.0).len(), 0);
    }

    /// Found by fuzzing: the few points of a cube were looked for in 10^12 cubes of the others.
    #[test]
    fn a_set_that_is_spread_wide_meets_few_cubes_of_one_that_is_not() {
        let (wide, narrow) = ([DVec3::ZERO, DVec3::new(1.0, 1e13, 0.0)], [DVec3::ZERO, DVec3::ONE]);
        let side = side([&wide, &narrow], 1.0);
        let (from, to) = (Cells::new(&wide, side), Cells::new(&narrow, side));
        assert_eq!(to.near(from.points(0)).len(), 2);
    }
}
