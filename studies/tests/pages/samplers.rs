//! The gallery, and the page of pixels.

use crate::{Page, mean};

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
