//! Measures azulejo and writes the pages of `docs/` that show it, with their pictures.
//!
//! `cargo run --release -p azulejo-studies -- kdrt` writes `docs/kdrt.md`; so do `psp`, `dcr`, `classes`, `order`,
//! `pixels`, `gallery`, `goals` and `volume` their pages.

mod args;
mod blue;
mod chart;
mod claims;
mod classes;
mod dcr;
mod files;
mod gallery;
mod goals;
mod kdrt;
mod near;
mod order;
mod pixels;
mod psp;
mod reference;
mod repeated;
mod timing;
mod verdict;
mod volume;

use std::process::ExitCode;

use azulejo::{Context, Result};
use clap::{Parser, Subcommand};

/// Measures azulejo and writes the pages of docs/ that show it.
#[derive(Parser)]
#[command(name = "azulejo-studies", version, arg_required_else_help = true)]
struct Cli {
    /// Number of threads; 0 takes one per core.
    #[arg(long, global = true, value_name = "N", default_value_t = 0, display_order = 900)]
    threads: usize,
    #[command(subcommand)]
    study: Study,
}

/// The study that is run.
#[derive(Subcommand)]
enum Study {
    /// Measure bias, spectra and times of KDRT against the thesis and the unbiased reference; takes some minutes.
    Kdrt(kdrt::Kdrt),
    /// Measure rates, density and bias of PSP on meshes against the thesis; takes some minutes.
    Psp(psp::Psp),
    /// Measure what DCR makes of random and of KDRT's sets, against others' methods; takes some minutes.
    Dcr(dcr::Dcr),
    /// Measure shares, spectra and times of several classes, beside Wei's algorithm; takes some minutes.
    Classes(classes::Study),
    /// Measure prefixes of progressive sets beside sets of their number, and what the order costs; takes some minutes.
    Order(order::Study),
    /// Measure errors of sample sets for pixels, beside those of samplers that renderers use.
    Pixels(pixels::Study),
    /// Measure the performance targets of version 0.2 that are on no other page; takes some minutes.
    Goals(goals::Goals),
    /// Measure sets of cuboids and of the inside of meshes against their goals and beside others'; takes some minutes.
    Volume(volume::Study),
    /// Show samplers side by side: points, spectra and a zone plate; takes some minutes.
    Gallery(gallery::Gallery),
}

fn run(cli: &Cli) -> Result<()> {
    let context = Context::new(cli.threads)?;
    match &cli.study {
        Study::Kdrt(kdrt) => kdrt.run(&context),
        Study::Psp(psp) => psp.run(&context),
        Study::Dcr(dcr) => dcr.run(&context),
        Study::Classes(classes) => classes.run(&context),
        Study::Order(order) => order.run(&context),
        Study::Pixels(pixels) => pixels.run(&context),
        Study::Gallery(gallery) => gallery.run(&context),
        Study::Goals(goals) => goals.run(&context),
        Study::Volume(volume) => volume.run(&context),
    }
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    azulejo_cli::exit_code(|| run(&cli))
}
