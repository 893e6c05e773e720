//! The shell of the inside of a mesh: the places that are no farther from its surface than a thickness.
//!
//! A place belongs to it if the square of its distance from the nearest triangle is at most that of the thickness, both in `f64`
//! (`interior/nearest.rs`). The distance changes by no more than the place does. So a box lies in the shell, or outside, if its centre
//! does by more than half its diagonal; all other boxes are cut. Those of which no side is longer than the tolerance are dropped, as
//! at the surface (`inside.rs`): an open place of the shell lies within a diagonal of its border.
//!
//! The corners of a cell, which cells share, bound the distances in it from both sides (`distances.rs`). Parts that are divided further
//! may count as cut though they are not, if the bounds are close. Where cut parts are dropped, or the bounds are loose, the corners of
//! the voxel itself are asked for, and for the few parts of which that is not enough the tree.

use crate::interior::Interior;
use crate::math::square;
use crate::plane::{Lattice, Rect};
use crate::volume::distances::{Corner, Distances, between_squared, number_along};
use crate::volume::voxels::{Level, Voxel};

/// Distances are right to this share of the diagonal of the box around the mesh (`interior/nearest.rs`).
pub const ERROR: f64 = 1e-7;

/// The longest side of a box of cells, in cells, that is not halved any more.
const SMALL: usize = 2;

/// The parts of a voxel for which its own corners are asked for: each of these is a question to the tree, as is each part.
const MANY: u32 = 8;

/// Bounds of distances are close if they differ by no more than this many half diagonals of a part.
const CLOSE: f64 = 2.0;

/// No place of the surface.
const FAR: [f64; 3] = [f64::INFINITY; 3];

/// The part of a box that lies in a shell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Share {
    None,
    /// It is cut, or not known to lie on one side.
    Some,
    All,
}

/// The thickness of a shell, above 0.
#[derive(Clone, Copy)]
pub struct Thickness {
    pub distance: f64,
    /// The error of a distance.
    pub error: f64,
}

impl Thickness {
    /// True if a place belongs to the shell.
    pub fn holds(&self, interior: &Interior, position: [f32; 3]) -> bool {
        interior.nearest_in_band(position.map(f64::from), [self.distance; 2]).is_some()
    }
}

/// The shell in a region of lattice points. Places are given in radii from the region's centre.
pub struct Shell<'a> {
    interior: &'a Interior,
    thickness: Thickness,
    /// The region's centre.
    origin: [f64; 3],
    radius: f64,
    /// In radii, by which boxes are wider on all sides.
    margin: f64,
    cells: Cells,
    shares: Vec<Share>,
    /// The corners of cells, as far as they were asked for: x is the fastest.
    corners: Vec<Option<Corner>>,
}

/// The cells of a region, in radii.
#[derive(Clone, Copy, Default)]
pub struct Cells {
    pub counts: [usize; 3],
    pub side: [f64; 3],
    /// Half the sides of the region.
    pub half: [f64; 3],
}

impl<'a> Shell<'a> {
    /// The shell in a region.
    pub fn new(
        interior: &'a Interior,
        thickness: Thickness,
        lattice: &Lattice<3>,
        region: &Rect<3>,
        margin: f32,
    ) -> Self {
        let unit = lattice.unit();
        let centre =
            |axis: usize| lattice.coordinate(axis, region.min[axis]) + 0.5 * f64::from(region.length(axis)) * unit;
        let (origin, radius) = (std::array::from_fn(centre), lattice.radius * unit);
        let (cells, shares, corners) = Default::default();
        Self { interior, thickness, origin, radius, margin: margin.into(), cells, shares, corners }
    }

    /// True if a place belongs to the shell.
    pub fn holds(&self, position: [f32; 3]) -> bool {
        self.thickness.holds(self.interior, position)
    }

    /// True if no place of a region with these halves of its sides belongs to the shell.
    pub fn is_beyond(&self, half: [f64; 3]) -> bool {
        self.share([0.0; 3], half, FAR).0 == Share::None
    }

    /// Finds the shares of some cells.
    pub fn sort_cells(&mut self, cells: Cells, some: &[Voxel]) {
        self.cells = cells;
        let mut shares = vec![Share::None; cells.counts.iter().product()];
        for voxel in some {
            shares[voxel.cell as usize] = Share::Some;
        }
        self.sort_box([[0; 3], cells.counts], FAR, &mut shares);
        self.shares = shares;
    }

