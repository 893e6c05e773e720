//! The calls whose sums are kept: for `tests/sums.rs`, and for the same calls on WebAssembly (`bindings/js/sums`).

pub mod list;

mod analysis;
mod mask;
mod mesh_grid;
mod meshes;
mod plane;
mod plane_grid;
mod relaxation;
mod surface;
mod volume;

use azulejo::{Context, Result};

use list::List;

/// The sums of all calls.
pub fn sums(context: &Context) -> Result<List> {
    let mut list = List::default();
    let sets = plane::sums(context, &mut list)?;
    relaxation::sums(context, &sets, &mut list)?;
    let surface = surface::sums(context, &mut list)?;
    analysis::sums(context, &sets, &surface, &mut list)?;
    grids(context, false, &mut list)?;
    Ok(list)
}

/// The sums of small sets alone.
pub fn few_sums(context: &Context) -> Result<List> {
    let mut list = List::default();
    grids(context, true, &mut list)?;
    Ok(list)
}

/// Adds those of the grids, on small sets or large ones, of volumes and of masks.
fn grids(context: &Context, small: bool, list: &mut List) -> Result<()> {
    plane_grid::sums(context, small, list)?;
    mesh_grid::sums(context, small, list)?;
    volume::sums(context, small, list)?;
    mask::sums(context, small, list)
}
