//! Nearest neighbours in space, however the points are spread (Bentley 1975, "Multidimensional binary search trees used for
//! associative searching").

use glam::DVec3;

use crate::mesh::exact;

/// Points in a binary tree without pointers: the middle one of a range divides the others along an axis.
pub(super) struct Tree {
    points: Vec<DVec3>,
    /// The axis along which the middle of a range divides it.
    axes: Vec<u8>,
    /// The corners of the box around all points.
    bounds: [DVec3; 2],
}

/// Ranges of no more points are not divided.
const LEAF: usize = 8;

impl Tree {
    /// The tree of positions as they are given by callers.
    pub fn of(positions: &[[f32; 3]]) -> Self {
        Self::new(positions.iter().map(|&position| exact(position)).collect())
    }

    /// Takes O(n log n).
    fn new(mut points: Vec<DVec3>) -> Self {
        let mut axes = vec![0; points.len()];
        let bounds = bounds(&points);
        divide(&mut points, &mut axes);
        Self { points, axes, bounds }
    }

    /// The distance of the nearest point; infinite if there is none. Takes O(log n).
    pub fn nearest(&self, place: DVec3) -> f64 {
        self.nearest_point(place).map_or(f64::INFINITY, |point| point.distance(place))
    }

    /// The nearest point, if there is one. Takes O(log n).
    pub fn nearest_point(&self, place: DVec3) -> Option<DVec3> {
        let mut nearest = Found { squared: f64::INFINITY, point: None };
        let away = place - place.clamp(self.bounds[0], self.bounds[1]);
        search(&self.points, &self.axes, place, away, &mut nearest);
        nearest.point
    }
}

/// The nearest point so far.
struct Found {
    squared: f64,
    point: Option<DVec3>,
}

impl Found {
    fn look_at(&mut self, point: DVec3, place: DVec3) {
        let squared = point.distance_squared(place);
        if squared < self.squared {
            *self = Self { squared, point: Some(point) };
        }
    }
}

fn bounds(points: &[DVec3]) -> [DVec3; 2] {
    [DVec3::min, DVec3::max].map(|choose| points.iter().copied().reduce(choose).unwrap_or_default())
}

fn divide(points: &mut [DVec3], axes: &mut [u8]) {
    if points.len() <= LEAF {
        return;
    }
    let [low, high] = bounds(points);
    let axis = (high - low).max_position();
    let middle = points.len() / 2;
    points.select_nth_unstable_by(middle, |a, b| a[axis].total_cmp(&b[axis]));
    axes[middle] = axis as u8;
    divide(&mut points[..middle], &mut axes[..middle]);
    divide(&mut points[middle + 1..], &mut axes[middle + 1..]);
}

/// Looks at what may be nearer in a range. `away` is how far along each axis the place is
/// from the part of space that the range fills (Arya and Mount 1993, "Algorithms for fast vector quantization"): from far
/// away no axis alone tells that a part is too far.
fn search(points: &[DVec3], axes: &[u8], place: DVec3, away: DVec3, nearest: &mut Found) {
    if points.len() <= LEAF {
        points.iter().for_each(|&point| nearest.look_at(point, place));
        return;
    }
    let middle = points.len() / 2;
    let axis = usize::from(axes[middle]);
    let beyond = place[axis] - points[middle][axis];
    let [low, high] = [0..middle, middle + 1..points.len()].map(|range| (&points[range.clone()], &axes[range]));
    let [near, far] = if beyond < 0.0 { [low, high] } else { [high, low] };
    nearest.look_at(points[middle], place);
    search(near.0, near.1, place, away, nearest);
    let mut farther = away;
    farther[axis] = beyond;
    if farther.length_squared() < nearest.squared {
        search(far.0, far.1, place, farther, nearest);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    #[test]
    fn the_nearest_is_that_of_a_loop_over_all_points() {
        for (case, (count, flat)) in [(0, 0), (1, 0), (9, 0), (1000, 0), (1000, 2), (500, 3)].into_iter().enumerate() {
            let mut rng = Rng::at(1, Draw::Probe, &[case as u64]);
            let mut place = || DVec3::from_array(std::array::from_fn(|axis| rng.unit() * f64::from(axis >= flat)));
            let points: Vec<_> = (0..count).map(|_| place()).collect();
            let tree = Tree::new(points.clone());
            for probe in (0..100).map(|_| 3.0 * place() - 1.0) {
                let expected = points.iter().map(|point| point.distance(probe)).fold(f64::INFINITY, f64::min);
                assert!(tree.nearest(probe) == expected || (tree.nearest(probe) - expected).abs() < 1e-15);
            }
        }
    }
}
