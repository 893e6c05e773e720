//! The tree of a cloud: leaves of up to 16 points, nodes of eight boxes, one above the other up to the root. Points of
//! a leaf and boxes of a node are in lanes: loops of constant length, of which compilers make vectors.

use crate::error::Result;
use crate::job::Job;

/// A point of the cloud and its index.
type Point<const D: usize> = ([f32; D], u32);

/// The number of halvings from a cloud of so many points to its leaves.
fn halvings(count: usize) -> u32 {
    count.div_ceil(POINTS).next_power_of_two().ilog2()
}

/// The number of places for points in the leaves of the tree of a cloud.
pub(super) fn slots(count: usize) -> usize {
    POINTS << halvings(count)
}

/// The number of times that all threads together halve the cloud, before each halves parts on its own.
const SHARED_HALVINGS: u32 = 6;

/// A kd-tree of points, halved across their longest extent, that knows the farthest of them.
pub(super) struct Tree<const D: usize> {
    nearer: Nearer,
    leaves: Vec<Leaf<D>>,
    /// The levels, from the nodes of leaves up to the root. Child c of a level belongs to the node c / 8 of the next
    /// one.
    levels: Vec<Vec<Node<D>>>,
    /// The leaves, then the nodes of each level, that the place being selected reaches.
    reached: Vec<Vec<u32>>,
}

impl<const D: usize> Tree<D> {
    /// The tree of a cloud of at least one point, all at this distance from the selected points, of which there are
    /// none yet.
    pub fn new(job: &Job, positions: &[[f32; D]], squared: f64, nearer: Nearer) -> Result<Self> {
        let mut points: Vec<Point<D>> = positions.iter().copied().zip(0..).collect();
        let halvings = halvings(points.len());
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

    /// The point that is farthest from the selected ones, the lowest index on ties.
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

/// Appends the leaves of these points, halved this many times more, each with its box and its farthest point.
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

/// The most points of a leaf. Of 8, 16 and 32, measured, 16 takes the least time.
pub(super) const POINTS: usize = 16;

/// The boxes of a node.
pub(super) const BOXES: usize = 8;

/// A point of the cloud, or the best that there is of several: the square of its distance from the selected points, and
/// its index.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Farthest {
    pub squared: f64,
    pub index: u32,
}

/// The farthest point of each of `N` places, as far as known.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct FarthestKnown<const N: usize> {
    squared: [f64; N],
    index: [u32; N],
}

impl<const N: usize> FarthestKnown<N> {
    /// Places without a point: farther than none, behind all.
    const EMPTY: Self = Self { squared: [0.0; N], index: [u32::MAX; N] };

    fn set(&mut self, lane: usize, point: Farthest) {
        (self.squared[lane], self.index[lane]) = (point.squared, point.index);
    }

    /// The farthest of all, the lowest index on ties. `N` is a power of two.
    #[inline(always)]
    fn farthest(&self) -> Farthest {
        let squared = best_of(self.squared, |a, b| if a > b { a } else { b });
        let mut index = self.index;
        for (index, own) in index.iter_mut().zip(self.squared) {
            *index = if own == squared { *index } else { u32::MAX };
        }
        Farthest { squared, index: best_of(index, u32::min) }
    }
}

/// The best of all lanes, by halves.
#[inline(always)]
fn best_of<T: Copy, const N: usize>(mut lanes: [T; N], best: impl Fn(T, T) -> T) -> T {
    let mut half = N / 2;
    while half > 0 {
        for lane in 0..half {
            lanes[lane] = best(lanes[lane], lanes[lane + half]);
        }
        half /= 2;
    }
    lanes[0]
}

/// The new distance of a point when one is selected that is nearer than all before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Nearer {
    /// It is the distance from that one.
    Distance,
    /// It is 0: the point is out.
    Zero,
}

/// A few points that are near each other.
#[derive(Clone, Debug)]
pub(super) struct Leaf<const D: usize> {
    known: FarthestKnown<POINTS>,
    /// Lanes without a point repeat one, and so are in the box.
    places: [[f32; POINTS]; D],
}

