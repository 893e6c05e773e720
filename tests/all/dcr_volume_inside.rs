//! Relaxation inside of meshes: no point outside, fixed points where they were, what it reaches, and bad input.

use std::ops::ControlFlow;
use std::sync::Arc;

use azulejo::dcr::Stopped;
use azulejo::dcr::volume::{InsideOptions, Options, Report, relax, relax_inside};
use azulejo::mesh::Mesh;
use azulejo::volume::{self, Surface, sample_inside};
use azulejo::{Boundary, Context, Domain, Progress};

use crate::common::meshes;
use crate::common::random::Random;
use crate::volume_inside::{closed_shapes, corners, cube, depth, mesh, scaled, star, votes_inside};

/// A maximal set, and those of its samples that are on the surface.
fn maximal(mesh: &Arc<Mesh>, radius: f64, surface: Surface) -> (Vec<[f32; 3]>, Vec<bool>) {
    let options = volume::InsideOptions::new(radius).surface(surface);
    let (points, report) = sample_inside(&Context::new(1).unwrap(), mesh, &options, None).unwrap();
    let fixed = (0..points.len()).map(|i| i < report.surface_samples).collect();
    (points.positions, fixed)
}

fn relaxed(mesh: &Mesh, steps: u32, points: &[[f32; 3]], fixed: &[bool]) -> (Vec<[f32; 3]>, Report) {
    let options = InsideOptions::default().max_iterations(steps).fixed(fixed);
    relax_inside(&Context::new(1).unwrap(), mesh, &options, points, None).unwrap()
}

fn inside(mesh: &Mesh, random: &mut Random, count: usize) -> Vec<[f32; 3]> {
    let (low, high) = mesh.bounds();
    let place = |random: &mut Random| [0, 1, 2].map(|k: usize| low[k] + random.unit() * (high[k] - low[k]));
    std::iter::repeat_with(|| place(random)).filter(|&point| mesh.contains(point)).take(count).collect()
}

/// All by the exact test, and by rays in random directions where these can tell: not within the error of their sums.
fn check_inside(name: &str, mesh: &Mesh, points: &[[f32; 3]], fixed: &[bool]) {
    let mut random = Random::new(11);
    for (i, &point) in points.iter().enumerate().filter(|&(i, _)| fixed.get(i) != Some(&true)) {
        assert!(mesh.contains(point), "{name}: point {i} is outside, {point:?}");
        if i % 7 == 0 && depth(&corners(mesh), point.map(f64::from)) > 1e-5 {
            assert!(votes_inside(mesh, point, &mut random), "{name}: point {i} is outside, {point:?}");
        }
    }
}

/// The distance of the farthest of random places inside from the nearest point.
fn covering_radius(mesh: &Mesh, points: &[[f32; 3]]) -> f64 {
    let squared = |p: [f32; 3], q: &[f32; 3]| (0..3).map(|k| f64::from(p[k] - q[k]).powi(2)).sum::<f64>();
    let places = inside(mesh, &mut Random::new(3), 20_000);
    let distances = places.iter().map(|&place| points.iter().map(|q| squared(place, q)).fold(f64::INFINITY, f64::min));
    distances.fold(0.0, f64::max).sqrt()
}

/// From maximal sets and from random points, at the surface or not, after one step and after many.
#[test]
fn no_point_leaves_a_mesh_and_fixed_ones_stay() {
    for (name, soup, radius) in closed_shapes() {
        let mesh = mesh(soup);
        let sets = [Surface::Open, Surface::First].map(|surface| maximal(&mesh, radius, surface));
        let random = inside(&mesh, &mut Random::new(5), 300);
        let third = (0..300).map(|i| i % 3 == 0).collect();
        for (points, fixed) in sets.into_iter().chain([(random.clone(), Vec::new()), (random, third)]) {
            for steps in [0, 1, 3, 60] {
                let (after, report) = relaxed(&mesh, steps, &points, &fixed);
                check_inside(name, &mesh, &after, &fixed);
                assert_eq!(after.len(), points.len());
                let stays = |i: usize| steps == 0 || fixed.get(i) == Some(&true);
                assert!((0..points.len()).all(|i| !stays(i) || after[i] == points[i]), "{name} {steps}");
                let moved = after.iter().zip(&points).filter(|(a, b)| a != b).count();
                let free = points.len() - fixed.iter().filter(|&&is_fixed| is_fixed).count();
                assert!(steps == 0 || moved > free / 3, "{name} {steps}: {moved} of {free}");
                assert_eq!((report.iterations, report.stopped), (steps, Stopped::Steps));
            }
        }
    }
}

