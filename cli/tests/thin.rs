//! `azulejo thin`, from outside.

mod common;

use std::fs;

use common::Workshop;

const TEXT: &str = "ply\nformat ascii 1.0\ncomment scanned\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
    property uchar red\nproperty float confidence\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
    0 0 0 255 .5\n0.1 0 0 1 .25\n1 0 0 2 1e-3\n1.00 0 0.05 3 0\n0.5 0 0 4 9\n3 0 1 2\n";

#[test]
fn vertices_keep_their_attributes_in_the_format_of_the_file() {
    let workshop = Workshop::new();
    workshop.write("text.ply", TEXT);
    let said = workshop.succeed(&["thin", "text.ply", "--radius", "0.2", "-o", "out.ply"]);
    assert!(said.starts_with("out.ply: 3 of 5 points, "), "{said}");
    let header = "ply\nformat ascii 1.0\ncomment scanned\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        property uchar red\nproperty float confidence\nend_header\n";
    let written = |name: &str| fs::read_to_string(workshop.path(name)).unwrap();
    assert_eq!(written("out.ply"), format!("{header}0 0 0 255 .5\n1 0 0 2 1e-3\n0.5 0 0 4 9\n"));

    let row = |place: [f32; 3], red: u8, confidence: f32| {
        [place.map(f32::to_le_bytes).concat(), vec![red], confidence.to_le_bytes().to_vec()].concat()
    };
    let rows = [row([0.0; 3], 255, 0.5), row([0.1, 0.0, 0.0], 1, 0.25), row([1.0, 0.0, 0.0], 2, 1e-3)];
    let head = header.replace("ascii", "binary_little_endian");
    workshop.write("binary.ply", [head.as_bytes(), &rows.concat()].concat());
    workshop.succeed(&["thin", "binary.ply", "--radius", "0.2", "-o", "out.ply"]);
    let expected = [head.replace("vertex 3", "vertex 2").as_bytes(), &rows[0], &rows[2]].concat();
    assert_eq!(fs::read(workshop.path("out.ply")).unwrap(), expected);
}

