//! The place of a mesh that is nearest to a place in space.

use glam::DVec3;

use crate::interior::tree::Tree;
use crate::math::square;

impl Tree {
    /// The place of the triangles that is nearest to another place, and the square of its distance, if that is less than that of
    /// `within`. The distance is right to 1e-7 of the size of the triangle. About O(log n).
    pub fn nearest(&self, place: [f64; 3], within: f64) -> Option<([f64; 3], f64)> {
        let (mut least, mut found) = (square(within), None);
        self.for_each_nearest(place, least, |triangle| {
            let corners = self.corners[triangle].map(|corner| DVec3::from_array(corner.map(f64::from)));
            let foot = foot(place.into(), corners);
            let squared = foot.distance_squared(place.into());
            if squared < least {
                (least, found) = (squared, Some(foot.to_array()));
            }
            least
        });
        found.map(|foot| (foot, least))
    }
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
}
