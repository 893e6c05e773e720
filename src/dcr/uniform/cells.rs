//! The points in the cells of a grid of the torus, for forces with a reach shorter than a cell is wide.
//!
//! A force depends neither on which point a neighbour is nor on the number of neighbours, only on their positions: so
//! the neighbours of a point are found as two runs of memory, eight points of each at a time. Points stay in their
//! cells while none has moved by more than half of the skin, the width that cells have beyond the reach, as in Verlet's
//! lists (1967); only their coordinates are updated.

use std::ops::Range;

use glam::Vec2;

use crate::dcr::law::Constraints;
use crate::dcr::torus::{Torus, TorusPoint};
use crate::error::Result;
use crate::index::Binned;
use crate::job::{Job, chunks};
use crate::simd::{HALF, LANES, Lanes, Level, Work, run};

/// The width of cells beyond the reach of the forces, in spacings.
const SKIN: f32 = 0.2;

/// The least square of a distance, so that even a point's distance from itself has a finite inverse.
const LEAST: f32 = f32::MIN_POSITIVE;

/// For each number of points, up to eight: -1 in as many lanes from the first on, and 0 after them.
const FIRST: [[i32; HALF]; HALF + 1] = {
    let mut first = [[0; HALF]; HALF + 1];
    let mut count = 0;
    while count <= HALF {
        let mut lane = 0;
        while lane < count {
            first[count][lane] = -1;
            lane += 1;
        }
        count += 1;
    }
    first
};

/// The number of cells along a row that the forces on a point reach on either side of its own.
const NEAR: usize = 3;

/// A torus cut into cells.
///
/// Rows are so high that forces on a point in the upper half of one come from it and the next row only, and those in
/// the lower half from it and the row below: two runs of cells hold all neighbours. The cells at each end of a row are
/// repeated beyond its other end, so that no run is cut.
pub struct VerletCells {
    torus: Torus,
    rows: usize,
    /// The number of cells from one row to the next, and of a run.
    stride: usize,
    width: usize,
    /// The reach of the forces, in spacings.
    reach: f32,
    /// The longest distance that a point may have moved since it was assigned to its cell.
    travelled: f32,
    /// The first cell of the run around each point, doubled, and 1 more in the upper half of a row.
    runs: Vec<u32>,
    /// The points by cells.
    points: Binned<u32>,
    /// The coordinates of the points, padded to fill the lanes.
    x: Vec<i32>,
    y: Vec<i32>,
}

impl VerletCells {
    /// Sorts points into cells for forces of this reach, in spacings. Takes O(n).
    pub fn new(torus: &Torus, places: &[TorusPoint], reach: f32) -> Self {
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
        let run = |&[x, y]: &TorusPoint| {
            let half = along(2 * rows, y);
            (2 * (half / 2 * stride + along(columns, x)) + half % 2) as u32
        };
        let runs: Vec<u32> = places.iter().map(run).collect();
        let own = (0..).zip(&runs).map(|(point, &run)| (run as usize / 2 + near, point));
        // Points in the cells at one end of a row are repeated beyond the other, in cells of their own.
        let repeated = own.clone().zip(places).filter_map(|((cell, point), &[x, _])| match along(columns, x) {
            column if column < near => Some((cell + columns, point)),
            column if column >= columns - near => Some((cell - columns, point)),
            _ => None,
        });
        let repeated: Vec<(usize, u32)> = repeated.collect();
        let points = Binned::new(rows * stride, own.chain(repeated.iter().copied()));
        let [x, y] = [0, 1].map(|_| vec![0; points.items().len() + LANES]);
        Self { torus: *torus, rows, stride, width: 2 * near + 1, reach, travelled: 0.0, runs, points, x, y }
    }

    /// True if all forces of this reach are still found after a step in which points have moved by up to `distance`.
    pub fn still_serve(&mut self, distance: f32, reach: f32) -> bool {
        self.travelled += distance;
        reach + 2.0 * self.travelled <= self.reach + SKIN
    }

    /// Updates the coordinates.
    pub fn update(&mut self, job: &Job, places: &[TorusPoint]) -> Result<()> {
        let points = self.points.items();
        let chunks = chunks(points.len());
        let parts = points.chunks(chunks.size()).zip(self.x.chunks_mut(chunks.size()));
        let parts = parts.zip(self.y.chunks_mut(chunks.size()));
        job.map_each(parts.collect(), |((points, x), y)| {
            for ((&point, x), y) in points.iter().zip(x).zip(y) {
                [*x, *y] = places[point as usize].map(u32::cast_signed);
            }
        })?;
        Ok(())
    }

    /// The points that may be in reach of a point, as ranges.
    #[inline(always)]
    pub fn around(&self, point: usize) -> [Range<usize>; 2] {
        let (first, half) = (self.runs[point] as usize / 2, self.runs[point] % 2);
        let all = self.rows * self.stride;
        let run = |first: usize| self.points.range(first..first + self.width);
        let other = match half {
            _ if self.rows == 1 => return [run(first), 0..0],
            0 if first < self.stride => first + all - self.stride,
            0 => first - self.stride,
            _ if first + self.stride >= all => first + self.stride - all,
            _ => first + self.stride,
        };
        [run(first), run(other)]
    }

    /// Adds the forces on a range of points by all others that conflict with them to `forces`.
    pub fn gather(
        &self,
        level: Level,
        places: &[TorusPoint],
        constraints: &Constraints,
        points: Range<usize>,
        forces: &mut Vec<Vec2>,
    ) {
        run(level, Gather { cells: self, places, constraints, points, forces });
    }
}

