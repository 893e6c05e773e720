//! A tree of triangles with boxes: those that a ray along +x can cross, those near a box, and those nearest to a place.
//!
//! Triangles are sorted along the Z-curve; eight in a row have a node, eight nodes in a row have one above, up to the root. So
//! the tree has no pointers, and the boxes of a node's children are tested together.

use crate::index::curve::{SPACE_BITS, morton3, sorted};
use crate::interior::crossing::crossing;

/// The children of a node.
pub const CHILDREN: usize = 8;

/// The most levels: 8^11 triangles are more than there can be.
const MOST_LEVELS: usize = 11;

/// The boxes of the children of a node; those that there are not are empty.
#[derive(Clone, Copy, Debug)]
struct Boxes {
    low: [[f32; CHILDREN]; 3],
    high: [[f32; CHILDREN]; 3],
}

impl Boxes {
    const EMPTY: Self = Self { low: [[f32::INFINITY; CHILDREN]; 3], high: [[f32::NEG_INFINITY; CHILDREN]; 3] };

    /// The box around all.
    fn hull(&self) -> [[f32; 3]; 2] {
        let low = self.low.map(|low| low.into_iter().fold(f32::INFINITY, f32::min));
        [low, self.high.map(|high| high.into_iter().fold(f32::NEG_INFINITY, f32::max))]
    }

    /// The squared distances of a place from the boxes: infinite from empty ones.
    #[inline(always)]
    fn distances_squared(&self, place: [f64; 3]) -> [f64; CHILDREN] {
        let (mut squares, mut axis) = ([0.0; CHILDREN], 0);
        while axis < 3 {
            let mut child = 0;
            while child < CHILDREN {
                let (low, high) = (f64::from(self.low[axis][child]), f64::from(self.high[axis][child]));
                let beyond = (low - place[axis]).max(place[axis] - high).max(0.0);
                squares[child] += beyond * beyond;
                child += 1;
            }
            axis += 1;
        }
        squares
    }
}

/// Triangles by their corners.
#[derive(Debug)]
pub struct Tree {
    /// In the order of the tree.
    pub corners: Vec<[[f32; 3]; 3]>,
    /// The boxes of the triangles, of the nodes above them, and so on up to the root, which is alone.
    levels: Vec<Vec<Boxes>>,
}

/// The box of a triangle.
pub fn hull([a, b, c]: &[[f32; 3]; 3]) -> [[f32; 3]; 2] {
    let of = |pick: fn(f32, f32) -> f32| std::array::from_fn(|k| pick(a[k], pick(b[k], c[k])));
    [of(f32::min), of(f32::max)]
}

impl Tree {
    /// The tree of triangles, and their numbers in its order. O(n log n).
    pub fn new(triangles: &[[[f32; 3]; 3]]) -> (Self, Vec<u32>) {
        let all =
            triangles.iter().map(hull).fold([[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]], |[low, high], [l, h]| {
                [[0, 1, 2].map(|k| f32::min(low[k], l[k])), [0, 1, 2].map(|k| f32::max(high[k], h[k]))]
            });
        let cells = f64::from((1u32 << SPACE_BITS) - 1);
        let scale: [f64; 3] = std::array::from_fn(|k| {
            let width = f64::from(all[1][k]) - f64::from(all[0][k]);
            if width > 0.0 { cells / (2.0 * width) } else { 0.0 }
        });
        let place = |triangle: &[[f32; 3]; 3]| {
            let [low, high] = hull(triangle);
            let along = |k: usize| f64::from(low[k]) + f64::from(high[k]) - 2.0 * f64::from(all[0][k]);
            morton3(std::array::from_fn(|k| (along(k) * scale[k]) as u32))
        };
        let order: Vec<u32> = sorted(triangles.iter().map(place)).into_iter().map(|(_, number)| number).collect();
        let corners: Vec<_> = order.iter().map(|&number| triangles[number as usize]).collect();
        let mut levels = vec![level(corners.iter().map(hull))];
        while let Some(last) = levels.last()
            && last.len() > 1
        {
            let above = level(last.iter().map(Boxes::hull));
            levels.push(above);
        }
        (Self { corners, levels }, order)
    }

    /// The number of levels.
    pub fn levels(&self) -> usize {
        self.levels.len()
    }

    /// The number of nodes of a level.
    pub fn nodes(&self, level: usize) -> usize {
        self.levels[level].len()
    }

    /// The box of a node.
    pub fn node_box(&self, level: usize, node: usize) -> [[f32; 3]; 2] {
        self.levels[level][node].hull()
    }

    /// Visits the triangles whose boxes pass a test, which all boxes around them pass: it gives 1 for each child that does.
    #[inline(always)]
    fn visit(&self, passes: impl Fn(&Boxes, usize) -> u32, mut triangle: impl FnMut(usize)) {
        let (mut stack, mut depth) = ([(0u32, 0u32); MOST_LEVELS * CHILDREN], 1);
        stack[0] = (self.levels.len() as u32 - 1, 0);
        while depth > 0 {
            depth -= 1;
            let (level, node) = stack[depth];
            let boxes = &self.levels[level as usize][node as usize];
            // A sum, which the compiler makes of vectors.
            let (mut passing, mut child) = (0, 0);
            while child < CHILDREN {
                passing += passes(boxes, child) << child;
                child += 1;
            }
            while passing != 0 {
                let number = CHILDREN as u32 * node + passing.trailing_zeros();
                passing &= passing - 1;
                if level == 0 {
                    triangle(number as usize);
                } else {
                    stack[depth] = (level - 1, number);
                    depth += 1;
                }
            }
        }
    }

