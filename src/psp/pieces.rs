//! Long triangles in slices.
//!
//! Parts of a triangle's own shape would suffice for a well-shaped one. A needle, though, becomes needles of half its
//! length, two of them side by side: n² parts where n are enough. So a triangle that is longer than high is sliced
//! first, across its longest edge, into slices that are about as long as they are high.

use crate::mesh::{Mesh, exact};
use crate::psp::fragment::Fragment;

/// Appends a triangle in slices no shorter than `shortest`, or as a whole if it is not much longer than that or high.
///
/// The height on the longest edge makes two right triangles. Each is sliced parallel to the height, which gives one
/// triangle at the tip and quadrilaterals, cut in two. Slices that meet have the same corners, bit for bit.
pub(super) fn slice(mesh: &Mesh, triangle: u32, shortest: f64, slices: &mut Vec<Fragment>) {
    let whole = Fragment::whole(triangle);
    let shape = whole.shape(mesh);
    let length = shortest.max(2.0 * mesh.triangle_area(triangle) / shape.longest);
    if shape.longest <= 2.0 * length {
        slices.push(whole);
        return;
    }
    let [apex, p, q] = [0, 1, 2].map(|step| (shape.apex + step) % 3);
    let [top, start, end] = [apex, p, q].map(|corner| exact(mesh.corners(triangle)[corner]));
    let foot = ((top - start).dot(end - start) / (end - start).length_squared()).clamp(0.0, 1.0);

    let top = whole.corners[apex];
    let foot_point = between(whole.corners[p], whole.corners[q], foot);
    for (tip, share) in [(whole.corners[p], foot), (whole.corners[q], 1.0 - foot)] {
        let count = (share * shape.longest / length).ceil();
        for i in 0..count as u32 {
            let [near, far] = [i, i + 1].map(|i| f64::from(i) / count);
            let along_edge = |share| between(tip, foot_point, share);
            let along_slope = |share| between(tip, top, share);
            slices.push(Fragment { corners: [along_edge(near), along_edge(far), along_slope(far)], ..whole });
            if i > 0 {
                slices.push(Fragment { corners: [along_edge(near), along_slope(far), along_slope(near)], ..whole });
            }
        }
    }
}

/// The point at a share of the distance; exact at both ends.
fn between(from: [f64; 2], to: [f64; 2], share: f64) -> [f64; 2] {
    std::array::from_fn(|axis| (1.0 - share) * from[axis] + share * to[axis])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Well-shaped triangles and needles of every kind: flat, acute, right.
    fn triangles() -> Vec<Mesh> {
        let third = [[0.3, 0.8, 0.1], [0.5, 1e-6, 0.0], [0.999, 1e-4, 1e-4], [0.0, 1e-7, 1e-7], [1e-5, 0.05, 0.0]];
        let mesh = |third| Mesh::new(vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], third], vec![[0, 1, 2]]).unwrap();
        third.into_iter().map(mesh).collect()
    }

    fn all_pieces(mesh: &Mesh, longest: f64) -> Vec<Fragment> {
        let mut slices = Vec::new();
        slice(mesh, 0, longest, &mut slices);
        slices.iter().flat_map(|slice| slice.parts_up_to(mesh, longest)).collect()
    }

    #[test]
    fn pieces_are_short_and_make_up_the_triangle() {
        for mesh in triangles() {
            for longest in [2.0, 0.3, 0.01] {
                let pieces = all_pieces(&mesh, longest);
                assert!(pieces.iter().all(|piece| piece.shape(&mesh).longest <= longest * (1.0 + 1e-9)));
                let area: f64 = pieces.iter().map(|piece| piece.area(&mesh)).sum();
                assert!((area / mesh.area() - 1.0).abs() < 1e-9, "{area} of {}", mesh.area());
            }
        }
    }

    #[test]
    fn a_needle_has_as_many_pieces_as_it_is_long() {
        for mesh in &triangles()[1..] {
            for longest in [1e-2, 1e-3, 1e-4] {
                let expected = 1.0 / longest + mesh.area() / (longest * longest);
                let count = all_pieces(mesh, longest).len() as f64;
                assert!((0.5..12.0).contains(&(count / expected)), "{count} of about {expected}");
            }
        }
    }
}
