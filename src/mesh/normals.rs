//! Normals that a mesh carries: smooth ones, for shading.

use glam::DVec3;

use crate::error::{Error, Result};
use crate::mesh::check::{check_finite, check_indices};
use crate::mesh::rounding::exact;

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
    /// Checks and takes normals for a mesh of so many vertices and triangles.
    pub fn new(
        vertices: usize,
        triangles: usize,
        vectors: Vec<[f32; 3]>,
        indices: Option<Vec<[u32; 3]>>,
    ) -> Result<Self> {
        let count = vectors.len();
        if count >= u32::MAX as usize {
            return Err(Error::too_large("normals", format!("{count} entries; the limit is {}", u32::MAX - 1)));
        }
        check_finite("normals", "normal", &vectors)?;
        match &indices {
            None if count != vertices => {
                let reason = format!("{count} of them without indices, but there are {vertices} vertices");
                return Err(Error::invalid("normals", reason));
            }
            None => {}
            Some(indices) if indices.len() != triangles => {
                let reason = format!("{} entries, but there are {} triangles", indices.len(), triangles);
                return Err(Error::invalid("normal_indices", reason));
            }
            Some(indices) => check_indices("normal_indices", "normal", "normals", indices, count)?,
        }
        Ok(Self { vectors, indices })
    }

    /// The unit normal at a point of one of the mesh's triangles, if it has a direction.
    pub fn interpolated(&self, triangles: &[[u32; 3]], triangle: u32, uv: [f32; 2]) -> Option<DVec3> {
        let corners = self.indices.as_deref().unwrap_or(triangles)[triangle as usize];
        let [a, b, c] = corners.map(|corner| exact(self.vectors[corner as usize]));
        let [u, v] = uv.map(f64::from);
        let sum = (1.0 - u - v) * a + u * b + v * c;
        let longest = a.length().max(b.length()).max(c.length());
        (sum.length() > SHORTEST * longest).then(|| sum.normalize())
    }
}
