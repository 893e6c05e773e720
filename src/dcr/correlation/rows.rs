//! The points of a torus in rows of cells, for forces that reach over many spacings.
//!
//! Reaches of 12 spacings have 450 neighbours, whose lists would be as long to read as the points themselves. So the points
//! are sorted into the cells of rows that are low against the reach, of each row those within the circle around a point
//! are one run of memory, and sixteen of them are processed at a time. The cells at the ends of a row are repeated
//! beyond its other end, so that no run is cut.

use std::ops::Range;

use glam::Vec2;

use crate::dcr::correlation::tension::{Counts, TABLE, Table};
use crate::dcr::torus::{TURN, Torus, TorusPoint};
use crate::index::Binned;
use crate::simd::{LANES, Lanes, Level, Work, run};

/// The height of rows and the width of cells, in spacings of the torus, and the least number of either: with a reach of
/// at most [`WIDEST`] of a period, runs then do not meet themselves across it.
const HEIGHT: f64 = 2.2;
const WIDTH: f64 = 0.75;
const LEAST: f64 = 20.0;

/// The largest reach, in the shorter period.
pub const WIDEST: f64 = 0.42;

/// A margin for the rounding of ends of runs, in cells.
const MARGIN: f32 = 0.01;

/// The numbers of the lanes.
const NUMBERS: [f32; LANES] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0];

/// A float whose spacing is 1: the lowest bits of a sum with it are the nearest integer.
const INTEGERS: f32 = (1 << 23) as f32;

/// The points in their cells.
pub struct Rows {
    /// Length of 2^-32 of the periods, in spacings.
    unit: Vec2,
    /// The reach, in rows and in cells of a row, and in spacings.
    reach: f32,
    size: Vec2,
    rows: usize,
    columns: usize,
    /// The cells repeated at either end of a row.
    repeated: usize,
    points: Binned<TorusPoint>,
    /// The coordinates, by cells, padded to fill the lanes.
    x: Vec<i32>,
    y: Vec<i32>,
}

impl Rows {
    /// Sorts points for a reach in spacings, at most [`WIDEST`] of either period. Takes O(n).
    pub fn new(torus: &Torus, places: &[TorusPoint], reach: f32) -> Self {
        let size = torus.frame.size();
        // A strip that is thinner than the distance of its points has not many more cells than points.
        let limit = places.len() as f64 + LEAST;
        let count = |length: f64, cell: f64| (length / cell).floor().min(limit).max(LEAST) as usize;
        let (rows, columns) = (count(size.y, HEIGHT), count(size.x, WIDTH));
        let cell = Vec2::new((size.x / columns as f64) as f32, (size.y / rows as f64) as f32);
        let repeated = (reach / cell.x) as usize + 2;
        let stride = columns + 2 * repeated;
        let own = places.iter().map(|&place| {
            let [column, row] = [along(columns, place[0]), along(rows, place[1])];
            (row * stride + repeated + column, column, place)
        });
        let cells = own.flat_map(|(cell, column, place)| {
            let after = (column < repeated).then_some((cell + columns, place));
            let before = (column + repeated >= columns).then(|| (cell - columns, place));
            [Some((cell, place)), after, before].into_iter().flatten()
        });
        let points = Binned::new(rows * stride, cells);
        let [x, y] = [0, 1].map(|axis| {
            let coordinates = points.items().iter().map(|place| place[axis].cast_signed());
            coordinates.chain([0; LANES]).collect()
        });
        let unit = torus.unit_and_longest().0;
        Self { unit, reach, size: cell, rows, columns, repeated, points, x, y }
    }

    /// Adds up the forces of all points on each of `here`, and counts the pairs. `per_spacing` is the number of steps of
    /// the table in a spacing, and `beyond` the first that is out of reach.
    pub fn gather(&self, level: Level, law: &Law, here: &[TorusPoint], forces: &mut Vec<Vec2>, counts: &mut Counts) {
        run(level, Gather { rows: self, law, here, forces, counts });
    }

    /// Visits the runs of points that may be in reach of a point, and how many rows each is above its own.
    #[inline(always)]
    fn for_each_run(&self, [x, y]: TorusPoint, mut visit: impl FnMut(isize, Range<usize>)) {
        let of_period = |coordinate: u32, cells: usize| coordinate as f32 / TURN as f32 * cells as f32;
        let (column, row) = (of_period(x, self.columns) + self.repeated as f32, of_period(y, self.rows));
        let (own, most) = (along(self.rows, y), (self.reach / self.size.y) as isize + 1);
        let stride = self.columns + 2 * self.repeated;
        for other in own as isize - most..=own as isize + most {
            // The distance to the nearest edge of the row.
            let low = (other as f32 - row).max(row - (other + 1) as f32).max(0.0) * self.size.y;
            let squared = self.reach * self.reach - low * low;
            if squared < 0.0 {
                continue;
            }
            let half = squared.sqrt() / self.size.x + MARGIN;
            let first = other.rem_euclid(self.rows as isize) as usize * stride;
            let end = (column + half) as usize + 1;
            visit(
                other - own as isize,
                self.points.range(first + (column - half).max(0.0) as usize..first + end.min(stride)),
            );
        }
    }
}

/// The law of the forces of a step.
pub struct Law<'a> {
    pub table: &'a Table,
    /// The steps of the table in a spacing.
    pub per_spacing: f32,
    /// The first entry that is out of reach.
    pub beyond: usize,
}

/// [`Rows::gather`].
struct Gather<'a> {
    rows: &'a Rows,
    law: &'a Law<'a>,
    here: &'a [TorusPoint],
    forces: &'a mut Vec<Vec2>,
    counts: &'a mut Counts,
}

