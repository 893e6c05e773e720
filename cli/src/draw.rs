//! `azulejo draw`: pictures of samples.

mod camera;
pub mod canvas;
mod detail;
mod discs;
pub mod indexed;
pub mod palette;
pub mod panels;
pub mod plot;
pub mod points;
pub mod render;
pub mod rows;
pub mod spectra;
pub mod stage;
pub mod surface;

use std::path::PathBuf;

use azulejo::{Context, Result};
use clap::{Args, Subcommand};

use crate::output::{Output, Report, Writing};

/// Widths of pictures, in pixels.
pub const PICTURE_WIDTHS: std::ops::RangeInclusive<i64> = 200..=10_000;

/// The picture that a command draws.
#[derive(Args)]
struct PictureArgs {
    /// The picture.
    #[arg(short, long, value_name = "FILE.png")]
    output: PathBuf,
    #[command(flatten)]
    writing: Writing,
    /// Width of the picture in pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 1600, value_parser = clap::value_parser!(u32).range(PICTURE_WIDTHS))]
    size: u32,
}

impl PictureArgs {
    /// Reports the picture.
    fn report(&self, output: &Output) {
        output.report(&Report::default().fact("width", self.size, format!("{} pixels wide", self.size)));
    }

    fn open(&self) -> Result<Output> {
        self.writing.of_format("png", &self.output)
    }
}

/// The subject of a picture.
#[derive(Subcommand)]
pub(crate) enum Draw {
    /// Draw a set of the plane, or a part of a large one, beside its power spectrum.
    Points(points::Points),
    /// Draw samples as discs on their mesh, with two details.
    Surface(surface::Surface),
}

impl Draw {
    pub(crate) fn run(&self, context: &Context) -> Result<()> {
        match self {
            Self::Points(points) => points.run(context),
            Self::Surface(surface) => surface.run(context),
        }
    }
}
