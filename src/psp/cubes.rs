//! Space cut into cubes, the shared-nothing unit of work of a growing set.
//!
//! Whatever is accepted in a cube depends on what stands in and around it. Two cubes that do not touch are far enough apart
//! not to matter to each other; so all cubes of one *colour*, every second one along each axis, are worked on at once,
//! and eight colours are all cubes. The colours make the result independent of the threads.

use crate::psp::fill::space::key;
use crate::psp::fill::table::Table;

/// The side of a cube in radii: large beside the samples around it that a task sees too, small enough for many cubes and
/// for the `u16` that counts the points of [`Surroundings`](crate::psp::surroundings::Surroundings).
pub const SIDE: u32 = 24;

/// A cube, by its number on each axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Cube(pub [i32; 3]);

impl Cube {
    /// Which of the eight colours.
    pub fn colour(self) -> usize {
        self.0.iter().fold(0, |colour, x| colour << 1 | (x & 1) as usize)
    }

    /// What random numbers of the cube are keyed by.
    pub fn key(self) -> [u64; 3] {
        self.0.map(|x| x as u64)
    }

    /// The cube and all that touch it, in fixed order.
    pub fn around(self) -> impl Iterator<Item = Cube> {
        let [x, y, z] = self.0;
        (-1..=1).flat_map(move |k| (-1..=1).flat_map(move |j| (-1..=1).map(move |i| Cube([x + i, y + j, z + k]))))
    }
}

/// Cubes by numbers: from 0, in the order in which they are met.
pub struct Numbers {
    numbers: Table<u32>,
    /// The number that was given last: most cubes are met again at once.
    last: usize,
    /// The cubes that have numbers.
    pub cubes: Vec<Cube>,
}

impl Numbers {
    pub fn new() -> Self {
        Self { numbers: Table::new(), last: 0, cubes: Vec::new() }
    }

    /// The number of a cube: a new one where it has none.
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
