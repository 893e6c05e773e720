//! The passes over the blocks of a group, and what they have made.
//!
//! One dart after the other, anywhere, would give the density of random sequential placement. If each block was filled
//! at once, one next to a finished block would have its samples nearer to that edge than chance puts them: sets would have
//! 2 % more samples. So a first pass throws a few darts at each block, which bring most of the samples at
//! densities where edges matter little, and the last fills what is left. That leaves sets with up to 0.4 % more.

use crate::kdrt::blocks::Blocks;
use crate::kdrt::classes::group::Sample;
use crate::plane::lattice::Lattice;
use crate::plane::rect::Rect;
use crate::points::Boundary;

/// What is thrown at a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pass {
    /// A few darts for each cell.
    First,
    /// Darts until nothing is left, after the first pass.
    Last,
    /// Both at once.
    Only,
}

/// The blocks in which the first pass must be done for the last to fill a window of blocks: those that it fills, and
/// those that touch them.
pub fn first_window(blocks: &Blocks, window: &Rect) -> Rect {
    blocks.grown(&blocks.filled(window), [1, 1])
}

/// The samples that a rectangle of blocks has so far.
pub struct Made {
    /// Along an axis on which the window has all blocks of a torus, each of them once.
    blocks: Rect,
    /// How many blocks, and lattice points, such an axis has.
    periods: [Option<[i32; 2]>; 2],
    samples: Vec<Vec<Sample>>,
}

impl Made {
    /// Nothing yet in the blocks that are filled for a window.
    pub fn new(lattice: &Lattice, blocks: &Blocks, window: &Rect, filled: &Rect) -> Self {
        let (mut held, mut periods) = (*filled, [None; 2]);
        for (axis, count) in blocks.counts().into_iter().enumerate() {
            if lattice.boundary == Boundary::Periodic && window.length(axis) >= count {
                (held.min[axis], held.max[axis]) = (window.min[axis], window.min[axis] + count);
                periods[axis] = Some([count, lattice.size[axis]]);
            }
        }
        let count = held.length(0) as usize * held.length(1) as usize;
        Self { blocks: held, periods, samples: vec![Vec::new(); count] }
    }

    /// Whether a block is held here, and is not an image of one that is.
    pub fn holds(&self, place: [i32; 2]) -> bool {
        self.blocks.contains(place)
    }

    fn index(&self, [column, row]: [i32; 2]) -> usize {
        let [x, y] = [column - self.blocks.min[0], row - self.blocks.min[1]].map(|index| index as usize);
        y * self.blocks.length(0) as usize + x
    }

    /// Adds samples to a block that is held.
    pub fn add(&mut self, place: [i32; 2], samples: Vec<Sample>) {
        let index = self.index(place);
        match &mut self.samples[index] {
            made if made.is_empty() => *made = samples,
            made => made.extend(samples),
        }
    }

    /// The samples in a rectangle of blocks, row by row of them; images where it goes on beyond the edges of the torus.
    #[inline(always)]
    pub fn of_blocks(&self, blocks: &Rect) -> impl Iterator<Item = Sample> {
        let Rect { min, max } = *blocks;
        let places = (min[1]..max[1]).flat_map(move |y| (min[0]..max[0]).map(move |x| [x, y]));
        places.flat_map(|mut place| {
            let mut shift = [0; 2];
            for (axis, period) in self.periods.into_iter().enumerate() {
                if let Some([count, size]) = period {
                    let turns = (place[axis] - self.blocks.min[axis]).div_euclid(count);
                    shift[axis] = turns * size;
                    place[axis] -= turns * count;
                }
            }
            let samples = if self.holds(place) { &self.samples[self.index(place)][..] } else { &[] };
            samples.iter().map(move |sample| Sample {
                point: [sample.point[0] + shift[0], sample.point[1] + shift[1]],
                ..*sample
            })
        })
    }
}
