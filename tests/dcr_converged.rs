//! What "converged" promises of a set relaxed by momentum on Delaunay neighbours: no two points closer than 0.85 d_max and no
//! circumradius above 0.67 d_max. Many small sets, since it is a promise for any.

#[path = "common/sets.rs"]
#[allow(dead_code)]
mod sets;

use azulejo::dcr::{Neighbourhood, Options, Stopped, relax};
use azulejo::{Boundary, Context};
use sets::{nearest_distances, random_points, unit_square};

/// How many of the sets of some seeds converge. Distances are compared over all pairs.
fn converged(seeds: std::ops::Range<u64>) -> usize {
    let (context, domain) = (Context::new(1).unwrap(), unit_square(Boundary::Periodic));
    let options = Options::new(domain, Neighbourhood::Delaunay);
    let is_converged = |seed: &u64| {
        let points = random_points(20 + (seed * 37 % 180) as usize, 1000 + seed);
        let (relaxed, report) = relax(&context, &options.seed(*seed), &points, None).unwrap();
        let d_max = (2.0 / (3f64.sqrt() * points.len() as f64)).sqrt();
        let smallest = nearest_distances(&domain, &relaxed).into_iter().fold(f64::INFINITY, f64::min);
        assert!((report.rho - smallest / d_max).abs() < 1e-9, "{report:?}");
        let is_converged = report.stopped == Stopped::Converged;
        let said = format!("seed {seed}, {} points: {report:?}", points.len());
        // Up to what the last step moves.
        assert!(!is_converged || report.rho >= 0.85 - 0.002 && report.coverage <= 0.67 + 0.002, "{said}");
        is_converged
    };
    seeds.filter(is_converged).count()
}

#[test]
fn converged_sets_have_neither_close_points_nor_holes() {
    let count = converged(0..100);
    assert!(count >= 80, "{count} of 100 converge");
}

/// Ten thousand sets: takes minutes.
#[test]
#[ignore = "takes minutes: scripts/test.sh --long"]
fn ten_thousand_converged_sets_have_neither_close_points_nor_holes() {
    let count = converged(100..10_100);
    assert!(count >= 8_500, "{count} of 10000 converge");
}
