//! Algorithm 2 (thesis §2.3.2): parts of the pattern, laid in the blocks.

use azulejo::{Boundary, Context, Domain, Result, maximal};

use super::divide::Block;
use crate::reference::stream;

/// The excess of the radius of the pattern over that of the set, relative to it, so that translated samples, which are
/// rounded to floats, keep theirs.
const GUARD: f64 = 1e-5;

/// A maximal set of a square torus.
pub struct Pattern {
    side: f64,
    samples: Vec<[f32; 2]>,
}

/// A sample of a tile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Laid {
    /// On the unit torus.
    pub place: [f32; 2],
    /// The depth of the position in its block; negative in the margin.
    pub depth: f64,
}

impl Pattern {
    /// A pattern for sets of this radius, with a side in radii. Its floats are as fine as those of the unit square.
    pub fn new(context: &Context, radius: f64, side: f64, seed: u64) -> Result<Self> {
        let side = side * radius;
        let domain = Domain { min: [0.0; 2], max: [side; 2], boundary: Boundary::Periodic };
        let options = maximal::Options::new(radius * (1.0 + GUARD)).domain(domain).seed(seed);
        Ok(Self { side, samples: maximal::sample(context, &options, None)?.positions })
    }

    /// Lays a random part of the pattern in each block and a margin around it.
    ///
    /// A pattern of the radius of the set needs no scaling; on a torus every position can be clipped.
    pub fn lay(&self, blocks: &[Block], margin: f64, seed: u64) -> Vec<Vec<Laid>> {
        let mut random = stream(seed);
        let tile = |block: &Block| {
            let position = [0, 1].map(|_| f64::from(random()) * self.side);
            let enlarged = Block { min: block.min.map(|x| x - margin), max: block.max.map(|x| x + margin) };
            let mut tile = Vec::new();
            for sample in &self.samples {
                // The first image of the sample that is not left of or below the enlarged block, and those after it.
                let first: [f64; 2] = std::array::from_fn(|axis| {
                    let shifted = f64::from(sample[axis]) - position[axis];
                    enlarged.min[axis] + (shifted - enlarged.min[axis]).rem_euclid(self.side)
                });
                let images = |axis: usize| {
                    (0..)
                        .map(move |turn| first[axis] + f64::from(turn) * self.side)
                        .take_while(move |&x| x < enlarged.max[axis])
                };
                for place in images(1).flat_map(|y| images(0).map(move |x| [x, y])) {
                    tile.push(Laid { place: place.map(wrapped), depth: block.depth(place) });
                }
            }
            tile
        };
        blocks.iter().map(tile).collect()
    }
}

/// A float of the unit torus.
fn wrapped(x: f64) -> f32 {
    Some(x.rem_euclid(1.0) as f32).filter(|&x| x < 1.0).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use azulejo::analysis::coverage::covering_radius_2d;
    use azulejo::analysis::spacing::smallest_distance_2d;

    use super::super::divide::building_blocks;
    use super::*;

    #[test]
    fn tiles_keep_the_radius_and_cover_their_blocks() {
        let (context, radius, torus) = (Context::new(1).unwrap(), 0.02, Domain::unit(Boundary::Periodic));
        let pattern = Pattern::new(&context, radius, 25.0, 1).unwrap();
        let blocks = building_blocks(6.0 * radius, 2);
        let tiles = pattern.lay(&blocks, radius, 3);
        assert_eq!(tiles.len(), blocks.len());
        for tile in &tiles {
            let samples: Vec<_> = tile.iter().map(|laid| laid.place).collect();
            assert!(smallest_distance_2d(&context, &torus, &samples, None).unwrap() >= radius);
            assert!(tile.iter().all(|laid| laid.depth >= -radius));
        }
        // With the margins all is covered, without them it is not.
        let all = |least: f64| -> Vec<_> {
            tiles.iter().flatten().filter(|laid| laid.depth >= least).map(|laid| laid.place).collect()
        };
        let covering = |least| covering_radius_2d(&context, &torus, &all(least), None).unwrap();
        assert!(covering(-radius) < radius * (1.0 + 2.0 * GUARD) && covering(0.0) > 1.05 * radius);
    }
}
