//! Sets of samples whose radius varies, which grow octave by octave from small radii to large ones, and cube by cube in
//! each.
//!
//! The cubes of an octave measure [`SIDE`] of its largest radius. Samples accepted in a cube conflict with none in
//! another cube of its colour, as in `psp/set/cubes.rs`; those of octaves of smaller radii precede them, and those of
//! octaves of larger radii have to fit in. In this order a sample of a large radius does not displace many of small
//! ones where the radius jumps.
//!
//! Samples that precede the growth of the set are listed by their octaves and cubes as well, and are visible
//! everywhere.

use glam::DVec3;

use crate::math::{exp2, scalbn};
use crate::mesh::{Mesh, exact};
use crate::psp::adaptive::pieces::LONGEST;
use crate::psp::set::{Cube, Cubes, Growing, OctaveCube, Sample};
use crate::rng::{Draw, Rng};

/// The side of a cube, in units of the largest radius of its octave.
const SIDE: f64 = 16.0;
/// The largest distance from their cube of samples and of the surface that they cover, in the same unit: two thirds of
/// a piece.
const OVERHANG: f64 = 2.0 / 3.0 * LONGEST;
/// Half of the radius of a sample, in the same unit, and some more: rounding can take it above the radii of its piece
/// by at most a quarter of these (see `field.rs`).
const HALF: f64 = 0.64;

/// The largest multiple of the distance of conflicts at which samples of other cubes may matter: samples accepted in one
/// cube and in the next of its colour are farther apart than that.
pub const FARTHEST: f64 = 6.0;
const _: () = assert!(SIDE - 2.0 * OVERHANG > 2.0 * HALF * FARTHEST);

/// The octave of a radius: it is in `2^octave .. 2^(octave + 1)`.
fn octave(radius: f64) -> i32 {
    (radius.to_bits() >> 52) as i32 - 1023
}

/// The upper bound of the radii of an octave.
fn end_of_octave(octave: i32) -> f64 {
    scalbn(1.0, octave + 1)
}

/// The cubes of a set whose radius varies.
pub struct OctaveCubes {
    origin: DVec3,
    /// The origin of the cubes of each octave, in cubes: seams average out over many sets.
    shift: DVec3,
    seed: u64,
    /// The factor of relative radii.
    scale: f64,
}

impl OctaveCubes {
    /// The cube of an octave that a point is in.
    fn cube(&self, octave: i32, point: DVec3) -> Cube {
        let place = (point - self.origin) / (SIDE * end_of_octave(octave)) + self.shift;
        Cube(place.floor().as_ivec3().to_array())
    }

    /// The cubes of pieces of the surface that have their radii at a scale.
    pub fn of_pieces(&self, scale: f64) -> CubesOfPieces<'_> {
        CubesOfPieces { cubes: self, share: self.scale / scale, last: None }
    }
}

/// The cubes of pieces of the surface, one after the other: most of them share the limit of the piece before.
pub struct CubesOfPieces<'a> {
    cubes: &'a OctaveCubes,
    /// The scale of the cubes over that of the pieces.
    share: f64,
    /// A cube that pieces of the octave below may be in, and the least radius of those that are.
    last: Option<(OctaveCube, f64)>,
}

impl CubesOfPieces<'_> {
    /// The cube of a piece: in the octave of its radius or, if that is above a limit that is random for each cube, in
    /// the next larger one. Thus no seam follows a line of constant radius.
    pub fn cube(&mut self, centre: DVec3, radius: f64) -> OctaveCube {
        let radius = self.share * radius;
        let own = octave(radius);
        let above = OctaveCube { octave: own + 1, cube: self.cubes.cube(own + 1, centre) };
        let (_, limit) = match self.last {
            Some(last) if last.0 == above => last,
            _ => {
                let share = Rng::at(self.cubes.seed, Draw::Octave, &above.key()).unit();
                *self.last.insert((above, end_of_octave(own) * exp2(share - 1.0)))
            }
        };
        if radius > limit { above } else { OctaveCube { octave: own, cube: self.cubes.cube(own, centre) } }
    }
}

impl Cubes for OctaveCubes {
    /// A sample and its relative radius.
    type Sample = (Sample, f64);

    fn cube_of(&self, (sample, radius): &(Sample, f64)) -> OctaveCube {
        let octave = octave(self.scale * radius);
        OctaveCube { octave, cube: self.cube(octave, exact(sample.position)) }
    }
}

/// A conflict-free set of samples whose radius varies.
///
/// The task of [`Growing::grow`] returns samples whose radii are at most a quarter above the end of the octave, no
/// farther than [`OVERHANG`] from the cube.
pub type AdaptiveSet = Growing<OctaveCubes>;

impl AdaptiveSet {
    /// A set with some samples that do not conflict at this scale, which are put in the order of their cubes.
    pub fn new(mesh: &Mesh, seed: u64, scale: f64, samples: &[(Sample, f64)]) -> Self {
        let mut rng = Rng::at(seed, Draw::Adaptive, &[]);
        let shift = DVec3::from_array(std::array::from_fn(|_| rng.unit()));
        let cubes = OctaveCubes { origin: exact(mesh.bounds().0), shift, seed, scale };
        let mut order: Vec<(OctaveCube, usize)> = (0..samples.len()).map(|i| (cubes.cube_of(&samples[i]), i)).collect();
        order.sort_unstable();
        Self::in_order(cubes, order.into_iter().map(|(_, i)| samples[i]).collect())
    }

    /// Visits the samples that can matter in a cube: those whose ratio to one in the cube is below `stretch`, from 1 to
    /// [`FARTHEST`].
    pub fn each_around(&self, cube: OctaveCube, stretch: f64, mut visit: impl FnMut(&(Sample, f64))) {
        let OctaveCubes { origin, shift, scale, .. } = self.cubes;
        let end = end_of_octave(cube.octave);
        let low = origin + SIDE * end * (DVec3::from_array(cube.cube.0.map(f64::from)) - shift);
        // The points of the cube's pieces, widened by half of their radius.
        let margin = DVec3::splat((OVERHANG + stretch * HALF) * end);
        let (low, high) = (low - margin, low + SIDE * end + margin);
        for octave in self.octaves() {
            let reach = DVec3::splat((OVERHANG + stretch * HALF) * end_of_octave(octave));
            let ends = [low - reach, high + reach].map(|corner| self.cubes.cube(octave, corner));
            for sample in self.in_range(octave, ends) {
                let (point, radius) = (exact(sample.0.position), scale * sample.1);
                if (point - point.clamp(low, high)).length() <= stretch * 0.51 * radius {
                    visit(sample);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn octaves_begin_at_powers_of_two() {
        for (radius, expected) in [(1.0, 0), (1.999, 0), (2.0, 1), (0.25, -2), (1e-38, -127), (3e38, 127)] {
            assert_eq!(octave(radius), expected);
            assert!(radius < end_of_octave(expected) && 2.0 * radius >= end_of_octave(expected));
        }
    }
}
