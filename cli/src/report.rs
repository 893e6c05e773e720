//! `azulejo report`: measurements of the library as pages with plots.

mod adaptive;
mod dcr;
mod gallery;
mod head;
mod kdrt;
mod page;
mod pictures;
mod place;
mod psp;
mod statistics;
mod times;

use azulejo::{Context, Result};
use clap::Subcommand;

/// What to measure.
#[derive(Subcommand)]
pub enum Report {
    /// Measure bias, spectra and times of KDRT against the thesis and the unbiased reference; takes some minutes.
    Kdrt(kdrt::Kdrt),
    /// Measure rates, density and bias of PSP on meshes against the thesis; takes some minutes.
    Psp(psp::Psp),
    /// Measure what DCR makes of random and of KDRT's sets, against others' methods; takes some minutes.
    Dcr(dcr::Dcr),
    /// Show samplers side by side: points, spectra and a zone plate; takes some minutes.
    Gallery(gallery::Gallery),
}

impl Report {
    pub fn run(&self, context: &Context) -> Result<()> {
        match self {
            Self::Kdrt(kdrt) => kdrt.run(context),
            Self::Psp(psp) => psp.run(context),
            Self::Dcr(dcr) => dcr.run(context),
            Self::Gallery(gallery) => gallery.run(context),
        }
    }
}