impl<const D: usize> Leaf<D> {
    /// A leaf of 1 to [`POINTS`] points, all at this distance from the selected ones.
    pub fn new(points: &[([f32; D], u32)], squared: f64) -> Self {
        let mut leaf = Self { known: FarthestKnown::EMPTY, places: points[0].0.map(|x| [x; POINTS]) };
        for (lane, &(place, index)) in points.iter().enumerate() {
            leaf.known.set(lane, Farthest { squared, index });
            (0..D).for_each(|axis| leaf.places[axis][lane] = place[axis]);
        }
        leaf
    }

    /// The farthest point.
    #[inline(always)]
    pub fn farthest(&self) -> Farthest {
        self.known.farthest()
    }

    /// Takes note of a selected place.
    #[inline(always)]
    pub fn select(&mut self, place: &[f64; D], nearer: Nearer) {
        let mut squared = [0.0; POINTS];
        for (xs, from) in self.places.iter().zip(place) {
            for (squared, &x) in squared.iter_mut().zip(xs) {
                let difference = f64::from(x) - from;
                *squared += difference * difference;
            }
        }
        for (known, squared) in self.known.squared.iter_mut().zip(squared) {
            let then = if nearer == Nearer::Distance { squared } else { 0.0 };
            *known = if squared < *known { then } else { *known };
        }
    }
}

/// Eight boxes of points, and the farthest point of each.
#[derive(Clone, Debug)]
pub(super) struct Node<const D: usize> {
    known: FarthestKnown<BOXES>,
    low: [[f32; BOXES]; D],
    high: [[f32; BOXES]; D],
}

/// A box of points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent<const D: usize> {
    low: [f32; D],
    high: [f32; D],
}

impl<const D: usize> Extent<D> {
    /// The box around points, of which there is at least one.
    pub fn of(places: impl Iterator<Item = [f32; D]>) -> Self {
        places.map(|place| Self { low: place, high: place }).reduce(Self::around).expect("there is a point")
    }

    fn around(self, other: Self) -> Self {
        let low = std::array::from_fn(|axis| self.low[axis].min(other.low[axis]));
        Self { low, high: std::array::from_fn(|axis| self.high[axis].max(other.high[axis])) }
    }

    /// The axis along which it is longest.
    pub fn longest_axis(&self) -> usize {
        let length = |axis: usize| f64::from(self.high[axis]) - f64::from(self.low[axis]);
        (0..D).max_by(|&a, &b| length(a).total_cmp(&length(b))).unwrap_or(0)
    }
}

impl<const D: usize> Node<D> {
    /// The node of 1 to [`BOXES`] boxes, and the box around all of them.
    pub fn new(boxes: &[(Extent<D>, Farthest)]) -> (Self, Extent<D>) {
        let mut node = Self { known: FarthestKnown::EMPTY, low: [[0.0; BOXES]; D], high: [[0.0; BOXES]; D] };
        for (lane, &(extent, farthest)) in boxes.iter().enumerate() {
            node.known.set(lane, farthest);
            for axis in 0..D {
                (node.low[axis][lane], node.high[axis][lane]) = (extent.low[axis], extent.high[axis]);
            }
        }
        let around = boxes.iter().map(|&(extent, _)| extent).reduce(Extent::around).expect("there is a box");
        (node, around)
    }

    /// The farthest point.
    #[inline(always)]
    pub fn farthest(&self) -> Farthest {
        self.known.farthest()
    }

    /// Takes note of the farthest point of a box.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, farthest: Farthest) {
        self.known.set(lane, farthest);
    }

    /// The boxes that are nearer to a place than their farthest point to the selected ones, a bit each: in the others
    /// it is nearer to none. Differences, squares and sums are those of [`Leaf::select`], so they are rounded alike.
    #[inline(always)]
    pub fn reached(&self, place: &[f64; D]) -> u32 {
        let mut squared = [0.0; BOXES];
        for (from, (low, high)) in place.iter().zip(self.low.iter().zip(&self.high)) {
            for (squared, (&low, &high)) in squared.iter_mut().zip(low.iter().zip(high)) {
                let (below, above) = (f64::from(low) - from, from - f64::from(high));
                let outside = if below > above { below } else { above };
                let outside = if outside > 0.0 { outside } else { 0.0 };
                *squared += outside * outside;
            }
        }
        let mut reached = 0;
        for (lane, (squared, known)) in squared.into_iter().zip(self.known.squared).enumerate() {
            reached |= u32::from(squared < known) << lane;
        }
        reached
    }
}
