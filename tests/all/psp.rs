//! Samples on meshes, held against the definitions by plain checkers.

use std::cell::Cell;
use std::ops::ControlFlow;
use std::sync::Arc;

use azulejo::analysis::{coverage, spacing};
use azulejo::mesh::Mesh;
use azulejo::psp::{self, Engine, FlatOptions, Options, Priority, ProjectionOptions, Projectors, Psp};
use azulejo::{Context, Error, Given, MAXIMAL_DENSITY, Points};
use proptest::prelude::*;

use crate::common::meshes::{self, Soup};
use crate::common::surface_oracle as oracle;
use crate::common::tolerance::tolerance;

fn mesh((positions, triangles): Soup) -> Arc<Mesh> {
    Arc::new(Mesh::new(positions, triangles).unwrap())
}

/// Everything that a set owes.
fn check(mesh: &Mesh, samples: &Points<3>, radius: f64, maximal: bool) {
    assert!(!maximal || !samples.is_empty());
    assert_eq!(oracle::misplaced(mesh, samples), None);
    assert_eq!(oracle::conflict(samples, radius), None);
    if maximal {
        assert_eq!(oracle::gap(mesh, samples, radius, tolerance(mesh)), None);
    }
}

/// Samples a mesh with and without iterations and filling, on one thread and on four, and checks all sets.
fn check_all(mesh: &Arc<Mesh>, radius: f64) {
    let projected = Engine::AVAILABLE.iter().flat_map(|&engine| [(2, false, engine), (2, true, engine)]);
    for (iterations, maximal, engine) in projected.chain([(0, true, Engine::default())]) {
        let options = ProjectionOptions::new(radius).engine(engine);
        let project =
            |threads| psp::project(&Context::new(threads).unwrap(), mesh, &options, iterations, maximal, None);
        let [(samples, report), (again, _)] = [1, 4].map(|threads| project(threads).unwrap());
        check(mesh, &samples, radius, maximal);
        assert_eq!(samples, again, "depends on the number of threads");
        assert_eq!(report.samples, samples.len() as u64);
        assert_eq!(report.accepted, report.samples);
        assert_eq!(report.iterations, iterations);
        assert_eq!(report.hits + report.darts, report.accepted + report.conflicts + report.restart_conflicts);
    }
}

#[test]
fn closed_surfaces() {
    check_all(&mesh(meshes::sphere()), 0.12);
    check_all(&mesh(meshes::torus()), 0.15);
}

#[test]
fn open_surfaces() {
    check_all(&mesh(meshes::plane()), 0.03);
}

#[test]
fn a_hall_of_many_surfaces_behind_one_another() {
    check_all(&mesh(meshes::hall(6)), 0.12);
}

#[test]
fn vertices_of_no_triangle_do_not_matter() {
    let (mut positions, triangles) = meshes::sphere();
    let expected =
        psp::sample(&Context::new(1).unwrap(), &mesh((positions.clone(), triangles.clone())), &Options::new(0.2), None);
    positions.push([1e30, -1e30, 3e38]);
    let samples = psp::sample(&Context::new(1).unwrap(), &mesh((positions, triangles)), &Options::new(0.2), None);
    assert_eq!(samples.unwrap().0, expected.unwrap().0);
}

#[test]
fn sheets_closer_than_the_radius_share_their_samples() {
    let mesh = mesh(meshes::sheets(0.02));
    check_all(&mesh, 0.05);
}

#[test]
fn crossing_and_duplicated_faces() {
    check_all(&mesh(meshes::random_soup(3, 12)), 0.08);
    check_all(&mesh(meshes::duplicated(meshes::random_soup(4, 3))), 0.08);
}

#[test]
fn needles() {
    for aspect in [1e-2, 1e-6] {
        check_all(&mesh(meshes::needles(aspect)), 0.01);
    }
}

#[test]
fn parts_smaller_than_the_radius_get_a_sample_unless_one_reaches_them() {
    let part = |offset| meshes::placed(meshes::random_soup(8, 1), 0.01, offset);
    let mesh = mesh(meshes::join([part(0.0), part(0.005), part(1.0), part(3.0)]));
    check_all(&mesh, 0.2);
    let (samples, _) = psp::sample(&Context::new(1).unwrap(), &mesh, &Options::new(0.2), None).unwrap();
    assert_eq!(samples.len(), 3);
}

