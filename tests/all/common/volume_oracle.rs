//! What is promised of a set of a cuboid, tested in `f64` from the returned floats.

use azulejo::{Boundary, Domain};

use super::float_spacing;

type Point = [f64; 3];

/// The shortest distance of two points; on a torus, of their images.
fn distance(domain: &Domain<3>, a: Point, b: Point) -> f64 {
    let square = |axis: usize| {
        let (d, period) = ((a[axis] - b[axis]).abs(), domain.max[axis] - domain.min[axis]);
        let d = if domain.boundary == Boundary::Periodic { d.min(period - d) } else { d };
        d * d
    };
    (square(0) + square(1) + square(2)).sqrt()
}

/// Two samples nearer than `radius`, of all pairs.
pub fn conflict(domain: &Domain<3>, radius: f64, samples: &[[f32; 3]]) -> Option<(usize, usize)> {
    let points: Vec<Point> = samples.iter().map(|sample| sample.map(f64::from)).collect();
    let is_near = |&(i, j): &(usize, usize)| distance(domain, points[i], points[j]) < radius;
    (0..points.len()).flat_map(|j| (0..j).map(move |i| (i, j))).find(is_near)
}

/// A place of the domain that is farther from all samples than `limit`, by halving boxes that no ball covers.
pub fn gap(domain: &Domain<3>, limit: f64, samples: &[[f32; 3]]) -> Option<Point> {
    let turns: &[f64] = if domain.boundary == Boundary::Periodic { &[-1.0, 0.0, 1.0] } else { &[0.0] };
    let mut balls = Vec::new();
    for sample in samples {
        for &z in turns {
            for (x, y) in turns.iter().flat_map(|&y| turns.iter().map(move |&x| (x, y))) {
                let at =
                    |axis: usize, turn: f64| f64::from(sample[axis]) + turn * (domain.max[axis] - domain.min[axis]);
                balls.push([at(0, x), at(1, y), at(2, z)]);
            }
        }
    }
    gap_in(domain.min, domain.max, limit, &balls, float_spacing(domain) / 16.0)
}

/// Boxes whose sides are all below `finest` are given up.
fn gap_in(min: Point, max: Point, limit: f64, balls: &[Point], finest: f64) -> Option<Point> {
    let length = |vector: Point| vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    let middle = |axis: usize| 0.5 * (min[axis] + max[axis]);
    let farthest = |ball: &Point| [0, 1, 2].map(|k: usize| (ball[k] - min[k]).abs().max((ball[k] - max[k]).abs()));
    if balls.iter().any(|ball| length(farthest(ball)) <= limit) {
        return None;
    }
    let centre = [middle(0), middle(1), middle(2)];
    if balls.iter().all(|ball| length([0, 1, 2].map(|k: usize| ball[k] - centre[k])) > limit) {
        return Some(centre);
    }
    let nearest = |ball: &Point| [0, 1, 2].map(|k: usize| ball[k] - ball[k].clamp(min[k], max[k]));
    let near: Vec<Point> = balls.iter().copied().filter(|ball| length(nearest(ball)) <= limit).collect();
    let axis = (0..3).max_by(|&a, &b| (max[a] - min[a]).total_cmp(&(max[b] - min[b]))).unwrap();
    if max[axis] - min[axis] < finest {
        return None;
    }
    let (mut lower, mut upper) = (max, min);
    (lower[axis], upper[axis]) = (centre[axis], centre[axis]);
    gap_in(min, lower, limit, &near, finest).or_else(|| gap_in(upper, max, limit, &near, finest))
}

/// Everything that is promised of a set: its range, no conflict, no gap.
pub fn check(domain: &Domain<3>, radius: f64, samples: &[[f32; 3]]) {
    let is_inside =
        |sample: &[f32; 3]| (0..3).all(|axis| (domain.min[axis]..domain.max[axis]).contains(&f64::from(sample[axis])));
    assert!(samples.iter().all(is_inside), "a sample outside of {domain:?}");
    assert_eq!(conflict(domain, radius, samples), None, "conflict: {domain:?}, radius {radius}");
    let gap = gap(domain, radius + 3.5 * float_spacing(domain), samples);
    assert_eq!(gap, None, "gap: {domain:?}, radius {radius}");
}
