//! Files of points: PLY, NPY, CSV, XYZ and raw floats, in and out.
//!
//! | format | plane | surface | domain |
//! |---|---|---|---|
//! | PLY | `x y` | `x y z nx ny nz triangle u v` | in a comment |
//! | NPY | array of `(n, 2)` floats | array of `(n, 3)` floats: positions | - |
//! | CSV | columns `x,y` under a header | all columns of PLY under a header | - |
//! | XYZ | lines `x y 0` | lines `x y z nx ny nz` | - |
//! | raw | `x y` as little-endian floats | `x y z` as little-endian floats | - |
//!
//! What is read may have more: integers and doubles, big-endian arrays, other columns, comments.

#[cfg(test)]
mod hostile;
mod npy;
mod raw;
mod table;

use std::path::{Path, PathBuf};

use azulejo::{Domain, Error, Result, SurfaceSamples};
use clap::{Args, ValueEnum};

use crate::output::Output;
use crate::ply;

/// What a file of points holds, whoever wrote it.
#[derive(Debug, Default)]
pub struct PointSet {
    /// Positions; 0 where the file has no z.
    pub positions: Vec<[f32; 3]>,
    /// Normals, one for each position; empty if the file has none.
    pub normals: Vec<[f32; 3]>,
    /// For each point its triangle and barycentrics, where the file, PLY or CSV, has them.
    pub on_mesh: Option<(Vec<u32>, Vec<[f32; 2]>)>,
    /// The domain that the file names.
    pub domain: Option<Domain>,
}

impl PointSet {
    /// The positions without z.
    pub fn plane_positions(&self) -> Vec<[f32; 2]> {
        self.positions.iter().map(|&[x, y, _]| [x, y]).collect()
    }
}

/// What points are needed for, and so which coordinates.
#[derive(Clone, Copy, PartialEq)]
pub enum Coordinates {
    /// x and y; others are passed over.
    Plane,
    /// x, y and z.
    Space,
}

impl Coordinates {
    pub fn count(self) -> usize {
        match self {
            Self::Plane => 2,
            Self::Space => 3,
        }
    }
}

/// A format of points.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub enum Format {
    /// The Stanford polygon format, written as binary; it alone keeps the domain.
    Ply,
    /// An array of NumPy.
    Npy,
    /// Comma-separated values under a header.
    Csv,
    /// A point to a line, its numbers between spaces.
    Xyz,
    /// Little-endian 32-bit floats and nothing else.
    Raw,
}

impl Format {
    /// What the extension says; PLY if there is none.
    fn of(path: &Path) -> Result<Self> {
        let Some(extension) = path.extension() else { return Ok(Self::Ply) };
        match extension.to_string_lossy().to_lowercase().as_str() {
            "ply" => Ok(Self::Ply),
            "npy" => Ok(Self::Npy),
            "csv" => Ok(Self::Csv),
            "xyz" | "txt" => Ok(Self::Xyz),
            "raw" | "f32" | "bin" => Ok(Self::Raw),
            _ => Err(format_error(path, "the extension names no format of points: give ply, npy, csv, xyz or raw")),
        }
    }
}

fn format_error(path: &Path, reason: impl Into<String>) -> Error {
    Error::Format { path: path.into(), reason: reason.into() }
}

/// An error about points, with the file that they come from.
pub fn blame(path: &Path, error: Error) -> Error {
    match error {
        Error::InvalidArgument { argument: "xy" | "positions" | "normals", reason } => format_error(path, reason),
        Error::InvalidArgument { argument: argument @ ("triangles" | "barycentrics"), reason } => {
            format_error(path, format!("{argument}: {reason}"))
        }
        other => other,
    }
}

/// A word of a file as a message can show it: files may have anything in its place.
fn shortened(word: &str) -> String {
    word.chars().take(40).map(|letter| if letter.is_control() { ' ' } else { letter }).collect()
}

/// In which format points are read.
#[derive(Args)]
pub struct Input {
    /// The format of the input [default: by the extension].
    #[arg(long, value_enum, value_name = "FORMAT")]
    input_format: Option<Format>,
}

impl Input {
    /// Reads points, of which there is at least one, all finite.
    pub fn read(&self, path: &Path, coordinates: Coordinates) -> Result<PointSet> {
        let read_error = |source| Error::Io { path: path.into(), source };
        let format = self.input_format.map_or_else(|| Format::of(path), Ok);
        let bytes = std::fs::read(if path == Path::new("-") { Path::new("/dev/stdin") } else { path });
        let bytes = bytes.map_err(read_error)?;
        let set = match format? {
            Format::Ply => ply::parse(&bytes, coordinates),
            Format::Npy => npy::parse(&bytes, coordinates),
            Format::Csv | Format::Xyz => table::parse(&bytes, coordinates),
            Format::Raw => raw::parse(&bytes, coordinates),
        };
        let set = set.map_err(|reason| format_error(path, reason))?;
        if set.positions.is_empty() { Err(format_error(path, "no points")) } else { Ok(set) }
    }
}

/// Where points go to.
#[derive(Args)]
pub struct Destination {
    /// The samples: a .ply, .npy, .csv, .xyz or .raw file.
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// The format of the output [default: by the extension].
    #[arg(long, value_enum, value_name = "FORMAT")]
    format: Option<Format>,
}

impl Destination {
    /// Finds out before the work whether and how there can be a file.
    pub fn open(&self) -> Result<PointFile> {
        let output = Output::at(&self.output)?;
        let format = self.format.map_or_else(|| Format::of(&self.output), Ok)?;
        Ok(PointFile { output, format })
    }
}

/// A file of points to be written.
pub struct PointFile {
    pub output: Output,
    format: Format,
}

impl PointFile {
    /// Writes a set of the plane, with its domain if the format can name it.
    pub fn write_plane(&self, domain: &Domain, points: &[[f32; 2]]) -> Result<()> {
        match self.format {
            Format::Ply => ply::write_plane(&self.output, domain, points),
            Format::Npy => self.output.write(|writer| npy::write(writer, points)),
            Format::Csv => self.output.write(|writer| table::write_csv_plane(writer, points)),
            Format::Xyz => self.output.write(|writer| table::write_xyz_plane(writer, points)),
            Format::Raw => self.output.write(|writer| raw::write(writer, points)),
        }
    }

    /// Writes samples of a surface with these of their normals, and all else that the format has a place for.
    pub fn write_surface(&self, samples: &SurfaceSamples, normals: &[[f32; 3]]) -> Result<()> {
        match self.format {
            Format::Ply => ply::write_surface(&self.output, samples, normals),
            Format::Npy => self.output.write(|writer| npy::write(writer, &samples.positions)),
            Format::Csv => self.output.write(|writer| table::write_csv_surface(writer, samples, normals)),
            Format::Xyz => self.output.write(|writer| table::write_xyz_surface(writer, &samples.positions, normals)),
            Format::Raw => self.output.write(|writer| raw::write(writer, &samples.positions)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_names_the_format_in_any_case() {
        for (path, format) in [
            ("a.ply", Format::Ply),
            ("a.b.NPY", Format::Npy),
            ("dir.ply/a.csv", Format::Csv),
            ("a.txt", Format::Xyz),
            ("a.f32", Format::Raw),
            ("/dev/null", Format::Ply),
        ] {
            assert_eq!(Format::of(Path::new(path)).unwrap(), format, "{path}");
        }
        let said = Format::of(Path::new("a.png")).unwrap_err().to_string();
        assert!(said.starts_with("a.png: the extension names no format"), "{said}");
    }
}
