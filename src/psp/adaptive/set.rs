//! The samples accepted so far, and how the set grows: octave by octave from small radii to large ones, and cube by
//! cube in each.
//!
//! The cubes of an octave measure [`SIDE`] of its largest radius. What is accepted in a cube conflicts with nothing in
//! another cube of its colour, as in `psp/cubes.rs`; what octaves of smaller radii have accepted is there before, and
//! what those of larger radii will accept has to fit in. In this order a sample of a large radius takes no place from
//! many of small ones where the radius jumps.
//!
//! Samples that were there before the set grows are listed by their octaves and cubes as well, and are seen everywhere.

use std::collections::{BTreeMap, HashMap};
use std::ops::Range;

use glam::DVec3;

use crate::error::{Error, Result};
use crate::index::Buckets;
use crate::job::Job;
use crate::math::{exp2, scalbn};
use crate::mesh::{Mesh, exact};
use crate::psp::adaptive::dot::Dot;
use crate::psp::adaptive::pieces::{LONGEST, Piece};
use crate::psp::cubes::Cube;
use crate::psp::facing::Facing;
use crate::psp::samples::Sample;
use crate::rng::{Draw, Rng};

/// The side of a cube, in the largest radius of its octave.
const SIDE: f64 = 16.0;
/// How far samples and what they cover can lie outside of their cube, in the same unit: two thirds of a piece.
const OVERHANG: f64 = 2.0 / 3.0 * LONGEST;
/// Half of the radius of a sample, in the same unit, and some more: rounding can bring it above the radii of its piece by
/// at most a quarter of these (see `field.rs`).
const HALF: f64 = 0.64;

/// The octave of a radius: it is in `2^octave .. 2^(octave + 1)`.
fn octave(radius: f64) -> i32 {
    (radius.to_bits() >> 52) as i32 - 1023
}

/// What all radii of an octave are below.
fn end_of_octave(octave: i32) -> f64 {
    scalbn(1.0, octave + 1)
}

/// A cube of an octave.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct OctaveCube {
    pub octave: i32,
    pub cube: Cube,
}

impl OctaveCube {
    /// What random numbers of the cube are keyed by.
    pub fn key(self) -> [u64; 4] {
        let [x, y, z] = self.cube.key();
        [self.octave as u64, x, y, z]
    }
}

/// A conflict-free set that only grows.
pub struct AdaptiveSet {
    origin: DVec3,
    /// Where the cubes of each octave begin, in cubes: seams of many sets average out.
    shift: DVec3,
    seed: u64,
    /// What relative radii are multiplied by.
    scale: f64,
    /// In the order in which they were accepted, with their relative radii.
    pub samples: Vec<(Sample, f64)>,
    /// Which samples were accepted in each cube of each octave.
    octaves: BTreeMap<i32, HashMap<Cube, Vec<Range<u32>>>>,
}

impl AdaptiveSet {
    /// A set with some samples that do not conflict at this scale, which are put in the order of their cubes.
    pub fn new(mesh: &Mesh, seed: u64, scale: f64, samples: &[(Sample, f64)]) -> Self {
        let mut rng = Rng::at(seed, Draw::Adaptive, &[]);
        let shift = DVec3::from_array(std::array::from_fn(|_| rng.unit()));
        let (none, octaves) = (Vec::with_capacity(samples.len()), BTreeMap::new());
        let mut set = Self { origin: exact(mesh.bounds().0), shift, seed, scale, samples: none, octaves };
        let mut places: Vec<(OctaveCube, usize)> = (0..samples.len()).map(|i| (set.place(&samples[i]), i)).collect();
        places.sort_unstable();
        for run in places.chunk_by(|a, b| a.0 == b.0) {
            let start = set.samples.len() as u32;
            set.samples.extend(run.iter().map(|&(_, i)| samples[i]));
            set.list(run[0].0, start..set.samples.len() as u32);
        }
        set
    }

    /// Where a sample is listed that was there before.
    fn place(&self, (sample, radius): &(Sample, f64)) -> OctaveCube {
        let octave = octave(self.scale * radius);
        OctaveCube { octave, cube: self.cube_of(octave, exact(sample.position)) }
    }

    fn list(&mut self, cube: OctaveCube, run: Range<u32>) {
        self.octaves.entry(cube.octave).or_default().entry(cube.cube).or_default().push(run);
    }

    /// Where a piece of the surface belongs: to the octave of its radius or, where that is above a limit that is random
    /// for each cube, to the one above. Thus no seam follows a line of one radius.
    pub fn cube(&self, centre: DVec3, radius: f64) -> OctaveCube {
        let own = octave(radius);
        let above = OctaveCube { octave: own + 1, cube: self.cube_of(own + 1, centre) };
        let limit = Rng::at(self.seed, Draw::Octave, &above.key()).unit();
        if radius > end_of_octave(own) * exp2(limit - 1.0) {
            above
        } else {
            OctaveCube { octave: own, cube: self.cube_of(own, centre) }
        }
    }

