//! The place of a mesh that is nearest to a place in space.

use glam::DVec3;

use crate::interior::tree::Tree;
use crate::math::square;

/// The share of squared distances, and of the square of a triangle's longest edge, by which bounds of distances are too small: distances
/// are right to 1e-7 of the size of triangles.
const SLACK: f64 = 1e-6;
const JUNG_SLACK: f64 = 0.006;

impl Tree {
    /// The place of the triangles that is nearest to another place, and the square of its distance, if that is less than that of
    /// `within`. The distance is right to 1e-7 of the size of the triangle. About O(log n).
    pub fn nearest(&self, place: [f64; 3], within: f64) -> Option<([f64; 3], f64)> {
        self.nearest_triangle(place, within).map(|(foot, squared, _)| (foot, squared))
    }

    fn nearest_triangle(&self, place: [f64; 3], within: f64) -> Option<([f64; 3], f64, usize)> {
        let (mut least, mut found) = (square(within), None);
        self.for_each_nearest(place, least, |triangle| {
            let corners = self.corners[triangle].map(|corner| DVec3::from_array(corner.map(f64::from)));
            let foot = foot(place.into(), corners);
            let squared = foot.distance_squared(place.into());
            if squared < least {
                (least, found) = (squared, Some((foot.to_array(), squared, triangle)));
            }
            least
        });
        found
    }

    /// The place of the triangles as [`Tree::nearest`], and the unit normal of the triangle; 0 of one without area.
    pub fn nearest_facing(&self, place: [f64; 3], within: f64) -> Option<([f64; 3], [f64; 3])> {
        let (foot, _, triangle) = self.nearest_triangle(place, within)?;
        let [a, b, c] = self.corners[triangle].map(|corner| DVec3::from_array(corner.map(f64::from)));
        Some((foot, (b - a).cross(c - a).normalize_or_zero().to_array()))
    }

    /// A place of the triangles and the square of its distance from another place, if that is at most the square of `far`: the
    /// nearest, or the first one found whose square is at most that of `near`.
    ///
    /// The square is, to the bit, that of a search in all triangles: each place is moved into the box around its triangle, so that
    /// it is no nearer, in `f64`, than the boxes by which the tree leaves triangles out, and its square is at least the bound by which
    /// the corners do.
    pub fn nearest_in_band(&self, place: [f64; 3], [near, far]: [f64; 2]) -> Option<([f64; 3], f64)> {
        let enough = if near < 0.0 { -1.0 } else { square(near) };
        let (mut least, mut found) = (square(far), None);
        self.for_each_nearest(place, least, |triangle| {
            if let Some((foot, squared)) = boxed_foot(place, &self.corners[triangle], least)
                && squared <= least
            {
                (least, found) = (squared, Some((foot, squared)));
            }
            // Below any square: no box is visited any more.
            if found.is_some() && least <= enough { -1.0 } else { least }
        });
        found
    }
}

/// The place of a triangle that is nearest to another, moved into the box around the triangle, and the square of its distance, or its
/// lower bound by the corners if that is more. None if the bound is more than `within`.
fn boxed_foot(place: [f64; 3], &[a, b, c]: &[[f32; 3]; 3], within: f64) -> Option<([f64; 3], f64)> {
    let (place, [a, b, c]) = (DVec3::from_array(place), [vector(a), vector(b), vector(c)]);
    let bound = least_by_corners(place, [a, b, c]);
    if bound > within {
        return None;
    }
    let foot = foot(place, [a, b, c]).clamp(a.min(b).min(c), a.max(b).max(c));
    Some((foot.to_array(), foot.distance_squared(place).max(bound)))
}

/// A lower bound of the squared distance of a place x from a triangle: that from its nearest corner, less the square of the radius R of
/// the least circle around it. For |x - y|² is at least |x - m|² - 2 (x - m)·(y - m) for the circle's centre m, which is linear in y
/// and so least at a corner v, where it is |x - v|² - |v - m|². By Jung's theorem R² is at most a third of the square of the
/// longest edge. From afar, where boxes of triangles that are tilted leave in all within some sizes of the foot, this leaves in a few.
#[inline(always)]
fn least_by_corners(place: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
    let nearest = place.distance_squared(a).min(place.distance_squared(b)).min(place.distance_squared(c));
    // Less than both by more than the error of feet.
    (1.0 - SLACK) * nearest - (1.0 / 3.0 + JUNG_SLACK) * longest
}

#[inline(always)]
fn vector([x, y, z]: [f32; 3]) -> DVec3 {
    DVec3::new(x.into(), y.into(), z.into())
}

