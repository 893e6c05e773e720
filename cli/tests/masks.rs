//! `azulejo mask`, from outside.

mod common;

use std::fs;

use common::Workshop;
use image::{DynamicImage, GrayImage, Luma, Rgb, RgbImage};

/// The ranks of a raw file.
fn ranks(workshop: &Workshop, name: &str) -> Vec<u32> {
    let bytes = fs::read(workshop.path(name)).unwrap();
    bytes.chunks_exact(4).map(|bytes| u32::from_le_bytes(bytes.try_into().unwrap())).collect()
}

fn picture(workshop: &Workshop, name: &str) -> DynamicImage {
    image::open(workshop.path(name)).unwrap()
}

#[test]
fn a_picture_has_the_ranks_of_the_numbers() {
    let workshop = Workshop::new();
    let size = ["--width", "24", "--height", "10", "--channels", "2", "--seed", "3"];
    let said = workshop.succeed(&[&["mask", "-o", "a.raw"], &size[..]].concat());
    assert!(said.starts_with("a.raw: 24 x 10 x 1 pixels, channels: 2, "), "{said}");
    workshop.succeed(&[&["mask", "-o", "a.png", "--threads", "1"], &size[..]].concat());
    let ranks = ranks(&workshop, "a.raw");
    for channel in ranks.chunks(240) {
        let mut sorted = channel.to_vec();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..240));
    }
    let DynamicImage::ImageLumaA16(image) = picture(&workshop, "a.png") else { panic!("16 bits, grey and alpha") };
    assert_eq!((image.width(), image.height()), (24, 10));
    let expected =
        (0..240).flat_map(|pixel| [ranks[pixel], ranks[240 + pixel]]).map(|rank| (rank * 65536 / 240) as u16);
    assert!(image.into_raw().into_iter().eq(expected));
}

#[test]
fn slices_of_a_mask_of_space_stand_below_each_other() {
    let workshop = Workshop::new();
    workshop.succeed(&["mask", "--width", "6", "--height", "5", "--depth", "4", "-o", "a.png"]);
    let image = picture(&workshop, "a.png");
    assert_eq!((image.width(), image.height(), image.color().has_color()), (6, 20, false));
}

#[test]
fn a_halftone_has_the_light_of_the_image_in_few_levels() {
    let workshop = Workshop::new();
    let ramp = GrayImage::from_fn(128, 64, |x, _| Luma([(2 * x) as u8]));
    ramp.save(workshop.path("ramp.png")).unwrap();
    let colour = RgbImage::from_pixel(64, 64, Rgb([0, 128, 255]));
    colour.save(workshop.path("colour.png")).unwrap();
    let size = ["--width", "32", "--height", "32"];
    let dithered = |image: &str, more: &[&str]| {
        workshop.succeed(&[&["mask", "-o", "out.png", "--dither", image], &size[..], more].concat());
        picture(&workshop, "out.png")
    };
    let light = |value: u8| (f64::from(value) / 255.0).powf(2.2);
    let mean = |values: &[u8]| values.iter().map(|&value| light(value)).sum::<f64>() / values.len() as f64;
    for (levels, most) in [("2", 0.01), ("5", 0.005)] {
        let image = dithered("ramp.png", &["--levels", levels]).into_luma8();
        let mut values = image.as_raw().clone();
        assert!((mean(&values) - mean(ramp.as_raw())).abs() < most, "{levels}: {}", mean(&values));
        values.sort_unstable();
        values.dedup();
        assert_eq!(values.len().to_string(), levels);
    }
    let image = dithered("colour.png", &["--gamma", "1"]).into_rgb8();
    let of = |channel: usize| image.as_raw().iter().skip(channel).step_by(3).filter(|&&value| value == 255).count();
    assert_eq!((of(0), of(2)), (0, 64 * 64));
    assert!(of(1).abs_diff(64 * 64 * 128 / 255) <= 4, "{}", of(1));
}

#[test]
fn what_is_wrong_is_named() {
    let workshop = Workshop::new();
    workshop.write("text.png", "no picture");
    let size = ["--width", "8", "--height", "8"];
    for (arguments, said) in [
        (&["-o", "a.jpg"][..], "a.jpg: the extension names no format of masks"),
        (&["-o", "a.png", "--channels", "5"], "a.png: a PNG file has up to 4 channels"),
        (&["-o", "a.raw", "--dither", "text.png"], "a.raw: a halftone is written as PNG"),
        (&["-o", "a.png", "--dither", "text.png"], "text.png: is neither a PNG nor a JPEG file"),
        (&["-o", "a.png", "--sigma", "nan"], "sigma: NaN is not in 0.5..=4"),
        (&["-o", "a.png", "--depth", "65"], "depth: 65 is not in 1..=64"),
        (&["-o", "a.png", "--channels", "0"], "channels: 0 is not in 1..=64"),
    ] {
        let error = workshop.refuse(&[&["mask"], &size[..], arguments].concat(), 1);
        assert!(error.contains(said), "{arguments:?}: {error}");
    }
    workshop.refuse(&["mask", "-o", "a.png", "--width", "8"], 2);
    workshop.refuse(&[&["mask", "-o", "a.png", "--levels", "3"], &size[..]].concat(), 2);
}
