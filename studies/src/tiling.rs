//! `azulejo-studies tiling`: what else thesis chapter 2 measures and discusses about KDRT, measured again.

mod circumcentres;
pub mod claims;
mod counts;
mod levels;
mod patterns;
mod pieces;
mod randomness;
mod samplers;
mod seams;
mod spectra;
mod study;
mod thesis;

use azulejo::{Context, Result};
use clap::Args;

use crate::args::PageArgs;
use claims::Part;
use study::Study;

/// The first line of the page.
const SUBJECT: &str = "The thesis's claims about randomized tiling, each tested: subdivision, bias at the seams, \
    circumcentres, sizes of pattern and leaves, merged sets.";

#[derive(Args)]
pub struct Tiling {
    #[command(flatten)]
    page: PageArgs,
}

/// Measures, writes its pictures, and gives its part of the page.
type Section = fn(&Study) -> Result<Part>;

/// The sections in the order of the page. Each is a file of its own.
const SECTIONS: [Section; 8] = [
    levels::section,
    seams::section,
    circumcentres::section,
    counts::section,
    patterns::section,
    pieces::section,
    randomness::section,
    samplers::section,
];

impl Tiling {
    pub fn run(&self, context: &Context) -> Result<()> {
        let files = self.page.open("tiling")?;
        let study = Study { context, files: &files, quick: self.page.quick };
        let parts = SECTIONS.iter().map(|section| section(&study)).collect::<Result<Vec<_>>>()?;
        let mut text = introduction();
        text += &claims::tables(&parts);
        for part in &parts {
            text += &format!("\n{}", part.text);
        }
        files.write("Randomized tiling, measured", SUBJECT, context.num_threads(), &text)
    }
}

fn introduction() -> String {
    "Thesis: Wang 2019, chapter 2; its machine was a Core i7-4930K with a GTX 1080. What is not here is in \
     [docs/kdrt.md](kdrt.md). `r` is the radius, the smallest distance; *R_leaf* is the smallest side of a leaf; sets are of the \
     unit torus. Times are of one thread unless said otherwise, the least of some rounds in which all that is compared takes \
     turns, with their range, on a machine that may have had other work.\n\n"
        .to_owned()
}
