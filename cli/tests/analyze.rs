//! `azulejo analyze`, from outside.

mod common;

use common::Workshop;
use serde_json::Value;

/// A lattice of 32 by 32 points of the unit torus.
fn lattice(workshop: &Workshop) {
    let mut text = String::new();
    (0..1024).for_each(|i| text += &format!("{} {}\n", f64::from(i % 32) / 32.0, f64::from(i / 32) / 32.0));
    workshop.write("lattice.xyz", text);
}

fn json(workshop: &Workshop, arguments: &[&str]) -> Value {
    let said = workshop.succeed(&[&["analyze", "--json"], arguments].concat());
    assert_eq!(said.lines().count(), 1);
    serde_json::from_str(&said).unwrap()
}

fn mean(value: &Value, key: &str) -> f64 {
    value["figures"][key]["mean"].as_f64().unwrap_or_else(|| panic!("{key}: {value}"))
}

#[test]
fn a_lattice_has_the_figures_of_a_lattice() {
    let workshop = Workshop::new();
    lattice(&workshop);
    let found = json(&workshop, &["lattice.xyz", "--radius", "0.03125"]);
    let side = 1.0 / 32.0;
    let unit = (2.0 / (3f64.sqrt() * 1024.0)).sqrt();
    for (key, expected) in [
        ("points", 1024.0),
        ("smallest_distance", side),
        ("rho", side / unit),
        ("nearest_mean", side / unit),
        ("covering_radius", side * 0.5f64.sqrt()),
        ("covering_radius_relative", side * 0.5f64.sqrt() / unit),
        ("below_30_degrees", 0.0),
        ("smallest_over_radius", 1.0),
        ("covering_over_radius", 0.5f64.sqrt()),
        ("gaps", 0.0),
    ] {
        assert!((mean(&found, key) - expected).abs() < 1e-6, "{key}: {}", mean(&found, key));
    }
    assert!(mean(&found, "low_power") < 1e-4);
    // Below the first peak, at 1, there is nothing: half of that is Nyquist's frequency.
    assert!((mean(&found, "effective_nyquist") - 0.5).abs() < 0.02, "{found}");
    assert_eq!(found["domain"]["boundary"], "periodic");
    // All pairs of neighbours are at the distance of the lattice, where alone the first bin is filled.
    let rows = found["distances"]["rows"].as_array().unwrap();
    let first = rows.iter().find(|row| row[1].as_f64().unwrap() > 0.0).unwrap();
    assert!((first[0].as_f64().unwrap() - side / unit).abs() < 0.02, "{first}");
    let nearest = found["nearest"]["rows"].as_array().unwrap();
    assert_eq!(nearest.iter().filter(|row| row[1].as_f64().unwrap() > 0.0).count(), 1);
    // Half the lattice spacing leaves a gap in each cell, and they are all connected.
    assert_eq!(mean(&json(&workshop, &["lattice.xyz", "--radius", "0.0157"]), "gaps"), 1024.0);
}

#[test]
fn the_table_says_what_the_json_says() {
    let workshop = Workshop::new();
    workshop.succeed(&["plane", "--radius", "0.03", "-o", "a.npy"]);
    let said = workshop.succeed(&["analyze", "a.npy", "--radius", "0.03"]);
    assert!(said.starts_with("a.npy: x 0 to 1, y 0 to 1, periodic\n\npoints "), "{said}");
    let found = json(&workshop, &["a.npy", "--radius", "0.03"]);
    let row = |name: &str| said.lines().find_map(|line| line.strip_prefix(name)).unwrap_or_else(|| panic!("{said}"));
    let shown = |name: &str| row(name).split_whitespace().next().unwrap().parse::<f64>().unwrap();
    for (name, key) in [
        ("points", "points"),
        ("smallest distance, relative (ρ)", "rho"),
        ("covering radius / radius", "covering_over_radius"),
        ("bond order ψ6", "bond_order"),
        ("oscillation Ω", "oscillation"),
    ] {
        let value = mean(&found, key);
        assert!((shown(name) - value).abs() <= 1e-5 * value.abs(), "{name}: {said}");
    }
    assert!(row("effective Nyquist frequency").ends_with("  √density"));
    assert!(mean(&found, "smallest_over_radius") >= 1.0 && mean(&found, "covering_over_radius") < 1.0 + 1e-5);
    assert_eq!(mean(&found, "gaps"), 0.0);
}

