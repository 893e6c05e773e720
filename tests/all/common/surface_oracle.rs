//! The promises of a set of samples on a mesh, checked in the plainest way: all that is used of the library are the corners of
//! triangles and the mask.

use azulejo::Points;
use azulejo::mesh::Mesh;

use crate::common::buckets::Buckets;
use crate::common::parts::parts;
use crate::common::triangle::{distance, exact, has_area, is_normal};

type Point = [f64; 3];

/// A place, and a distance up to which it covers others.
pub type Ball = (Point, f64);

fn middle(a: Point, b: Point) -> Point {
    std::array::from_fn(|axis| (a[axis] + b[axis]) / 2.0)
}

/// The first two samples found that are closer than the radius.
pub fn conflict(samples: &Points<3>, radius: f64) -> Option<(usize, usize)> {
    let buckets = Buckets::new(&samples.positions, 1.01 * radius);
    buckets.all().iter().find_map(|&(i, point)| {
        let mut near = buckets.near(&[point], radius).into_iter();
        near.find(|&(j, other)| j < i && distance(point, other) < radius).map(|(j, _)| (j, i))
    })
}

/// A point of the surface for which it could not be proved that a sample is within the radius, up to a tolerance.
pub fn gap(mesh: &Mesh, samples: &Points<3>, radius: f64, tolerance: f64) -> Option<Point> {
    let reach = radius + tolerance;
    let buckets = Buckets::new(&samples.positions, 2.0 * reach);
    (0..mesh.triangles().len() as u32).filter(|&triangle| mesh.is_sampled(triangle)).find_map(|triangle| {
        let corners = mesh.corners(triangle).map(exact);
        let near: Vec<Ball> = buckets.near(&corners, reach).into_iter().map(|(_, point)| (point, reach)).collect();
        has_area(corners).then(|| gap_in_part(corners, &near, tolerance / 100.0)).flatten()
    })
}

/// A point for which it could not be proved that it lies in a ball: a part is covered when one ball has its three corners;
/// otherwise four quarters of it must be, or two halves where it is much longer than wide.
pub fn gap_in_part(part: [Point; 3], balls: &[Ball], smallest: f64) -> Option<Point> {
    if balls.iter().any(|&(centre, reach)| part.iter().all(|&corner| distance(corner, centre) <= reach)) {
        return None;
    }
    let [a, b, c] = part;
    let sides = [distance(b, c), distance(c, a), distance(a, b)];
    let longest = sides.into_iter().fold(0.0, f64::max);
    if longest < smallest {
        return Some(a);
    }
    let near: Vec<_> =
        balls.iter().copied().filter(|&(centre, reach)| distance(a, centre) <= reach + longest).collect();
    parts(part, sides, middle).into_iter().find_map(|part| gap_in_part(part, &near, smallest))
}

/// A sample that is not where its triangle and barycentrics say, or whose normal is not its triangle's.
pub fn misplaced(mesh: &Mesh, samples: &Points<3>) -> Option<usize> {
    let count = samples.len();
    assert_eq!([samples.normals.len(), samples.triangles.len(), samples.barycentrics.len()], [count; 3]);
    (0..count).find(|&i| {
        let [a, b, c] = mesh.corners(samples.triangles[i]).map(exact);
        let [u, v] = samples.barycentrics[i].map(f64::from);
        let expected: [f32; 3] =
            std::array::from_fn(|axis| ((1.0 - u - v) * a[axis] + u * b[axis] + v * c[axis]) as f32);
        let turned = !is_normal([a, b, c], samples.normals[i]);
        samples.positions[i] != expected || !(u >= 0.0 && v >= 0.0 && u + v <= 1.0) || turned
    })
}
