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
        assert!(picture.width() >= 900 && picture.pixels().any(|pixel| pixel[2] > pixel[0].saturating_add(25)));
        count += 1;
    }
    assert_eq!(count, 7);
}

#[test]
fn a_quick_report_on_adaptive_sampling_has_its_pictures_and_every_band() {
    let workshop = Workshop::new();
    let said = workshop.succeed(&["report", "adaptive", "--quick", "--out", "docs", "--threads", "2"]);
    assert!(said.is_empty(), "{said}");
    let page = std::fs::read_to_string(workshop.path("docs/adaptive.md")).unwrap();
    for figure in ["fig. 3.19", "fig. 3.20", "fig. 3.21"] {
        assert!(page.contains(figure), "{figure}");
    }
    let pictures = page.split("](").skip(1).map(|rest| rest.split(')').next().unwrap());
    let pictures: Vec<_> = pictures.map(|path| image::open(workshop.path("docs").join(path)).unwrap()).collect();
    assert_eq!(pictures.len(), 3);
    assert!(pictures.iter().all(|picture| picture.width() >= 900));
    let errors = page.lines().filter_map(|line| line.strip_suffix(" % |")?.rsplit("| ").next()?.parse::<f64>().ok());
    let errors: Vec<_> = errors.collect();
    assert_eq!(errors.len(), 16);
    assert!(errors.iter().all(|error| error.abs() < 20.0), "{errors:?}");
}

#[test]
fn a_report_is_refused_where_it_cannot_be_written() {
    let workshop = Workshop::new();
    workshop.write("file", "");
    let said = workshop.refuse(&["report", "kdrt", "--quick", "--out", "file"], 1);
    assert!(said.starts_with("error: file"), "{said}");
}
