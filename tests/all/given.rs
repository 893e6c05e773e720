//! Samples on meshes around given ones, held against the definitions by plain checkers.

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::adaptive::{self, Radius};
use azulejo::psp::{self, Engine, Options, ProjectionOptions, Psp, Report};
use azulejo::{Context, Error, Given, Points};
use proptest::prelude::*;

use crate::common::adaptive_oracle as oracle;
use crate::common::adaptive_oracle::{Ball, Field};
use crate::common::meshes::{self, Soup};
use crate::common::random::Random;
use crate::common::tolerance::tolerance;

fn mesh((positions, triangles): Soup) -> Arc<Mesh> {
    Arc::new(Mesh::new(positions, triangles).unwrap())
}

fn balls(given: Given<3>, radius: f64) -> Vec<Ball> {
    let ball = |(i, position): (usize, &[f32; 3])| (position.map(f64::from), given.clearance(i, radius));
    given.positions.iter().enumerate().map(ball).collect()
}

/// Everything that a set of one radius owes.
fn check(mesh: &Mesh, samples: &Points<3>, options: &ProjectionOptions, maximal: bool) {
    let (balls, radii) = (balls(options.given, options.radius), vec![options.radius; samples.len()]);
    assert_eq!(oracle::conflict(samples, &radii, options.cosine), None);
    assert_eq!(oracle::too_near(samples, &balls), None);
    if maximal {
        let at = |_: [f64; 3]| options.radius;
        let field = Field::Function(&at, 0.0);
        let gap = oracle::gap_around(mesh, &field, samples, &radii, options.cosine, tolerance(mesh), &balls);
        assert_eq!(gap, None);
    }
}

/// A set that is only filled on one thread and on three, checked.
fn sample(mesh: &Arc<Mesh>, options: &ProjectionOptions) -> (Points<3>, Report) {
    let &ProjectionOptions { radius, seed, given, cosine, .. } = options;
    let filled = Options::new(radius).seed(seed).given(given).cosine(cosine);
    let on = |threads| psp::sample(&Context::new(threads).unwrap(), mesh, &filled, None).unwrap();
    checked(mesh, [on(1), on(3)], options, true)
}

/// A set after an iteration on one thread and on three, checked.
fn project(mesh: &Arc<Mesh>, options: &ProjectionOptions, maximal: bool) -> (Points<3>, Report) {
    let on = |threads| psp::project(&Context::new(threads).unwrap(), mesh, options, 1, maximal, None).unwrap();
    checked(mesh, [on(1), on(3)], options, maximal)
}

fn checked(
    mesh: &Mesh,
    [(samples, report), (again, _)]: [(Points<3>, Report); 2],
    options: &ProjectionOptions,
    maximal: bool,
) -> (Points<3>, Report) {
    assert_eq!(samples, again, "depends on the number of threads");
    check(mesh, &samples, options, maximal);
    assert_eq!((report.samples, report.accepted), (samples.len() as u64, samples.len() as u64));
    assert_eq!(report.hits + report.darts, report.accepted + report.conflicts + report.restart_conflicts);
    (samples, report)
}

/// A set of radii that vary on one thread and on three, checked.
fn sample_adaptive(mesh: &Mesh, options: &adaptive::Options, field: &Field) -> Points<3> {
    let [(set, _), (again, _)] =
        [1, 3].map(|threads| adaptive::sample(&Context::new(threads).unwrap(), mesh, options, None).unwrap());
    assert_eq!(set, again, "depends on the number of threads");
    let (samples, radii, balls) = (&set, &set.radii, balls(options.given, f64::NAN));
    assert_eq!(oracle::conflict(samples, radii, options.cosine), None);
    assert_eq!(oracle::too_near(samples, &balls), None);
    // More than the documented one: that of the radii, which change by no more than the lengths.
    let tolerance = 2.0 * tolerance(mesh) + 1e-6 * radii.iter().copied().fold(0.0, f64::max);
    assert_eq!(oracle::gap_around(mesh, field, samples, radii, options.cosine, tolerance, &balls), None);
    set
}

