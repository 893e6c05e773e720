//! Which triangles share an edge: the surface as it is for those who stay on it.
//!
//! Vertices at the same place are one, as files that repeat their vertices in each triangle (STL) ask for. What shares
//! no edge is not connected, however near it is: the two sides of a thin wall are far from each other, and a crack is a
//! border. Triangles that the mesh's mask leaves out are not there, nor are those two of whose corners coincide.
//!
//! Half-edges are numbered `3 t + k`: the edge from corner `k` to the next of triangle `t`.

use glam::DVec3;

use crate::error::{Error, Result};
use crate::geometry::grid3::{Grid3, distance_squared};
use crate::mesh::{Mesh, exact};

/// A mesh with its edges.
pub(super) struct Sheet<'a> {
    pub(super) mesh: &'a Mesh,
    /// For each vertex the first one of the same position.
    vertices: Vec<u32>,
    /// The half-edges of an edge lead to one another in a circle. One that is alone, at a border, leads to itself.
    around: Vec<u32>,
}

/// The next half-edge of the triangle.
fn next(edge: u32) -> u32 {
    if edge % 3 == 2 { edge - 2 } else { edge + 1 }
}

impl<'a> Sheet<'a> {
    /// Finds the edges. O(n log n).
    ///
    /// # Errors
    /// [`Error::TooLarge`] for a mesh of more triangles than half-edges can be numbered for.
    pub(super) fn new(mesh: &'a Mesh) -> Result<Self> {
        let count = mesh.triangles().len();
        if count > (u32::MAX / 3) as usize {
            return Err(Error::too_large("mesh", format!("{count} triangles; the limit is {}", u32::MAX / 3)));
        }
        let mut sheet = Self { mesh, vertices: welded(mesh), around: Vec::new() };
        sheet.around = sheet.linked();
        Ok(sheet)
    }

    /// Links the half-edges between the same two vertices.
    fn linked(&self) -> Vec<u32> {
        // The edges whose lower vertex is `v`: `ends[starts[v]..starts[v + 1]]`, each with its higher vertex.
        let mut starts = vec![0u32; self.vertices.len() + 1];
        self.edges().for_each(|edge| starts[self.vertices_of(edge)[0] as usize + 1] += 1);
        for vertex in 1..starts.len() {
            starts[vertex] += starts[vertex - 1];
        }
        let mut ends = vec![(0, 0); starts[self.vertices.len()] as usize];
        let mut places = starts.clone();
        for edge in self.edges() {
            let [low, high] = self.vertices_of(edge);
            ends[places[low as usize] as usize] = (high, edge);
            places[low as usize] += 1;
        }
        let mut around: Vec<u32> = (0..3 * self.mesh.triangles().len() as u32).collect();
        for range in starts.windows(2) {
            let ends = &mut ends[range[0] as usize..range[1] as usize];
            ends.sort_unstable();
            for same in ends.chunk_by(|a, b| a.0 == b.0) {
                let others = same.iter().cycle().skip(1);
                same.iter().zip(others).for_each(|(&(_, edge), &(_, other))| around[edge as usize] = other);
            }
        }
        around
    }

    /// The half-edges of all triangles that are there.
    fn edges(&self) -> impl Iterator<Item = u32> {
        self.mesh
            .sampled_triangles()
            .map(|triangle| 3 * triangle)
            .filter_map(|first| {
                let [a, b, c] = [first, first + 1, first + 2].map(|edge| self.origin(edge));
                (a != b && b != c && c != a).then_some(first..first + 3)
            })
            .flatten()
    }

    /// The vertex at which a half-edge starts.
    fn origin(&self, edge: u32) -> u32 {
        let corner = self.mesh.triangles()[(edge / 3) as usize][(edge % 3) as usize];
        self.vertices[corner as usize]
    }

    /// The vertices of an edge, the lower number first.
    fn vertices_of(&self, edge: u32) -> [u32; 2] {
        let (from, to) = (self.origin(edge), self.origin(next(edge)));
        [from.min(to), from.max(to)]
    }