/// [`VerletCells::gather`].
struct Gather<'a> {
    cells: &'a VerletCells,
    places: &'a [TorusPoint],
    constraints: &'a Constraints,
    points: Range<usize>,
    forces: &'a mut Vec<Vec2>,
}

impl Work for Gather<'_> {
    type Out = ();

    const IS_WIDE: bool = false;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Self { cells, places, constraints, points, forces } = self;
        // Copies, which no store into memory can change, and so are broadcast once.
        let law = Law { cells, unit: cells.torus.unit_and_longest().0, constraints: *constraints };
        for point in points {
            forces.push(law.force(lanes, places[point], cells.around(point)));
        }
    }
}

/// The law of the forces in the cells.
struct Law<'a> {
    cells: &'a VerletCells,
    /// The lengths of 2^-32 of the periods.
    unit: Vec2,
    constraints: Constraints,
}

impl Law<'_> {
    /// The force on a point by all points of these ranges that conflict with it.
    ///
    /// Each of the lower eight lanes adds one point after the other, up to the last eight, which the upper lanes hold.
    #[inline(always)]
    fn force<L: Lanes>(&self, lanes: L, here: TorusPoint, [near, other]: [Range<usize>; 2]) -> Vec2 {
        let last = other.start + other.len().saturating_sub(1) / HALF * HALF;
        let first = near.start..near.end.min(near.start + HALF);
        let [mut x, mut y] = self.pushes(lanes, here, [first, last..other.end]);
        for run in [near.start + HALF..near.end, other.start..last] {
            for first in run.clone().step_by(HALF) {
                let pushes = self.pushes(lanes, here, [first..run.end.min(first + HALF), 0..0]);
                (x, y) = (lanes.add(x, pushes[0]), lanes.add(y, pushes[1]));
            }
        }
        Vec2::new(lanes.sum(x), lanes.sum(y))
    }

    /// The forces on a point along `x` and along `y` by up to eight points of each range.
    #[inline(always)]
    fn pushes<L: Lanes>(&self, lanes: L, here: TorusPoint, around: [Range<usize>; 2]) -> [L::Floats; 2] {
        let [near, other] = around;
        let starts = [near.start, other.start];
        let x = offsets(lanes, eights(lanes, &self.cells.x, starts), here[0], self.unit.x);
        let y = offsets(lanes, eights(lanes, &self.cells.y, starts), here[1], self.unit.y);
        let squared = lanes.add(lanes.mul(x, x), lanes.mul(y, y));
        let distance = lanes.sqrt(lanes.max(squared, lanes.splat(LEAST)));
        // Without conflict the factor is 0; the offset of a point from itself is 0 too.
        let pushed = lanes.min(self.constraints.conflicts(lanes, distance), lanes.splat(0.0));
        let are = lanes.load_halves([&FIRST[near.len()], &FIRST[other.len()]]);
        let pushed = lanes.only(lanes.less_ints(are, lanes.splat_int(0)), pushed);
        [lanes.mul(pushed, x), lanes.mul(pushed, y)]
    }
}

// Functions, since closures are not always inlined, and without that they are not compiled for the level.

/// Eight numbers from each of two places on.
#[inline(always)]
fn eights<L: Lanes>(lanes: L, of: &[i32], [near, other]: [usize; 2]) -> L::Ints {
    let [near, other] = [of[near..].first_chunk(), of[other..].first_chunk()];
    lanes.load_halves([near.expect("eight of them"), other.expect("eight of them")])
}

/// The offsets of coordinates from one, in units of a length.
#[inline(always)]
fn offsets<L: Lanes>(lanes: L, coordinates: L::Ints, here: u32, unit: f32) -> L::Floats {
    let offsets = lanes.sub_ints(coordinates, lanes.splat_int(here.cast_signed()));
    lanes.mul(lanes.floats(offsets), lanes.splat(unit))
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

    /// Against all pairs, on grids of many cells and of a few, before and after the points have moved a little.
    #[test]
    fn forces_in_cells_are_those_of_all_pairs() {
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
            let mut cells = VerletCells::new(&torus, &places, 0.92);
            for distance in [0.0, 0.04, 0.05] {
                for place in &mut places[..count] {
                    *place = torus.moved(*place, Vec2::from_angle(rng.unit() as f32 * 6.3) * distance);
                }
                context.run(None, |job| torus.mirror(job, &mut places, count)).unwrap();
                assert!(cells.still_serve(distance, 0.92));
                context.run(None, |job| cells.update(job, &places)).unwrap();
                let mut portable = None;
                for level in Level::available() {
                    let mut forces = Vec::new();
                    cells.gather(level, &places, &constraints, 0..count, &mut forces);
                    for (&place, force) in places.iter().zip(&forces) {
                        let offsets = places.iter().map(|&other| torus.offset_f32(place, other));
                        let expected: Vec2 =
                            offsets.map(|offset| constraints.push(offset, offset.length_squared())).sum();
                        assert!(force.distance(expected) < 1e-5, "{level:?}: {force}, not {expected}");
                    }
                    assert_eq!(&forces, portable.get_or_insert_with(|| forces.clone()), "{level:?}");
                }
            }
            assert!(!cells.still_serve(0.03, 0.92));
        }
    }
}
