//! Normals that a mesh carries: smooth ones, for shading.

use glam::DVec3;

use crate::error::{Error, Result};
use crate::mesh::{Mesh, check_finite, check_indices, exact};

/// Interpolated normals shorter than this share of the longest normal have no direction: it would be that of roundings.
const SHORTEST: f64 = 1e-6;

/// Normals at the corners of all triangles.
#[derive(Debug)]
pub(super) struct Normals {
    vectors: Vec<[f32; 3]>,
    /// The normals of each triangle's corners; those of its vertices, without.
    indices: Option<Vec<[u32; 3]>>,
}

impl Normals {
    /// Checks and takes normals for a mesh.
    pub fn new(mesh: &Mesh, vectors: Vec<[f32; 3]>, indices: Option<Vec<[u32; 3]>>) -> Result<Self> {
        let count = vectors.len();
        if count >= u32::MAX as usize {
            return Err(Error::too_large("normals", format!("{count} entries; the limit is {}", u32::MAX - 1)));
        }
        check_finite("normals", "normal", &vectors)?;
        match &indices {
            None if count != mesh.positions.len() => {
                let reason =
                    format!("{count} of them without indices, but there are {} vertices", mesh.positions.len());
                return Err(Error::invalid("normals", reason));
            }
            None => {}
            Some(indices) if indices.len() != mesh.triangles.len() => {
                let reason = format!("{} entries, but there are {} triangles", indices.len(), mesh.triangles.len());
                return Err(Error::invalid("normal_indices", reason));
            }
            Some(indices) => check_indices("normal_indices", "normal", "normals", indices, count)?,
        }
        Ok(Self { vectors, indices })
    }

    /// The unit normal at a point of a triangle, if it has a direction.
    pub fn interpolated(&self, mesh: &Mesh, triangle: u32, uv: [f32; 2]) -> Option<DVec3> {
        let corners = self.indices.as_deref().unwrap_or(&mesh.triangles)[triangle as usize];
        let [a, b, c] = corners.map(|corner| exact(self.vectors[corner as usize]));
        let [u, v] = uv.map(f64::from);
        let sum = (1.0 - u - v) * a + u * b + v * c;
        let longest = a.length().max(b.length()).max(c.length());
        (sum.length() > SHORTEST * longest).then(|| sum.normalize())
    }
}
