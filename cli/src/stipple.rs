//! `azulejo stipple`: an image in dots, all of one size, as dense as it is dark.

pub mod darkness;
pub mod dots;
mod drawing;

use std::path::{Path, PathBuf};
use std::time::Instant;

use azulejo::{Context, Error, Result};
use clap::Args;

use crate::generate::{compared, report};
use crate::output::Output;
use crate::ply;
use crate::progress::watched;
use crate::text::rounded;
use darkness::Darkness;
use drawing::Drawing;

#[derive(Args)]
pub(crate) struct Stipple {
    /// The image: a PNG file. Colours count by their luminance, what is transparent is white.
    #[arg(value_name = "IMAGE.png")]
    image: PathBuf,
    /// The dots, in pixels of the image, with y downwards: a drawing (SVG), a picture (PNG) or the centres alone (PLY).
    #[arg(value_name = "OUT.svg|png|ply")]
    output: PathBuf,
    /// How many dots there are.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    count: u32,
    /// Leave the dots where they are put first: a maximal Poisson-disk set whose radius follows the image (PSP), of about
    /// as many dots. Without it dots are put at random and relaxed (DCR): exactly as many, and truer to the tone.
    #[arg(long)]
    no_relax: bool,
    /// The largest number of steps of the relaxation.
    #[arg(long, value_name = "STEPS", default_value_t = 100, conflicts_with = "no_relax")]
    iterations: u32,
    /// The light of a pixel is its grey value to this power, 1 being white. What 1 - light says shall be covered with ink.
    #[arg(long, value_name = "EXPONENT", default_value_t = 2.2, allow_negative_numbers = true)]
    gamma: f64,
    /// Width of a picture in pixels [default: twice that of the image].
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(crate::draw::PICTURE_WIDTHS))]
    size: Option<u32>,
    /// Another seed gives other dots.
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    seed: u64,
}

/// What the dots are written as.
#[derive(Clone, Copy)]
enum Format {
    Svg,
    Png,
    Ply,
}

impl Format {
    /// By the end of the name.
    fn of(path: &Path) -> Result<Self> {
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        match extension.as_str() {
            "svg" => Ok(Self::Svg),
            "png" => Ok(Self::Png),
            "ply" => Ok(Self::Ply),
            _ => {
                let reason = format!("{} ends neither in .svg nor in .png nor in .ply", path.display());
                Err(Error::InvalidArgument { argument: "OUT", reason })
            }
        }
    }
}

impl Stipple {
    pub(crate) fn run(&self, context: &Context) -> Result<()> {
        let format = Format::of(&self.output)?;
        let output = Output::at(&self.output)?;
        let darkness = Darkness::load(&self.image, self.gamma)?;
        let start = Instant::now();
        let (dots, about) = self.dots(context, &darkness)?;
        let seconds = start.elapsed().as_secs_f64();
        let radius = darkness.dot_radius(dots.len());
        let drawing = Drawing { size: darkness.size(), dots: &dots, radius };
        match format {
            Format::Svg => drawing.write_svg(&output)?,
            Format::Png => {
                let twice = 2 * darkness.size()[0] as u32;
                let limits = crate::draw::PICTURE_WIDTHS;
                let width = self.size.unwrap_or(twice.clamp(*limits.start() as u32, *limits.end() as u32));
                drawing.write_png(width, self.gamma, &output)?;
            }
            Format::Ply => ply::write_plane(&output, &darkness.domain(), &dots)?,
        }
        report(&output, dots.len(), &format!("{about}dots of radius {}", rounded(radius, 4)), seconds);
        Ok(())
    }

    /// The dots, and what is to be said of how they were made.
    fn dots(&self, context: &Context, darkness: &Darkness) -> Result<(Vec<[f32; 2]>, String)> {
        if self.no_relax {
            let set =
                watched("dots", |progress| dots::poisson(context, darkness, self.count as usize, self.seed, progress))?;
            let about = compared(set.len(), self.count.into());
            return Ok((set, about));
        }
        let random = dots::random(context, darkness, self.count as usize, self.seed)?;
        let (set, done) =
            watched("relax", |progress| dots::relaxed(context, darkness, &random, self.iterations, progress))?;
        Ok((set, format!("{} steps, ", done.iterations)))
    }
}
