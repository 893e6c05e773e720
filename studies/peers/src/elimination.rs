//! Sample elimination (Yuksel 2015, "Sample Elimination for Generating Poisson Disk Sample Sets"), written here from
//! the paper: no registry has the author's own code as a package. Points on a surface; parameters are those of the
//! paper.

use std::collections::{BinaryHeap, HashMap};

/// The exponent of weights.
const ALPHA: i32 = 8;
/// The limit of weights (section 3.3), and its dependence on the remaining share.
const BETA: f64 = 0.65;
const GAMMA: f64 = 1.5;

type Point = [f32; 3];

/// The indices of so many of the points, which lie on a surface of this area: the points that are left when the one
/// with the largest weight has been eliminated again and again.
pub fn eliminate(points: &[Point], area: f64, count: usize) -> Vec<u32> {
    let mut left: Vec<u32> = (0..points.len() as u32).collect();
    eliminated(points, area, count, &mut left);
    left
}

/// The chosen points in progressive order (section 4): half of them are eliminated, those come last, and so on.
pub fn ordered(points: &[Point], area: f64, chosen: &[u32]) -> Vec<u32> {
    let (mut left, mut reversed) = (chosen.to_vec(), Vec::with_capacity(chosen.len()));
    while left.len() > 1 {
        reversed.extend(eliminated(points, area, left.len() / 2, &mut left));
    }
    reversed.extend(left);
    reversed.reverse();
    reversed
}

/// Eliminates points until so many are left, and returns them in this order.
fn eliminated(points: &[Point], area: f64, count: usize, left: &mut Vec<u32>) -> Vec<u32> {
    // The radius of as many disks in hexagonal arrangement.
    let largest = (area / (2.0 * 3.0f64.sqrt() * count as f64)).sqrt();
    let least = largest * (1.0 - (count as f64 / left.len() as f64).powf(GAMMA)) * BETA;
    let weight = |distance: f64| (1.0 - distance.max(2.0 * least) / (2.0 * largest)).powi(ALPHA);
    let near = Near::new(left.iter().map(|&number| points[number as usize]).collect(), 2.0 * largest);
    let mut weights: Vec<f64> = (0..left.len())
        .map(|one| {
            let mut sum = 0.0;
            near.visit(one, |_, distance| sum += weight(distance));
            sum
        })
        .collect();
    // Weights only fall: what is popped with an old one goes back with the present one. They are positive, so that
    // their bits are ordered as they are.
    let mut heap: BinaryHeap<(u64, usize)> = (0..left.len()).map(|one| (weights[one].to_bits(), one)).collect();
    let (mut is_left, mut gone) = (vec![true; left.len()], Vec::with_capacity(left.len() - count));
    while gone.len() < left.len() - count {
        let (bits, one) = heap.pop().expect("more points than are eliminated");
        if bits != weights[one].to_bits() {
            heap.push((weights[one].to_bits(), one));
            continue;
        }
        is_left[one] = false;
        gone.push(left[one]);
        near.visit(one, |other, distance| weights[other] = (weights[other] - weight(distance)).max(0.0));
    }
    let mut kept = is_left.into_iter();
    left.retain(|_| kept.next().expect("one for each"));
    gone
}

/// Points by cells as wide as they are looked for.
struct Near {
    points: Vec<Point>,
    reach: f64,
    cells: HashMap<[i32; 3], Vec<u32>>,
}

impl Near {
    fn new(points: Vec<Point>, reach: f64) -> Self {
        let mut near = Self { points, reach, cells: HashMap::new() };
        for number in 0..near.points.len() {
            near.cells.entry(near.cell(number)).or_default().push(number as u32);
        }
        near
    }

    fn cell(&self, number: usize) -> [i32; 3] {
        self.points[number].map(|x| (f64::from(x) / self.reach).floor() as i32)
    }

    /// Visits all other points within reach, with their distances.
    fn visit(&self, one: usize, mut visit: impl FnMut(usize, f64)) {
        let (point, [x, y, z]) = (self.points[one], self.cell(one));
        for key in (0..27).map(|i| [x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1]) {
            for &other in self.cells.get(&key).into_iter().flatten() {
                let offset = [0, 1, 2].map(|axis| f64::from(self.points[other as usize][axis] - point[axis]));
                let distance = offset.iter().map(|x| x * x).sum::<f64>().sqrt();
                if distance < self.reach && other as usize != one {
                    visit(other as usize, distance);
                }
            }
        }
    }
}
