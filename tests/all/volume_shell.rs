//! Shells of the inside of meshes against their definition: no sample is deeper than the thickness, by a search in all triangles; no
//! place of the shell is open that is farther from both of its borders than the report says.

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::volume::{InsideOptions, Surface, sample_inside};
use azulejo::{Context, Error, Given, Order};

use crate::common::meshes;
use crate::common::random::Random;
use crate::common::volume_oracle::{conflict, distance};
use crate::volume_inside::{
    check_seeds_and_threads, check_shell, closed_shapes, corners, cube, depth, made, mesh, open_place, scaled, space,
};

fn torus() -> Arc<Mesh> {
    mesh(meshes::welded(meshes::torus()))
}

fn smallest_side(mesh: &Mesh) -> f64 {
    let (low, high) = mesh.bounds();
    (0..3).map(|k| f64::from(high[k]) - f64::from(low[k])).fold(f64::INFINITY, f64::min)
}

#[test]
fn shells_are_filled() {
    for (name, soup, radius) in closed_shapes() {
        let mesh = mesh(soup);
        let mut fewer = 0;
        for (seed, share) in [(0, 0.4), (1, 1.0), (2, 1.7)] {
            let thickness = share * radius;
            for surface in [Surface::Open, Surface::First] {
                let all = InsideOptions::new(radius).seed(seed).surface(surface);
                let (points, report) = made(&mesh, &all.thickness(thickness));
                assert!(points.len() > 100, "{name}: {}", points.len());
                assert!(check_shell(&mesh, &points, &report, &[], thickness) > 50, "{name} {share}");
                assert!(report.depth < 0.44 * thickness, "{name} {share}: {}", report.depth);
                fewer += usize::from(points.len() < made(&mesh, &all).0.len());
            }
        }
        assert!(fewer >= 2, "{name}");
    }
}

/// Thinner than the voxels that the tolerance leaves open: places of the cube at half of the thickness, and at the depths that are promised.
#[test]
fn thin_shells_are_covered_in_the_middle() {
    let (mesh, radius) = (mesh(cube()), 0.2);
    for thickness in [radius / 20.0, radius / 250.0] {
        let (points, report) = made(&mesh, &InsideOptions::new(radius).thickness(thickness).tolerance(0.5));
        assert!(report.depth < 0.44 * thickness && points.len() > 60, "{} {}", report.depth, points.len());
        let deepest = |place: &[f32; 3]| depth(&corners(&mesh), place.map(f64::from)) > thickness * (1.0 + 1e-12);
        assert_eq!(points.positions.iter().find(|place| deepest(place)), None);
        assert_eq!(conflict(&space(&mesh), radius, &points.positions), None);
        for depth in [1.01 * report.depth, 0.5 * thickness, thickness - 1.01 * report.depth] {
            for (face, i, j) in (0..6).flat_map(|face| (0..60).flat_map(move |i| (0..60).map(move |j| (face, i, j)))) {
                let (along, mut place) = (|k: i32| depth + f64::from(k) / 59.0 * (1.0 - 2.0 * depth), [0.0; 3]);
                (place[(face + 1) % 3], place[(face + 2) % 3]) = (along(i), along(j));
                place[face % 3] = if face < 3 { depth } else { 1.0 - depth };
                let is_near = |sample: &[f32; 3]| distance(&space(&mesh), sample.map(f64::from), place) < radius + 1e-5;
                assert!(points.positions.iter().any(is_near), "{place:?} is open");
            }
        }
    }
}

/// The floats of the cube's samples give distances without error.
#[test]
fn the_border_belongs_to_the_shell_and_nothing_beyond() {
    let mesh = mesh(cube());
    for thickness in [0.125, 0.25, 0.3] {
        let (points, _) = made(&mesh, &InsideOptions::new(0.04).thickness(thickness));
        let depths = points
            .positions
            .iter()
            .map(|place| place.iter().map(|&x| f64::from(x).min(1.0 - f64::from(x))).fold(f64::INFINITY, f64::min));
        let deepest = depths.fold(0.0, f64::max);
        assert!(deepest <= thickness && deepest > thickness - 1e-3, "{deepest} {thickness}");
    }
}

#[test]
fn a_thickness_that_reaches_all_places_is_all_of_the_inside() {
    for (name, soup, radius) in closed_shapes() {
        let mesh = mesh(soup);
        let thickness = 0.501 * smallest_side(&mesh);
        for surface in [Surface::Open, Surface::First] {
            let options = InsideOptions::new(radius).seed(7).surface(surface);
            let (all, shell) = (made(&mesh, &options), made(&mesh, &options.thickness(thickness)));
            assert_eq!((all.0.positions, all.1.depth), (shell.0.positions, shell.1.depth), "{name}");
        }
        for options in [InsideOptions::by_count(200), InsideOptions::new(radius).order(Order::Progressive)] {
            let (all, shell) = (made(&mesh, &options).0, made(&mesh, &options.thickness(thickness)).0);
            assert_eq!((all.positions, all.ranks), (shell.positions, shell.ranks), "{name}");
        }
    }
    // Less than that, but no voxel meets the inner border: the deepest place is the centre of the ball.
    let sphere = || meshes::welded(meshes::sphere());
    let mesh = mesh(meshes::join([sphere(), scaled(sphere(), 0.7), scaled(sphere(), 0.4)]));
    let options = InsideOptions::new(0.1).seed(3);
    let (all, shell) = (made(&mesh, &options).0, made(&mesh, &options.thickness(0.6)).0);
    assert_eq!(all.positions, shell.positions);
}

