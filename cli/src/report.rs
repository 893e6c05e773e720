//! `azulejo report`: measurements of the library as pages with plots.

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
}

impl Report {
    pub fn run(&self, context: &Context) -> Result<()> {
        match self {
            Self::Kdrt(kdrt) => kdrt.run(context),
        }
    }
}
