//! The page of volumes.

use std::fs;
use std::os::unix::fs::PermissionsExt;

use crate::{Page, rows_with};

/// A replacement for the program that runs crates: three samples, two of which conflict at the radius of the tasks.
const PEERS: &str = "#!/bin/sh
printf '\\0\\0\\0\\0\\0\\0\\340\\077\\0\\0\\0\\0\\0\\0\\340\\077\\0\\0\\0\\0\\0\\0\\340\\077' >\"$5\"
printf '\\0\\0\\0\\0\\0\\0\\340\\077\\0\\0\\0\\0\\0\\0\\340\\077\\0\\0\\0\\0\\0\\0\\340\\077' >>\"$5\"
printf '\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0' >>\"$5\"
echo 0.5 0.25 1
";

#[test]
fn a_quick_page_of_volumes_judges_sets_and_those_of_others() {
    let directory = tempfile::tempdir().unwrap();
    let program = directory.path().join("peers");
    fs::write(&program, PEERS).unwrap();
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
    let page = Page::of(directory, "volume", &["--peers", "./peers"]);
    page.check_pictures(1, 600);
    let page = page.text;
    assert!(!page.contains("NaN") && !page.contains("inf |"), "{page}");
    // Two rounds decide nothing about times; of densities and distances the worst decides.
    let verdicts = page.lines().filter(|line| line.ends_with("met |") || line.ends_with("met** |"));
    assert_eq!(verdicts.count(), 4, "{page}");
    // Name, time, spread, samples, density, conflicts, uncovered, farthest, distances.
    let rows = rows_with(&page, 10, 1);
    let own: Vec<_> = rows.iter().filter(|row| row[0].contains("azulejo") && row[4] != "-").collect();
    assert_eq!(own.len(), 2 + 2 * 2, "{rows:?}");
    for row in own {
        let [density, farthest] = [4, 7].map(|cell| row[cell].parse::<f64>().unwrap());
        assert!(density > 0.73 && row[5] == "0" && row[6] == "0 %" && farthest < 1.0001, "{row:?}");
    }
    let others: Vec<_> = rows.iter().filter(|row| row[0] == "fast_poisson").collect();
    assert_eq!(others.len(), 2, "{rows:?}");
    for row in others {
        let [time, farthest] = [1, 7].map(|cell| row[cell].parse::<f64>().unwrap());
        assert!((time - 83_333.0).abs() < 1000.0 && row[3] == "3" && row[5] == "1" && farthest > 1.0, "{row:?}");
    }
    for left_out in ["scipy PoissonDisk", "tph_poisson, 30 attempts", "`--python` was not given"] {
        assert!(page.contains(left_out), "{left_out}: {page}");
    }
}
