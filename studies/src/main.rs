//! Measures azulejo and writes the pages of `docs/` that show it, with their pictures.
//!
//! `cargo run --release -p azulejo-studies -- kdrt` writes `docs/kdrt.md`; so do `psp`, `dcr` and `gallery` their pages;
//! `sums` prints SHA-256 sums of what calls return.

mod args;
mod chart;
mod dcr;
mod files;
mod gallery;
mod kdrt;
mod psp;
mod reference;
mod sums;
mod verdict;

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

/// What to measure.
#[derive(Subcommand)]
enum Study {
    /// Measure bias, spectra and times of KDRT against the thesis and the unbiased reference; takes some minutes.
    Kdrt(kdrt::Kdrt),
    /// Measure rates, density and bias of PSP on meshes against the thesis; takes some minutes.
    Psp(psp::Psp),
    /// Measure what DCR makes of random and of KDRT's sets, against others' methods; takes some minutes.
    Dcr(dcr::Dcr),
    /// Show samplers side by side: points, spectra and a zone plate; takes some minutes.
    Gallery(gallery::Gallery),
    /// Print SHA-256 sums of what some sixty calls return, to compare them before and after a change; takes a minute.
    Sums(sums::Sums),
}

fn run(cli: &Cli) -> Result<()> {
    let context = Context::new(cli.threads)?;
    match &cli.study {
        Study::Kdrt(kdrt) => kdrt.run(&context),
        Study::Psp(psp) => psp.run(&context),
        Study::Dcr(dcr) => dcr.run(&context),
        Study::Gallery(gallery) => gallery.run(&context),
        Study::Sums(sums) => sums.run(&context),
    }
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    azulejo_cli::exit_code(|| run(&cli))
}
