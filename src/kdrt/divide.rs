//! Divide (thesis §2.3.1): the random kd-tree that cuts the plane into leaves, or space (`D` = 3) into fill blocks.
//!
//! Departures: a node's random numbers are keyed by its path from the root, so that any part of the plane is made from
//! only the nodes that meet it, with the same leaves; and a node is split across its longer side instead of in turns,
//! so that leaves do not become slivers.

use crate::plane::Rect;
use crate::rng::{Draw, Rng, hash};

/// A leaf of the tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaf<const D: usize = 2> {
    pub rect: Rect<D>,
    /// The key of all random numbers of this leaf: the hash of its path.
    pub key: u64,
}

impl<const D: usize> Leaf<D> {
    /// The rank of the leaf: where leaves meet, the one of higher rank keeps its points. No two leaves have the same
    /// rank.
    pub fn rank(&self) -> (u64, [i32; D]) {
        (hash(self.key, Draw::Priority, &[]), self.rect.min)
    }
}

/// The implicit tree: a node is its rectangle and the hash of its path from the root.
#[derive(Clone, Debug)]
pub struct Tree<const D: usize = 2> {
    root: Leaf<D>,
    /// The smallest side of a leaf, per axis: sides are between it and twice it.
    shortest: [i32; D],
    #[cfg(feature = "stages")]
    pub fixed: Fixed,
}

/// The part of the algorithm that tests and studies make deterministic, to measure the effect of its randomness (thesis
/// §2.5.2).
#[cfg(feature = "stages")]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Fixed {
    /// Everything is random, as in the sampler.
    #[default]
    Nothing,
    /// Every node is split in its middle.
    Splits,
    /// Every leaf is given the same part of the pattern.
    Clips,
}

impl<const D: usize> Tree<D> {
    /// A tree over `rect`, whose sides are at least `shortest`.
    pub fn new(rect: Rect<D>, shortest: [i32; D], seed: u64) -> Self {
        Self {
            root: Leaf { rect, key: hash(seed, Draw::Split, &[]) },
            shortest,
            #[cfg(feature = "stages")]
            fixed: Fixed::Nothing,
        }
    }

    /// All leaves that meet `window`, which lies in the domain. O(leaves met + depth).
    pub fn leaves(&self, window: &Rect<D>) -> Vec<Leaf<D>> {
        let mut leaves = Vec::new();
        self.descend(self.root, window, &mut leaves);
        leaves
    }

    /// The leaf that a point of the domain lies in. O(depth).
    pub fn leaf(&self, point: [i32; D]) -> Leaf<D> {
        let mut node = self.root;
        while let Some([lower, upper]) = self.split(node) {
            node = if lower.rect.contains(point) { lower } else { upper };
        }
        node
    }

    fn descend(&self, node: Leaf<D>, window: &Rect<D>, leaves: &mut Vec<Leaf<D>>) {
        if node.rect.intersection(window).is_empty() {
            return;
        }
        match self.split(node) {
            Some(halves) => halves.into_iter().for_each(|half| self.descend(half, window, leaves)),
            #[cfg(feature = "stages")]
            None if self.fixed == Fixed::Clips => leaves.push(Leaf { key: self.root.key, ..node }),
            None => leaves.push(node),
        }
    }

    /// The children of a node; none if it is a leaf: a node is split as long as both parts are long enough.
    fn split(&self, node: Leaf<D>) -> Option<[Leaf<D>; 2]> {
        let axis = (0..D)
            .filter(|&axis| node.rect.length(axis) / 2 >= self.shortest[axis])
            .max_by_key(|&axis| node.rect.length(axis))?;
        let choices = node.rect.length(axis) - 2 * self.shortest[axis] + 1;
        let choice = Rng::at(node.key, Draw::Split, &[]).below(choices as u64) as i32;
        #[cfg(feature = "stages")]
        let choice = if self.fixed == Fixed::Splits { choices / 2 } else { choice };
        let edge = node.rect.min[axis] + self.shortest[axis] + choice;
        let mut rects = [node.rect; 2];
        rects[0].max[axis] = edge;
        rects[1].min[axis] = edge;
        Some([0, 1].map(|half| Leaf { rect: rects[half], key: hash(node.key, Draw::Split, &[half as u64]) }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DOMAIN: Rect = Rect { min: [0; 2], max: [10_000, 3_000] };

    #[test]
    fn leaves_tile_the_domain_with_sides_within_bounds() {
        for seed in 0..20 {
            let shortest = [100 + 10 * seed as i32, 250];
            let leaves = Tree::new(DOMAIN, shortest, seed).leaves(&DOMAIN);
            let area = |rect: &Rect| i64::from(rect.length(0)) * i64::from(rect.length(1));
            assert_eq!(leaves.iter().map(|leaf| area(&leaf.rect)).sum::<i64>(), area(&DOMAIN));
            for (i, leaf) in leaves.iter().enumerate() {
                assert!((0..2).all(|axis| (shortest[axis]..2 * shortest[axis]).contains(&leaf.rect.length(axis))));
                assert!(leaves[..i].iter().all(|other| other.rect.intersection(&leaf.rect).is_empty()));
                assert!(leaves[..i].iter().all(|other| other.rank() != leaf.rank() && other.key != leaf.key));
            }
        }
    }

    #[test]
    fn a_window_meets_the_same_leaves_as_the_whole() {
        let tree = Tree::new(DOMAIN, [90, 90], 3);
        let all = tree.leaves(&DOMAIN);
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        for _ in 0..200 {
            let min = [rng.below(9_000) as i32, rng.below(2_000) as i32];
            let window = Rect { min, max: [min[0] + 1 + rng.below(900) as i32, min[1] + 1 + rng.below(900) as i32] };
            let met: Vec<_> = all.iter().copied().filter(|leaf| !leaf.rect.intersection(&window).is_empty()).collect();
            assert_eq!(tree.leaves(&window), met);
        }
    }

    #[test]
    fn a_side_of_twice_the_shortest_is_split_in_its_middle() {
        let leaves = Tree::new(DOMAIN, [5_000, 3_000], 0).leaves(&DOMAIN);
        assert_eq!(leaves.iter().map(|leaf| leaf.rect.max[0]).collect::<Vec<_>>(), [5_000, 10_000]);
    }
}
