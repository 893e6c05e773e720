//! Lists of the neighbours of each point, kept while points move little, as Verlet's (1967).
//!
//! A list holds all points and images up to a skin beyond the reach of the forces. Until a point has moved by half of the
//! skin no other can have come into reach. Lists are made from points sorted into cells whose rows are as high as the lists
//! reach: nine runs of memory hold all that is near a point, sixteen positions of which are tested at a time.

use std::ops::Range;

use crate::dcr::volume::torus::{Place, VolumeTorus};
use crate::error::Result;
use crate::index::Binned;
use crate::job::{Job, chunks};
use crate::simd::{LANES, Lanes, Level, Work, run};

/// The number of cells along a row that lists reach on either side of a point's own.
const NEAR: usize = 3;

/// The number of vectors that most lists have at most.
const USUAL: usize = 2;

/// The numbers of the lanes.
const NUMBERS: [i32; LANES] = {
    let mut numbers = [0; LANES];
    let mut lane = 0;
    while lane < LANES {
        numbers[lane] = lane as i32;
        lane += 1;
    }
    numbers
};

/// The lists of consecutive points: vectors of names, the last one of a list filled up with the name of its point.
#[derive(Default)]
pub struct Lists {
    /// The end of each list.
    ends: Vec<u32>,
    names: Vec<[u32; LANES]>,
}

impl Lists {
    /// The lists, in order.
    pub fn iter(&self) -> impl Iterator<Item = &[[u32; LANES]]> {
        let starts = std::iter::once(&0).chain(&self.ends);
        starts.zip(&self.ends).map(|(&from, &to)| &self.names[from as usize..to as usize])
    }
}

/// Lists of the first `count` places, by chunks of them, which hold all others, and all images of these and of the points, up to
/// a radius in spacings.
pub fn lists(
    job: &Job,
    torus: &VolumeTorus,
    level: Level,
    places: &[Place],
    count: usize,
    radius: f64,
) -> Result<Vec<Lists>> {
    let cells = Cells::new(torus, places, radius);
    job.report(0.3)?;
    let tasks = chunks(count);
    job.part(0.3, 1.0).map(tasks.len(), |task| {
        let points = tasks.range(task);
        run(level, Listing { cells: &cells, places: &places[points.clone()], first: points.start as u32 })
    })
}

/// The points in the cells of a grid of the torus. The cells at each end of a row are repeated beyond its other end.
struct Cells {
    unit: [f32; 3],
    radius: f32,
    columns: usize,
    /// The cells before the first of a row, and after the last.
    near: usize,
    rows: [usize; 2],
    /// The points by cells.
    points: Binned<u32>,
    /// Their coordinates, padded to fill the lanes.
    coordinates: [Vec<i32>; 3],
    /// Their names.
    names: Vec<i32>,
}

impl Cells {
    fn new(torus: &VolumeTorus, places: &[Place], radius: f64) -> Self {
        let periods = torus.periods();
        // No more cells than points on an axis along which these stand in a line.
        let limit = (places.len() + 8) as f64;
        let number = |length: f64, width: f64| (length / width).floor().clamp(1.0, limit) as usize;
        let rows = [number(periods[1], radius), number(periods[2], radius)];
        let (columns, near) = match number(periods[0], radius / NEAR as f64) {
            columns if columns > 2 * NEAR => (columns, NEAR),
            _ => (1, 0),
        };
        let mut cells = Self {
            unit: torus.unit().map(|unit| unit as f32),
            radius: radius as f32,
            columns,
            near,
            rows,
            points: Binned::default(),
            coordinates: Default::default(),
            names: Vec::new(),
        };
        let own: Vec<u32> = places.iter().map(|place| cells.cell(place) as u32).collect();
        let own = (0..).zip(&own).map(|(point, &cell)| (cell as usize, point));
        let repeated = own.clone().zip(places).filter_map(|((cell, point), place)| match along(columns, place[0]) {
            column if column < near => Some((cell + columns, point)),
            column if column >= columns - near => Some((cell - columns, point)),
            _ => None,
        });
        let repeated: Vec<(usize, u32)> = repeated.collect();
        cells.points = Binned::new(rows[0] * rows[1] * cells.stride(), own.chain(repeated.iter().copied()));
        let padded = |coordinate: &dyn Fn(u32) -> i32| {
            let coordinates = cells.points.items().iter().map(|&point| coordinate(point));
            coordinates.chain([0; LANES]).collect::<Vec<i32>>()
        };
        let coordinates = [0, 1, 2].map(|axis| padded(&|point| places[point as usize][axis].cast_signed()));
        let names = padded(&u32::cast_signed);
        Self { coordinates, names, ..cells }
    }

    /// The number of cells from one row to the next.
    #[inline(always)]
    fn stride(&self) -> usize {
        self.columns + 2 * self.near
    }

    /// The cell of a place.
    fn cell(&self, &[x, y, z]: &Place) -> usize {
        let row = along(self.rows[1], z) * self.rows[0] + along(self.rows[0], y);
        row * self.stride() + self.near + along(self.columns, x)
    }

    /// The runs of points around a place, and their number.
    #[inline(always)]
    fn around(&self, [x, y, z]: Place) -> ([Range<usize>; 9], usize) {
        let column = along(self.columns, x);
        let ([rows_y, rows_z], mut runs) = ([next_to(self.rows[0], y), next_to(self.rows[1], z)], [const { 0..0 }; 9]);
        let (mut count, mut k) = (0, 0);
        while k < 9 {
            let (row_y, row_z) = (rows_y[k % 3], rows_z[k / 3]);
            if row_y < self.rows[0] && row_z < self.rows[1] {
                let first = (row_z * self.rows[0] + row_y) * self.stride() + column;
                runs[count] = self.points.range(first..first + 2 * self.near + 1);
                count += 1;
            }
            k += 1;
        }
        (runs, count)
    }
}

