//! Images that are read: PNG and JPEG files, known by their contents.

use std::io::Cursor;
use std::path::Path;

use azulejo::{Error, Result};
use image::metadata::Orientation;
use image::{DynamicImage, GrayImage, ImageError, ImageFormat, ImageReader, Limits, RgbImage};
use jpeg_decoder::{Decoder, Error as JpegError, PixelFormat};

use crate::input;

/// The largest side of an image.
const LARGEST: u32 = 32_768;

/// An image of a PNG or JPEG file, or of the standard input for `-`. Photographs are turned as their cameras say.
pub fn read(path: &Path) -> Result<DynamicImage> {
    let bytes = input::bytes(path)?;
    let refused = |reason| Error::Format { path: path.into(), reason };
    // By the contents: the name proves nothing.
    match image::guess_format(&bytes) {
        Ok(ImageFormat::Png) => png(bytes).map_err(|error| match error {
            ImageError::IoError(source) => Error::Io { path: path.into(), source },
            other => refused(other.to_string()),
        }),
        Ok(ImageFormat::Jpeg) => jpeg(&bytes).map_err(refused),
        _ => Err(refused("is neither a PNG nor a JPEG file".to_owned())),
    }
}

fn png(bytes: Vec<u8>) -> image::ImageResult<DynamicImage> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
    let mut limits = Limits::default();
    (limits.max_image_width, limits.max_image_height) = (Some(LARGEST), Some(LARGEST));
    reader.limits(limits);
    reader.decode()
}

/// Not by the crate `image`, which fills what a damaged file lacks with grey and takes any inks for colours.
fn jpeg(bytes: &[u8]) -> std::result::Result<DynamicImage, String> {
    let mut decoder = Decoder::new(bytes);
    // What the header claims is looked at before memory is asked for.
    decoder.read_info().map_err(damage)?;
    let info = decoder.info().ok_or("has no header")?;
    let [width, height] = [info.width, info.height].map(u32::from);
    match info.pixel_format {
        PixelFormat::L8 | PixelFormat::RGB24 => {}
        PixelFormat::CMYK32 => {
            return Err("is a JPEG file in CMYK, inks whose colours it does not say: convert it to RGB".to_owned());
        }
        PixelFormat::L16 => return Err("is a lossless JPEG file, which is not read: convert it to PNG".to_owned()),
    }
    let size = u64::from(width) * u64::from(height) * info.pixel_format.pixel_bytes() as u64;
    if width.max(height) > LARGEST || Limits::default().max_alloc.is_some_and(|most| size > most) {
        return Err(format!("is a JPEG file of {width} x {height} pixels, which are too many"));
    }
    let pixels = decoder.decode().map_err(damage)?;
    let image = match info.pixel_format {
        PixelFormat::L8 => GrayImage::from_raw(width, height, pixels).map(DynamicImage::from),
        _ => RgbImage::from_raw(width, height, pixels).map(DynamicImage::from),
    };
    let mut image = image.ok_or("is a damaged JPEG file: it lacks pixels")?;
    if let Some(turned) = decoder.exif_data().and_then(Orientation::from_exif_chunk) {
        image.apply_orientation(turned);
    }
    Ok(image)
}

fn damage(error: JpegError) -> String {
    match error {
        JpegError::Format(reason) => format!("is a damaged JPEG file: {reason}"),
        JpegError::Unsupported(feature) => format!("is a JPEG file of a kind that is not read: {feature:?}"),
        // The bytes are in memory: they can only end.
        JpegError::Io(_) => "is a damaged JPEG file: it ends too early".to_owned(),
        JpegError::Internal(source) => format!("cannot be decoded: {source}"),
    }
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::*;

    /// A file that Pillow 13 has written, the pixels that it reads from one (PNG) beside it.
    fn at(name: &str) -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/images").join(name)
    }

    fn bytes_of(name: &str) -> Vec<u8> {
        std::fs::read(at(name)).unwrap()
    }

    /// Baseline with a quarter of the colours, progressive with all of them, grey and large enough for threads of the
    /// decoder's, and one that a camera has turned.
    #[test]
    fn pixels_are_those_of_an_independent_decoder() {
        for (name, is_colour) in [("colour", true), ("progressive", true), ("grey", false), ("turned", true)] {
            let found = read(&at(&format!("{name}.jpg"))).unwrap();
            let expected = read(&at(&format!("{name}.png"))).unwrap();
            assert_eq!(found.color().has_color(), is_colour, "{name}");
            assert_eq!((found.width(), found.height()), (expected.width(), expected.height()), "{name}");
            let differences = found.to_rgb8().into_raw().into_iter().zip(expected.to_rgb8().into_raw());
            let differences: Vec<u8> = differences.map(|(found, expected)| found.abs_diff(expected)).collect();
            let mean = differences.iter().map(|&by| f64::from(by)).sum::<f64>() / differences.len() as f64;
            let most = differences.into_iter().max().unwrap();
            assert!(most <= 4 && mean < 0.5, "{name}: {most}, {mean} in the mean");
        }
    }

    #[test]
    fn inks_are_refused() {
        let said = read(&at("cmyk.jpg")).unwrap_err().to_string();
        assert!(said.contains("cmyk.jpg: is a JPEG file in CMYK"), "{said}");
    }

    /// Everywhere: in the header, in the tables and in the pixels.
    #[test]
    fn a_file_that_ends_early_is_refused() {
        for name in ["colour.jpg", "progressive.jpg", "grey.jpg"] {
            let bytes = bytes_of(name);
            for length in 3..bytes.len() {
                let said = jpeg(&bytes[..length]).unwrap_err();
                assert!(said.starts_with("is a damaged JPEG file: "), "{name} of {length} bytes: {said}");
            }
        }
    }

    /// Any image or any error: no panic, and no memory for what only a header claims.
    #[test]
    fn damage_is_no_panic() {
        for name in ["colour.jpg", "progressive.jpg", "turned.jpg"] {
            let bytes = bytes_of(name);
            for place in 2..bytes.len() {
                for byte in [0, 1, bytes[place] ^ 0x10, 0xff] {
                    let mut damaged = bytes.clone();
                    damaged[place] = byte;
                    if let Ok(image) = jpeg(&damaged) {
                        assert!(image.width().max(image.height()) <= LARGEST);
                    }
                }
            }
        }
    }

    #[test]
    fn sizes_are_limited_before_they_are_decoded() {
        let mut bytes = bytes_of("colour.jpg");
        let header = bytes.windows(2).position(|marker| marker == [0xff, 0xc0]).unwrap();
        for (height, width) in [(8u16, 32_769u16), (32_768, 32_768)] {
            bytes[header + 5..header + 7].copy_from_slice(&height.to_be_bytes());
            bytes[header + 7..header + 9].copy_from_slice(&width.to_be_bytes());
            let said = jpeg(&bytes).unwrap_err();
            assert_eq!(said, format!("is a JPEG file of {width} x {height} pixels, which are too many"));
        }
    }
}
