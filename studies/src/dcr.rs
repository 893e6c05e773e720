//! `azulejo-studies dcr`: what relaxation makes of sets of the torus and of a bounded square (thesis chapter 4), beside
//! others' methods.

pub mod bounded;
mod convergence;
mod density;
mod distributions;
mod measured;
pub mod others;
mod page;
mod radii;
mod remeshing;
pub mod sets;
mod spacing;
mod study;
mod surfaces;

use azulejo::{Boundary, Context, Domain, Progress, Result};
use clap::Args;

use crate::args::{MeshArgs, PageArgs};
use azulejo_cli::draw::points;
use azulejo_cli::progress::watched;
use measured::Measured;
use sets::{METHODS, Start};
use study::Study;

/// The first line of the page.
const SUBJECT: &str = "Relaxed sets of the plane and of meshes: regularity, holes, spectra and time of the \
    momentum method and of the thesis's, beside those of others.";

#[derive(Args)]
pub struct Dcr {
    #[command(flatten)]
    page: PageArgs,
    #[command(flatten)]
    meshes: MeshArgs,
}

/// The size of the study.
pub struct Effort {
    /// Points of a set, and sets of that size from each start: by the momentum method, and by the thesis's.
    pub momentum: &'static [(usize, u64)],
    pub thesis: &'static [(usize, u64)],
    /// The same by the momentum method on a bounded square.
    pub bounded: &'static [(usize, u64)],
    /// Points of the sets that are drawn, one of the sizes of all methods.
    pub pictured: usize,
}

const FULL: Effort = Effort {
    momentum: &[(1000, 64), (4096, 16), (65_536, 2), (1_000_000, 1)],
    thesis: &[(1000, 20), (4096, 20), (65_536, 20), (1_000_000, 1)],
    bounded: &[(1000, 32), (4096, 16), (65_536, 4)],
    pictured: 65_536,
};
const QUICK: Effort =
    Effort { momentum: &[(300, 2), (1000, 1)], thesis: &[(300, 1)], bounded: &[(300, 2)], pictured: 300 };

/// Measures, writes its pictures, and gives its text, from its `##` title on.
type Section = fn(&Study) -> Result<String>;

/// The sections that follow the tables of the methods, in the order of the page. Each is a file of its own.
const SECTIONS: [Section; 6] = [
    convergence::section,
    radii::section,
    distributions::section,
    remeshing::section,
    density::section,
    surfaces::section,
];

/// Width of the pictures in pixels.
const PIXELS: u32 = 1000;

impl Dcr {
    pub fn run(&self, context: &Context) -> Result<()> {
        let effort = if self.page.quick { QUICK } else { FULL };
        let files = self.page.open("dcr")?;

        let mut measured = Vec::new();
        for method in METHODS {
            let measure = |progress: &Progress| Measured::all(context, method, &effort, progress);
            measured.extend(watched(method.name, measure)?);
        }
        let drawn = |one: &&Measured| one.count == effort.pictured && one.start == Start::Random;
        for one in measured.iter().filter(drawn) {
            let output = files.picture(&one.method.picture())?;
            points::draw(context, &Domain::unit(Boundary::Periodic), &one.first, PIXELS, &output)?;
        }
        let bounded = watched("bounded", |progress| bounded::Measured::all(context, effort.bounded, progress))?;
        let corners = bounded.iter().filter(|one| one.count == effort.pictured && one.start == Start::Kdrt);
        let corners: Vec<_> = corners.map(|one| (one.name(), &*one.first)).collect();
        bounded::draw_corners(&corners, 2 * PIXELS, &files.picture("corners")?)?;
        let study = Study {
            context,
            files: &files,
            quick: self.page.quick,
            bunny: self.meshes.bunny.as_deref(),
            dragon: self.meshes.dragon.as_deref(),
        };
        let others = others::Measured::all(&study)?;
        let mut text = page::text(&effort, &measured, &others, &bounded);
        text += &format!("\n{}", others::section(&study, &others)?);
        for section in SECTIONS {
            text += &format!("\n{}", section(&study)?);
        }
        files.write("DCR, measured", SUBJECT, context.num_threads(), &text)
    }
}
