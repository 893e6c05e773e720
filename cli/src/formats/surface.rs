//! Samples of a surface as a table: what files of them hold, and in which order.

use std::io::{self, Write};

use azulejo::SurfaceSamples;

/// Samples with all that is known of them.
pub struct SurfaceTable<'a> {
    pub samples: &'a SurfaceSamples,
    /// The normals to write: geometric or interpolated.
    pub normals: &'a [[f32; 3]],
    /// The radius of each sample, where they differ.
    pub radii: Option<&'a [f64]>,
}

impl SurfaceTable<'_> {
    /// Writes all rows as binary numbers, little-endian and without gaps: x y z, nx ny nz, the triangle as an unsigned
    /// integer, u v, and the radius if there is one.
    pub fn write_binary(&self, writer: &mut impl Write) -> io::Result<()> {
        (0..self.samples.len()).try_for_each(|i| {
            let (SurfaceSamples { positions, triangles, barycentrics, .. }, normals) = (self.samples, self.normals);
            write_floats(writer, &[positions[i], normals[i]])?;
            writer.write_all(&triangles[i].to_le_bytes())?;
            write_floats(writer, &[barycentrics[i]])?;
            self.radii.map_or(Ok(()), |radii| write_floats(writer, &[[radii[i] as f32]]))
        })
    }
}

/// Writes vectors as little-endian floats.
pub fn write_floats<const N: usize>(writer: &mut impl Write, vectors: &[[f32; N]]) -> io::Result<()> {
    vectors.iter().flatten().try_for_each(|x| writer.write_all(&x.to_le_bytes()))
}
