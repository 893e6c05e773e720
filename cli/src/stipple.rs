//! `azulejo stipple`: an image in dots of one size, denser where it is darker, black or in four inks.

pub mod darkness;
pub mod dots;
pub mod drawing;
pub mod inks;

use std::path::{Path, PathBuf};
use std::time::Instant;

use azulejo::{Context, Domain, Error, Given, Result};
use clap::{Args, ValueEnum};

use crate::formats::points::PointTable;
use crate::generate::{compared, count, report};
use crate::output::{Report, Writing};
use crate::ply;
use crate::progress::watched;
use crate::text::rounded;
use darkness::Darkness;
use drawing::Drawing;

#[derive(Args)]
pub(crate) struct Stipple {
    /// The image: a PNG or JPEG file. Colours count by their luminance unless there is `--cmyk`; transparent parts are white.
    #[arg(value_name = "IMAGE.png|jpg")]
    image: PathBuf,
    /// The dots, in pixels of the image, with y downwards: a drawing (SVG), a picture (PNG) or the centres alone (PLY).
    #[arg(short, long, value_name = "FILE.svg|png|ply")]
    output: PathBuf,
    #[command(flatten)]
    writing: Writing,
    /// The format of the output [default: by the extension].
    #[arg(long, value_enum, value_name = "FORMAT")]
    format: Option<Format>,
    /// The number of dots, such as 20000 or 2e4.
    #[arg(long, value_name = "N", value_parser = count::<u32>)]
    count: u32,
    /// Dots of a maximal Poisson-disk set whose radius follows the image (PSP); their number is approximate. Without
    /// this flag random dots are relaxed (DCR): their number is exact, and tones are closer to those of the image.
    #[arg(long)]
    no_relax: bool,
    /// Dots of black, cyan, magenta and yellow, about as many as asked for: each a maximal Poisson-disk set whose
    /// density follows its share of the image, around the dots of the inks before it, so that all are well spread
    /// together. PLY files have the ink as `class`: 0 black, 1 cyan, 2 magenta, 3 yellow.
    #[arg(long, conflicts_with = "no_relax")]
    cmyk: bool,
    /// The largest number of steps of the relaxation.
    #[arg(long, value_name = "STEPS", default_value_t = 100, conflicts_with_all = ["no_relax", "cmyk"])]
    iterations: u32,
    /// The light of a pixel is its grey value, of which 1 is white, to this power; the share 1 - light is covered with
    /// ink.
    #[arg(long, value_name = "EXPONENT", default_value_t = 2.2, allow_negative_numbers = true)]
    gamma: f64,
    /// Width of a picture in pixels [default: twice that of the image].
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(crate::draw::PICTURE_WIDTHS))]
    size: Option<u32>,
    /// Another seed gives other dots.
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    seed: u64,
}

/// The format of the dots.
#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// A drawing.
    Svg,
    /// A picture.
    Png,
    /// The centres of the dots.
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
                let reason = "the extension names no format of dots: give svg, png or ply".to_owned();
                Err(Error::Format { path: path.into(), reason })
            }
        }
    }
}

/// Dots, and a report on how they were made.
struct Stippled {
    /// The paper.
    domain: Domain,
    centres: Vec<[f32; 2]>,
    /// The ink of each; empty if all are black.
    inks: Vec<u32>,
    radius: f64,
    about: Report,
}

impl Stipple {
    pub(crate) fn run(&self, context: &Context) -> Result<()> {
        let format = self.format.map_or_else(|| Format::of(&self.output), Ok)?;
        let output = self.writing.at(&self.output)?;
        let start = Instant::now();
        let stippled = if self.cmyk { self.in_inks(context)? } else { self.in_black(context)? };
        let seconds = start.elapsed().as_secs_f64();
        let Stippled { domain, centres, inks, radius, about } = stippled;
        let size = domain.max.map(|length| length as usize);
        let drawing = Drawing { size, dots: &centres, inks: &inks, radius };
        match format {
            Format::Svg => drawing.write_svg(&output)?,
            Format::Png => {
                let twice = 2 * size[0] as u32;
                let limits = crate::draw::PICTURE_WIDTHS;
                let width = self.size.unwrap_or(twice.clamp(*limits.start() as u32, *limits.end() as u32));
                drawing.write_png(width, self.gamma, &output)?;
            }
            Format::Ply => {
                ply::write_points(&output, &domain, &PointTable { classes: &inks, ..PointTable::of(&centres) })?
            }
        }
        let about = about.fact("dot_radius", radius, format!("dots of radius {}", rounded(radius, 4)));
        report(&output, centres.len(), about, seconds);
        Ok(())
    }

    fn in_black(&self, context: &Context) -> Result<Stippled> {
        let darkness = Darkness::load(&self.image, self.gamma)?;
        let (centres, about) = self.dots(context, &darkness)?;
        let radius = darkness.dot_radius(centres.len());
        Ok(Stippled { domain: darkness.domain(), centres, inks: Vec::new(), radius, about })
    }

    fn in_inks(&self, context: &Context) -> Result<Stippled> {
        let inks = Darkness::load_inks(&self.image, self.gamma)?;
        let count = self.count as usize;
        let (dots, radius) = watched("dots", |progress| inks::dots(context, &inks, count, self.seed, progress))?;
        let about = compared(dots.centres.len(), self.count.into());
        Ok(Stippled { domain: inks[0].domain(), centres: dots.centres, inks: dots.inks, radius, about })
    }

    /// The dots, and a report on how they were made.
    fn dots(&self, context: &Context, darkness: &Darkness) -> Result<(Vec<[f32; 2]>, Report)> {
        if self.no_relax {
            let set = watched("dots", |progress| {
                dots::poisson(context, darkness, self.count.into(), Given::default(), self.seed, progress)
            })?;
            let about = compared(set.len(), self.count.into());
            return Ok((set, about));
        }
        let random = dots::random(context, darkness, self.count as usize, self.seed)?;
        let (set, done) =
            watched("relax", |progress| dots::relaxed(context, darkness, &random, self.iterations, progress))?;
        Ok((set, Report::default().fact("steps", done.iterations, format!("{} steps", done.iterations))))
    }
}
