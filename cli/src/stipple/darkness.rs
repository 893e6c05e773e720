//! The darkness of an image: the share of the paper to cover with ink, with black or with each of four.

use std::path::Path;

use azulejo::dcr::Density;
use azulejo::{Boundary, Domain, Error, Result};
use image::{DynamicImage, Rgba};

use super::inks::INKS;
use crate::photo;

/// The darkness of each pixel, row by row from the top: 0 is white and 1 black.
pub struct Darkness {
    values: Vec<f32>,
    width: usize,
}

impl Darkness {
    /// The darkness of rows of pixels.
    pub fn new(values: Vec<f32>, width: usize) -> Self {
        Self { values, width }
    }

    /// The darkness of an image's file, PNG or JPEG. The light of a pixel is its grey value to the power of `gamma`.
    pub fn load(path: &Path, gamma: f64) -> Result<Self> {
        let darkness = Self::of(&load(path, gamma)?, gamma);
        check_ink(path, darkness.ink())?;
        Ok(darkness)
    }

    /// The darkness of an image's file for each ink ([`ABSORBS`](super::inks::ABSORBS)). Black is the part that red, green
    /// and blue all lack; another ink takes the share of the remaining light by which its colour is darker than the
    /// lightest.
    pub fn load_inks(path: &Path, gamma: f64) -> Result<[Self; INKS]> {
        let inks = Self::inks_of(&load(path, gamma)?, gamma);
        check_ink(path, inks.iter().map(Self::ink).sum())?;
        Ok(inks)
    }

    fn inks_of(image: &DynamicImage, gamma: f64) -> [Self; INKS] {
        let pixels = image.to_rgba32f();
        let lights = |&Rgba([r, g, b, alpha]): &Rgba<f32>| {
            [r, g, b].map(|light| f64::from(1.0 - alpha + alpha * light).clamp(0.0, 1.0).powf(gamma))
        };
        Self::inks(&pixels.pixels().map(lights).collect::<Vec<_>>(), image.width() as usize)
    }

    /// The darkness of rows of pixels for each ink, by their lights: red, green and blue, 0 to 1.
    pub fn inks(lights: &[[f64; 3]], width: usize) -> [Self; INKS] {
        std::array::from_fn(|ink| {
            let dark = |lights: &[f64; 3]| {
                let lightest = lights.iter().copied().fold(0.0, f64::max);
                let dark = match ink.checked_sub(1) {
                    None => 1.0 - lightest,
                    Some(_) if lightest == 0.0 => 0.0,
                    Some(colour) => 1.0 - lights[colour] / lightest,
                };
                dark as f32
            };
            Self::new(lights.iter().map(dark).collect(), width)
        })
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

    /// The radius with which this many dots have the area of the ink. Dots that overlap cover less: of evenly spread
    /// ones the nearest touch where two thirds are to be covered, and black is covered to nine tenths.
    pub fn dot_radius(&self, count: usize) -> f64 {
        (self.ink() / (std::f64::consts::PI * count as f64)).sqrt()
    }
}

/// An image of a file; `gamma` is checked before.
pub fn load(path: &Path, gamma: f64) -> Result<DynamicImage> {
    if !(gamma > 0.0 && gamma.is_finite()) {
        let reason = format!("{gamma} is not a positive finite number");
        return Err(Error::InvalidArgument { argument: "--gamma", reason });
    }
    photo::read(path)
}

/// Refuses an image without ink.
fn check_ink(path: &Path, ink: f64) -> Result<()> {
    if ink > 0.0 {
        return Ok(());
    }
    let reason = "is all white: there is nothing to be drawn with dots".to_owned();
    Err(Error::Format { path: path.into(), reason })
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

    /// Light that passes all inks is that of the image.
    #[test]
    fn inks_leave_the_light_of_the_image() {
        let colours = [[255, 0, 0], [10, 200, 30], [0, 0, 0], [255, 255, 255], [90, 90, 90], [12, 0, 250]];
        let image = RgbaImage::from_fn(6, 1, |x, _| {
            let [r, g, b] = colours[x as usize];
            Rgba([r, g, b, 255])
        });
        let inks = Darkness::inks_of(&DynamicImage::from(image), 2.2);
        for (pixel, colour) in colours.into_iter().enumerate() {
            for (channel, value) in colour.into_iter().enumerate() {
                let left = (0..INKS).filter(|&ink| super::super::inks::ABSORBS[ink][channel]);
                let light: f64 = left.map(|ink| 1.0 - inks[ink].at(pixel, 0)).product();
                assert!((light - (f64::from(value) / 255.0).powf(2.2)).abs() < 1e-5, "{colour:?} {channel}: {light}");
            }
        }
        assert!(inks[0].at(0, 0) == 0.0 && inks[1].at(0, 0) == 0.0 && inks[2].at(0, 0) == 1.0);
    }
}