    /// The cube of an octave that a point is in.
    fn cube_of(&self, octave: i32, point: DVec3) -> Cube {
        let place = (point - self.origin) / (SIDE * end_of_octave(octave)) + self.shift;
        Cube(place.floor().as_ivec3().to_array())
    }

    /// Adds what `task` makes of each cube's pieces, given the dots around it, and returns the sum of its counts. Dots
    /// whose ratio to one in the cube is below `stretch`, from 1 to 2, are there.
    ///
    /// The task returns samples that conflict neither with each other nor with any of these dots, whose radii are
    /// at most a quarter above the end of the octave, no farther than [`OVERHANG`] from the cube.
    pub fn grow(
        &mut self,
        job: &Job,
        mesh: &Mesh,
        facing: Facing,
        buckets: &Buckets<OctaveCube, Piece>,
        stretch: f64,
        task: impl Fn(OctaveCube, Vec<Dot>, &[&Piece]) -> Result<(Vec<(Sample, f64)>, u64)> + Sync,
    ) -> Result<u64> {
        let key = |&bucket: &usize| (buckets.key(bucket).octave, buckets.key(bucket).cube.colour());
        let mut order: Vec<usize> = (0..buckets.len()).collect();
        order.sort_by_key(key);
        let (mut done, mut total) = (0, 0);
        for members in order.chunk_by(|a, b| key(a) == key(b)) {
            let share = |done: usize| done as f64 / buckets.len() as f64;
            let part = job.part(share(done), share(done + members.len()));
            let grown = part.map(members.len(), |member| {
                let cube = buckets.key(members[member]);
                let pieces: Vec<&Piece> = buckets.items(members[member]).collect();
                task(cube, self.dots_around(mesh, facing, cube, stretch), &pieces)
            })?;
            done += members.len();
            for (&bucket, grown) in members.iter().zip(grown) {
                let (samples, count) = grown?;
                total += count;
                self.add(buckets.key(bucket), samples)?;
            }
        }
        Ok(total)
    }

    fn add(&mut self, cube: OctaveCube, samples: Vec<(Sample, f64)>) -> Result<()> {
        let [start, end] = [self.samples.len(), self.samples.len() + samples.len()].map(u32::try_from);
        let (Ok(start), Ok(end)) = (start, end) else {
            return Err(Error::too_large("radius", format!("it asks for more than {} samples", u32::MAX)));
        };
        self.samples.extend(samples);
        self.list(cube, start..end);
        Ok(())
    }

    /// The samples that can matter in a cube.
    fn dots_around(
        &self,
        mesh: &Mesh,
        facing: Facing,
        OctaveCube { octave, cube }: OctaveCube,
        stretch: f64,
    ) -> Vec<Dot> {
        let mut dots = Vec::new();
        let end = end_of_octave(octave);
        let low = self.origin + SIDE * end * (DVec3::from_array(cube.0.map(f64::from)) - self.shift);
        // Where points of the cube's pieces are, and half of their radius around.
        let margin = DVec3::splat((OVERHANG + stretch * HALF) * end);
        let (low, high) = (low - margin, low + SIDE * end + margin);
        for (&octave, cubes) in &self.octaves {
            let reach = DVec3::splat((OVERHANG + stretch * HALF) * end_of_octave(octave));
            let bounds = [low - reach, high + reach].map(|corner| self.cube_of(octave, corner).0);
            for run in runs_in(cubes, bounds) {
                for &(sample, radius) in &self.samples[run.start as usize..run.end as usize] {
                    let (point, radius) = (exact(sample.position), self.scale * radius);
                    if (point - point.clamp(low, high)).length() <= stretch * 0.51 * radius {
                        let normal = facing.normal(mesh, sample.triangle);
                        dots.push(Dot { position: sample.position, radius, normal });
                    }
                }
            }
        }
        dots
    }
}

/// The runs of all cubes from the first to the last: looked up, or, where these are more than there are cubes at all,
/// picked from all.
fn runs_in(cubes: &HashMap<Cube, Vec<Range<u32>>>, [first, last]: [[i32; 3]; 2]) -> Vec<Range<u32>> {
    let count: f64 = (0..3).map(|axis| f64::from(last[axis]) - f64::from(first[axis]) + 1.0).product();
    let mut runs: Vec<Range<u32>> = if count < cubes.len() as f64 {
        let all = (first[2]..=last[2]).flat_map(move |z| {
            (first[1]..=last[1]).flat_map(move |y| (first[0]..=last[0]).map(move |x| Cube([x, y, z])))
        });
        all.filter_map(|cube| cubes.get(&cube)).flatten().cloned().collect()
    } else {
        let is_in = |cube: &Cube| (0..3).all(|axis| (first[axis]..=last[axis]).contains(&cube.0[axis]));
        cubes.iter().filter(|(cube, _)| is_in(cube)).flat_map(|(_, runs)| runs).cloned().collect()
    };
    runs.sort_by_key(|run| run.start);
    runs
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
