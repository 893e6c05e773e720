//! The promises of "converged" for a set relaxed by momentum on Delaunay neighbours: no two points closer than 0.85 d_max and no
//! circumradius above 0.67 d_max. Many small sets and some larger ones, since it is a promise for any.

use azulejo::dcr::{Neighbourhood, Options, Report, Stopped, relax};
use azulejo::{Boundary, Context};

use crate::common::BOUNDARIES;
use crate::common::relaxed;
use crate::common::sets::{random_points, unit_square};

/// True for a set that is all that is promised: its smallest distance by all pairs and its holes by cutting the domain are what its
/// report says, and if that says that it has converged, they are up to what the last step moves within the bounds.
fn is_as_promised(count: usize, seed: u64, boundary: Boundary) -> (bool, Report) {
    let domain = unit_square(boundary);
    let options = Options::new(domain, Neighbourhood::Delaunay).seed(seed);
    let start = random_points(count, 1000 + seed);
    let (relaxed, report) = relax(&Context::new(1).unwrap(), &options, &start, None).unwrap();
    let said = format!("seed {seed}, {count} points, {boundary:?}: {report:?}");
    assert_eq!(relaxed::fault(&domain, &relaxed, &report), None, "{said}");
    let is_converged = report.stopped == Stopped::Converged;
    assert!(!is_converged || report.rho >= 0.85 - 0.002 && report.relative_covering_radius <= 0.67 + 0.002, "{said}");
    (is_converged, report)
}

/// The number of small sets of some seeds that converge.
fn converged(seeds: std::ops::Range<u64>, boundary: Boundary) -> usize {
    seeds.filter(|&seed| is_as_promised(20 + (seed * 37 % 180) as usize, seed, boundary).0).count()
}

#[test]
fn converged_sets_have_neither_close_points_nor_holes() {
    for (boundary, least) in BOUNDARIES.into_iter().zip([80, 15]) {
        let count = converged(0..100, boundary);
        assert!(count >= least, "{count} of 100 converge");
    }
}

#[test]
fn larger_sets_that_converge_have_neither() {
    for boundary in BOUNDARIES {
        for (seed, count) in [(0, 500), (1, 1000), (2, 2000), (3, 4000)] {
            let (is_converged, report) = is_as_promised(count, seed, boundary);
            // With a boundary some are still moving a little after all steps.
            assert!(is_converged || boundary == Boundary::Bounded && report.rho >= 0.85, "{count}: {report:?}");
        }
    }
}

/// Ten thousand sets: takes minutes.
#[test]
#[ignore = "takes minutes: scripts/test.sh --long"]
fn ten_thousand_converged_sets_have_neither_close_points_nor_holes() {
    let count = converged(100..10_100, Boundary::Periodic);
    assert!(count >= 8_500, "{count} of 10000 converge");
}
