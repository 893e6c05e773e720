//! Space cut into cubes, the shared-nothing unit of work of a growing set.
//!
//! Whatever a block accepts depends on what stands in and around it. Two blocks that do not touch are far enough apart
//! not to matter to each other; so all blocks of one *colour*, every second one along each axis, are worked on at once,
//! and eight colours are all blocks. The colours make the result independent of the threads.

use crate::error::Result;
use crate::job::Job;

/// The side of a block in radii: large beside the samples around it that its room holds too, small enough for many
/// blocks and for the `u16` that counts the points of a room.
pub(super) const SIDE: u32 = 24;

/// A block, by its number on each axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Block(pub [i32; 3]);

impl Block {
    /// Which of the eight colours.
    pub fn colour(self) -> usize {
        self.0.iter().fold(0, |colour, x| colour << 1 | (x & 1) as usize)
    }

    /// What random numbers of the block are keyed by.
    pub fn key(self) -> [u64; 3] {
        self.0.map(|x| x as u64)
    }

    /// The block and all that touch it, in fixed order.
    pub fn around(self) -> impl Iterator<Item = Block> {
        let [x, y, z] = self.0;
        (-1..=1).flat_map(move |k| (-1..=1).flat_map(move |j| (-1..=1).map(move |i| Block([x + i, y + j, z + k]))))
    }
}

/// Items sorted by their place: those of a place are the items of a run of parts.
pub(super) struct Groups<K, T> {
    /// Places with some of their items, sorted by place; parts of one place in the order in which they were made.
    parts: Vec<(K, Vec<T>)>,
    /// Where the parts of each place end.
    ends: Vec<usize>,
}

impl<K: Copy + Ord + Send, T: Send> Groups<K, T> {
    /// The items that each task hands to its second argument with their places.
    pub fn collect<R: Send>(
        job: &Job,
        count: usize,
        task: impl Fn(usize, &mut dyn FnMut(K, T)) -> R + Sync,
    ) -> Result<(Self, Vec<R>)> {
        let results = job.map(count, |index| {
            let mut parts: Vec<(K, Vec<T>)> = Vec::new();
            let mut last = 0;
            let result = task(index, &mut |place, item| {
                if parts.get(last).is_none_or(|part| part.0 != place) {
                    last = parts.iter().position(|part| part.0 == place).unwrap_or(parts.len());
                    if last == parts.len() {
                        parts.push((place, Vec::new()));
                    }
                }
                parts[last].1.push(item);
            });
            (parts, result)
        })?;
        let (parts, results): (Vec<_>, _) = results.into_iter().unzip();
        let mut parts: Vec<_> = parts.into_iter().flatten().collect();
        parts.sort_by_key(|part| part.0);
        let differs = |&end: &usize| end == parts.len() || parts[end - 1].0 != parts[end].0;
        let ends = (1..=parts.len()).filter(differs).collect();
        Ok((Self { parts, ends }, results))
    }

    /// The number of places that have items.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// The place of a group.
    pub fn place(&self, group: usize) -> K {
        self.parts[self.ends[group] - 1].0
    }

    /// The items of a group, in the order of the tasks that made them.
    pub fn items(&self, group: usize) -> impl Iterator<Item = &T> + Clone {
        let start = if group == 0 { 0 } else { self.ends[group - 1] };
        self.parts[start..self.ends[group]].iter().flat_map(|part| &part.1)
    }
}
