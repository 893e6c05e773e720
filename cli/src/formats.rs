//! Files of points: PLY, NPY, CSV, XYZ and raw floats, in and out.
//!
//! | format | plane, cuboid | surface | domain |
//! |---|---|---|---|
//! | PLY | `x y z`, in the plane z being 0, and perhaps `radius`, `rank`, `class` | `x y z nx ny nz triangle u v` and perhaps `radius`, `rank`, `class` | in a comment |
//! | NPY | array of `(n, 2)` or `(n, 3)` floats; structured array of `x y`, in a cuboid `z`, and `radius`, `rank` or `class` | structured array of `position normal triangle barycentrics` and perhaps `radius`, `rank`, `class` | - |
//! | CSV | columns `x,y`, in a cuboid `z`, and perhaps `radius`, `rank`, `class` under a header | all columns of PLY under a header | - |
//! | XYZ | lines `x y 0` or `x y z` | lines `x y z nx ny nz` | - |
//! | raw | `x y` or `x y z` as little-endian floats | - | - |
//! | USD | points or instances in space | the same with normals | - |
//! | GLB | instances in space | the same, turned to the normals | - |
//!
//! USD and GLB are for scenes: they are written, not read. The others are read, too.
//!
//! Input may have more: integers and doubles, big-endian arrays, other columns, comments. The number of dimensions, two
//! or three, follows from the file, except for raw floats, where the user states it. Ranks are not read: the order of
//! the points holds the same information.

pub mod columns;
mod glb;
#[cfg(test)]
mod hostile;
mod npy;
pub mod points;
mod raw;
mod records;
mod scene;
pub mod set;
pub mod surface;
mod table;
mod usda;

use std::path::{Path, PathBuf};

use azulejo::{Centred, Domain, Error, Result};
use clap::builder::PossibleValue;
use clap::{Args, ValueEnum};

use crate::input;
use crate::output::{Output, Writing};
use crate::ply;
use columns::write_floats;
use npy::Grid;
use points::PointTable;
use records::Records;
use scene::Scene;
use set::{PlaneSet, PointSet, SampleSet};
use surface::SurfaceTable;

/// The remedy for samples of a mesh where a set of the plane is needed.
pub const ON_MESH: &str = "give the mesh that they lie on by --mesh";

/// A format of points.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub enum Format {
    /// The Stanford polygon format, written as binary; it alone keeps the domain.
    Ply,
    /// A NumPy array: two columns for the plane, three for a cuboid, a structured array for samples of a mesh.
    Npy,
    /// Comma-separated values under a header.
    Csv,
    /// One point per line, coordinates between spaces; of samples of a mesh the positions and normals alone.
    Xyz,
    /// Little-endian 32-bit floats without a header, for points of the plane or of a cuboid.
    Raw,
}

/// A format of scenes, which are written, not read.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum SceneFormat {
    /// OpenUSD as text: points whose widths are their radii, with ranks and classes as primvars.
    Usda,
    /// OpenUSD as text: instances, with a prototype for each class.
    UsdaInstances,
    /// Binary glTF: instances (EXT_mesh_gpu_instancing), with a mesh for each class.
    Glb,
}

impl SceneFormat {
    /// The format that the extension names.
    fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_string_lossy().to_lowercase().as_str() {
            "usda" => Some(Self::Usda),
            "glb" => Some(Self::Glb),
            _ => None,
        }
    }
}

/// A format that points are written in.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Written {
    Points(Format),
    Scene(SceneFormat),
}

impl ValueEnum for Written {
    fn value_variants<'a>() -> &'a [Self] {
        const ALL: [Written; 8] = [
            Written::Points(Format::Ply),
            Written::Points(Format::Npy),
            Written::Points(Format::Csv),
            Written::Points(Format::Xyz),
            Written::Points(Format::Raw),
            Written::Scene(SceneFormat::Usda),
            Written::Scene(SceneFormat::UsdaInstances),
            Written::Scene(SceneFormat::Glb),
        ];
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        match self {
            Self::Points(format) => format.to_possible_value(),
            Self::Scene(format) => format.to_possible_value(),
        }
    }
}

