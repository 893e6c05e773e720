//! The gallery, and the page of other figures.

use std::fs;
use std::os::unix::fs::PermissionsExt;

use crate::{Page, knot_file, mean, rows_with};

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

/// A replacement for the example program of this name.
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
    // Pins beyond the domain, rho, cover, that on the boundary, density, spacing: mirrored points keep the boundary
    // covered.
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
fn a_quick_page_of_pixels_has_every_sampler_and_claims_that_follow() {
    let page = Page::quick("pixels");
    assert_eq!(page.check_verdicts(8).unknown, [""; 0]);
    let rows = page.text.lines().filter(|line| line.starts_with("| ") && line.matches('±').count() == 2);
    let names: Vec<_> = rows.filter_map(|row| row.split(" | ").next()?.strip_prefix("| ")).collect();
    let samplers =
        ["random", "stratified", "Sobol, Owen-scrambled", "KDRT tile", "DCR tile", "KDRT image", "DCR image"];
    assert!(samplers.iter().all(|name| names.iter().filter(|row| row == &name).count() == 4), "{names:?}");
}
