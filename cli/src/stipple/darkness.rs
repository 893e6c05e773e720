//! The darkness of an image: the share of the paper to cover with ink.

use std::io::Cursor;
use std::path::Path;

use azulejo::dcr::Density;
use azulejo::{Boundary, Domain, Error, Result};
use image::{DynamicImage, ImageFormat, ImageReader, Rgba};

use crate::input;

/// The largest side of an image.
const LARGEST: u32 = 32_768;

/// The darkness of each pixel, row by row from the top: 0 is white and 1 black.
pub struct Darkness {
    values: Vec<f32>,
    width: usize,
}

impl Darkness {
    /// That of rows of pixels.
    pub fn new(values: Vec<f32>, width: usize) -> Self {
        Self { values, width }
    }

    /// That of a PNG file. The light of a pixel is its grey value to the power of `gamma`.
    pub fn load(path: &Path, gamma: f64) -> Result<Self> {
        if !(gamma > 0.0 && gamma.is_finite()) {
            let reason = format!("{gamma} is not a positive finite number");
            return Err(Error::InvalidArgument { argument: "--gamma", reason });
        }
        let io_error = |source| Error::Io { path: path.into(), source };
        let format_error = |reason: String| Error::Format { path: path.into(), reason };
        let file = Cursor::new(input::bytes(path)?);
        // By the contents: the name proves nothing.
        let mut reader = ImageReader::new(file).with_guessed_format().map_err(io_error)?;
        if reader.format() != Some(ImageFormat::Png) {
            return Err(format_error("is no PNG file".to_owned()));
        }
        let mut limits = image::Limits::default();
        (limits.max_image_width, limits.max_image_height) = (Some(LARGEST), Some(LARGEST));
        reader.limits(limits);
        let image = reader.decode().map_err(|error| match error {
            image::ImageError::IoError(source) => io_error(source),
            other => format_error(other.to_string()),
        })?;
        let darkness = Self::of(&image, gamma);
        if darkness.ink() == 0.0 {
            return Err(format_error("is all white: there is nothing to be drawn with dots".to_owned()));
        }
        Ok(darkness)
    }

    fn of(image: &DynamicImage, gamma: f64) -> Self {
        let pixels = image.to_rgba32f();
        let dark = |&Rgba([r, g, b, alpha]): &Rgba<f32>| {
            let grey = 0.2126 * r + 0.7152 * g + 0.0722 * b;
            let on_white = f64::from(1.0 - alpha + alpha * grey);
            (1.0 - on_white.clamp(0.0, 1.0).powf(gamma)) as f32
        };
        Self::new(pixels.pixels().map(dark).collect(), image.width() as usize)
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.values.len() / self.width]
    }

    /// The paper, in pixels, y downwards.
    pub fn domain(&self) -> Domain {
        Domain { min: [0.0; 2], max: self.size().map(|length| length as f64), boundary: Boundary::Bounded }
    }

    /// The darkness as a density on the [`domain`](Self::domain).
    pub fn density(&self) -> Density<'_> {
        let [width, height] = self.size();
        Density::Image { values: &self.values, width, height }
    }

    /// The darkness of a pixel.
    pub fn at(&self, column: usize, row: usize) -> f64 {
        self.values[row * self.width + column].into()
    }

    /// The area, in pixels, that is to be covered with ink.
    pub fn ink(&self) -> f64 {
        self.values.iter().map(|&dark| f64::from(dark)).sum()
    }

    /// The radius with which so many dots have the area of the ink. Dots that overlap cover less: of evenly spread ones
    /// the nearest touch where two thirds are to be covered, and black is covered to nine tenths.
    pub fn dot_radius(&self, count: usize) -> f64 {
        (self.ink() / (std::f64::consts::PI * count as f64)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::RgbaImage;

    #[test]
    fn grey_values_are_taken_for_light_and_transparency_for_paper() {
        let mut image = RgbaImage::new(2, 2);
        for (x, y, colour) in
            [(0, 0, [255, 255, 255, 255]), (1, 0, [0, 0, 0, 255]), (0, 1, [128, 128, 128, 255]), (1, 1, [0, 0, 0, 0])]
        {
            image.put_pixel(x, y, Rgba(colour));
        }
        let image = DynamicImage::from(image);
        for (gamma, grey) in [(1.0, 1.0 - 128.0 / 255.0), (2.2, 0.7804)] {
            let darkness = Darkness::of(&image, gamma);
            for (dark, expected) in darkness.values.iter().zip([0.0, 1.0, grey, 0.0]) {
                assert!((f64::from(*dark) - expected).abs() < 1e-3, "{:?}", darkness.values);
            }
            assert!((darkness.dot_radius(3).powi(2) * 3.0 * std::f64::consts::PI - 1.0 - grey).abs() < 1e-3);
        }
    }
}
