//! The samples around a place, one after the other: what many darts and voxels of it are compared with.

use crate::plane::rect::Rect;
use crate::plane::rows::{LANES, NOWHERE, Rows};

/// Samples, by their coordinates.
#[derive(Default)]
pub(crate) struct List {
    /// The first `count` are samples, the eight after them are [`NOWHERE`].
    pub x: Vec<i32>,
    pub y: Vec<i32>,
    pub count: usize,
}

impl List {
    /// Empties the list for [`collect`], with capacity for so many samples in all.
    pub fn clear(&mut self, capacity: usize) {
        self.count = 0;
        // Vectors of sixteen are written from any place on.
        if self.x.len() < capacity + 2 * LANES {
            self.x.resize(capacity + 2 * LANES, NOWHERE);
            self.y.resize(capacity + 2 * LANES, NOWHERE);
        }
    }

    /// Ends what was collected.
    pub fn end(&mut self) {
        self.x[self.count..self.count + LANES].fill(NOWHERE);
        self.y[self.count..self.count + LANES].fill(NOWHERE);
    }

    /// Adds a sample; the list must have capacity for it.
    pub fn push(&mut self, [x, y]: [i32; 2]) {
        (self.x[self.count], self.y[self.count]) = (x, y);
        (self.x[self.count + LANES], self.y[self.count + LANES]) = (NOWHERE, NOWHERE);
        self.count += 1;
    }

    /// The samples by eights, for the tests in `near.rs`.
    pub fn rows(&self) -> Rows<'_> {
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

/// Appends the samples in the first `width` cells of each row that lie in a rectangle to a list that has capacity for all.
pub fn collect(rows: &Rows, width: usize, rect: &Rect, list: &mut List) {
    let [xs, ys] = rows.samples;
    for row in 0..rows.count {
        let cells = rows.first + row * rows.stride..rows.first + row * rows.stride + width;
        for (&x, &y) in xs[cells.clone()].iter().zip(&ys[cells]) {
            // Written in any case and counted only if it is one: which cells have one is not predictable.
            (list.x[list.count], list.y[list.count]) = (x, y);
            list.count += usize::from(rect.contains([x, y]));
        }
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