impl Written {
    /// The format that the extension names; PLY if there is none.
    fn of(path: &Path) -> Result<Self> {
        SceneFormat::of(path).map_or_else(|| Format::of(path).map(Self::Points), |format| Ok(Self::Scene(format)))
    }
}

impl Format {
    /// The format that the extension names; PLY if there is none.
    fn of(path: &Path) -> Result<Self> {
        let Some(extension) = path.extension() else { return Ok(Self::Ply) };
        match extension.to_string_lossy().to_lowercase().as_str() {
            "ply" => Ok(Self::Ply),
            "npy" => Ok(Self::Npy),
            "csv" => Ok(Self::Csv),
            "xyz" | "txt" => Ok(Self::Xyz),
            "raw" | "f32" | "bin" => Ok(Self::Raw),
            "usda" | "glb" => Err(format_error(path, "scenes are written, not read: give ply, npy, csv, xyz or raw")),
            other => {
                let other = shortened(other);
                let reason =
                    format!("the extension .{other} names no format of points: give ply, npy, csv, xyz or raw");
                Err(format_error(path, reason))
            }
        }
    }
}

fn format_error(path: &Path, reason: impl Into<String>) -> Error {
    Error::Format { path: path.into(), reason: reason.into() }
}

/// An error about points or radii, with the file that they come from.
pub fn blame(path: &Path, error: Error) -> Error {
    match error {
        Error::InvalidArgument { argument: "positions" | "normals", reason } => format_error(path, reason),
        Error::InvalidArgument {
            argument:
                argument @ ("triangles" | "barycentrics" | "given_positions" | "given_clearances" | "classes"
                | "grid_values" | "grid_size"),
            reason,
        }
        | Error::TooLarge { argument: argument @ "grid_values", reason } => {
            format_error(path, format!("{argument}: {reason}"))
        }
        other => other,
    }
}

/// A word of a file as a message can show it: short and on one line.
fn shortened(word: &str) -> String {
    word.chars().take(40).map(|letter| if letter.is_control() { ' ' } else { letter }).collect()
}

/// The arguments that points are read by.
#[derive(Args)]
pub struct Input {
    /// The format of the input [default: by the extension; PLY without one].
    #[arg(long, value_enum, value_name = "FORMAT")]
    input_format: Option<Format>,
    /// The number of coordinates of each point of the input. Required for .raw files, which do not record it.
    #[arg(long, value_name = "2|3", value_parser = clap::value_parser!(u8).range(2..=3))]
    dimensions: Option<u8>,
}

impl Input {
    /// Reads a set of the plane. The error for a set in space names the remedy, `instead`.
    pub fn read_plane(&self, path: &Path, instead: &str) -> Result<PlaneSet> {
        self.read(path)?.into_plane(instead).map_err(|reason| format_error(path, reason))
    }

    /// Reads samples in space, relative to the origin of their mesh.
    pub fn read_samples(&self, path: &Path, origin: [f64; 3]) -> Result<SampleSet> {
        self.read(path)?.into_samples(origin).map_err(|reason| format_error(path, reason))
    }

    /// Reads a cloud of points with all that is known of them.
    pub fn read_cloud(&self, path: &Path) -> Result<Cloud> {
        let format = self.format_of(path)?;
        let bytes = input::bytes(path)?;
        let set = |bytes| self.parse(path, format, bytes).map(PointSet::into_positions);
        let (positions, records) = match format {
            Format::Ply => {
                let positions = ply::positions(&bytes).map_err(|reason| format_error(path, reason))?;
                (positions, Records::of_ply(bytes))
            }
            Format::Csv | Format::Xyz => {
                let positions = set(&bytes)?;
                let count = positions.len();
                (positions, Records::of_table(bytes, count))
            }
            Format::Raw => {
                let positions = set(&bytes)?;
                let count = positions.len();
                (positions, Ok(Records::of_raw(bytes, count)))
            }
            Format::Npy => {
                let reason = "records of NumPy arrays are not copied: give the cloud as .ply, .csv, .xyz or .raw";
                return Err(format_error(path, reason));
            }
        };
        let records = records.map_err(|reason| format_error(path, reason))?;
        Ok(Cloud { format, positions: Centred::of(&positions), records })
    }

