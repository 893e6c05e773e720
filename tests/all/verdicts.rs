//! The pages of `docs/` as they are committed: whether their verdicts and sentences follow from their tables, and whether
//! pages agree.

#[path = "../../studies/tests/recomputed/mod.rs"]
mod recomputed;

use std::fs;
use std::path::Path;

use recomputed::{Recomputed, Table, numbers, tables};

fn page(name: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs").join(name)).unwrap()
}

/// The names of the pages that studies wrote, with those of the archive.
fn pages() -> Vec<String> {
    let names = ["", "archive/"].map(|folder| {
        let files = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs").join(folder)).unwrap();
        files.map(move |file| format!("{folder}{}", file.unwrap().file_name().into_string().unwrap()))
    });
    let is_written = |name: &String| name.ends_with(".md") && page(name).contains("\nWritten by `");
    names.into_iter().flatten().filter(is_written).collect()
}

#[test]
fn verdicts_follow_from_the_tables() {
    let pages = pages();
    let mut right = 0;
    for name in &pages {
        let all = Recomputed::of(&page(name));
        assert!(all.wrong.is_empty(), "{name}: {:#?}", all.wrong);
        // On these pages all are in a form that is known.
        if ["kdrt.md", "archive/tiling.md"].contains(&&**name) {
            assert!(all.unknown.is_empty(), "{name}: {:#?}", all.unknown);
        }
        right += all.right;
    }
    assert!(pages.len() >= 9 && right > 120, "{right} of {pages:?}");
}

#[test]
fn a_goal_that_nothing_decides_is_not_called_met() {
    let text = page("kdrt.md");
    let sentences: Vec<_> = text.lines().filter(|line| line.starts_with("Density of leaves of ")).collect();
    assert!(!sentences.is_empty());
    for sentence in sentences {
        let all: Vec<_> = numbers(sentence).iter().map(|number| number.value).collect();
        // Leaves, the goal, the density of unbiased sets; the excess, its error, n, t.
        let [goal, excess, error, t] = [all[1], all[3], all[4], all[6]];
        let distance = (excess.abs() - goal) / error;
        assert!((distance - t).abs() < 0.1 + 0.1 * distance.abs(), "{sentence}");
        // Of a hundred sets a t of 2.4 has a chance of a hundredth.
        let expected: &[_] = match distance {
            ..-2.6 => &["met"],
            2.6.. => &["**not met**"],
            -2.1..2.1 => &["not decided", "**not decided**"],
            _ => &["met", "**not met**", "not decided", "**not decided**"],
        };
        let is_said = |verdict: &&str| sentence.contains(&format!("from the limit, {verdict}"));
        assert!(expected.iter().any(is_said), "{sentence}");
    }
}

/// The median of a cell with its range: "0.748 (0.74 to 0.76)".
fn range(cell: &str) -> Option<[f64; 2]> {
    let (_, range) = cell.split_once('(')?;
    let (range, _) = range.split_once(')')?;
    let (low, high) = range.split_once(" to ")?;
    Some([low, high].map(|bound| numbers(bound)[0].value))
}

/// The row of a column that is below all others, by ranges.
fn lowest(table: &Table, column: usize) -> Option<Option<usize>> {
    let ranges = table.rows.iter().map(|row| match &*row[column] {
        "1" => Some([1.0; 2]),
        cell => range(cell),
    });
    let ranges = ranges.collect::<Option<Vec<_>>>()?;
    let is_lowest = |&i: &usize| (0..ranges.len()).all(|k| k == i || ranges[i][1] < ranges[k][0]);
    Some((0..ranges.len()).find(is_lowest))
}

