//! The page of surfaces.

use std::fs;

use crate::{Page, knot_file, rows_with, studies};

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
    check_densities(&page.text);
    let errors =
        page.text.lines().filter_map(|line| line.strip_suffix(" % |")?.rsplit("| ").next()?.parse::<f64>().ok());
    let errors: Vec<_> = errors.collect();
    assert!(errors.len() >= 16 && errors.iter().all(|error| error.abs() < 20.0), "{errors:?}");
    let refused = studies(&page.directory, &["psp", "--quick", "--dragon", "missing.ply", "--out", "pages/docs"]);
    assert_eq!(refused.status.code(), Some(1));
}

/// Of the page of surfaces: the density of each way to a maximal set, and what is said of it.
fn check_densities(page: &str) {
    // Surface, way, samples, n, density, over the limit, over one piece, t, p, verdict.
    let rows: Vec<_> =
        rows_with(page, 10, 3).into_iter().filter(|row| row[4].contains("0.6") || row[4].contains("0.7")).collect();
    let surfaces: Vec<_> = rows.iter().map(|row| row[0].as_str()).collect();
    assert_eq!(surfaces, ["sphere"; 4].into_iter().chain(["torus"; 4]).chain(["bunny"; 4]).collect::<Vec<_>>());
    let number = |text: &str| text.split(' ').next().unwrap().parse::<f64>().unwrap();
    let limit = 0.69656;
    for row in &rows {
        let density = number(&row[4]);
        assert!((100.0 * (density / limit - 1.0) - number(&row[5])).abs() < 0.01, "{row:?}");
        match row[9].as_str() {
            "–" => assert!(row[0] == "bunny" && row[1].contains("one piece"), "{row:?}"),
            _ if row[0] == "bunny" => {
                assert_eq!(row[9] == "no difference shown", number(&row[8].replace("< ", "")) > 0.01, "{row:?}")
            }
            verdict => {
                let error = number(row[4].split(" ± ").nth(1).unwrap());
                let (t, p) = ((density - limit) / error, number(&row[8].replace("< ", "")));
                assert!((t - number(&row[7])).abs() <= 0.1 + 0.1 * t.abs(), "{row:?}: {t}");
                assert_eq!(verdict == "no difference shown", p > 0.01, "{row:?}");
            }
        }
    }
    // Whose every row beside its own was 1 without an error.
    let reference: Vec<_> =
        page.lines().filter(|line| line.starts_with("| filled in one piece (reference) |")).collect();
    assert!(reference.len() == 2 && reference.iter().all(|line| !line.contains("± 0.0000")), "{reference:?}");
}
