//! The pages that `azulejo-studies --quick` writes, from outside.

mod recomputed;

use std::fs;
use std::os::unix::fs::PermissionsExt;
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
    /// What a study writes into `directory`, quickly. It says nothing: nothing is a terminal here.
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

    /// Checks that there are verdicts, and that those that can be computed anew follow from the tables.
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

#[test]
fn a_quick_page_of_the_plane_has_every_table_and_picture_that_it_shows() {
    let page = Page::quick("kdrt");
    for figure in ["table 2.2", "fig. 2.11", "fig. 2.13", "fig. 2.15 to 2.19"] {
        assert!(page.text.contains(figure), "{figure}");
    }
    for name in ["reference", "6r", "20r", "40r", "80r"] {
        assert!(page.text.contains(&format!("\n| {name} ")), "{name}");
    }
    let rows = rows_with(&page.text, 9, 3);
    // Contrast, and three quantities in three places, for each size of leaves.
    assert_eq!(rows.len() % (1 + 3 * 3), 0);
    assert!(!rows.is_empty() && !page.text.contains("NaN"));
    let columns = |row: &[String]| ([row[4].clone(), row[2].clone()], [6, 7, 8].map(|cell| row[cell].clone()));
    assert!(rows.iter().all(|row| ["**not met**", "no difference shown"].contains(&&*row[8])), "{rows:?}");
    rows.iter().for_each(|row| check_verdict(columns(row), "no difference shown", |p| p > 0.01));
    page.check_pictures(7, 900);
    assert_eq!(page.check_verdicts(10).unknown, [""; 0]);
}

const VERDICTS: [&str; 3] = ["met", "**not met**", "not decided"];

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

#[test]
fn a_quick_page_of_surfaces_says_what_is_left_out_and_shows_the_rest() {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("knot.obj"), knot_file()).unwrap();
    let page = Page::of(directory, "psp", &["--bunny", "knot.obj"]);
    for figure in [
        "fig. 3.8 and 3.9",
        "fig. 3.10 and 3.11",
        "fig. 3.8, 3.12 and 3.13",
        "fig. 3.14",
        "table 3.1",
        "fig. 3.19",
        "fig. 3.20",
        "fig. 3.21",
    ] {
        assert!(page.text.contains(figure), "{figure}");
    }
    assert!(page.text.contains("**The dragon was not given") && !page.text.contains("The bunny was not given"));
    // No gap is beyond rounding; two rounds decide nothing of times.
    let covered = page.text.lines().find(|line| line.starts_with("| covering radius less r")).unwrap();
    assert_eq!(covered.matches(", met |").count(), 2, "{covered}");
    let threads = page.text.lines().find(|line| line.starts_with("| 2 threads, times as fast")).unwrap();
    assert_eq!(threads.matches(", not decided |").count(), 2, "{threads}");
    assert!(page.text.contains("the bunny took the least time is not decided"));
    assert!(page.text.contains("\n| bunny | ") && page.text.contains("\n| hall | ") && !page.text.contains("NaN"));
    page.check_pictures(10, 400);
    page.check_verdicts(10);
    let errors =
        page.text.lines().filter_map(|line| line.strip_suffix(" % |")?.rsplit("| ").next()?.parse::<f64>().ok());
    let errors: Vec<_> = errors.collect();
    assert!(errors.len() >= 16 && errors.iter().all(|error| error.abs() < 20.0), "{errors:?}");
    let refused = studies(&page.directory, &["psp", "--quick", "--dragon", "missing.ply", "--out", "pages/docs"]);
    assert_eq!(refused.status.code(), Some(1));
}