/// All kinds of sets on a mesh around given samples: filled, projected, both, with radii of vertices and of a function.
fn check_all(mesh: &Arc<Mesh>, radius: f64, given: Given<3>) {
    let options = ProjectionOptions::new(radius).given(given);
    sample(mesh, &options);
    for &engine in Engine::AVAILABLE {
        let options = options.engine(engine);
        project(mesh, &options, false);
        project(mesh, &options, true);
    }
    if radius > 1e3 {
        return;
    }
    let clearances: Vec<f64> = balls(given, radius).iter().map(|ball| ball.1).collect();
    let given = Given::with_clearances(given.positions, &clearances);
    let radii: Vec<f32> = (0..mesh.positions().len()).map(|i| radius as f32 * [1.0, 1.5][i % 2]).collect();
    sample_adaptive(mesh, &adaptive::Options::new(Radius::PerVertex(&radii)).given(given), &Field::PerVertex(&radii));
    let low = mesh.bounds().0.map(f64::from);
    let at = |place: [f64; 3]| (radius + 0.1 * (place[0] - low[0]).max(0.0)).min(1.5 * radius);
    let function = Radius::Function { at: &at, smallest: radius, largest: 1.5 * radius, slope: 0.1 };
    sample_adaptive(mesh, &adaptive::Options::new(function).given(given), &Field::Function(&at, 0.1));
}

/// Random points on a mesh and near it.
fn points_near(mesh: &Mesh, distance: f64, count: usize, seed: u64) -> Vec<[f32; 3]> {
    let mut random = Random::new(seed);
    let mut point = || {
        let triangle = (random.unit() * mesh.triangles().len() as f32) as u32;
        let (u, v) = (random.unit(), random.unit());
        let place = mesh.point(triangle, if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] });
        place.map(|x| (f64::from(x) + distance * (2.0 * f64::from(random.unit()) - 1.0)) as f32)
    };
    (0..count).map(|_| point()).collect()
}

/// Clearances between two, even in their logarithms.
fn clearances(least: f64, largest: f64, count: usize, seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    (0..count).map(|_| least * (largest / least).powf(random.unit().into())).collect()
}

#[test]
fn clearances_that_are_the_radius_or_span_five_orders() {
    for (soup, radius) in [(meshes::torus(), 0.2), (meshes::plane(), 0.06)] {
        let mesh = mesh(soup);
        for distance in [0.0, 0.7 * radius] {
            let positions = points_near(&mesh, distance, 60, 3);
            check_all(&mesh, radius, Given::at(&positions));
            let clearances = clearances(1e-4 * radius, 10.0 * radius, 60, 4);
            check_all(&mesh, radius, Given::with_clearances(&positions, &clearances));
        }
        // Many tiny ones, which cover next to nothing, and some in one place.
        let mut positions = points_near(&mesh, 0.0, 400, 5);
        positions.extend([positions[0]; 40]);
        check_all(&mesh, radius, Given::with_clearances(&positions, &vec![0.05 * radius; positions.len()]));
    }
}

#[test]
fn soups_needles_and_masked_meshes() {
    let masked = {
        let (positions, triangles) = meshes::torus();
        let mask = (0..triangles.len()).map(|i| i % 7 < 4).collect();
        Arc::new(Mesh::new(positions, triangles).unwrap().with_mask(mask).unwrap())
    };
    let soup = mesh(meshes::random_soup(3, 12));
    let kinds = [(masked, 0.15), (soup, 0.1), (mesh(meshes::needles(1e-6)), 0.01), (mesh(meshes::slivers()), 0.03)];
    for (mesh, radius) in kinds {
        let positions = points_near(&mesh, 0.3 * radius, 30, 6);
        check_all(&mesh, radius, Given::with_clearances(&positions, &clearances(0.01 * radius, 3.0 * radius, 30, 7)));
        check_all(&mesh, radius, Given::at(&positions));
    }
}

#[test]
fn any_size_and_any_place() {
    for (scale, offset) in [(1e-6, 0.0), (1.0, 1000.0), (1e-30, 0.0), (1e30, 3e31)] {
        let mesh = mesh(meshes::placed(meshes::torus(), scale, offset));
        let mut positions = points_near(&mesh, 0.1 * scale, 20, 8);
        let mut clearances = clearances(1e-5 * scale, 0.7 * scale, 20, 9);
        // Without effect: far away, or with a clearance of 0. And at the edge of what floats can be.
        positions.extend([[3.4e38; 3], [-3.4e38, 3.4e38, -3.4e38], [f32::MIN_POSITIVE, -1e-45, 0.0], positions[3]]);
        clearances.extend([1e-38, 1e30, 0.3 * scale, 0.0]);
        check_all(&mesh, 0.25 * scale, Given::with_clearances(&positions, &clearances));
    }
}

