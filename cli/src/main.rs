//! The command-line tool of azulejo: samples into files, and pictures of them.

mod domain;
mod draw;
mod generate;
mod output;
mod ply;
mod procedural;
mod progress;
mod report;
mod text;

use std::process::ExitCode;

use azulejo::{Context, Result};
use clap::{Parser, Subcommand};

/// Blue-noise samples in the plane and on meshes: make them, relax them, draw them.
#[derive(Parser)]
#[command(name = "azulejo", version, arg_required_else_help = true)]
struct Cli {
    /// Number of threads; 0 takes one per core. Results do not depend on it.
    #[arg(long, global = true, value_name = "N", default_value_t = 0)]
    threads: usize,
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Fill a rectangle with a maximal Poisson-disk set (KDRT).
    Plane(generate::Plane),
    /// Cover a triangle mesh with a maximal Poisson-disk set (PSP).
    Surface(generate::Surface),
    /// Relax a set of the plane, or the samples of a mesh, by distance constraints (DCR).
    Relax(generate::Relax),
    /// Write a mesh that needs no download.
    Mesh(procedural::Procedural),
    /// Draw samples as a PNG picture.
    #[command(subcommand)]
    Draw(draw::Draw),
    /// Measure the library and write a page with plots.
    #[command(subcommand)]
    Report(report::Report),
}

fn run(cli: &Cli) -> Result<()> {
    let context = Context::new(cli.threads)?;
    match &cli.command {
        Command::Plane(plane) => plane.run(&context),
        Command::Surface(surface) => surface.run(&context),
        Command::Relax(relax) => relax.run(&context),
        Command::Mesh(procedural) => procedural.run(),
        Command::Draw(draw) => draw.run(&context),
        Command::Report(report) => report.run(&context),
    }
}

/// 0: done; 1: refused or failed, with the reason on the standard error; 2: wrong usage (by clap).
fn main() -> ExitCode {
    match run(&Cli::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