    /// The share of one of these cells.
    pub fn of_cell(&self, cell: usize) -> Share {
        self.shares[cell]
    }

    /// Sorts the cells of a box, which is halved until it is small or lies on one side. A place of the surface makes searches shorter.
    fn sort_box(&self, [from, to]: [[usize; 3]; 2], foot: [f64; 3], shares: &mut [Share]) {
        let Cells { counts, side, half } = self.cells;
        let row = |y: usize, z: usize| {
            let first = (z * counts[1] + y) * counts[0];
            first + from[0]..first + to[0]
        };
        let rows = (from[2]..to[2]).flat_map(|z| (from[1]..to[1]).map(move |y| (y, z)));
        if rows.clone().all(|(y, z)| shares[row(y, z)].iter().all(|&share| share == Share::None)) {
            return;
        }
        let centre = std::array::from_fn(|k| 0.5 * (from[k] + to[k]) as f64 * side[k] - half[k]);
        let halves = std::array::from_fn(|k| 0.5 * (to[k] - from[k]) as f64 * side[k]);
        let (share, foot) = self.share(centre, halves, foot);
        let longest = (0..3).max_by_key(|&k| to[k] - from[k]).unwrap_or_default();
        match share {
            // The corners of the cells of a small box say more than their centres.
            Share::Some if to[longest] - from[longest] <= SMALL => (),
            Share::Some => {
                let (mut below, mut above) = (to, from);
                let middle = (from[longest] + to[longest]) / 2;
                (below[longest], above[longest]) = (middle, middle);
                self.sort_box([from, below], foot, shares);
                self.sort_box([above, to], foot, shares);
            }
            _ => {
                for (y, z) in rows {
                    for of_cell in shares[row(y, z)].iter_mut().filter(|of_cell| **of_cell != Share::None) {
                        *of_cell = share;
                    }
                }
            }
        }
    }

    /// The share of a box by its centre and half its sides, with the place of the surface by which it is known. Another such place, or
    /// one that is infinitely far, makes the search shorter.
    fn share(&self, centre: [f64; 3], halves: [f64; 3], foot: [f64; 3]) -> (Share, [f64; 3]) {
        let (Thickness { distance, error }, reach, place) = (self.thickness, self.reach(halves), self.place(centre));
        let (near, beyond) = (distance - reach, distance + reach);
        let known = between_squared(place, foot);
        if is_within(known, near) {
            return (Share::All, foot);
        }
        let far = known.sqrt() + error;
        match self.interior.nearest_in_band(place, [near, beyond.min(far)]) {
            None => (if far < beyond { Share::Some } else { Share::None }, foot),
            Some((foot, squared)) => (if is_within(squared, near) { Share::All } else { Share::Some }, foot),
        }
    }

    /// Of some parts of a voxel those in the shell, and those that may be cut, or none of these if cut parts are dropped: those in the
    /// shell are then all of which the distance of the centre says so. The voxel lies in a box with known corners.
    pub fn parts(&self, around: &Distances, level: &Level, centre: [f32; 3], among: u64, drops_cut: bool) -> [u64; 2] {
        let (thickness, reach) = (self.thickness.distance, self.reach(level.part_halves.map(f64::from)));
        let near = thickness - reach;
        let band = [near, if drops_cut { near } else { thickness + reach }];
        let along = |axis: usize, number: usize| {
            let place = f64::from(centre[axis] + level.offset(axis, number));
            self.origin[axis] + self.radius * place
        };
        let grid: [[f64; 4]; 3] = std::array::from_fn(|axis| std::array::from_fn(|number| along(axis, number)));
        let place = |bit: u32| {
            let bit = bit as usize;
            [grid[0][bit % 4], grid[1][bit / 4 % 4], grid[2][bit / 16]]
        };
        let (mut inside, mut cut, mut open) = (0, 0, among);
        let mut sort = |around: &Distances, open: u64| {
            let mut unknown = 0;
            around.for_each(&grid, open, |bit, [least, most]| {
                let bit = 1 << bit;
                if is_within(most, near) {
                    inside |= bit;
                } else if is_within(least, band[1]) {
                    let is_decided = !drops_cut && {
                        let is_cut = !is_within(least, near) && is_within(most, band[1]);
                        is_cut || most.sqrt() - least.sqrt() <= CLOSE * reach
                    };
                    if is_decided { cut |= bit } else { unknown |= bit }
                }
            });
            unknown
        };
        open = sort(around, open);
        if open.count_ones() > MANY && level.counts != [1; 3] {
            open = sort(&self.distances_around(centre.map(f64::from), level.halves.map(f64::from)), open);
        }
        while open != 0 {
            let bit = open & open.wrapping_neg();
            open ^= bit;
            match self.interior.nearest_in_band(place(bit.trailing_zeros()), band) {
                None => (),
                Some((_, squared)) if is_within(squared, near) => inside |= bit,
                Some(_) => cut |= bit,
            }
        }
        [inside, cut]
    }

