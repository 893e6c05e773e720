//! `azulejo report`, from outside.

mod common;

use common::Workshop;

#[test]
fn a_quick_report_has_every_table_and_picture_that_it_shows() {
    let workshop = Workshop::new();
    let said = workshop.succeed(&["report", "kdrt", "--quick", "--out", "pages/docs", "--threads", "2"]);
    assert!(said.is_empty(), "{said}");
    let page = std::fs::read_to_string(workshop.path("pages/docs/kdrt.md")).unwrap();
    for figure in ["table 2.2", "fig. 2.11", "fig. 2.13", "fig. 2.15 to 2.19"] {
        assert!(page.contains(figure), "{figure}");
    }
    for name in ["reference", "6r", "20r", "40r", "80r"] {
        assert!(page.contains(&format!("\n| {name} ")), "{name}");
    }
    let pictures = page.split("](").skip(1).map(|rest| rest.split(')').next().unwrap());
    let mut count = 0;
    for picture in pictures {
        let picture = image::open(workshop.path("pages/docs").join(picture)).unwrap().to_rgb8();
        assert!(picture.width() >= 900 && picture.pixels().any(|pixel| pixel[0] < 128));
        count += 1;
    }
    assert_eq!(count, 7);
}

#[test]
fn a_quick_report_of_surfaces_says_what_is_left_out_and_shows_the_rest() {
    let workshop = Workshop::new();
    workshop.succeed(&["mesh", "knot", "--detail", "64", "-o", "knot.ply"]);
    let arguments = ["report", "psp", "--quick", "--bunny", "knot.ply", "--out", "pages/docs", "--threads", "2"];
    let said = workshop.succeed(&arguments);
    assert!(said.is_empty(), "{said}");
    let page = std::fs::read_to_string(workshop.path("pages/docs/psp.md")).unwrap();
    for figure in [
        "fig. 3.8 and 3.9",
        "fig. 3.10 and 3.11",
        "fig. 3.8, 3.12, 3.13 and 3.15",
        "fig. 3.14",
        "table 3.1",
        "fig. 3.19",
        "fig. 3.20",
        "fig. 3.21",
    ] {
        assert!(page.contains(figure), "{figure}");
    }
    assert!(page.contains("**The dragon was not given") && !page.contains("The bunny was not given"));
    assert!(page.contains("\n| samples that a second fill adds | 0, met | 0, met |"));
    assert!(page.contains("\n| bunny | ") && page.contains("\n| hall | ") && !page.contains("NaN"));
    let pictures = page.split("](").skip(1).map(|rest| rest.split(')').next().unwrap());
    let mut count = 0;
    for picture in pictures {
        let picture = image::open(workshop.path("pages/docs").join(picture)).unwrap().to_rgb8();
        assert!(picture.width() >= 400 && picture.pixels().any(|pixel| pixel[0] < 128));
        count += 1;
    }
    assert_eq!(count, 10);
    let errors = page.lines().filter_map(|line| line.strip_suffix(" % |")?.rsplit("| ").next()?.parse::<f64>().ok());
    let errors: Vec<_> = errors.collect();
    assert!(errors.len() >= 16 && errors.iter().all(|error| error.abs() < 20.0), "{errors:?}");
    workshop.refuse(&["report", "psp", "--quick", "--dragon", "missing.ply", "--out", "pages/docs"], 1);
}

#[test]
fn a_quick_report_of_relaxation_has_every_method_and_plausible_figures() {
    let workshop = Workshop::new();
    let said = workshop.succeed(&["report", "dcr", "--quick", "--out", "pages/docs", "--threads", "2"]);
    assert!(said.is_empty(), "{said}");
    let page = std::fs::read_to_string(workshop.path("pages/docs/dcr.md")).unwrap();
    let pictures = ["best-delaunay", "best-nearest", "thesis-delaunay", "thesis-nearest", "corners"];
    assert_eq!(page.matches("](").count(), pictures.len());
    for name in pictures {
        assert!(page.contains(&format!("](dcr/{name}.png)")), "{name}");
        let picture = image::open(workshop.path(&format!("pages/docs/dcr/{name}.png"))).unwrap().to_rgb8();
        assert!(picture.width() >= 900 && picture.pixels().any(|pixel| pixel[0] < 128));
    }
    let rows = page.lines().map(|line| line.split('|').map(str::trim).collect::<Vec<_>>());
    let bounded: Vec<_> = rows.clone().filter(|cells| cells.len() == 16 && cells[2] == "300").collect();
    // Two methods from two starts each, and one start as it is.
    assert_eq!(bounded.len(), 2 * 2 + 1);
    for row in bounded {
        let [rho, least, cover, largest, border] = [5, 6, 7, 8, 9].map(|cell| row[cell].parse::<f64>().unwrap());
        assert!(0.6 < least && least <= rho && rho < 1.0 && 0.577 < cover && cover <= largest && border <= cover);
        assert!((10..15).all(|cell| (0.7..1.5).contains(&row[cell].parse::<f64>().unwrap())), "{row:?}");
    }
    let rows: Vec<_> = rows.filter(|cells| cells.len() == 15 && ["random", "KDRT"].contains(&cells[3])).collect();
    // Two sizes of the best methods, one of the thesis's, from two starts each.
    assert_eq!(rows.len(), 2 * 2 * 2 + 2 * 2);
    for row in rows {
        let number = |cell: usize| row[cell].trim_end_matches(" %").parse::<f64>().unwrap();
        let [rho, least, nearest, cover, order, power, obtuse, edges] = [4, 5, 6, 7, 8, 9, 10, 11].map(number);
        assert!(0.5 < least && least <= rho && rho < nearest && nearest < 1.0, "{row:?}");
        assert!((0.577..1.5).contains(&cover) && (0.4..0.75).contains(&order), "{row:?}");
        assert!(
            0.0 < power && power < 0.1 && (0.5..15.0).contains(&obtuse) && (0.01..0.03).contains(&edges),
            "{row:?}"
        );
    }
    assert!(page.contains("Sets of 1,000 points and more are left out") && !page.contains("NaN"));
}

#[test]
fn a_report_is_refused_where_it_cannot_be_written() {
    let workshop = Workshop::new();
    workshop.write("file", "");
    for page in ["kdrt", "psp", "dcr"] {
        let said = workshop.refuse(&["report", page, "--quick", "--out", "file"], 1);
        assert!(said.starts_with("error: file"), "{said}");
    }
}