/// Each class is measured as the file of its points alone is, and the union as the file without classes.
#[test]
fn sets_of_several_classes_are_measured_by_class_too() {
    let workshop = Workshop::new();
    workshop.succeed(&["plane", "--classes", "0.04,0.08", "-o", "a.csv"]);
    workshop.write("roof.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 2 3\nf 1 4 2\n");
    workshop.succeed(&["surface", "roof.obj", "--classes", "0.1,0.2", "-o", "s.csv"]);
    for (name, options) in [("a.csv", &["--domain", "0", "0", "1", "1"][..]), ("s.csv", &["--mesh", "roof.obj"])] {
        let text = std::fs::read_to_string(workshop.path(name)).unwrap();
        let of = |keep: &dyn Fn(&str) -> bool| {
            let lines = text.lines().filter(|line| line.starts_with('x') || keep(line));
            lines.map(|line| format!("{}\n", line.rsplit_once(',').unwrap().0)).collect::<String>()
        };
        let analyzed = |file: &str| json(&workshop, &[&[file], options].concat());
        workshop.write("union.csv", of(&|_| true));
        let (found, union) = (analyzed(name), analyzed("union.csv"));
        assert!(found["figures"] == union["figures"] && union["classes"].is_null(), "{found}");
        let said = workshop.succeed(&[&["analyze", name], options].concat());
        assert!(said.contains("of each class alone:\n\nclass 0\n"), "{said}");
        for class in 0..2 {
            workshop.write("own.csv", of(&|line| line.ends_with(&format!(",{class}"))));
            let (found, alone) = (&found["classes"][class], analyzed("own.csv"));
            assert_eq!(found["class"], class);
            let figures = found["figures"].as_object().unwrap();
            assert!(
                figures.len() >= 5 && figures.iter().all(|(key, figure)| alone["figures"][key] == *figure),
                "{found}"
            );
        }
    }
    // A class that a file lacks is not known there; classes that are none are left out, and that is said.
    workshop.write("one.csv", "x,y,class\n0.1,0.1,0\n0.9,0.9,0\n");
    workshop.write("two.csv", "x,y,class\n0.1,0.1,0\n0.9,0.9,3\n");
    workshop.write("names.csv", "x,y,class\n0.1,0.1,oak\n0.9,0.9,elm\n");
    let square = ["--domain", "0", "0", "1", "1"];
    let found = json(&workshop, &[&["one.csv", "two.csv"], &square[..]].concat());
    assert!(found["classes"][1]["class"] == 3 && found["classes"][1]["figures"]["points"]["values"][0].is_null());
    for (files, reason) in [
        (&["names.csv"][..], "names.csv: point 0: its class is no whole number"),
        (&["one.csv", "names.csv"], "names.csv: point 0: its class is no whole number"),
    ] {
        let said = workshop.succeed(&[&["analyze"], files, &square].concat());
        assert!(said.ends_with(&format!("\nOf all points together, without classes: {reason}.\n")), "{said}");
        assert!(json(&workshop, &[files, &square].concat())["classes"].is_null());
    }
}

#[test]
fn several_files_are_averaged() {
    let workshop = Workshop::new();
    for seed in ["1", "2", "3"] {
        workshop.succeed(&["plane", "--radius", "0.03", "--seed", seed, "-o", &format!("{seed}.ply")]);
    }
    let found = json(&workshop, &["1.ply", "2.ply", "3.ply"]);
    let single = ["1.ply", "2.ply", "3.ply"].map(|file| mean(&json(&workshop, &[file]), "bond_order"));
    let order = &found["figures"]["bond_order"];
    assert!((order["mean"].as_f64().unwrap() - single.iter().sum::<f64>() / 3.0).abs() < 1e-12);
    assert_eq!(order["values"].as_array().unwrap().len(), 3);
    assert!(order["least"].as_f64() < order["greatest"].as_f64());
    let said = workshop.succeed(&["analyze", "1.ply", "2.ply", "3.ply"]);
    assert!(said.starts_with("3 sets, the first of 1.ply: ") && said.contains(" least    greatest\n"), "{said}");
    lattice(&workshop);
    let said = workshop.refuse(&["analyze", "1.ply", "lattice.xyz"], 1);
    assert!(said.starts_with("error: lattice.xyz: 1024 points, not about "), "{said}");
    workshop.succeed(&["plane", "--radius", "0.06", "--domain", "0", "0", "2", "2", "-o", "wide.ply"]);
    let said = workshop.refuse(&["analyze", "1.ply", "wide.ply"], 1);
    assert_eq!(said, "error: wide.ply: has another domain than 1.ply\n");
}