/// After iterations and fill, and after fill alone, on several seeds: the checker subdivides the surface until each part
/// lies in one ball.
#[test]
fn nothing_is_left_uncovered_on_any_kind_of_mesh() {
    let small = |seed, offset| meshes::placed(meshes::random_soup(seed, 2), 0.02, offset);
    let kinds = [
        ("closed", meshes::torus(), 0.15),
        ("open", meshes::plane(), 0.04),
        ("non-manifold", meshes::book(7), 0.09),
        ("self-intersecting", meshes::random_soup(11, 9), 0.1),
        ("slivers", meshes::slivers(), 0.02),
        ("needles", meshes::needles(1e-6), 0.004),
        ("duplicated faces", meshes::duplicated(meshes::book(3)), 0.09),
        ("parts smaller than the radius", meshes::join((0..40).map(|i| small(i, 0.013 * i as f64))), 0.06),
    ];
    let context = Context::new(2).unwrap();
    for (kind, soup, radius) in kinds {
        let mesh = mesh(soup);
        for (seed, iterations) in (0..6).flat_map(|seed| [(seed, 0), (seed, 1), (seed, 3)]) {
            println!("{kind}, seed {seed}, {iterations} iterations");
            let options = ProjectionOptions::new(radius).seed(seed);
            let (samples, report) = psp::project(&context, &mesh, &options, iterations, true, None).unwrap();
            assert_eq!(report.iterations, iterations);
            check(&mesh, &samples, radius, true);
        }
    }
}

/// A box of 10^5 radii along each side with next to nothing in it: projecting patterns through it would take hours.
#[test]
fn small_parts_far_apart_are_filled_without_global_projectors() {
    let triangle = |x: f32| vec![[x, x, -x], [x + 1.0, x, -x], [x, x + 1.0, 1.0 - x]];
    let positions = [triangle(0.0), triangle(1e3), triangle(2e3)].concat();
    let mesh = mesh((positions, vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]]));
    let global = ProjectionOptions::new(0.02).projectors(Projectors::Global);
    let (samples, report) = psp::project(&Context::new(2).unwrap(), &mesh, &global, 1, true, None).unwrap();
    check(&mesh, &samples, 0.02, true);
    assert_eq!((report.iterations, report.rays), (0, 0));
    // Local projectors do not see what lies between.
    let (samples, report) =
        psp::project(&Context::new(2).unwrap(), &mesh, &ProjectionOptions::new(0.02), 1, true, None).unwrap();
    check(&mesh, &samples, 0.02, true);
    assert!(report.iterations == 1 && report.rays < 20 * report.samples, "{report:?}");
}

#[test]
fn a_radius_larger_than_the_mesh_gives_one_sample() {
    for radius in [10.0, 1e10, 1e200] {
        let mesh = mesh(meshes::sphere());
        check_all(&mesh, radius);
        let (samples, _) = psp::sample(&Context::new(1).unwrap(), &mesh, &Options::new(radius), None).unwrap();
        assert_eq!(samples.len(), 1);
    }
}

#[test]
fn any_size_and_any_distance_from_the_origin() {
    for (scale, offset) in [(1e-6, 0.0), (1e6, 0.0), (1.0, 1000.0), (1e-30, 0.0), (1e30, 3e31)] {
        check_all(&mesh(meshes::placed(meshes::torus(), scale, offset)), 0.2 * scale);
    }
}

/// The jamming limit of random sequential placement is [`MAXIMAL_DENSITY`] / radius²; the boundary of the plane adds to it. Projected
/// samples leave a set some 2 % sparser, and more with some seeds.
#[test]
fn a_maximal_set_is_as_dense_as_darts_become() {
    let context = Context::new(2).unwrap();
    let sphere = mesh(meshes::sphere());
    for (mesh, radius, boundary) in [(mesh(meshes::plane()), 0.005, 4.0), (sphere, 0.02, 0.0)] {
        for iterations in [0, 3] {
            let options = ProjectionOptions::new(radius);
            let (samples, _) = psp::project(&context, &mesh, &options, iterations, true, None).unwrap();
            let expected = MAXIMAL_DENSITY * (mesh.area() + 0.5 * boundary * radius) / (radius * radius);
            let ratio = samples.len() as f64 / expected;
            let tolerance = if iterations == 0 { 0.02 } else { 0.04 };
            assert!((ratio - 1.0).abs() < tolerance, "{iterations} iterations: {ratio}");
        }
    }
}

