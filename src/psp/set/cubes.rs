//! Space cut into cubes, and sets of samples that grow cube by cube.
//!
//! The samples accepted in a cube depend on those in and around it. Two cubes that do not touch are far enough apart
//! not to affect each other; so all cubes of one *colour*, every second one along each axis, are filled at once, and
//! eight colours make up all cubes. The colours make the result independent of the threads.
//!
//! If the radius varies, each octave of radii has cubes of its own. Those of small radii are filled first.

use std::collections::{BTreeMap, HashMap};
use std::ops::{AddAssign, Range};

use crate::error::{Error, Result};
use crate::job::Job;
use crate::psp::fill::space::key;
use crate::psp::fill::table::Table;

/// The side of a cube in radii: large compared with the margin of samples around it that a task reads too, small enough
/// for many cubes.
pub const SIDE: u32 = 24;

/// A cube, by its number on each axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Cube(pub [i32; 3]);

impl Cube {
    /// The number of its colour, of eight.
    pub fn colour(self) -> usize {
        self.0.iter().fold(0, |colour, x| colour << 1 | (x & 1) as usize)
    }

    /// The key of the cube's random numbers.
    pub fn key(self) -> [u64; 3] {
        self.0.map(|x| x as u64)
    }

    /// The cube and all that touch it, in fixed order.
    pub fn around(self) -> [Cube; 27] {
        let [x, y, z] = self.0;
        std::array::from_fn(|number| {
            let number = number as i32;
            Cube([x + number % 3 - 1, y + number / 3 % 3 - 1, z + number / 9 - 1])
        })
    }
}

/// A cube of an octave of radii.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct OctaveCube {
    pub octave: i32,
    pub cube: Cube,
}

impl OctaveCube {
    /// The key of the cube's random numbers.
    pub fn key(self) -> [u64; 4] {
        let [x, y, z] = self.cube.key();
        [self.octave as u64, x, y, z]
    }

    /// The turn of a cube: cubes of the same turn are filled at once, smaller ones first.
    fn turn(self) -> (i32, usize) {
        (self.octave, self.cube.colour())
    }
}

/// The cubes of sets with one radius are all of one octave.
impl From<Cube> for OctaveCube {
    fn from(cube: Cube) -> Self {
        Self { octave: 0, cube }
    }
}

/// The cubes that a set grows in.
pub trait Cubes: Sync {
    type Sample: Copy + Send + Sync;

    /// The cube that a sample is listed in, unless another one accepted it.
    fn cube_of(&self, sample: &Self::Sample) -> OctaveCube;
}

/// A conflict-free set of samples that only grows.
pub struct Growing<C: Cubes> {
    pub cubes: C,
    /// The samples in the order in which they were accepted.
    samples: Vec<C::Sample>,
    /// The samples of each cube, by octave. They lie in it or slightly outside: it is the cube that accepted them.
    octaves: BTreeMap<i32, HashMap<Cube, Vec<Range<u32>>>>,
    /// The number of samples that are listed by their cubes.
    listed: usize,
}

impl<C: Cubes> Growing<C> {
    /// A set of samples that do not conflict, in their order.
    pub fn in_order(cubes: C, samples: Vec<C::Sample>) -> Self {
        Self { cubes, samples, octaves: BTreeMap::new(), listed: 0 }
    }

    /// The samples, the last added last.
    pub fn into_samples(self) -> Vec<C::Sample> {
        self.samples
    }

    /// The number of samples.
    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// The samples in the order in which they were accepted.
    pub fn all(&self) -> &[C::Sample] {
        &self.samples
    }

    /// Calls `task` for each of the cubes, all of them different, with the number of the cube and the set so far; adds
    /// the samples that it returns, and returns the sum of its counts.
    ///
    /// The task must return samples that conflict neither with each other nor with any sample in and around the cube,
    /// and lie at most slightly outside of it. If the job fails or is cancelled, the samples of complete colours
    /// remain.
    pub fn grow<T: AddAssign + Default + Send>(
        &mut self,
        job: &Job,
        cubes: &[impl Copy + Into<OctaveCube>],
        task: impl Fn(usize, &Self) -> Result<(Vec<C::Sample>, T)> + Sync,
    ) -> Result<T> {
        self.list_all();
        let turn = |&number: &usize| cubes[number].into().turn();
        let mut order: Vec<usize> = (0..cubes.len()).collect();
        order.sort_by_key(turn);
        let (mut done, mut total) = (0, T::default());
        for members in order.chunk_by(|a, b| turn(a) == turn(b)) {
            let share = |done: usize| done as f64 / cubes.len() as f64;
            let part = job.part(share(done), share(done + members.len()));
            let grown = part.map(members.len(), |member| task(members[member], self))?;
            done += members.len();
            for (&number, grown) in members.iter().zip(grown) {
                let (samples, count) = grown?;
                total += count;
                self.accept(cubes[number].into(), samples)?;
            }
        }
        Ok(total)
    }

