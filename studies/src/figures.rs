//! `azulejo-studies figures`: figures of the thesis that belong to none of the other pages.

mod chains;
mod correlation;
mod engines;
mod lights;
mod pins;
mod stipple;

use std::path::PathBuf;

use azulejo::{Context, Result};
use clap::Args;

use crate::args::{MeshArgs, PageArgs};

/// The first line of the page.
const SUBJECT: &str = "The thesis's smaller experiments, done again: pair correlation, rasteriser, all projectors \
    at once, boundaries, stipples and light sources.";

#[derive(Args)]
pub struct Figures {
    #[command(flatten)]
    page: PageArgs,
    #[command(flatten)]
    meshes: MeshArgs,
    /// The program `lights` of `examples_c/`; left out if it is not given.
    #[arg(long, value_name = "PROGRAM")]
    lights: Option<PathBuf>,
}

impl Figures {
    pub fn run(&self, context: &Context) -> Result<()> {
        let (files, quick) = (self.page.open("figures")?, self.page.quick);
        let parts = [
            "Thesis: Wang 2019.\n".to_owned(),
            correlation::section(context, &files, quick)?,
            engines::section(context, &self.meshes, quick)?,
            chains::section(context, &self.meshes, quick)?,
            pins::section(context, &files, quick)?,
            stipple::section(context, &files, quick)?,
            lights::section(self.lights.as_deref(), quick)?,
        ];
        files.write("Other figures of the thesis, measured", SUBJECT, context.num_threads(), &parts.join("\n"))
    }
}