    /// Reads points, of which there is at least one, all finite.
    fn read(&self, path: &Path) -> Result<PointSet> {
        let format = self.format_of(path);
        self.parse(path, format?, &input::bytes(path)?)
    }

    fn format_of(&self, path: &Path) -> Result<Format> {
        self.input_format.map_or_else(|| Format::of(path), Ok)
    }

    fn parse(&self, path: &Path, format: Format, bytes: &[u8]) -> Result<PointSet> {
        let set = match (format, self.dimensions) {
            (Format::Ply, _) => ply::parse(bytes),
            (Format::Npy, _) => npy::parse(bytes),
            (Format::Csv | Format::Xyz, _) => table::parse(bytes),
            (Format::Raw, Some(dimensions)) => raw::parse(bytes, dimensions),
            (Format::Raw, None) => {
                Err("raw floats do not say how many coordinates a point has: give --dimensions 2 or 3".to_owned())
            }
        };
        let set = set.map_err(|reason| format_error(path, reason))?;
        if set.is_empty() {
            return Err(format_error(path, "no points"));
        }
        match self.dimensions {
            Some(dimensions) if !set.has_dimensions(dimensions) => {
                Err(format_error(path, format!("its points do not have {dimensions} dimensions, as --dimensions says")))
            }
            _ => Ok(set),
        }
    }
}

/// Reads samples in space that are given, in a format by their extension, relative to the origin of their mesh.
pub fn read_given(path: &Path, origin: [f64; 3]) -> Result<SampleSet> {
    let dimensions = (Format::of(path)? == Format::Raw).then_some(3);
    Input { input_format: None, dimensions }.read_samples(path, origin)
}

/// Reads radii on a grid: an array of NumPy, whatever its name.
pub fn read_grid(path: &Path) -> Result<Grid> {
    npy::parse_grid(&input::bytes(path)?).map_err(|reason| format_error(path, reason))
}

/// Points of a file, some of which are to be written as they stand in it.
pub struct Cloud {
    format: Format,
    positions: Centred<3>,
    records: Records,
}

impl Cloud {
    /// The positions in space, in the plane z = 0 where there is no z, near an origin of their own.
    pub fn positions(&self) -> &[[f32; 3]] {
        &self.positions.positions
    }

    /// The radius by which two points as rounded are at least `radius` apart as they stand in the file.
    pub fn lengthened(&self, radius: f64) -> f64 {
        Centred::<3>::lengthened(radius, self.positions.rounding)
    }

    /// Refuses a name with the extension of another format than that of the cloud, which is kept.
    pub fn check_output(&self, path: &Path) -> Result<()> {
        if path.extension().is_none() || Format::of(path)? == self.format {
            return Ok(());
        }
        Err(format_error(path, "the extension names another format than that of the cloud, which is kept"))
    }

    /// Refuses a cloud that has ranks already where others are to be written.
    pub fn check_ranks(&self, path: &Path) -> Result<()> {
        if self.records.has_ranks() { Err(format_error(path, "has a column rank already")) } else { Ok(()) }
    }

    /// Writes some of the points, in this order, with their ranks if there are any.
    pub fn write(&self, output: &Output, indices: &[u32], ranks: &[f32]) -> Result<()> {
        output.write(|writer| self.records.write(writer, indices, ranks))
    }
}

