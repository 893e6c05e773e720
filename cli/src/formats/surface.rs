//! Samples of a surface as a table: what files of them hold, and in which order.

use std::io::{self, Write};

use azulejo::Points;

use super::columns::{CLASS, Column, Number, RADIUS, RANK, placed, write_floats, write_position};

/// Samples of a surface with all of their columns.
pub struct SurfaceTable<'a> {
    pub samples: &'a Points<3>,
    /// The normals to write: geometric or interpolated.
    pub normals: &'a [[f32; 3]],
    /// The radius of each sample, where they differ.
    pub radii: Option<&'a [f64]>,
    /// The radius of each class, or of all samples, where `radii` has none; empty if it is not known.
    pub class_radii: &'a [f64],
    /// The origin of the mesh, to which positions are relative. If it is not 0, positions are written as doubles.
    pub origin: [f64; 3],
}

impl SurfaceTable<'_> {
    /// True if positions are written as doubles.
    pub fn has_origin(&self) -> bool {
        self.origin != [0.0; 3]
    }

    /// The coordinates of a sample as text.
    pub fn position(&self, sample: usize) -> [String; 3] {
        let position = self.samples.positions[sample];
        if self.has_origin() {
            placed(position, self.origin).map(|x| x.to_string())
        } else {
            position.map(|x| x.to_string())
        }
    }

    /// The columns that only some sets have.
    pub fn more_columns(&self) -> impl Iterator<Item = Column> {
        let Points { ranks, classes, .. } = self.samples;
        let radius = self.radii.is_some().then_some(RADIUS);
        let (rank, class) = ((!ranks.is_empty()).then_some(RANK), (!classes.is_empty()).then_some(CLASS));
        [radius, rank, class].into_iter().flatten()
    }

    /// The numbers of a sample in these columns.
    pub fn more_numbers(&self, sample: usize) -> impl Iterator<Item = Number> {
        let Points { ranks, classes, .. } = self.samples;
        let radius = self.radii.map(|radii| Number::Float(radii[sample] as f32));
        let rank = ranks.get(sample).map(|&rank| Number::Float(rank));
        let class = classes.get(sample).map(|&class| Number::Whole(class));
        [radius, rank, class].into_iter().flatten()
    }

    /// Writes all rows as binary numbers, little-endian and without gaps: x y z, nx ny nz, the triangle as an unsigned
    /// integer, u v, and radius, rank and class if there are any.
    pub fn write_binary(&self, writer: &mut impl Write) -> io::Result<()> {
        (0..self.samples.len()).try_for_each(|i| {
            let Points { positions, triangles, barycentrics, .. } = self.samples;
            write_position(writer, positions[i], self.origin)?;
            write_floats(writer, &[self.normals[i]])?;
            writer.write_all(&triangles[i].to_le_bytes())?;
            write_floats(writer, &[barycentrics[i]])?;
            self.more_numbers(i).try_for_each(|number| writer.write_all(&number.bytes()))
        })
    }
}