#[test]
fn iterations_only_add_and_can_be_made_in_pieces() {
    let context = Context::new(2).unwrap();
    let mesh = mesh(meshes::torus());
    let options = ProjectionOptions::new(0.05).seed(7);
    let mut whole = Psp::new(&mesh, &options).unwrap();
    let mut pieces = Psp::new(&mesh, &options).unwrap();
    whole.advance(&context, 4, None).unwrap();
    let mut before = Points::<3>::default();
    for iterations in [1, 0, 2, 1] {
        let report = pieces.advance(&context, iterations, None).unwrap();
        let samples = pieces.samples();
        assert_eq!(report.accepted, (samples.len() - before.len()) as u64);
        assert_eq!(samples.positions[..before.len()], before.positions);
        before = samples;
    }
    assert_eq!(before, whole.samples());
    whole.fill(&context, None).unwrap();
    assert_eq!(whole.samples().positions[..before.len()], before.positions);
    assert!(whole.samples().len() > before.len());

    // Nothing fits into a maximal set.
    assert_eq!(whole.advance(&context, 1, None).unwrap().accepted, 0);
    assert_eq!(whole.fill(&context, None).unwrap().accepted, 0);
    let other = psp::sample(&context, &mesh, &Options::new(0.05).seed(8), None).unwrap().0;
    assert_ne!(other.positions[..20], before.positions[..20], "another seed gives another set");
}

/// On the surface's flanks the pattern is stretched, and what comes first there leaves gaps that are too small for others.
#[test]
fn candidates_can_come_in_the_order_of_the_thesis_which_finds_fewer() {
    let context = Context::new(2).unwrap();
    let mesh = mesh(meshes::torus());
    let radius = 0.03;
    let found = [Priority::Squareness, Priority::Projector].map(|priority| {
        let options = ProjectionOptions::new(radius).projectors(Projectors::Global).priority(priority);
        let mut psp = Psp::new(&mesh, &options).unwrap();
        psp.advance(&context, 1, None).unwrap();
        check(&mesh, &psp.samples(), radius, false);
        let found = psp.len();
        psp.fill(&context, None).unwrap();
        check(&mesh, &psp.samples(), radius, true);
        found as f64
    });
    assert!(found[0] > 1.05 * found[1], "{found:?}");
}

#[test]
fn a_small_maximal_set_is_only_filled_unless_iterations_are_asked_for() {
    let (context, mesh) = (Context::new(2).unwrap(), mesh(meshes::torus()));
    let (filled, _) = psp::sample(&context, &mesh, &Options::new(0.1), None).unwrap();
    let options = FlatOptions::new(0.1);
    let sample = |options: FlatOptions| options.sample(&context, &mesh, None).unwrap();
    let (by_rule, report) = sample(options);
    assert_eq!((report.iterations, report.uncovered_before), (0, Some(1.0)));
    assert_eq!(by_rule, filled);
    assert_eq!(by_rule, sample(options.iterations(Some(0))).0);
    assert_eq!(sample(options.iterations(Some(2))).1.iterations, 2);
    assert_eq!(sample(options.maximal(false)).1.iterations, 1);
    let none = options.maximal(false).iterations(Some(0)).sample(&context, &mesh, None);
    assert!(matches!(none, Err(Error::InvalidArgument { argument: "iterations", .. })));
}