/// The destination of points.
#[derive(Args)]
pub struct Destination {
    /// The samples: a .ply, .npy, .csv or .xyz file, or .raw unless they lie on a mesh; or a scene, .usda or .glb.
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// The format of the output [default: by the extension].
    #[arg(long, value_enum, value_name = "FORMAT")]
    format: Option<Written>,
    #[command(flatten)]
    pub writing: Writing,
}

impl Destination {
    /// Checks before the work whether and how a file of a set of the plane or of a cuboid can be written.
    pub fn open_points(&self) -> Result<PointFile> {
        let output = self.writing.at(&self.output)?;
        let format = self.format.map_or_else(|| Written::of(&self.output), Ok)?;
        Ok(PointFile { output, format })
    }

    /// Checks before the work whether and how a file of a set of the plane of several classes can be written.
    pub fn open_classes(&self) -> Result<PointFile> {
        let file = self.open_points()?;
        if matches!(file.format, Written::Points(Format::Raw | Format::Xyz)) {
            let reason = "this format has no place for the classes of samples: give .ply, .npy or .csv";
            return Err(format_error(&self.output, reason));
        }
        Ok(file)
    }

    /// Checks before the work whether and how a file of samples of a surface can be written.
    pub fn open_surface(&self) -> Result<PointFile> {
        let file = self.open_points()?;
        if file.format == Written::Points(Format::Raw) {
            let reason = "raw floats have no place for the normals, triangles and barycentrics of samples: \
                          give .ply, .npy or .csv, or .xyz for positions and normals";
            return Err(format_error(&self.output, reason));
        }
        Ok(file)
    }
}

/// A file of points to be written.
pub struct PointFile {
    pub output: Output,
    format: Written,
}

impl PointFile {
    /// Writes a set of the plane or of a cuboid, with its domain and every column that the format has.
    pub fn write_points<const D: usize>(&self, domain: &Domain<D>, table: &PointTable<D>) -> Result<()> {
        let format = match self.format {
            Written::Points(format) => format,
            Written::Scene(format) => return self.write_scene(format, &Scene::of_points(table)),
        };
        match format {
            Format::Ply => ply::write_points(&self.output, domain, table),
            Format::Npy => self.output.write(|writer| npy::write_points(writer, table)),
            Format::Csv => self.output.write(|writer| table::write_csv_points(writer, table)),
            Format::Xyz => self.output.write(|writer| table::write_xyz_points(writer, table.points)),
            Format::Raw => self.output.write(|writer| write_floats(writer, table.points)),
        }
    }

    /// Writes samples of a surface, with every column that the format has.
    pub fn write_surface(&self, table: &SurfaceTable) -> Result<()> {
        let format = match self.format {
            Written::Points(format) => format,
            Written::Scene(format) => return self.write_scene(format, &Scene::of_surface(table)),
        };
        match format {
            Format::Ply => ply::write_surface(&self.output, table),
            Format::Npy => self.output.write(|writer| npy::write_surface(writer, table)),
            Format::Csv => self.output.write(|writer| table::write_csv_surface(writer, table)),
            Format::Xyz => self.output.write(|writer| table::write_xyz_surface(writer, table)),
            Format::Raw => unreachable!("refused by Destination::open_surface"),
        }
    }

    fn write_scene(&self, format: SceneFormat, scene: &Scene) -> Result<()> {
        self.output.write(|writer| match format {
            SceneFormat::Usda => usda::write_points(writer, scene),
            SceneFormat::UsdaInstances => usda::write_instances(writer, scene),
            SceneFormat::Glb => glb::write(writer, scene),
        })
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
        assert!(said.starts_with("a.png: the extension .png names no format"), "{said}");
        let said = Format::of(Path::new("a.usda")).unwrap_err().to_string();
        assert!(said.starts_with("a.usda: scenes are written, not read"), "{said}");
        assert_eq!(Written::of(Path::new("a.GLB")).unwrap(), Written::Scene(SceneFormat::Glb));
    }
}
