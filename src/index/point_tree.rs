//! Nearest neighbours in space, for any distribution of the points (Bentley 1975, "Multidimensional binary search trees
//! used for associative searching").

use glam::DVec3;

use crate::error::Result;
use crate::job::Job;
use crate::mesh::exact;

/// Points in a binary tree without pointers: the middle point of a range divides the others along an axis.
pub struct PointTree {
    points: Vec<DVec3>,
    /// The axis along which the middle of a range divides it.
    axes: Vec<u8>,
    /// The corners of the box around all points.
    bounds: [DVec3; 2],
}

/// The largest number of points in a range that is not divided.
const LEAF: usize = 8;

/// The largest number of points in a range that one task divides further.
const TASK: usize = 1 << 13;

impl PointTree {
    /// The tree of positions as callers give them.
    pub fn of(job: &Job, positions: &[[f32; 3]]) -> Result<Self> {
        Self::new(job, positions.iter().map(|&position| exact(position)).collect())
    }

    /// Takes O(n log n).
    fn new(job: &Job, mut points: Vec<DVec3>) -> Result<Self> {
        let mut axes = vec![0; points.len()];
        let bounds = bounds(&points);
        let (mut large, mut small) = (vec![Range { points: &mut points, axes: &mut axes }], Vec::new());
        let mut rest = *job;
        while !large.is_empty() {
            let halves = rest.part(0.0, 0.2).map_each(large, Range::halves)?;
            rest = rest.part(0.2, 1.0);
            let (more, done): (_, Vec<_>) = halves.into_iter().flatten().flatten().partition(Range::is_large);
            large = more;
            small.extend(done);
        }
        rest.map_each(small, Range::divide)?;
        Ok(Self { points, axes, bounds })
    }

    /// The distance of the nearest point; infinite if there is none. Takes O(log n).
    pub fn nearest(&self, place: DVec3) -> f64 {
        self.nearest_point(place).map_or(f64::INFINITY, |point| point.distance(place))
    }

    /// The nearest point, if there is one. Takes O(log n).
    pub fn nearest_point(&self, place: DVec3) -> Option<DVec3> {
        self.search(place, -1.0).point
    }

    /// The distance of the nearest point, or None if a point is no farther than `enough`, which mostly takes much less
    /// time to find out.
    pub fn nearest_beyond(&self, place: DVec3, enough: f64) -> Option<f64> {
        let nearest = self.search(place, enough.abs() * enough);
        (nearest.squared > nearest.enough).then(|| nearest.squared.sqrt())
    }

    fn search(&self, place: DVec3, enough: f64) -> NearestPoint {
        let mut nearest = NearestPoint { squared: f64::INFINITY, point: None, enough };
        let away = place - place.clamp(self.bounds[0], self.bounds[1]);
        search(&self.points, &self.axes, place, away, &mut nearest);
        nearest
    }
}

/// The nearest point so far.
struct NearestPoint {
    squared: f64,
    point: Option<DVec3>,
    /// The squared distance of the nearest point at which the search ends, or a negative number.
    enough: f64,
}

impl NearestPoint {
    fn look_at(&mut self, point: DVec3, place: DVec3) {
        let squared = point.distance_squared(place);
        if squared < self.squared {
            *self = Self { squared, point: Some(point), ..*self };
        }
    }
}

fn bounds(points: &[DVec3]) -> [DVec3; 2] {
    [DVec3::min, DVec3::max].map(|choose| points.iter().copied().reduce(choose).unwrap_or_default())
}

/// A part of the tree under construction.
struct Range<'a> {
    points: &'a mut [DVec3],
    axes: &'a mut [u8],
}

impl<'a> Range<'a> {
    fn is_large(&self) -> bool {
        self.points.len() > TASK
    }

    /// The ranges on either side of the middle point; none if there are too few points.
    fn halves(self) -> Option<[Self; 2]> {
        let Self { points, axes } = self;
        if points.len() <= LEAF {
            return None;
        }
        let [low, high] = bounds(points);
        let axis = (high - low).max_position();
        let middle = points.len() / 2;
        points.select_nth_unstable_by(middle, |a, b| a[axis].total_cmp(&b[axis]));
        axes[middle] = axis as u8;
        let ((low, high), (low_axes, high_axes)) = (points.split_at_mut(middle), axes.split_at_mut(middle));
        Some([Self { points: low, axes: low_axes }, Self { points: &mut high[1..], axes: &mut high_axes[1..] }])
    }

    /// Divides the range to the end.
    fn divide(self) {
        self.halves().into_iter().flatten().for_each(Self::divide);
    }
}

/// Searches a range for nearer points. `away` is the distance along each axis of the place from the part of space that
/// the range fills (Arya and Mount 1993, "Algorithms for fast vector quantization"): from far away no single axis shows
/// that a part is too far.
fn search(points: &[DVec3], axes: &[u8], place: DVec3, away: DVec3, nearest: &mut NearestPoint) {
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
    if nearest.squared > nearest.enough && farther.length_squared() < nearest.squared {
        search(far.0, far.1, place, farther, nearest);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::rng::{Draw, Rng};

    #[test]
    fn the_nearest_is_that_of_a_loop_over_all_points() {
        let context = Context::new(2).unwrap();
        let cases = [(0, 0), (1, 0), (9, 0), (1000, 0), (1000, 2), (500, 3), (4 * TASK, 0), (2 * TASK, 3)];
        for (case, (count, flat)) in cases.into_iter().enumerate() {
            let mut rng = Rng::at(1, Draw::Probe, &[case as u64]);
            let mut place = || DVec3::from_array(std::array::from_fn(|axis| rng.unit() * f64::from(axis >= flat)));
            let points: Vec<_> = (0..count).map(|_| place()).collect();
            let tree = context.run(None, |job| PointTree::new(job, points.clone())).unwrap();
            for probe in (0..100).map(|_| 3.0 * place() - 1.0) {
                let expected = points.iter().map(|point| point.distance(probe)).fold(f64::INFINITY, f64::min);
                assert!(tree.nearest(probe) == expected || (tree.nearest(probe) - expected).abs() < 1e-15);
                for share in [-1.0, 0.0, 0.999, 1.001, 5.0] {
                    let enough = if count > 0 { share * expected } else { share };
                    let beyond = (expected > enough).then_some(tree.nearest(probe));
                    assert_eq!(tree.nearest_beyond(probe, enough), beyond, "{count} {share}");
                }
            }
        }
    }
}
