//! The pages of the plane: KDRT, and the thesis's further claims about tiling.

use crate::{Page, check_verdict, mean, rows_with};

const VERDICTS: [&str; 3] = ["met", "**not met**", "not decided"];

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
    // The facts that must hold exactly.
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