#[test]
fn a_quick_page_of_relaxation_has_every_method_and_plausible_figures() {
    let page = Page::quick("dcr");
    let pictures = [
        "momentum-delaunay",
        "momentum-nearest",
        "thesis-delaunay",
        "thesis-nearest",
        "others",
        "radii-delaunay",
        "radii-nearest",
        "distributions",
        "remeshing",
        "corners",
        "density",
        "surfaces",
    ];
    page.check_pictures(pictures.len(), 900);
    let page = page.text;
    for (image, relaxed) in ["ramp", "sphere", "knot"].into_iter().flat_map(|image| [(image, "PSP"), (image, "random")])
    {
        let start = format!("| {image} | 1,000 | from {relaxed} | ");
        let row = page.lines().find_map(|line| line.strip_prefix(&start)).unwrap_or_else(|| panic!("{start}"));
        assert!(row.ends_with("| met |"), "{row}");
    }
    for name in pictures {
        assert!(page.contains(&format!("](dcr/{name}.png)")), "{name}");
    }
    let rows = page.lines().map(|line| line.split('|').map(str::trim).collect::<Vec<_>>());
    let bounded: Vec<_> = rows.clone().filter(|cells| cells.len() == 16 && cells[2] == "300").collect();
    // Two methods from two starts each, and one start as it is.
    assert_eq!(bounded.len(), 2 * 2 + 1);
    for row in bounded {
        let [rho, least, cover, largest, boundary] = [5, 6, 7, 8, 9].map(|cell| mean(row[cell]));
        assert!(0.6 < least && least <= rho && rho < 1.0 && 0.577 < cover && cover <= largest && boundary <= cover);
        assert!((10..15).all(|cell| (0.7..1.5).contains(&mean(row[cell]))), "{row:?}");
    }
    let rows: Vec<_> = rows.filter(|cells| cells.len() == 15 && ["random", "KDRT"].contains(&cells[3])).collect();
    // Two sizes of the momentum method, one of the thesis's, from two starts each.
    assert_eq!(rows.len(), 2 * 2 * 2 + 2 * 2);
    for row in rows {
        let [rho, least, nearest, cover, order, power, obtuse, edges] =
            [4, 5, 6, 7, 8, 9, 10, 11].map(|cell| mean(row[cell]));
        assert!(0.5 < least && least <= rho && rho < nearest && nearest < 1.0, "{row:?}");
        assert!((0.577..1.5).contains(&cover) && (0.4..0.75).contains(&order), "{row:?}");
        assert!(
            0.0 < power && power < 0.1 && (0.5..15.0).contains(&obtuse) && (0.01..0.03).contains(&edges),
            "{row:?}"
        );
    }
    assert!(page.contains("Sets of 1,000 points and more are left out") && !page.contains("NaN"));
    check_others(&page);
    check_variations_of_the_thesis(&page);
    check_surfaces(&page);
}

/// Of the page of relaxation: other methods, and the verdict beside push-pull.
fn check_others(page: &str) {
    let rows = rows_with(page, 15, 1);
    let names: Vec<_> = rows.iter().map(|row| row[0].as_str()).collect();
    assert_eq!(names, ["push-pull", "push-pull", "CVT", "CVT", "FPO", "FPO", "CCVT", "CCVT"]);
    assert!(rows.iter().all(|row| row[2] == row[12]), "all come to their end: {rows:?}");
    let verdicts = rows_with(page, 10, 4);
    // Six figures from two starts.
    assert_eq!(verdicts.len(), 6 * 2, "{verdicts:?}");
    for row in &verdicts {
        let is_higher_better = row[2] == "ρ";
        let (own, other) = (row[3].clone(), row[5].clone());
        let means = if is_higher_better { [own, other] } else { [other, own] };
        check_verdict((means, [7, 8, 9].map(|cell| row[cell].clone())), "met", |p| p <= 0.01);
    }
}

/// Of the page of relaxation: the sphere before and after, and what was not given.
fn check_surfaces(page: &str) {
    let rows = page.lines().filter(|line| line.starts_with("| sphere | 102,400 |"));
    let number = |cell: &str| cell.trim().trim_end_matches(" %").parse::<f64>().unwrap();
    let figures = rows.map(|row| row.split('|').collect::<Vec<_>>());
    // Smallest distance, obtuse triangles, variation of the edges.
    let figures: Vec<_> = figures.map(|cells| [5, 8, 10].map(|cell| number(cells[cell]))).collect();
    let [before, after] = figures[..] else { panic!("{figures:?}") };
    assert!(before[0] < 0.79 && after[0] > 0.83 && after[1] < before[1] && after[2] < before[2], "{figures:?}");
    assert!(["bunny", "dragon"].iter().all(|name| page.contains(&format!("The {name} is left out"))));
}