/// Beside edges of narrow wedges, and where floats hardly resolve the mesh or are tiny.
#[test]
fn no_point_leaves_meshes_that_are_thin_large_or_far() {
    let blade = |thickness: f32| {
        let (mut positions, triangles) = cube();
        positions.iter_mut().for_each(|p| p[2] *= thickness * p[0]);
        (positions, triangles)
    };
    for (name, soup) in [
        ("blade", blade(0.2)),
        ("thin blade", blade(1e-4)),
        ("far cube", meshes::placed(cube(), 1.0, 20_000.0)),
        ("far star", meshes::placed(star(), 1.0, 500_000.0)),
        ("large star", scaled(star(), 1e30)),
        ("small star", scaled(star(), 1e-30)),
    ] {
        let mesh = mesh(soup);
        let points = inside(&mesh, &mut Random::new(8), 200);
        for steps in [1, 40] {
            let (after, report) = relaxed(&mesh, steps, &points, &[]);
            check_inside(name, &mesh, &after, &[]);
            assert!(report.rho > 0.0 && report.rho.is_finite(), "{name}: {report:?}");
        }
    }
}

/// The forces, the wall and the unit of length are those of a bounded cuboid, but for a thin layer at the wall.
#[test]
fn a_cube_is_as_a_bounded_cuboid() {
    let mesh = mesh(cube());
    let domain = Domain { min: [0.0; 3], max: [1.0; 3], boundary: Boundary::Bounded };
    let points = inside(&mesh, &mut Random::new(2), 1000);
    let at_faces = |points: &[[f32; 3]], beside: f32| {
        points.iter().filter(|p| p.iter().any(|&x| x < beside || x > 1.0 - beside)).count() as f64
    };
    let (within, report) = relaxed(&mesh, 100, &points, &[]);
    let options = Options::new(domain).max_iterations(100);
    let (cuboid, wanted) = relax(&Context::new(1).unwrap(), &options, &points, None).unwrap();
    assert!((report.rho / wanted.rho - 1.0).abs() < 0.03, "{} {}", report.rho, wanted.rho);
    // 0.01 is a tenth of a spacing.
    let (own, wanted) = (at_faces(&within, 0.01), at_faces(&cuboid, 0.01));
    assert!(wanted > 300.0 && (own / wanted - 1.0).abs() < 0.08, "{own} {wanted}");
}

/// Larger distances and smaller holes than those of the maximal set, of which the surface stays or not.
#[test]
fn maximal_sets_are_spread() {
    for (name, soup, radius) in [
        ("torus", meshes::welded(meshes::torus()), 0.1),
        ("sphere", meshes::welded(meshes::sphere()), 0.16),
        ("star", star(), 0.09),
    ] {
        let mesh = mesh(soup);
        for surface in [Surface::Open, Surface::First] {
            let (points, fixed) = maximal(&mesh, radius, surface);
            let before = relaxed(&mesh, 0, &points, &fixed).1;
            let (after, report) = relaxed(&mesh, 200, &points, &fixed);
            let covers = [&points, &after].map(|points| covering_radius(&mesh, points));
            assert!(covers[1] < covers[0], "{name} {surface:?}: {covers:?}");
            match surface {
                Surface::Open => assert!(before.rho < 0.85 && report.rho > 0.94, "{name}: {report:?}"),
                // Samples of the surface are no farther from each other than before.
                Surface::First => assert!(report.rho > 0.99 * before.rho, "{name}: {} {report:?}", before.rho),
            }
        }
    }
}

