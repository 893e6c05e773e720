//! The edges of a mesh by the triangles that share them: closed meshes, and the boundaries of others.
//!
//! Vertices at one place are one, so that a mesh whose triangles have vertices of their own can be closed. A triangle with
//! two corners at one place has its edges in pairs, and counts for nothing; one whose corners lie on a line counts.

use std::sync::Arc;

use crate::index::Binned;
use crate::mesh::{Mesh, exact};

/// An edge at its lower vertex: the other vertex, the triangle, and true if it leads up.
type Edge = (u32, u32, bool);

/// The triangles that share edges.
#[derive(Debug)]
pub struct Sides {
    /// True if an even number of triangles shares each edge.
    pub is_closed: bool,
    /// Of a mesh that is not closed: the length of boundary of triangles that have some. It is the edges that are not passed
    /// as often one way as the other, once for each time that is missing, each counted for one of its triangles.
    pub boundary: Vec<(u32, f64)>,
}

impl Sides {
    /// The edges of the triangles that the mask does not leave out.
    pub fn of(mesh: &Mesh) -> Self {
        let sampled = || mesh.sampled_triangles().map(|number| (number, mesh.triangles()[number as usize]));
        let closed = Self { is_closed: true, boundary: Vec::new() };
        // To make vertices at one place one can close a mesh, but not open it.
        if is_even(&edges(mesh.positions().len(), sampled())) {
            return closed;
        }
        let places = places(mesh.positions());
        let welded = sampled().map(|(number, triangle)| (number, triangle.map(|vertex| places[vertex as usize])));
        let edges = edges(mesh.positions().len(), welded);
        if is_even(&edges) { closed } else { Self { is_closed: false, boundary: boundary(mesh, &edges) } }
    }
}

impl Mesh {
    /// True if an even number of triangles shares each edge, so that there is an inside: a line crosses the surface an even
    /// number of times. The direction of triangles does not matter, nor do intersections. Vertices at one place are one; a
    /// triangle with two of them has no edges; triangles that the mask leaves out are not there. O(n) the first time.
    pub fn is_closed(&self) -> bool {
        self.sides().is_closed
    }

    /// The edges, kept with the mesh.
    pub(super) fn sides(&self) -> Arc<Sides> {
        let kept = self.kept(|| Ok(()), || Ok(Sides::of(self)));
        kept.unwrap_or_else(|_| Arc::new(Sides::of(self)))
    }
}

/// The edges of triangles with their numbers, at their lower vertices, sorted.
fn edges(vertices: usize, triangles: impl Iterator<Item = (u32, [u32; 3])> + Clone) -> Binned<Edge> {
    let of = |(number, [a, b, c]): (u32, [u32; 3])| {
        [(a, b), (b, c), (c, a)].map(|(from, to)| (from.min(to) as usize, (from.max(to), number, from < to)))
    };
    let mut edges = Binned::new(vertices, triangles.flat_map(of).filter(|&(low, (high, ..))| low != high as usize));
    (0..vertices).for_each(|vertex| edges.bin_mut(vertex).sort_unstable());
    edges
}

/// The edges at a vertex by their other one.
fn shared(edges: &[Edge]) -> impl Iterator<Item = &[Edge]> {
    edges.chunk_by(|a, b| a.0 == b.0)
}

fn is_even(edges: &Binned<Edge>) -> bool {
    (0..edges.len()).all(|vertex| shared(edges.bin(vertex)).all(|edge| edge.len().is_multiple_of(2)))
}

/// See [`Sides::boundary`].
fn boundary(mesh: &Mesh, edges: &Binned<Edge>) -> Vec<(u32, f64)> {
    let place = |vertex: usize| exact(mesh.positions()[vertex]);
    let mut boundary = Vec::new();
    for vertex in 0..edges.len() {
        for edge in shared(edges.bin(vertex)) {
            let up = edge.iter().filter(|(.., is_up)| *is_up).count();
            let missing = up.abs_diff(edge.len() - up);
            if missing > 0 {
                let length = place(vertex).distance(place(edge[0].0 as usize));
                boundary.push((edge[0].1, missing as f64 * length));
            }
        }
    }
    boundary
}

/// For each vertex the first one at its place.
fn places(positions: &[[f32; 3]]) -> Vec<u32> {
    // A sum with 0 makes both zeros one.
    let key = |vertex: u32| positions[vertex as usize].map(|x| (x + 0.0).to_bits());
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.sort_unstable_by_key(|&vertex| (key(vertex), vertex));
    let mut places = vec![0; positions.len()];
    for same in order.chunk_by(|&a, &b| key(a) == key(b)) {
        same.iter().for_each(|&vertex| places[vertex as usize] = same[0]);
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tetrahedron without its last `missing` triangles.
    fn tetrahedron(missing: usize) -> Mesh {
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mut triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        triangles.truncate(4 - missing);
        Mesh::new(positions, triangles).unwrap()
    }

    /// The same mesh with vertices of its own for each triangle.
    fn torn(mesh: &Mesh) -> Mesh {
        let corners = mesh.triangles().iter().flatten().map(|&vertex| mesh.positions()[vertex as usize].map(|x| -x));
        let count = mesh.triangles().len() as u32;
        Mesh::new(corners.collect(), (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()).unwrap()
    }

    #[test]
    fn closed_meshes_are_those_without_an_odd_edge() {
        for missing in 0..4 {
            let mesh = tetrahedron(missing);
            assert_eq!([mesh.is_closed(), torn(&mesh).is_closed()], [missing == 0; 2]);
        }
        // Turned triangles, one twice more, and triangles without edges.
        let turned = [[0, 1, 2], [0, 1, 3], [0, 3, 2], [1, 2, 3], [0, 1, 2], [1, 2, 0], [3, 3, 3], [0, 0, 1]].to_vec();
        let mesh = Mesh::new(tetrahedron(0).positions().to_vec(), turned).unwrap();
        assert!(mesh.is_closed());
        let masked = |left_out: usize| (0..8).map(|triangle| triangle != left_out).collect();
        assert!(!mesh.clone().with_mask(masked(1)).unwrap().is_closed());
        assert!(mesh.with_mask(masked(6)).unwrap().is_closed());
    }

    #[test]
    fn the_boundary_has_the_lengths_of_edges_that_are_not_passed_both_ways() {
        let length = |mesh: &Mesh| Sides::of(mesh).boundary.iter().map(|&(_, length)| length).sum::<f64>();
        let root = 2f64.sqrt();
        for mesh in [tetrahedron(1), torn(&tetrahedron(1))] {
            assert!((length(&mesh) - 3.0 * root).abs() < 1e-6);
        }
        assert_eq!(length(&tetrahedron(0)), 0.0);
        // One of three triangles is turned: its edges to the others count twice.
        let turned = Mesh::new(tetrahedron(1).positions().to_vec(), vec![[0, 1, 2], [0, 1, 3], [0, 3, 2]]).unwrap();
        assert!((length(&turned) - (3.0 * root + 4.0)).abs() < 1e-6);
    }
}
