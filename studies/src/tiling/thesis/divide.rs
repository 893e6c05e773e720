//! Algorithm 1 (thesis §2.3.1): random rectangles.

use crate::reference::stream;

/// A building block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    pub min: [f64; 2],
    pub max: [f64; 2],
}

impl Block {
    pub fn length(&self, axis: usize) -> f64 {
        self.max[axis] - self.min[axis]
    }

    /// The depth of a position inside of it, along the axis where that is least; negative outside.
    pub fn depth(&self, place: [f64; 2]) -> f64 {
        (0..2)
            .map(|axis| (place[axis] - self.min[axis]).min(self.max[axis] - place[axis]))
            .fold(f64::INFINITY, f64::min)
    }
}

/// The blocks of the unit square, whose sides are at least `shortest`.
///
/// The thesis's pseudocode divides what is longer than the threshold; its fig. 2.5 divides nothing that is shorter than
/// twice the threshold, so that no side falls below it. This does as the figure.
pub fn building_blocks(shortest: f64, seed: u64) -> Vec<Block> {
    let mut blocks = Vec::new();
    divide(Block { min: [0.0; 2], max: [1.0; 2] }, 0, shortest, &mut stream(seed), &mut blocks);
    blocks
}

fn divide(block: Block, axis: usize, shortest: f64, random: &mut impl FnMut() -> f32, blocks: &mut Vec<Block>) {
    let next = 1 - axis;
    let is_long = |axis: usize| block.length(axis) >= 2.0 * shortest;
    if is_long(axis) {
        let place = block.min[axis] + shortest + f64::from(random()) * (block.length(axis) - 2.0 * shortest);
        let (mut left, mut right) = (block, block);
        (left.max[axis], right.min[axis]) = (place, place);
        divide(left, next, shortest, random, blocks);
        divide(right, next, shortest, random, blocks);
    } else if is_long(next) {
        divide(block, next, shortest, random, blocks);
    } else {
        blocks.push(block);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_divide_the_square_with_sides_within_bounds() {
        for seed in 0..10 {
            let blocks = building_blocks(0.03, seed);
            let area: f64 = blocks.iter().map(|block| block.length(0) * block.length(1)).sum();
            assert!((area - 1.0).abs() < 1e-9);
            let is_good = |length: f64| (0.03 - 1e-12..0.06).contains(&length);
            assert!(blocks.iter().all(|block| (0..2).all(|axis| is_good(block.length(axis)))));
        }
        assert_ne!(building_blocks(0.03, 1), building_blocks(0.03, 2));
        let block = Block { min: [0.0; 2], max: [4.0, 2.0] };
        assert_eq!([[1.0, 1.5], [2.0, 3.0], [-2.0, 1.0]].map(|place| block.depth(place)), [0.5, -1.0, -2.0]);
    }
}
