//! The shell of the inside of a mesh: the places that are no farther from its surface than a thickness.
//!
//! A place belongs to it if the square of its distance from the nearest triangle is at most that of the thickness, both in `f64`
//! (`interior/nearest.rs`). The distance changes by no more than the place does. So a box lies in the shell, or outside, if its centre
//! does by more than half its diagonal; all other boxes are cut. Those of which no side is longer than the tolerance are dropped, as
//! at the surface (`inside.rs`): an open place of the shell lies within a diagonal of its border.
//!
//! The nearest triangle of the centre of a voxel bounds the distances of its parts from both sides; the tree is asked for those of which
//! that is not enough.

use crate::interior::Interior;
use crate::math::square;
use crate::plane::{Lattice, Rect};
use crate::volume::grid::Grid;
use crate::volume::voxels::Level;

/// Distances are right to this share of the diagonal of the box around the mesh (`interior/nearest.rs`).
pub const ERROR: f64 = 1e-7;

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
        Self { interior, thickness, origin, radius, margin: margin.into() }
    }

    /// True if a place belongs to the shell.
    pub fn holds(&self, position: [f32; 3]) -> bool {
        self.thickness.holds(self.interior, position)
    }

    /// The share of each cell of a grid that covers the region.
    pub fn cells(&self, grid: &Grid, side: [f64; 3], half: [f64; 3]) -> Vec<Share> {
        let mut shares = vec![Share::Some; grid.cells()];
        self.share_cells(grid.counts(), side, half, [[0; 3], grid.counts()], &mut shares);
        shares
    }

    /// The same for a box of cells, which is halved until it is a cell or lies on one side.
    fn share_cells(
        &self,
        counts: [usize; 3],
        side: [f64; 3],
        half: [f64; 3],
        [from, to]: [[usize; 3]; 2],
        shares: &mut [Share],
    ) {
        let centre = std::array::from_fn(|k| 0.5 * (from[k] + to[k]) as f64 * side[k] - half[k]);
        let share = self.share(centre, std::array::from_fn(|k| 0.5 * (to[k] - from[k]) as f64 * side[k]));
        let longest = (0..3).max_by_key(|&k| to[k] - from[k]).unwrap_or_default();
        if share == Share::Some && to[longest] - from[longest] > 1 {
            let (mut below, mut above) = (to, from);
            let middle = (from[longest] + to[longest]) / 2;
            (below[longest], above[longest]) = (middle, middle);
            self.share_cells(counts, side, half, [from, below], shares);
            self.share_cells(counts, side, half, [above, to], shares);
            return;
        }
        for z in from[2]..to[2] {
            for y in from[1]..to[1] {
                let row = (z * counts[1] + y) * counts[0];
                shares[row + from[0]..row + to[0]].fill(share);
            }
        }
    }

    /// The share of a box by its centre and half its sides.
    fn share(&self, centre: [f64; 3], halves: [f64; 3]) -> Share {
        let (distance, reach) = (self.thickness.distance, self.reach(halves));
        match self.interior.nearest_in_band(self.place(centre), [distance - reach, distance + reach]) {
            None => Share::None,
            Some((_, squared)) if is_within(squared, distance - reach) => Share::All,
            Some(_) => Share::Some,
        }
    }

    /// Of some parts of a voxel those in the shell, and those that are cut, or none of these if cut parts are dropped.
    pub fn parts(&self, level: &Level, centre: [f32; 3], among: u64, drops_cut: bool) -> [u64; 2] {
        let thickness = self.thickness.distance;
        let (middle, reach) = (self.place(centre.map(f64::from)), self.reach(level.halves.map(f64::from)));
        let band = [thickness - reach, thickness + reach];
        let Some((foot, squared)) = self.interior.nearest_in_band(middle, band) else { return [0; 2] };
        if is_within(squared, band[0]) {
            return [among, 0];
        }
        let (distance, reach) = (squared.sqrt(), self.reach(level.part_halves.map(f64::from)));
        let near = thickness - reach;
        let far = if drops_cut { near } else { thickness + reach };
        let (mut inside, mut cut, mut left) = (0, 0, among);
        while left != 0 {
            let bit = left & left.wrapping_neg();
            let place = self.place(level.part_centre(centre, left.trailing_zeros()).map(f64::from));
            left ^= bit;
            if between(place, foot) <= near {
                inside |= bit;
            } else if far >= 0.0 && distance - between(place, middle) <= far {
                match self.interior.nearest_in_band(place, [near, far]) {
                    None => (),
                    Some((_, squared)) if is_within(squared, near) => inside |= bit,
                    Some(_) => cut |= bit,
                }
            }
        }
        [inside, cut]
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

/// The distance of two places.
fn between(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| square(a[k] - b[k])).sum::<f64>().sqrt()
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
                let [[inside, cut], [whole, none]] =
                    [false, true].map(|drops_cut| shell.parts(level, centre, among, drops_cut));
                assert_eq!((inside & cut, (inside | cut) & !among, none), (0, 0, 0));
                assert_eq!(whole, inside, "those that are cut are dropped");
                for bit in (0..64).filter(|bit| among >> bit & 1 == 1) {
                    let part = level.part_centre(centre, bit);
                    let place = |rng: &mut Rng| -> [f64; 3] {
                        std::array::from_fn(|axis| {
                            f64::from(part[axis]) + (2.0 * rng.unit() - 1.0) * f64::from(level.part_halves[axis])
                        })
                    };
                    let (is_inside, is_cut) = (inside >> bit & 1 == 1, cut >> bit & 1 == 1);
                    seen[if is_inside { 0 } else { 1 + usize::from(is_cut) }] += 1;
                    // A part that is cut is not far from the border.
                    let diagonal = 1.01 * shell.reach(level.part_halves.map(f64::from));
                    let is_far = (depth(part.map(f64::from)) - distance).abs() > diagonal;
                    assert!(!is_cut || !is_far, "{number} {distance}");
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
