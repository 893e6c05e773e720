//! `azulejo merge`, from outside.

mod common;

use std::fs;

use common::Workshop;

/// The points of a CSV file.
fn points(workshop: &Workshop, name: &str) -> Vec<[f64; 2]> {
    let text = fs::read_to_string(workshop.path(name)).unwrap();
    let number = |word: &str| f64::from(word.parse::<f32>().unwrap());
    text.lines().skip(1).map(|line| line.split_once(',').map(|(x, y)| [number(x), number(y)]).unwrap()).collect()
}

/// Two halves of the unit square, as PLY and as CSV, and a file of two points that must stay.
fn halves() -> Workshop {
    let workshop = Workshop::new();
    for (name, x0, x1, seed) in [("left", "0", "0.5", "1"), ("right", "0.5", "1", "2")] {
        for format in ["ply", "csv"] {
            let output = format!("{name}.{format}");
            let arguments = ["plane", "--radius", "0.05", "--domain", x0, "0", x1, "1", "--bounded", "--seed", seed];
            workshop.succeed(&[&arguments[..], &["-o", &output]].concat());
        }
    }
    workshop.write("fixed.xyz", "0.25 0.75\n0.625 0.5\n");
    workshop
}

#[test]
fn pieces_become_one_set_that_keeps_its_distance_around_the_torus() {
    let workshop = halves();
    let arguments = ["merge", "left.ply", "right.ply", "--fixed", "fixed.xyz", "--radius", "0.05", "-o", "all.csv"];
    let said = workshop.succeed(&arguments);
    let merged = points(&workshop, "all.csv");
    assert_eq!(merged[..2], [[0.25, 0.75], [0.625, 0.5]]);
    for (i, a) in merged.iter().enumerate() {
        for b in &merged[..i] {
            let offset = [0, 1].map(|axis| (a[axis] - b[axis]).abs()).map(|d| d.min(1.0 - d));
            assert!(offset[0].hypot(offset[1]) >= 0.05, "{a:?} {b:?}");
        }
    }
    // The numbers of the message add up: fixed points, kept and inserted ones.
    let words: Vec<_> = said.split([' ', ',']).collect();
    let before = |word: &str| words[words.iter().position(|w| *w == word).unwrap() - 1].parse::<usize>().unwrap();
    assert_eq!(2 + before("kept") + before("inserted"), merged.len());
    let given = points(&workshop, "left.csv").len() + points(&workshop, "right.csv").len();
    assert_eq!(before("kept") + before("eliminated"), given);
    assert!(before("eliminated") > 0 && before("inserted") > 0, "{said}");
}

#[test]
fn rectangles_are_given_where_files_do_not_name_them() {
    let workshop = halves();
    workshop.succeed(&["merge", "left.ply", "right.ply", "--radius", "0.05", "-o", "named.csv"]);
    let pieces = ["merge", "left.csv", "right.csv", "--radius", "0.05", "-o", "given.csv"];
    let said = workshop.refuse(&pieces, 1);
    assert!(said.starts_with("error: left.csv: does not name its rectangle"), "{said}");
    let one = [&pieces[..], &["--rectangle", "0", "0", "0.5", "1"]].concat();
    assert_eq!(workshop.refuse(&one, 1), "error: --rectangle: there are 1 for 2 pieces\n");
    workshop.succeed(&[&one[..], &["--rectangle", "0.5", "0", "1", "1"]].concat());
    assert_eq!(points(&workshop, "given.csv"), points(&workshop, "named.csv"));
}

#[test]
fn what_cannot_be_merged_is_refused() {
    let workshop = halves();
    workshop.refuse(&["merge", "left.ply", "-o", "a.ply"], 2);
    workshop.refuse(&["merge", "--radius", "0.05", "-o", "a.ply"], 2);
    let said = workshop.refuse(&["merge", "left.ply", "left.ply", "--radius", "0.05", "-o", "a.ply"], 1);
    assert_eq!(said, "error: pieces: the rectangles of left.ply and left.ply overlap\n");
    let said = workshop.refuse(&["merge", "left.ply", "right.ply", "--radius", "0.06", "-o", "a.ply"], 1);
    assert!(said.starts_with("error: pieces: left.ply: samples "), "{said}");
}
