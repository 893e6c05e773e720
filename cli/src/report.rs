//! `azulejo report`: measurements of the library as pages with plots.

mod adaptive;
mod kdrt;
mod page;
mod pictures;
mod statistics;
mod times;

use azulejo::{Context, Result};
use clap::Subcommand;

/// What to measure.
#[derive(Subcommand)]
pub enum Report {
    /// Measure bias, spectra and times of KDRT against the thesis and the unbiased reference; takes some minutes.
    Kdrt(kdrt::Kdrt),
    /// Draw and measure samples whose radius varies: a fading, an image in dots, a ramp of density.
    Adaptive(adaptive::Adaptive),
}

impl Report {
    pub fn run(&self, context: &Context) -> Result<()> {
        match self {
            Self::Kdrt(kdrt) => kdrt.run(context),
            Self::Adaptive(adaptive) => adaptive.run(context),
        }
    }
}
