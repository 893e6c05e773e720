//! Fill blocks: the leaves of a random kd-tree, and the order in which they are filled.
//!
//! A block is filled by itself, around the samples that its neighbours have by then; blocks that matter to each other are
//! filled one after the other. At its faces the density ripples. The faces of a kd-tree are short: planes through the whole
//! domain, as between columns of blocks, would add their ripples up to peaks in the spectrum that grow with the domain
//! (docs/design/volume.md).

use std::collections::HashMap;

use crate::kdrt::{Leaf, Tree};
use crate::plane::{Lattice, Rect};
use crate::points::Boundary;
use crate::rng::{Draw, Rng};
use crate::volume::fill::Pass;

/// The shortest side of a block, in radii, where the domain is wider. Sides are random, below twice this.
const SHORTEST: f64 = 9.0;

/// The distance from a block in radii within which samples matter to it: darts fall within one radius.
pub const REACH: f64 = 2.0;

/// A block whose samples matter to another one: its number, and the displacement of its image.
pub type Neighbour = (u32, [i32; 3]);

/// The blocks of a cuboid.
pub struct Blocks {
    pub leaves: Vec<Leaf<3>>,
    /// The neighbours of each block, without itself.
    pub neighbours: Vec<Vec<Neighbour>>,
    /// The blocks in the order in which they are filled; those of a wave do not matter to each other.
    pub waves: Vec<Vec<u32>>,
    /// The displacements of images along the axes on which a torus is one block wide: samples there see images of their
    /// own block.
    pub images: Vec<[i32; 3]>,
    /// True for these axes.
    wraps: [bool; 3],
    tree: Tree<3>,
    /// The numbers of blocks by their keys.
    numbers: HashMap<u64, u32>,
}

impl Blocks {
    /// The blocks of a lattice, which depend on the seed.
    pub fn new(lattice: &Lattice<3>, seed: u64) -> Self {
        let shortest = (SHORTEST * lattice.radius).ceil() as i32;
        let tree = Tree::new(lattice.rect(), [shortest; 3], seed);
        let leaves = tree.leaves(&lattice.rect());
        let is_torus = lattice.boundary == Boundary::Periodic;
        // A side of less than two blocks is in one leaf as a whole, any other in none.
        let wraps = lattice.size.map(|size| is_torus && size / 2 < shortest);

        let numbers: HashMap<u64, u32> = leaves.iter().map(|leaf| leaf.key).zip(0..).collect();
        let images = displacements(lattice, wraps.map(|wraps| is_torus && !wraps));
        let reach = (REACH * lattice.radius).ceil() as i32 + 1;
        let around = |number: u32| -> Vec<Neighbour> {
            let window = leaves[number as usize].rect.grown(reach);
            let near = |image: [i32; 3]| {
                let leaves = tree.leaves(&window.translated(image.map(|x| -x))).into_iter();
                leaves.map(|leaf| numbers[&leaf.key]).filter(|&other| other != number).map(move |other| (other, image))
            };
            images.iter().flat_map(|&image| near(image)).collect()
        };
        let neighbours: Vec<_> = (0..leaves.len() as u32).map(around).collect();
        let mut images = displacements(lattice, wraps);
        images.retain(|image| *image != [0; 3]);
        Self { waves: waves(&leaves, &neighbours), leaves, neighbours, images, wraps, tree, numbers }
    }

    /// The number of the block that a lattice point of the domain lies in.
    pub fn holding(&self, point: [i32; 3]) -> u32 {
        self.numbers[&self.tree.leaf(point).key]
    }

    /// The random numbers of a pass over a block.
    pub fn rng(&self, block: u32, pass: Pass) -> Rng {
        Rng::at(self.leaves[block as usize].key, Draw::Volume, &[pass as u64])
    }

    /// The lattice points on which the darts of a block fall.
    pub fn region(&self, lattice: &Lattice<3>, block: &Rect<3>, pass: Pass) -> Rect<3> {
        if pass == Pass::Last {
            return *block;
        }
        let (grown, mut region) = (block.grown(lattice.radius.ceil() as i32), *block);
        for axis in (0..3).filter(|&axis| !self.wraps[axis]) {
            (region.min[axis], region.max[axis]) = (grown.min[axis], grown.max[axis]);
        }
        if lattice.boundary == Boundary::Bounded { region.intersection(&lattice.rect()) } else { region }
    }
}

/// The displacements by a period or none along these axes.
fn displacements(lattice: &Lattice<3>, axes: [bool; 3]) -> Vec<[i32; 3]> {
    let along = |axis: usize| if axes[axis] { vec![-lattice.size[axis], 0, lattice.size[axis]] } else { vec![0] };
    let (x, y, z) = (&along(0), &along(1), &along(2));
    z.iter().flat_map(|&z| y.iter().flat_map(move |&y| x.iter().map(move |&x| [x, y, z]))).collect()
}

