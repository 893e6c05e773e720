//! `azulejo-studies gallery`: samplers side by side, as in the thesis's fig. 4.16 and 4.17 and the third row of fig.
//! 2.12.

mod measured;
mod page;
mod pictures;
mod samplers;
pub mod zone_plate;

use azulejo::{Context, Progress, Result};
use clap::Args;

use crate::args::PageArgs;
use azulejo_cli::progress::watched;
use measured::Measured;
use samplers::{RELAXED, SAMPLERS, Sampler};

/// The first line of the page.
const SUBJECT: &str = "Points, spectra and a zone plate of the samplers that the thesis compares, by the same \
    program.";

#[derive(Args)]
pub struct Gallery {
    #[command(flatten)]
    page: PageArgs,
}

/// The size of the study.
pub struct Effort {
    /// Points of a set: those of `side` by `side` cells.
    pub side: usize,
    /// The numbers of sets of each sampler, and of a slow one.
    pub sets: u64,
    pub slow_sets: u64,
}

const FULL: Effort = Effort { side: 256, sets: 10, slow_sets: 2 };
const QUICK: Effort = Effort { side: 32, sets: 2, slow_sets: 1 };

impl Gallery {
    pub fn run(&self, context: &Context) -> Result<()> {
        let effort = if self.page.quick { QUICK } else { FULL };
        let files = self.page.open("gallery")?;

        let samplers: Vec<Sampler> = SAMPLERS.into_iter().chain(RELAXED).collect();
        let mut measured = Vec::new();
        for sampler in samplers {
            let measure = |progress: &Progress| Measured::of(context, sampler, &effort, progress);
            measured.push(watched("gallery", measure)?);
        }
        let (direct, relaxed) = measured.split_at(SAMPLERS.len());
        pictures::draw_sets(direct, &files.picture("samplers")?)?;
        pictures::draw_sets(relaxed, &files.picture("relaxed")?)?;
        pictures::draw_plates(&measured, effort.side, &files.picture("zone-plate")?)?;
        files.write("Samplers side by side", SUBJECT, context.num_threads(), &page::text(&effort, &measured))
    }
}
