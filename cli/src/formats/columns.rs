//! The columns of files of points that only some sets have, and the numbers in them.

use std::fmt::{self, Display, Formatter};
use std::io::{self, Write};

/// A column that only some sets have.
#[derive(Clone, Copy)]
pub struct Column {
    pub name: &'static str,
    /// True if its numbers are unsigned integers; otherwise they are floats.
    is_whole: bool,
}

/// The radius of each sample, where they differ.
pub const RADIUS: Column = Column { name: "radius", is_whole: false };
/// The rank of each sample of a progressive order.
pub const RANK: Column = Column { name: "rank", is_whole: false };
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

/// Writes a position relative to an origin: as floats if that is 0, and in the frame of the origin as doubles otherwise.
pub fn write_position(writer: &mut impl Write, position: [f32; 3], origin: [f64; 3]) -> io::Result<()> {
    if origin == [0.0; 3] {
        return write_floats(writer, &[position]);
    }
    placed(position, origin).iter().try_for_each(|x| writer.write_all(&x.to_le_bytes()))
}

/// A position in the frame of its origin.
pub fn placed(position: [f32; 3], origin: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|axis| origin[axis] + f64::from(position[axis]))
}

/// Writes vectors as little-endian floats.
pub fn write_floats<const N: usize>(writer: &mut impl Write, vectors: &[[f32; N]]) -> io::Result<()> {
    vectors.iter().flatten().try_for_each(|x| writer.write_all(&x.to_le_bytes()))
}
