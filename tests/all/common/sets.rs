//! Point sets to start from, made without the library.

use azulejo::{Boundary, Domain};

pub use crate::common::disks::distance;
pub use crate::common::random::Random;

/// The unit square.
pub fn unit_square(boundary: Boundary) -> Domain {
    Domain { min: [0.0; 2], max: [1.0; 2], boundary }
}

/// Uniform random points of the unit square.
pub fn random_points(count: usize, seed: u64) -> Vec<[f32; 2]> {
    let mut random = Random::new(seed);
    (0..count).map(|_| [random.unit(), random.unit()]).collect()
}

/// About `count` points of the unit torus by dart throwing, nearly maximal: every dart against all points.
pub fn darts(count: usize, seed: u64) -> Vec<[f32; 2]> {
    let radius = (0.6966 / count as f64).sqrt();
    let domain = unit_square(Boundary::Periodic);
    let mut random = Random::new(seed);
    let mut points: Vec<[f32; 2]> = Vec::new();
    for _ in 0..200 * count {
        let dart = [random.unit(), random.unit()];
        if points.iter().all(|&point| distance(&domain, dart, point) >= radius) {
            points.push(dart);
        }
    }
    points
}

/// The distance of each point to its nearest neighbour, over all pairs.
pub fn nearest_distances(domain: &Domain, points: &[[f32; 2]]) -> Vec<f64> {
    let mut nearest = vec![f64::INFINITY; points.len()];
    for (i, j) in (0..points.len()).flat_map(|i| (0..i).map(move |j| (i, j))) {
        let distance = distance(domain, points[i], points[j]);
        nearest[i] = nearest[i].min(distance);
        nearest[j] = nearest[j].min(distance);
    }
    nearest
}