#[test]
fn points_come_in_the_order_of_the_cloud_or_coarse_to_fine() {
    let workshop = Workshop::new();
    workshop.write("cloud.csv", "x,y,name\n0,0,a\n0.1,0,b\n1,0,c\n1,0.05,d\n0.5,0,e\n");
    let names = |arguments: &[&str]| {
        let arguments = [&["thin", "cloud.csv", "-o", "out.csv"], arguments].concat();
        workshop.succeed(&arguments);
        let text = fs::read_to_string(workshop.path("out.csv")).unwrap();
        text.lines().map(|line| line.split(',').nth(2).unwrap().to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(names(&["--radius", "0.3"]), ["name", "a", "c", "e"]);
    let progressive = names(&["--order", "progressive"]);
    let counted = names(&["--count", "3"]);
    let mut first = progressive[..4].to_vec();
    first[1..].sort();
    assert_eq!((progressive.len(), progressive[0].as_str(), first), (6, "name", counted));
    assert_eq!(names(&["--order", "progressive", "--radius", "0.3"]), progressive[..4]);
    let text = fs::read_to_string(workshop.path("out.csv")).unwrap();
    let ranks: Vec<f32> = text.lines().skip(1).map(|line| line.split(',').nth(3).unwrap().parse().unwrap()).collect();
    assert!(text.starts_with("x,y,name,rank\n") && ranks[0] == f32::INFINITY && ranks.is_sorted_by(|a, b| a >= b));
    fs::rename(workshop.path("out.csv"), workshop.path("ranked.csv")).unwrap();
    let said = workshop.refuse(&["thin", "ranked.csv", "--order", "progressive", "-o", "again.csv"], 1);
    assert_eq!(said, "error: ranked.csv: has a column rank already\n");
    workshop.succeed(&["thin", "ranked.csv", "--count", "2", "-o", "again.csv"]);
    assert_eq!(names(&["--count", "1e6"]), ["name", "a", "b", "c", "d", "e"]);
    let other = (0..20).any(|seed| names(&["--order", "progressive", "--seed", &seed.to_string()]) != progressive);
    assert!(other);
}

#[test]
fn coordinates_far_from_the_origin_keep_their_distances() {
    let workshop = Workshop::new();
    let head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nend_header\n";
    let rows = "5432100.01 600000.5\n5432100.02 600000.5\n5432100.03 600000.5\n";
    workshop.write("map.ply", format!("{head}{rows}"));
    workshop.succeed(&["thin", "map.ply", "--radius", "0.015", "-o", "out.ply"]);
    let text = fs::read_to_string(workshop.path("out.ply")).unwrap();
    assert!(text.ends_with("end_header\n5432100.01 600000.5\n5432100.03 600000.5\n"), "{text}");
}

#[test]
fn what_cannot_be_thinned_is_refused() {
    let workshop = Workshop::new();
    workshop.write("cloud.ply", TEXT);
    workshop.write("bad.ply", TEXT.replace("1.00 0", "nan 0"));
    workshop.write("points.raw", [0.0f32, 1.0, 2.0, 3.0].map(f32::to_le_bytes).concat());
    workshop.refuse(&["thin", "cloud.ply", "-o", "a.ply"], 2);
    workshop.refuse(&["thin", "cloud.ply", "--count", "0", "-o", "a.ply"], 2);
    let said = workshop.refuse(&["thin", "cloud.ply", "--radius", "-1", "-o", "a.ply"], 1);
    assert_eq!(said, "error: radius: -1 is not a positive finite number\n");
    let said = workshop.refuse(&["thin", "bad.ply", "--count", "2", "-o", "a.ply"], 1);
    assert_eq!(said, "error: bad.ply: point 3 is [NaN, 0.0, 0.05], not finite\n");
    let said = workshop.refuse(&["thin", "cloud.ply", "--count", "2", "-o", "a.csv"], 1);
    assert_eq!(said, "error: a.csv: the extension names another format than that of the cloud, which is kept\n");
    let said = workshop.refuse(&["thin", "points.raw", "--count", "2", "-o", "a.raw"], 1);
    assert!(said.starts_with("error: points.raw: raw floats do not say"), "{said}");
    workshop.succeed(&["thin", "points.raw", "--dimensions", "2", "--count", "1", "-o", "a.raw"]);
    assert_eq!(fs::metadata(workshop.path("a.raw")).unwrap().len(), 8);
}

#[test]
fn doubles_far_from_the_origin_keep_the_radius() {
    let workshop = Workshop::new();
    // A lattice of 0.5 at (500000, 4649776), moved here and there by less than floats can tell.
    let place =
        |i: usize| [500000.0 + 0.5 * (i % 30) as f64 + 0.011 * (i % 7) as f64, 4649776.0 + 0.5 * (i / 30) as f64];
    let rows: String = (0..600).map(|i| format!("{},{}\n", place(i)[0], place(i)[1])).collect();
    workshop.write("far.csv", format!("x,y\n{rows}"));
    let ply = "ply\nformat ascii 1.0\nelement vertex 600\nproperty double x\nproperty double y\nend_header\n";
    workshop.write("far.ply", format!("{ply}{}", rows.replace(',', " ")));
    for name in ["far.csv", "far.ply"] {
        let out = name.replace("far", "out");
        workshop.succeed(&["thin", name, "--radius", "0.52", "-o", &out]);
        let text = fs::read_to_string(workshop.path(&out)).unwrap();
        let numbers = text.lines().filter(|line| line.starts_with("500"));
        let kept: Vec<[f64; 2]> = numbers
            .map(|line| {
                line.split([',', ' ']).map(|word| word.parse().unwrap()).collect::<Vec<f64>>().try_into().unwrap()
            })
            .collect();
        let distance = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        let pairs = || kept.iter().enumerate().flat_map(|(i, a)| kept[..i].iter().map(move |b| distance(a, b)));
        assert!(kept.len() > 150 && pairs().all(|d| d >= 0.52), "{name}");
        assert!((0..600).all(|i| kept.iter().any(|at| distance(at, &place(i)) < 0.52 + 1e-4)), "{name}");
    }
}
