//! The place of a mesh that is nearest to a place in space.

use crate::interior::tree::Tree;
use crate::math::square;

type Place = [f64; 3];

fn minus(a: Place, b: Place) -> Place {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Place, b: Place) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Place, b: Place) -> Place {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `from + share * along`.
fn onward(from: Place, along: Place, share: f64) -> Place {
    [from[0] + share * along[0], from[1] + share * along[1], from[2] + share * along[2]]
}

fn distance_squared(a: Place, b: Place) -> f64 {
    let offset = minus(a, b);
    dot(offset, offset)
}

impl Tree {
    /// The place of the triangles that is nearest to another place, and the square of its distance, if that is less than that of
    /// `within`. The distance is right to 1e-7 of the size of the triangle. About O(log n).
    pub fn nearest(&self, place: Place, within: f64) -> Option<(Place, f64)> {
        let (mut least, mut found) = (square(within), None);
        self.for_each_nearest(place, least, |triangle| {
            let foot = foot(place, self.corners[triangle].map(|corner| corner.map(f64::from)));
            let squared = distance_squared(place, foot);
            if squared < least {
                (least, found) = (squared, Some(foot));
            }
            least
        });
        found.map(|foot| (foot, least))
    }
}

/// The place of a triangle that is nearest to another: the foot of the perpendicular, if that is in the triangle, else the nearest
/// place of an edge. Edges are tested in any case, so that triangles that are no more than a line, whose plane is no use, are right
/// too.
fn foot(place: Place, [a, b, c]: [Place; 3]) -> Place {
    let on_edge = |from: Place, to: Place| {
        let edge = minus(to, from);
        let length = dot(edge, edge);
        let share = if length > 0.0 { (dot(edge, minus(place, from)) / length).clamp(0.0, 1.0) } else { 0.0 };
        onward(from, edge, share)
    };
    let edges = [on_edge(a, b), on_edge(b, c), on_edge(c, a)];
    let nearest = edges.into_iter().fold(a, |nearest, foot| {
        if distance_squared(place, foot) < distance_squared(place, nearest) { foot } else { nearest }
    });
    let normal = cross(minus(b, a), minus(c, a));
    let is_left = |from: Place, to: Place| dot(cross(minus(to, from), minus(place, from)), normal) >= 0.0;
    let length = dot(normal, normal);
    if length > 0.0 && is_left(a, b) && is_left(b, c) && is_left(c, a) {
        let below = onward(place, normal, -dot(minus(place, a), normal) / length);
        if distance_squared(place, below) < distance_squared(place, nearest) {
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
    fn searched(place: Place, [a, b, c]: [Place; 3]) -> f64 {
        let at = |u: f64, v: f64| onward(onward(a, minus(b, a), u), minus(c, a), v);
        let (mut best, mut size) = ((0.3, 0.3), 1.0);
        while size > 1e-7 {
            let mut nearest = (f64::INFINITY, best);
            for (i, j) in (-4..=4).flat_map(|i| (-4..=4).map(move |j| (f64::from(i), f64::from(j)))) {
                let u = (best.0 + 0.25 * size * i).clamp(0.0, 1.0);
                let v = (best.1 + 0.25 * size * j).clamp(0.0, 1.0 - u);
                let squared = distance_squared(place, at(u, v));
                nearest = if squared < nearest.0 { (squared, (u, v)) } else { nearest };
            }
            (best, size) = (nearest.1, 0.8 * size);
        }
        distance_squared(place, at(best.0, best.1)).sqrt()
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
                let all = triangles.iter().map(|t| searched(place, t.map(|corner| corner.map(f64::from))));
                let least = all.fold(f64::INFINITY, f64::min);
                let (foot, squared) = tree.nearest(place, 3.0).unwrap();
                assert!((squared.sqrt() - least).abs() < 1e-5, "{count} {probe}: {} {least}", squared.sqrt());
                assert_eq!(distance_squared(place, foot), squared);
                assert_eq!(tree.nearest(place, least + 1e-4), Some((foot, squared)));
                assert!(least < 1e-4 || tree.nearest(place, least - 1e-4).is_none());
            }
        }
    }
}
