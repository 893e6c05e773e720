//! `azulejo report dcr`: what relaxation makes of sets of the torus and of a bounded square (thesis chapter 4), beside others' methods.

mod bounded;
mod page;
mod quality;
mod sets;

use std::fs;
use std::io::Write;
use std::path::PathBuf;

use azulejo::{Boundary, Context, Domain, Error, Progress, Result};
use clap::Args;

use crate::draw::points;
use crate::output::Output;
use crate::progress::watched;
use quality::Measured;
use sets::{METHODS, Start};

#[derive(Args)]
pub struct Dcr {
    /// The directory of the page `dcr.md` and its pictures.
    #[arg(long, value_name = "DIRECTORY", default_value = "docs")]
    out: PathBuf,
    /// Measure few and small sets: to see the page, not to believe it.
    #[arg(long)]
    quick: bool,
}

/// How much is measured.
pub struct Effort {
    /// Points of a set, and sets of that size from each start: of the best method's, and of the thesis's, which is slow.
    pub best: &'static [(usize, u64)],
    pub thesis: &'static [(usize, u64)],
    /// The same of the best method's on a bounded square.
    pub bounded: &'static [(usize, u64)],
    /// Points of the sets that are drawn, one of the sizes of all methods.
    pub pictured: usize,
}

const FULL: Effort = Effort {
    best: &[(1000, 64), (4096, 16), (65_536, 2), (1_000_000, 1)],
    thesis: &[(1000, 8), (4096, 4), (65_536, 1)],
    bounded: &[(1000, 32), (4096, 16), (65_536, 4)],
    pictured: 65_536,
};
const QUICK: Effort = Effort { best: &[(300, 2), (1000, 1)], thesis: &[(300, 1)], bounded: &[(300, 2)], pictured: 300 };

/// Width of the pictures in pixels.
const PIXELS: u32 = 1000;

impl Dcr {
    pub fn run(&self, context: &Context) -> Result<()> {
        let effort = if self.quick { QUICK } else { FULL };
        let pictures = self.out.join("dcr");
        fs::create_dir_all(&pictures).map_err(|source| Error::Io { path: pictures.clone(), source })?;
        let page = Output::at(&self.out.join("dcr.md"))?;

        let mut measured = Vec::new();
        for method in METHODS {
            let measure = |progress: &Progress| Measured::all(context, method, &effort, progress);
            measured.extend(watched(method.name, measure)?);
        }
        let drawn = |one: &&Measured| one.count == effort.pictured && one.start == Start::Random;
        for one in measured.iter().filter(drawn) {
            let output = Output::at(&pictures.join(one.method.picture()))?;
            points::draw(context, &Domain::unit(Boundary::Periodic), &one.first, PIXELS, &output)?;
        }
        let at_borders = watched("bounded", |progress| bounded::Measured::all(context, effort.bounded, progress))?;
        let corners = at_borders.iter().filter(|one| one.count == effort.pictured && one.start == Start::Kdrt);
        let corners: Vec<_> = corners.map(|one| (one.name(), &*one.first)).collect();
        bounded::draw_corners(&corners, 2 * PIXELS, &Output::at(&pictures.join(page::CORNERS))?)?;
        let text = page::text(context, &effort, &measured, &at_borders, self.quick);
        page.write(|writer| writer.write_all(text.as_bytes()))
    }
}
