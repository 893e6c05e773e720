//! azulejo beside its peers: one run, one machine, one page.
//!
//! Each peer runs in a process of its own, which says how long its call took, how busy its threads were and how much
//! memory it took on top; all that is judged here, from the samples that it wrote.

// Figures on a page need not be the same bytes on every processor.
#![allow(clippy::disallowed_methods)]

mod elimination;
mod judge;
mod native;
mod page;
mod peers;
mod space;
mod timing;

use std::error::Error;
use std::path::PathBuf;

use clap::{Parser, Subcommand};

#[derive(Parser)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Runs one peer that is written in Rust.
    One { name: String, count: usize, radius: f64, out: PathBuf, mesh: Option<PathBuf> },
    /// Runs all and writes the page.
    All {
        #[command(flatten)]
        pythons: peers::Pythons,
        #[arg(long)]
        mesh: PathBuf,
        #[arg(long)]
        page: PathBuf,
        /// The packages' versions, as the page gives them.
        #[arg(long)]
        packages: String,
    },
}

fn main() -> Result<(), Box<dyn Error>> {
    match Cli::parse().command {
        Command::One { name, count, radius, out, mesh } => native::run(&name, count, radius, &out, mesh.as_deref()),
        Command::All { pythons, mesh, page, packages } => {
            let tables = peers::run_all(&pythons, &mesh)?;
            Ok(std::fs::write(page, page::page(&tables, &mesh, &packages)?)?)
        }
    }
}
