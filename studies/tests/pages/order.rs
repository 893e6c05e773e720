//! The pages of progressive order and of classes.

use std::fs;

use crate::{Page, knot_file, rows_with};

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
    assert!(ratios.clone().count() == 2 * 3 && ratios.clone().all(|line| line.ends_with("| met |")), "{page}");
    // Quotient, N·r², two ratios and two ρ: prefixes are worse the larger the quotient is, and none is as good as a set.
    let distances = rows_with(&page, 6, 2);
    let distances: Vec<_> = distances.iter().filter(|row| row[5].starts_with("0.")).collect();
    let names = ["2^(1/8)", "2^(1/4)", "√2", "direct", "2^(1/8)", "2^(1/4)", "√2"];
    assert_eq!(distances.iter().map(|row| row[0].as_str()).collect::<Vec<_>>(), names);
    let on_mesh: Vec<f64> = distances[4..].iter().map(|row| row[2].parse().unwrap()).collect();
    assert!(on_mesh.is_sorted() && on_mesh[0] > 1.0, "{on_mesh:?}");
    // N, sets with N, ratio and bound, largest and mean, and two ρ: what is lost of maximality is within the bound.
    let exact = rows_with(&page, 8, 2);
    assert_eq!(exact.iter().map(|row| [&*row[0], &*row[1]]).collect::<Vec<_>>(), [["100", "2"], ["500", "2"]]);
    for row in &exact {
        let [ratio, mean, bound] = [2, 3, 4].map(|cell| row[cell].parse::<f64>().unwrap());
        assert!(1.0 <= mean && mean <= ratio && ratio <= bound + 1e-3 && bound < 1.3, "{row:?}");
    }
    assert!(
        page.contains("sets of exactly N samples have N | 4 of 4 | met |")
            && page.contains("## The quotient of windows")
    );
    let largest: Vec<f64> = distances.iter().map(|row| row[2].parse().unwrap()).collect();
    assert!(largest[..3].is_sorted() && largest[3] < largest[0], "{largest:?}");
    // Samples, quotient, ρ, P, ν, anisotropy, from direct.
    let spectra = rows_with(&page, 7, 2);
    assert_eq!(spectra.len(), 5 * 4);
    assert!(spectra.iter().all(|row| (0.6..0.9).contains(&row[2].parse::<f64>().unwrap())), "{spectra:?}");
}