/// Of the page of relaxation: the sections on what the thesis's algorithm can be varied by, and on remeshing.
fn check_variations_of_the_thesis(page: &str) {
    for figure in ["(thesis §4.4.4)", "fig. 4.13 to 4.15", "fig. 4.19 and 4.20", "fig. 4.21"] {
        assert!(page.contains(figure), "{figure}");
    }
    let rows: Vec<Vec<_>> = page.lines().map(|line| line.split('|').map(str::trim).collect()).collect();
    let number = |cell: &str| -> f64 {
        let number = cell.trim_matches('*').split(' ').next().unwrap();
        number.parse().unwrap_or_else(|_| panic!("{cell} is no number"))
    };
    // Start, the thesis's steps, those by its test and by motion, with and without activeness, and two rho.
    let starts: Vec<_> = rows.iter().filter(|row| row.len() == 11 && row[2].parse::<u32>().is_ok()).collect();
    assert_eq!(starts.iter().map(|row| row[1]).collect::<Vec<_>>(), ["KDRT", "PSP", "random"]);
    for row in starts {
        assert!([4, 5, 8, 9].iter().all(|&cell| (20.0..=1000.0).contains(&number(row[cell]))), "{row:?}");
        assert!([6, 7].iter().all(|&cell| (0.5..0.9).contains(&number(row[cell]))), "{row:?}");
    }
    // Four radii after three numbers of steps: what is visited from one end only does not come to rest.
    let variances: Vec<_> = rows.iter().filter(|row| row.len() == 10 && row[1].contains(" and 1.")).collect();
    let variances: Vec<_> = variances.iter().filter(|row| row[2].parse::<u32>().is_ok()).collect();
    assert_eq!(variances.len(), 12);
    for row in variances.iter().filter(|row| row[1] == "0.95 and 1.05" && row[2] == "400") {
        let [active, average, dominant, zero, mixed] = [3, 4, 5, 6, 7].map(|cell| number(row[cell]));
        assert!(active < dominant && active < zero && average < dominant && mixed < dominant, "{row:?}");
    }
    let shares = |name: &str| {
        let row = rows.iter().find(|row| row.len() == 7 && row[1] == name).unwrap();
        [2, 3, 4, 5].map(|cell| number(row[cell]))
    };
    for name in ["obtuse triangles", "variance of edge lengths / mean²", "variance of areas / mean²"] {
        let [thrown, momentum, thesis, capacity] = shares(name);
        assert!(momentum < 0.7 * thrown && thesis < 0.7 * thrown && capacity < thrown, "{name}");
    }
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
fn a_quick_page_of_classes_has_their_shares_and_those_of_wei() {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("knot.obj"), knot_file()).unwrap();
    let page = Page::of(directory, "classes", &["--bunny", "knot.obj", "--dragon", "knot.obj"]);
    page.check_pictures(5, 400);
    assert_eq!(page.check_verdicts(19).unknown, [""; 0]);
    let page = page.text;
    assert!(!page.contains("NaN") && !page.contains("is left out"), "{page}");
    let shares = |listed: &str| listed.split(" / ").map(|share| share.parse().unwrap()).collect::<Vec<f64>>();
    // Own radii, factor, shares, all.
    let own = rows_with(&page, 4, 1);
    assert_eq!(own.len(), 8 * 3, "{own:?}");
    for mix in own.chunks_exact(3) {
        let mean = |row: &Vec<String>| {
            let shares = shares(&row[2]);
            shares.iter().sum::<f64>() / shares.len() as f64
        };
        assert!(mix.iter().is_sorted_by(|a, b| mean(a) < mean(b)), "smaller factors leave more: {mix:?}");
        let is_falling = mix[0][0].contains('½');
        let first = shares(&mix[0][2])[0];
        assert!(if is_falling { first > 0.9 } else { (0.7..0.9).contains(&first) }, "{mix:?}");
    }
    // Own radii, maker, shares, all, and the eight figures.
    let pairs = rows_with(&page, 12, 3);
    assert_eq!(pairs.len(), 8 * 2);
    for pair in pairs.chunks_exact(2) {
        let ([azulejo, wei], all) = ([&pair[0], &pair[1]], |row: &Vec<String>| row[3].parse::<f64>().unwrap());
        assert_eq!([&azulejo[1], &wei[1]], ["azulejo", "Wei"]);
        assert!(all(azulejo) > all(wei) && all(wei) > 0.5, "{pair:?}");
    }
    let two = |name: &str| shares(&second_cell(&page, name));
    assert!(two("1 and 0.99")[1] < two("1 and 1")[1] - 0.05, "the jump at ties");
}

