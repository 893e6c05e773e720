//! Dots on paper: black discs of one size, as a drawing or as a picture.

use std::io::Write;

use azulejo::Result;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use tiny_skia::{FillRule, Mask, PathBuilder, Transform};

use crate::output::Output;

/// Dots, in pixels of the image that they draw.
pub struct Drawing<'a> {
    /// Width and height of the paper.
    pub size: [usize; 2],
    pub dots: &'a [[f32; 2]],
    pub radius: f64,
}

impl Drawing<'_> {
    /// One path of strokes without length, whose round caps are the dots.
    pub fn write_svg(&self, output: &Output) -> Result<()> {
        let [width, height] = self.size;
        output.write(|writer| {
            writeln!(writer, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\">")?;
            writeln!(writer, "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>")?;
            writeln!(
                writer,
                "<path stroke=\"black\" stroke-linecap=\"round\" stroke-width=\"{}\" d=\"",
                2.0 * self.radius
            )?;
            self.dots.iter().try_for_each(|[x, y]| writeln!(writer, "M{x:.3} {y:.3}h0"))?;
            writeln!(writer, "\"/>\n</svg>")
        })
    }

    /// A grey picture so many pixels wide. A pixel that is covered in part has the light of the part that is not, encoded
    /// as that of the image is.
    pub fn write_png(&self, columns: u32, gamma: f64, output: &Output) -> Result<()> {
        let [width, height] = self.size.map(|length| length as f32);
        let scale = columns as f32 / width;
        let rows = ((height * scale).round() as u32).max(1);
        let mut ink = Mask::new(columns, rows).expect("the size of a picture is checked by the command line");
        let mut builder = PathBuilder::new();
        self.dots.iter().for_each(|&[x, y]| builder.push_circle(x, y, self.radius as f32));
        if let Some(path) = builder.finish() {
            ink.fill_path(&path, FillRule::Winding, true, Transform::from_scale(scale, scale));
        }
        let greys: Vec<u8> = (0..=255).map(|ink: u8| grey(ink, gamma)).collect();
        let pixels: Vec<u8> = ink.data().iter().map(|&ink| greys[usize::from(ink)]).collect();
        output.write(|writer| {
            PngEncoder::new_with_quality(writer, CompressionType::Best, FilterType::NoFilter)
                .write_image(&pixels, columns, rows, ExtendedColorType::L8)
                .map_err(std::io::Error::other)
        })
    }
}

/// The grey value of a pixel that is covered to so many 255ths.
fn grey(ink: u8, gamma: f64) -> u8 {
    let light = 1.0 - f64::from(ink) / 255.0;
    (255.0 * light.powf(1.0 / gamma)).round() as u8
}
