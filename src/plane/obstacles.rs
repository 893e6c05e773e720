//! Disks in the plane in addition to the samples of a grid, of any radii and at any positions: no sample may lie in
//! one, and points in one are covered. Balls, if `D` is 3.
//!
//! Their centres need not lie on the lattice, so distances to them are numbers in `f64`. A lattice point lies in a disk
//! if its computed distance does, and a rectangle of them if its farthest corner does. Rounding is monotone, so then
//! all of its points do: the two tests are consistent, and a search for uncovered points ends.

use crate::given::Given;
use crate::index::Binned;
use crate::math::pow;
use crate::plane::{lattice::Lattice, rect::Rect};
use crate::points::{Boundary, Domain};

/// A disk in lattice units, without its boundary; a ball if `D` is 3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Disk<const D: usize = 2> {
    pub centre: [f64; D],
    pub radius: f64,
}

impl<const D: usize> Disk<D> {
    /// True if all lattice points of a rectangle lie in the disk.
    pub fn covers(&self, rect: &Rect<D>) -> bool {
        self.reaches(|axis| {
            let ends = [f64::from(rect.min[axis]), f64::from(rect.max[axis] - 1)];
            ends.map(|end| (end - self.centre[axis]).abs()).into_iter().fold(0.0, f64::max)
        })
    }

    /// True if the disk may have points of a rectangle of lattice points.
    pub fn meets(&self, rect: &Rect<D>) -> bool {
        self.reaches(|axis| {
            let (first, last) = (f64::from(rect.min[axis]), f64::from(rect.max[axis] - 1));
            (first - self.centre[axis]).max(self.centre[axis] - last).max(0.0)
        })
    }

    /// True if a vector from the centre ends in the disk.
    pub fn reaches(&self, along: impl Fn(usize) -> f64) -> bool {
        (0..D).map(|axis| along(axis) * along(axis)).sum::<f64>() < self.radius * self.radius
    }
}

/// The disks that matter to the cells of a grid.
#[derive(Default)]
pub(crate) struct Obstacles {
    columns: usize,
    /// For each cell, true if one disk covers it.
    covered: Vec<bool>,
    /// For each other cell the disks that may have points of it.
    met: Binned<u32>,
    disks: Vec<Disk>,
}

impl Obstacles {
    /// The obstacles of a grid whose columns and rows of cells begin at these lattice points, with the end of the last.
    /// `cell` is the column (axis 0) or row (axis 1) of a lattice point of the grid.
    pub fn new(edges: &[Vec<i32>; 2], cell: impl Fn(usize, i32) -> usize, mut disks: Vec<Disk>) -> Self {
        let [columns, rows] = [0, 1].map(|axis: usize| edges[axis].len() - 1);
        let span = |axis: usize, place: f64, reach: f64| {
            let (first, last) = (f64::from(edges[axis][0]), f64::from(*edges[axis].last().unwrap_or(&0)) - 1.0);
            let (from, to) = ((place - reach).ceil().max(first), (place + reach).floor().min(last));
            if from > to { 0..0 } else { cell(axis, from as i32)..cell(axis, to as i32) + 1 }
        };
        let (mut covered, mut met) = (vec![false; columns * rows], Vec::new());
        // Large disks first: cells that they cover are not tested again.
        disks.sort_unstable_by(|a, b| b.radius.total_cmp(&a.radius));
        for (index, disk) in (0..).zip(&disks) {
            for y in span(1, disk.centre[1], disk.radius) {
                // The half width of the disk where it is widest in this row.
                let rows = [edges[1][y], edges[1][y + 1]];
                let (low, high) = (f64::from(rows[0]), f64::from(rows[1] - 1));
                let away = (low - disk.centre[1]).max(disk.centre[1] - high).max(0.0);
                let half = (disk.radius * disk.radius - away * away).max(0.0).sqrt();
                let columns_met = span(0, disk.centre[0], half);
                let row = &mut covered[y * columns..][..columns];
                if row[columns_met.clone()].iter().all(|&is_covered| is_covered) {
                    continue;
                }
                let covers =
                    |x: &usize| disk.covers(&Rect { min: [edges[0][*x], rows[0]], max: [edges[0][x + 1], rows[1]] });
                // The cells of a row that it covers form one run.
                let start = columns_met.clone().find(covers).unwrap_or(columns_met.end);
                let stop = (start..columns_met.end).rfind(covers).map_or(start, |x| x + 1);
                row[start..stop].fill(true);
                let cells = (columns_met.start..start).chain(stop..columns_met.end).filter(|&x| !row[x]);
                met.extend(cells.map(|x| ((y * columns + x) as u32, index)));
            }
        }
        let met = met.iter().filter(|(cell, _)| !covered[*cell as usize]).map(|&(cell, disk)| (cell as usize, disk));
        let met = Binned::new(covered.len(), met);
        Self { columns, covered, met, disks }
    }

