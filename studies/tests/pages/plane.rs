//! The page of the plane.

use crate::{Page, check_verdict, rows_with};

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
