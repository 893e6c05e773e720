//! The quality of triangles as a surface: their incidences at edges and vertices, and their angles.

use std::collections::BTreeSet;

use glam::DVec3;

use crate::math::atan2;
use crate::mesh::{Mesh, exact};

/// A mesh as a surface; see [`Mesh::quality`]. Vertices are the same if they have the same number, wherever they are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Quality {
    /// The number of edges with one triangle, which are the boundary.
    pub boundary_edges: u64,
    /// The number of edges with two triangles.
    pub inner_edges: u64,
    /// The number of edges with more than two triangles.
    pub non_manifold_edges: u64,
    /// The number of edges with two triangles that are wound against each other.
    pub twisted_edges: u64,
    /// The number of vertices at an edge with more than two triangles, and of those whose triangles are not all
    /// connected by edges at the vertex.
    pub non_manifold_vertices: u64,
    /// The number of vertices without a triangle.
    pub unused_vertices: u64,
    /// Euler's characteristic, vertices - edges + triangles, without unused vertices: 2 for a sphere, 0 for a torus, 1
    /// for a disk.
    pub euler: i64,
    /// The smallest angle of all triangles, in degrees. A triangle without area has an angle of 0.
    pub smallest_angle: f64,
    /// The largest angle of all triangles, in degrees.
    pub largest_angle: f64,
    /// The mean over all triangles of their smallest angle, in degrees; at most 60.
    pub mean_smallest_angle: f64,
}

impl Quality {
    /// True if the mesh is a closed surface of one orientation: each edge has two triangles, wound alike, and the
    /// triangles of each vertex are one fan. Unused vertices do not matter.
    pub fn is_closed_manifold(&self) -> bool {
        self.is_manifold() && self.boundary_edges == 0
    }

    /// True if the mesh is a surface of one orientation, with or without a boundary.
    pub fn is_manifold(&self) -> bool {
        self.non_manifold_edges == 0 && self.twisted_edges == 0 && self.non_manifold_vertices == 0
    }
}

impl Mesh {
    /// The mesh as a surface, with the triangles that a mask leaves out. A triangle that names a vertex twice counts as
    /// any other. O(n log n).
    pub fn quality(&self) -> Quality {
        let mut quality = Quality::default();
        let is_rough = quality.count_edges(self);
        quality.count_vertices(self, &is_rough);
        quality.measure_angles(self);
        quality
    }
}

impl Quality {
    /// Counts edges; returns for each vertex whether it is at an edge with more than two triangles.
    fn count_edges(&mut self, mesh: &Mesh) -> Vec<bool> {
        let sides = mesh.triangles().iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let mut edges: Vec<_> = sides.map(|[a, b]| (a.min(b), a.max(b), a < b)).collect();
        edges.sort_unstable();
        let mut is_rough = vec![false; mesh.positions().len()];
        for sides in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            match sides {
                [_] => self.boundary_edges += 1,
                [one, other] => {
                    self.inner_edges += 1;
                    self.twisted_edges += u64::from(one.2 == other.2);
                }
                [(a, b, _), ..] => {
                    self.non_manifold_edges += 1;
                    for end in [*a, *b] {
                        is_rough[end as usize] = true;
                    }
                }
                [] => {}
            }
        }
        is_rough
    }

    /// Counts vertices, and what follows from that.
    fn count_vertices(&mut self, mesh: &Mesh, is_rough: &[bool]) {
        let sides = mesh.triangles().iter().flat_map(|&[a, b, c]| [(a, b, c), (b, c, a), (c, a, b)]);
        let mut sides: Vec<_> = sides.collect();
        sides.sort_unstable();
        let mut used = 0;
        for opposite in sides.chunk_by(|a, b| a.0 == b.0) {
            used += 1;
            let is_manifold = !is_rough[opposite[0].0 as usize] && are_connected(opposite);
            self.non_manifold_vertices += u64::from(!is_manifold);
        }
        self.unused_vertices = mesh.positions().len() as u64 - used;
        let edges = self.boundary_edges + self.inner_edges + self.non_manifold_edges;
        self.euler = used as i64 - edges as i64 + mesh.triangles().len() as i64;
    }

    fn measure_angles(&mut self, mesh: &Mesh) {
        (self.smallest_angle, self.largest_angle) = (180.0, 0.0);
        let mut sum = 0.0;
        for triangle in 0..mesh.triangles().len() as u32 {
            let [a, b, c] = mesh.corners(triangle).map(exact);
            let angles = [angle(a, b, c), angle(b, c, a), angle(c, a, b)];
            let smallest = angles.into_iter().fold(180.0, f64::min);
            self.smallest_angle = self.smallest_angle.min(smallest);
            self.largest_angle = angles.into_iter().fold(self.largest_angle, f64::max);
            sum += smallest;
        }
        self.mean_smallest_angle = sum / mesh.triangles().len() as f64;
    }
}

