//! The samples accepted so far, and how the set grows: octave by octave from large radii to small ones, and block by
//! block in each.
//!
//! The blocks of an octave measure [`SIDE`] of its largest radius. What is accepted in a block conflicts with nothing in
//! another block of its colour, as in `psp/blocks.rs`; what octaves of larger radii have accepted is there before, and
//! what those of smaller radii will accept has to fit in.

use std::cmp::Reverse;
use std::collections::{BTreeMap, HashMap};
use std::ops::Range;

use glam::DVec3;

use crate::error::{Error, Result};
use crate::job::Job;
use crate::mesh::{Mesh, exact};
use crate::psp::adaptive::room::{Dot, Room, Rule, end_of_octave, octave};
use crate::psp::blocks::{Block, Groups};
use crate::psp::coverage::Fragment;
use crate::psp::samples::Sample;
use crate::rng::{Draw, Rng};

/// The side of a block, in the largest radius of its octave.
const SIDE: f64 = 16.0;
/// How far samples and what they cover can lie outside of their block, in the same unit: pieces are no longer than two.
const OVERHANG: f64 = 4.0 / 3.0;
/// Half of the radius of a sample, in the same unit, and some more: rounding can bring it above the radii of its piece by
/// at most a quarter of these (see `radius.rs`).
const HALF: f64 = 0.64;

/// A block of an octave.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Place {
    pub octave: i32,
    pub block: Block,
}

impl Place {
    /// What random numbers of the place are keyed by.
    pub fn key(self) -> [u64; 4] {
        let [x, y, z] = self.block.key();
        [self.octave as u64, x, y, z]
    }
}

/// A conflict-free set that only grows.
pub(super) struct Set {
    origin: DVec3,
    /// Where the blocks of each octave begin, in blocks: seams of many sets average out.
    shift: DVec3,
    seed: u64,
    /// In the order in which they were accepted, with their radii.
    pub samples: Vec<(Sample, f64)>,
    /// Which samples were accepted in each block of each octave.
    octaves: BTreeMap<i32, HashMap<Block, Range<u32>>>,
}

impl Set {
    pub fn new(mesh: &Mesh, seed: u64) -> Self {
        let mut rng = Rng::at(seed, Draw::Adaptive, &[]);
        let shift = DVec3::from_array(std::array::from_fn(|_| rng.unit()));
        Self { origin: exact(mesh.bounds().0), shift, seed, samples: Vec::new(), octaves: BTreeMap::new() }
    }

    /// Where a piece of the surface belongs: to the octave of its radius or, where that is above a limit that is random
    /// for each block, to the one above. Thus no seam follows the places of one radius.
    pub fn place(&self, centre: DVec3, radius: f64) -> Place {
        let own = octave(radius);
        let above = Place { octave: own + 1, block: self.block(own + 1, centre) };
        let limit = Rng::at(self.seed, Draw::Octave, &above.key()).unit();
        if radius > end_of_octave(own) * (limit - 1.0).exp2() {
            above
        } else {
            Place { octave: own, block: self.block(own, centre) }
        }
    }

    /// The block of an octave that a point is in.
    fn block(&self, octave: i32, point: DVec3) -> Block {
        let place = (point - self.origin) / (SIDE * end_of_octave(octave)) + self.shift;
        Block(place.floor().as_ivec3().to_array())
    }

    /// Adds what `task` makes of each block's pieces, given its room, and returns the sum of its counts.
    ///
    /// The task returns samples that conflict neither with each other nor with anything in the room, whose radii are
    /// at most a quarter above the end of the octave, no farther than [`OVERHANG`] from the block.
    pub fn grow(
        &mut self,
        job: &Job,
        mesh: &Mesh,
        rule: Rule,
        groups: &Groups<Place, Fragment>,
        task: impl Fn(Place, &mut Room, &mut dyn Iterator<Item = &Fragment>) -> Result<(Vec<(Sample, f64)>, u64)> + Sync,
    ) -> Result<u64> {
        let key = |&group: &usize| (Reverse(groups.place(group).octave), groups.place(group).block.colour());
        let mut order: Vec<usize> = (0..groups.len()).collect();
        order.sort_by_key(key);
        let (mut done, mut total) = (0, 0);
        for members in order.chunk_by(|a, b| key(a) == key(b)) {
            let share = |done: usize| done as f64 / groups.len() as f64;
            let part = job.part(share(done), share(done + members.len()));
            let grown = part.map(members.len(), |member| {
                let place = groups.place(members[member]);
                task(place, &mut self.room(mesh, rule, place), &mut groups.items(members[member]))
            })?;
            done += members.len();
            for (&group, grown) in members.iter().zip(grown) {
                let (samples, count) = grown?;
                total += count;
                self.add(groups.place(group), samples)?;
            }
        }
        Ok(total)
    }

    fn add(&mut self, place: Place, samples: Vec<(Sample, f64)>) -> Result<()> {
        let [start, end] = [self.samples.len(), self.samples.len() + samples.len()].map(u32::try_from);
        let (Ok(start), Ok(end)) = (start, end) else {
            return Err(Error::too_large("radius", format!("it asks for more than {} samples", u32::MAX)));
        };
        self.samples.extend(samples);
        self.octaves.entry(place.octave).or_default().insert(place.block, start..end);
        Ok(())
    }

    /// What matters in a block.
    fn room(&self, mesh: &Mesh, rule: Rule, place: Place) -> Room {
        let mut room = Room::new(rule);
        let end = end_of_octave(place.octave);
        let low = self.origin + SIDE * end * (DVec3::from_array(place.block.0.map(f64::from)) - self.shift);
        // Where points of the block's pieces are, and half of their radius around.
        let margin = DVec3::splat((OVERHANG + HALF) * end);
        let (low, high) = (low - margin, low + SIDE * end + margin);
        for (&octave, blocks) in self.octaves.range(place.octave..) {
            let reach = DVec3::splat((OVERHANG + HALF) * end_of_octave(octave));
            let [first, last] = [low - reach, high + reach].map(|corner| self.block(octave, corner).0);
            let all = (first[2]..=last[2]).flat_map(move |z| {
                (first[1]..=last[1]).flat_map(move |y| (first[0]..=last[0]).map(move |x| Block([x, y, z])))
            });
            for run in all.filter_map(|block| blocks.get(&block)) {
                for &(sample, radius) in &self.samples[run.start as usize..run.end as usize] {
                    let point = exact(sample.position);
                    if (point - point.clamp(low, high)).length() <= 0.51 * radius {
                        room.add(Dot { position: sample.position, radius, normal: mesh.normal(sample.triangle) });
                    }
                }
            }
        }
        room
    }
}