    /// The distances at the corners of a cell, which are kept.
    pub fn distances_of_cell(&mut self, place: [u16; 3]) -> Distances {
        let (Cells { counts, side, half }, mut kept) = (self.cells, std::mem::take(&mut self.corners));
        if kept.is_empty() {
            kept = vec![None; counts.iter().map(|count| count + 1).product()];
        }
        let number = |corner: usize, axis: usize| usize::from(place[axis]) + number_along(corner, axis);
        let along = |corner: usize, axis: usize| number(corner, axis) as f64 * side[axis] - half[axis];
        let index = |corner: usize| {
            (number(corner, 2) * (counts[1] + 1) + number(corner, 1)) * (counts[0] + 1) + number(corner, 0)
        };
        let found = self.distances(side, along, |corner, ask| *kept[index(corner)].get_or_insert_with(ask));
        self.corners = kept;
        found
    }

    /// The distances at the corners of a box.
    fn distances_around(&self, centre: [f64; 3], halves: [f64; 3]) -> Distances {
        let sides = halves.map(|half| 2.0 * half);
        let low: [f64; 3] = std::array::from_fn(|axis| centre[axis] - halves[axis]);
        let along = |corner: usize, axis: usize| low[axis] + number_along(corner, axis) as f64 * sides[axis];
        self.distances(sides, along, |_, ask| ask())
    }

    /// The distances at the corners of a box with these sides and coordinates of corners: those that are known, or what the mesh says.
    fn distances(
        &self,
        sides: [f64; 3],
        along: impl Fn(usize, usize) -> f64,
        mut known: impl FnMut(usize, &dyn Fn() -> Corner) -> Corner,
    ) -> Distances {
        let place = |corner: usize| std::array::from_fn(|axis| along(corner, axis));
        let mut foot = FAR;
        let corners = std::array::from_fn(|corner| {
            let found = known(corner, &|| self.corner(place(corner), sides, foot));
            foot = found.foot;
            found
        });
        Distances { low: self.place(place(0)), sides: sides.map(|side| self.radius * side), corners }
    }

    /// A corner of a box with these sides. If no place of the box can be cut, it is enough that it is far. A place of the surface that
    /// may be near, or infinitely far, makes the search shorter.
    fn corner(&self, place: [f64; 3], sides: [f64; 3], foot: [f64; 3]) -> Corner {
        let (Thickness { distance, error }, place) = (self.thickness, self.place(place));
        let far = (distance + 2.0 * self.reach(sides)).min(between_squared(place, foot).sqrt() + error);
        let nearest = self.interior.nearest_in_band(place, [-1.0, far]);
        let (foot, distance) = nearest.map_or((FAR, far), |(foot, squared)| (foot, squared.sqrt()));
        Corner { least: square((distance - error).max(0.0)), foot }
    }

    /// Half the diagonal of a box with its margin, and the error of a distance.
    fn reach(&self, halves: [f64; 3]) -> f64 {
        let squares = halves.map(|half| square(half + self.margin));
        self.radius * squares.iter().sum::<f64>().sqrt() + self.thickness.error
    }

    /// A place in the units of the mesh.
    fn place(&self, place: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|axis| self.origin[axis] + self.radius * place[axis])
    }
}