/// The farthest of some points from the surface, over what is promised: two float spacings of the box, and 10^-7 of its size.
fn off_surface(mesh: &Mesh, points: impl Iterator<Item = [f32; 3]>) -> f64 {
    let (low, high) = mesh.bounds();
    let largest = low.iter().chain(&high).fold(0.0, |largest, x| f64::max(largest, x.abs().into()));
    let size = (0..3).map(|k| f64::from(high[k]) - f64::from(low[k])).fold(0.0, f64::max);
    let allowed = 2.0 * f64::from(f32::EPSILON) * largest + 1e-7 * size;
    let triangles = corners(mesh);
    points.map(|point| depth(&triangles, point.map(f64::from))).fold(0.0, f64::max) / allowed
}

fn slid(mesh: &Mesh, steps: u32, points: &[[f32; 3]], sliding: &[bool]) -> (Vec<[f32; 3]>, Report) {
    let options = InsideOptions::default().max_iterations(steps).sliding(sliding);
    relax_inside(&Context::new(1).unwrap(), mesh, &options, points, None).unwrap()
}

/// Those of the surface stay on it and move, and the others stay inside; also where floats hardly resolve the mesh or are tiny.
#[test]
fn sliding_points_stay_on_the_surface() {
    let placed = [
        ("far star", meshes::placed(star(), 1.0, 20_000.0), 0.2),
        ("large star", scaled(star(), 1e30), 0.2e30),
        ("small star", scaled(star(), 1e-30), 0.2e-30),
    ];
    for (name, soup, radius) in closed_shapes().into_iter().chain(placed) {
        let mesh = mesh(soup);
        let (points, sliding) = maximal(&mesh, radius, Surface::First);
        for steps in [0, 1, 3, 60] {
            let (after, report) = slid(&mesh, steps, &points, &sliding);
            let of_surface = || (0..points.len()).filter(|&i| sliding[i]);
            let off = off_surface(&mesh, of_surface().map(|i| after[i]));
            assert!(off <= 1.0, "{name} {steps}: {off}");
            check_inside(name, &mesh, &after, &sliding);
            let moved = of_surface().filter(|&i| after[i] != points[i]).count();
            assert!(steps == 0 || 2 * moved > of_surface().count(), "{name} {steps}: {moved}");
            assert_eq!((report.iterations, steps == 0), (steps, after == points), "{name}");
        }
    }
}

/// From one face of a cube to all others, past its edges and corners, and as far from each other as a few points get.
#[test]
fn sliding_points_pass_edges() {
    let mesh = mesh(cube());
    let mut random = Random::new(4);
    let points: Vec<[f32; 3]> = (0..300).map(|_| [random.unit(), random.unit(), 0.0]).collect();
    let after = slid(&mesh, 1000, &points, &[true; 300]).0;
    let on = |axis: usize, side: f32| after.iter().filter(|p| (p[axis] - side).abs() < 1e-6).count();
    for (axis, side) in [(0, 0.0), (0, 1.0), (1, 0.0), (1, 1.0), (2, 1.0)] {
        assert!(on(axis, side) > 20, "axis {axis} at {side}: {}", on(axis, side));
    }
    assert!(off_surface(&mesh, after.into_iter()) <= 1.0);
    let pair = slid(&mesh, 500, &[[0.5, 0.5, 0.0], [0.501, 0.5, 0.0]], &[true; 2]).1;
    assert!(pair.smallest_distance > 0.9, "{pair:?}");
}

