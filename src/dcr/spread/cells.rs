//! The points by cells of a grid of the torus, for forces that reach less far than a cell is wide.
//!
//! Neither who a neighbour is nor how many there are matters to a force, only where they are: so the neighbours of a point
//! are looked up as three runs of memory, eight places at a time. Points stay in their cells while none has gone farther
//! than half of what the cells are wider than the forces reach, as in Verlet's lists (1967); only their places are brought
//! up to date.

use std::array::from_fn;
use std::ops::Range;

use glam::Vec2;

use super::constraints::Constraints;
use super::torus::{Place, Torus};
use crate::error::Result;
use crate::job::{Job, chunks};

/// How much wider than the forces reach the cells are, in spacings.
const SKIN: f32 = 0.25;

/// So many places at a time.
const LANES: usize = 8;

/// A torus cut into cells.
pub(super) struct Cells {
    torus: Torus,
    /// Columns and rows.
    counts: [usize; 2],
    /// How far the forces reach, in spacings.
    reach: f32,
    /// How far a point may have gone since it was given its cell.
    travelled: f32,
    /// The cell of each point.
    cells: Vec<u32>,
    /// Cell `c` holds the points `points[starts[c]..starts[c + 1]]`.
    starts: Vec<u32>,
    points: Vec<u32>,
    /// The places of these points, and some more to fill the lanes.
    x: Vec<u32>,
    y: Vec<u32>,
}

impl Cells {
    /// Sorts places into cells for forces that reach so far, in spacings. Takes O(n).
    pub(super) fn new(torus: &Torus, places: &[Place], reach: f32) -> Self {
        // A strip that is thinner than the distance of its points has no more cells than points.
        let limit = (places.len() + 8) as f64;
        let count = |length: f64| (length / f64::from(reach + SKIN)).floor().clamp(1.0, limit) as usize;
        let counts = torus.frame.size().to_array().map(count);
        let cell = |place: &Place| (along(counts, 1, place[1]) * counts[0] + along(counts, 0, place[0])) as u32;
        let cells: Vec<u32> = places.iter().map(cell).collect();
        let mut starts = vec![0; counts[0] * counts[1] + 2];
        // Counted two cells on and begun one cell on, the starts are what they shall be when all points have their slots.
        cells.iter().for_each(|&cell| starts[cell as usize + 2] += 1);
        for cell in 2..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        let mut points = vec![0; places.len()];
        for (point, &cell) in (0..).zip(&cells) {
            let next = &mut starts[cell as usize + 1];
            points[*next as usize] = point;
            *next += 1;
        }
        let [x, y] = [0, 1].map(|_| vec![0; places.len() + LANES]);
        Self { torus: *torus, counts, reach, travelled: 0.0, cells, starts, points, x, y }
    }

    /// Whether forces that reach so far are still found after points have gone so far since the last step.
    pub(super) fn still_serve(&mut self, way: f32, reach: f32) -> bool {
        self.travelled += way;
        reach + 2.0 * self.travelled <= self.reach + SKIN
    }

    /// Brings the places up to date.
    pub(super) fn update(&mut self, job: &Job, places: &[Place]) -> Result<()> {
        let chunks = chunks(self.points.len());
        let parts = self.points.chunks(chunks.size()).zip(self.x.chunks_mut(chunks.size()));
        let parts = parts.zip(self.y.chunks_mut(chunks.size()));
        job.map_each(parts.collect(), |((points, x), y)| {
            for ((&point, x), y) in points.iter().zip(x).zip(y) {
                [*x, *y] = places[point as usize];
            }
        })?;
        Ok(())
    }

    /// The columns or rows next to one, each once, as ranges.
    fn near(&self, axis: usize, index: usize) -> [Range<usize>; 2] {
        let count = self.counts[axis];
        match index {
            _ if count <= 3 => [0..count, 0..0],
            0 => [0..2, count - 1..count],
            _ if index + 1 == count => [index - 1..count, 0..1],
            _ => [index - 1..index + 2, 0..0],
        }
    }

