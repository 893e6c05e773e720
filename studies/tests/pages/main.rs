//! The pages that `azulejo-studies --quick` writes, from outside.

mod goals;
mod order;
mod plane;
#[path = "../recomputed/mod.rs"]
mod recomputed;
mod relaxation;
mod samplers;
mod surfaces;
mod volume;

use std::fs;
use std::process::{Command, Output};

use azulejo_cli::procedural::knot::knot;
use image::RgbImage;
use recomputed::Recomputed;
use tempfile::TempDir;

fn studies(directory: &TempDir, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_azulejo-studies")).args(arguments).current_dir(directory).output().unwrap()
}

/// A page with its pictures.
struct Page {
    directory: TempDir,
    text: String,
}

impl Page {
    /// The pages that a study writes into `directory`, quickly. It prints no progress, as it has no terminal.
    fn of(directory: TempDir, study: &str, arguments: &[&str]) -> Self {
        let common = [study, "--quick", "--out", "pages/docs", "--threads", "2"];
        let output = studies(&directory, &[&common, arguments].concat());
        let said = [output.stdout, output.stderr].map(|said| String::from_utf8(said).unwrap());
        assert!(output.status.success() && said == ["", ""], "{said:?}");
        let text = fs::read_to_string(directory.path().join(format!("pages/docs/{study}.md"))).unwrap();
        Self { directory, text }
    }

    fn quick(study: &str) -> Self {
        Self::of(tempfile::tempdir().unwrap(), study, &[])
    }

    /// The names and the pictures that the page shows.
    fn pictures(&self) -> Vec<(String, RgbImage)> {
        let targets = self.text.split("](").skip(1).map(|rest| rest.split(')').next().unwrap());
        // Other targets are pages.
        let names = targets.filter(|target| target.ends_with(".png"));
        let open = |name: &str| image::open(self.directory.path().join("pages/docs").join(name)).unwrap().to_rgb8();
        names.map(|name| (name.to_owned(), open(name))).collect()
    }

    /// Checks that there are verdicts, and that the verdicts that can be recomputed follow from the tables.
    fn check_verdicts(&self, least: usize) -> Recomputed {
        let all = Recomputed::of(&self.text);
        assert!(all.right >= least && all.wrong.is_empty(), "{all:#?}");
        all
    }

    /// Checks that there are `count` pictures, all at least so wide and with something dark.
    fn check_pictures(&self, count: usize, width: u32) {
        let pictures = self.pictures();
        assert_eq!(pictures.len(), count);
        for (name, picture) in pictures {
            let has_ink = picture.pixels().any(|pixel| pixel[0] < 128);
            assert!(picture.width() >= width && has_ink, "{name}");
        }
    }
}

/// Checks that a verdict follows from what is printed: two means with their errors, then t, p and the verdict.
fn check_verdict((means, [t, p, found]): ([String; 2], [String; 3]), verdict: &str, is_met: impl Fn(f64) -> bool) {
    let number = |text: &str| text.trim().parse::<f64>().unwrap();
    let [[own, own_error], [other, other_error]] = means.each_ref().map(|mean| {
        let (mean, error) = mean.split_once('±').unwrap();
        [number(mean), number(error)]
    });
    let difference = (own - other) / own_error.hypot(other_error);
    // Errors are printed with few digits.
    assert!((difference - number(&t)).abs() <= 0.1 + 0.4 * difference.abs(), "{means:?}: {t}, not {difference}");
    let p = if p.starts_with('<') { 0.0 } else { number(&p) };
    assert_eq!(found == verdict, is_met(p), "{means:?} {p}");
}

/// A knot as an OBJ file.
fn knot_file() -> String {
    let (positions, triangles) = knot(64);
    let vertices = positions.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n"));
    vertices
        .chain(triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(|vertex| vertex + 1);
            format!("f {a} {b} {c}\n")
        }))
        .collect()
}

/// The number that a cell begins with, before its error or range.
fn mean(cell: &str) -> f64 {
    cell.split_whitespace().next().unwrap().parse().unwrap_or_else(|_| panic!("{cell} is no number"))
}

/// The cells of the rows of a page that have so many, and a number in one of them.
fn rows_with(page: &str, cells: usize, number: usize) -> Vec<Vec<String>> {
    let rows = page.lines().map(|line| line.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect());
    rows.filter(|row: &Vec<String>| row.len() == cells && row[number].parse::<f64>().is_ok()).collect()
}

#[test]
fn a_page_is_refused_where_it_cannot_be_written() {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("file"), "").unwrap();
    for page in ["kdrt", "psp", "dcr", "classes", "order", "gallery", "goals", "volume"] {
        let refused = studies(&directory, &[page, "--quick", "--out", "file"]);
        let said = String::from_utf8(refused.stderr).unwrap();
        assert!(refused.status.code() == Some(1) && said.starts_with("error: file"), "{said}");
    }
}
