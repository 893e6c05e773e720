//! Ordered dithering: an image in few levels, by comparison with a mask.

use super::Mask;
use crate::check;
use crate::error::{Error, Result};

/// The numbers of an image.
#[derive(Clone, Copy, Debug)]
pub enum Pixels<'a> {
    /// 0 to 255.
    Bytes(&'a [u8]),
    /// 0 to 1; what lies outside is taken as the nearest of these.
    Floats(&'a [f32]),
}

/// An image of the plane or, with a depth above 1, of space.
#[derive(Clone, Copy, Debug)]
pub struct Image<'a> {
    /// The pixels along x, y and z; any may be 0.
    pub size: [usize; 3],
    /// The numbers of a pixel, such as 1 of grey and 3 of colour; at least 1.
    pub channels: usize,
    /// The numbers of all pixels, those of one pixel after each other; x grows first, then y, then z.
    pub pixels: Pixels<'a>,
}

impl Pixels<'_> {
    fn len(&self) -> usize {
        match self {
            Self::Bytes(bytes) => bytes.len(),
            Self::Floats(floats) => floats.len(),
        }
    }

    /// A number in 0..=1.
    fn get(&self, i: usize) -> f64 {
        match self {
            Self::Bytes(bytes) => f64::from(bytes[i]) / 255.0,
            Self::Floats(floats) => f64::from(floats[i]).clamp(0.0, 1.0),
        }
    }
}

impl Mask {
    /// An image in `levels` levels: for each of its numbers the level, from 0 to `levels` - 1, in the same order.
    ///
    /// A number v becomes one of the levels beside v · (`levels` - 1), the upper one where the fraction exceeds 1 - t,
    /// t being the value of the mask at the pixel. The mask is repeated over the image, and its channels over those of
    /// the image. So the mean over a tile of one colour differs from that colour by half a rank at most, and the levels
    /// of 0 and 1 are the first and the last.
    ///
    /// Numbers are taken as they are. Light adds up where they are linear: an image in sRGB should be made linear
    /// before, unless there are many levels.
    ///
    /// O(pixels) time, on the thread that calls.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for `levels` outside 2..=256, `channels` of 0, an image that has more or fewer numbers
    /// than its size says (`image`), and numbers that are not finite (`image`, with the index).
    ///
    /// ```
    /// use azulejo::{Context, mask};
    ///
    /// let (mask, _) = mask::create(&Context::new(0)?, &mask::Options::new(16, 16), None)?;
    /// let grey = [0.25; 64 * 64];
    /// let image = mask::Image { size: [64, 64, 1], channels: 1, pixels: mask::Pixels::Floats(&grey) };
    /// let halftone = mask.dither(&image, 2)?;
    /// assert_eq!(halftone.iter().filter(|&&level| level == 1).count(), 64 * 64 / 4);
    /// # Ok::<(), azulejo::Error>(())
    /// ```
    pub fn dither(&self, image: &Image, levels: usize) -> Result<Vec<u8>> {
        check::range("levels", levels, 2..=256)?;
        let Image { size: [width, height, depth], channels, pixels } = *image;
        if channels == 0 {
            return Err(Error::invalid("channels", "0; a pixel has at least one number"));
        }
        let numbers = [width, height, depth].into_iter().try_fold(channels, usize::checked_mul);
        if numbers != Some(pixels.len()) {
            let reason =
                format!("{} numbers are not {width} x {height} x {depth} pixels of {channels} channels", pixels.len());
            return Err(Error::invalid("image", reason));
        }
        if let Pixels::Floats(floats) = pixels
            && let Some(i) = floats.iter().position(|number| !number.is_finite())
        {
            return Err(Error::invalid("image", format!("[{i}] is {}, not finite", floats[i])));
        }
        let (steps, count) = ((levels - 1) as f64, self.pixels());
        let mut out = Vec::with_capacity(pixels.len());
        for row in 0..height * depth {
            let (y, z) = (row % height % self.size[1], row / height % self.size[2]);
            let tile = (z * self.size[1] + y) * self.size[0];
            for x in 0..width {
                for channel in 0..channels {
                    let rank = self.ranks[channel % self.channels * count + tile + x % self.size[0]];
                    let threshold = (f64::from(rank) + 0.5) / count as f64;
                    out.push((pixels.get(out.len()) * steps + threshold).min(steps) as u8);
                }
            }
        }
        Ok(out)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Options, create};
    use super::*;
    use crate::job::Context;

