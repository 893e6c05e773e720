//! Distances, and triangles from their corners, without the library.

use azulejo::mesh::Mesh;

type Point = [f64; 3];

pub fn exact(position: [f32; 3]) -> Point {
    position.map(f64::from)
}

/// The straight distance of two places.
pub fn distance<T: Copy + Into<f64>, const D: usize>(a: [T; D], b: [T; D]) -> f64 {
    (0..D).map(|axis| (a[axis].into() - b[axis].into()).powi(2)).sum::<f64>().sqrt()
}

/// The length of a vector.
pub fn length([x, y, z]: Point) -> f64 {
    (x * x + y * y + z * z).sqrt()
}

/// The vector product of two edges.
pub fn cross([a, b, c]: [Point; 3]) -> Point {
    let [ab, ac] = [b, c].map(|corner| -> Point { std::array::from_fn(|axis| corner[axis] - a[axis]) });
    std::array::from_fn(|axis| {
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        ab[next] * ac[last] - ab[last] * ac[next]
    })
}

/// True for a triangle that is more than a segment, up to the rounding of its area.
pub fn has_area(corners: [Point; 3]) -> bool {
    let edge = |i: usize| length(std::array::from_fn(|axis| corners[i][axis] - corners[(i + 1) % 3][axis]));
    let longest = (0..3).map(edge).fold(0.0, f64::max);
    length(cross(corners)) > 1e-14 * longest * longest
}

/// True for a vector that is the unit normal of a triangle, up to the rounding of floats.
pub fn is_normal(corners: [Point; 3], normal: [f32; 3]) -> bool {
    let cross = cross(corners);
    (0..3).all(|axis| (f64::from(normal[axis]) - cross[axis] / length(cross)).abs() <= 1e-6)
}

/// The normal that the library has for a triangle. Samples there have it bit for bit, so it decides what they see; it must
/// be that of the corners.
pub fn normal(mesh: &Mesh, triangle: u32) -> [f32; 3] {
    let (corners, normal) = (mesh.corners(triangle).map(|corner| corner.map(f64::from)), mesh.normal(triangle));
    assert!(is_normal(corners, normal), "{normal:?} is not the normal of {corners:?}");
    normal
}
