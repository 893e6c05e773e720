//! Meshes with holes, closed: only the inside of a closed mesh can be filled.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::{Error, Result};

/// A closed mesh, and the holes that it had.
pub struct Closed {
    pub mesh: Arc<Mesh>,
    pub holes: usize,
}

impl Closed {
    /// A mesh without its holes: the edges of each one, by which an odd number of triangles meets, become triangles with their
    /// mean. As each corner of a hole has an even number of such edges, all edges then have an even number of triangles.
    pub fn of(mesh: Arc<Mesh>) -> Result<Self> {
        if mesh.is_closed() {
            return Ok(Self { mesh, holes: 0 });
        }
        let edges = odd_edges(&merged(&mesh));
        let (mut positions, mut triangles) = (mesh.positions().to_vec(), mesh.triangles().to_vec());
        let holes = holes(&edges);
        for hole in &holes {
            let centre = positions.len() as u32;
            let sum = hole.iter().flatten().fold([0.0; 3], |sum: [f64; 3], &corner| {
                let position = mesh.positions()[corner as usize];
                std::array::from_fn(|axis| sum[axis] + f64::from(position[axis]))
            });
            positions.push(sum.map(|x| (x / (2 * hole.len()) as f64) as f32));
            triangles.extend(hole.iter().map(|&[from, to]| [to, from, centre]));
        }
        Ok(Self { mesh: Arc::new(Mesh::new(positions, triangles)?), holes: holes.len() })
    }

    /// Writes the mesh as an OBJ file to the folder of temporary files, for programs of others.
    pub fn write(&self) -> Result<PathBuf> {
        let path = std::env::temp_dir().join(format!("azulejo-volume-{}.obj", std::process::id()));
        let mut text = String::new();
        for [x, y, z] in self.mesh.positions() {
            writeln!(text, "v {x} {y} {z}").expect("a string takes all");
        }
        for triangle in self.mesh.triangles() {
            let [a, b, c] = triangle.map(|corner| corner + 1);
            writeln!(text, "f {a} {b} {c}").expect("a string takes all");
        }
        fs::write(&path, text).map_err(|source| Error::Io { path: path.clone(), source })?;
        Ok(path)
    }
}

/// The triangles by the first of the vertices at each place, without those that have two corners there.
fn merged(mesh: &Mesh) -> Vec<[u32; 3]> {
    let mut first = BTreeMap::new();
    let place = |corner: u32| mesh.positions()[corner as usize].map(|x| (x + 0.0).to_bits());
    let mut of = |corner: u32| *first.entry(place(corner)).or_insert(corner);
    let corners: Vec<[u32; 3]> = mesh.triangles().iter().map(|triangle| triangle.map(&mut of)).collect();
    corners.into_iter().filter(|[a, b, c]| a != b && b != c && c != a).collect()
}

/// The edges that an odd number of triangles shares, as one of them passes them.
fn odd_edges(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let mut passed: BTreeMap<[u32; 2], (usize, [u32; 2])> = BTreeMap::new();
    for &[a, b, c] in triangles {
        for edge in [[a, b], [b, c], [c, a]] {
            let entry = passed.entry([edge[0].min(edge[1]), edge[0].max(edge[1])]).or_insert((0, edge));
            entry.0 += 1;
        }
    }
    passed.into_values().filter(|(count, _)| count % 2 == 1).map(|(_, edge)| edge).collect()
}

/// The edges by the holes that they belong to: those that share corners.
fn holes(edges: &[[u32; 2]]) -> Vec<Vec<[u32; 2]>> {
    let mut rest = edges.to_vec();
    let mut holes = Vec::new();
    while let Some(first) = rest.pop() {
        let mut hole = vec![first];
        let mut at = 0;
        while let Some(&edge) = hole.get(at) {
            let (near, far) = rest.into_iter().partition(|other: &[u32; 2]| other.iter().any(|end| edge.contains(end)));
            hole.extend::<Vec<_>>(near);
            rest = far;
            at += 1;
        }
        holes.push(hole);
    }
    holes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::psp::scenes::sphere;

    #[test]
    fn a_sphere_with_holes_becomes_closed_again() {
        let sphere = sphere().unwrap();
        let is_kept = |index: &usize| ![10, 11, 2000].contains(index);
        let kept: Vec<_> = (0..sphere.triangles().len()).filter(is_kept).map(|i| sphere.triangles()[i]).collect();
        let open = Arc::new(Mesh::new(sphere.positions().to_vec(), kept).unwrap());
        assert!(!open.is_closed());
        let closed = Closed::of(open).unwrap();
        assert!(closed.mesh.is_closed() && closed.holes >= 2, "{}", closed.holes);
        assert_eq!(Closed::of(closed.mesh).unwrap().holes, 0);
    }
}
