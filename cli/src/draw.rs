//! `azulejo draw`: pictures of samples.

mod canvas;
mod palette;
mod plot;
mod points;
mod spectra;

use azulejo::{Context, Result};
use clap::Subcommand;

/// Widths of pictures, in pixels.
pub const PICTURE_WIDTHS: std::ops::RangeInclusive<i64> = 200..=10_000;

/// What to draw.
#[derive(Subcommand)]
pub enum Draw {
    /// Draw a set of the plane, or a part of a large one, beside its power spectrum.
    Points(points::Points),
}

impl Draw {
    pub fn run(&self, context: &Context) -> Result<()> {
        match self {
            Self::Points(points) => points.run(context),
        }
    }
}
