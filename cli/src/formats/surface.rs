//! Samples of a surface as a table: what files of them hold, and in which order.

use std::fmt::{self, Display, Formatter};
use std::io::{self, Write};

use azulejo::SurfaceSamples;

/// A column that only some sets have.
#[derive(Clone, Copy)]
pub struct Column {
    pub name: &'static str,
    /// Whether its numbers are unsigned integers; otherwise they are floats.
    is_whole: bool,
}

const RADIUS: Column = Column { name: "radius", is_whole: false };
const RANK: Column = Column { name: "rank", is_whole: false };
/// The class of each sample, in a set of several.
pub const CLASS: Column = Column { name: "class", is_whole: true };

impl Column {
    /// The type of its numbers in PLY files.
    pub fn ply_type(self) -> &'static str {
        if self.is_whole { "uint" } else { "float" }
    }

    /// The type of its numbers in arrays of NumPy.
    pub fn npy_type(self) -> &'static str {
        if self.is_whole { "<u4" } else { "<f4" }
    }
}

/// A number in such a column.
#[derive(Clone, Copy)]
pub enum Number {
    Float(f32),
    Whole(u32),
}

impl Number {
    /// Little-endian.
    pub fn bytes(self) -> [u8; 4] {
        match self {
            Self::Float(number) => number.to_le_bytes(),
            Self::Whole(number) => number.to_le_bytes(),
        }
    }
}

impl Display for Number {
    fn fmt(&self, formatter: &mut Formatter) -> fmt::Result {
        match self {
            Self::Float(number) => number.fmt(formatter),
            Self::Whole(number) => number.fmt(formatter),
        }
    }
}

/// Samples with all that is known of them.
pub struct SurfaceTable<'a> {
    pub samples: &'a SurfaceSamples,
    /// The normals to write: geometric or interpolated.
    pub normals: &'a [[f32; 3]],
    /// The radius of each sample, where they differ.
    pub radii: Option<&'a [f64]>,
}

impl SurfaceTable<'_> {
    /// The columns that only some sets have.
    pub fn more_columns(&self) -> impl Iterator<Item = Column> {
        let SurfaceSamples { ranks, classes, .. } = self.samples;
        let radius = self.radii.is_some().then_some(RADIUS);
        let (rank, class) = ((!ranks.is_empty()).then_some(RANK), (!classes.is_empty()).then_some(CLASS));
        [radius, rank, class].into_iter().flatten()
    }

    /// The numbers of a sample in these columns.
    pub fn more_numbers(&self, sample: usize) -> impl Iterator<Item = Number> {
        let SurfaceSamples { ranks, classes, .. } = self.samples;
        let radius = self.radii.map(|radii| Number::Float(radii[sample] as f32));
        let rank = ranks.get(sample).map(|&rank| Number::Float(rank));
        let class = classes.get(sample).map(|&class| Number::Whole(class));
        [radius, rank, class].into_iter().flatten()
    }

    /// Writes all rows as binary numbers, little-endian and without gaps: x y z, nx ny nz, the triangle as an unsigned
    /// integer, u v, and radius, rank and class if there are any.
    pub fn write_binary(&self, writer: &mut impl Write) -> io::Result<()> {
        (0..self.samples.len()).try_for_each(|i| {
            let SurfaceSamples { positions, triangles, barycentrics, .. } = self.samples;
            write_floats(writer, &[positions[i], self.normals[i]])?;
            writer.write_all(&triangles[i].to_le_bytes())?;
            write_floats(writer, &[barycentrics[i]])?;
            self.more_numbers(i).try_for_each(|number| writer.write_all(&number.bytes()))
        })
    }
}

/// Writes vectors as little-endian floats.
pub fn write_floats<const N: usize>(writer: &mut impl Write, vectors: &[[f32; N]]) -> io::Result<()> {
    vectors.iter().flatten().try_for_each(|x| writer.write_all(&x.to_le_bytes()))
}

/// Writes points of the plane and the class of each, little-endian and without gaps; no classes are left out.
pub fn write_plane_binary(writer: &mut impl Write, points: &[[f32; 2]], classes: &[u32]) -> io::Result<()> {
    if classes.is_empty() {
        return write_floats(writer, points);
    }
    points.iter().zip(classes).try_for_each(|(&point, class)| {
        write_floats(writer, &[point])?;
        writer.write_all(&class.to_le_bytes())
    })
}
