//! The commands of the program, and its exit codes.

use std::io::{self, Write};
use std::process::ExitCode;

use azulejo::{Context, Result};
use clap::{CommandFactory, Parser, Subcommand};

use crate::{analyze, draw, generate, mask, merge, output, procedural, shell, stipple, thin};

/// The text at the end of the help of all commands.
const AFTERWARDS: &str = "\
Examples:
  azulejo plane --count 65536 -o points.npy
  azulejo relax points.npy -o relaxed.csv
  azulejo surface bunny.obj --radius 0.002 -o samples.ply
  azulejo volume --count 65536 --box 0 0 0 2 1 1 -o points.ply
  azulejo thin cloud.ply --count 100000 -o thinned.ply
  azulejo mask --width 64 --height 64 --dither photo.png -o halftone.png
  azulejo analyze relaxed.csv --plots plots

Files of points are PLY (.ply), NumPy arrays (.npy), text (.csv, .xyz, .txt) or little-endian 32-bit floats (.raw, .f32, .bin). \
Only PLY files record the domain of a set of the plane or of a box. The file - is the standard input or output, for points, meshes \
and images: points are read and written as PLY there unless --input-format or --format says otherwise; the format of a \
mesh is recognised by its contents.

Exit codes: 0 done; 1 refused or failed, with the reason on the standard error; 2 wrong usage. Files are written whole or \
not at all, and those that exist are replaced with --force only. --json prints reports for programs.";

/// Blue-noise samples in the plane, on meshes and in boxes: make them, relax them, measure them, draw them.
#[derive(Parser)]
#[command(name = "azulejo", version, arg_required_else_help = true, after_help = AFTERWARDS)]
pub struct Cli {
    /// Number of threads; 0 takes one per core. Results do not depend on it.
    #[arg(long, global = true, value_name = "N", default_value_t = 0, display_order = 900)]
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
    /// Fill a box with a maximal Poisson-disk set.
    Volume(generate::Volume),
    /// Relax a set of the plane or of a box, or the samples of a mesh, by distance constraints (DCR).
    Relax(generate::Relax),
    /// Merge sets that were sampled separately into one maximal set (KDRT).
    Merge(merge::Merge),
    /// Select points of a cloud that are far from each other, by number or by distance.
    Thin(thin::Thin),
    /// Make a blue-noise mask (void and cluster), or dither an image with one.
    Mask(mask::Masking),
    /// Measure sets of the plane or samples of a mesh: a table, JSON, plots.
    Analyze(analyze::Analyze),
    /// Stipple an image: dots, denser where it is darker (PSP, DCR).
    Stipple(stipple::Stipple),
    /// Write a procedural mesh: a knot, a sphere, a torus or a hall.
    Mesh(procedural::Procedural),
    /// Draw samples as a PNG picture.
    #[command(subcommand)]
    Draw(draw::Draw),
    /// Print the completions for a shell.
    Completions(shell::Completions),
    /// Print a page of the manual.
    Man(shell::Man),
}

fn run(cli: &Cli) -> Result<()> {
    let context = Context::new(cli.threads)?;
    match &cli.command {
        Command::Plane(plane) => plane.run(&context),
        Command::Surface(surface) => surface.run(&context),
        Command::Volume(volume) => volume.run(&context),
        Command::Relax(relax) => relax.run(&context),
        Command::Merge(merge) => merge.run(&context),
        Command::Thin(thin) => thin.run(&context),
        Command::Mask(mask) => mask.run(&context),
        Command::Analyze(analyze) => analyze.run(&context),
        Command::Stipple(stipple) => stipple.run(&context),
        Command::Mesh(procedural) => procedural.run(),
        Command::Draw(draw) => draw.run(&context),
        Command::Completions(completions) => completions.run(Cli::command()),
        Command::Man(man) => man.run(Cli::command()),
    }
}

/// Runs the program with the arguments of this process. Exit codes: 0 done; 1 refused or failed, with the reason on the
/// standard error; 2 wrong usage (by clap).
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    exit_code(|| run(&cli))
}

/// Does the work of a program: 0 if it is done, 1 with the reason on the standard error if it fails. Signals that end
/// the process meanwhile remove the files that are incomplete.
pub fn exit_code(work: impl FnOnce() -> Result<()>) -> ExitCode {
    // Signals that cannot be caught end the process as by default.
    _ = output::remove_on_signals();
    match work() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // The exit code remains where the message cannot be written.
            _ = writeln!(io::stderr(), "error: {error}");
            ExitCode::FAILURE
        }
    }
}