#[test]
fn counts_are_exact_and_orders_progressive() {
    for (mesh, thickness) in [(torus(), 0.07), (mesh(cube()), 0.1), (mesh(cube()), 0.004)] {
        for count in [1, 2, 7, 300, 1000] {
            let options = InsideOptions::by_count(count).thickness(thickness);
            let (points, report) = made(&mesh, &options);
            assert_eq!(points.len(), count);
            check_shell(&mesh, &points, &report, &[], thickness);
            let (ordered, _) = made(&mesh, &options.order(Order::Progressive));
            let more = InsideOptions::by_count(count + 50).thickness(thickness).order(Order::Progressive);
            assert_eq!(ordered.positions, made(&mesh, &more).0.positions[..count]);
            for i in 1..count.min(300) {
                let rank = f64::from(ordered.ranks[i]);
                let place = |i: usize| ordered.positions[i].map(f64::from);
                assert!((0..i).all(|k| distance(&space(&mesh), place(k), place(i)) >= rank));
            }
        }
        let (points, report) = made(&mesh, &InsideOptions::new(0.15).thickness(thickness).order(Order::Progressive));
        check_shell(&mesh, &points, &report, &[], thickness);
    }
}

#[test]
fn given_samples_keep_their_clearances() {
    let mesh = mesh(meshes::welded(meshes::sphere()));
    let mut random = Random::new(6);
    let positions: Vec<_> = (0..40).map(|_| [0; 3].map(|_: i32| 2.4 * random.unit() - 1.2)).collect();
    let clearances: Vec<_> = (0..40).map(|i| [0.0, 0.05, 0.3][i % 3]).collect();
    let given: Vec<_> = positions.iter().copied().zip(clearances.iter().copied()).collect();
    for surface in [Surface::Open, Surface::First] {
        let with = Given::with_clearances(&positions, &clearances);
        let options = InsideOptions::new(0.15).given(with).surface(surface);
        let (points, report) = made(&mesh, &options.thickness(0.2));
        assert!(check_shell(&mesh, &points, &report, &given, 0.2) > 500);
    }
    let counted = InsideOptions::by_count(300).given(Given::with_clearances(&positions, &clearances));
    let (points, report) = made(&mesh, &counted.thickness(0.2));
    assert_eq!(points.len(), 300);
    check_shell(&mesh, &points, &report, &given, 0.2);
}

#[test]
fn seeds_and_not_threads_decide() {
    check_seeds_and_threads(&torus(), InsideOptions::new(0.03).thickness(0.08));
}

#[test]
fn bad_thicknesses_are_refused() {
    let mesh = torus();
    let refused = |options: InsideOptions| {
        let error = sample_inside(&Context::new(1).unwrap(), &mesh, &options, None).unwrap_err();
        assert!(matches!(error, Error::InvalidArgument { argument: "thickness", .. }), "{error}");
        error.to_string()
    };
    for thickness in [-0.1, f64::NAN, f64::INFINITY, -f64::INFINITY, -f64::MIN_POSITIVE] {
        refused(InsideOptions::new(0.1).thickness(thickness));
        refused(InsideOptions::by_count(10).thickness(thickness));
    }
    let said = refused(InsideOptions::new(0.256).thickness(0.00099));
    assert_eq!(said, "thickness: 0.00099 is neither 0 nor at least 1/256 of the radius, 0.001");
    assert!(!made(&mesh, &InsideOptions::new(0.256).thickness(0.001)).0.is_empty());
    // A count finds its radius: the depth says that nothing is promised of so thin a shell.
    let (points, report) = made(&mesh, &InsideOptions::by_count(3).thickness(1e-4));
    assert!(points.len() == 3 && report.depth > 0.5e-4);
}

/// The oracles find a sample that is missing, and one that is too deep.
#[test]
fn the_oracles_can_fail() {
    let mesh = mesh(cube());
    let (points, report) = made(&mesh, &InsideOptions::new(0.15).thickness(0.2));
    assert!(check_shell(&mesh, &points, &report, &[], 0.2) > 1_000);
    let middle = |place: &[f32; 3]| {
        let depth = depth(&corners(&mesh), place.map(f64::from));
        depth > 0.06 && depth < 0.14
    };
    let mut less = points.positions.clone();
    less.remove(points.positions.iter().position(middle).unwrap());
    assert!(open_place(&mesh, &less, &report, &[], 0.2).is_some());
    assert!(std::panic::catch_unwind(|| check_shell(&mesh, &points, &report, &[], 0.19)).is_err());
}
