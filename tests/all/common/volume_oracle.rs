//! The promises of a set of a cuboid, tested in `f64` from the returned floats.

use azulejo::{Boundary, Domain};

use super::float_spacing;

type Point = [f64; 3];

/// A ball by its centre and radius.
type Ball = (Point, f64);

/// Cuboids with all that makes arithmetic hard, with radii for some hundred samples.
pub const HARD_CUBOIDS: [(Point, Point, f64); 10] = [
    ([0.0; 3], [1.0; 3], 0.1),
    ([-0.37, 0.11, -2.0], [1.91, 1.0 / 3.0, -1.1], 0.12),
    ([1e5, -3e4, 0.3], [1e5 + 12.5, -3e4 + 9.9, 5.0], 1.0),
    // Some hundred floats wide: the radius is hardly above 64 of them.
    ([1.0; 3], [1.00005, 1.00004, 1.00003], 64.2 / (1 << 23) as f64),
    ([1.0; 3], [1.0000107; 3], 89.0 / (1 << 23) as f64),
    ([-1e37, 1e36, 0.0], [1e38, 2e38, 1.5e38], 2e37),
    ([-1e-30; 3], [3.3e-30, 2e-30, 0.0], 4e-31),
    // Wider than a block on one axis, on two and on three.
    ([0.0; 3], [10.0, 0.1, 0.3], 0.25),
    ([0.0; 3], [2.5, 2.5, 0.1], 0.1),
    ([0.0, 0.5, -1.0], [1.0, 1.45, 0.1], 0.049),
];

/// The shortest distance of two points, which may lie anywhere; on a torus, of their images.
pub fn distance(domain: &Domain<3>, a: Point, b: Point) -> f64 {
    let square = |axis: usize| {
        let (d, period) = ((a[axis] - b[axis]).abs(), domain.max[axis] - domain.min[axis]);
        let d = match domain.boundary {
            Boundary::Bounded => d,
            Boundary::Periodic if d <= period => d.min(period - d),
            Boundary::Periodic => (d - period * (d / period).round()).abs(),
        };
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

/// A sample that lies nearer to a ball's centre than its radius, and the number of the ball. Distances are computed with an
/// error of their own where periods are rounded.
pub fn sample_in_ball(domain: &Domain<3>, samples: &[[f32; 3]], balls: &[Ball]) -> Option<([f32; 3], usize)> {
    let is_in = |sample: [f32; 3], (centre, radius): Ball| {
        distance(domain, sample.map(f64::from), centre) < radius * (1.0 - 1e-15)
    };
    let all = samples.iter().flat_map(|&sample| (0..balls.len()).map(move |ball| (sample, ball)));
    all.into_iter().find(|&(sample, ball)| is_in(sample, balls[ball]))
}

/// A place of the domain that is farther from all samples than `limit`, by halving boxes that no ball covers.
pub fn gap(domain: &Domain<3>, limit: f64, samples: &[[f32; 3]]) -> Option<Point> {
    let balls: Vec<_> = samples.iter().map(|sample| (sample.map(f64::from), limit)).collect();
    gap_between(domain, &balls)
}

/// A place of the domain that lies in no ball. Balls may lie anywhere; on a torus they wrap.
pub fn gap_between(domain: &Domain<3>, balls: &[Ball]) -> Option<Point> {
    let turns: &[f64] = if domain.boundary == Boundary::Periodic { &[-1.0, 0.0, 1.0] } else { &[0.0] };
    let mut images = Vec::new();
    for &(centre, radius) in balls {
        let at = |axis: usize, turn: f64| {
            let (min, period) = (domain.min[axis], domain.max[axis] - domain.min[axis]);
            let is_outside = centre[axis] < min || centre[axis] >= domain.max[axis];
            let wraps = domain.boundary == Boundary::Periodic && is_outside;
            let turn = if wraps { turn - ((centre[axis] - min) / period).floor() } else { turn };
            centre[axis] + turn * period
        };
        for &z in turns {
            for (x, y) in turns.iter().flat_map(|&y| turns.iter().map(move |&x| (x, y))) {
                images.push(([at(0, x), at(1, y), at(2, z)], radius));
            }
        }
    }
    gap_in(domain.min, domain.max, &images, float_spacing(domain) / 16.0)
}

/// Boxes whose sides are all below `finest` are given up.
fn gap_in(min: Point, max: Point, balls: &[Ball], finest: f64) -> Option<Point> {
    let length = |vector: Point| vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    let middle = |axis: usize| 0.5 * (min[axis] + max[axis]);
    let farthest = |ball: &Point| [0, 1, 2].map(|k: usize| (ball[k] - min[k]).abs().max((ball[k] - max[k]).abs()));
    if balls.iter().any(|(ball, limit)| length(farthest(ball)) <= *limit) {
        return None;
    }
    let centre = [middle(0), middle(1), middle(2)];
    if balls.iter().all(|(ball, limit)| length([0, 1, 2].map(|k: usize| ball[k] - centre[k])) > *limit) {
        return Some(centre);
    }
    let nearest = |ball: &Point| [0, 1, 2].map(|k: usize| ball[k] - ball[k].clamp(min[k], max[k]));
    let near: Vec<Ball> = balls.iter().copied().filter(|(ball, limit)| length(nearest(ball)) <= *limit).collect();
    let axis = (0..3).max_by(|&a, &b| (max[a] - min[a]).total_cmp(&(max[b] - min[b]))).unwrap();
    if max[axis] - min[axis] < finest {
        return None;
    }
    let (mut lower, mut upper) = (max, min);
    (lower[axis], upper[axis]) = (centre[axis], centre[axis]);
    gap_in(min, lower, &near, finest).or_else(|| gap_in(upper, max, &near, finest))
}

/// Everything that is promised of a set around given samples with clearances: its range, no conflict, no gap.
pub fn check_around(domain: &Domain<3>, radius: f64, given: &[([f32; 3], f64)], samples: &[[f32; 3]]) {
    let mut balls: Vec<Ball> = given.iter().map(|&(centre, clearance)| (centre.map(f64::from), clearance)).collect();
    balls.retain(|&(_, clearance)| clearance > 0.0);
    check_range_and_conflicts(domain, radius, samples);
    assert_eq!(sample_in_ball(domain, samples, &balls), None, "clearance: {domain:?}, radius {radius}");
    balls.extend(samples.iter().map(|sample| (sample.map(f64::from), radius)));
    let tolerance = 7.0 * float_spacing(domain);
    balls.iter_mut().for_each(|(_, radius)| *radius += tolerance);
    assert_eq!(gap_between(domain, &balls), None, "gap: {domain:?}, radius {radius}");
}

/// Everything that is promised of a set: its range, no conflict, no gap.
pub fn check(domain: &Domain<3>, radius: f64, samples: &[[f32; 3]]) {
    check_range_and_conflicts(domain, radius, samples);
    let gap = gap(domain, radius + 3.5 * float_spacing(domain), samples);
    assert_eq!(gap, None, "gap: {domain:?}, radius {radius}");
}

fn check_range_and_conflicts(domain: &Domain<3>, radius: f64, samples: &[[f32; 3]]) {
    let is_inside =
        |sample: &[f32; 3]| (0..3).all(|axis| (domain.min[axis]..domain.max[axis]).contains(&f64::from(sample[axis])));
    assert!(samples.iter().all(is_inside), "a sample outside of {domain:?}");
    assert_eq!(conflict(domain, radius, samples), None, "conflict: {domain:?}, radius {radius}");
}