/// The second cell of the row of this name.
fn second_cell(page: &str, name: &str) -> String {
    let row = page.lines().find(|line| line.starts_with(&format!("| {name} |"))).unwrap();
    row.split('|').nth(2).unwrap().trim().to_owned()
}

#[test]
fn a_quick_page_of_progressive_order_has_prefixes_as_promised() {
    let page = Page::quick("order");
    page.check_pictures(2, 900);
    let page = page.text;
    assert!(!page.contains("NaN"), "{page}");
    let ratios = page.lines().filter(|line| line.contains("covering radius / smallest distance at most"));
    assert!(ratios.clone().count() == 3 && ratios.clone().all(|line| line.ends_with("| met |")), "{page}");
    // Quotient, N·r², two ratios and two ρ: prefixes are worse the larger the quotient is, and none is as good as a set.
    let distances = rows_with(&page, 6, 2);
    let distances: Vec<_> = distances.iter().filter(|row| row[5].starts_with("0.")).collect();
    let names = ["2^(1/8)", "2^(1/4)", "√2", "direct"];
    assert_eq!(distances.iter().map(|row| row[0].as_str()).collect::<Vec<_>>(), names);
    let largest: Vec<f64> = distances.iter().map(|row| row[2].parse().unwrap()).collect();
    assert!(largest[..3].is_sorted() && largest[3] < largest[0], "{largest:?}");
    // Samples, quotient, ρ, P, ν, anisotropy, from direct.
    let spectra = rows_with(&page, 7, 2);
    assert_eq!(spectra.len(), 5 * 4);
    assert!(spectra.iter().all(|row| (0.6..0.9).contains(&row[2].parse::<f64>().unwrap())), "{spectra:?}");
}

