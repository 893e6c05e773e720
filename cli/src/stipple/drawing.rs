//! Dots on paper: discs of one size, black or in several inks, as a drawing or as a picture.

use std::io::Write;

use azulejo::Result;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use tiny_skia::{FillRule, Mask, PathBuilder, Transform};

use super::inks::{ABSORBS, INKS};
use crate::draw::indexed::write_png;
use crate::draw::palette::Colour;
use crate::output::Output;

/// The colours of the inks in a drawing.
const COLOURS: [&str; INKS] = ["#000", "#0ff", "#f0f", "#ff0"];

/// Dots, in pixels of the image that they draw.
pub struct Drawing<'a> {
    /// Width and height of the paper.
    pub size: [usize; 2],
    /// Their centres.
    pub dots: &'a [[f32; 2]],
    /// The ink of each dot ([`ABSORBS`]); empty if all are black.
    pub inks: &'a [u32],
    /// The radius of all dots.
    pub radius: f64,
}

impl Drawing<'_> {
    /// The dots of an ink.
    fn of_ink(&self, ink: usize) -> impl Iterator<Item = [f32; 2]> {
        let is_own = move |dot: usize| self.inks.get(dot).map_or(ink == 0, |&of| of as usize == ink);
        self.dots.iter().enumerate().filter(move |&(dot, _)| is_own(dot)).map(|(_, &centre)| centre)
    }

    /// For each ink one path of strokes without length, whose round caps are the dots. Inks multiply.
    pub fn write_svg(&self, output: &Output) -> Result<()> {
        let [width, height] = self.size;
        output.write(|writer| {
            writeln!(writer, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\">")?;
            writeln!(writer, "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>")?;
            let inks = if self.inks.is_empty() { 1 } else { INKS };
            for (ink, colour) in COLOURS.iter().enumerate().take(inks) {
                let colour = if inks == 1 { "black" } else { colour };
                write!(writer, "<path stroke=\"{colour}\" stroke-linecap=\"round\" ")?;
                if inks > 1 {
                    write!(writer, "style=\"mix-blend-mode:multiply\" ")?;
                }
                writeln!(writer, "stroke-width=\"{}\" d=\"", 2.0 * self.radius)?;
                self.of_ink(ink).try_for_each(|[x, y]| writeln!(writer, "M{x:.3} {y:.3}h0"))?;
                writeln!(writer, "\"/>")?;
            }
            writeln!(writer, "</svg>")
        })
    }

    /// A picture `columns` pixels wide, grey or in colours. A pixel that is covered in part has the light of the part
    /// that is not, encoded as that of the image is.
    pub fn write_png(&self, columns: u32, gamma: f64, output: &Output) -> Result<()> {
        let [width, height] = self.size.map(|length| length as f32);
        let scale = columns as f32 / width;
        let rows = ((height * scale).round() as u32).max(1);
        if self.inks.is_empty() {
            let covered = self.covered(0, columns, rows, scale);
            let pixels: Vec<u8> = covered.into_iter().map(|ink| value(light(ink), gamma)).collect();
            return output.write(|writer| {
                PngEncoder::new_with_quality(writer, CompressionType::Best, FilterType::NoFilter)
                    .write_image(&pixels, columns, rows, ExtendedColorType::L8)
                    .map_err(std::io::Error::other)
            });
        }
        let inks: [Vec<u8>; INKS] = std::array::from_fn(|ink| self.covered(ink, columns, rows, scale));
        let channel = |pixel: usize, channel: usize| {
            let inks = inks.iter().zip(ABSORBS).filter(|(_, absorbs)| absorbs[channel]);
            value(inks.map(|(ink, _)| light(ink[pixel])).product(), gamma)
        };
        let pixels: Vec<Colour> = (0..inks[0].len()).map(|pixel| [0, 1, 2].map(|of| channel(pixel, of))).collect();
        output.write(|writer| write_png(writer, &pixels, columns))
    }

    /// The share of each pixel that the dots of an ink cover, in 255ths.
    fn covered(&self, ink: usize, columns: u32, rows: u32, scale: f32) -> Vec<u8> {
        let mut mask = Mask::new(columns, rows).expect("the size of a picture is checked by the command line");
        let mut builder = PathBuilder::new();
        self.of_ink(ink).for_each(|[x, y]| builder.push_circle(x, y, self.radius as f32));
        if let Some(path) = builder.finish() {
            mask.fill_path(&path, FillRule::Winding, true, Transform::from_scale(scale, scale));
        }
        mask.take()
    }
}

/// The light of a pixel of which this many 255ths are covered.
fn light(ink: u8) -> f64 {
    1.0 - f64::from(ink) / 255.0
}

/// The value that stands for a light.
fn value(light: f64, gamma: f64) -> u8 {
    (255.0 * light.powf(1.0 / gamma)).round() as u8
}
