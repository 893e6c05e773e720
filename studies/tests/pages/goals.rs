//! The page of goals.

use std::fs;

use crate::{Page, knot_file, rows_with};

#[test]
fn a_quick_page_of_goals_says_what_follows_from_its_figures() {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("knot.obj"), knot_file()).unwrap();
    let page = Page::of(directory, "goals", &["--dragon", "knot.obj"]).text;
    assert!(page.contains("**The bunny was not given") && !page.contains("The dragon was not given"), "{page}");
    assert!(!page.contains("NaN") && !page.contains("inf"), "{page}");
    // Figure, result, range, goal, verdict.
    let rows = page.lines().map(|line| line.trim_matches('|').split('|').map(str::trim).collect::<Vec<_>>());
    let rows: Vec<_> =
        rows.filter(|row| row.len() == 5 && (row[4].contains("met") || row[4] == "not decided")).collect();
    let number = |text: &str| text.split(' ').next().unwrap().parse::<f64>().unwrap();
    for row in &rows {
        let (measured, goal) = (row[1], row[3]);
        let (is_most, bound) = match goal.strip_prefix("at most ") {
            Some(most) => (true, most),
            None => (false, goal.strip_prefix("at least ").unwrap_or_else(|| panic!("{row:?}"))),
        };
        let [value, bound, low, high] =
            [number(measured), number(bound), number(row[2]), number(row[2].split(" to ").nth(1).unwrap())];
        // Two rounds decide nothing.
        let is_met = if is_most { value <= bound } else { value >= bound };
        assert!(row[4] == "not decided" || (row[4] == "met") == is_met, "{row:?}");
        assert!(low <= high && measured.split(' ').nth(1) == goal.split(' ').nth(3), "{row:?}");
    }
    let parts = ["The plane", "Maximal sets on meshes", "Files of meshes", "Relaxation on meshes"];
    let others = ["Relaxation from any start", "Given samples and exact numbers", "Clouds", "Goals on other pages"];
    assert!(parts.iter().chain(&others).all(|part| page.contains(&format!("\n## {part}\n"))), "{page}");
    assert_eq!(rows.len(), 56);
    assert!(rows.iter().any(|row| row[4] == "met") && rows.iter().any(|row| row[4] == "not decided"));
    // Starts are as good as a uniform one.
    let starts = rows_with(&page, 7, 4);
    assert_eq!(starts.len(), 2 * 8);
    assert!(starts.iter().all(|row| row[4].parse::<f64>().unwrap() > 0.8), "{starts:?}");
}