    /// True if there are no disks.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.covered.is_empty()
    }

    /// The columns and rows of the cells that one disk covers.
    pub fn covered_cells(&self) -> impl Iterator<Item = [usize; 2]> {
        let cells = self.covered.iter().enumerate().filter(|(_, is_covered)| **is_covered);
        cells.map(|(cell, _)| [cell % self.columns, cell / self.columns])
    }

    /// True if one disk covers all of a rectangle of lattice points in a cell.
    pub fn cover(&self, [x, y]: [i32; 2], rect: &Rect) -> bool {
        let cell = y as usize * self.columns + x as usize;
        self.covered[cell] || self.met.bin(cell).iter().any(|&disk| self.disks[disk as usize].covers(rect))
    }
}

// # Given samples
//
// Given samples, around which sets are made: as disks on the lattice, found by position.
//
// # Exactness
// The floats of given samples are not on the lattice, and no distance to them is an integer. So a disk is wider than
// its clearance by more than rounding can be: relatively for the squares, and by a millionth of a unit for the
// quotient by the unit. On a torus whose period is no multiple of the unit, the lattice's period is shorter by a part
// of a unit; a distance across the seam may be shorter by that, per axis, than on the lattice, and disks are wider by
// as much. Lattice points in a disk are thus covered within its clearance and 3 units, and points between them within 6
// units.

/// The relative widening of a disk, for the rounding of squares and roots here and in the user's own check.
const RELATIVE: f64 = 1e-13;

/// The absolute widening of a disk, in lattice units, for the rounding of its position.
const ABSOLUTE: f64 = 1e-6;

/// The disks in a bin of the shortest side, where there are as many as samples.
const PER_BIN: f64 = 1024.0;

/// The disks of given samples by octaves of their radii.
#[derive(Default)]
pub struct GivenDisks<const D: usize = 2> {
    octaves: Vec<Octave<D>>,
    /// The size of the torus.
    periods: Option<[i32; D]>,
}

/// Disks of about the same radius, sorted by bins.
struct Octave<const D: usize> {
    /// No disk has a longer radius.
    radius: f64,
    /// The side of a bin.
    side: f64,
    /// The disks by bins, whose last axis is the first of the key; on a torus in its first period.
    disks: Vec<([i64; D], Disk<D>)>,
}

impl<const D: usize> GivenDisks<D> {
    /// The given samples of a domain, whose lattice has the radius of the set.
    pub fn new(domain: &Domain<D>, lattice: &Lattice<D>, radius: f64, given: &Given<D>) -> Self {
        let mut disks: Vec<Disk<D>> = (0..given.positions.len())
            .filter(|&index| given.clearance(index, radius) > 0.0)
            .map(|index| Disk::around(domain, lattice, given.positions[index], given.clearance(index, radius)))
            .collect();
        disks.sort_unstable_by(|a, b| a.radius.total_cmp(&b.radius));
        let is_same = |a: &Disk<D>, b: &Disk<D>| octave(a.radius) == octave(b.radius);
        let shortest = pow(PER_BIN, 1.0 / D as f64) * lattice.radius;
        let octaves = disks.chunk_by(is_same).map(|disks| Octave::new(disks, shortest)).collect();
        let periods = (lattice.boundary == Boundary::Periodic).then_some(lattice.size);
        Self { octaves, periods }
    }

    /// The disks that may have points of a rectangle of lattice points; on a torus all their images that do.
    pub fn near(&self, rect: &Rect<D>) -> Vec<Disk<D>> {
        let mut near = Vec::new();
        for octave in &self.octaves {
            let turns = |axis: usize| match self.periods {
                None => (0..=0, 1),
                Some(size) => {
                    // Of a disk that reaches around the torus, the nearest image covers all that any image does.
                    let period = size[axis];
                    let reach = octave.radius.min(f64::from(period) / 2.0 + 2.0) as i32 + 1;
                    let [first, last] = [rect.min[axis] - reach, rect.max[axis] + reach];
                    // A position may lie a fraction of a unit beyond the lattice points of the last period.
                    ((first - 1).div_euclid(period)..=last.div_euclid(period), period)
                }
            };
            let mut images = vec![[0; D]];
            for axis in (0..D).rev() {
                let (turns, period) = turns(axis);
                let moved = |mut image: [i32; D], turn: i32| {
                    image[axis] = turn * period;
                    image
                };
                images = images.iter().flat_map(|&image| turns.clone().map(move |turn| moved(image, turn))).collect();
            }
            for image in images {
                octave.visit(&rect.translated(image.map(|x| -x)), |disk| {
                    let centre = std::array::from_fn(|axis| disk.centre[axis] + f64::from(image[axis]));
                    near.push(Disk { centre, ..disk });
                });
            }
        }
        near
    }
}

