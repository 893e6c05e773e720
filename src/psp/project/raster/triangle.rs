//! Triangles on a projector, in integers: which points are inside, and where (Pineda 1988, "A parallel algorithm for
//! polygon rasterization").
//!
//! A point on an edge counts as if it were moved to the right by next to nothing, and up by much less still. So of all
//! triangles that meet along an edge, or around a corner, and do not overlap there, exactly one has it.

use crate::psp::project::raster::lattice::LatticePoint;

/// An edge of a triangle: positive on its inner side, and where a point on it counts as inside.
#[derive(Clone, Copy)]
struct ProjectedEdge {
    slope: LatticePoint,
    constant: i64,
    /// 0 if points on the edge are inside, else 1.
    bias: i64,
}

/// A triangle on a projector.
pub(super) struct ProjectedTriangle {
    /// Each opposite the corner of its number.
    edges: [ProjectedEdge; 3],
    /// Twice the area; above zero.
    area: i64,
}

impl ProjectedTriangle {
    /// None if the triangle is seen without area.
    pub fn new(corners: [LatticePoint; 3]) -> Option<Self> {
        let [a, b, c] = corners;
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let sign = area.signum();
        let edge = |from: LatticePoint, to: LatticePoint| {
            let slope = [sign * (from[1] - to[1]), sign * (to[0] - from[0])];
            let inside = slope[0] > 0 || (slope[0] == 0 && slope[1] > 0);
            ProjectedEdge { slope, constant: -(slope[0] * from[0] + slope[1] * from[1]), bias: i64::from(!inside) }
        };
        let edges = [edge(b, c), edge(c, a), edge(a, b)];
        (area != 0).then_some(Self { edges, area: area.abs() })
    }

    /// The shares of the second and third corner in a point; none for points outside.
    pub fn barycentrics(&self, [x, y]: LatticePoint) -> Option<[f64; 2]> {
        let [a, b, c] = self.edges.map(|edge| edge.slope[0] * x + edge.slope[1] * y + edge.constant - edge.bias);
        // One of them is negative, and with it their union, for points outside.
        let weight = |value: i64, edge: usize| (value + self.edges[edge].bias) as f64 / self.area as f64;
        (a | b | c >= 0).then(|| [weight(b, 1), weight(c, 2)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::psp::project::raster::lattice::{END, extent, extent_between};
    use crate::rng::{Draw, Rng};

    const SIDE: i64 = 25;

    fn turn([a, b, c]: [LatticePoint; 3]) -> i64 {
        ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).signum()
    }

    /// A mesh of 5 by 5 quads whose inner corners are anywhere near their place; each is cut in two, some along an edge.
    fn quads(rng: &mut Rng) -> Vec<[LatticePoint; 3]> {
        let inner = 1..5;
        let mut corner = |x: i64, y: i64| {
            let moves = inner.contains(&x) && inner.contains(&y);
            [x, y].map(|i| 5 * i + if moves { rng.below(4) as i64 } else { 0 })
        };
        let corners: Vec<Vec<_>> = (0..=5).map(|y| (0..=5).map(|x| corner(x, y)).collect()).collect();
        let quads = (0..5).flat_map(|y| (0..5).map(move |x| (x, y)));
        let halves = quads.flat_map(|(x, y): (usize, usize)| {
            let [a, b, c, d] = [corners[y][x], corners[y][x + 1], corners[y + 1][x + 1], corners[y + 1][x]];
            let mut cuts = [[[a, b, c], [a, c, d]], [[b, a, d], [d, c, b]]];
            cuts.rotate_left(rng.below(2) as usize);
            // One of the two cuts lies inside the quad.
            if cuts[0].map(turn).iter().product::<i64>() < 0 { cuts[1] } else { cuts[0] }
        });
        halves.collect()
    }

    #[test]
    fn a_mesh_has_every_point_once() {
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        for _ in 0..300 {
            let triangles = quads(&mut rng);
            for point in (1..SIDE).flat_map(|y| (1..SIDE).map(move |x| [x, y])) {
                let hits = triangles.iter().filter_map(|t| ProjectedTriangle::new(*t)?.barycentrics(point)).count();
                assert_eq!(hits, 1, "{point:?}");
            }
        }
    }

    #[test]
    fn barycentrics_lead_back_to_the_point_at_any_size() {
        let mut rng = Rng::at(2, Draw::Probe, &[]);
        let mut inside = 0;
        for round in 0..20_000 {
            let size = [10, 1000, END as u64][round % 3];
            let mut place = || [rng.below(size) as i64, rng.below(size) as i64];
            let (corners, point) = ([place(), place(), place()], place());
            let Some([u, v]) = ProjectedTriangle::new(corners).and_then(|triangle| triangle.barycentrics(point)) else {
                continue;
            };
            inside += 1;
            assert!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 + 1e-15);
            for axis in 0..2 {
                let [a, b, c] = corners.map(|corner| corner[axis] as f64);
                assert!((a + u * (b - a) + v * (c - a) - point[axis] as f64).abs() < 1e-14 * size as f64 + 1e-12);
            }
        }
        assert!(inside > 1000, "{inside}");
    }

    #[test]
    fn the_extent_of_a_row_holds_all_its_points() {
        let mut rng = Rng::at(3, Draw::Probe, &[]);
        for _ in 0..2000 {
            let mut place = || [rng.below(SIDE as u64) as i64, rng.below(SIDE as u64) as i64];
            let corners = [place(), place(), place()];
            let Some(triangle) = ProjectedTriangle::new(corners) else { continue };
            let ([left, right], [bottom, top]) = (extent(&corners, 0), extent(&corners, 1));
            for y in bottom as i64..=top as i64 {
                let [low, high] = extent_between(&corners, y as f64 - 0.5, y as f64 + 0.5);
                assert!(left <= low && high <= right, "wider than the triangle");
                for x in (0..SIDE).filter(|&x| triangle.barycentrics([x, y]).is_some()) {
                    assert!((low - 1e-9..=high + 1e-9).contains(&(x as f64)));
                }
            }
        }
    }
}