/// The other side of the rule: more samples than are filled in one piece, on few triangles.
#[test]
fn a_large_maximal_set_on_few_triangles_begins_with_an_iteration_unless_darts_are_asked_for() {
    let (context, mesh, radius) = (Context::new(2).unwrap(), mesh(meshes::torus()), 0.017);
    let given = [[1.4, 0.0, 0.0], [0.0, 1.4, 0.0]];
    for given in [Given::default(), Given::at(&given), Given::with_clearances(&given, &[0.1, 0.2])] {
        let project = |iterations: u32| {
            let options = ProjectionOptions::new(radius).seed(3).given(given);
            psp::project(&context, &mesh, &options, iterations, true, None).unwrap()
        };
        let [(filled, _), (projected, report)] = [0, 1].map(project);
        assert!(filled.len() > 25_000 && filled != projected, "{}", filled.len());
        let options = Options::new(radius).seed(3).given(given);
        let (by_default, told) = psp::sample(&context, &mesh, &options, None).unwrap();
        assert_eq!(by_default, projected);
        assert_eq!([told.rays, told.hits, told.darts], [report.rays, report.hits, report.darts]);
        assert!(told.iterations == 1 && told.hits > 0 && told.darts < 2 * told.samples, "{told:?}");
        assert_eq!(told.hits + told.darts, told.samples + told.conflicts + told.restart_conflicts);
        assert_eq!(psp::sample(&context, &mesh, &options.projected(false), None).unwrap().0, filled);

        let options = FlatOptions::new(radius).seed(3).given(given);
        let flat = |options: FlatOptions| options.sample(&context, &mesh, None).unwrap().0;
        assert_eq!(flat(options), projected);
        assert_eq!(flat(options.iterations(Some(0))), filled);
        // What has no local projectors is filled only, and what given samples cover for the most part.
        let covered = Options::new(radius).given(Given::at(&filled.positions));
        assert_eq!(psp::sample(&context, &mesh, &covered, None).unwrap().1.iterations, 0);
        assert_eq!(flat(options.projectors(Projectors::Global)), filled);
        assert_eq!(flat(options.cosine(0.5)), flat(options.cosine(0.5).iterations(Some(0))));
    }
}

#[test]
fn a_report_says_where_the_time_went_and_how_good_the_set_is() {
    let context = Context::new(2).unwrap();
    let mesh = mesh(meshes::fine_torus(100, 50));
    for &engine in Engine::AVAILABLE {
        let options = ProjectionOptions::new(0.01).engine(engine).projectors(Projectors::Global);
        let mut psp = Psp::new(&mesh, &options).unwrap();
        let first = psp.advance(&context, 1, None).unwrap();
        let second = psp.advance(&context, 1, None).unwrap();
        let positions = psp.samples().positions;
        let uncovered =
            coverage::surface_uncovered_fraction(&context, &mesh, &positions, 0.01, 100_000, 1, None).unwrap();
        let filled = psp.fill(&context, None).unwrap();
        let again = psp.fill(&context, None).unwrap();

        let stages = |report: &psp::Report| {
            [report.prepare_seconds, report.project_seconds, report.merge_seconds, report.fill_seconds]
        };
        for (report, used) in [(first, [1, 1, 1, 0]), (second, [0, 1, 1, 0]), (filled, [0, 0, 0, 1])] {
            assert!(
                stages(&report).iter().zip(used).all(|(&seconds, used)| (seconds > 1e-4) == (used == 1)),
                "{report:?}"
            );
            let sum: f64 = stages(&report).iter().sum();
            assert!(sum <= report.seconds && sum > 0.8 * report.seconds, "{report:?}");
        }
        assert_eq!([first.uncovered_before, second.uncovered_before], [None; 2]);
        assert_eq!([filled.uncovered_after, again.uncovered_after], [Some(0.0); 2]);
        let before = filled.uncovered_before.unwrap();
        assert!((0.9..1.1).contains(&(before / uncovered)), "{before} for {uncovered}");
        assert!(again.uncovered_before.unwrap() < 0.1 * before);
        let smallest = spacing::smallest_distance_3d(&context, &psp.samples().positions, None).unwrap();
        let hexagonal = (2.0 * mesh.area() / (3f64.sqrt() * psp.len() as f64)).sqrt();
        assert!(
            (filled.rho - smallest / hexagonal).abs() < 1e-5 && filled.rho > first.rho,
            "{} {}",
            first.rho,
            filled.rho
        );
    }
}

