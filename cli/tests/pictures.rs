//! `azulejo draw`, from outside.

mod common;

use std::fs;

use common::Workshop;
use image::RgbImage;

/// A picture as it is in its file.
fn picture(workshop: &Workshop, name: &str) -> RgbImage {
    image::open(workshop.path(name)).unwrap().to_rgb8()
}

/// The share of pixels in a part of a picture, given in shares of its sides, that are clearly blue.
fn blue(picture: &RgbImage, [left, top, right, bottom]: [f64; 4]) -> f64 {
    let (width, height) = (picture.width() as f64, picture.height() as f64);
    let inside = |x: u32, y: u32| {
        let (x, y) = (x as f64 / width, y as f64 / height);
        (left..right).contains(&x) && (top..bottom).contains(&y)
    };
    let part: Vec<_> = picture.enumerate_pixels().filter(|&(x, y, _)| inside(x, y)).collect();
    let count = part.iter().filter(|(_, _, colour)| colour[2] as i32 > colour[0] as i32 + 25).count();
    count as f64 / part.len() as f64
}

#[test]
fn points_are_drawn_beside_their_spectrum() {
    let workshop = Workshop::new();
    workshop.succeed(&["plane", "--count", "1000", "-o", "a.ply"]);
    workshop.succeed(&["draw", "points", "a.ply", "-o", "a.png", "--size", "800"]);
    let picture = picture(&workshop, "a.png");
    assert_eq!((picture.width(), picture.height()), (800, 575));
    let dots = blue(&picture, [0.08, 0.08, 0.46, 0.6]);
    assert!((0.1..0.5).contains(&dots), "{dots}");
    // The middle of the spectrum is empty, what is around it is not.
    let (hole, around) = (blue(&picture, [0.72, 0.31, 0.77, 0.37]), blue(&picture, [0.55, 0.08, 0.65, 0.2]));
    assert!(hole < 0.5 && around > 0.8, "{hole} {around}");
    assert!(blue(&picture, [0.0, 0.0, 1.0, 0.02]) == 0.0);
    assert_eq!(workshop.files(), ["a.ply", "a.png"]);
}

#[test]
fn a_large_set_is_drawn_in_part_and_a_strange_one_as_it_is() {
    let workshop = Workshop::new();
    workshop.succeed(&["plane", "--count", "30000", "--domain", "-2", "0", "2", "3", "-o", "large.ply"]);
    let header = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nend_header\n";
    workshop.write("two.ply", format!("{header}5 5\n5 5\n"));
    workshop.write("line.ply", format!("{header}-1e6 3\n1e6 3\n"));
    for name in ["large", "two", "line"] {
        let (input, output) = (format!("{name}.ply"), format!("{name}.png"));
        workshop.succeed(&["draw", "points", &input, "-o", &output, "--size", "400"]);
        let picture = picture(&workshop, &output);
        assert_eq!((picture.width(), picture.height()), (400, 288));
        assert!(blue(&picture, [0.0, 0.0, 1.0, 1.0]) > 0.001, "{name}");
    }
}

#[test]
#[cfg_attr(not(feature = "embree"), ignore = "pictures of meshes need Embree")]
fn samples_are_painted_on_their_mesh() {
    let workshop = Workshop::new();
    workshop.succeed(&["mesh", "knot", "--detail", "100", "-o", "knot.ply"]);
    workshop.succeed(&["draw", "surface", "knot.ply", "knot.ply", "-o", "a.png", "--size", "400"]);
    let picture = picture(&workshop, "a.png");
    assert_eq!((picture.width(), picture.height()), (400, 247));
    // The knot in the left part, with its dots; a close view in the lower right one; nothing around.
    let (whole, detail) = (blue(&picture, [0.1, 0.1, 0.7, 0.95]), blue(&picture, [0.72, 0.55, 0.97, 0.95]));
    assert!(whole > 0.05 && detail > 0.05, "{whole} {detail}");
    assert!(blue(&picture, [0.0, 0.1, 0.05, 1.0]) == 0.0);
    let first = fs::read(workshop.path("a.png")).unwrap();
    workshop.succeed(&["draw", "surface", "knot.ply", "knot.ply", "-o", "a.png", "--size", "400", "--threads", "1"]);
    assert!(fs::read(workshop.path("a.png")).unwrap() == first, "the threads change the picture");
}

#[test]
#[cfg_attr(not(feature = "embree"), ignore = "pictures of meshes need Embree")]
fn one_looks_into_a_hall_that_is_cut_away() {
    let workshop = Workshop::new();
    workshop.succeed(&["mesh", "hall", "--detail", "16", "-o", "hall.ply"]);
    // Samples on the back wall only, behind everything.
    let mut samples =
        "ply\nformat ascii 1.0\nelement vertex 100\nproperty float x\nproperty float y\nproperty float z\n\
        end_header\n"
            .to_owned();
    (0..100).for_each(|i| samples += &format!("{} {} -2\n", 0.2 * f64::from(i / 5), 0.1 + 0.2 * f64::from(i % 5)));
    workshop.write("samples.ply", samples);
    let [closed, open] = [&[][..], &["--cutaway"]].map(|flags| {
        let arguments = ["draw", "surface", "hall.ply", "samples.ply", "-o", "a.png", "--size", "400"];
        workshop.succeed(&[&arguments[..], flags].concat());
        blue(&picture(&workshop, "a.png"), [0.05, 0.2, 0.69, 0.9])
    });
    assert!(closed < 0.03 && open > closed + 0.02, "{closed} {open}");
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let workshop = Workshop::new();
    workshop.succeed(&["mesh", "knot", "--detail", "16", "-o", "knot.ply"]);
    workshop.write("garbage.ply", "ply\nformat ascii 1.0\nend_header\n");
    workshop.write("flat.obj", "v 1 1 1\nv 2 2 2\nv 3 3 3\nf 1 2 3\n");
    fs::create_dir(workshop.path("folder")).unwrap();
    let refuse = |arguments: &[&str], named: &str| {
        let said = workshop.refuse(&[arguments, &["-o", "a.png"]].concat(), 1);
        assert!(said.starts_with(&format!("error: {named}: ")), "{said}");
    };
    for name in ["missing.ply", "garbage.ply", "folder"] {
        refuse(&["draw", "points", name], name);
        refuse(&["draw", "surface", name, "knot.ply"], name);
        refuse(&["draw", "surface", "knot.ply", name], name);
    }
    let said = workshop.refuse(&["draw", "surface", "flat.obj", "knot.ply", "-o", "a.png"], 1);
    assert!(said.starts_with("error: "), "{said}");
    let said = workshop.refuse(&["draw", "points", "knot.ply", "-o", "a.jpg"], 1);
    assert!(said.starts_with("error: a.jpg: the extension is not .png"), "{said}");
    let said = workshop.refuse(&["draw", "points", "knot.ply", "-o", "folder"], 1);
    assert!(said.starts_with("error: folder: "), "{said}");
    for size in ["0", "50", "1000000", "-5", "big"] {
        workshop.refuse(&["draw", "points", "knot.ply", "-o", "a.png", "--size", size], 2);
    }
}