/// A surface that slides ends with larger distances than one that is fixed, and no wider holes.
#[test]
fn sliding_surfaces_are_spread() {
    for (name, soup, radius) in [
        ("torus", meshes::welded(meshes::torus()), 0.1),
        ("sphere", meshes::welded(meshes::sphere()), 0.16),
        ("star", star(), 0.09),
    ] {
        let mesh = mesh(soup);
        let (points, on_surface) = maximal(&mesh, radius, Surface::First);
        let (fixed, of_fixed) = relaxed(&mesh, 200, &points, &on_surface);
        let (after, report) = slid(&mesh, 200, &points, &on_surface);
        let covers = [&fixed, &after].map(|points| covering_radius(&mesh, points));
        assert!(report.rho > 1.1 * of_fixed.rho && covers[1] < 1.02 * covers[0], "{name}: {report:?} {covers:?}");
    }
}

#[test]
fn threads_do_not_matter() {
    let mesh = mesh(meshes::welded(meshes::torus()));
    let (points, fixed) = maximal(&mesh, 0.045, Surface::First);
    assert!(points.len() > 9000, "{}", points.len());
    for fixed in [&fixed[..], &[]] {
        let points = if fixed.is_empty() { maximal(&mesh, 0.045, Surface::Open).0 } else { points.clone() };
        let one = relaxed(&mesh, 12, &points, fixed);
        for threads in [2, 3] {
            let options = InsideOptions::default().max_iterations(12).fixed(fixed);
            let context = Context::new(threads).unwrap();
            assert_eq!(relax_inside(&context, &mesh, &options, &points, None).unwrap(), one);
        }
    }
    let options = InsideOptions::default().max_iterations(12).sliding(&fixed);
    let threaded = relax_inside(&Context::new(3).unwrap(), &mesh, &options, &points, None).unwrap();
    assert_eq!(threaded, slid(&mesh, 12, &points, &fixed));
}