#[test]
fn a_cancelled_call_leaves_a_valid_set_that_can_be_used_on() {
    let mesh = mesh(meshes::torus());
    let options = ProjectionOptions::new(0.08);
    for threads in [1, 3] {
        let context = Context::new(threads).unwrap();
        let expected = psp::project(&context, &mesh, &options, 1, true, None).unwrap().0;
        for limit in [0.0, 0.2, 0.5, 0.95, 1.0] {
            let stop = |share: f64| if share >= limit { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
            assert!(matches!(psp::project(&context, &mesh, &options, 1, true, Some(&stop)), Err(Error::Cancelled)));
            let mut psp = Psp::new(&mesh, &options).unwrap();
            assert!(matches!(psp.advance(&context, 1, Some(&stop)), Err(Error::Cancelled)));
            check(&mesh, &psp.samples(), options.radius, false);
            assert_eq!(psp.samples().positions[..], expected.positions[..psp.len()]);
            assert!(matches!(psp.fill(&context, Some(&stop)), Err(Error::Cancelled)));
            check(&mesh, &psp.samples(), options.radius, false);
            psp.advance(&context, 1, None).unwrap();
            psp.fill(&context, None).unwrap();
            check(&mesh, &psp.samples(), options.radius, true);
        }
    }
}

/// At every single call of the callback: while patterns and scene are made, in every stage of iterations and of the fill.
#[test]
fn whenever_it_is_cancelled_a_set_stays_valid_and_can_go_on() {
    let mesh = mesh(meshes::torus());
    let context = Context::new(1).unwrap();
    // The engines report at the same places, and take turns at ending a call there.
    let engines = Engine::AVAILABLE;
    for (turn, &engine) in engines.iter().enumerate() {
        let options = ProjectionOptions::new(0.13).engine(engine);
        let expected = psp::project(&context, &mesh, &options, 1, true, None).unwrap().0;
        let mut lengths = vec![];
        for limit in (1 + turn..).step_by(engines.len()) {
            let calls = Cell::new(0);
            let stop = |_| {
                calls.set(calls.get() + 1);
                if calls.get() == limit { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            // One that keeps no pattern yet.
            let context = Context::new(1).unwrap();
            let mut psp = Psp::new(&mesh, &options).unwrap();
            let cancelled = psp.advance(&context, 1, Some(&stop)).and_then(|_| psp.fill(&context, Some(&stop)));
            check(&mesh, &psp.samples(), options.radius, cancelled.is_ok());
            assert_eq!(psp.samples().positions[..], expected.positions[..psp.len()]);
            if calls.get() < limit {
                break;
            }
            assert!(matches!(cancelled, Err(Error::Cancelled)), "at call {limit}");
            lengths.push(psp.len());
            psp.advance(&context, 1, None).unwrap();
            psp.fill(&context, None).unwrap();
            check(&mesh, &psp.samples(), options.radius, true);
        }
        assert!(lengths.len() > 20 / engines.len() && lengths.is_sorted(), "{}", lengths.len());
        lengths.dedup();
        assert!(lengths.len() > 2 && lengths[0] == 0, "{lengths:?}");
    }
}

#[test]
fn the_checkers_see_what_is_wrong() {
    let mesh = mesh(meshes::torus());
    let radius = 0.15;
    let (good, _) = psp::sample(&Context::new(1).unwrap(), &mesh, &Options::new(radius), None).unwrap();
    for removed in (0..good.len()).step_by(50) {
        let mut bad = good.clone();
        bad.positions.remove(removed);
        assert!(oracle::gap(&mesh, &bad, radius, tolerance(&mesh)).is_some(), "sample {removed} is missing");
    }
    let closest = (0..good.len()).map(|i| {
        let apart =
            |j: usize| (0..3).map(|axis| (good.positions[i][axis] - good.positions[j][axis]).powi(2)).sum::<f32>();
        (0..i).map(apart).fold(f32::INFINITY, f32::min)
    });
    let closest = closest.fold(f32::INFINITY, f32::min).sqrt();
    assert!(oracle::conflict(&good, f64::from(closest) * 1.001).is_some());
    let mut bad = good.clone();
    bad.positions[3][1] *= 1.0 + f32::EPSILON;
    assert_eq!(oracle::misplaced(&mesh, &bad), Some(3));
    let mut bad = good;
    bad.normals[4] = bad.normals[4].map(|x| -x);
    assert_eq!(oracle::misplaced(&mesh, &bad), Some(4));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn random_soups(seed: u64, triangles in 1u32..8, size in -3.0f64..0.5, iterations in 0u32..3, offset in 0.0f64..30.0) {
        let mesh = mesh(meshes::placed(meshes::random_soup(seed, triangles), 1.0, offset));
        let radius = (mesh.area().sqrt() * 10f64.powf(size)).max(0.01);
        let options = ProjectionOptions::new(radius).seed(seed);
        let (samples, _) = psp::project(&Context::new(2).unwrap(), &mesh, &options, iterations, true, None).unwrap();
        check(&mesh, &samples, radius, true);
    }
}