/// Colours the blocks in the order of their ranks: each has the first colour that no neighbour has.
fn waves(leaves: &[Leaf<3>], neighbours: &[Vec<Neighbour>]) -> Vec<Vec<u32>> {
    let mut order: Vec<u32> = (0..leaves.len() as u32).collect();
    order.sort_by_key(|&block| leaves[block as usize].rank());
    let (mut colours, mut waves) = (vec![None; leaves.len()], Vec::<Vec<u32>>::new());
    for block in order {
        let near = &neighbours[block as usize];
        let is_free = |colour: &usize| near.iter().all(|&(other, _)| colours[other as usize] != Some(*colour));
        let colour = (0..waves.len()).find(is_free).unwrap_or(waves.len());
        colours[block as usize] = Some(colour);
        if colour == waves.len() {
            waves.push(Vec::new());
        }
        waves[colour].push(block);
    }
    waves
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::Domain;

    fn blocks(size: [f64; 3], boundary: Boundary, seed: u64) -> (Lattice<3>, Blocks) {
        let domain = Domain { min: [1.0; 3], max: size.map(|x| 1.0 + x), boundary };
        let lattice = Lattice::of_any_size(&domain, 0.01).unwrap();
        let blocks = Blocks::new(&lattice, seed);
        (lattice, blocks)
    }

    /// The greatest distance along an axis.
    fn distance(a: &Rect<3>, b: &Rect<3>) -> i32 {
        let along = |axis: usize| (a.min[axis] - b.max[axis] + 1).max(b.min[axis] - a.max[axis] + 1).max(0);
        (0..3).map(along).max().unwrap()
    }

    #[test]
    fn blocks_share_out_the_domain_and_know_their_neighbours() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            for (size, seed) in [[0.5, 0.4, 0.3], [0.9, 0.05, 0.002], [0.19, 0.17, 0.2]].into_iter().zip(0..) {
                let (lattice, blocks) = blocks(size, boundary, seed);
                let volume = |rect: &Rect<3>| (0..3).map(|axis| i128::from(rect.length(axis))).product::<i128>();
                let all: i128 = blocks.leaves.iter().map(|leaf| volume(&leaf.rect)).sum();
                assert_eq!(all, volume(&lattice.rect()));
                for (number, leaf) in (0..).zip(&blocks.leaves) {
                    let last = leaf.rect.max.map(|x| x - 1);
                    assert_eq!([leaf.rect.min, last].map(|point| blocks.holding(point)), [number; 2]);
                }
                let periods = displacements(&lattice, [boundary == Boundary::Periodic; 3]);
                for (number, leaf) in blocks.leaves.iter().enumerate() {
                    for (other, near) in blocks.leaves.iter().enumerate().filter(|&(other, _)| other != number) {
                        for &image in &periods {
                            let found = blocks.neighbours[number].contains(&(other as u32, image));
                            let distance = distance(&leaf.rect, &near.rect.translated(image));
                            let sees_itself = (0..3).any(|axis| blocks.wraps[axis] && image[axis] != 0);
                            assert!(!found || distance <= (2.0 * lattice.radius) as i32 + 2);
                            assert!(found || sees_itself || distance > (2.0 * lattice.radius) as i32);
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn no_wave_has_neighbours_and_each_block_is_in_one() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            let (_, blocks) = blocks([0.6, 0.5, 0.4], boundary, 3);
            let mut waves = vec![usize::MAX; blocks.leaves.len()];
            for (wave, members) in blocks.waves.iter().enumerate() {
                members.iter().for_each(|&block| waves[block as usize] = wave);
            }
            assert!(waves.iter().all(|&wave| wave < blocks.waves.len()));
            for (number, near) in blocks.neighbours.iter().enumerate() {
                assert!(near.iter().all(|&(other, _)| waves[other as usize] != waves[number]));
            }
        }
    }

    #[test]
    fn a_torus_of_one_block_has_images_of_its_own_and_no_rivals() {
        let (lattice, one) = blocks([0.1, 0.05, 0.4], Boundary::Periodic, 0);
        assert_eq!((one.wraps, one.images.len()), ([true, true, false], 8));
        let block = one.leaves[0].rect;
        let region = one.region(&lattice, &block, Pass::First);
        assert_eq!((region.length(0), region.length(1)), (lattice.size[0], lattice.size[1]));
        assert!(region.min[2] < block.min[2] && region.max[2] > block.max[2]);
        assert_eq!(one.region(&lattice, &block, Pass::Last), block);
        let (lattice, bounded) = blocks([0.1, 0.05, 0.4], Boundary::Bounded, 0);
        assert!(bounded.images.is_empty());
        for leaf in &bounded.leaves {
            let region = bounded.region(&lattice, &leaf.rect, Pass::First);
            assert_eq!(region.intersection(&lattice.rect()), region);
        }
    }
}