/// The row or column of a coordinate.
#[inline(always)]
fn along(count: usize, coordinate: u32) -> usize {
    ((u64::from(coordinate) * count as u64) >> 32) as usize
}

/// The row of a coordinate and those beside it, each once; in place of a row that there is not, one that is out of range.
#[inline(always)]
fn next_to(count: usize, coordinate: u32) -> [usize; 3] {
    let row = along(count, coordinate);
    let before = if row == 0 { count - 1 } else { row - 1 };
    let after = if row + 1 == count { 0 } else { row + 1 };
    [row, if count > 1 { before } else { count }, if count > 2 { after } else { count }]
}

/// Lists points that follow each other.
struct Listing<'a> {
    cells: &'a Cells,
    places: &'a [Place],
    /// The name of the first.
    first: u32,
}

impl Work for Listing<'_> {
    type Out = Lists;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Lists {
        let cells = self.cells;
        let mut lists =
            Lists { ends: Vec::with_capacity(self.places.len()), names: Vec::with_capacity(USUAL * self.places.len()) };
        // The names in the list of a point, with space for one vector more.
        let mut found = vec![0i32; 4 * LANES];
        let most = lanes.splat(cells.radius * cells.radius);
        for (&here, name) in self.places.iter().zip(self.first..) {
            let mut count = 0;
            let (runs, number) = cells.around(here);
            for run in &runs[..number] {
                let mut first = run.start;
                while first < run.end {
                    let squared = squares(lanes, cells, here, first);
                    // Neither what is at the same place, as the point itself, nor what is beyond the run.
                    let is_near = lanes.both(lanes.at_most(squared, most), lanes.less(lanes.splat(0.0), squared));
                    let left = lanes.splat_int((run.end - first) as i32);
                    let is_near = lanes.both(is_near, lanes.less_ints(lanes.load_ints(&NUMBERS), left));
                    let names = lanes.load_ints(sixteen(&cells.names, first));
                    if found.len() < count + LANES {
                        found.resize(2 * (count + LANES), 0);
                    }
                    let to = found[count..].first_chunk_mut().expect("resized");
                    lanes.compress_ints(is_near, names, to);
                    count += lanes.bits(is_near).count_ones() as usize;
                    first += LANES;
                }
            }
            for names in found[..count].chunks(LANES) {
                let mut vector = [name; LANES];
                for (to, name) in vector.iter_mut().zip(names) {
                    *to = name.cast_unsigned();
                }
                lists.names.push(vector);
            }
            lists.ends.push(lists.names.len() as u32);
        }
        lists
    }
}

/// The squared distances of sixteen positions from a place.
#[inline(always)]
fn squares<L: Lanes>(lanes: L, cells: &Cells, here: Place, first: usize) -> L::Floats {
    let mut sum = lanes.splat(0.0);
    let mut axis = 0;
    while axis < 3 {
        let there = lanes.load_ints(sixteen(&cells.coordinates[axis], first));
        let offset = lanes.floats(lanes.sub_ints(there, lanes.splat_int(here[axis].cast_signed())));
        let offset = lanes.mul(offset, lanes.splat(cells.unit[axis]));
        sum = lanes.add(sum, lanes.mul(offset, offset));
        axis += 1;
    }
    sum
}

#[inline(always)]
fn sixteen(of: &[i32], first: usize) -> &[i32; LANES] {
    of[first..].first_chunk().expect("sixteen of them")
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::job::Context;
    use crate::points::{Boundary, Domain};
    use crate::rng::{Draw, Rng};

    /// Against all pairs: where cells are few and many, in heaps, and with names beyond the points.
    #[test]
    fn lists_hold_what_is_near() {
        let context = Context::new(1).unwrap();
        for (max, count, boundary) in [
            ([1.0; 3], 700, Boundary::Periodic),
            ([1.0; 3], 30, Boundary::Periodic),
            ([9.0, 0.2, 1.0], 90, Boundary::Bounded),
            ([0.2, 9.0, 0.001], 90, Boundary::Periodic),
        ] {
            for heap in [1.0, 0.1] {
                let torus = VolumeTorus::new(Domain { min: [0.0; 3], max, boundary }, count);
                let mut rng = Rng::at(9, Draw::Probe, &[]);
                let places: Vec<Place> =
                    (0..count).map(|_| torus.fraction([0; 3].map(|_| heap * rng.unit()))).collect();
                let points = count / 2;
                for (level, radius) in Level::available().into_iter().flat_map(|level| [(level, 1.0f32), (level, 1.55)])
                {
                    let lists =
                        context.run(None, |job| lists(job, &torus, level, &places, points, radius.into())).unwrap();
                    let mut listed = 0;
                    for (point, list) in lists.iter().flat_map(Lists::iter).enumerate() {
                        let mut names: Vec<u32> =
                            list.as_flattened().iter().copied().filter(|&name| name as usize != point).collect();
                        names.sort_unstable();
                        let squared = |other: usize| {
                            let along = |axis: usize| {
                                let offset = places[other][axis].wrapping_sub(places[point][axis]).cast_signed();
                                offset as f32 * torus.unit()[axis] as f32
                            };
                            along(0) * along(0) + along(1) * along(1) + along(2) * along(2)
                        };
                        let is_near = |&other: &usize| squared(other) <= radius * radius && squared(other) > 0.0;
                        let near: Vec<u32> = (0..count).filter(is_near).map(|other| other as u32).collect();
                        assert_eq!(names, near, "{max:?} {count} {boundary:?} {heap} {level:?}: {point}");
                        listed += 1;
                    }
                    assert_eq!(listed, points);
                }
            }
        }
    }
}