impl<const D: usize> Disk<D> {
    /// The disk of a position with a clearance, on a torus in its first period.
    pub fn around(domain: &Domain<D>, lattice: &Lattice<D>, position: [f32; D], clearance: f64) -> Self {
        let radius = clearance / lattice.unit() * (1.0 + RELATIVE) + ABSOLUTE + lattice.short(domain);
        Self { centre: lattice.place(domain, position), radius }
    }
}

/// The exponent of a radius.
fn octave(radius: f64) -> u64 {
    radius.to_bits() >> 52
}

impl<const D: usize> Octave<D> {
    fn new(disks: &[Disk<D>], shortest: f64) -> Self {
        let radius = disks.last().map_or(0.0, |disk| disk.radius);
        let side = radius.max(shortest);
        let bin = |disk: &Disk<D>| std::array::from_fn(|k| (disk.centre[D - 1 - k] / side).floor() as i64);
        let mut disks: Vec<_> = disks.iter().map(|disk| (bin(disk), *disk)).collect();
        disks.sort_unstable_by_key(|(bin, _)| *bin);
        Self { radius, side, disks }
    }

    /// Visits the disks that may have points of a rectangle.
    fn visit(&self, rect: &Rect<D>, mut visit: impl FnMut(Disk<D>)) {
        let bin = |x: f64| (x / self.side).floor() as i64;
        let range = |k: usize| {
            let [first, last] = [rect.min[D - 1 - k], rect.max[D - 1 - k]].map(f64::from);
            [bin(first - self.radius), bin(last + self.radius)]
        };
        Self::visit_bins(&self.disks, &std::array::from_fn(range), 0, &mut |disk| {
            if disk.meets(rect) {
                visit(disk);
            }
        });
    }

    /// Visits the disks in a box of bins, of those whose keys differ from number `k` on.
    fn visit_bins(mut disks: &[([i64; D], Disk<D>)], bins: &[[i64; 2]; D], k: usize, visit: &mut impl FnMut(Disk<D>)) {
        let [first, last] = bins[k];
        disks = &disks[disks.partition_point(|(bin, _)| bin[k] < first)..];
        if k + 1 == D {
            let end = disks.partition_point(|(bin, _)| bin[k] <= last);
            disks[..end].iter().for_each(|(_, disk)| visit(*disk));
            return;
        }
        // Row by row of bins that have any.
        while let Some(&(bin, _)) = disks.first().filter(|(bin, _)| bin[k] <= last) {
            let (row, rest) = disks.split_at(disks.partition_point(|(other, _)| other[k] <= bin[k]));
            Self::visit_bins(row, bins, k + 1, visit);
            disks = rest;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    /// Random disks of all sizes, and every test against a loop over them.
    #[test]
    fn points_and_rectangles_are_covered_as_a_loop_over_all_disks_says() {
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        let edges: [Vec<i32>; 2] = [(-3..20).map(|i| i * 37 + i % 3).collect(), (0..15).map(|i| i * 41).collect()];
        let mut seen = [0; 2];
        for round in 0..60 {
            let disks: Vec<_> = (0..1 + round % 7)
                .map(|_| Disk {
                    centre: [rng.unit() * 1000.0 - 200.0, rng.unit() * 800.0 - 100.0],
                    radius: 2000f64.powf(rng.unit()),
                })
                .collect();
            let cell = |axis: usize, x: i32| edges[axis].partition_point(|&edge| edge <= x) - 1;
            let obstacles = Obstacles::new(&edges, cell, disks.clone());
            for (y, x) in (0..14).flat_map(|y| (0..22).map(move |x| (y, x))) {
                let cell = Rect { min: [edges[0][x], edges[1][y]], max: [edges[0][x + 1], edges[1][y + 1]] };
                for _ in 0..10 {
                    let min = [0, 1].map(|axis| cell.min[axis] + rng.below(cell.length(axis) as u64) as i32);
                    let length = 1 + rng.below(30) as i32 * (round % 2);
                    let rect = Rect { min, max: min.map(|x| x + length) }.intersection(&cell);
                    let expected = disks.iter().any(|disk| {
                        let corners = [rect.min, [rect.min[0], rect.max[1] - 1], [rect.max[0] - 1, rect.min[1]]];
                        corners.into_iter().chain([rect.max.map(|x| x - 1)]).all(|corner| {
                            let [dx, dy] = [0, 1].map(|axis| f64::from(corner[axis]) - disk.centre[axis]);
                            dx * dx + dy * dy < disk.radius * disk.radius
                        })
                    });
                    assert_eq!(obstacles.cover([x as i32, y as i32], &rect), expected);
                    seen[usize::from(expected)] += 1;
                }
            }
        }
        assert!(seen.into_iter().all(|count| count > 10_000), "{seen:?}");
    }
}
