//! A trefoil knot with a quilted relief: a closed surface, its box about 2 wide.

use std::f64::consts::TAU;

use glam::DVec3;

use super::shapes::Soup;

/// The torus that the knot's centre line lies on, and the mean radius of the tube around that line.
const TORUS: [f64; 2] = [0.58, 0.24];
const TUBE: f64 = 0.155;

/// The depth of the relief in tube radii, and its rhombs: along the knot and around the tube.
const RELIEF: f64 = 0.16;
const RHOMBS: [f64; 2] = [54.0, 7.0];

/// A point of the knot's surface, `along` and `around` in [0, 2π); it looks towards z and stands on y.
fn knot_surface(along: f64, around: f64) -> DVec3 {
    let (long, short) = (2.0 * along, 3.0 * along);
    let outwards = DVec3::new(long.cos(), long.sin(), 0.0);
    let centre = |along: f64| {
        let (long, short) = (2.0 * along, 3.0 * along);
        let reach = TORUS[0] + TORUS[1] * short.cos();
        DVec3::new(reach * long.cos(), reach * long.sin(), TORUS[1] * short.sin())
    };
    // The line lies on a torus, whose normal is therefore square to it, and comes back to itself after one turn.
    let normal = outwards * short.cos() + DVec3::Z * short.sin();
    let tangent = (centre(along + 1e-5) - centre(along - 1e-5)).normalize();
    let side = tangent.cross(normal);
    let [u, v] = [RHOMBS[0] * along, RHOMBS[1] * around];
    let cushion = (0.5 * (u + v)).sin() * (0.5 * (u - v)).sin();
    let radius = TUBE * (1.0 + RELIEF * (cushion.abs().sqrt() - 0.6));
    centre(along) + radius * (normal * around.cos() + side * around.sin())
}

/// The knot as a grid around the tube, closed in both directions, counter-clockwise from outside.
pub fn knot(columns: u32) -> Soup {
    let rows = columns / 4;
    let turn = |i: u32, count: u32| TAU * i as f64 / count as f64;
    let vertices = (0..columns)
        .flat_map(|i| (0..rows).map(move |j| knot_surface(turn(i, columns), turn(j, rows)).as_vec3().to_array()));
    let vertex = |i: u32, j: u32| (i % columns) * rows + j % rows;
    let triangles = (0..columns).flat_map(|i| {
        (0..rows).flat_map(move |j| {
            let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
            [[a, c, b], [a, d, c]]
        })
    });
    (vertices.collect(), triangles.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;

    #[test]
    fn the_knot_is_one_closed_surface_that_looks_outwards() {
        let (positions, triangles) = knot(400);
        let mut edges = HashMap::new();
        let mut volume = 0.0;
        for triangle in &triangles {
            for corner in 0..3 {
                *edges.entry((triangle[corner], triangle[(corner + 1) % 3])).or_insert(0) += 1;
            }
            let [a, b, c] = triangle.map(|i| glam::Vec3::from(positions[i as usize]).as_dvec3());
            volume += a.dot(b.cross(c)) / 6.0;
        }
        assert!(edges.iter().all(|(&(a, b), &count)| count == 1 && edges.contains_key(&(b, a))));
        assert_eq!(positions.len() + triangles.len(), edges.len() / 2, "a torus has Euler characteristic 0");
        assert!(volume > 0.3, "{volume}");
    }
}
