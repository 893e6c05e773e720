//! The list of samples around a place, with which many darts and voxels are compared.

use crate::plane::rect::Rect;
use crate::plane::rows::{LANES, NOWHERE, Rows};
use crate::simd::{Lanes, Work};

/// Samples, by their coordinates.
#[derive(Default)]
pub(crate) struct List {
    /// The first `count` are samples, the eight after them are [`NOWHERE`].
    pub x: Vec<i32>,
    pub y: Vec<i32>,
    pub count: usize,
}

impl List {
    /// Empties the list for [`Collect`], with capacity for this number of samples.
    pub fn clear(&mut self, capacity: usize) {
        self.count = 0;
        // Vectors of sixteen are written at any offset.
        if self.x.len() < capacity + 2 * LANES {
            self.x.resize(capacity + 2 * LANES, NOWHERE);
            self.y.resize(capacity + 2 * LANES, NOWHERE);
        }
    }

    /// Terminates the collected samples.
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

    /// The samples in groups of eight, for the tests in `near.rs`.
    pub fn rows(&self) -> Rows<'_> {
        let count = self.count.div_ceil(LANES).max(1);
        Rows { samples: [&self.x, &self.y], first: 0, stride: LANES, count }
    }

    /// The samples in groups of eight; missing ones of the last group are far below zero.
    pub fn eights(&self) -> impl Iterator<Item = [&[i32; LANES]; 2]> {
        let (xs, ys) = (self.x.as_chunks().0, self.y.as_chunks().0);
        let eights = self.count.div_ceil(LANES);
        xs[..eights].iter().zip(&ys[..eights]).map(|(xs, ys)| [xs, ys])
    }
}

/// Appends the samples in the first `width` cells of each row that lie in a rectangle to a list that has capacity for
/// all. After the rows sixteen more cells must be readable.
pub struct Collect<'a> {
    pub rows: &'a Rows<'a>,
    pub width: usize,
    pub rect: &'a Rect,
    pub list: &'a mut List,
}

/// The number of cells that are read at a time.
const WIDE: usize = 2 * LANES;

const NUMBERS: [i32; WIDE] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

impl Work for Collect<'_> {
    type Out = ();

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Self { rows, width, rect, list } = self;
        // A sample lies beyond the lattice point before the rectangle, and before its end.
        let before = [lanes.splat_int(rect.min[0] - 1), lanes.splat_int(rect.min[1] - 1)];
        let end = [lanes.splat_int(rect.max[0]), lanes.splat_int(rect.max[1])];
        let numbers = lanes.load_ints(&NUMBERS);
        let mut row = 0;
        while row < rows.count {
            let (first, mut column) = (rows.first + row * rows.stride, 0);
            while column < width {
                let [x, y] = [wide(rows.samples[0], first + column), wide(rows.samples[1], first + column)];
                let (x, y) = (lanes.load_ints(x), lanes.load_ints(y));
                let inside = lanes.both(
                    lanes.both(lanes.less_ints(before[0], x), lanes.less_ints(x, end[0])),
                    lanes.both(lanes.less_ints(before[1], y), lanes.less_ints(y, end[1])),
                );
                let inside = lanes.both(inside, lanes.less_ints(numbers, lanes.splat_int((width - column) as i32)));
                let count = list.count;
                lanes.compress_ints(inside, x, (&mut list.x[count..count + WIDE]).try_into().expect("sixteen places"));
                lanes.compress_ints(inside, y, (&mut list.y[count..count + WIDE]).try_into().expect("sixteen places"));
                list.count += lanes.bits(inside).count_ones() as usize;
                column += WIDE;
            }
            row += 1;
        }
    }
}

#[inline(always)]
fn wide(samples: &[i32], start: usize) -> &[i32; WIDE] {
    samples[start..start + WIDE].try_into().expect("sixteen cells")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_holds_what_is_collected_and_pushed_and_nothing_else() {
        let mut list = List::default();
        for collected in [0, 3, 8, 20] {
            list.clear(40);
            // Remainders of vectors that were written beyond the end.
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