/// True if the edges opposite a vertex, the second and third of each, are connected.
fn are_connected(opposite: &[(u32, u32, u32)]) -> bool {
    let mut ends: Vec<_> = opposite.iter().flat_map(|&(_, a, b)| [(a, b), (b, a)]).collect();
    ends.sort_unstable();
    let (mut reached, mut new) = (BTreeSet::from([ends[0].0]), vec![ends[0].0]);
    while let Some(end) = new.pop() {
        let first = ends.partition_point(|&(from, _)| from < end);
        for &(_, to) in ends[first..].iter().take_while(|&&(from, _)| from == end) {
            if reached.insert(to) {
                new.push(to);
            }
        }
    }
    reached.len() == ends.chunk_by(|a, b| a.0 == b.0).count()
}

/// The angle at the first of three points, in degrees.
fn angle(at: DVec3, a: DVec3, b: DVec3) -> f64 {
    let (a, b) = (a - at, b - at);
    atan2(a.cross(b).length(), a.dot(b)).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

    /// Nine places in general position.
    fn quality(triangles: &[[u32; 3]]) -> Quality {
        let places = (0..9u8).map(|i| [1, 2, 3].map(|power| f32::from(i + 1).powi(power)));
        Mesh::new(places.collect(), triangles.to_vec()).unwrap().quality()
    }

    #[test]
    fn closed_open_and_broken_surfaces_are_told_apart() {
        let closed = quality(&TETRAHEDRON);
        assert!(closed.is_closed_manifold() && closed.euler == 2, "{closed:?}");
        assert_eq!((closed.inner_edges, closed.boundary_edges, closed.unused_vertices), (6, 0, 5));
        let open = quality(&TETRAHEDRON[..3]);
        assert!(open.is_manifold() && !open.is_closed_manifold() && open.euler == 1, "{open:?}");
        assert_eq!((open.inner_edges, open.boundary_edges), (3, 3));
        // One more page at an edge.
        let booklet = quality(&[&TETRAHEDRON[..], &[[0, 1, 4]]].concat());
        assert_eq!((booklet.non_manifold_edges, booklet.non_manifold_vertices, booklet.boundary_edges), (1, 2, 2));
        // Two tetrahedra that share a vertex.
        let second = TETRAHEDRON.map(|corners| corners.map(|corner| if corner == 0 { 0 } else { corner + 3 }));
        let touching = quality(&[TETRAHEDRON, second].concat());
        assert_eq!((touching.non_manifold_edges, touching.non_manifold_vertices, touching.euler), (0, 1, 3));
        assert!(!touching.is_manifold());
        let twisted = quality(&[[0, 1, 2], [0, 1, 3]]);
        assert_eq!((twisted.twisted_edges, twisted.is_manifold()), (1, false));
    }

    #[test]
    fn angles_are_those_of_the_triangles() {
        let mesh = |corners: [[f32; 3]; 3]| Mesh::new(corners.to_vec(), vec![[0, 1, 2]]).unwrap().quality();
        let right = mesh([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        assert!((right.largest_angle - 90.0).abs() < 1e-12 && (right.smallest_angle - 45.0).abs() < 1e-12, "{right:?}");
        assert_eq!(right.mean_smallest_angle, right.smallest_angle);
        // A half of a square, and a triangle with angles of 120 and 30 degrees.
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.5, 0.0, 0.75f32.sqrt()]];
        let both = Mesh::new(positions, vec![[0, 1, 2], [0, 1, 3]]).unwrap().quality();
        assert!((both.largest_angle - 150.0).abs() < 1e-5, "{both:?}");
    }
}
