//! The samples around a place, one after the other: what many darts and voxels of it are compared with.

use crate::plane::cells::NOWHERE;
use crate::plane::near::{LANES, Rows};

/// Samples, by their coordinates.
#[derive(Default)]
pub(crate) struct List {
    /// The first `count` are samples, the eight after them are [`NOWHERE`].
    pub(super) x: Vec<i32>,
    pub(super) y: Vec<i32>,
    pub(super) count: usize,
}

impl List {
    /// Empties the list for [`collect`](super::near::collect) and makes room for so many samples, whenever they come.
    pub(super) fn clear(&mut self, room: usize) {
        self.count = 0;
        // Vectors of sixteen are written from any place on.
        if self.x.len() < room + 2 * LANES {
            self.x.resize(room + 2 * LANES, NOWHERE);
            self.y.resize(room + 2 * LANES, NOWHERE);
        }
    }

    /// Ends what was collected.
    pub(super) fn end(&mut self) {
        self.x[self.count..self.count + LANES].fill(NOWHERE);
        self.y[self.count..self.count + LANES].fill(NOWHERE);
    }

    /// Adds a sample, for which there must be room.
    pub(super) fn push(&mut self, [x, y]: [i32; 2]) {
        (self.x[self.count], self.y[self.count]) = (x, y);
        (self.x[self.count + LANES], self.y[self.count + LANES]) = (NOWHERE, NOWHERE);
        self.count += 1;
    }

    /// The samples by eights, for the tests in `near.rs`.
    pub(super) fn rows(&self) -> Rows<'_> {
        let count = self.count.div_ceil(LANES).max(1);
        Rows { samples: [&self.x, &self.y], first: 0, stride: LANES, count }
    }

    /// The samples by eights; the last ones are far below zero where there are none.
    pub fn eights(&self) -> impl Iterator<Item = [&[i32; LANES]; 2]> {
        let (xs, ys) = (self.x.as_chunks().0, self.y.as_chunks().0);
        let eights = self.count.div_ceil(LANES);
        xs[..eights].iter().zip(&ys[..eights]).map(|(xs, ys)| [xs, ys])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_holds_what_is_collected_and_pushed_and_nothing_else() {
        let mut list = List::default();
        for collected in [0, 3, 8, 20] {
            list.clear(40);
            // Something is left of vectors that were written beyond the end.
            list.x.fill(7);
            list.y.fill(7);
            for i in 0..collected {
                (list.x[i], list.y[i], list.count) = (i as i32, -(i as i32), i + 1);
            }
            list.end();
            for i in collected..40 {
                let samples: Vec<_> =
                    list.eights().flat_map(|[xs, ys]| xs.iter().copied().zip(ys.iter().copied())).collect();
                assert!(samples[..i].iter().enumerate().all(|(i, &sample)| sample == (i as i32, -(i as i32))));
                assert!(samples[i..].iter().all(|&sample| sample == (NOWHERE, NOWHERE)));
                assert!(list.rows().iter().zip(list.eights()).all(|(row, eight)| row == eight));
                list.push([i as i32, -(i as i32)]);
            }
        }
    }
}