    /// Adds samples that a cube has accepted.
    fn accept(&mut self, cube: OctaveCube, samples: Vec<C::Sample>) -> Result<()> {
        let [start, end] = [self.len(), self.len() + samples.len()].map(u32::try_from);
        let (Ok(start), Ok(end)) = (start, end) else {
            return Err(Error::too_large("radius", format!("it asks for more than {} samples", u32::MAX)));
        };
        if start < end {
            self.samples.extend(samples);
            self.listed = self.len();
            self.octaves.entry(cube.octave).or_default().entry(cube.cube).or_default().push(start..end);
        }
        Ok(())
    }

    /// Adds samples that conflict neither with each other nor with any other sample.
    pub fn append(&mut self, samples: &mut Vec<C::Sample>) {
        self.samples.append(samples);
    }

    /// Lists all samples by their cubes.
    pub fn list_all(&mut self) {
        for number in self.listed..self.len() {
            let OctaveCube { octave, cube } = self.cubes.cube_of(&self.samples[number]);
            let (runs, number) = (self.octaves.entry(octave).or_default().entry(cube).or_default(), number as u32);
            match runs.last_mut() {
                Some(run) if run.end == number => run.end += 1,
                _ => runs.push(number..number + 1),
            }
        }
        self.listed = self.len();
    }

    /// The samples of a cube and of those of its octave that touch it.
    pub fn around(&self, cube: impl Into<OctaveCube>) -> impl Iterator<Item = &C::Sample> {
        let OctaveCube { octave, cube } = cube.into();
        let cubes = self.octaves.get(&octave).into_iter();
        let runs = cubes.flat_map(move |cubes| cube.around().into_iter().filter_map(|cube| cubes.get(&cube)).flatten());
        runs.flat_map(|run| &self.samples[run.start as usize..run.end as usize])
    }

    /// The octaves of all cubes with samples.
    pub fn octaves(&self) -> impl Iterator<Item = i32> {
        self.octaves.keys().copied()
    }

    /// The samples of all cubes of an octave from the first to the last, in their order.
    pub fn in_range(&self, octave: i32, [Cube(first), Cube(last)]: [Cube; 2]) -> impl Iterator<Item = &C::Sample> {
        let cubes = &self.octaves[&octave];
        let count: f64 = (0..3).map(|axis| f64::from(last[axis]) - f64::from(first[axis]) + 1.0).product();
        // Each cube is looked up, or selected from all cubes if these are fewer.
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
        runs.into_iter().flat_map(|run| &self.samples[run.start as usize..run.end as usize])
    }

    /// Removes all but the first samples.
    pub fn truncate(&mut self, len: usize) {
        self.samples.truncate(len);
        self.listed = self.listed.min(len);
        for runs in self.octaves.values_mut().flat_map(HashMap::values_mut) {
            runs.retain(|run| run.end as usize <= len);
        }
    }
}

/// Cubes by number: from 0, in the order in which they are first encountered.
pub struct Numbers {
    numbers: Table<u32>,
    /// The number that was returned last: most cubes are repeated immediately.
    last: usize,
    /// The cubes that have numbers.
    pub cubes: Vec<Cube>,
}

impl Numbers {
    pub fn new() -> Self {
        Self { numbers: Table::new(), last: 0, cubes: Vec::new() }
    }

    /// The number of a cube: a new one if it has none.
    #[inline]
    pub fn of(&mut self, cube: Cube) -> usize {
        if self.cubes.get(self.last) != Some(&cube) {
            self.last = self.find(cube);
        }
        self.last
    }

    fn find(&mut self, cube: Cube) -> usize {
        let number = self.numbers.entry(key(cube.0.map(|x| x as u32)));
        if *number == 0 {
            self.cubes.push(cube);
            *number = self.cubes.len() as u32;
        }
        *number as usize - 1
    }
}
