//! Meshes from files.

use std::fs::File;
use std::io::Cursor;
use std::path::Path;

use crate::centred::Centred;
use crate::error::{Error, Result};
use crate::mesh::source::{Input, Source};
use crate::mesh::surface::Mesh;
use crate::mesh::{glb, obj, off, ply, stl};

impl Mesh {
    /// Reads an OBJ, PLY, STL, OFF or binary glTF file: by the extension `.obj`, `.ply`, `.stl`, `.off` or `.glb`, otherwise by
    /// its first bytes.
    ///
    /// Polygons are cut into fans, in the order of the faces. Of glTF the meshes of all nodes of the scene are read, placed as
    /// the nodes say, one after the other. Normals of corners (OBJ `vn`) and vertices (PLY `nx`, `ny`, `nz`; `NOFF`; glTF)
    /// are read; where a file has some, a corner without, or with one that is not finite, has the normal
    /// zero. Points, lines, materials, texture coordinates, colours and groups are ignored, as are the normals of STL
    /// facets, and STL vertices are not merged. Memory stays proportional to the size of the file, whatever its header
    /// claims.
    ///
    /// Coordinates that a file has in text or doubles, so far from the origin that floats would displace them by more than
    /// a millionth of the mesh's size, are moved to an [origin](Mesh::origin), for which the file is read once more.
    ///
    /// A file is read block by block, in one pass, and never in memory as a whole: O(size). The exception is an OBJ
    /// file with rare syntax, such as continued lines, or with an error, which takes longer as well; and glTF.
    ///
    /// # Errors
    /// [`Error::Io`] where the file cannot be read (or is not a regular file), [`Error::Format`] where it is broken or
    /// its contents are not what [`Mesh::new`] takes.
    pub fn load(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        let io_error = |source| Error::Io { path: path.to_owned(), source };
        let kind = std::fs::metadata(path).map_err(io_error)?.file_type();
        if !kind.is_file() {
            let what = if kind.is_dir() { "is a directory" } else { "is not a regular file" };
            return Err(io_error(std::io::Error::other(what)));
        }
        let mut file = File::open(path).map_err(io_error)?;
        let length = file.metadata().map_err(io_error)?.len();
        read(path, &mut file, length)
    }

    /// [`Mesh::load`] for the contents of a file that are in memory, such as those of a pipe or an archive. The
    /// extension of `path` names the format, and messages name `path`; nothing is read from there.
    ///
    /// # Errors
    /// [`Error::Format`] where the contents are broken or not what [`Mesh::new`] takes.
    pub fn parse(path: impl AsRef<Path>, bytes: &[u8]) -> Result<Self> {
        read(path.as_ref(), &mut Cursor::new(bytes), bytes.len() as u64)
    }
}

fn read(path: &Path, input: &mut dyn Input, length: u64) -> Result<Mesh> {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
    let mut source = Source::new(input, length);
    let (parse, doubles): (Parse<Soup>, Parse<Vec<[f64; 3]>>) = match extension.as_deref() {
        Some("obj") => (obj::parse, obj::doubles),
        Some("ply") => (ply::parse, ply::doubles),
        Some("stl") => (stl::parse, stl::doubles),
        Some("off") => (off::parse, off::doubles),
        Some("glb" | "gltf") => (glb::parse, glb::doubles),
        _ if ply::is_likely(&mut source) => (ply::parse, ply::doubles),
        _ if glb::is_likely(&mut source) => (glb::parse, glb::doubles),
        _ if off::is_likely(&mut source) => (off::parse, off::doubles),
        _ if stl::is_likely(&mut source) => (stl::parse, stl::doubles),
        _ => (obj::parse, obj::doubles),
    };
    let mut soup = passed(path, source, parse)?;
    if soup.triangles.is_empty() && !matches!(extension.as_deref(), Some("obj" | "ply" | "stl" | "off" | "glb")) {
        return Err(format_error(path, "holds no mesh in a format that is read: OBJ, PLY, STL, OFF, GLB".to_owned()));
    }
    let mut origin = [0.0; 3];
    if is_far(&soup.positions) {
        input.rewind().map_err(|source| Error::Io { path: path.to_owned(), source })?;
        let centred = Centred::of(&passed(path, Source::new(input, length), doubles)?);
        (soup.positions, origin) = (centred.positions, centred.origin);
    }
    let mesh = checked(soup).map_err(|error| format_error(path, error.to_string()))?;
    Ok(mesh.with_origin(origin))
}

type Parse<T> = fn(&mut Source) -> std::result::Result<T, String>;

/// The contents of a file, in one pass.
fn passed<T>(path: &Path, mut source: Source, parse: Parse<T>) -> Result<T> {
    let contents = parse(&mut source);
    match source.failure() {
        Some(source) => Err(Error::Io { path: path.to_owned(), source }),
        None => contents.map_err(|reason| format_error(path, reason)),
    }
}

fn format_error(path: &Path, reason: String) -> Error {
    Error::Format { path: path.to_owned(), reason }
}

/// True if these floats may have been displaced far enough by rounding for another look at the file.
fn is_far(positions: &[[f32; 3]]) -> bool {
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for position in positions {
        for axis in 0..3 {
            low[axis] = low[axis].min(position[axis]);
            high[axis] = high[axis].max(position[axis]);
        }
    }
    let extent = (0..3).map(|axis| f64::from(high[axis]) - f64::from(low[axis])).fold(0.0, f64::max);
    let largest = low.into_iter().chain(high).fold(0f32, |largest, x| largest.max(x.abs()));
    // A rounding is at most 2^-24 of the coordinate; the extent is that of the doubles up to two of them.
    f64::from(largest) > 8.0 * extent
}

/// Checks the contents of a file. A normal that is not finite counts as none.
fn checked(mut soup: Soup) -> Result<Mesh> {
    let mesh = Mesh::new(soup.positions, soup.triangles)?;
    if soup.normals.is_empty() {
        return Ok(mesh);
    }
    for normal in &mut soup.normals {
        if normal.iter().any(|x| !x.is_finite()) {
            *normal = [0.0; 3];
        }
    }
    mesh.with_normals(soup.normals, soup.normal_indices)
}

/// The contents of a file, not yet checked.
#[derive(Default)]
pub(super) struct Soup {
    pub positions: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
    /// Normals, as [`Mesh::with_normals`](crate::mesh::Mesh::with_normals) takes them, except that they need not be
    /// finite; none at all if it is empty.
    pub normals: Vec<[f32; 3]>,
    pub normal_indices: Option<Vec<[u32; 3]>>,
}
