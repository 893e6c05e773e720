//! Iterations of local projectors, by the definitions.

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::error::Error;
use crate::given::Given;
use crate::job::Context;
use crate::math::distance_squared;
use crate::mesh::Mesh;
use crate::points::Points;
use crate::psp::project::tests::meshes;
use crate::psp::{self, Engine, Options, Priority, ProjectionOptions, Psp, Report};

pub fn mesh((positions, triangles): meshes::Soup) -> Arc<Mesh> {
    Arc::new(Mesh::new(positions, triangles).unwrap())
}

/// Meshes with radii at which they have some thousands of samples.
pub fn cases() -> Vec<(&'static str, Arc<Mesh>, f64)> {
    vec![
        ("torus", mesh(meshes::torus()), 0.03),
        ("fine torus", mesh(meshes::fine_torus(300, 100)), 0.04),
        ("sphere", mesh(meshes::sphere()), 0.04),
        ("coarse plane", mesh(meshes::plane()), 0.005),
        ("hall", mesh(meshes::hall(6)), 0.25),
        ("soup", mesh(meshes::random_soup(3, 40)), 0.03),
        ("sheets closer than the radius", mesh(meshes::sheets(0.01)), 0.03),
        ("sheets farther apart", mesh(meshes::sheets(0.031)), 0.03),
        ("book", mesh(meshes::book(20)), 0.04),
        ("needles", mesh(meshes::needles(1e-2)), 0.002),
        ("slivers", mesh(meshes::slivers()), 0.02),
        ("duplicates", mesh(meshes::duplicated(meshes::sphere())), 0.05),
        ("far from the origin", mesh(meshes::placed(meshes::torus(), 1e-3, 0.05)), 4e-5),
        ("huge", mesh(meshes::placed(meshes::sphere(), 1e30, 3e30)), 5e28),
        ("large radius", mesh(meshes::torus()), 10.0),
    ]
}

fn project(mesh: &Arc<Mesh>, options: &ProjectionOptions, iterations: u32, threads: usize) -> (Points<3>, Report) {
    psp::project(&Context::new(threads).unwrap(), mesh, options, iterations, false, None).unwrap()
}

/// Compares all pairs.
fn assert_apart(name: &str, positions: &[[f32; 3]], radius: f64) {
    for (i, &a) in positions.iter().enumerate() {
        let nearest = positions[..i].iter().map(|&b| distance_squared(a, b)).fold(f64::INFINITY, f64::min);
        assert!(nearest >= radius * radius, "{name}: {} < {radius}", nearest.sqrt());
    }
}

#[test]
fn no_pair_is_closer_than_the_radius_and_threads_change_nothing() {
    let mut found = 0;
    for (name, mesh, radius) in cases() {
        for (seed, iterations) in [(1, 1), (2, 1), (3, 3)] {
            let options = ProjectionOptions::new(radius).seed(seed);
            let (samples, report) = project(&mesh, &options, iterations, 1);
            assert_apart(name, &samples.positions, radius);
            assert_eq!(project(&mesh, &options, iterations, 3).0, samples, "{name}");
            assert_eq!(report.samples, samples.len() as u64);
            assert_eq!(report.hits, report.accepted + report.conflicts + report.restart_conflicts);
            found += samples.len();
        }
    }
    assert!(found > 50_000, "{found}");
}

#[test]
#[cfg_attr(not(feature = "embree"), ignore = "one of them is Embree")]
fn both_engines_give_the_same_bits() {
    let mut hits = 0;
    for (name, mesh, radius) in cases() {
        for seed in 0..3 {
            let made = |engine| project(&mesh, &ProjectionOptions::new(radius).seed(seed).engine(engine), 2, 2);
            let ((drawn, report), (traced, other)) = (made(Engine::Rasteriser), made(Engine::Embree));
            assert_eq!(drawn, traced, "{name}, seed {seed}");
            let counts = |report: Report| [report.hits, report.accepted, report.conflicts, report.restart_conflicts];
            assert_eq!(counts(report), counts(other), "{name}, seed {seed}");
            assert_eq!(made(Engine::Auto).0, drawn);
            hits += report.hits;
        }
    }
    assert!(hits > 200_000, "{hits}");
}

