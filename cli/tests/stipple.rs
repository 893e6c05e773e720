//! `azulejo stipple`, from outside.

mod common;

use std::fs;

use common::Workshop;
use image::{GrayImage, Luma, Rgb, RgbImage};

const SIDE: u32 = 96;

/// A ramp from black at the left to white at the right, whose grey values are light.
fn write_ramp(workshop: &Workshop, name: &str) {
    let ramp = GrayImage::from_fn(SIDE, SIDE / 2, |x, _| Luma([(255 * x / (SIDE - 1)) as u8]));
    ramp.save(workshop.path(name)).unwrap();
}

/// The centres of an SVG drawing, and the diameter of its dots.
fn drawing(workshop: &Workshop, name: &str) -> (Vec<[f64; 2]>, f64) {
    let text = fs::read_to_string(workshop.path(name)).unwrap();
    assert!(text.contains("viewBox=\"0 0 96 48\"") && text.ends_with("</svg>\n"), "{}", &text[..200]);
    let dot = |line: &str| {
        let (x, y) = line.strip_prefix('M')?.strip_suffix("h0")?.split_once(' ')?;
        Some([x.parse().unwrap(), y.parse().unwrap()])
    };
    let width = text.split("stroke-width=\"").nth(1).unwrap().split('"').next().unwrap();
    (text.lines().filter_map(dot).collect(), width.parse().unwrap())
}

#[test]
fn dots_have_the_number_and_the_ink_that_the_image_asks_for() {
    let workshop = Workshop::new();
    write_ramp(&workshop, "ramp.png");
    let said = workshop.succeed(&["stipple", "ramp.png", "-o", "a.svg", "--count", "3000", "--gamma", "1"]);
    assert!(said.starts_with("a.svg: 3,000 samples, 100 steps, dots of radius 0.49"), "{said}");
    let (dots, diameter) = drawing(&workshop, "a.svg");
    assert_eq!(dots.len(), 3000);
    let ink = 3000.0 * std::f64::consts::PI * (0.5 * diameter).powi(2);
    assert!((ink / (0.5 * 96.0 * 48.0) - 1.0).abs() < 0.01, "{ink}");
    for [from, to] in [[0.0, 24.0], [24.0, 48.0], [48.0, 72.0], [72.0, 96.0]] {
        let found = dots.iter().filter(|[x, _]| (from..to).contains(x)).count() as f64;
        let share = |x: f64| (2.0 - x / 96.0) * x / 96.0;
        let expected = 3000.0 * (share(to) - share(from));
        assert!((found - expected).abs() < 0.03 * expected + 5.0, "{found} for {expected}");
    }
}

#[test]
fn without_relaxation_there_are_about_as_many() {
    let workshop = Workshop::new();
    write_ramp(&workshop, "ramp.png");
    let said = workshop.succeed(&["stipple", "ramp.png", "-o", "a.svg", "--count", "3000", "--no-relax"]);
    let (dots, diameter) = drawing(&workshop, "a.svg");
    assert!((2700..3300).contains(&dots.len()) && !said.contains("steps"), "{said}");
    let told = said.split("dots of radius ").nth(1).unwrap().split(',').next().unwrap().parse::<f64>().unwrap();
    assert!((told / (0.5 * diameter) - 1.0).abs() < 1e-3, "{said}");
}