/// True if a squared distance is at most that of a distance, which may be below 0.
fn is_within(squared: f64, distance: f64) -> bool {
    distance >= 0.0 && squared <= square(distance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::mesh::Mesh;
    use crate::plane::{GivenDisks, Lattice};
    use crate::points::{Boundary, Domain};
    use crate::rng::{Draw, Rng};
    use crate::simd::Level as Simd;
    use crate::volume::inside::Solid;
    use crate::volume::set::Set;
    use crate::volume::space::Space;

    /// An octahedron around a smaller one, which is hollow.
    fn interior() -> std::sync::Arc<Interior> {
        let corner = |k: u32, size: f32| -> [f32; 3] {
            std::array::from_fn(
                |axis| if axis as u32 == k / 2 { if k.is_multiple_of(2) { size } else { -size } } else { 0.0 },
            )
        };
        let positions = (0..12).map(|k| corner(k % 6, if k < 6 { 1.0 } else { 0.4 })).collect();
        let face = |k: u32| [k & 1, 2 + (k >> 1 & 1), 4 + (k >> 2 & 1)].map(|corner| corner + 6 * (k / 8));
        Interior::of(&Mesh::new(positions, (0..16).map(face).collect()).unwrap())
    }

    fn lattice(radius: f64) -> Lattice<3> {
        let domain = Domain { min: [-1.0; 3], max: [1.0; 3], boundary: Boundary::Bounded };
        Lattice::of_any_size(&domain, radius).unwrap()
    }

    #[test]
    fn boxes_and_parts_lie_where_their_places_do() {
        let (interior, lattice, mut rng) = (interior(), lattice(0.1), Rng::at(3, Draw::Probe, &[]));
        let (region, mut seen) = (lattice.rect(), [0; 3]);
        for distance in [0.01, 0.05, 0.13] {
            let thickness = Thickness { distance, error: 1e-7 };
            let shell = Shell::new(&interior, thickness, &lattice, &region, 1e-5);
            let depth = |place: [f64; 3]| interior.nearest(shell.place(place), 9.0).unwrap().1.sqrt();
            let levels = Level::all([0.9 * lattice.radius; 3], lattice.radius);
            for number in (0..600).map(|case| case % 3) {
                let (level, centre) = (&levels[number], [0; 3].map(|_: i32| (18.0 * rng.unit() - 9.0) as f32));
                let among = rng.bits();
                // A cell around the voxel.
                let beyond = [0; 3].map(|_: i32| 0.1 + rng.unit());
                let around = shell.distances_around(
                    centre.map(f64::from),
                    std::array::from_fn(|k| f64::from(level.halves[k]) * (1.0 + beyond[k])),
                );
                let [[inside, cut], [whole, none]] =
                    [false, true].map(|drops_cut| shell.parts(&around, level, centre, among, drops_cut));
                assert_eq!((inside & cut, (inside | cut) & !among, none), (0, 0, 0));
                assert_eq!((inside & !whole, whole & !(inside | cut)), (0, 0), "those that are cut are dropped");
                for bit in (0..64).filter(|bit| among >> bit & 1 == 1) {
                    let part = level.part_centre(centre, bit);
                    let place = |rng: &mut Rng| -> [f64; 3] {
                        std::array::from_fn(|axis| {
                            f64::from(part[axis]) + (2.0 * rng.unit() - 1.0) * f64::from(level.part_halves[axis])
                        })
                    };
                    let (is_inside, is_cut) = (inside >> bit & 1 == 1, cut >> bit & 1 == 1);
                    seen[if is_inside { 0 } else { 1 + usize::from(is_cut) }] += 1;
                    // A part that is cut is not far from the border, and one that is dropped meets it.
                    let reach = shell.reach(level.part_halves.map(f64::from));
                    let beyond = depth(part.map(f64::from)) - distance;
                    assert!(!is_cut || beyond.abs() <= 1.01 * (1.0 + CLOSE) * reach, "{number} {distance}");
                    let is_whole = whole >> bit & 1 == 1;
                    assert!(
                        if is_whole { beyond <= -0.9999 * reach } else { beyond > -1.0001 * reach },
                        "{beyond} {reach}"
                    );
                    for depth in [0; 3].map(|_: i32| depth(place(&mut rng))) {
                        assert!(is_cut || (depth <= distance) == is_inside, "{depth} {distance}");
                    }
                }
            }
        }
        assert!(seen.iter().all(|&seen| seen > 1_000), "{seen:?}");
    }

    #[test]
    fn all_levels_of_vector_instructions_make_the_same_shell() {
        let (interior, lattice, given) = (interior(), lattice(0.05), GivenDisks::default());
        let context = Context::new(1).unwrap();
        for distance in [0.02, 0.12] {
            let thickness = Some(Thickness { distance, error: 1e-7 });
            let solid = Some(Solid { interior: &interior, tolerance: 1.0 / 16.0, thickness });
            let positions = |level: Simd| {
                let space = Space { lattice: &lattice, given: &given, solid };
                context.run(None, |job| Set::new(job, space, 5, level)).unwrap().into_positions()
            };
            let portable = positions(Simd::Portable);
            assert!(portable.len() > 500, "{}", portable.len());
            assert!(Simd::available().into_iter().all(|level| positions(level) == portable));
        }
    }
}
