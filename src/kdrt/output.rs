//! The samples of a window, as floats in the order in which they are found.

use crate::plane::lattice::Lattice;
use crate::plane::rect::Rect;

use crate::kdrt::clip::Row;

/// For how many samples there should be memory where an unbiased set would have so many: seams make a set up to 2 %
/// denser; that much again for chance.
pub fn capacity(expected: f64) -> usize {
    (expected * 1.04) as usize
}

/// Collects the samples that lie in a rectangle.
pub struct Output<'a> {
    lattice: &'a Lattice,
    rect: Rect,
    samples: Vec<[f32; 2]>,
}

impl<'a> Output<'a> {
    /// An empty collection for the samples in `rect`.
    pub fn new(lattice: &'a Lattice, rect: Rect) -> Self {
        Self { lattice, rect, samples: Vec::with_capacity(capacity(lattice.samples_in(&rect))) }
    }

    /// Adds a sample if it lies in the rectangle.
    pub fn push(&mut self, sample: [i32; 2]) {
        if self.rect.contains(sample) {
            self.samples.push(self.lattice.position(sample));
        }
    }

    /// Adds the samples of a row of the pattern that lie in the rectangle. The row must be whole.
    pub fn copy(&mut self, row: &Row) {
        let inside = self.rect.intersection(&row.part);
        if inside == row.part {
            self.samples.extend(row.points().map(|point| self.lattice.position(point)));
        } else if !inside.is_empty() {
            row.points().for_each(|point| self.push(point));
        }
    }

    /// How many samples there are so far.
    #[cfg(feature = "stages")]
    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// The samples.
    pub fn finish(self) -> Vec<[f32; 2]> {
        self.samples
    }
}
