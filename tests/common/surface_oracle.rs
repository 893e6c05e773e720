//! What a set of samples on a mesh owes, checked in the plainest way: all that is used of the library are the corners of
//! triangles and the mask. Buckets bring only what is near to a place, so that large sets can be checked, too.

#[path = "parts.rs"]
mod parts;

use std::collections::HashMap;

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

/// Points by the cubes of a grid that they are in.
struct Buckets {
    side: f64,
    cubes: HashMap<[i64; 3], Vec<(usize, Point)>>,
    all: Vec<(usize, Point)>,
}

impl Buckets {
    fn new(samples: &SurfaceSamples, side: f64) -> Self {
        let all: Vec<_> = samples.positions.iter().map(|&position| exact(position)).enumerate().collect();
        let mut buckets = Self { side, cubes: HashMap::new(), all: all.clone() };
        for (index, point) in all {
            buckets.cubes.entry(buckets.cube(point)).or_default().push((index, point));
        }
        buckets
    }

    fn cube(&self, point: Point) -> [i64; 3] {
        point.map(|x| (x / self.side).floor() as i64)
    }

    /// All points of a box, and some around it.
    fn near(&self, low: Point, high: Point) -> Vec<(usize, Point)> {
        let [low, high] = [self.cube(low), self.cube(high)];
        if (0..3).map(|axis| (high[axis] as f64) - (low[axis] as f64) + 1.0).product::<f64>() > self.cubes.len() as f64
        {
            return self.all.clone();
        }
        let cubes = (low[0]..=high[0])
            .flat_map(|x| (low[1]..=high[1]).flat_map(move |y| (low[2]..=high[2]).map(move |z| [x, y, z])));
        cubes.filter_map(|cube| self.cubes.get(&cube)).flatten().copied().collect()
    }
}

/// The first two samples found that are closer than the radius.
pub fn conflict(samples: &SurfaceSamples, radius: f64) -> Option<(usize, usize)> {
    let buckets = Buckets::new(samples, 1.01 * radius);
    let reach = |point: Point, by: f64| point.map(|x| x + by);
    buckets.all.iter().find_map(|&(i, point)| {
        let near = buckets.near(reach(point, -1.001 * radius), reach(point, 1.001 * radius));
        near.into_iter().find(|&(j, other)| j < i && distance(point, other) < radius).map(|(j, _)| (j, i))
    })
}

/// A point of the surface for which it could not be proved that a sample is within the radius, up to a tolerance.
pub fn gap(mesh: &Mesh, samples: &SurfaceSamples, radius: f64, tolerance: f64) -> Option<Point> {
    let reach = radius + tolerance;
    let buckets = Buckets::new(samples, 2.0 * reach);
    (0..mesh.triangles().len() as u32).filter(|&triangle| mesh.is_sampled(triangle)).find_map(|triangle| {
        let corners = mesh.corners(triangle).map(exact);
        let bound = |pick: fn(f64, f64) -> f64, by: f64| -> Point {
            std::array::from_fn(|axis| corners.map(|corner| corner[axis]).into_iter().reduce(pick).unwrap() + by)
        };
        let near = buckets.near(bound(f64::min, -1.001 * reach), bound(f64::max, 1.001 * reach));
        let near: Vec<Point> = near.into_iter().map(|(_, point)| point).collect();
        has_area(corners).then(|| gap_in_part(corners, &near, reach, tolerance / 100.0)).flatten()
    })
}

/// Whether a triangle is more than a segment, up to the rounding of its area.
fn has_area(corners: [Point; 3]) -> bool {
    let longest = (0..3).map(|i| distance(corners[i], corners[(i + 1) % 3])).fold(0.0, f64::max);
    distance(cross(corners), [0.0; 3]) > 1e-14 * longest * longest
}

/// The vector product of two edges.
fn cross([a, b, c]: [Point; 3]) -> Point {
    let [ab, ac] = [b, c].map(|corner| -> Point { std::array::from_fn(|axis| corner[axis] - a[axis]) });
    std::array::from_fn(|axis| {
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        ab[next] * ac[last] - ab[last] * ac[next]
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
        let cross = cross([a, b, c]);
        let length = distance(cross, [0.0; 3]);
        let normal = exact(samples.normals[i]);
        let turned = (0..3).any(|axis| (normal[axis] - cross[axis] / length).abs() > 1e-6);
        samples.positions[i] != expected || !(u >= 0.0 && v >= 0.0 && u + v <= 1.0) || turned
    })
}