#[test]
fn pictures_are_as_dark_as_the_image_and_files_of_points_hold_the_centres() {
    let workshop = Workshop::new();
    write_ramp(&workshop, "ramp.png");
    for gamma in ["1", "2.2"] {
        let exponent: f64 = gamma.parse().unwrap();
        let arguments = ["stipple", "ramp.png", "-o", "a.png", "--count", "800", "--size", "960", "--gamma", gamma];
        workshop.succeed(&arguments);
        let picture = image::open(workshop.path("a.png")).unwrap().to_luma8();
        assert_eq!((picture.width(), picture.height()), (960, 480));
        let light = |image: &GrayImage, side: u32| {
            let half = image.width() / 2;
            let pixels = image.enumerate_pixels().filter(|(x, _, _)| x / half == side);
            let sum: f64 = pixels.map(|(_, _, grey)| (f64::from(grey[0]) / 255.0).powf(exponent)).sum();
            sum / f64::from(half * image.height())
        };
        let ramp = image::open(workshop.path("ramp.png")).unwrap().to_luma8();
        // Where it is darkest dots overlap.
        assert!((light(&picture, 1) - light(&ramp, 1)).abs() < 0.03, "{gamma}");
        assert!((light(&picture, 0) - light(&ramp, 0)).abs() < 0.15, "{gamma}");
    }
    workshop.succeed(&["stipple", "ramp.png", "-o", "a.ply", "--count", "800", "--iterations", "3", "--threads", "1"]);
    let first = fs::read(workshop.path("a.ply")).unwrap();
    assert!(String::from_utf8_lossy(&first[..200]).contains("comment domain 0 0 96 48 bounded\nelement vertex 800\n"));
    workshop.succeed(&["stipple", "ramp.png", "-o", "a.ply", "--count", "800", "--iterations", "3", "--threads", "3"]);
    assert!(fs::read(workshop.path("a.ply")).unwrap() == first);
    workshop.succeed(&["stipple", "ramp.png", "-o", "a.ply", "--count", "800", "--iterations", "3", "--seed", "1"]);
    assert!(fs::read(workshop.path("a.ply")).unwrap() != first);
}

#[test]
fn what_cannot_be_drawn_is_refused_with_its_name() {
    let workshop = Workshop::new();
    write_ramp(&workshop, "ramp.png");
    GrayImage::from_pixel(8, 8, Luma([255])).save(workshop.path("white.png")).unwrap();
    workshop.write("text.png", "no picture");
    for (image, start) in [
        ("white.png", "white.png: "),
        ("text.png", "text.png: is neither a PNG nor a JPEG file"),
        ("missing.png", "missing.png: "),
    ] {
        let said = workshop.refuse(&["stipple", image, "-o", "a.svg", "--count", "100"], 1);
        assert!(said.starts_with(&format!("error: {start}")), "{said}");
    }
    let said = workshop.refuse(&["stipple", "ramp.png", "-o", "a.jpg", "--count", "100"], 1);
    assert_eq!(said, "error: a.jpg: the extension names no format of dots: give svg, png or ply\n");
    for gamma in ["0", "-1", "nan", "inf"] {
        let said = workshop.refuse(&["stipple", "ramp.png", "-o", "a.svg", "--count", "100", "--gamma", gamma], 1);
        assert!(said.starts_with("error: --gamma: "), "{said}");
    }
    for wrong in [
        &["-o", "a.svg"][..],
        &["-o", "a.svg", "--count", "0"],
        &["-o", "a.svg", "--count", "9", "--size", "1"],
        &["--count", "9"],
    ] {
        workshop.refuse(&[&["stipple", "ramp.png"], wrong].concat(), 2);
    }
    let both = ["stipple", "ramp.png", "-o", "a.svg", "--count", "9", "--no-relax", "--iterations", "3"];
    workshop.refuse(&both, 2);
}

/// Bands of red, of a dark blue and of grey that gets lighter, beside white.
fn bands() -> RgbImage {
    RgbImage::from_fn(SIDE, SIDE / 2, |x, y| match 4 * x / SIDE {
        0 => Rgb([255, 60, 60]),
        1 => Rgb([40, 40, 160]),
        2 => Rgb([2 * y as u8 + 100; 3]),
        _ => Rgb([255; 3]),
    })
}

#[test]
fn four_inks_give_the_colours_of_the_image() {
    let workshop = Workshop::new();
    let image = bands();
    image.save(workshop.path("bands.png")).unwrap();
    workshop.succeed(&[
        "stipple",
        "bands.png",
        "--cmyk",
        "-o",
        "a.png",
        "--count",
        "4000",
        "--size",
        "960",
        "--gamma",
        "1",
    ]);
    let picture = image::open(workshop.path("a.png")).unwrap().to_rgb8();
    let light = |image: &RgbImage, band: u32, channel: usize| {
        let width = image.width() / 4;
        let pixels = image.enumerate_pixels().filter(|(x, _, _)| x / width == band);
        let sum: f64 = pixels.map(|(_, _, colour)| f64::from(colour[channel]) / 255.0).sum();
        sum / f64::from(width * image.height())
    };
    for (band, channel) in (0..4).flat_map(|band| (0..3).map(move |channel| (band, channel))) {
        let (drawn, wanted) = (light(&picture, band, channel), light(&image, band, channel));
        // Where it is darkest dots of one ink overlap.
        assert!((drawn - wanted).abs() < 0.1, "band {band}, channel {channel}: {drawn} for {wanted}");
    }
}

