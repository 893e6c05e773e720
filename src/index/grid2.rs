//! Uniform grid over points of the plane, sorted by cell: the neighbour search in 2D.

use crate::index::Binned;
use crate::points::{Boundary, Domain};

/// Points of a domain, sorted by the cells of a uniform grid. Built in O(n), never changed.
pub struct Grid2 {
    domain: Domain,
    /// Cells per axis.
    cells: [usize; 2],
    /// Cells per unit of length.
    scale: [f64; 2],
    /// The points with their ids, by cells.
    entries: Binned<(u32, [f64; 2])>,
}

impl Grid2 {
    /// Sorts `points`, which lie in the domain, into cells of about `cell_size`, but not many more cells than points.
    pub fn new(domain: Domain, points: impl ExactSizeIterator<Item = [f64; 2]> + Clone, cell_size: f64) -> Self {
        let extent = domain.extent();
        let limit = (4 * points.len()).max(64) as f64;
        let finest = (domain.area() / limit).sqrt().max(extent[0].max(extent[1]) / limit);
        let cells = extent.map(|length| (length / cell_size.max(finest)).floor().max(1.0) as usize);
        let scale = std::array::from_fn(|axis| cells[axis] as f64 / extent[axis]);
        let grid = Self { domain, cells, scale, entries: Binned::default() };
        let entries =
            Binned::new(cells[0] * cells[1], (0..).zip(points).map(|(id, point)| (grid.cell(point), (id, point))));
        Self { entries, ..grid }
    }

    /// The points with their ids, those of a cell together.
    pub fn entries(&self) -> &[(u32, [f64; 2])] {
        self.entries.items()
    }

    fn cell(&self, point: [f64; 2]) -> usize {
        let [x, y] = std::array::from_fn(|axis| {
            let cell = (point[axis] - self.domain.min[axis]) * self.scale[axis];
            (cell.max(0.0) as usize).min(self.cells[axis] - 1)
        });
        y * self.cells[0] + x
    }

    /// Cells of an axis that can hold points within `radius` of `coordinate`, each once.
    fn cells_near(&self, axis: usize, coordinate: f64, radius: f64) -> impl Iterator<Item = usize> + Clone + use<> {
        let count = self.cells[axis] as i64;
        let at = |x: f64| ((x - self.domain.min[axis]) * self.scale[axis]).floor().clamp(-1e15, 1e15) as i64;
        // One cell more on each side than exact arithmetic needs: rounding may move a point across a cell boundary.
        let (mut first, mut last) = (at(coordinate - radius) - 1, at(coordinate + radius) + 1);
        match self.domain.boundary {
            Boundary::Periodic if last - first >= count => (first, last) = (0, count - 1),
            Boundary::Periodic => {}
            Boundary::Bounded => (first, last) = (first.clamp(0, count - 1), last.clamp(0, count - 1)),
        }
        (first..=last).map(move |cell| cell.rem_euclid(count) as usize)
    }

    /// Calls `visit(id, offset, squared distance)` for every point within `radius` of `point` (inclusive).
    ///
    /// Offsets are from `point` to the neighbour, on a torus the shortest: `radius` must not exceed half the period if
    /// all images are to be seen. A point that is itself in the grid is visited too.
    pub fn for_each_within(&self, point: [f64; 2], radius: f64, mut visit: impl FnMut(u32, [f64; 2], f64)) {
        let columns = self.cells_near(0, point[0], radius);
        for row in self.cells_near(1, point[1], radius) {
            for column in columns.clone() {
                let cell = row * self.cells[0] + column;
                for &(id, neighbour) in self.entries.bin(cell) {
                    let offset = self.domain.offset(point, neighbour);
                    let d2 = offset[0] * offset[0] + offset[1] * offset[1];
                    if d2 <= radius * radius {
                        visit(id, offset, d2);
                    }
                }
            }
        }
    }

    /// The squared distance from `point` to the nearest point of the grid other than `except`; infinite if there is
    /// none. On a torus the shortest images count.
    pub fn nearest_squared(&self, point: [f64; 2], except: Option<u32>) -> f64 {
        let [width, height] = self.domain.extent();
        let mut radius = 1.0 / self.scale[0].max(self.scale[1]);
        loop {
            let mut nearest = f64::INFINITY;
            self.for_each_within(point, radius, |id, _, d2| {
                if Some(id) != except {
                    nearest = nearest.min(d2);
                }
            });
            if nearest < f64::INFINITY || radius > width + height {
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
        for (case, boundary) in [Boundary::Periodic, Boundary::Bounded].into_iter().enumerate() {
            for (width, cell_size) in [(1.0, 0.1), (30.0, 0.5), (0.01, 0.2), (1.0, 5.0), (1.0, 1e-9)] {
                let domain = Domain { min: [-1.0, 2.0], max: [-1.0 + width, 3.0], boundary };
                let mut rng = Rng::at(5, Draw::Probe, &[case as u64]);
                let points: Vec<_> = (0..300).map(|_| [-1.0 + width * rng.unit(), 2.0 + rng.unit()]).collect();
                let grid = Grid2::new(domain, points.iter().copied(), cell_size);
                for radius in [0.0, 0.03, 0.3, 2.0] {
                    for &point in points.iter().step_by(7) {
                        let mut found = Vec::new();
                        grid.for_each_within(point, radius, |id, _, d2| found.push((id, d2)));
                        found.sort_by_key(|&(id, _)| id);
                        let squared = |to| {
                            let [x, y] = domain.offset(point, to);
                            x * x + y * y
                        };
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
