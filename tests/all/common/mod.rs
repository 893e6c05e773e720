//! Oracles for samples of the plane: from the definitions, on the returned floats, without any of the library's tricks.

pub mod adaptive_oracle;
pub mod buckets;
pub mod class_darts;
pub mod class_oracle;
pub mod disks;
pub mod merge_oracle;
pub mod meshes;
pub mod order_oracle;
pub mod parts;
pub mod pieces;
pub mod random;
pub mod relaxed;
pub mod sets;
pub mod surface_oracle;
pub mod tiled;
pub mod tolerance;
pub mod triangle;
pub mod volume_oracle;
pub mod windows;

use std::collections::HashMap;

use azulejo::{Boundary, Domain};
pub use disks::distance;
pub use tolerance::float_spacing;

/// Both boundaries, for loops.
pub const BOUNDARIES: [Boundary; 2] = [Boundary::Periodic, Boundary::Bounded];

/// The rectangle from `min` to `max`.
pub fn domain(min: [f64; 2], max: [f64; 2], boundary: Boundary) -> Domain {
    Domain { min, max, boundary }
}

/// Rectangles with all that makes arithmetic hard, and a length on which radii are chosen.
pub fn hard_domains(boundary: Boundary) -> Vec<Domain> {
    vec![
        domain([0.0; 2], [1.0; 2], boundary),
        domain([-0.37, 0.11], [1.91, 1.0 / 3.0], boundary),
        domain([1e5, -3e4], [1e5 + 1234.5, -3e4 + 999.9], boundary),
        domain([0.0; 2], [10.0, 0.1], boundary),
        domain([2.0, -7.0], [2.03, -4.0], boundary),
        domain([-1e-30; 2], [3.3e-30, 2e-30], boundary),
        domain([-1e37, 1e36], [1e38, 2e38], boundary),
        // About 7000 floats wide: a radius of a 109th is hardly above 64 of them.
        domain([1.0; 2], [1.000835; 2], boundary),
    ]
}

/// Everything that is promised of a sample set: its range, no conflict, no gap.
pub fn check(domain: &Domain, radius: f64, samples: &[[f32; 2]]) {
    let inside = |sample: &[f32; 2]| {
        (0..2).all(|axis| domain.min[axis] <= f64::from(sample[axis]) && f64::from(sample[axis]) < domain.max[axis])
    };
    assert!(samples.iter().all(inside), "a sample outside of {domain:?}");
    let conflict = find_conflict(domain, radius, samples);
    assert_eq!(conflict, None, "conflict: {domain:?}, radius {radius}");
    let gap = find_gap(domain, radius + 3.0 * float_spacing(domain), samples);
    assert_eq!(gap, None, "uncovered: {domain:?}, radius {radius}");
}

/// Two samples closer than `radius`, if there are any: each sample against those of the buckets around it.
pub fn find_conflict(domain: &Domain, radius: f64, samples: &[[f32; 2]]) -> Option<([f32; 2], [f32; 2])> {
    // A bucket wider than the radius: the nine around a point hold all that is in conflict.
    let bucket = |point: [f64; 2]| point.map(|x| (x / (1.01 * radius)).floor() as i64);
    let mut buckets: HashMap<[i64; 2], Vec<usize>> = HashMap::new();
    for (i, sample) in samples.iter().enumerate() {
        buckets.entry(bucket(sample.map(f64::from))).or_default().push(i);
    }
    for (i, &sample) in samples.iter().enumerate() {
        for image in images(domain, sample.map(f64::from)) {
            let [column, row] = bucket(image);
            for near in (-1..=1).flat_map(|y| (-1..=1).map(move |x| [column + x, row + y])) {
                for &j in buckets.get(&near).into_iter().flatten() {
                    if i != j && distance(domain, sample, samples[j]) < radius {
                        return Some((sample, samples[j]));
                    }
                }
            }
        }
    }
    None
}

/// A point, and on a torus its eight nearest images.
fn images(domain: &Domain, point: [f64; 2]) -> Vec<[f64; 2]> {
    match domain.boundary {
        Boundary::Bounded => vec![point],
        Boundary::Periodic => (-1..=1)
            .flat_map(|y| (-1..=1).map(move |x| [x, y]))
            .map(|turns| {
                [0, 1].map(|axis| point[axis] + f64::from(turns[axis]) * (domain.max[axis] - domain.min[axis]))
            })
            .collect(),
    }
}

/// A point of the domain farther than `radius` from all samples, if there is one.
pub fn find_gap(domain: &Domain, radius: f64, samples: &[[f32; 2]]) -> Option<[f64; 2]> {
    let samples = samples.iter().map(|&sample| (sample, radius));
    disks::find_gap(domain, samples, 0.0, float_spacing(domain) / 16.0)
}