#[test]
fn a_quick_page_of_tiling_has_every_item_of_the_thesis_with_verdicts_that_follow() {
    let page = Page::quick("tiling");
    page.check_pictures(4, 900);
    assert_eq!(page.check_verdicts(40).unknown, [""; 0]);
    let page = page.text;
    assert!(!page.contains("NaN") && !page.contains("inf"), "{page}");
    for item in [
        "table 2.1",
        "eq. 2.4",
        "Algorithms 3 and 4",
        "(thesis §2.5.3)",
        "(thesis §2.5.2)",
        "fig. 2.14",
        "fig. 2.20",
        "fig. 2.12",
    ] {
        assert!(page.lines().any(|line| line.starts_with("## ") && line.contains(item)), "{item}");
    }
    // Claim, the lower mean, n, the higher one, n, t, p, verdict.
    let claims: Vec<_> = rows_with(&page, 8, 5).into_iter().filter(|row| VERDICTS.contains(&&*row[7])).collect();
    assert!(claims.len() > 40, "{}", claims.len());
    for row in &claims {
        check_verdict(([row[3].clone(), row[1].clone()], [5, 6, 7].map(|cell| row[cell].clone())), "met", |p| {
            p <= 0.01
        });
    }
    // What must hold exactly.
    let facts: Vec<_> = page.lines().filter(|line| line.contains("conflict-free, and maximal up to")).collect();
    assert!(facts.len() == 5 && facts.iter().all(|line| line.ends_with("| met |")), "{facts:?}");
    // R_leaf, bound, processed, tested, eliminated, inserted, excess: seams touch less the larger the leaves are.
    let seams = rows_with(&page, 7, 1);
    assert_eq!(seams.iter().map(|row| row[0].as_str()).collect::<Vec<_>>(), ["6r", "10r", "20r", "40r", "80r"]);
    let inserted: Vec<_> = seams.iter().map(|row| mean(&row[5])).collect();
    assert!(inserted.is_sorted_by(|a, b| a > b), "{inserted:?}");
    assert!(seams.iter().zip(&inserted).all(|(row, inserted)| *inserted < mean(&row[1])));
    // Without one of the randomnesses: contrast, or a peak.
    let random = |name: &str| -> Vec<_> {
        let rows = page.lines().map(|line| line.trim_matches('|').split('|').map(str::trim).collect::<Vec<_>>());
        let own = rows.filter(|row| row.len() == 4 && row[0].ends_with('x') && row[1] == name);
        own.map(|row| [mean(row[2]), mean(row[3])]).collect()
    };
    let [both, subdivision, clipping] = ["both", "subdivision only", "clipping only"].map(random);
    assert_eq!([both.len(), subdivision.len(), clipping.len()], [2; 3]);
    for (both, (subdivision, clipping)) in both.iter().zip(subdivision.iter().zip(&clipping)) {
        assert!(both[0] < 1.2 && subdivision[0] > 1.8 && clipping[1] > 2.0 * both[1], "{both:?} {clipping:?}");
    }
}

#[test]
fn a_quick_gallery_shows_every_sampler_with_its_spectrum_and_zone_plate() {
    let page = Page::quick("gallery");
    page.check_pictures(3, 1400);
    let page = page.text;
    for name in ["samplers", "relaxed", "zone-plate"] {
        assert!(page.contains(&format!("](gallery/{name}.png)")), "{name}");
    }
    let rows = |cells: usize| {
        let rows = page.lines().map(|line| line.split('|').map(str::trim).collect::<Vec<_>>());
        let is_row = move |row: &Vec<&str>| row.len() == cells && row[2].contains('±');
        rows.filter(is_row).map(|row| row.iter().map(|cell| cell.to_string()).collect::<Vec<_>>()).collect::<Vec<_>>()
    };
    let (figures, errors) = (rows(11), rows(5));
    let names =
        ["random", "jittered", "Halton", "flat quadtree", "KDRT", "DCR, momentum, Delaunay", "DCR, momentum, nearest"];
    assert_eq!((figures.len(), errors.len()), (9, 9), "{page}");
    assert!(figures.iter().zip(names).all(|(row, name)| row[1] == name), "{figures:?}");
    let number = |row: &[String], cell: usize| mean(&row[cell]);
    // The order in which the samplers have always been ranked: by spacing, and by what they show of the plate.
    for (better, worse) in [(1, 0), (3, 1), (3, 2), (5, 3), (6, 5)] {
        assert!(number(&figures[better], 2) > number(&figures[worse], 2), "{better} {worse}: {figures:?}");
    }
    for (better, worse) in [(1, 0), (2, 0), (3, 1), (3, 2), (5, 3)] {
        assert!(number(&errors[better], 2) < number(&errors[worse], 2), "{better} {worse}: {errors:?}");
    }
    assert!(!page.contains("NaN"));
}

/// What stands for the example program of this name.
const LIGHTS: &str = "#!/bin/sh
echo \"$2 lights, 240 places, 40 sets each, reference of 100000 lights\"
echo 'blue noise: error 0.0512 +- 0.0004'
echo 'random:     error 0.0712 +- 0.0011'
";