impl Work for Gather<'_> {
    type Out = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Self { rows, law, here, forces, counts } = self;
        for &place in here {
            let [mut x, mut y] = [lanes.splat(0.0); 2];
            rows.for_each_run(place, |above, run| {
                for first in run.clone().step_by(LANES) {
                    let [dx, dy] = rows.offsets(lanes, first, place);
                    let squared = lanes.add(lanes.mul(dx, dx), lanes.mul(dy, dy));
                    let steps = lanes.mul(lanes.sqrt(squared), lanes.splat(law.per_spacing));
                    // Those after the run count as out of reach.
                    let are = lanes.less(lanes.load(&NUMBERS), lanes.splat((run.end - first) as f32));
                    let beyond = lanes.splat(law.beyond as f32);
                    let steps = lanes.min(lanes.select(are, steps, beyond), beyond);
                    let entries = entries(lanes, lanes.add(steps, lanes.splat(INTEGERS)));
                    count(&entries, counts, (1 + above.signum()) as u32);
                    let factors = look_up(lanes, law.table, &entries);
                    x = lanes.sub(x, lanes.mul(factors, dx));
                    y = lanes.sub(y, lanes.mul(factors, dy));
                }
            });
            forces.push(Vec2::new(lanes.sum(x), lanes.sum(y)));
        }
    }
}

impl Rows {
    /// The offsets of sixteen points from one.
    #[inline(always)]
    fn offsets<L: Lanes>(&self, lanes: L, first: usize, place: TorusPoint) -> [L::Floats; 2] {
        let along = |coordinates: &[i32], here: u32, unit: f32| {
            let there = lanes.load_ints(coordinates[first..].first_chunk().expect("padded to fill the lanes"));
            lanes.mul(lanes.floats(lanes.sub_ints(there, lanes.splat_int(here.cast_signed()))), lanes.splat(unit))
        };
        [along(&self.x, place[0], self.unit.x), along(&self.y, place[1], self.unit.y)]
    }
}

// Functions, since closures are not always inlined, and without that they are not compiled for the level.

/// The integers that floats have in their lowest bits.
#[inline(always)]
fn entries<L: Lanes>(lanes: L, numbers: L::Floats) -> [u32; LANES] {
    let (mut stored, mut entries) = ([0.0; LANES], [0; LANES]);
    lanes.store(numbers, &mut stored);
    for lane in 0..LANES {
        entries[lane] = stored[lane].to_bits() % TABLE as u32;
    }
    entries
}

/// The entries of a table.
#[inline(always)]
fn look_up<L: Lanes>(lanes: L, table: &Table, entries: &[u32; LANES]) -> L::Floats {
    let mut factors = [0.0; LANES];
    for lane in 0..LANES {
        factors[lane] = table[entries[lane] as usize % TABLE];
    }
    lanes.load(&factors)
}

/// Adds a number to the counts of entries.
#[inline(always)]
fn count(entries: &[u32; LANES], counts: &mut Counts, number: u32) {
    if number > 0 {
        for lane in 0..LANES {
            counts[entries[lane] as usize % TABLE] += number;
        }
    }
}

/// The row or column of a coordinate.
fn along(count: usize, coordinate: u32) -> usize {
    ((u64::from(coordinate) * count as u64) >> 32) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::{Boundary, Domain};
    use crate::rng::{Draw, Rng};

    /// Against all pairs, on grids of many cells and of few, in reaches up to the widest, with each level.
    #[test]
    fn forces_and_counts_are_those_of_all_pairs() {
        for (width, count, share) in
            [(1.0, 1500, 0.2), (1.0, 40, 0.42), (9.0, 300, 0.42), (0.02, 150, 0.3), (1.0, 2, 0.4)]
        {
            let torus = Torus::new(Domain { min: [0.0; 2], max: [width, 1.0], boundary: Boundary::Periodic }, count);
            let mut rng = Rng::at(6, Draw::Probe, &[count as u64]);
            let points: Vec<_> = (0..count).map(|_| [rng.unit() * width, rng.unit()].map(|x| x as f32)).collect();
            let places = torus.enter(&points, 0);
            let reach = (share * torus.frame.size().min_element()) as f32;
            let (beyond, mut table) = (700, [0.0; TABLE]);
            table[..beyond].iter_mut().for_each(|entry| *entry = rng.unit() as f32);
            let law = Law { table: &table, per_spacing: (beyond as f32 - 0.5) / reach, beyond };
            let (mut expected, mut pairs) = (vec![Vec2::ZERO; count], [0; TABLE]);
            for (sum, &place) in expected.iter_mut().zip(&places) {
                for &other in &places {
                    let offset = torus.offset_f32(place, other);
                    let entry = ((offset.length() * law.per_spacing).round_ties_even() as usize).min(beyond);
                    *sum -= table[entry] * offset;
                    pairs[entry] += 1;
                }
            }
            let rows = Rows::new(&torus, &places, reach);
            let mut portable = None;
            for level in Level::available() {
                let (mut forces, mut counts) = (Vec::new(), [0; TABLE]);
                rows.gather(level, &law, &places, &mut forces, &mut counts);
                let bound = 1e-5 * (count as f32).sqrt() * (1.0 + reach);
                assert!(
                    forces.iter().zip(&expected).all(|(a, b)| a.distance(*b) < bound),
                    "{level:?}, {width}, {count}"
                );
                // A pair at the edge of an entry may be counted in the next by one of its ends.
                let apart: u32 = (0..beyond).map(|k| counts[k].abs_diff(pairs[k])).sum();
                assert!(apart as usize <= count / 20, "{level:?}, {width}, {count}: {apart}");
                counts[beyond] = 0;
                assert_eq!(&(forces.clone(), counts), portable.get_or_insert((forces, counts)), "{level:?}");
            }
        }
    }
}
