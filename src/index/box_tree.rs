//! A tree of boxes: which of them meet a box.

use glam::DVec3;

/// The most boxes of a leaf.
const LEAF: usize = 8;

/// A box, by its lowest and its highest corner.
pub type Extent = [DVec3; 2];

/// True if two boxes have a point in common.
pub fn meet(a: &Extent, b: &Extent) -> bool {
    a[0].cmple(b[1]).all() && b[0].cmple(a[1]).all()
}

/// Boxes that are all known at first, halved at the median of their centres along the axis on which these lie widest
/// apart.
pub struct BoxTree {
    /// Their numbers, by leaf.
    numbers: Vec<u32>,
    boxes: Vec<Extent>,
    /// Depth first: a node, all below its first half, all below its second half.
    nodes: Vec<Node>,
}

struct Node {
    around: Extent,
    /// Its boxes, in `numbers`.
    first: u32,
    last: u32,
    /// The second half; 0 for a leaf.
    second: u32,
}

impl BoxTree {
    /// O(n log n), for fewer than 2^32 boxes.
    pub fn new(boxes: Vec<Extent>) -> Self {
        let mut tree = Self { numbers: (0..boxes.len() as u32).collect(), boxes, nodes: Vec::new() };
        tree.divide(0, tree.numbers.len());
        tree
    }

    /// The boxes, by number.
    pub fn boxes(&self) -> &[Extent] {
        &self.boxes
    }

    /// Adds the node of a run of the numbers, and all below it.
    fn divide(&mut self, first: usize, last: usize) {
        let around = |points: &mut dyn Iterator<Item = Extent>| {
            points.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], [a, b]| [low.min(a), high.max(b)])
        };
        let Self { numbers, boxes, nodes } = self;
        let run = &mut numbers[first..last];
        let centre = |number: u32| (boxes[number as usize][0] + boxes[number as usize][1]) / 2.0;
        let [low, high] = around(&mut run.iter().map(|&number| [centre(number); 2]));
        let node = nodes.len();
        let around = around(&mut run.iter().map(|&number| boxes[number as usize]));
        nodes.push(Node { around, first: first as u32, last: last as u32, second: 0 });
        if run.len() <= LEAF {
            return;
        }
        let (middle, axis) = (run.len() / 2, (high - low).max_position());
        run.select_nth_unstable_by(middle, |&a, &b| centre(a)[axis].total_cmp(&centre(b)[axis]));
        self.divide(first, first + middle);
        self.nodes[node].second = self.nodes.len() as u32;
        self.divide(first + middle, last);
    }

    /// Visits the number of each box that meets this one, in no particular order.
    pub fn visit(&self, wanted: &Extent, mut visit: impl FnMut(u32)) {
        let mut waiting = vec![0];
        while let Some(index) = waiting.pop() {
            let node = &self.nodes[index];
            if !meet(&node.around, wanted) {
                continue;
            }
            if node.second > 0 {
                waiting.extend([node.second as usize, index + 1]);
                continue;
            }
            let run = &self.numbers[node.first as usize..node.last as usize];
            run.iter().filter(|&&number| meet(&self.boxes[number as usize], wanted)).for_each(|&number| visit(number));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    #[test]
    fn finds_what_a_look_at_all_finds() {
        let mut rng = Rng::at(3, Draw::Probe, &[]);
        for count in [0, 1, 8, 9, 100, 1000] {
            for size in [0.0, 0.1, 3.0] {
                let mut extent = || {
                    let low = DVec3::from_array([(); 3].map(|()| rng.unit()));
                    [low, low + size * DVec3::from_array([(); 3].map(|()| rng.unit()))]
                };
                let boxes: Vec<_> = (0..count).map(|_| extent()).collect();
                let tree = BoxTree::new(boxes.clone());
                for wanted in (0..20).map(|_| extent()) {
                    let mut found = Vec::new();
                    tree.visit(&wanted, |number| found.push(number));
                    found.sort_unstable();
                    let all = (0..count as u32).filter(|&number| meet(&boxes[number as usize], &wanted));
                    assert_eq!(found, all.collect::<Vec<_>>(), "{count} boxes of {size}");
                }
            }
        }
    }

    #[test]
    fn equal_boxes_are_all_found() {
        let tree = BoxTree::new(vec![[DVec3::ZERO, DVec3::ONE]; 100]);
        let mut found = 0;
        tree.visit(&[DVec3::ONE, DVec3::ONE], |_| found += 1);
        assert_eq!(found, 100);
        tree.visit(&[DVec3::splat(1.1), DVec3::INFINITY], |_| panic!("no box is there"));
    }
}