/// Heaps come apart, also at the surface, on it and on a fixed point; of two fixed points at one place none moves.
#[test]
fn coincident_points_are_parted() {
    let mesh = mesh(cube());
    for at in [[0.5; 3], [0.001, 0.5, 0.5], [0.001; 3]] {
        let points = vec![at; 20];
        for fixed in [vec![], (0..20).map(|i| i == 9).collect(), (0..20).map(|i| i < 2).collect()] {
            let (after, report) = relaxed(&mesh, 100, &points, &fixed);
            check_inside("cube", &mesh, &after, &fixed);
            let pairs = fixed.iter().filter(|&&is_fixed| is_fixed).count() == 2;
            assert_eq!(report.smallest_distance == 0.0, pairs, "{at:?}");
            // Of a heap in a corner, where all are held back at once, no more is promised.
            let least = if at[1] < 0.5 { 0.0 } else { 1e-4 };
            let free: Vec<_> = (0..20).filter(|&i| fixed.get(i) != Some(&true)).map(|i| after[i]).collect();
            let squared = |p: [f32; 3], q: [f32; 3]| (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f32>();
            let apart = free.iter().enumerate().all(|(i, &p)| free[..i].iter().all(|&q| squared(p, q) > least));
            assert!(apart, "{at:?}");
        }
    }
    for at in [[0.5, 0.5, 0.0], [0.5, 0.0, 0.0], [0.0; 3]] {
        let (after, report) = slid(&mesh, 100, &[at; 20], &[true; 20]);
        assert!(off_surface(&mesh, after.into_iter()) <= 1.0 && report.smallest_distance > 0.01, "{at:?} {report:?}");
    }
}

#[test]
fn few_points() {
    let mesh = mesh(cube());
    for points in [vec![], vec![[0.5; 3]]] {
        let (same, report) = relaxed(&mesh, 100, &points, &[]);
        assert!(same == points && report.iterations == 0 && report.stopped == Stopped::Converged);
        assert!(report.smallest_distance == f64::INFINITY && report.rho == f64::INFINITY);
    }
    let (positions, triangles) = cube();
    let none = Mesh::new(positions, triangles).unwrap().with_mask(vec![false; 12]).unwrap();
    assert_eq!(relaxed(&none, 100, &[], &[]).0, [[0.0f32; 3]; 0]);
    let pair = relaxed(&mesh, 100, &[[0.5; 3], [0.6, 0.5, 0.5]], &[]).1;
    assert!(pair.smallest_distance > 0.9, "{pair:?}");
    let all_fixed = relaxed(&mesh, 100, &[[0.5; 3], [0.6, 0.5, 0.5]], &[true, true]).0;
    assert_eq!(all_fixed, [[0.5; 3], [0.6, 0.5, 0.5]]);
}

#[test]
fn bad_arguments_are_refused_by_name() {
    let (closed, unit) = (mesh(cube()), [0.5; 3]);
    let options = InsideOptions::default();
    for (mesh, options, points, said) in [
        (&closed, options, vec![unit, [0.5, 0.5, 1.5]], "positions: point 1 is (0.5, 0.5, 1.5), outside the mesh"),
        (&closed, options, vec![unit, unit, [f32::NAN, 0.5, 0.5]], "positions: point 2 is [NaN, 0.5, 0.5], not finite"),
        (&closed, options, vec![[0.5, f32::INFINITY, 0.5]], "positions: point 0 is [0.5, inf, 0.5], not finite"),
        (&closed, options.fixed(&[true]), vec![unit, unit], "fixed: has 1 entries for 2 points"),
        (&closed, options.fixed(&[true; 3]), vec![unit, unit], "fixed: has 3 entries for 2 points"),
        (
            &closed,
            options.fixed(&[false, true]),
            vec![unit, [0.5, 0.5, 1.1]],
            "positions: point 1 is (0.5, 0.5, 1.1), fixed and outside of the box around the mesh",
        ),
        (&closed, options.sliding(&[true]), vec![unit, unit], "sliding: has 1 entries for 2 points"),
        (&closed, options.fixed(&[true; 2]).sliding(&[false, true]), vec![unit, unit], "sliding: point 1 is fixed"),
        (
            &closed,
            options.sliding(&[true; 2]),
            vec![[0.5, 1.0, 0.5], [0.5, 0.9, 0.5]],
            "positions: point 1 is (0.5, 0.9, 0.5), sliding and off the surface of the mesh",
        ),
        (&closed, options.tolerance(-1.0), vec![unit], "tolerance: -1 is not at least 0"),
        (&closed, options.tolerance(f64::NAN), vec![unit], "tolerance: NaN is not at least 0"),
    ] {
        let called = |_| panic!("the work began");
        let error = relax_inside(&Context::new(1).unwrap(), mesh, &options, &points, Some(&called)).unwrap_err();
        assert_eq!(error.to_string(), said);
    }
}

#[test]
fn a_cancelled_call_returns_the_last_whole_step() {
    let mesh = mesh(meshes::welded(meshes::torus()));
    let (points, fixed) = maximal(&mesh, 0.1, Surface::First);
    let options = InsideOptions::default().max_iterations(50).tolerance(0.0).fixed(&fixed);
    let context = Context::new(1).unwrap();
    let stop = |share: f64| if share > 0.5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    let (after, report) = relax_inside(&context, &mesh, &options, &points, Some(&stop as &Progress)).unwrap();
    assert_eq!(report.stopped, Stopped::Cancelled);
    assert!((20..30).contains(&report.iterations), "{report:?}");
    check_inside("torus", &mesh, &after, &fixed);
    let shares = std::sync::Mutex::new(Vec::new());
    let note = |share: f64| {
        shares.lock().unwrap().push(share);
        ControlFlow::Continue(())
    };
    relax_inside(&context, &mesh, &options, &points, Some(&note as &Progress)).unwrap();
    let shares = shares.into_inner().unwrap();
    assert!(shares.len() > 50 && shares.is_sorted() && shares.last() == Some(&1.0), "{shares:?}");
}