#[test]
fn what_a_clearance_of_zero_or_a_ball_elsewhere_changes_is_nothing() {
    let mesh = mesh(meshes::torus());
    let options = ProjectionOptions::new(0.1).seed(2);
    let expected = sample(&mesh, &options).0;
    let mut positions = points_near(&mesh, 0.0, 50, 1);
    positions.extend([[9.0; 3], [f32::MAX; 3]]);
    let clearances: Vec<f64> = (0..52).map(|i| if i < 50 { 0.0 } else { 1.0 }).collect();
    let same = sample(&mesh, &options.given(Given::with_clearances(&positions, &clearances))).0;
    assert_eq!(same, expected);
    assert_eq!(sample(&mesh, &options.given(Given::at(&positions[50..]))).0, expected);
}

#[test]
fn a_ball_around_everything_leaves_no_sample() {
    let mesh = mesh(meshes::sphere());
    for (position, clearance) in [([0.0; 3], 1e3), ([1e38, 0.0, 0.0], 3e38), ([2.0, 0.0, 0.0], 1e200)] {
        for iterations in [0, 1] {
            let (positions, clearances) = ([position], [clearance]);
            let given = Given::with_clearances(&positions, &clearances);
            let options = ProjectionOptions::new(0.2).given(given);
            let context = Context::new(2).unwrap();
            let (samples, report) = psp::project(&context, &mesh, &options, iterations, true, None).unwrap();
            assert_eq!((samples.len(), report.uncovered_before), (0, Some(0.0)));
        }
    }
}

/// A ball that ends just beyond the surface, or just before it, all over: floats could not tell which.
#[test]
fn a_ball_as_large_as_the_mesh() {
    let mesh = mesh(meshes::sphere());
    let radii = mesh.positions().iter().map(|position| {
        let [x, y, z] = position.map(f64::from);
        (x * x + y * y + z * z).sqrt()
    });
    let farthest = radii.fold(0.0, f64::max);
    for (clearance, covers) in [(farthest * (1.0 + 1e-12), true), (0.99, false), (1e-3, false)] {
        let options = ProjectionOptions::new(0.3);
        let clearances = [clearance];
        let (samples, report) = sample(&mesh, &options.given(Given::with_clearances(&[[0.0; 3]], &clearances)));
        assert_eq!(samples.is_empty(), covers);
        assert!(report.darts < 100_000, "{}", report.darts);
    }
    // Seen from far away it is a plane through the mesh.
    for distance in [1e3f32, 1e7] {
        let (positions, clearances) = ([[0.0, 0.0, distance]], [f64::from(distance)]);
        let options = ProjectionOptions::new(0.2).given(Given::with_clearances(&positions, &clearances));
        let samples = sample(&mesh, &options).0;
        assert!(samples.positions.iter().all(|position| position[2] < 1e-3), "{distance}");
        assert!(!samples.is_empty());
    }
}

#[test]
fn radii_far_above_the_mesh_count_from_given_samples_as_well() {
    let mesh = mesh(meshes::sphere());
    // Inside of the radius, and outside of it.
    for (place, expected) in [(90.0, 0), (110.0, 1)] {
        let positions = [[place, 0.0, 0.0]];
        let options = Options::new(100.0).given(Given::at(&positions));
        let samples = psp::sample(&Context::new(1).unwrap(), &mesh, &options, None).unwrap().0;
        assert_eq!(samples.len(), expected, "{place}");
    }
}

/// After an edit: all samples outside of the hole are given, and so stay bit for bit. The union is a set as any other.
#[test]
fn a_hole_is_filled_and_nothing_else_changes() {
    let mesh = mesh(meshes::torus());
    let options = ProjectionOptions::new(0.08);
    let before = sample(&mesh, &options).0;
    let is_outside = |position: &&[f32; 3]| position[0] < 0.8;
    let outside: Vec<[f32; 3]> = before.positions.iter().filter(is_outside).copied().collect();
    let (new, report) = sample(&mesh, &options.seed(9).given(Given::at(&outside)));
    let [lost, gained] = [before.len() - outside.len(), new.len()];
    assert!((lost.abs_diff(gained) as f64) < 0.2 * lost as f64, "{gained} for {lost}");
    assert!(new.positions.iter().all(|position| position[0] > 0.7));
    assert!((0.02..0.3).contains(&report.uncovered_before.unwrap()));
    let mut union = new.clone();
    union.positions.extend(&outside);
    union.normals.extend(vec![[0.0; 3]; outside.len()]);
    check(&mesh, &union, &options, true);
}

