//! The farthest place of a small cuboid, exactly.
//!
//! Where all points that are nearest to some place of a cuboid are known, the largest distance from them is at a vertex: of the
//! cuboid, or where their Voronoi diagram meets its edges or faces or has a vertex of its own, since the distance from a point
//! is convex on the part of the cuboid that is nearest to it. All of these are corners of polygons: of the faces of the cuboid
//! by the part that is nearest to a point, and of the walls between two points. Rounding moves a corner along a line on which
//! the distances hardly differ, so that the result is right to some 1e-15 of the distances.

use glam::DVec3;

/// The largest distance of a place of the cuboid of this half around 0 from the nearest of `points`, if it is above `known`.
pub(super) fn farthest(half: DVec3, points: &[DVec3], known: f64) -> f64 {
    let mut farthest = known;
    for (i, &point) in points.iter().enumerate() {
        for face in faces(half) {
            let others = points.iter().enumerate().filter(|&(j, _)| j != i);
            farthest = farthest.max(of_polygon(face, point, others.map(|(_, &other)| other), farthest));
        }
        for (j, &other) in points[..i].iter().enumerate() {
            let others = points.iter().enumerate().filter(|&(k, _)| k != i && k != j);
            let wall = wall(half, point, other);
            farthest = farthest.max(of_polygon(wall, point, others.map(|(_, &other)| other), farthest));
        }
    }
    farthest
}

/// The largest distance from a point of the part of a polygon to which no other point is nearer; `known` if it is not above
/// that.
fn of_polygon(mut polygon: Vec<DVec3>, point: DVec3, others: impl Iterator<Item = DVec3>, known: f64) -> f64 {
    let largest = |polygon: &[DVec3]| polygon.iter().map(|corner| corner.distance(point)).fold(known, f64::max);
    for other in others {
        if largest(&polygon) <= known {
            return known;
        }
        polygon = cut(&polygon, closer(point, other));
    }
    largest(&polygon)
}

/// A plane by its normal and the place along it; what is below belongs to a part.
type Plane = (DVec3, f64);

/// The places that are nearer to a point than to another.
fn closer(point: DVec3, other: DVec3) -> Plane {
    (other - point, 0.5 * (other.length_squared() - point.length_squared()))
}

/// The part of a polygon below a plane.
fn cut(polygon: &[DVec3], (normal, along): Plane) -> Vec<DVec3> {
    let height = |corner: DVec3| corner.dot(normal) - along;
    let mut below = Vec::with_capacity(polygon.len() + 1);
    for (i, &corner) in polygon.iter().enumerate() {
        let next = polygon[(i + 1) % polygon.len()];
        let [from, to] = [height(corner), height(next)];
        if from <= 0.0 {
            below.push(corner);
        }
        if (from <= 0.0) != (to <= 0.0) {
            below.push(corner + (next - corner) * (from / (from - to)));
        }
    }
    below
}

/// The faces of a cuboid around 0.
fn faces(half: DVec3) -> impl Iterator<Item = Vec<DVec3>> {
    (0..6).map(move |face| {
        let [across, u, v] = [0, 1, 2].map(|k| (face / 2 + k) % 3);
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[a, b]| {
            let mut corner = half;
            corner[across] *= if face % 2 == 0 { -1.0 } else { 1.0 };
            corner[u] *= a;
            corner[v] *= b;
            corner
        });
        corners.to_vec()
    })
}

/// The places of a cuboid around 0 that are as far from one point as from another: none for two points at one place, which
/// have no wall between them.
fn wall(half: DVec3, point: DVec3, other: DVec3) -> Vec<DVec3> {
    let (normal, along) = closer(point, other);
    let length = normal.length();
    if length == 0.0 || (along / length).abs() > half.length() {
        return Vec::new();
    }
    let (normal, along) = (normal / length, along / length);
    let (u, v) = normal.any_orthonormal_pair();
    let reach = 2.0 * half.length();
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let mut wall: Vec<_> = corners.iter().map(|&[a, b]| normal * along + (u * a + v * b) * reach).collect();
    for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
        wall = cut(&cut(&wall, (axis, axis.dot(half))), (-axis, axis.dot(half)));
    }
    wall
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    /// Against places of a fine grid, which cannot be farther, and hardly nearer; also for points on a sphere around a corner
    /// of the cuboid or its middle, and for points at one place.
    #[test]
    fn no_place_of_a_grid_is_farther() {
        const STEPS: usize = 24;
        for case in 0..200u64 {
            let mut rng = Rng::at(case, Draw::Probe, &[]);
            let mut vector = |scale: f64| DVec3::from_array(std::array::from_fn(|_| scale * (2.0 * rng.unit() - 1.0)));
            let half = vector(0.4).abs() + 0.1;
            let mut points: Vec<DVec3> = (0..1 + case as usize % 12).map(|_| vector(1.5)).collect();
            match case % 4 {
                0 => points.iter_mut().for_each(|point| *point = point.normalize()),
                1 => points.iter_mut().for_each(|point| *point = half + point.normalize()),
                2 => points.push(points[0]),
                _ => {}
            }
            let distance =
                |place: DVec3| points.iter().map(|point| point.distance(place)).fold(f64::INFINITY, f64::min);
            let at = |i: usize| 2.0 * (i as f64 / STEPS as f64) - 1.0;
            let side = STEPS + 1;
            let places = (0..side * side * side)
                .map(|i| half * DVec3::new(at(i % side), at(i / side % side), at(i / side / side)));
            let expected = places.map(distance).fold(0.0, f64::max);
            let found = farthest(half, &points, 0.0);
            let step = half.length() / STEPS as f64;
            assert!((expected - 1e-12..=expected + step).contains(&found), "{case}: {found}, not {expected}");
            assert_eq!(farthest(half, &points, found + 1e-3), found + 1e-3);
        }
    }
}