    /// The other half-edges of the same edge: none at a border, most often one.
    pub(super) fn across(&self, edge: u32) -> impl Iterator<Item = u32> {
        std::iter::successors(Some(self.around[edge as usize]), |&other| Some(self.around[other as usize]))
            .take_while(move |&other| other != edge)
    }

    /// Whether two half-edges of an edge run the same way: then their triangles face opposite sides.
    pub(super) fn run_alike(&self, edge: u32, other: u32) -> bool {
        self.origin(edge) == self.origin(other)
    }

    /// The ends of a half-edge.
    pub(super) fn ends(&self, edge: u32) -> [DVec3; 2] {
        let corners = self.mesh.triangles()[(edge / 3) as usize];
        [edge, next(edge)].map(|end| exact(self.mesh.positions()[corners[(end % 3) as usize] as usize]))
    }
}

/// For each vertex the first one that is at its place, up to a float spacing at the largest coordinate: seams that were
/// computed twice differ by that.
fn welded(mesh: &Mesh) -> Vec<u32> {
    let tolerance = f64::from(mesh.largest_coordinate()) * f64::from(f32::EPSILON);
    let positions = mesh.positions();
    let mut grid = Grid3::new(mesh.bounds().0.map(f64::from), 16.0 * tolerance);
    let mut firsts: Vec<u32> = Vec::new();
    let weld = |(vertex, &position): (u32, &[f32; 3])| {
        let is_here = |first: &u32| distance_squared(positions[*first as usize], position) <= tolerance * tolerance;
        let found =
            grid.candidates(position.map(f64::from), tolerance).map(|id| firsts[id as usize]).filter(is_here).min();
        found.unwrap_or_else(|| {
            grid.insert(position);
            firsts.push(vertex);
            vertex
        })
    };
    (0..).zip(positions).map(weld).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many half-edges each edge of the mesh has, from the most to the fewest.
    fn degrees(sheet: &Sheet) -> Vec<usize> {
        let edges = 0..3 * sheet.mesh.triangles().len() as u32;
        let firsts = edges.filter(|&edge| sheet.across(edge).all(|other| other > edge));
        let mut degrees: Vec<_> = firsts.map(|edge| 1 + sheet.across(edge).count()).collect();
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
            let sheet = Sheet::new(&mesh).unwrap();
            assert_eq!(degrees(&sheet), [2, 1, 1, 1, 1]);
            let alike = positions[3] == d;
            let [diagonal, other] = [2, if alike { 4 } else { 3 }];
            assert_eq!(sheet.across(diagonal).collect::<Vec<_>>(), [other]);
            assert_eq!(sheet.run_alike(diagonal, other), alike);
        }
        let apart = [a[0], 0.0, 1e-5];
        let mesh = Mesh::new(vec![a, b, c, apart, c, d], vec![[0, 1, 2], [3, 4, 5]]).unwrap();
        assert_eq!(degrees(&Sheet::new(&mesh).unwrap()), [1; 6]);
    }

    #[test]
    fn edges_of_many_triangles_hold_them_all_and_what_is_left_out_is_not_there() {
        let [a, b, c, d] = SQUARE;
        let up = [0.5, 0.5, 1.0];
        let triangles = vec![[0, 1, 2], [0, 2, 3], [2, 0, 4], [0, 0, 2]];
        let mesh = Mesh::new(vec![a, b, c, d, up], triangles).unwrap();
        assert_eq!(degrees(&Sheet::new(&mesh).unwrap())[..2], [3, 1]);
        let mesh = mesh.with_mask(vec![true, true, false, true]).unwrap();
        let sheet = Sheet::new(&mesh).unwrap();
        assert_eq!(degrees(&sheet)[..2], [2, 1]);
        assert_eq!(sheet.across(2).collect::<Vec<_>>(), [3]);
    }
}