/// A set of twice the radius is given, and the finer one around it completes it.
#[test]
fn a_set_is_refined() {
    let mesh = mesh(meshes::torus());
    let coarse = sample(&mesh, &ProjectionOptions::new(0.16)).0;
    let options = ProjectionOptions::new(0.08).given(Given::at(&coarse.positions));
    let fine = sample(&mesh, &options).0;
    let direct = sample(&mesh, &ProjectionOptions::new(0.08)).0;
    let ratio = (coarse.len() + fine.len()) as f64 / direct.len() as f64;
    assert!((0.95..1.05).contains(&ratio), "{ratio}");
}

/// Plants of three sizes are painted by hand; grass grows between them and beside a road, given by points along it.
#[test]
fn grass_keeps_clear_of_plants_and_roads() {
    let mesh = mesh(meshes::plane());
    let plants = [([0.2, 0.2, 0.0], 0.1), ([0.6, 0.75, 0.0], 0.2), ([0.3, 0.5, 0.01], 0.05)];
    let half_width = 0.04;
    let road = (0..=100).map(|i| ([0.5 + 0.4 * (0.05 * i as f32).sin(), 0.01 * i as f32, 0.0], half_width));
    let (positions, clearances): (Vec<[f32; 3]>, Vec<f64>) = plants.into_iter().chain(road).unzip();
    let (grass, report) =
        sample(&mesh, &ProjectionOptions::new(0.03).given(Given::with_clearances(&positions, &clearances)));
    assert!(grass.len() > 300);
    assert!((0.5..0.9).contains(&report.uncovered_before.unwrap()));
}

/// The report's share of uncovered area is that of a lattice of points.
#[test]
fn the_uncovered_area_before_is_that_of_the_given_samples() {
    let mesh = mesh(meshes::plane());
    for (count, seed) in [(3, 1), (30, 2), (300, 3)] {
        let positions = points_near(&mesh, 0.0, count, seed);
        let clearances = clearances(0.03, 0.2, count, seed);
        let given = Given::with_clearances(&positions, &clearances);
        let balls = balls(given, f64::NAN);
        let is_open = |i: &usize| {
            let place = [(i % 200) as f64 / 200.0, (i / 200) as f64 / 200.0, 0.0];
            let squared = |b: [f64; 3]| (0..3).map(|axis| (place[axis] - b[axis]).powi(2)).sum::<f64>();
            balls.iter().all(|&(centre, clearance)| squared(centre) >= clearance * clearance)
        };
        let expected = (0..40_000).filter(is_open).count() as f64 / 40_000.0;
        let report = psp::sample(&Context::new(1).unwrap(), &mesh, &Options::new(0.02).given(given), None).unwrap().1;
        let before = report.uncovered_before.unwrap();
        assert!((before - expected).abs() < 0.05, "{before} for {expected}");
    }
}

#[test]
fn a_handle_keeps_what_is_given_for_all_its_calls() {
    let (context, mesh) = (Context::new(2).unwrap(), mesh(meshes::torus()));
    let options = ProjectionOptions::new(0.15);
    let mut psp = {
        let positions = points_near(&mesh, 0.0, 20, 2);
        let clearances = clearances(0.01, 0.5, 20, 3);
        Psp::new(&mesh, &options.given(Given::with_clearances(&positions, &clearances))).unwrap()
    };
    let positions = points_near(&mesh, 0.0, 20, 2);
    let clearances = clearances(0.01, 0.5, 20, 3);
    let options = options.given(Given::with_clearances(&positions, &clearances));
    psp.advance(&context, 2, None).unwrap();
    check(&mesh, &psp.samples(), &options, false);
    psp.fill(&context, None).unwrap();
    check(&mesh, &psp.samples(), &options, true);
    assert_eq!(psp.fill(&context, None).unwrap().accepted, 0);
}

/// The sides of a wall much thinner than the radius, with a normal cone and without; given samples act on both.
#[test]
fn both_sides_of_a_thin_wall() {
    let wall = {
        let (low, mut high) = (meshes::plane(), meshes::plane());
        high.0.iter_mut().for_each(|position| position[2] = 0.001);
        high.1.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        mesh(meshes::join([low, high]))
    };
    let one_side = sample(&mesh(meshes::plane()), &ProjectionOptions::new(0.05)).0.len() as f64;
    for cosine in [-1.0, 0.0, 0.9, 1.0] {
        let both = sample(&wall, &ProjectionOptions::new(0.05).cosine(cosine)).0.len() as f64;
        let expected = if cosine > -1.0 { 2.0 * one_side } else { one_side };
        assert!((both / expected - 1.0).abs() < 0.1, "{cosine}: {both} for {expected}");
    }
    let positions = [[0.5, 0.5, 0.002], [0.1, 0.2, 0.001]];
    let options = ProjectionOptions::new(0.05).cosine(0.5);
    sample(&wall, &options.given(Given::with_clearances(&positions, &[0.3, 0.01])));
    sample(&wall, &options.given(Given::at(&positions)));
    for soup in [meshes::torus(), meshes::random_soup(5, 9)] {
        sample(&mesh(soup), &ProjectionOptions::new(0.1).cosine(0.7));
    }
    let mut psp = Psp::new(&wall, &ProjectionOptions::new(0.05).cosine(0.5)).unwrap();
    let context = Context::new(1).unwrap();
    psp.fill(&context, None).unwrap();
    assert_eq!(psp.fill(&context, None).unwrap().accepted, 0);
}

