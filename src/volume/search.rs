//! The exact end of a fill: a lattice point that no ball covers, by halving a box of integers.

use crate::plane::{Disk, Rect};

/// A ball by its centre, a lattice point.
pub type Centre = [i32; 3];

/// The squared distance of two lattice points. Coordinates differ by less than 2^30.
pub fn square(a: Centre, b: Centre) -> i64 {
    let along = |axis: usize| i64::from(a[axis]) - i64::from(b[axis]);
    (0..3).map(|axis| along(axis) * along(axis)).sum()
}

/// True if a ball covers any lattice point of a box that is not empty.
pub fn touches(points: &Rect<3>, ball: Centre, threshold: i64) -> bool {
    let nearest = std::array::from_fn(|axis| ball[axis].clamp(points.min[axis], points.max[axis] - 1));
    square(ball, nearest) < threshold
}

/// True if a ball covers all lattice points of a box.
fn covers(points: &Rect<3>, ball: Centre, threshold: i64) -> bool {
    let farthest = std::array::from_fn(|axis| {
        let (first, last) = (points.min[axis], points.max[axis] - 1);
        if i64::from(ball[axis]) - i64::from(first) > i64::from(last) - i64::from(ball[axis]) { first } else { last }
    });
    square(ball, farthest) < threshold
}

/// A lattice point of a box whose squared distance from all balls is at least the threshold and that lies in no given ball,
/// if there is one.
pub fn open_point(points: &Rect<3>, balls: &[Centre], threshold: i64, given: &[Disk<3>]) -> Option<Centre> {
    let is_covered =
        || balls.iter().any(|&ball| covers(points, ball, threshold)) || given.iter().any(|ball| ball.covers(points));
    if points.is_empty() || is_covered() {
        return None;
    }
    let touching: Vec<_> = balls.iter().copied().filter(|&ball| touches(points, ball, threshold)).collect();
    let given: Vec<_> = given.iter().copied().filter(|ball| ball.meets(points)).collect();
    if touching.is_empty() && given.is_empty() {
        return Some(points.min);
    }
    // A box of one point is covered by every ball that touches it: there are two points at least.
    let axis = (0..3).max_by_key(|&axis| points.length(axis))?;
    let middle = points.min[axis] + points.length(axis) / 2;
    let mut halves = [*points; 2];
    (halves[0].max[axis], halves[1].min[axis]) = (middle, middle);
    halves.iter().find_map(|half| open_point(half, &touching, threshold, &given))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    /// All points of a box.
    fn all(points: &Rect<3>) -> Vec<Centre> {
        let mut all = Vec::new();
        for z in points.min[2]..points.max[2] {
            for y in points.min[1]..points.max[1] {
                all.extend((points.min[0]..points.max[0]).map(|x| [x, y, z]));
            }
        }
        all
    }

    #[test]
    fn a_point_is_found_if_and_only_if_there_is_one() {
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        let (mut found, mut closed) = (0, 0);
        for case in 0..400 {
            let min = [0; 3].map(|_: i32| rng.below(40) as i32 - 20);
            let max = std::array::from_fn(|axis| min[axis] + rng.below(9) as i32);
            let (points, threshold) = (Rect { min, max }, 1 + rng.below(100) as i64);
            let ball = |rng: &mut Rng| std::array::from_fn(|axis| min[axis] - 5 + rng.below(18) as i32);
            let balls: Vec<_> = (0..case % 40).map(|_| ball(&mut rng)).collect();
            let is_open = |point: &Centre| balls.iter().all(|&ball| square(ball, *point) >= threshold);
            match open_point(&points, &balls, threshold, &[]) {
                Some(point) => {
                    assert!(points.contains(point) && is_open(&point));
                    found += 1;
                }
                None => {
                    assert!(!all(&points).iter().any(is_open), "{points:?}");
                    closed += 1;
                }
            }
        }
        assert!(found > 50 && closed > 50, "{found} {closed}");
    }

    #[test]
    fn boxes_are_tested_by_their_nearest_and_farthest_points() {
        let mut rng = Rng::at(2, Draw::Probe, &[]);
        for _ in 0..300 {
            let min = [0; 3].map(|_: i32| rng.below(20) as i32 - 10);
            let max = std::array::from_fn(|axis| min[axis] + 1 + rng.below(6) as i32);
            let (points, ball) = (Rect { min, max }, [0; 3].map(|_: i32| rng.below(30) as i32 - 15));
            let squares: Vec<_> = all(&points).into_iter().map(|point| square(point, ball)).collect();
            for threshold in [1, 20, 90, 300] {
                assert_eq!(touches(&points, ball, threshold), squares.iter().any(|&square| square < threshold));
                assert_eq!(covers(&points, ball, threshold), squares.iter().all(|&square| square < threshold));
            }
        }
    }
}
