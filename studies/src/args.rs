//! Where the page of a report goes, and what it is about.

use std::fs;
use std::path::PathBuf;

use azulejo::{Error, Result};
use clap::Args;

use azulejo_cli::output::Output;

/// What all reports have.
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
    /// The page of this name, and the folder of its pictures, which is made.
    pub fn open(&self, name: &str) -> Result<(Output, PathBuf)> {
        let pictures = self.out.join(name);
        fs::create_dir_all(&pictures).map_err(|source| Error::Io { path: pictures.clone(), source })?;
        Ok((Output::at(&self.out.join(format!("{name}.md")))?, pictures))
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
