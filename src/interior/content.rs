//! The volume of the inside of a mesh.

use crate::interior::Interior;

/// The rays along each of two axes of the box around a mesh: so many at first, and twice as many while few pass the inside.
/// Under Miri thousands of rays would take minutes.
const RAYS: u32 = if cfg!(miri) { 8 } else { 128 };
const MOST_RAYS: u32 = 1024;

/// The number of rays that are enough.
const ENOUGH: usize = if cfg!(miri) { 1 } else { 1000 };

impl Interior {
    /// The volume of the inside of a closed mesh: a midpoint rule over rays along +x, of what of each is inside, by the parity that
    /// decides for points. Unlike the sum over triangles it needs neither directions that agree nor a surface without
    /// intersections. About 1/1000 off for a body as a ball is. 0 for a body that all rays miss. Kept, as it takes up to a
    /// million rays.
    pub(crate) fn volume(&self) -> f64 {
        *self.volume.get_or_init(|| self.measured_volume())
    }

    /// True if the triangles of the mesh coincide in pairs, so that nothing is inside. O(t log t) for t triangles.
    pub(crate) fn cancels_out(&self) -> bool {
        let sorted = |corners: &[[f32; 3]; 3]| {
            // -0 is 0.
            let mut corners = corners.map(|corner| corner.map(|x| (x + 0.0).to_bits()));
            corners.sort_unstable();
            corners
        };
        let mut triangles: Vec<_> = self.tree.corners.iter().map(sorted).collect();
        triangles.sort_unstable();
        triangles.chunk_by(|a, b| a == b).all(|same| same.len().is_multiple_of(2))
    }

    fn measured_volume(&self) -> f64 {
        let ([low, high], mut rays) = (self.bounds, RAYS);
        if (0..3).any(|axis| low[axis] == high[axis]) {
            // Rays in the plane of all triangles would meet each of them.
            return 0.0;
        }
        loop {
            let (length, passed) = self.passed(rays);
            if passed >= ENOUGH || rays == MOST_RAYS {
                let side = |axis: usize| (f64::from(high[axis]) - f64::from(low[axis])) / f64::from(rays);
                return length * side(1) * side(2);
            }
            rays *= 2;
        }
    }

    /// The length inside of all rays, so many along each axis, and the number of those that pass the inside.
    fn passed(&self, rays: u32) -> (f64, usize) {
        let [low, high] = self.bounds;
        let place = |axis: usize, ray: u32| {
            let share = (f64::from(ray) + 0.5) / f64::from(rays);
            (f64::from(low[axis]) + share * (f64::from(high[axis]) - f64::from(low[axis]))) as f32
        };
        let (mut sum, mut passed, mut crossings) = (0.0, 0, Vec::new());
        for (j, k) in (0..rays).flat_map(|j| (0..rays).map(move |k| (j, k))) {
            let from = [low[0].next_down(), place(1, j), place(2, k)];
            crossings.clear();
            self.tree.for_each_crossing(from, |triangle, crossing| {
                if crossing != 0 {
                    crossings.push(height(from, &self.tree.corners[triangle]));
                }
            });
            crossings.sort_unstable_by(f64::total_cmp);
            let length: f64 = crossings.chunks_exact(2).map(|ends| ends[1] - ends[0]).sum();
            sum += length;
            passed += usize::from(length > 0.0);
        }
        (sum, passed)
    }
}

/// The coordinate along x at which the ray from a point crosses a triangle's plane, within those of its corners.
fn height([_, y, z]: [f32; 3], corners: &[[f32; 3]; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| corner.map(f64::from));
    let area = |p: [f64; 3], q: [f64; 3]| {
        (p[1] - f64::from(y)) * (q[2] - f64::from(z)) - (q[1] - f64::from(y)) * (p[2] - f64::from(z))
    };
    let weights = [area(b, c), area(c, a), area(a, b)];
    let (sum, low, high) = (weights.iter().sum::<f64>(), a[0].min(b[0]).min(c[0]), a[0].max(b[0]).max(c[0]));
    let height = (weights[0] * a[0] + weights[1] * b[0] + weights[2] * c[0]) / sum;
    // Of a triangle that is seen as a line, which has no plane.
    if height.is_finite() { height.clamp(low, high) } else { low }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;

    /// The surface of a box.
    fn cuboid(low: [f32; 3], high: [f32; 3]) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
        let corner = |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 1 { high[axis] } else { low[axis] });
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = faces.iter().flat_map(|&[a, b, c, d]: &[u32; 4]| [[a, b, c], [a, c, d]]);
        ((0..8).map(corner).collect(), triangles.collect())
    }

    fn volume(parts: &[([f32; 3], [f32; 3])]) -> f64 {
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        for &(low, high) in parts {
            let (corners, faces) = cuboid(low, high);
            let first = positions.len() as u32;
            positions.extend(corners);
            triangles.extend(faces.into_iter().map(|face| face.map(|corner| corner + first)));
        }
        Interior::of(&Mesh::new(positions, triangles).unwrap()).volume()
    }

    #[test]
    fn the_volume_is_that_of_boxes_and_their_parity() {
        let about =
            |found: f64, expected: f64| assert!((found - expected).abs() < 0.01 * expected, "{found} {expected}");
        let whole = ([-1.0, 0.0, 2.0], [3.0, 0.5, 3.0]);
        about(volume(&[whole]), 2.0);
        // A hollow is left out, a second box beside is added, what two boxes share is outside.
        about(volume(&[whole, ([0.0, 0.1, 2.2], [1.0, 0.4, 2.8])]), 2.0 - 0.18);
        about(volume(&[([0.0; 3], [1.0; 3]), ([2.0, 0.0, 0.0], [3.0, 1.0, 1.0])]), 2.0);
        about(volume(&[([0.0; 3], [1.0; 3]), ([0.5, 0.0, 0.0], [1.5, 1.0, 1.0])]), 1.0);
        // Two copies enclose nothing.
        assert_eq!(volume(&[whole, whole]), 0.0);
    }

    #[test]
    fn copies_of_all_triangles_cancel_out_however_they_are_turned() {
        let (mut positions, triangles) = cuboid([-1.0, 0.0, 2.0], [3.0, 0.5, 3.0]);
        let cancels_out = |positions: &[[f32; 3]], triangles: Vec<[u32; 3]>| {
            Interior::of(&Mesh::new(positions.to_vec(), triangles).unwrap()).cancels_out()
        };
        assert!(!cancels_out(&positions, triangles.clone()));
        let count = positions.len() as u32;
        positions.extend(positions.clone().into_iter().map(|[x, y, z]| [x, if y == 0.0 { -0.0 } else { y }, z]));
        let turned = triangles.iter().map(|&[a, b, c]| [c + count, b + count, a + count]);
        let mut both: Vec<_> = triangles.iter().copied().chain(turned).collect();
        assert!(cancels_out(&positions, both.clone()));
        both.extend(triangles);
        assert!(!cancels_out(&positions, both));
    }
}
