//! Point sets to start from, made without the library.

use azulejo::{Boundary, Domain};

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

/// The distance of two points, around the torus on a periodic domain: the shortest way over nine images.
pub fn distance(domain: &Domain, a: [f32; 2], b: [f32; 2]) -> f64 {
    let turns: &[f64] = match domain.boundary {
        Boundary::Periodic => &[-1.0, 0.0, 1.0],
        Boundary::Bounded => &[0.0],
    };
    let along = |axis: usize| {
        let period = domain.max[axis] - domain.min[axis];
        let ways = turns.iter().map(|turn| (f64::from(b[axis]) - f64::from(a[axis]) + turn * period).abs());
        ways.fold(f64::INFINITY, f64::min)
    };
    along(0).hypot(along(1))
}

/// The distance of each point to its nearest neighbour, over all pairs.
pub fn nearest_distances(domain: &Domain, points: &[[f32; 2]]) -> Vec<f64> {
    let nearest = |i: usize| {
        let others = (0..points.len()).filter(|&j| j != i);
        others.map(|j| distance(domain, points[i], points[j])).fold(f64::INFINITY, f64::min)
    };
    (0..points.len()).map(nearest).collect()
}
