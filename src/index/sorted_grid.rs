//! Uniform grid over points of the plane or of space, sorted by cell: the neighbour search where all points are known.

use crate::index::Binned;
use crate::math::square;
use crate::points::{Boundary, Domain};

/// Points of a domain, sorted by the cells of a uniform grid. Built in O(n), never changed.
pub struct SortedGrid<const D: usize> {
    domain: Domain<D>,
    /// Cells per axis.
    cells: [usize; D],
    /// Cells per unit of length.
    scale: [f64; D],
    /// The points, by cells.
    entries: Binned<Entry<D>>,
}

/// The grid of the plane.
pub type Grid2 = SortedGrid<2>;

/// A point of a grid, and its number among those that the grid was made of.
#[derive(Clone, Copy)]
pub struct Entry<const D: usize> {
    pub id: u32,
    pub point: [f64; D],
}

impl<const D: usize> Default for Entry<D> {
    fn default() -> Self {
        Self { id: 0, point: [0.0; D] }
    }
}

impl<const D: usize> SortedGrid<D> {
    /// Sorts `points`, which lie in the domain, into cells of about `cell_size`, but not many more cells than points.
    pub fn new(domain: Domain<D>, points: impl ExactSizeIterator<Item = [f64; D]> + Clone, cell_size: f64) -> Self {
        let extent = domain.extent();
        let limit = (4 * points.len()).max(64) as f64;
        let side = cell_size.max(domain.cell_side(limit));
        let cells = extent.map(|length| (length / side).floor().max(1.0) as usize);
        let scale = std::array::from_fn(|axis| cells[axis] as f64 / extent[axis]);
        let grid = Self { domain, cells, scale, entries: Binned::default() };
        let entries = (0..).zip(points).map(|(id, point)| (grid.cell(point), Entry { id, point }));
        Self { entries: Binned::new(cells.iter().product(), entries), ..grid }
    }

    /// The points with their ids, those of a cell together.
    pub fn entries(&self) -> &[Entry<D>] {
        self.entries.items()
    }

    fn cell(&self, point: [f64; D]) -> usize {
        (0..D).rev().fold(0, |row, axis| {
            let cell = (point[axis] - self.domain.min[axis]) * self.scale[axis];
            row * self.cells[axis] + (cell.max(0.0) as usize).min(self.cells[axis] - 1)
        })
    }

    /// The first and last cell of an axis that can hold points within `radius` of `coordinate`; on a torus from a cell of an
    /// image on.
    fn cells_near(&self, axis: usize, coordinate: f64, radius: f64) -> [i64; 2] {
        let count = self.cells[axis] as i64;
        let at = |x: f64| ((x - self.domain.min[axis]) * self.scale[axis]).floor().clamp(-1e15, 1e15) as i64;
        // One cell more on each side than exact arithmetic needs: rounding may move a point across a cell boundary.
        let (first, last) = (at(coordinate - radius) - 1, at(coordinate + radius) + 1);
        match self.domain.boundary {
            Boundary::Periodic if last - first >= count => [0, count - 1],
            Boundary::Periodic => [first, last],
            Boundary::Bounded => [first.clamp(0, count - 1), last.clamp(0, count - 1)],
        }
    }

    /// Calls `visit(id, offset, squared distance)` for every point within `radius` of `point` (inclusive).
    ///
    /// Offsets are from `point` to the neighbour, on a torus the shortest: `radius` must not exceed half the period if
    /// all images are to be seen. A point that is itself in the grid is visited too.
    pub fn for_each_within(&self, point: [f64; D], radius: f64, mut visit: impl FnMut(u32, [f64; D], f64)) {
        let near: [_; D] = std::array::from_fn(|axis| self.cells_near(axis, point[axis], radius));
        let place = |axis: usize, cell: i64| cell.rem_euclid(self.cells[axis] as i64) as usize;
        let mut at = near.map(|[first, _]| first);
        loop {
            let row = (1..D).rev().fold(0, |row, axis| (row + place(axis, at[axis])) * self.cells[axis - 1]);
            for column in near[0][0]..=near[0][1] {
                for &Entry { id, point: neighbour } in self.entries.bin(row + place(0, column)) {
                    let offset = self.domain.offset(point, neighbour);
                    let d2 = offset.into_iter().map(square).sum();
                    if d2 <= radius * radius {
                        visit(id, offset, d2);
                    }
                }
            }
            // The next row.
            let Some(axis) = (1..D).find(|&axis| at[axis] < near[axis][1]) else { return };
            at[axis] += 1;
            (1..axis).for_each(|axis| at[axis] = near[axis][0]);
        }
    }

    /// The squared distance from `point` to the nearest point of the grid other than `except`; infinite if there is
    /// none. On a torus the shortest images count.
    pub fn nearest_squared(&self, point: [f64; D], except: Option<u32>) -> f64 {
        let farthest: f64 = self.domain.extent().into_iter().sum();
        let mut radius = 1.0 / self.scale.into_iter().fold(0.0, f64::max);
        loop {
            let mut nearest = f64::INFINITY;
            self.for_each_within(point, radius, |id, _, d2| {
                if Some(id) != except {
                    nearest = nearest.min(d2);
                }
            });
            if nearest < f64::INFINITY || radius > farthest {
                return nearest;
            }
            radius *= 2.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    /// Every query against the whole list, on square and thin domains, small and large radii.
    #[test]
    fn finds_what_a_loop_over_all_points_finds() {
        check::<2>([-1.0, 2.0]);
        check::<3>([-1.0, 2.0, 0.1]);
    }

    fn check<const D: usize>(min: [f64; D]) {
        for (case, boundary) in [Boundary::Periodic, Boundary::Bounded].into_iter().enumerate() {
            for (width, cell_size) in [(1.0, 0.1), (30.0, 0.5), (0.01, 0.2), (1.0, 5.0), (1.0, 1e-9)] {
                let extent: [f64; D] = std::array::from_fn(|axis| if axis == 0 { width } else { 1.0 });
                let domain = Domain { min, max: std::array::from_fn(|axis| min[axis] + extent[axis]), boundary };
                let mut rng = Rng::at(5, Draw::Probe, &[case as u64]);
                let mut place = || std::array::from_fn(|axis| min[axis] + extent[axis] * rng.unit());
                let points: Vec<_> = (0..300).map(|_| place()).collect();
                let grid = SortedGrid::new(domain, points.iter().copied(), cell_size);
                for radius in [0.0, 0.03, 0.3, 2.0] {
                    for &point in points.iter().step_by(7) {
                        let mut found = Vec::new();
                        grid.for_each_within(point, radius, |id, _, d2| found.push((id, d2)));
                        found.sort_by_key(|&(id, _)| id);
                        let squared = |to| domain.offset(point, to).into_iter().map(square).sum::<f64>();
                        let expected: Vec<_> = (0..points.len() as u32)
                            .map(|id| (id, squared(points[id as usize])))
                            .filter(|&(_, d2)| d2 <= radius * radius)
                            .collect();
                        let nearest = expected.iter().map(|&(_, d2)| d2).min_by(f64::total_cmp);
                        if let Some(nearest) = nearest {
                            assert_eq!(grid.nearest_squared(point, None), nearest);
                        }
                        let others = |&id: &u32| points[id as usize] != point;
                        let nearest = (0..points.len() as u32).filter(others).map(|id| squared(points[id as usize]));
                        let id = points.iter().position(|&other| other == point).map(|id| id as u32);
                        assert_eq!(grid.nearest_squared(point, id), nearest.min_by(f64::total_cmp).unwrap());
                        assert_eq!(found, expected);
                    }
                }
            }
        }
    }
}
