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
fn a_report_is_refused_where_it_cannot_be_written() {
    let workshop = Workshop::new();
    workshop.write("file", "");
    for page in ["kdrt", "psp"] {
        let said = workshop.refuse(&["report", page, "--quick", "--out", "file"], 1);
        assert!(said.starts_with("error: file"), "{said}");
    }
}
