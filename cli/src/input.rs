//! The input of commands: whole files, or the standard input.

use std::fs;
use std::io::{self, Read};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use azulejo::mesh::Mesh;
use azulejo::{Error, Result};

/// True once the standard input has been read: a second reader would find nothing.
static STDIN_IS_READ: AtomicBool = AtomicBool::new(false);

/// The contents of a file, or of the standard input for `-`.
pub fn bytes(path: &Path) -> Result<Vec<u8>> {
    let error = |source| Error::Io { path: path.into(), source };
    if path != Path::new("-") {
        return fs::read(path).map_err(error);
    }
    if STDIN_IS_READ.swap(true, Ordering::Relaxed) {
        return Err(error(io::Error::other("the standard input can be read only once")));
    }
    let mut bytes = Vec::new();
    io::stdin().lock().read_to_end(&mut bytes).map_err(error)?;
    Ok(bytes)
}

/// The mesh of a file, or of the standard input for `-`: by the extension, or by its contents if that names no format.
pub fn mesh(path: &Path) -> Result<Mesh> {
    // Only regular files are loaded: a device may have no end.
    if path == Path::new("-") { Mesh::parse(path, &bytes(path)?) } else { Mesh::load(path) }
}

/// The mesh of a file whose inside is meant, which has no samples on triangles that would tell where it was moved from.
pub fn mesh_at_origin(path: &Path) -> Result<Mesh> {
    let mesh = mesh(path)?;
    if mesh.origin() != [0.0; 3] {
        let reason = "coordinates so far from the origin that floats would displace its samples: move it there first";
        return Err(Error::Format { path: path.to_owned(), reason: reason.to_owned() });
    }
    Ok(mesh)
}