    fn mask(options: &Options) -> Mask {
        create(&Context::new(1).unwrap(), options, None).unwrap().0
    }

    #[test]
    fn one_colour_keeps_its_mean_in_every_channel() {
        let mask = mask(&Options::new(12, 10).channels(2));
        for levels in [2, 3, 17, 256] {
            for colour in [[0.0, 1.0, 0.5], [0.3, 1.0 / 3.0, 0.999], [1e-3, -7.0, 3.0]] {
                let numbers: Vec<f32> = (0..24 * 30).flat_map(|_| colour).collect();
                let image = Image { size: [24, 30, 1], channels: 3, pixels: Pixels::Floats(&numbers) };
                let out = mask.dither(&image, levels).unwrap();
                for (channel, &v) in colour.iter().enumerate() {
                    let exact = f64::from(v.clamp(0.0, 1.0)) * (levels - 1) as f64;
                    let of_channel = || out.iter().skip(channel).step_by(3).map(|&level| f64::from(level));
                    assert!(of_channel().all(|level| level == exact.floor() || level == exact.ceil()), "{v} {levels}");
                    let mean = of_channel().sum::<f64>() / 720.0;
                    assert!((mean - exact).abs() <= 0.5 / 120.0 + 1e-9, "{v} in {levels}: {mean} for {exact}");
                }
            }
        }
    }

    #[test]
    fn the_mask_is_a_tile_whose_channels_are_repeated_too() {
        let mask = mask(&Options::new(5, 3).depth(2).channels(2).seed(9));
        let size = [11, 7, 5];
        let numbers: Vec<u8> = (0..11 * 7 * 5 * 3).map(|i| (i * 37 % 256) as u8).collect();
        let out = mask.dither(&Image { size, channels: 3, pixels: Pixels::Bytes(&numbers) }, 4).unwrap();
        for (i, (&level, &byte)) in out.iter().zip(&numbers).enumerate() {
            let pixel = i / 3;
            let place = [pixel % 11, pixel / 11 % 7, pixel / 77];
            let exact = f64::from(byte) / 85.0 + f64::from(mask.threshold(i % 3 % 2, place));
            assert_eq!(level, exact.floor().min(3.0) as u8, "{place:?}");
        }
    }

    #[test]
    fn bytes_and_floats_agree() {
        let mask = mask(&Options::new(16, 16));
        let bytes: Vec<u8> = (0..=255).collect();
        let floats: Vec<f32> = bytes.iter().map(|&byte| f32::from(byte) / 255.0).collect();
        let size = [16, 16, 1];
        for levels in [2, 5, 256] {
            let [a, b] = [Pixels::Bytes(&bytes), Pixels::Floats(&floats)]
                .map(|pixels| mask.dither(&Image { size, channels: 1, pixels }, levels).unwrap());
            assert_eq!(a, b);
            assert!(levels < 256 || a == bytes);
        }
    }

    #[test]
    fn wrong_images_are_refused_by_name() {
        let mask = mask(&Options::new(4, 4));
        let said = |size, channels, pixels, levels| {
            mask.dither(&Image { size, channels, pixels }, levels).unwrap_err().to_string()
        };
        let floats = [0.5, f32::NAN, 0.5, f32::INFINITY];
        assert_eq!(said([2, 2, 1], 1, Pixels::Floats(&floats), 2), "image: [1] is NaN, not finite");
        assert_eq!(
            said([2, 2, 1], 3, Pixels::Floats(&floats), 2),
            "image: 4 numbers are not 2 x 2 x 1 pixels of 3 channels"
        );
        assert!(said([usize::MAX, 2, 1], 3, Pixels::Bytes(&[0; 4]), 2).starts_with("image: 4 numbers are not"));
        assert_eq!(said([2, 2, 1], 1, Pixels::Bytes(&[0; 4]), 1), "levels: 1 is not in 2..=256");
        assert_eq!(said([2, 2, 1], 0, Pixels::Bytes(&[]), 2), "channels: 0; a pixel has at least one number");
        let nothing = Image { size: [0, 7, 1], channels: 1, pixels: Pixels::Bytes(&[]) };
        assert!(mask.dither(&nothing, 2).unwrap().is_empty());
    }
}
