//! The points by cells of a grid of the torus, for forces that reach less far than a cell is wide.
//!
//! Neither who a neighbour is nor how many there are matters to a force, only where they are: so the neighbours of a point
//! are looked up as two runs of memory, eight places at a time. Points stay in their cells while none has gone farther
//! than half of what the cells are wider than the forces reach, as in Verlet's lists (1967); only their places are brought
//! up to date.

use std::array::from_fn;
use std::ops::Range;

use glam::Vec2;

use crate::dcr::ground::constraints::Constraints;
use crate::dcr::ground::torus::{Place, Torus};
use crate::error::Result;
use crate::job::{Job, chunks};

/// How much wider than the forces reach the cells are, in spacings.
const SKIN: f32 = 0.2;

/// So many places at a time.
pub(super) const LANES: usize = 8;

/// What the square of a distance is at least, so that that of a point from itself has a finite inverse.
pub(super) const LEAST: f32 = f32::MIN_POSITIVE;

/// How many cells beside its own the forces on a point can reach along a row.
const NEAR: usize = 3;

/// A torus cut into cells.
///
/// Rows are so high that forces on a point in the upper half of one come from it and the next only, or else from the one
/// below: two runs of cells hold all neighbours. Behind either end of a row the cells of its other end stand once more, so
/// that no run is cut.
pub(super) struct Cells {
    torus: Torus,
    rows: usize,
    /// Cells from one row to the next, and those of a run.
    stride: usize,
    width: usize,
    /// How far the forces reach, in spacings.
    reach: f32,
    /// How far a point may have gone since it was given its cell.
    travelled: f32,
    /// The first cell of the run around each point, doubled, and 1 more in the upper half of a row.
    runs: Vec<u32>,
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
        let (size, width) = (torus.frame.size(), f64::from(reach + SKIN));
        // A strip that is thinner than the distance of its points has no more cells than points.
        let limit = (places.len() + 8) as f64;
        let count = |length: f64, width: f64| (length / width).floor().clamp(1.0, limit) as usize;
        let rows = count(size.y, 2.0 * width);
        let (columns, near) = match count(size.x, width / NEAR as f64) {
            columns if columns > 2 * NEAR => (columns, NEAR),
            _ => (1, 0),
        };
        let stride = columns + 2 * near;
        let run = |&[x, y]: &Place| {
            let half = along(2 * rows, y);
            (2 * (half / 2 * stride + along(columns, x)) + half % 2) as u32
        };
        let runs: Vec<u32> = places.iter().map(run).collect();
        // The cells at the ends of rows, and where they stand once more.
        let twins = (0..rows).map(|row| row * stride);
        let twins = twins.flat_map(|row| [(row + columns, row), (row + near, row + near + columns)]);
        let mut starts = vec![0; rows * stride + 1];
        let cell = |run: u32| run as usize / 2 + near;
        runs.iter().for_each(|&run| starts[cell(run) + 1] += 1);
        twins.clone().for_each(|(from, to)| starts.copy_within(from + 1..from + 1 + near, to + 1));
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        let (mut points, mut slots) = (vec![0; starts[rows * stride] as usize], starts.clone());
        for (point, &run) in (0..).zip(&runs) {
            let slot = &mut slots[cell(run)];
            points[*slot as usize] = point;
            *slot += 1;
        }
        for (from, to) in twins {
            points.copy_within(starts[from] as usize..starts[from + near] as usize, starts[to] as usize);
        }
        let [x, y] = [0, 1].map(|_| vec![0; points.len() + LANES]);
        Self { torus: *torus, rows, stride, width: 2 * near + 1, reach, travelled: 0.0, runs, starts, points, x, y }
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

    /// The points that may be in reach of a point, as ranges.
    #[inline(always)]
    pub(super) fn around(&self, point: usize) -> [Range<usize>; 2] {
        let (first, half) = (self.runs[point] as usize / 2, self.runs[point] % 2);
        let all = self.rows * self.stride;
        let run = |first: usize| self.starts[first] as usize..self.starts[first + self.width] as usize;
        let other = match half {
            _ if self.rows == 1 => return [run(first), 0..0],
            0 if first < self.stride => first + all - self.stride,
            0 => first - self.stride,
            _ if first + self.stride >= all => first + self.stride - all,
            _ => first + self.stride,
        };
        [run(first), run(other)]
    }

    /// Eight places from one on: `x` and `y`.
    #[inline(always)]
    pub(super) fn lanes(&self, first: usize) -> [&[u32; LANES]; 2] {
        [&self.x, &self.y].map(|all| all[first..first + LANES].try_into().expect("eight of them"))
    }

    /// The lengths of 2^-32 of the periods.
    #[inline(always)]
    pub(super) fn unit(&self) -> Vec2 {
        self.torus.unit_and_longest().0
    }

    /// The force on a point by all that conflict with it, of those around.
    pub(super) fn force(&self, here: Place, constraints: &Constraints, around: [Range<usize>; 2]) -> Vec2 {
        let &Constraints { conflict_radius, push, .. } = constraints;
        let unit = self.unit();
        let mut sum = [[0.0; LANES]; 2];
        for run in around {
            for first in run.clone().step_by(LANES) {
                let [xs, ys] = self.lanes(first);
                for i in 0..LANES.min(run.end - first) {
                    let x = xs[i].wrapping_sub(here[0]).cast_signed() as f32 * unit.x;
                    let y = ys[i].wrapping_sub(here[1]).cast_signed() as f32 * unit.y;
                    let distance = (x * x + y * y).max(LEAST).sqrt();
                    // Without conflict it is 0; and so is the way of a point to itself.
                    let pushed = push * (conflict_radius.recip() - distance.recip()).min(0.0);
                    sum[0][i] += pushed * x;
                    sum[1][i] += pushed * y;
                }
            }
        }
        let [x, y] = sum.map(|lanes| {
            let halves: [f32; 4] = from_fn(|i| lanes[i] + lanes[i + 4]);
            (halves[0] + halves[2]) + (halves[1] + halves[3])
        });
        Vec2::new(x, y)
    }
}

/// The column or row of a coordinate.
fn along(count: usize, coordinate: u32) -> usize {
    ((u64::from(coordinate) * count as u64) >> 32) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::points::{Boundary, Domain};
    use crate::rng::{Draw, Rng};
    use crate::simd::Level;

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
            for way in [0.0, 0.04, 0.05] {
                for place in &mut places[..count] {
                    *place = torus.moved(*place, Vec2::from_angle(rng.unit() as f32 * 6.3) * way);
                }
                context.run(None, |job| torus.mirror(job, &mut places, count)).unwrap();
                assert!(cells.still_serve(way, 0.92));
                context.run(None, |job| cells.update(job, &places)).unwrap();
                let mut portable = None;
                for vectors in Level::available() {
                    let mut forces = Vec::new();
                    cells.forces(vectors, &places, &constraints, 0..count, &mut forces);
                    for (&place, force) in places.iter().zip(&forces) {
                        let ways = places.iter().map(|&other| torus.way(place, other));
                        let expected: Vec2 = ways.map(|way| constraints.push(way, way.length_squared())).sum();
                        assert!(force.distance(expected) < 1e-5, "{vectors:?}: {force}, not {expected}");
                    }
                    assert_eq!(&forces, portable.get_or_insert_with(|| forces.clone()), "{vectors:?}");
                }
            }
            assert!(!cells.still_serve(0.03, 0.92) && SKIN < 0.24);
        }
    }
}
