//! The edges that triangles share: which part of a surface is connected to which.
//!
//! Vertices at the same position are one (`welding.rs`). Triangles without a common edge are not connected, however
//! close they are: the two sides of a thin wall are far from each other on the surface, and a crack is a boundary.
//! Triangles left out by the mesh's mask are ignored, as are those two of whose corners coincide.
//!
//! Half-edges are numbered `3 t + k`: the edge from corner `k` to the next of triangle `t`.

use std::sync::Arc;

use glam::DVec3;

use crate::dcr::surface::welding::welded;
use crate::error::{Error, Result};
use crate::index::Binned;
use crate::mesh::{Mesh, exact};

/// A mesh with its edges.
pub(super) struct ConnectedMesh<'a> {
    pub(super) mesh: &'a Mesh,
    edges: Arc<Edges>,
}

/// The edges of a mesh. They are kept with it for the next call.
struct Edges {
    /// For each vertex the first one of the same position.
    vertices: Vec<u32>,
    /// The half-edges of an edge are linked in a circle. One that is alone, at a boundary, is linked to itself.
    around: Vec<u32>,
}

/// The next half-edge of the triangle.
fn next(edge: u32) -> u32 {
    if edge % 3 == 2 { edge - 2 } else { edge + 1 }
}

impl<'a> ConnectedMesh<'a> {
    /// Finds the edges, unless an earlier call did. O(n log n).
    ///
    /// # Errors
    /// [`Error::TooLarge`] for a mesh of more triangles than half-edges can be numbered for.
    pub(super) fn new(mesh: &'a Mesh) -> Result<Self> {
        let count = mesh.triangles().len();
        if count > (u32::MAX / 3) as usize {
            return Err(Error::too_large("mesh", format!("{count} triangles; the limit is {}", u32::MAX / 3)));
        }
        Ok(Self { mesh, edges: mesh.kept(|| Ok(()), || Ok(Edges::of(mesh)))? })
    }

    /// The other half-edges of the same edge: none at a boundary, most often one.
    pub(super) fn across(&self, edge: u32) -> impl Iterator<Item = u32> {
        let around = &self.edges.around;
        std::iter::successors(Some(around[edge as usize]), |&other| Some(around[other as usize]))
            .take_while(move |&other| other != edge)
    }

    /// Whether two half-edges of an edge have the same direction: then their triangles face opposite sides.
    pub(super) fn run_alike(&self, edge: u32, other: u32) -> bool {
        self.edges.origin(self.mesh, edge) == self.edges.origin(self.mesh, other)
    }

    /// The ends of a half-edge.
    pub(super) fn ends(&self, edge: u32) -> [DVec3; 2] {
        self.end_positions(edge).map(exact)
    }

    /// The ends of a half-edge, in floats.
    pub(super) fn end_positions(&self, edge: u32) -> [[f32; 3]; 2] {
        let corners = self.mesh.triangles()[(edge / 3) as usize];
        [edge, next(edge)].map(|end| self.mesh.positions()[corners[(end % 3) as usize] as usize])
    }
}

impl Edges {
    /// Links the half-edges between the same two vertices.
    fn of(mesh: &Mesh) -> Self {
        let all: Vec<u32> = (0..3 * mesh.triangles().len() as u32).collect();
        let mut edges = Self { vertices: welded(mesh), around: all };
        // The edges by their lower vertex, each with its higher one.
        let ends = edges.half_edges(mesh).map(|edge| {
            let [low, high] = edges.vertices_of(mesh, edge);
            (low as usize, (high, edge))
        });
        let mut ends = Binned::new(edges.vertices.len(), ends);
        for vertex in 0..ends.len() {
            let ends = ends.bin_mut(vertex);
            ends.sort_unstable();
            for same in ends.chunk_by(|a, b| a.0 == b.0) {
                let others = same.iter().cycle().skip(1);
                let links = same.iter().zip(others);
                links.for_each(|(&(_, edge), &(_, other))| edges.around[edge as usize] = other);
            }
        }
        edges
    }

    /// The half-edges of all triangles that are not ignored.
    fn half_edges(&self, mesh: &Mesh) -> impl Iterator<Item = u32> + Clone {
        mesh.sampled_triangles()
            .map(|triangle| 3 * triangle)
            .filter_map(|first| {
                let [a, b, c] = [first, first + 1, first + 2].map(|edge| self.origin(mesh, edge));
                (a != b && b != c && c != a).then_some(first..first + 3)
            })
            .flatten()
    }

    /// The vertex at which a half-edge starts.
    fn origin(&self, mesh: &Mesh, edge: u32) -> u32 {
        let corner = mesh.triangles()[(edge / 3) as usize][(edge % 3) as usize];
        self.vertices[corner as usize]
    }

    /// The vertices of an edge, the lower number first.
    fn vertices_of(&self, mesh: &Mesh, edge: u32) -> [u32; 2] {
        let (from, to) = (self.origin(mesh, edge), self.origin(mesh, next(edge)));
        [from.min(to), from.max(to)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many half-edges each edge of the mesh has, from the most to the fewest.
    fn degrees(connected: &ConnectedMesh) -> Vec<usize> {
        let edges = 0..3 * connected.mesh.triangles().len() as u32;
        let firsts = edges.filter(|&edge| connected.across(edge).all(|other| other > edge));
        let mut degrees: Vec<_> = firsts.map(|edge| 1 + connected.across(edge).count()).collect();
        degrees.sort_unstable_by(|a, b| b.cmp(a));
        degrees
    }

    const SQUARE: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

    #[test]
    fn edges_are_shared_by_place_whatever_the_winding_and_the_indices() {
        let [a, b, c, d] = SQUARE;
        let turned = [a[0], -0.0, 1e-8];
        for positions in [vec![a, b, c, a, c, d], vec![a, b, c, turned, c, d], vec![a, b, c, d, c, a]] {
            let mesh = Mesh::new(positions.clone(), vec![[0, 1, 2], [3, 4, 5]]).unwrap();
            let connected = ConnectedMesh::new(&mesh).unwrap();
            assert_eq!(degrees(&connected), [2, 1, 1, 1, 1]);
            let alike = positions[3] == d;
            let [diagonal, other] = [2, if alike { 4 } else { 3 }];
            assert_eq!(connected.across(diagonal).collect::<Vec<_>>(), [other]);
            assert_eq!(connected.run_alike(diagonal, other), alike);
        }
        let apart = [a[0], 0.0, 1e-5];
        let mesh = Mesh::new(vec![a, b, c, apart, c, d], vec![[0, 1, 2], [3, 4, 5]]).unwrap();
        assert_eq!(degrees(&ConnectedMesh::new(&mesh).unwrap()), [1; 6]);
    }

    #[test]
    fn edges_of_many_triangles_hold_them_all_and_what_is_left_out_is_not_there() {
        let [a, b, c, d] = SQUARE;
        let up = [0.5, 0.5, 1.0];
        let triangles = vec![[0, 1, 2], [0, 2, 3], [2, 0, 4], [0, 0, 2]];
        let mesh = Mesh::new(vec![a, b, c, d, up], triangles).unwrap();
        assert_eq!(degrees(&ConnectedMesh::new(&mesh).unwrap())[..2], [3, 1]);
        let mesh = mesh.with_mask(vec![true, true, false, true]).unwrap();
        let connected = ConnectedMesh::new(&mesh).unwrap();
        assert_eq!(degrees(&connected)[..2], [2, 1]);
        assert_eq!(connected.across(2).collect::<Vec<_>>(), [3]);
    }
}