#[test]
fn what_cannot_be_is_refused() {
    let (context, mesh) = (Context::new(1).unwrap(), mesh(meshes::plane()));
    let invalid = |result| match result {
        Err(Error::InvalidArgument { argument, reason }) => (argument, reason),
        other => panic!("{other:?}"),
    };
    let refused = |options: Options| invalid(psp::sample(&context, &mesh, &options, None));
    let options = Options::new(0.1);
    let positions = [[0.0; 3], [0.0, f32::NAN, 0.0]];
    let (argument, reason) = refused(options.given(Given::at(&positions)));
    assert!(argument == "given_positions" && reason.starts_with("[1] is"), "{reason}");
    let (argument, reason) = refused(options.given(Given::with_clearances(&positions[..1], &[-1.0])));
    assert!(argument == "given_clearances" && reason.starts_with("[0] is -1.0"), "{reason}");
    assert_eq!(refused(options.given(Given::with_clearances(&positions[..1], &[]))).0, "given_clearances");
    for cosine in [f64::NAN, -1.1, 1.1] {
        assert_eq!(refused(options.cosine(cosine)).0, "cosine");
    }
    for maximal in [false, true] {
        let options = ProjectionOptions::new(0.1).cosine(0.5);
        let (argument, reason) = invalid(psp::project(&context, &mesh, &options, 1, maximal, None));
        assert!(argument == "cosine" && reason.contains("iterations"), "{reason}");
    }
    let varying = adaptive::Options::new(Radius::PerVertex(&[0.1; 4])).given(Given::at(&positions[..1]));
    let Err(Error::InvalidArgument { argument, .. }) = adaptive::sample(&context, &mesh, &varying, None) else {
        panic!("no clearances");
    };
    assert_eq!(argument, "given_clearances");
}

#[test]
fn the_checkers_see_a_given_sample_that_is_moved_or_left_out() {
    let mesh = mesh(meshes::torus());
    let radius = 0.15;
    let positions = points_near(&mesh, 0.0, 12, 4);
    let clearances = clearances(0.3, 0.6, 12, 5);
    let given = Given::with_clearances(&positions, &clearances);
    let samples = sample(&mesh, &ProjectionOptions::new(radius).given(given)).0;
    let good = balls(given, radius);
    let gap = |balls: &[Ball]| {
        let (at, radii) = (|_: [f64; 3]| radius, vec![radius; samples.len()]);
        oracle::gap_around(&mesh, &Field::Function(&at, 0.0), &samples, &radii, -1.0, tolerance(&mesh), balls)
    };
    assert!(gap(&good).is_none());
    let mut seen = [0; 3];
    for i in 0..good.len() {
        let (mut less, mut moved) = (good.clone(), good.clone());
        less.remove(i);
        moved[i].0[0] += 0.2;
        seen[0] += usize::from(gap(&less).is_some());
        seen[1] += usize::from(gap(&moved).is_some());
        seen[2] += usize::from(oracle::too_near(&samples, &moved).is_some());
    }
    assert!(seen.into_iter().all(|count| count >= 6), "{seen:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn random_soups(seed: u64, triangles in 1u32..8, size in -2.0f64..0.5, spread in 0.0f64..4.0, count in 0usize..40) {
        let mesh = mesh(meshes::random_soup(seed, triangles));
        let radius = (mesh.area().sqrt() * 10f64.powf(size)).max(0.02);
        let positions = points_near(&mesh, radius, count, seed);
        let clearances = clearances(radius * 10f64.powf(-spread), radius * 2.0, count, seed);
        let options = ProjectionOptions::new(radius).given(Given::with_clearances(&positions, &clearances)).seed(seed);
        sample(&mesh, &options);
        project(&mesh, &options, true);
        sample(&mesh, &options.cosine(0.5));
    }
}
