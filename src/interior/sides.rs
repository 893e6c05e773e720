//! The edges of a mesh by the triangles that share them: closed meshes, and the boundaries of others.
//!
//! Vertices at one place are one, so that a mesh whose triangles have vertices of their own can be closed. A triangle with
//! two corners at one place has its edges in pairs, and counts for nothing; one whose corners lie on a line counts.

use std::sync::Arc;

use crate::index::Binned;
use crate::mesh::Mesh;

/// An edge at its lower vertex: the other vertex, and true if it leads up.
type Edge = (u32, bool);

/// The triangles that share edges.
#[derive(Debug)]
pub struct Sides {
    /// The number of edges that an odd number of triangles shares: 0 of a closed mesh.
    pub odd_edges: usize,
    /// Of a mesh that is not closed: the edges that are not passed as often one way as the other, once for each time that is
    /// missing, in the direction that is.
    pub boundary: Vec<[u32; 2]>,
}

impl Sides {
    /// The edges of the triangles that the mask does not leave out.
    pub fn of(mesh: &Mesh) -> Self {
        let sampled = || mesh.sampled_triangles().map(|number| mesh.triangles()[number as usize]);
        let closed = Self { odd_edges: 0, boundary: Vec::new() };
        // To make vertices at one place one can close a mesh, but not open it.
        if odd_edges(&edges(mesh.positions().len(), sampled())) == 0 {
            return closed;
        }
        let places = places(mesh.positions());
        let welded = sampled().map(|triangle| triangle.map(|vertex| places[vertex as usize]));
        let edges = edges(mesh.positions().len(), welded);
        match odd_edges(&edges) {
            0 => closed,
            odd_edges => Self { odd_edges, boundary: boundary(&edges) },
        }
    }
}

impl Mesh {
    /// True if an even number of triangles shares each edge, so that there is an inside: a line crosses the surface an even
    /// number of times. The direction of triangles does not matter, nor do intersections. Vertices at one place are one; a
    /// triangle with two of them has no edges; triangles that the mask leaves out are not there. O(n) the first time.
    pub fn is_closed(&self) -> bool {
        self.sides().odd_edges == 0
    }

    /// The edges, kept with the mesh.
    pub(crate) fn sides(&self) -> Arc<Sides> {
        let kept = self.kept(|| Ok(()), || Ok(Sides::of(self)));
        kept.unwrap_or_else(|_| Arc::new(Sides::of(self)))
    }
}

/// The edges of triangles, at their lower vertices, sorted.
fn edges(vertices: usize, triangles: impl Iterator<Item = [u32; 3]> + Clone) -> Binned<Edge> {
    let of = |[a, b, c]: [u32; 3]| {
        [(a, b), (b, c), (c, a)].map(|(from, to)| (from.min(to) as usize, (from.max(to), from < to)))
    };
    let mut edges = Binned::new(vertices, triangles.flat_map(of).filter(|&(low, (high, _))| low != high as usize));
    (0..vertices).for_each(|vertex| edges.bin_mut(vertex).sort_unstable());
    edges
}

/// The edges at a vertex by their other one.
fn shared(edges: &[Edge]) -> impl Iterator<Item = &[Edge]> {
    edges.chunk_by(|a, b| a.0 == b.0)
}

fn odd_edges(edges: &Binned<Edge>) -> usize {
    let is_odd = |edge: &&[Edge]| !edge.len().is_multiple_of(2);
    (0..edges.len()).map(|vertex| shared(edges.bin(vertex)).filter(is_odd).count()).sum()
}

/// See [`Sides::boundary`].
fn boundary(edges: &Binned<Edge>) -> Vec<[u32; 2]> {
    let mut boundary = Vec::new();
    for vertex in 0..edges.len() {
        for edge in shared(edges.bin(vertex)) {
            let up = edge.iter().filter(|(.., is_up)| *is_up).count();
            let (down, ends) = (edge.len() - up, [vertex as u32, edge[0].0]);
            let missing = if up < down { ends } else { [ends[1], ends[0]] };
            boundary.extend(std::iter::repeat_n(missing, up.abs_diff(down)));
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
    fn the_boundary_is_what_is_not_passed_both_ways() {
        let sorted = |mesh: &Mesh| {
            let mut boundary = Sides::of(mesh).boundary;
            boundary.sort_unstable();
            boundary
        };
        assert!(sorted(&tetrahedron(0)).is_empty());
        // The directions of the missing triangle.
        assert_eq!(sorted(&tetrahedron(1)), [[1, 2], [2, 3], [3, 1]]);
        assert_eq!(sorted(&torn(&tetrahedron(1))).len(), 3);
        // One of three triangles is turned: two of its edges are missing twice.
        let turned = Mesh::new(tetrahedron(1).positions().to_vec(), vec![[0, 1, 2], [0, 1, 3], [0, 3, 2]]).unwrap();
        assert_eq!(sorted(&turned), [[0, 2], [0, 2], [1, 0], [1, 0], [2, 1], [2, 3], [3, 1]]);
    }
}
