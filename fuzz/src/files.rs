//! Mesh files.

use std::ffi::CString;
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use azulejo_c::mesh::azulejo_mesh_load;

use crate::calls::create;
use crate::input::Input;
use crate::surface;

/// Loads a file of these bytes, once by its extension and once by what it begins with, and samples the mesh if it is one.
/// The options of the sampler follow from the bytes, too.
pub fn load_and_sample(extension: &str, bytes: &[u8]) {
    for path in [path(extension), path("")] {
        fs::write(path, bytes).expect("the file can be written");
        let name = CString::new(path.as_os_str().as_bytes()).expect("a path without NUL");
        // SAFETY: the string ends with a NUL.
        if let Some(mesh) = create(|out| unsafe { azulejo_mesh_load(name.as_ptr(), out) }) {
            surface::sample(&mesh, &mut Input::new(bytes));
        }
    }
}

/// A file of this process's, in memory where there is such a folder; the target knows two of them.
fn path(extension: &str) -> &'static Path {
    static PATHS: OnceLock<[PathBuf; 2]> = OnceLock::new();
    let paths = PATHS.get_or_init(|| {
        let memory = Path::new("/dev/shm");
        let folder = if memory.is_dir() { memory.to_owned() } else { std::env::temp_dir() };
        let file = folder.join(format!("azulejo-fuzz-{}", std::process::id()));
        [file.with_extension(extension), file]
    });
    &paths[usize::from(extension.is_empty())]
}
