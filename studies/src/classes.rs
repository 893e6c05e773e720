//! `azulejo-studies classes`: sets of several classes (Wei 2010): shares, spectra, times.

mod inks;
mod mixes;
mod page;
mod pictures;
mod relaxed;
mod sets;
mod times;
mod wei;

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::{Context, Result};
use clap::Args;

use crate::args::{MeshArgs, PageArgs};
use crate::repeated::ROUNDS;
use azulejo_cli::progress::watched;
use relaxed::Relaxed;
use sets::{Measured, Tie};
use times::{Times, Windows};

/// The first line of the page.
const SUBJECT: &str = "Sets of several classes: the shares that classes get, their spectra, what they take, and \
    Wei's sets beside them.";

#[derive(Args)]
pub struct Study {
    #[command(flatten)]
    page: PageArgs,
    #[command(flatten)]
    meshes: MeshArgs,
}

/// The size of the study.
pub struct Effort {
    /// Samples that the class of the smallest radius would have alone, and sets of each kind.
    pub count: f64,
    pub sets: u64,
    /// The same where times are taken, and how often.
    pub timed: f64,
    pub rounds: usize,
    /// Samples of a window, and places of windows.
    pub window: f64,
    pub windows: u32,
    /// Of the picture of a mesh: samples of the smallest class alone, and width.
    pub pictured: f64,
    pub pixels: u32,
    /// Dots of the picture in inks.
    pub dots: usize,
}

const FULL: Effort = Effort {
    count: 5e3,
    sets: 5,
    timed: 1e5,
    rounds: ROUNDS,
    window: times::WINDOW,
    windows: 8,
    pictured: 3e4,
    pixels: 1000,
    dots: 30_000,
};

const QUICK: Effort = Effort {
    count: 6e2,
    sets: 2,
    timed: 1e3,
    rounds: 2,
    window: 5e2,
    windows: 1,
    pictured: 2e3,
    pixels: 400,
    dots: 2_000,
};

/// All that was measured.
struct Results {
    sets: Vec<Measured>,
    ties: Vec<Tie>,
    relaxed: Vec<Relaxed>,
    plane: Vec<Times>,
    /// The results on a mesh, if one was given.
    bunny: Option<Vec<Times>>,
    windows: Windows,
}

impl Study {
    pub fn run(&self, context: &Context) -> Result<()> {
        let effort = if self.page.quick { QUICK } else { FULL };
        let files = self.page.open("classes")?;

        let load = |path: &Option<_>| path.as_deref().map(|path| Ok(Arc::new(Mesh::load(path)?))).transpose();
        let [bunny, dragon]: [Option<Arc<Mesh>>; 2] = [load(&self.meshes.bunny)?, load(&self.meshes.dragon)?];
        let results = Results {
            sets: watched("sets", |progress| Measured::all(context, &effort, progress))?,
            ties: watched("ties", |_| Tie::all(context, &effort))?,
            relaxed: watched("relaxed", |progress| Relaxed::all(context, &effort, progress))?,
            plane: watched("plane", |_| Times::plane(&effort))?,
            bunny: watched("bunny", |_| bunny.map(|mesh| Times::mesh(&mesh, &effort)).transpose())?,
            windows: watched("windows", |_| Windows::measure(&effort))?,
        };

        pictures::draw_plane(&results.sets, &files.picture("plane")?)?;
        pictures::draw_spectra(&results.sets, &files.picture("spectra")?)?;
        pictures::draw_ties(&results.ties, &files.picture("ties")?)?;
        let picture = files.picture("inks")?;
        watched("inks", |progress| inks::draw(context, &effort, &picture, progress))?;
        if let Some(mesh) = &dragon {
            pictures::draw_mesh(context, "dragon", mesh, &effort, &files.picture("dragon")?)?;
        }
        let text = page::text(&effort, &results, dragon.is_some());
        files.write("Several classes, measured", SUBJECT, context.num_threads(), &text)
    }
}
