//! Sample elimination (Yuksel 2015, "Sample elimination for generating Poisson disk sample sets"), with the weights and
//! their limits of the paper.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use azulejo::{Boundary, Domain};

/// Exponents and factor of the paper.
const ALPHA: f64 = 8.0;
const BETA: f64 = 0.65;
const GAMMA: f64 = 1.5;

/// A sample with its weight when it was put on the heap: what has changed since is put there again.
struct Entry {
    weight: f64,
    index: usize,
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        self.weight.total_cmp(&other.weight).then(self.index.cmp(&other.index))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Entry {}

/// The samples of the unit torus that remain, in their order, when the one of the largest weight is taken out again and
/// again until there are `count`.
pub fn eliminate(samples: &[[f32; 2]], count: usize) -> Vec<[f32; 2]> {
    // Twice the paper's r_max, half of the hexagonal distance: the reach of weights.
    let reach = Domain::unit(Boundary::Periodic).hexagonal_distance(count.max(1));
    let least = reach * (1.0 - (count as f64 / samples.len().max(1) as f64).powf(GAMMA)) * BETA;
    let weight = |distance: f64| (1.0 - distance.max(least).min(reach) / reach).powf(ALPHA);
    let neighbours = neighbours(samples, reach);
    let mut weights: Vec<f64> =
        neighbours.iter().map(|near| near.iter().map(|&(_, distance)| weight(distance)).sum()).collect();
    let mut heap: BinaryHeap<_> = weights.iter().enumerate().map(|(index, &weight)| Entry { weight, index }).collect();
    let (mut is_left, mut left) = (vec![true; samples.len()], samples.len());
    while left > count
        && let Some(Entry { weight: then, index }) = heap.pop()
    {
        if !is_left[index] || weights[index] != then {
            continue;
        }
        is_left[index] = false;
        left -= 1;
        for &(other, distance) in neighbours[index].iter().filter(|&&(other, _)| is_left[other]) {
            weights[other] -= weight(distance);
            heap.push(Entry { weight: weights[other], index: other });
        }
    }
    samples.iter().zip(is_left).filter(|(_, is_left)| *is_left).map(|(&sample, _)| sample).collect()
}

/// Of each sample the others nearer than `reach`, with their distances.
fn neighbours(samples: &[[f32; 2]], reach: f64) -> Vec<Vec<(usize, f64)>> {
    let side = ((1.0 / reach) as usize).max(1);
    let cell = |x: f32| ((f64::from(x) * side as f64) as usize).min(side - 1);
    let mut cells = vec![Vec::new(); side * side];
    samples.iter().enumerate().for_each(|(index, &[x, y])| cells[cell(y) * side + cell(x)].push(index));
    // On a small torus no cell is visited twice.
    let steps = side.min(3);
    let around = |index: usize| {
        let [x, y] = samples[index];
        let places = (0..steps).flat_map(move |i| (0..steps).map(move |j| (i, j)));
        let visited = places.flat_map(|(i, j)| {
            let [row, column] = [(cell(y), i), (cell(x), j)].map(|(place, step)| (place + side - 1 + step) % side);
            &cells[row * side + column]
        });
        let distance = |other: usize| {
            let [dx, dy]: [f64; 2] = std::array::from_fn(|axis| {
                let x = f64::from(samples[other][axis]) - f64::from(samples[index][axis]);
                x - x.round()
            });
            dx.hypot(dy)
        };
        let near = visited.map(|&other| (other, distance(other)));
        near.filter(|&(other, distance)| other != index && distance < reach).collect()
    };
    (0..samples.len()).map(around).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::random;

    #[test]
    fn what_goes_is_what_the_definition_says() {
        let samples = random(150, 7);
        let (count, reach) = (60, Domain::unit(Boundary::Periodic).hexagonal_distance(60));
        let least = reach * (1.0 - (60.0f64 / 150.0).powf(1.5)) * 0.65;
        let mut left = samples.clone();
        while left.len() > count {
            let weight = |i: usize| -> f64 {
                let others = left.iter().enumerate().filter(|&(j, _)| j != i);
                let distances = others.map(|(_, other)| {
                    let [x, y] = [0, 1].map(|axis: usize| {
                        let x = (f64::from(other[axis]) - f64::from(left[i][axis])).abs();
                        x.min(1.0 - x)
                    });
                    (x * x + y * y).sqrt()
                });
                distances.filter(|&d| d < reach).map(|d| (1.0 - d.max(least) / reach).powi(8)).sum()
            };
            let heaviest = (0..left.len()).max_by(|&a, &b| weight(a).total_cmp(&weight(b))).unwrap();
            left.remove(heaviest);
        }
        assert_eq!(eliminate(&samples, count), left);
        assert_eq!(eliminate(&samples, 200), samples);
    }
}
