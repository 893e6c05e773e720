//! The page of relaxation.

use crate::{Page, check_verdict, mean, rows_with};

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
    // Mesh, samples, least and mean ρ, sets below, and the verdicts.
    let spacing: Vec<_> =
        rows_with(page, 7, 4).into_iter().filter(|row| row[0] == "sphere" && row[3].contains('±')).collect();
    assert_eq!(spacing.len(), 1, "{spacing:?}");
    for row in &spacing {
        let [least, mean] = [&row[2], &row[3]].map(|cell| number(cell.split(' ').next().unwrap()));
        assert!(0.8 < least && least <= mean, "{row:?}");
        assert_eq!([row[4] == "0", mean >= 0.845], [&row[5], &row[6]].map(|told| told == "met"), "{row:?}");
        assert_eq!(row[4] == "0", least >= 0.845, "{row:?}");
    }
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
