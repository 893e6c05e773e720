//! What a set of samples on a mesh owes, checked in the plainest way. Slow: O(n²) and more.

#[path = "parts.rs"]
mod parts;

use azulejo::SurfaceSamples;
use azulejo::mesh::Mesh;
use parts::parts;

type Point = [f64; 3];

fn exact(position: [f32; 3]) -> Point {
    position.map(f64::from)
}

fn distance(a: Point, b: Point) -> f64 {
    ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2) + (a[2] - b[2]).powi(2)).sqrt()
}

fn middle(a: Point, b: Point) -> Point {
    std::array::from_fn(|axis| (a[axis] + b[axis]) / 2.0)
}

/// The first two samples found that are closer than the radius.
pub fn conflict(samples: &SurfaceSamples, radius: f64) -> Option<(usize, usize)> {
    let points: Vec<_> = samples.positions.iter().map(|&position| exact(position)).collect();
    (0..points.len()).find_map(|i| (0..i).find(|&j| distance(points[i], points[j]) < radius).map(|j| (j, i)))
}

/// A point of the surface for which it could not be proved that a sample is within the radius, up to a tolerance.
pub fn gap(mesh: &Mesh, samples: &SurfaceSamples, radius: f64, tolerance: f64) -> Option<Point> {
    let points: Vec<_> = samples.positions.iter().map(|&position| exact(position)).collect();
    (0..mesh.triangles().len() as u32).filter(|&triangle| mesh.triangle_area(triangle) > 0.0).find_map(|triangle| {
        gap_in_part(mesh.corners(triangle).map(exact), &points, radius + tolerance, tolerance / 100.0)
    })
}

/// A part is covered when one sample is near to its three corners; otherwise four quarters of it must be, or two halves
/// where it is much longer than wide.
fn gap_in_part(part: [Point; 3], samples: &[Point], reach: f64, smallest: f64) -> Option<Point> {
    if samples.iter().any(|&sample| part.iter().all(|&corner| distance(corner, sample) <= reach)) {
        return None;
    }
    let [a, b, c] = part;
    let sides = [distance(b, c), distance(c, a), distance(a, b)];
    let longest = sides.into_iter().fold(0.0, f64::max);
    if longest < smallest {
        return Some(a);
    }
    let near: Vec<_> = samples.iter().copied().filter(|&sample| distance(a, sample) <= reach + longest).collect();
    parts(part, sides, middle).into_iter().find_map(|part| gap_in_part(part, &near, reach, smallest))
}

/// A sample that is not where its triangle and barycentrics say, or whose normal is not its triangle's.
pub fn misplaced(mesh: &Mesh, samples: &SurfaceSamples) -> Option<usize> {
    let count = samples.len();
    assert_eq!([samples.normals.len(), samples.triangles.len(), samples.barycentrics.len()], [count; 3]);
    (0..count).find(|&i| {
        let [a, b, c] = mesh.corners(samples.triangles[i]).map(exact);
        let [u, v] = samples.barycentrics[i].map(f64::from);
        let expected: [f32; 3] =
            std::array::from_fn(|axis| ((1.0 - u - v) * a[axis] + u * b[axis] + v * c[axis]) as f32);
        let [ab, ac] = [b, c].map(|corner| -> Point { std::array::from_fn(|axis| corner[axis] - a[axis]) });
        let cross: Point = std::array::from_fn(|axis| {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            ab[next] * ac[last] - ab[last] * ac[next]
        });
        let length = distance(cross, [0.0; 3]);
        let normal = exact(samples.normals[i]);
        let turned = (0..3).any(|axis| (normal[axis] - cross[axis] / length).abs() > 1e-6);
        samples.positions[i] != expected || !(u >= 0.0 && v >= 0.0 && u + v <= 1.0) || turned
    })
}