#[test]
#[cfg_attr(not(feature = "embree"), ignore = "pictures of meshes need Embree")]
fn every_plot_is_drawn() {
    let workshop = Workshop::new();
    workshop.succeed(&["plane", "--count", "2000", "--domain", "0", "0", "4", "1", "--bounded", "-o", "a.ply"]);
    workshop.succeed(&["analyze", "a.ply", "--plots", "plots/a"]);
    workshop.succeed(&["mesh", "sphere", "--detail", "32", "-o", "sphere.ply"]);
    workshop.succeed(&["surface", "sphere.ply", "--count", "2000", "-o", "s.ply"]);
    let said =
        workshop.succeed(&["analyze", "s.ply", "--mesh", "sphere.ply", "--radius", "0.05", "--plots", "plots/s"]);
    assert!(said.starts_with("s.ply: on sphere.ply of 1,024 triangles, area 12."), "{said}");
    let of_plane = ["points", "spectrum", "radial", "distances", "nearest"].map(|name| format!("plots/a/{name}.png"));
    let of_mesh = ["samples", "differences", "distances", "radial"].map(|name| format!("plots/s/{name}.png"));
    for name in of_plane.iter().chain(&of_mesh) {
        let picture = image::open(workshop.path(name)).unwrap().to_rgb8();
        let blue = picture.pixels().filter(|pixel| pixel[2] as i32 > pixel[0] as i32 + 25).count();
        let light = picture.pixels().filter(|pixel| pixel[0] > 240).count();
        assert!(picture.width() >= 900 && blue > 2000 && light * 5 > picture.pixels().len(), "{name}: {blue} {light}");
    }
}

#[test]
fn few_points_have_the_figures_that_they_have() {
    let workshop = Workshop::new();
    for (text, points) in [("0.5 0.5\n", 1.0), ("0.5 0.5\n0.25 0.25\n", 2.0), ("0.5 0.5\n0.5 0.5\n", 2.0)] {
        workshop.write("few.xyz", text);
        let found = json(&workshop, &["few.xyz", "--domain", "0", "0", "1", "1", "--radius", "0.1"]);
        assert_eq!(mean(&found, "points"), points);
        assert!(found["distances"]["rows"].is_null() && mean(&found, "covering_radius") > 0.4);
        workshop.succeed(&["analyze", "few.xyz", "--domain", "0", "0", "1", "1", "--plots", "plots"]);
    }
}

#[test]
fn what_cannot_be_analysed_is_refused_with_its_file() {
    let workshop = Workshop::new();
    lattice(&workshop);
    let said = workshop.refuse(&["analyze", "lattice.xyz", "--domain", "0", "0", "0.5", "1"], 1);
    assert!(said.starts_with("error: lattice.xyz: point 16 is (0.5, 0), outside the domain"), "{said}");
    for radius in ["0", "-1", "nan"] {
        let said = workshop.refuse(&["analyze", "lattice.xyz", "--radius", radius], 1);
        assert!(said.starts_with("error: --radius: "), "{said}");
    }
    workshop.write("file", "");
    let said = workshop.refuse(&["analyze", "lattice.xyz", "--plots", "file"], 1);
    assert!(said.starts_with("error: file: "), "{said}");
    let said = workshop.refuse(&["analyze", "lattice.xyz", "--mesh", "missing.obj"], 1);
    assert!(said.starts_with("error: lattice.xyz: ") || said.starts_with("error: missing.obj: "), "{said}");
    workshop.refuse(&["analyze"], 2);
    workshop.refuse(&["analyze", "lattice.xyz", "--mesh", "a.obj", "--bounded"], 2);
}

/// The simple cubic lattice of a torus, a quarter of a cell from its corner.
#[test]
fn a_lattice_of_a_cuboid_has_the_figures_of_a_lattice() {
    let workshop = Workshop::new();
    let at = |i: usize| [i % 8, i / 8 % 8, i / 64].map(|x| x as f64 + 0.25);
    let text: String = (0..512).map(|i| at(i).map(|x| x.to_string()).join(" ") + "\n").collect();
    workshop.write("cubes.xyz", text);
    let cuboid = ["cubes.xyz", "--cuboid", "0", "0", "0", "8", "8", "8"];
    let found = json(&workshop, &[&cuboid[..], &["--radius", "1"]].concat());
    let (unit, covering) = (2f64.sqrt().cbrt(), 0.75f64.sqrt());
    for (key, expected) in [
        ("points", 512.0),
        ("smallest_distance", 1.0),
        ("rho", 1.0 / unit),
        ("nearest_mean", 1.0 / unit),
        ("covering_radius", covering),
        ("covering_radius_relative", covering / unit),
        ("covering_over_radius", covering),
        ("gaps", 0.0),
        ("conflicts", 0.0),
    ] {
        assert!((mean(&found, key) - expected).abs() < 1e-8, "{key}: {found}");
    }
    // All power is at 8 of the 7 to 11 waves.
    assert!((mean(&found, "axis_power") - 512.0 / 5.0).abs() < 1e-5, "{found}");
    assert_eq!(found["domain"]["boundary"], "periodic");
    let open = json(&workshop, &[&cuboid[..], &["--radius", "0.8", "--bounded"]].concat());
    // One in the middle of each cube of the lattice, and one that spreads along the three upper faces, .75 from it.
    assert_eq!(mean(&open, "gaps"), 7.0 * 7.0 * 7.0 + 1.0);
    let text = workshop.succeed(&[&["analyze"], &cuboid[..]].concat());
    assert!(text.starts_with("cubes.xyz: x 0 to 8, y 0 to 8, z 0 to 8, periodic\n"), "{text}");
}
