//! Given samples, around which sets are made: as disks on the lattice, found by place.
//!
//! # Exactness
//! The floats of given samples are not on the lattice, and no distance to them is an integer. So a disk is wider than
//! its clearance by more than rounding can be: relatively for the squares, and by a millionth of a unit for the
//! quotient by the unit. On a torus whose period is no multiple of the unit, the lattice's period is shorter by a part
//! of a unit; a distance over the seam may be shorter by that, per axis, than on the lattice, and disks are wider by as
//! much. What lies in a disk is thus covered within its clearance and 3 units, and with the place between lattice
//! points within 6 units.

use std::cmp::Ordering;

use crate::given::Given;
use crate::plane::Disk;
use crate::plane::lattice::Lattice;
use crate::plane::rect::Rect;
use crate::points::{Boundary, Domain};

/// What a disk is wider by, relatively, for the rounding of squares and roots here and in the user's own check.
const RELATIVE: f64 = 1e-13;

/// And in lattice units, for the rounding of its place.
const ABSOLUTE: f64 = 1e-6;

/// The shortest side of a bin, in radii.
const BIN: f64 = 32.0;

/// The disks of given samples by octaves of their radii.
#[derive(Default)]
pub struct Around {
    octaves: Vec<Octave>,
    /// Of a torus the size.
    periods: Option<[i32; 2]>,
}

/// Disks of about the same radius, sorted by bins.
struct Octave {
    /// No disk has a longer radius.
    radius: f64,
    /// The side of a bin.
    side: f64,
    /// By rows and columns of bins, on a torus in its first turn.
    disks: Vec<([i64; 2], Disk)>,
}

impl Around {
    /// The given samples of a domain, whose lattice has the radius of the set.
    pub fn new(domain: &Domain, lattice: &Lattice, radius: f64, given: &Given<2>) -> Self {
        let mut disks: Vec<Disk> = (0..given.positions.len())
            .filter(|&index| given.clearance(index, radius) > 0.0)
            .map(|index| {
                let clearance = given.clearance(index, radius) / lattice.unit();
                let place = lattice.place(domain, given.positions[index]);
                Disk { centre: place, radius: clearance * (1.0 + RELATIVE) + ABSOLUTE + lattice.short(domain) }
            })
            .collect();
        disks.sort_unstable_by(|a, b| a.radius.total_cmp(&b.radius));
        let is_same = |a: &Disk, b: &Disk| octave(a.radius) == octave(b.radius);
        let octaves = disks.chunk_by(is_same).map(|disks| Octave::new(disks, BIN * lattice.radius)).collect();
        let periods = (lattice.boundary == Boundary::Periodic).then_some(lattice.size);
        Self { octaves, periods }
    }

    /// The disks that may have points of a rectangle of lattice points; on a torus all their images that do.
    pub fn near(&self, rect: &Rect) -> Vec<Disk> {
        let mut near = Vec::new();
        for octave in &self.octaves {
            let turns = |axis: usize| match self.periods {
                None => (0..=0, 1),
                Some(size) => {
                    // Of a disk that reaches around, the nearest image covers what any does.
                    let period = size[axis];
                    let reach = octave.radius.min(f64::from(period) / 2.0 + 2.0) as i32 + 1;
                    let [first, last] = [rect.min[axis] - reach, rect.max[axis] + reach];
                    // A place may lie a part of a unit beyond the last turn's lattice points.
                    ((first - 1).div_euclid(period)..=last.div_euclid(period), period)
                }
            };
            let ((columns, width), (rows, height)) = (turns(0), turns(1));
            for [x, y] in rows.flat_map(|y| columns.clone().map(move |x| [x * width, y * height])) {
                octave.visit(&rect.translated([-x, -y]), |disk| {
                    let centre = [disk.centre[0] + f64::from(x), disk.centre[1] + f64::from(y)];
                    near.push(Disk { centre, ..disk });
                });
            }
        }
        near
    }
}

/// The exponent of a radius.
fn octave(radius: f64) -> u64 {
    radius.to_bits() >> 52
}

impl Octave {
    fn new(disks: &[Disk], shortest: f64) -> Self {
        let radius = disks.last().map_or(0.0, |disk| disk.radius);
        let side = radius.max(shortest);
        let bin = |disk: &Disk| [1, 0].map(|axis: usize| (disk.centre[axis] / side).floor() as i64);
        let mut disks: Vec<_> = disks.iter().map(|disk| (bin(disk), *disk)).collect();
        disks.sort_unstable_by_key(|(bin, _)| *bin);
        Self { radius, side, disks }
    }

    /// Visits the disks that may have points of a rectangle.
    fn visit(&self, rect: &Rect, mut visit: impl FnMut(Disk)) {
        let bin = |x: f64| (x / self.side).floor() as i64;
        let first = rect.min.map(|x| bin(f64::from(x) - self.radius));
        let last = rect.max.map(|x| bin(f64::from(x) + self.radius));
        let mut from = self.disks.partition_point(|(bin, _)| bin[0] < first[1]);
        // Row by row of bins that have any.
        while let Some(&([row, _], _)) = self.disks.get(from).filter(|(bin, _)| bin[0] <= last[1]) {
            let rest = &self.disks[from..];
            let start = rest.partition_point(|(bin, _)| bin.cmp(&[row, first[0]]) == Ordering::Less);
            let end = rest.partition_point(|(bin, _)| bin.cmp(&[row, last[0]]) != Ordering::Greater);
            rest[start..end].iter().filter(|(_, disk)| disk.meets(rect)).for_each(|(_, disk)| visit(*disk));
            from += rest.partition_point(|(bin, _)| bin[0] <= row);
        }
    }
}
