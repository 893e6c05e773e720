//! The sums of `tests/sums.txt`, taken on WebAssembly by the same cases, for `test/sums.test.js`.

use std::sync::OnceLock;

use azulejo::{Context, Result};

#[path = "../../../../tests/sums/analysis.rs"]
mod analysis;
#[path = "../../../../tests/sums/list.rs"]
mod list;
#[path = "../../../../tests/sums/mesh_grid.rs"]
mod mesh_grid;
#[path = "../../../../tests/sums/meshes.rs"]
mod meshes;
#[path = "../../../../tests/sums/plane.rs"]
mod plane;
#[path = "../../../../tests/sums/plane_grid.rs"]
mod plane_grid;
#[path = "../../../../tests/sums/relaxation.rs"]
mod relaxation;
#[path = "../../../../tests/sums/surface.rs"]
mod surface;
#[path = "../../../../tests/sums/volume.rs"]
mod volume;

/// The lines of all calls.
fn sums() -> Result<String> {
    let (context, mut list) = (Context::new(1)?, list::List::default());
    let sets = plane::sums(&context, &mut list)?;
    relaxation::sums(&context, &sets, &mut list)?;
    let surface = surface::sums(&context, &mut list)?;
    analysis::sums(&context, &sets, &surface, &mut list)?;
    plane_grid::sums(&context, false, &mut list)?;
    mesh_grid::sums(&context, false, &mut list)?;
    volume::sums(&context, false, &mut list)?;
    Ok(list.to_string())
}

/// The lines, or the text of an error; made once.
fn text() -> &'static str {
    static TEXT: OnceLock<String> = OnceLock::new();
    TEXT.get_or_init(|| sums().unwrap_or_else(|error| error.to_string()))
}

/// Where the text is.
#[unsafe(no_mangle)]
pub extern "C" fn sums_text() -> *const u8 {
    text().as_ptr()
}

/// The number of its bytes.
#[unsafe(no_mangle)]
pub extern "C" fn sums_bytes() -> usize {
    text().len()
}