    /// The sum of the crossings of the ray from a point along +x.
    pub fn crossings(&self, point: [f32; 3]) -> i32 {
        let mut sum = 0;
        self.for_each_crossing(point, |_, crossing| sum += crossing);
        sum
    }

    /// Visits the triangles that the ray from a point along +x may cross, each with its crossing.
    #[inline(always)]
    pub fn for_each_crossing(&self, point: [f32; 3], mut crossed: impl FnMut(usize, i32)) {
        let [x, y, z] = point;
        let is_met = |Boxes { low, high }: &Boxes, k: usize| {
            let (is_beside, is_above) = ((low[1][k] <= y) & (y <= high[1][k]), (low[2][k] <= z) & (z <= high[2][k]));
            u32::from(is_beside & is_above & (x <= high[0][k]))
        };
        self.visit(is_met, |triangle| crossed(triangle, crossing(point, &self.corners[triangle])));
    }

    /// Visits triangles near a place, the nearer boxes first, and no box that is farther than the square of a distance: that of
    /// `within`, then what the last triangle gave.
    pub fn for_each_nearest(&self, place: [f64; 3], within: f64, mut triangle: impl FnMut(usize) -> f64) {
        let (mut stack, mut depth, mut least) = ([(0.0, 0, 0); MOST_LEVELS * CHILDREN], 1, within);
        stack[0] = (0.0, self.levels.len() as u32 - 1, 0u32);
        while depth > 0 {
            depth -= 1;
            let (squared, level, node) = stack[depth];
            if squared > least {
                continue;
            }
            let squares = self.levels[level as usize][node as usize].distances_squared(place);
            let first = depth;
            for (child, &squared) in squares.iter().enumerate() {
                let number = CHILDREN as u32 * node + child as u32;
                if squared > least {
                    continue;
                }
                if level == 0 {
                    least = triangle(number as usize);
                } else {
                    // The nearest is the last, which is visited next.
                    let mut to = depth;
                    while to > first && stack[to - 1].0 < squared {
                        stack[to] = stack[to - 1];
                        to -= 1;
                    }
                    stack[to] = (squared, level - 1, number);
                    depth += 1;
                }
            }
        }
    }

    /// Visits the triangles whose boxes touch a box.
    pub fn for_each_near(&self, [from, to]: [[f32; 3]; 2], triangle: impl FnMut(usize)) {
        let is_near = |Boxes { low, high }: &Boxes, k: usize| {
            let along = |axis: usize| (low[axis][k] <= to[axis]) & (from[axis] <= high[axis][k]);
            u32::from(along(0) & along(1) & along(2))
        };
        self.visit(is_near, triangle);
    }
}

/// The nodes over a row of boxes.
fn level(boxes: impl ExactSizeIterator<Item = [[f32; 3]; 2]>) -> Vec<Boxes> {
    let mut nodes = vec![Boxes::EMPTY; boxes.len().div_ceil(CHILDREN).max(1)];
    for (number, [low, high]) in boxes.enumerate() {
        let (node, child) = (&mut nodes[number / CHILDREN], number % CHILDREN);
        for axis in 0..3 {
            (node.low[axis][child], node.high[axis][child]) = (low[axis], high[axis]);
        }
    }
    nodes
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    /// Random triangles of all sizes, some without an extent along an axis.
    pub fn soup(count: usize, seed: u64) -> Vec<[[f32; 3]; 3]> {
        let mut rng = Rng::at(seed, Draw::Probe, &[]);
        let triangle = |index: usize| {
            let size = [0.5, 0.1, 0.01][index % 3];
            let centre = [0; 3].map(|_: i32| rng.unit() as f32);
            let flat = (rng.below(8) as usize, if index.is_multiple_of(7) { 0.0 } else { 1.0 });
            [0; 3].map(|_: i32| {
                let mut corner = centre.map(|x| x + size * (rng.unit() as f32 - 0.5));
                if flat.0 < 3 {
                    corner[flat.0] = centre[flat.0] + flat.1 * (corner[flat.0] - centre[flat.0]);
                }
                corner
            })
        };
        (0..count).map(triangle).collect()
    }

    #[test]
    fn the_tree_finds_what_all_triangles_say() {
        for count in [1, 7, 8, 9, 64, 65, 700] {
            let triangles = soup(count, count as u64);
            let (tree, order) = Tree::new(&triangles);
            let mut seen = order.clone();
            seen.sort_unstable();
            assert!(seen.into_iter().eq(0..count as u32));
            let mut rng = Rng::at(9, Draw::Probe, &[]);
            let mut odd = 0;
            for probe in 0..500 {
                let mut point = [0; 3].map(|_: i32| 1.4 * rng.unit() as f32 - 0.2);
                if probe % 4 == 0 {
                    point = triangles[probe % count][probe % 3];
                }
                let crossed: i32 = triangles.iter().map(|triangle| crossing(point, triangle)).sum();
                assert_eq!(tree.crossings(point), crossed);
                odd += crossed.rem_euclid(2);

                let around = [point, point.map(|x| x + 0.2 * rng.unit() as f32)];
                let touches = |triangle: &[[f32; 3]; 3]| {
                    let [low, high] = hull(triangle);
                    (0..3).all(|k| low[k] <= around[1][k] && around[0][k] <= high[k])
                };
                let mut near = Vec::new();
                tree.for_each_near(around, |triangle| near.push(order[triangle]));
                near.sort_unstable();
                assert!((0..count as u32).filter(|&t| touches(&triangles[t as usize])).eq(near));
            }
            assert!(count < 64 || odd > 50, "{odd}");
        }
    }
}
