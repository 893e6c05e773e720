//! Pieces and fixed points to merge.

use azulejo::kdrt::{self, Options};
use azulejo::{Boundary, Context, Domain};

use crate::common::random::Random;
use crate::common::{check, distance, domain};

/// A piece that owns its samples.
#[derive(Clone, Debug)]
pub struct Part {
    pub samples: Vec<[f32; 2]>,
    pub rectangle: Domain,
}

/// A maximal set of a rectangle with a boundary.
pub fn part(min: [f64; 2], max: [f64; 2], radius: f64, seed: u64) -> Part {
    let rectangle = domain(min, max, Boundary::Bounded);
    let options = Options::new(radius).domain(rectangle).leaf_size(6.0).seed(seed);
    let samples = kdrt::sample(&Context::new(1).unwrap(), &options, None).unwrap().positions;
    check(&rectangle, radius, &samples);
    Part { samples, rectangle }
}

/// The rectangles between given shares of the domain's extent, each with a set of its own.
pub fn parts(domain: &Domain, radius: f64, shares: &[[[f64; 2]; 2]], seed: u64) -> Vec<Part> {
    let corner = |share: [f64; 2]| {
        [0, 1].map(|axis: usize| match share[axis] {
            1.0 => domain.max[axis],
            share => domain.min[axis] + share * domain.extent()[axis],
        })
    };
    let part =
        |(i, [min, max]): (usize, &[[f64; 2]; 2])| part(corner(*min), corner(*max), radius, 1000 * seed + i as u64);
    shares.iter().enumerate().map(part).collect()
}

/// Columns and rows of rectangles of the same size.
pub fn tiles(columns: usize, rows: usize) -> Vec<[[f64; 2]; 2]> {
    let share = |i: usize, of: usize| i as f64 / of as f64;
    let tile = |x, y| [[share(x, columns), share(y, rows)], [share(x + 1, columns), share(y + 1, rows)]];
    (0..rows).flat_map(|y| (0..columns).map(move |x| tile(x, y))).collect()
}

/// Four rectangles around a fifth: every corner of the inner one is a T-junction.
pub const PINWHEEL: [[[f64; 2]; 2]; 5] = [
    [[0.0, 0.0], [0.7, 0.3]],
    [[0.7, 0.0], [1.0, 0.7]],
    [[0.3, 0.7], [1.0, 1.0]],
    [[0.0, 0.3], [0.3, 1.0]],
    [[0.3, 0.3], [0.7, 0.7]],
];

/// Two rectangles, a hole in the shape of a cross and more.
pub const HOLES: [[[f64; 2]; 2]; 2] = [[[0.0, 0.0], [0.45, 0.4]], [[0.5, 0.55], [0.9, 1.0]]];

/// Points of the outline of a polygon without acute corners, a bit more than `radius` apart.
pub fn outline(corners: &[[f64; 2]], radius: f64) -> Vec<[f32; 2]> {
    let mut points: Vec<[f32; 2]> = Vec::new();
    for (i, from) in corners.iter().enumerate() {
        let to = corners[(i + 1) % corners.len()];
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let steps = (length / (1.0001 * radius)).floor();
        for step in 0..steps as usize {
            let share = step as f64 / steps;
            points.push([0, 1].map(|axis: usize| (from[axis] + share * (to[axis] - from[axis])) as f32));
        }
    }
    points
}

/// Random points, those left out that conflict with one before.
pub fn darts(domain: &Domain, radius: f64, count: usize, seed: u64) -> Vec<[f32; 2]> {
    let mut random = Random::new(seed);
    let mut points: Vec<[f32; 2]> = Vec::new();
    for _ in 0..count {
        let dart =
            [0, 1].map(|axis: usize| (domain.min[axis] + f64::from(random.unit()) * domain.extent()[axis]) as f32);
        let inside = (0..2).all(|axis| (domain.min[axis]..domain.max[axis]).contains(&f64::from(dart[axis])));
        if inside && points.iter().all(|&point| distance(domain, point, dart) >= radius) {
            points.push(dart);
        }
    }
    points
}
