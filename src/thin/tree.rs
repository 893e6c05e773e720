//! The tree of a cloud: leaves of up to 16 points, nodes of eight boxes, one above the other up to the root.

use super::leaf::{BOXES, Extent, Farthest, Leaf, Nearer, Node, POINTS};
use crate::error::Result;
use crate::job::Job;

/// A point of the cloud and its index.
type Point<const D: usize> = ([f32; D], u32);

/// How many times the cloud is halved by all threads together, before each halves parts on its own.
const SHARED_HALVINGS: u32 = 6;

/// A kd-tree of points, halved across their longest extent, that knows the farthest of them.
pub(super) struct Tree<const D: usize> {
    nearer: Nearer,
    leaves: Vec<Leaf<D>>,
    /// From those of leaves up to the root. Child c of a level belongs to the node c / 8 of the next one.
    levels: Vec<Vec<Node<D>>>,
    /// What the place that is being selected reaches: leaves, then nodes of each level.
    reached: Vec<Vec<u32>>,
}

impl<const D: usize> Tree<D> {
    /// The tree of a cloud of at least one point, all this far from what is selected: nothing yet.
    pub fn new(job: &Job, positions: &[[f32; D]], squared: f64, nearer: Nearer) -> Result<Self> {
        let mut points: Vec<Point<D>> = positions.iter().copied().zip(0..).collect();
        let halvings = points.len().div_ceil(POINTS).next_power_of_two().ilog2();
        let shared = halvings.min(SHARED_HALVINGS);
        let mut parts = vec![points.as_mut_slice()];
        for halving in 0..shared {
            let at = |halving: u32| 0.5 * f64::from(halving) / f64::from(shared);
            let halves = job.part(at(halving), at(halving + 1)).map_each(parts, halved)?;
            parts = halves.into_iter().flatten().collect();
        }
        let made = job.part(0.5, 1.0).map_each(parts, |part| {
            let mut made = Vec::new();
            make_leaves(part, halvings - shared, squared, &mut made);
            made
        })?;
        let (leaves, mut boxes): (Vec<_>, Vec<_>) = made.into_iter().flatten().unzip();
        let mut levels = Vec::new();
        loop {
            let (nodes, above): (Vec<Node<D>>, Vec<_>) = boxes
                .chunks(BOXES)
                .map(|boxes| {
                    let (node, around) = Node::new(boxes);
                    let farthest = node.farthest();
                    (node, (around, farthest))
                })
                .unzip();
            levels.push(nodes);
            if above.len() == 1 {
                break;
            }
            boxes = above;
        }
        let mut reached = vec![Vec::new(); levels.len()];
        reached.push(vec![0]);
        Ok(Self { nearer, leaves, levels, reached })
    }

    /// The point that is farthest from what is selected, the lowest index on ties.
    #[inline(always)]
    pub fn farthest(&self) -> Farthest {
        self.levels[self.levels.len() - 1][0].farthest()
    }

    /// Selects a place: down to the leaves that it reaches, and up again with their farthest points.
    #[inline(always)]
    pub fn select(&mut self, place: &[f64; D]) {
        let Self { nearer, leaves, levels, reached } = self;
        for (level, nodes) in levels.iter().enumerate().rev() {
            let (below, above) = reached.split_at_mut(level + 1);
            let children = &mut below[level];
            children.clear();
            for &node in &above[0] {
                let mut boxes = nodes[node as usize].reached(place);
                while boxes != 0 {
                    children.push(node * BOXES as u32 + boxes.trailing_zeros());
                    boxes &= boxes - 1;
                }
            }
        }
        let (nodes, reached) = (&mut levels[0], &*reached);
        for &leaf in &reached[0] {
            let (leaf, points) = (leaf as usize, &mut leaves[leaf as usize]);
            points.select(place, *nearer);
            nodes[leaf / BOXES].set(leaf % BOXES, points.farthest());
        }
        for level in 1..levels.len() {
            let (below, above) = levels.split_at_mut(level);
            for &node in &reached[level] {
                let node = node as usize;
                above[0][node / BOXES].set(node % BOXES, below[level - 1][node].farthest());
            }
        }
    }
}

/// Two halves of the points, one on each side of a plane across their longest extent.
fn halved<const D: usize>(points: &mut [Point<D>]) -> [&mut [Point<D>]; 2] {
    let axis = Extent::of(points.iter().map(|&(place, _)| place)).longest_axis();
    let middle = points.len() / 2;
    points.select_nth_unstable_by(middle, |a, b| a.0[axis].total_cmp(&b.0[axis]));
    points.split_at_mut(middle).into()
}

/// Appends the leaves of these points, halved so many times more, each with its box and its farthest point.
fn make_leaves<const D: usize>(
    points: &mut [Point<D>],
    halvings: u32,
    squared: f64,
    made: &mut Vec<(Leaf<D>, (Extent<D>, Farthest))>,
) {
    if halvings == 0 {
        let leaf = Leaf::new(points, squared);
        let farthest = leaf.farthest();
        made.push((leaf, (Extent::of(points.iter().map(|&(place, _)| place)), farthest)));
    } else {
        halved(points).into_iter().for_each(|half| make_leaves(half, halvings - 1, squared, made));
    }
}