/// The place of a triangle that is nearest to another: the foot of the perpendicular, if that is in the triangle, else the nearest
/// place of an edge. Edges are tested in any case, so that triangles that are no more than a line, whose plane is no use, are right
/// too.
fn foot(place: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let on_edge = |from: DVec3, to: DVec3| {
        let edge = to - from;
        let length = edge.length_squared();
        let share = if length > 0.0 { (edge.dot(place - from) / length).clamp(0.0, 1.0) } else { 0.0 };
        from + share * edge
    };
    let edges = [on_edge(a, b), on_edge(b, c), on_edge(c, a)];
    let nearest = edges.into_iter().fold(a, |nearest, foot| {
        if place.distance_squared(foot) < place.distance_squared(nearest) { foot } else { nearest }
    });
    let normal = (b - a).cross(c - a);
    let is_left = |from: DVec3, to: DVec3| (to - from).cross(place - from).dot(normal) >= 0.0;
    let length = normal.length_squared();
    if length > 0.0 && is_left(a, b) && is_left(b, c) && is_left(c, a) {
        let below = place - (place - a).dot(normal) / length * normal;
        if place.distance_squared(below) < place.distance_squared(nearest) {
            return below;
        }
    }
    nearest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interior::tree::tests::soup;
    use crate::rng::{Draw, Rng};

    /// The least distance of a triangle's places on a grid of them, which then shrinks around the least.
    fn searched(place: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
        let at = |u: f64, v: f64| a + u * (b - a) + v * (c - a);
        let (mut best, mut size) = ((0.3, 0.3), 1.0);
        while size > 1e-7 {
            let mut nearest = (f64::INFINITY, best);
            for (i, j) in (-4..=4).flat_map(|i| (-4..=4).map(move |j| (f64::from(i), f64::from(j)))) {
                let u = (best.0 + 0.25 * size * i).clamp(0.0, 1.0);
                let v = (best.1 + 0.25 * size * j).clamp(0.0, 1.0 - u);
                let squared = place.distance_squared(at(u, v));
                nearest = if squared < nearest.0 { (squared, (u, v)) } else { nearest };
            }
            (best, size) = (nearest.1, 0.8 * size);
        }
        place.distance(at(best.0, best.1))
    }

    #[test]
    fn the_nearest_place_is_that_of_a_search_in_all_triangles() {
        for count in [1, 8, 9, 70] {
            let triangles = soup(count, count as u64);
            let (tree, _) = Tree::new(&triangles);
            let mut rng = Rng::at(4, Draw::Probe, &[]);
            for probe in 0..60 {
                let mut place = [0; 3].map(|_: i32| 1.4 * rng.unit() - 0.2);
                if probe % 5 == 0 {
                    place = triangles[probe % count][probe % 3].map(f64::from);
                }
                let vector = |corner: [f32; 3]| DVec3::from_array(corner.map(f64::from));
                let all = triangles.iter().map(|t| searched(place.into(), t.map(vector)));
                let least = all.fold(f64::INFINITY, f64::min);
                let (foot, squared) = tree.nearest(place, 3.0).unwrap();
                assert!((squared.sqrt() - least).abs() < 1e-5, "{count} {probe}: {} {least}", squared.sqrt());
                assert_eq!(DVec3::from_array(place).distance_squared(foot.into()), squared);
                assert_eq!(tree.nearest(place, least + 1e-4), Some((foot, squared)));
                assert!(least < 1e-4 || tree.nearest(place, least - 1e-4).is_none());
            }
        }
    }

    #[test]
    fn a_band_is_that_of_all_triangles_to_the_bit() {
        for count in [1, 9, 70, 600] {
            let triangles = soup(count, count as u64);
            let (tree, _) = Tree::new(&triangles);
            let mut rng = Rng::at(5, Draw::Probe, &[]);
            let mut seen = [0; 3];
            for probe in 0..400 {
                let mut place = [0; 3].map(|_: i32| 1.4 * rng.unit() - 0.2);
                if probe % 5 == 0 {
                    place = triangles[probe % count][probe % 3].map(f64::from);
                }
                let least = triangles
                    .iter()
                    .map(|t| boxed_foot(place, t, f64::INFINITY).unwrap().1)
                    .fold(f64::INFINITY, f64::min);
                // A distance that is met exactly is not beyond.
                let exact = least.sqrt();
                let exact = if square(exact) < least { exact.next_up() } else { exact };
                let found = |near: f64, far: f64| tree.nearest_in_band(place, [near, far]).map(|(_, squared)| squared);
                assert_eq!(found(-1.0, exact), Some(least));
                assert!(found(exact, exact).is_some_and(|squared| squared <= square(exact)));
                let below = exact.next_down();
                assert!(exact == 0.0 || found(below, below).is_some() == (square(below) >= least));
                let [near, far] = [0.1 * rng.unit(), 0.1 + 0.2 * rng.unit()];
                let number = match found(near, far) {
                    None => {
                        assert!(least > square(far));
                        0
                    }
                    Some(squared) if squared <= square(near) => {
                        assert!(least <= squared);
                        1
                    }
                    Some(squared) => {
                        assert_eq!(squared, least);
                        2
                    }
                };
                seen[number] += 1;
            }
            assert!(count != 9 || seen.iter().all(|&count| count > 10), "{seen:?}");
        }
    }

    #[test]
    fn corners_bound_the_distance_from_below() {
        let (triangles, mut rng, mut close) = (soup(600, 3), Rng::at(6, Draw::Probe, &[]), 0);
        for triangle in &triangles {
            let corners = triangle.map(vector);
            let longest = (0..3).map(|k| corners[k].distance_squared(corners[(k + 1) % 3])).fold(0.0, f64::max);
            for far in [0.0, 0.01, 0.1, 1.0, 30.0] {
                let shares = [rng.unit(), rng.unit()].map(f64::sqrt);
                let at = corners[0].lerp(corners[1].lerp(corners[2], shares[1]), shares[0]);
                let place = at + far * DVec3::from_array([0; 3].map(|_: i32| 2.0 * rng.unit() - 1.0));
                let (bound, squared) = (least_by_corners(place, corners), searched(place, corners).powi(2));
                assert!(bound <= squared, "{far}: {bound} {squared}");
                close += usize::from(far >= 1.0 && squared - bound < longest);
                let boxed = boxed_foot(place.to_array(), triangle, f64::INFINITY).unwrap();
                assert_eq!(boxed.1, boxed_foot(place.to_array(), triangle, boxed.1).unwrap().1);
            }
        }
        assert!(close > 300, "{close}");
    }
}
