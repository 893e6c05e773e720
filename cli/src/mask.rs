//! `azulejo mask`: a blue-noise mask as a picture or as numbers, or a halftone of an image by one.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use azulejo::mask::{Image, Mask, Options, Pixels, create};
use azulejo::{Context, Error, Result};
use clap::Args;
use png::{BitDepth, ColorType, Encoder};

use crate::output::{Report, Writing};
use crate::progress::watched;
use crate::stipple::darkness;

#[derive(Args)]
pub(crate) struct Masking {
    /// The mask: a picture (PNG) of 16 bits, dark where ranks are low, with the channels as grey, grey and alpha, RGB or
    /// RGBA and slices below each other; or all ranks (RAW), little-endian integers of 32 bits, channel by channel. With
    /// `--dither` the halftone (PNG).
    #[arg(short, long, value_name = "FILE.png|raw")]
    output: PathBuf,
    #[command(flatten)]
    writing: Writing,
    /// The pixels along x: 2 to 1024, up to 64 with a depth above 1.
    #[arg(long, value_name = "PIXELS")]
    width: usize,
    /// The pixels along y: 2 to 1024, up to 64 with a depth above 1.
    #[arg(long, value_name = "PIXELS")]
    height: usize,
    /// The pixels along z, 1 to 64: 1 is a mask of the plane, others are masks of space.
    #[arg(long, value_name = "PIXELS", default_value_t = 1)]
    depth: usize,
    /// The number of independent masks, 1 to 64.
    #[arg(long, value_name = "N", default_value_t = 1)]
    channels: usize,
    /// Another seed gives another mask.
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    seed: u64,
    /// The standard deviation of the filter that finds voids and clusters, in pixels: 0.5 to 4.
    #[arg(long, value_name = "PIXELS", default_value_t = 1.5, allow_negative_numbers = true)]
    sigma: f64,
    /// An image, a PNG or JPEG file, that is dithered with the mask, grey or in colours; transparent parts are white.
    #[arg(long, value_name = "IMAGE.png|jpg")]
    dither: Option<PathBuf>,
    /// The number of levels of a halftone, in each channel: 2 to 256, equal steps of light.
    #[arg(long, value_name = "N", default_value_t = 2, requires = "dither")]
    levels: usize,
    /// The light of a pixel of the image is its value, of which 1 is white, to this power.
    #[arg(long, value_name = "EXPONENT", default_value_t = 2.2, allow_negative_numbers = true, requires = "dither")]
    gamma: f64,
}

/// A picture of rows from the top, as it is encoded.
struct Picture {
    size: [usize; 2],
    colours: ColorType,
    depth: BitDepth,
    bytes: Vec<u8>,
}

impl Picture {
    fn write(&self, writer: &mut BufWriter<&File>) -> io::Result<()> {
        let mut encoder = Encoder::new(writer, self.size[0] as u32, self.size[1] as u32);
        encoder.set_color(self.colours);
        encoder.set_depth(self.depth);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.bytes)?;
        Ok(writer.finish()?)
    }
}

impl Masking {
    pub(crate) fn run(&self, context: &Context) -> Result<()> {
        let is_raw = self.is_raw()?;
        let output = self.writing.at(&self.output)?;
        // What is wrong with the image is said before the mask is made.
        let image = self.dither.as_deref().map(|path| darkness::load(path, self.gamma)).transpose()?;
        let options = Options::new(self.width, self.height).depth(self.depth).channels(self.channels);
        let options = options.seed(self.seed).sigma(self.sigma);
        let start = Instant::now();
        let (mask, _) = watched("mask", |progress| create(context, &options, Some(progress)))?;
        let report = match image {
            Some(image) => {
                let halftone = self.halftone(&mask, &image)?;
                output.write(|writer| halftone.write(writer))?;
                let [width, height] = halftone.size;
                let text = format!("{width} x {height} pixels in {} levels", self.levels);
                Report::default().fact("size", vec![width, height], text).fact("levels", self.levels, "")
            }
            None => {
                if is_raw {
                    output
                        .write(|writer| mask.ranks.iter().try_for_each(|rank| writer.write_all(&rank.to_le_bytes())))?;
                } else {
                    output.write(|writer| picture(&mask).write(writer))?;
                }
                let [width, height, depth] = mask.size;
                Report::default().fact("size", mask.size.to_vec(), format!("{width} x {height} x {depth} pixels")).fact(
                    "channels",
                    mask.channels,
                    format!("channels: {}", mask.channels),
                )
            }
        };
        output.report(&report.seconds(start.elapsed().as_secs_f64()));
        Ok(())
    }

    /// True for a file of numbers; refuses what a file cannot hold.
    fn is_raw(&self) -> Result<bool> {
        let refused = |reason: &str| Err(Error::Format { path: self.output.clone(), reason: reason.to_owned() });
        let has =
            |extension| self.output.extension().is_some_and(|of: &std::ffi::OsStr| of.eq_ignore_ascii_case(extension));
        match (has("raw"), has("png") || self.output == Path::new("-")) {
            (true, _) if self.dither.is_some() => refused("a halftone is written as PNG"),
            (false, false) => refused("the extension names no format of masks: give png or raw"),
            (false, true) if self.channels > 4 && self.dither.is_none() => {
                refused("a PNG file has up to 4 channels; write more of them to a .raw file")
            }
            (is_raw, _) => Ok(is_raw),
        }
    }

    /// The image in few levels of light.
    fn halftone(&self, mask: &Mask, image: &image::DynamicImage) -> Result<Picture> {
        let channels = if image.color().has_color() { 3 } else { 1 };
        let pixels = image.to_rgba32f();
        let light = |value: f32| f64::from(value).clamp(0.0, 1.0).powf(self.gamma) as f32;
        let numbers: Vec<f32> = pixels
            .pixels()
            .flat_map(|pixel| {
                let [r, g, b, alpha] = pixel.0;
                [r, g, b].map(|value| light(1.0 - alpha + alpha * value)).into_iter().take(channels)
            })
            .collect();
        let size = [image.width() as usize, image.height() as usize];
        let image = Image { size: [size[0], size[1], 1], channels, pixels: Pixels::Floats(&numbers) };
        let levels = mask.dither(&image, self.levels)?;
        let steps = (self.levels - 1) as f64;
        let grey = |level: u8| (255.0 * (f64::from(level) / steps).powf(1.0 / self.gamma)).round() as u8;
        let greys: Vec<u8> = (0..=steps as u8).map(grey).collect();
        let bytes = levels.into_iter().map(|level| greys[usize::from(level)]).collect();
        let colours = if channels == 3 { ColorType::Rgb } else { ColorType::Grayscale };
        Ok(Picture { size, colours, depth: BitDepth::Eight, bytes })
    }
}

/// The channels of a mask as those of a picture of 16 bits: the rank in 65,536ths of the pixels, rounded down.
fn picture(mask: &Mask) -> Picture {
    let colours = match mask.channels {
        1 => ColorType::Grayscale,
        2 => ColorType::GrayscaleAlpha,
        3 => ColorType::Rgb,
        _ => ColorType::Rgba,
    };
    let pixels = mask.pixels();
    let sample = |rank: u32| ((u64::from(rank) << 16) / pixels as u64) as u16;
    let of_pixel = |pixel| (0..mask.channels).flat_map(move |c| sample(mask.channel(c)[pixel]).to_be_bytes());
    let bytes = (0..pixels).flat_map(of_pixel).collect();
    Picture { size: [mask.size[0], mask.size[1] * mask.size[2]], colours, depth: BitDepth::Sixteen, bytes }
}