#[test]
fn dots_of_inks_keep_apart() {
    let workshop = Workshop::new();
    bands().save(workshop.path("bands.png")).unwrap();
    let draw = |output: &str, threads: &str| {
        workshop.succeed(&["stipple", "bands.png", "--cmyk", "-o", output, "--count", "1500", "--threads", threads])
    };
    let said = draw("a.ply", "1");
    draw("b.ply", "2");
    assert_eq!(fs::read(workshop.path("a.ply")).unwrap(), fs::read(workshop.path("b.ply")).unwrap());
    let bytes = fs::read(workshop.path("a.ply")).unwrap();
    let body = bytes.windows(11).position(|window| window == b"end_header\n").unwrap() + 11;
    let dots: Vec<([f64; 2], u32)> = bytes[body..]
        .chunks_exact(16)
        .map(|dot| {
            let word = |i: usize| dot[4 * i..4 * i + 4].try_into().unwrap();
            ([0, 1].map(|axis| f32::from_le_bytes(word(axis)).into()), u32::from_le_bytes(word(3)))
        })
        .collect();
    assert!((1450..=1550).contains(&dots.len()), "{said}");
    let radius: f64 = said.split("dots of radius ").nth(1).unwrap().split(',').next().unwrap().parse().unwrap();
    // 0.75 of Wei's cross radius where they are densest, in the dark blue.
    for (i, (a, ink)) in dots.iter().enumerate() {
        for (b, other) in &dots[..i] {
            let apart = (a[0] - b[0]).hypot(a[1] - b[1]);
            assert!(ink == other || apart >= 0.69 * radius, "{a:?} {ink}, {b:?} {other}");
        }
    }
    // Red is made of magenta and yellow, blue of cyan and magenta with black; white has nothing.
    let count =
        |band: usize, ink: u32| dots.iter().filter(|(at, of)| at[0] as usize / 24 == band && *of == ink).count();
    assert!(count(0, 0) + count(0, 1) < 20 && count(0, 2) > 100 && count(0, 3) > 100, "{said}");
    assert!(count(1, 0) > 100 && count(1, 1) > 100 && count(1, 2) > 100 && count(1, 3) < 30, "{said}");
    assert!(count(2, 0) > 100 && count(2, 1) + count(2, 2) + count(2, 3) < 20, "{said}");
    assert!((0..4).map(|ink| count(3, ink)).sum::<usize>() < 20, "{said}");
    workshop.succeed(&["stipple", "bands.png", "--cmyk", "-o", "a.svg", "--count", "500"]);
    let drawing = fs::read_to_string(workshop.path("a.svg")).unwrap();
    assert_eq!((drawing.matches("<path").count(), drawing.matches("multiply").count()), (4, 4));
    let refused =
        workshop.refuse(&["stipple", "bands.png", "--cmyk", "--no-relax", "-o", "a.svg", "--count", "500"], 2);
    assert!(refused.contains("--no-relax"), "{refused}");
}

/// A photograph gives the dots of the pixels that it holds, known by its contents, whatever it is called.
#[test]
fn photographs_are_read() {
    let workshop = Workshop::new();
    let photo = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/images/colour.jpg");
    let bytes = fs::read(photo).unwrap();
    fs::write(workshop.path("photo.png"), &bytes).unwrap();
    for (image, output) in [(photo, "a.ply"), ("photo.png", "b.ply")] {
        workshop.succeed(&["stipple", image, "-o", output, "--count", "300", "--iterations", "3"]);
    }
    let dots = fs::read(workshop.path("a.ply")).unwrap();
    assert!(String::from_utf8_lossy(&dots[..200]).contains("comment domain 0 0 40 28 bounded\nelement vertex 300\n"));
    assert!(dots == fs::read(workshop.path("b.ply")).unwrap());
    fs::write(workshop.path("half.jpg"), &bytes[..bytes.len() / 2]).unwrap();
    let said = workshop.refuse(&["stipple", "half.jpg", "-o", "a.svg", "--count", "100"], 1);
    assert_eq!(said, "error: half.jpg: is a damaged JPEG file: it ends too early\n");
}
