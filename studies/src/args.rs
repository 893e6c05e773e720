//! The arguments that the commands have in common.

use std::path::PathBuf;

use azulejo::Result;
use clap::Args;

use crate::files::Files;

/// Options of every page.
#[derive(Args)]
pub struct PageArgs {
    /// The directory of the page and its pictures.
    #[arg(long, value_name = "DIRECTORY", default_value = "docs")]
    out: PathBuf,
    /// Measure few and small sets: to see the page, not to believe it.
    #[arg(long)]
    pub quick: bool,
}

impl PageArgs {
    /// The files of the page of this name.
    pub fn open(&self, name: &'static str) -> Result<Files> {
        Files::open(&self.out, name, self.quick)
    }
}

/// The meshes of others.
#[derive(Args)]
pub struct MeshArgs {
    /// The Stanford bunny: OBJ, PLY or STL; left out if it is not given.
    #[arg(long, value_name = "MESH")]
    pub bunny: Option<PathBuf>,
    /// The Stanford dragon: OBJ, PLY or STL; left out if it is not given.
    #[arg(long, value_name = "MESH")]
    pub dragon: Option<PathBuf>,
}