#[test]
fn a_quick_page_of_other_figures_has_plausible_ones() {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("knot.obj"), knot_file()).unwrap();
    fs::write(directory.path().join("lights"), LIGHTS).unwrap();
    fs::set_permissions(directory.path().join("lights"), fs::Permissions::from_mode(0o755)).unwrap();
    let page = Page::of(directory, "figures", &["--dragon", "knot.obj", "--lights", "./lights"]);
    page.check_pictures(3, 600);
    assert_eq!(page.check_verdicts(2).unknown, [""; 0]);
    let page = page.text;
    assert!(page.contains(
        "| error of 100 lights: blue noise below random | 0.0512 ± 0.0004 | 40 | 0.0712 ± 0.0011 | 40 | +17.1 |"
    ));
    for figure in ["fig. 4.2)", "fig. 3.18)", "fig. 3.16)", "fig. 4.12)", "fig. 1.14)", "fig. 3.22)"] {
        assert!(page.lines().any(|line| line.starts_with("## ") && line.contains(figure)), "{figure}");
    }
    // Points, sets, hole, peak, height, dip: what is farther apart has the larger hole; random points have none.
    let holes: Vec<_> = rows_with(&page, 6, 1).iter().map(|row| row[2].parse::<f64>().unwrap()).collect();
    assert_eq!(holes.len(), 4, "{page}");
    assert!(holes[0] > 0.5 && holes[1] > 0.7 && holes[2] > holes[1] && holes[3] == 0.0, "{holes:?}");
    // Scene, triangles, samples, times of rays and of the rasteriser, their ratio with its verdict, of too few rounds.
    let engines: Vec<_> = page.lines().filter(|line| line.starts_with("| hall |")).collect();
    assert!(engines.len() == 1 && engines[0].ends_with("), not decided |"), "{engines:?}");
    check_chains(&page);
    // What is beyond, rho, cover, that on the boundary, density, spacing: mirrored points keep the boundary covered.
    let means = |row: &String| -> Vec<f64> {
        row.split(" | ").skip(1).map(|cell| cell.split(' ').next().unwrap().parse().unwrap()).collect()
    };
    let rows: Vec<_> = ["(a)", "(b)"]
        .map(|kind| page.lines().find(|line| line.starts_with(&format!("| {kind}"))).unwrap().to_owned())
        .iter()
        .map(means)
        .collect();
    let [pins, mirrored] = &rows[..] else { panic!("{rows:?}") };
    assert!(pins[1] > mirrored[1] && pins[2] > mirrored[2] && mirrored[0] > pins[0], "{rows:?}");
    assert!(!page.contains("NaN") && page.contains("**The bunny was not given"));
}

/// Checks the table of priorities, samples, checks per candidate, longest chain and relative rate.
fn check_chains(page: &str) {
    let start = page.find("| priorities |").unwrap();
    let rows: Vec<Vec<f64>> = page[start..]
        .lines()
        .skip(2)
        .take_while(|line| line.starts_with('|'))
        .map(|line| line.trim_matches('|').split('|').map(|cell| mean(&cell.replace(',', ""))).collect())
        .collect();
    assert_eq!(rows.iter().map(|row| row[0]).collect::<Vec<_>>(), [1.0, 2.0, 3.0, 4.0, 6.0, 12.0]);
    // One projector at a time needs no chains; with more the checks grow, and a chain ends at the lowest priority.
    assert_eq!(rows[0][2..], [1.0, 1.0, 1.0]);
    assert!(rows.windows(2).all(|pair| pair[0][2] < pair[1][2] && pair[0][3] <= pair[1][3]), "{rows:?}");
    assert!(rows.iter().all(|row| row[3] <= row[0]), "{rows:?}");
    // All at once or one after the other: the same set.
    assert_eq!(rows[0][1], rows[5][1]);
}

#[test]
fn a_page_is_refused_where_it_cannot_be_written() {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("file"), "").unwrap();
    for page in ["kdrt", "psp", "dcr", "classes", "order", "tiling", "figures", "gallery"] {
        let refused = studies(&directory, &[page, "--quick", "--out", "file"]);
        let said = String::from_utf8(refused.stderr).unwrap();
        assert!(refused.status.code() == Some(1) && said.starts_with("error: file"), "{said}");
    }
}
