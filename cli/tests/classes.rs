//! `azulejo plane` and `relax` with several classes, from outside.

mod common;
#[path = "common/ply.rs"]
#[allow(dead_code)]
mod ply;

use std::fs;

use common::Workshop;
use ply::{flat, nearest, points};

#[test]
fn plane_samples_of_several_classes() {
    let workshop = Workshop::new();
    let own = [0.04, 0.08, 0.02];
    let set = ["plane", "--classes", "0.04,0.08,0.02", "--class-factor", "0.8", "--seed", "3"];
    let said = workshop.succeed(&[&set[..], &["-o", "whole.csv"]].concat());
    assert!(said.contains(", by classes "), "{said}");
    let text = fs::read_to_string(workshop.path("whole.csv")).unwrap();
    assert!(text.starts_with("x,y,class\n"));
    let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect()).collect();
    for class in ["0", "1", "2"] {
        let own = own[class.parse::<usize>().unwrap()];
        let samples = rows.iter().filter(|row| row[2] == class).map(|row| [0, 1].map(|axis| row[axis].parse::<f64>()));
        let samples: Vec<_> = samples.map(|[x, y]| [x.unwrap(), y.unwrap()]).collect();
        assert!(samples.len() as f64 > 0.5 / (own * own), "{class} has {}", samples.len());
        for (i, a) in samples.iter().enumerate() {
            let [dx, dy] = [0, 1].map(|axis| samples[..i].iter().map(move |b| (a[axis] - b[axis]).abs()));
            let distance = |(dx, dy): (f64, f64)| dx.min(1.0 - dx).hypot(dy.min(1.0 - dy));
            assert!(dx.zip(dy).map(distance).all(|distance| distance >= own * (1.0 - 1e-12)), "{a:?} of {class}");
        }
    }
    // The other formats have the same rows, and can be read as sets of the plane.
    for (name, more) in [("whole.ply", &[][..]), ("window.ply", &["--window", "0.25", "0.5", "0.75", "1"])] {
        workshop.succeed(&[&set[..], more, &["-o", name]].concat());
        let (header, found) = flat(&fs::read(workshop.path(name)).unwrap(), 3);
        assert!(header.contains("property uint class"), "{header}");
        let [min, max] = if more.is_empty() { [[0.0, 0.0], [1.0, 1.0]] } else { [[0.25, 0.5], [0.75, 1.0]] };
        let of_text = |row: &Vec<&str>| [0, 1].map(|axis| row[axis].parse::<f32>().unwrap());
        let is_inside = |[x, y]: &[f32; 2]| (min[0]..max[0]).contains(x) && (min[1]..max[1]).contains(y);
        let expected = rows.iter().map(|row| (of_text(row), row[2].parse::<u32>().unwrap()));
        let found = found.iter().map(|row| ([row[0], row[1]], row[2].to_bits()));
        assert!(found.eq(expected.filter(|(sample, _)| is_inside(sample))), "{name}");
    }
    workshop.succeed(&[&set[..], &["-o", "whole.npy"]].concat());
    for name in ["whole.npy", "whole.ply", "whole.csv"] {
        workshop.succeed(&["plane", "--radius", "0.02", "--given", name, "-o", "none.csv"]);
        assert_eq!(fs::read_to_string(workshop.path("none.csv")).unwrap(), "x,y\n", "{name}");
    }
    workshop.refuse(&[&set[..], &["-o", "a.raw"]].concat(), 1);
    // In progressive order the ranks of each class fall.
    workshop.succeed(&[&set[..], &["--order", "progressive", "-o", "ordered.csv"]].concat());
    let text = fs::read_to_string(workshop.path("ordered.csv")).unwrap();
    assert!(text.starts_with("x,y,rank,class\n"), "{}", &text[..40]);
    let of_row = |row: Vec<&str>| (row[3].parse::<i32>().unwrap(), -row[2].parse::<f64>().unwrap());
    assert!(text.lines().skip(1).map(|line| of_row(line.split(',').collect())).is_sorted());
    workshop.refuse(&[&set[..], &["--order", "progressive", "-o", "a.raw"]].concat(), 1);
    workshop.refuse(&["plane", "--radius", "0.1", "--class-factor", "2", "-o", "a.ply"], 2);
    let said = workshop.refuse(&["plane", "--classes", "0.1,0", "-o", "a.ply"], 1);
    assert!(said.starts_with("error: own: [1] is 0.0"), "{said}");
}

