//! The edges that triangles share: the connectivity of a surface.
//!
//! Vertices at the same position are one ([`welded`]). Triangles without a common edge are not connected, however
//! close they are: the two sides of a thin wall are far from each other on the surface, and a crack is a boundary.
//! Triangles excluded by the mesh's mask are ignored, as are those with two coincident corners.
//!
//! Half-edges are numbered `3 t + k`: the edge from corner `k` to the next of triangle `t`.

use std::sync::Arc;

use glam::DVec3;

use crate::error::{Error, Result};
use crate::index::Binned;
use crate::mesh::{Mesh, exact};

/// A mesh with its edges.
pub struct ConnectedMesh<'a> {
    pub mesh: &'a Mesh,
    edges: Arc<Edges>,
}

/// The edges of a mesh. They are kept with it for the next call.
struct Edges {
    /// For each vertex the first one at the same position.
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
    /// [`Error::TooLarge`] for a mesh of more triangles than half-edge numbers allow.
    pub fn new(mesh: &'a Mesh) -> Result<Self> {
        let count = mesh.triangles().len();
        if count > (u32::MAX / 3) as usize {
            return Err(Error::too_large("mesh", format!("{count} triangles; the limit is {}", u32::MAX / 3)));
        }
        Ok(Self { mesh, edges: mesh.kept(|| Ok(()), || Ok(Edges::of(mesh)))? })
    }

    /// The other half-edges of the same edge: none at a boundary, most often one.
    pub fn across(&self, edge: u32) -> impl Iterator<Item = u32> {
        let around = &self.edges.around;
        std::iter::successors(Some(around[edge as usize]), |&other| Some(around[other as usize]))
            .take_while(move |&other| other != edge)
    }

    /// True if two half-edges of an edge have the same direction: then their triangles face opposite sides.
    pub fn run_alike(&self, edge: u32, other: u32) -> bool {
        self.edges.origin(self.mesh, edge) == self.edges.origin(self.mesh, other)
    }

    /// The ends of a half-edge.
    pub fn ends(&self, edge: u32) -> [DVec3; 2] {
        self.end_positions(edge).map(exact)
    }

    /// The ends of a half-edge, in floats.
    pub fn end_positions(&self, edge: u32) -> [[f32; 3]; 2] {
        let corners = self.mesh.triangles()[(edge / 3) as usize];
        [edge, next(edge)].map(|end| self.mesh.positions()[corners[(end % 3) as usize] as usize])
    }
}

impl Edges {
    /// Links the half-edges between the same two vertices.
    fn of(mesh: &Mesh) -> Self {
        let all: Vec<u32> = (0..3 * mesh.triangles().len() as u32).collect();
        let mut edges = Self { vertices: welded(mesh), around: all };
        // The edges binned by their lower vertex, each with its higher one.
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

// Vertices at the same position are one, as needed for files that repeat their vertices in each triangle (STL), and
// where a seam was computed twice.

/// The side of the cells in which vertices are found, in tolerances: wide, so that few vertices are near two of them.
const CELL: f64 = 256.0;

const NONE: u32 = u32::MAX;

/// For each vertex the first one at its position, up to a float spacing at the largest coordinate. O(n).
pub fn welded(mesh: &Mesh) -> Vec<u32> {
    let tolerance = f64::from(mesh.largest_coordinate()) * f64::from(f32::EPSILON);
    let positions = mesh.positions();
    let low = exact(mesh.bounds().0);
    // Vertices that no triangle uses may be outside the bounds; whole numbers saturate there.
    let cell = |place: DVec3| {
        let cell = (place - low) / (CELL * tolerance);
        [cell.x as i64, cell.y as i64, cell.z as i64]
    };
    let bits = (2 * positions.len()).next_power_of_two().ilog2().max(1);
    let bucket = |[x, y, z]: [i64; 3]| {
        // Large primes of Teschner et al. 2003; the product brings the mixed bits to the top.
        let mixed = (x as u64).wrapping_mul(73_856_093)
            ^ (y as u64).wrapping_mul(19_349_663)
            ^ (z as u64).wrapping_mul(83_492_791);
        (mixed.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - bits)) as usize
    };
    // The first vertices, in chains from the buckets of their cells.
    let mut heads = vec![NONE; 1 << bits];
    let mut chain = vec![NONE; positions.len()];
    let mut firsts = Vec::with_capacity(positions.len());
    for (vertex, &position) in (0..).zip(positions) {
        let place = exact(position);
        let (from, to) = (cell(place - tolerance), cell(place + tolerance));
        let mut first = NONE;
        for z in from[2]..=to[2] {
            for y in from[1]..=to[1] {
                for x in from[0]..=to[0] {
                    let mut other = heads[bucket([x, y, z])];
                    while other != NONE {
                        let squared = exact(positions[other as usize]).distance_squared(place);
                        if squared <= tolerance * tolerance {
                            first = first.min(other);
                        }
                        other = chain[other as usize];
                    }
                }
            }
        }
        if first == NONE {
            first = vertex;
            let bucket = bucket(cell(place));
            chain[vertex as usize] = heads[bucket];
            heads[bucket] = vertex;
        }
        firsts.push(first);
    }
    firsts
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::rng::{Draw, Rng};

    /// The number of half-edges that each edge of the mesh has, from the most to the fewest.
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

    #[test]
    fn vertices_are_welded_as_in_a_loop_over_all() {
        let mut rng = Rng::at(12, Draw::Probe, &[]);
        let tolerance = f64::from(f32::EPSILON);
        // Positions in many and in few cells, each several times, about as far apart as the tolerance.
        for scale in [1.0, 1e-5] {
            let mut positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
            for _ in 0..300 {
                let place: [f64; 3] = std::array::from_fn(|_| rng.unit() * scale);
                for _ in 0..3 {
                    positions.push(place.map(|x| (x + 2.0 * tolerance * (rng.unit() - 0.5)) as f32));
                }
            }
            let mut firsts: Vec<u32> = Vec::new();
            let expected = (0..positions.len() as u32).map(|vertex| {
                let here = |first: &&u32| {
                    let [a, b] = [**first, vertex].map(|vertex| exact(positions[vertex as usize]));
                    a.distance_squared(b) <= tolerance * tolerance
                };
                let first = firsts.iter().find(here).copied();
                first.unwrap_or_else(|| {
                    firsts.push(vertex);
                    vertex
                })
            });
            let expected: Vec<u32> = expected.collect();
            let mesh = Mesh::new(positions.clone(), vec![[0, 1, 2]]).unwrap();
            assert_eq!(welded(&mesh), expected);
            assert!(firsts.len() < positions.len() - 100);
        }
    }
}