    /// The forces on a range of points by all that conflict with them.
    #[inline(always)]
    pub(super) fn forces_portable(
        &self,
        places: &[Place],
        constraints: &Constraints,
        points: Range<usize>,
        forces: &mut Vec<Vec2>,
    ) {
        for point in points {
            let mut sum = [[0.0; LANES]; 2];
            let (row, column) =
                (self.cells[point] as usize / self.counts[0], self.cells[point] as usize % self.counts[0]);
            let columns = self.near(0, column);
            for row in self.near(1, row).into_iter().flatten() {
                for columns in columns.iter().filter(|columns| !columns.is_empty()) {
                    let start = |column| self.starts[row * self.counts[0] + column] as usize;
                    self.add(&mut sum, places[point], constraints, start(columns.start)..start(columns.end));
                }
            }
            let [x, y] = sum.map(|lanes| {
                let halves: [f32; 4] = from_fn(|i| lanes[i] + lanes[i + 4]);
                (halves[0] + halves[2]) + (halves[1] + halves[3])
            });
            forces.push(Vec2::new(x, y));
        }
    }

    /// Adds the pushes by a run of places.
    #[inline(always)]
    fn add(&self, sum: &mut [[f32; LANES]; 2], here: Place, constraints: &Constraints, run: Range<usize>) {
        let &Constraints { conflict_radius, push, .. } = constraints;
        let unit = self.torus.unit_and_longest().0;
        for first in run.clone().step_by(LANES) {
            let count = (run.end - first) as u32;
            let (xs, ys) = (&self.x[first..first + LANES], &self.y[first..first + LANES]);
            for i in 0..LANES {
                let x = xs[i].wrapping_sub(here[0]).cast_signed() as f32 * unit.x;
                let y = ys[i].wrapping_sub(here[1]).cast_signed() as f32 * unit.y;
                let squared = x * x + y * y;
                let distance = squared.sqrt();
                let is = ((i as u32) < count) & (squared < conflict_radius * conflict_radius) & (squared != 0.0);
                let pushed = if is { push * (conflict_radius.recip() - distance.recip()) } else { 0.0 };
                sum[0][i] += pushed * x;
                sum[1][i] += pushed * y;
            }
        }
    }
}

/// The column or row of a coordinate.
fn along(counts: [usize; 2], axis: usize, coordinate: u32) -> usize {
    ((u64::from(coordinate) * counts[axis] as u64) >> 32) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::maximal::Vectors;
    use crate::points::{Boundary, Domain};
    use crate::rng::{Draw, Rng};

    /// Against all pairs, on grids of many cells and of a few, before and after the points have moved a little.
    #[test]
    fn forces_are_those_of_all_pairs() {
        let context = Context::new(1).unwrap();
        let constraints = Constraints { conflict_radius: 0.92, coverage_radius: f32::INFINITY, push: 0.4, pull: 0.2 };
        for (width, count, boundary) in [
            (1.0, 403, Boundary::Periodic),
            (40.0, 60, Boundary::Periodic),
            (1.0, 9, Boundary::Periodic),
            (2.0, 90, Boundary::Bounded),
        ] {
            let torus = Torus::new(Domain { min: [0.0; 2], max: [width, 1.0], boundary }, count);
            let mut rng = Rng::at(6, Draw::Probe, &[]);
            let points: Vec<_> = (0..count).map(|_| [rng.unit() * width, rng.unit()].map(|x| x as f32)).collect();
            let mut places = torus.with_images(&torus.enter(&points, 0));
            let mut cells = Cells::new(&torus, &places, 0.92);
            for way in [0.0, 0.05, 0.05] {
                for place in &mut places[..count] {
                    *place = torus.moved(*place, Vec2::from_angle(rng.unit() as f32 * 6.3) * way);
                }
                context.run(None, |job| torus.mirror(job, &mut places, count)).unwrap();
                assert!(cells.still_serve(way, 0.92));
                context.run(None, |job| cells.update(job, &places)).unwrap();
                for vectors in Vectors::available() {
                    let mut forces = Vec::new();
                    cells.forces(vectors, &places, &constraints, 0..count, &mut forces);
                    for (&place, force) in places.iter().zip(forces) {
                        let ways = places.iter().map(|&other| torus.way(place, other));
                        let expected: Vec2 = ways.map(|way| constraints.push(way, way.length_squared())).sum();
                        assert!(force.distance(expected) < 1e-5, "{vectors:?}: {force}, not {expected}");
                    }
                }
            }
            assert!(!cells.still_serve(0.03, 0.92) && SKIN < 0.26);
        }
    }
}