/// The smallest distance on the unit torus within each of three classes, of rows of x, y and class as bits.
fn distances_of_classes(rows: &[Vec<f32>]) -> [f64; 3] {
    [0, 1, 2].map(|class| {
        let own: Vec<Vec<f32>> = rows.iter().filter(|row| row[2].to_bits() == class).cloned().collect();
        let pairs = own.iter().enumerate().skip(1);
        pairs.map(|(i, a)| nearest(&own[..i], [a[0].into(), a[1].into()])).fold(f64::MAX, f64::min)
    })
}

/// Classes stay with their points, and each is spread more evenly, which relaxation of the union does not do.
#[test]
fn relax_keeps_the_classes_of_a_file_and_spreads_each() {
    let workshop = Workshop::new();
    workshop.succeed(&["plane", "--classes", "0.06,0.06,0.06", "-o", "a.ply"]);
    let rows = |name: &str| flat(&fs::read(workshop.path(name)).unwrap(), 3);
    let said = workshop.succeed(&["relax", "a.ply", "--iterations", "60", "-o", "b.ply"]);
    assert!(said.contains(" 60 steps, smallest distance 0.0") && said.contains(", ρ 0."), "{said}");
    let ((header, before), (same, after)) = (rows("a.ply"), rows("b.ply"));
    assert!(header == same && header.contains("property uint class"), "{header}");
    assert!(before.iter().map(|row| row[2].to_bits()).eq(after.iter().map(|row| row[2].to_bits())));
    workshop.succeed(&["relax", "a.ply", "--iterations", "60", "--no-classes", "-o", "union.ply"]);
    let union = points(&workshop, "union.ply");
    assert_eq!(union.len(), before.len());
    let union: Vec<Vec<f32>> = union.iter().zip(&before).map(|(at, of)| vec![at[0], at[1], of[2]]).collect();
    let [before, after, union] = [&before, &after, &union].map(|rows| distances_of_classes(rows));
    for class in 0..3 {
        assert!(
            after[class] > 1.05 * before[class] && after[class] > 1.2 * union[class],
            "{before:?} {after:?} {union:?}"
        );
    }
    // The other formats with columns, and without steps the file as it was.
    for name in ["a.csv", "a.npy"] {
        workshop.succeed(&["plane", "--classes", "0.06,0.06,0.06", "-o", name]);
        workshop.succeed(&["relax", name, "--iterations", "0", "-o", "back.ply"]);
        assert!(fs::read(workshop.path("back.ply")).unwrap() == fs::read(workshop.path("a.ply")).unwrap(), "{name}");
    }
}

#[test]
fn classes_that_cannot_be_relaxed_are_refused_and_not_dropped() {
    let workshop = Workshop::new();
    workshop.succeed(&["plane", "--classes", "0.1,0.1", "-o", "a.ply"]);
    let refuse = |arguments: &[&str]| workshop.refuse(&[&["relax"], arguments].concat(), 1);
    let said = refuse(&["a.ply", "-o", "b.xyz"]);
    assert_eq!(said, "error: b.xyz: this format has no place for the classes of samples: give .ply, .npy or .csv\n");
    let said = refuse(&["a.ply", "--neighbourhood", "nearest", "-o", "b.ply"]);
    assert!(said.starts_with("error: neighbourhood: classes are relaxed"), "{said}");
    workshop.write("names.csv", "x,y,class\n0.1,0.1,oak\n0.9,0.9,elm\n");
    let said = refuse(&["names.csv", "--domain", "0", "0", "1", "1", "-o", "b.ply"]);
    let reason = "point 0: its class is no whole number: --no-classes takes the points for one set";
    assert_eq!(said, format!("error: names.csv: {reason}\n"));
    workshop.succeed(&["relax", "names.csv", "--domain", "0", "0", "1", "1", "--no-classes", "-o", "b.xyz"]);
    workshop.write("many.csv", "x,y,class\n0.1,0.1,3\n0.9,0.9,16\n");
    let said = refuse(&["many.csv", "--domain", "0", "0", "1", "1", "-o", "c.ply"]);
    assert_eq!(said, "error: many.csv: classes: [1] is 16, not below 16\n");
    workshop.write("roof.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 2 3\nf 1 4 2\n");
    workshop.succeed(&["surface", "roof.obj", "--classes", "0.3,0.3", "-o", "s.ply"]);
    let said = refuse(&["s.ply", "--mesh", "roof.obj", "-o", "c.ply"]);
    assert!(said.starts_with("error: s.ply: has classes, which are relaxed in the plane only"), "{said}");
    workshop.succeed(&["relax", "s.ply", "--mesh", "roof.obj", "--no-classes", "-o", "c.ply"]);
}