#[test]
fn one_iteration_finds_most_of_a_maximal_set_and_further_ones_add_to_it() {
    for (name, mesh, radius, share) in [
        ("sphere", mesh(meshes::placed(meshes::fine_torus(600, 300), 1.0, 0.0)), 0.02, 0.9),
        ("coarse torus", mesh(meshes::torus()), 0.015, 0.85),
        ("coarse plane", mesh(meshes::plane()), 0.005, 0.91),
    ] {
        let context = Context::new(2).unwrap();
        let maximal = psp::sample(&context, &mesh, &Options::new(radius), None).unwrap().0.len() as f64;
        let mut psp = Psp::new(&mesh, &ProjectionOptions::new(radius)).unwrap();
        let mut before = psp.samples();
        for iteration in 0..6 {
            let report = psp.advance(&context, 1, None).unwrap();
            let after = psp.samples();
            assert_eq!(after.positions[..before.len()], before.positions);
            assert!(report.accepted > 0 && iteration == 0 || report.accepted < before.len() as u64 / 5, "{report:?}");
            before = after;
            if iteration == 0 {
                assert!(before.len() as f64 > share * maximal, "{name}: {} of {maximal}", before.len());
            }
        }
        assert!(before.len() as f64 > (share + 0.02) * maximal, "{name}: {} of {maximal}", before.len());
        assert_eq!(project(&mesh, &ProjectionOptions::new(radius), 6, 1).0, before);
    }
}

#[test]
fn samples_keep_clear_of_given_ones_and_off_masked_triangles() {
    let all = mesh(meshes::fine_torus(200, 80));
    let mask: Vec<bool> = (0..all.triangles().len()).map(|i| i % 3 != 0).collect();
    let masked = Arc::new(Mesh::clone(&all).with_mask(mask.clone()).unwrap());
    let radius = 0.05;
    let (set, _) = project(&all, &ProjectionOptions::new(0.2).seed(9), 1, 1);
    let clearances: Vec<f64> = (0..set.len()).map(|i| [radius, 0.02, 0.13][i % 3]).collect();
    let given = Given::with_clearances(&set.positions, &clearances);
    for given in [given, Given::at(&set.positions)] {
        let options = ProjectionOptions::new(radius).given(given);
        let (samples, _) = project(&masked, &options, 2, 2);
        assert!(samples.len() > 2000, "{}", samples.len());
        assert!(samples.triangles.iter().all(|&triangle| mask[triangle as usize]));
        for &sample in &samples.positions {
            for (index, &position) in set.positions.iter().enumerate() {
                let clearance = given.clearance(index, radius);
                assert!(distance_squared(sample, position) >= clearance * clearance);
            }
        }
        assert_apart("masked", &samples.positions, radius);
    }
}

#[test]
fn both_priorities_are_orders_of_the_same_hits() {
    let mesh = mesh(meshes::random_soup(5, 60));
    let [squareness, projector] = [Priority::Squareness, Priority::Projector].map(|priority| {
        let (samples, report) = project(&mesh, &ProjectionOptions::new(0.03).priority(priority), 1, 1);
        assert_apart("soup", &samples.positions, 0.03);
        (samples, report.hits)
    });
    assert_eq!(squareness.1, projector.1);
    assert_ne!(squareness.0, projector.0);
}

#[test]
fn a_cancelled_iteration_adds_nothing_and_can_be_repeated() {
    let (mesh, options, context) = (mesh(meshes::torus()), ProjectionOptions::new(0.02), Context::new(1).unwrap());
    let expected = project(&mesh, &options, 1, 1).0;
    for limit in [0.0, 0.35, 0.7, 0.95] {
        let mut psp = Psp::new(&mesh, &options).unwrap();
        let stop = |share: f64| if share > limit { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        assert!(matches!(psp.advance(&context, 1, Some(&stop)), Err(Error::Cancelled)), "{limit}");
        assert!(psp.is_empty());
        psp.advance(&context, 1, None).unwrap();
        assert_eq!(psp.samples(), expected);
    }
}