#[test]
fn sentences_name_the_fastest_where_ranges_do() {
    let text = page("psp.md");
    for table in tables(&text).iter().filter(|table| table.head[0] == "directions") {
        for (column, scene) in table.head.iter().enumerate().skip(1) {
            // Pages without ranges state nothing that could be checked.
            let Some(lowest) = lowest(table, column) else { continue };
            let sentence = match lowest {
                Some(row) => format!("The {scene} took the least time with {} directions.", table.rows[row][0]),
                None => format!("With how many the {scene} took the least time is not decided."),
            };
            assert!(text.contains(&sentence), "{sentence}");
        }
    }
    let text = page("archive/figures.md");
    for table in tables(&text).iter().filter(|table| table.head[0] == "priorities") {
        let Some(lowest) = lowest(table, table.head.len() - 1) else { continue };
        let sentence = match lowest {
            Some(row) => format!("here {} is the fastest.", table.rows[row][0]),
            None => "which is the fastest is not decided here.".to_owned(),
        };
        assert!(text.contains(&sentence), "{sentence}");
    }
}

/// The cell of the row whose first cells are these, in the column of this head.
fn cell(page: &str, first: &[&str], head: &str) -> String {
    let table = tables(page);
    let found = table.iter().find_map(|table| {
        let column = table.head.iter().position(|name| name == head)?;
        let row = table.rows.iter().find(|row| row.iter().zip(first).all(|(cell, name)| cell == name))?;
        Some(row[column].clone())
    });
    found.unwrap_or_else(|| panic!("no {head} of {first:?}"))
}

#[test]
fn one_quantity_is_one_figure_on_the_page_of_surfaces() {
    let text = page("psp.md");
    let Some(goals) =
        tables(&text).into_iter().find(|table| table.rows.iter().any(|row| row[0].contains("goal: at least 5")))
    else {
        // Written before rounds were.
        return;
    };
    for (column, scene) in goals.head.iter().enumerate().skip(1) {
        let of = |start: &str| goals.rows.iter().find(|row| row[0].starts_with(start)).unwrap()[column].clone();
        let rate = of("maximal, M samples/s");
        let rate = rate.split(", ").next().unwrap();
        let rates =
            tables(&text).into_iter().find(|table| table.head.first().is_some_and(|head| head == "scene")).unwrap();
        assert!(rates.rows.iter().any(|row| &row[0] == scene && row[4] == rate), "{scene}: {rate}");
        let seconds = of("2 threads, seconds");
        let by_priority = cell(&text, &[&format!("{scene}, squareness")], "seconds");
        assert_eq!(by_priority, seconds, "{scene}");
        assert!(cell(&text, &["3"], scene).starts_with(&seconds), "{scene}");
    }
}

/// A mean and its standard error: "0.862 ± 4e-5".
fn mean(cell: &str) -> Option<[f64; 2]> {
    let (mean, error) = cell.split_once('±')?;
    Some([numbers(mean).first()?.value, numbers(error).first()?.value])
}

#[test]
fn relaxed_sets_are_the_same_on_two_pages() {
    let (dcr, gallery) = (page("dcr.md"), page("gallery.md"));
    let mut compared = 0;
    for head in ["ρ", "nearest", "cover", "ψ6"] {
        let mut own = Vec::new();
        for table in tables(&dcr).into_iter().filter(|table| table.text.starts_with("## Momentum, Delaunay")) {
            let column = table.head.iter().position(|name| name == head).unwrap();
            let rows = table.rows.iter().filter(|row| row[0] == "65,536" && row[2] == "random");
            own.extend(rows.map(|row| row[column].clone()));
        }
        let other = cell(&gallery, &["DCR, momentum, Delaunay"], head);
        for (own, other) in own.iter().filter_map(|own| Some((mean(own)?, mean(&other)?))) {
            // Errors of two sets are not well known.
            let error = own[1].hypot(other[1]);
            assert!((own[0] - other[0]).abs() <= 10.0 * error + 1e-3, "{head}: {own:?} {other:?}");
            compared += 1;
        }
    }
    // Pages without errors cannot be compared.
    assert!(compared == 4 || mean(&cell(&gallery, &["DCR, momentum, Delaunay"], "ρ")).is_none(), "{compared}");
}
