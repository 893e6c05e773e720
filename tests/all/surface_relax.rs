//! Relaxation on surfaces: what it promises, on smooth, open, thin and broken meshes.

use std::cell::Cell;
use std::ops::ControlFlow;
use std::sync::Arc;

use azulejo::dcr::Stopped;
use azulejo::dcr::surface::{Options, Report, relax, triangulate};
use azulejo::mesh::Mesh;
use azulejo::{Context, Error, Points, psp};

use crate::common::meshes::{self, Soup};
use crate::common::surface_oracle as oracle;
use crate::common::triangle::distance;

fn mesh((positions, triangles): Soup) -> Arc<Mesh> {
    Arc::new(Mesh::new(positions, triangles).unwrap())
}

/// A maximal set of about `count` samples.
fn darts(mesh: &Arc<Mesh>, count: f64) -> Points<3> {
    let radius = (0.7 * mesh.area() / count).sqrt();
    psp::sample(&Context::new(1).unwrap(), mesh, &psp::Options::new(radius), None).unwrap().0
}

fn run(mesh: &Mesh, samples: &Points<3>) -> (Points<3>, Report) {
    run_steps(mesh, samples, Options::default().max_iterations)
}

fn run_steps(mesh: &Mesh, samples: &Points<3>, steps: u32) -> (Points<3>, Report) {
    let context = Context::new(2).unwrap();
    let options = Options::default().max_iterations(steps);
    let (relaxed, report) = relax(&context, mesh, &samples.triangles, &samples.barycentrics, &options, None).unwrap();
    assert_eq!(relaxed.len(), samples.len());
    assert_eq!(oracle::misplaced(mesh, &relaxed), None);
    let smallest = smallest_distance(&relaxed);
    assert!(smallest >= smallest_distance(samples), "{smallest}, not {} any more", smallest_distance(samples));
    assert!((report.smallest_distance - smallest).abs() < 1e-12 * smallest);
    assert!((report.rho - smallest / d_max(mesh, samples.len())).abs() < 1e-9);
    (relaxed, report)
}

fn d_max(mesh: &Mesh, count: usize) -> f64 {
    (2.0 * mesh.area() / (3f64.sqrt() * count as f64)).sqrt()
}

fn smallest_distance(samples: &Points<3>) -> f64 {
    let of = |i: usize| samples.positions[..i].iter().map(move |&other| distance(samples.positions[i], other));
    (0..samples.len()).flat_map(of).fold(f64::INFINITY, f64::min)
}

#[test]
fn closed_and_open_surfaces_end_at_the_distances_of_the_plane() {
    // Sharp edges, and boundaries, cost a little.
    for (name, soup, goal) in [
        ("sphere", meshes::sphere(), 0.85),
        ("torus", meshes::torus(), 0.85),
        ("torus of many triangles", meshes::fine_torus(300, 150), 0.85),
        ("square", meshes::plane(), 0.83),
        ("cube", cube(), 0.85),
    ] {
        let mesh = mesh(soup);
        let samples = darts(&mesh, 3000.0);
        let before = smallest_distance(&samples) / d_max(&mesh, samples.len());
        let (_, report) = run(&mesh, &samples);
        assert!(before < 0.79 && report.rho > goal, "{name}: {before} to {report:?}");
    }
}

/// The unit cube.
fn cube() -> Soup {
    let positions = (0..8).map(|i| [i & 1, (i >> 1) & 1, i >> 2].map(|x| x as f32)).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    (positions, quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect())
}

/// There is a row of samples along the boundary, no denser than elsewhere.
#[test]
fn samples_neither_leave_an_open_square_nor_crowd_at_its_boundary() {
    let mesh = mesh(meshes::plane());
    let samples = darts(&mesh, 4000.0);
    let (relaxed, _) = run(&mesh, &samples);
    assert!(
        relaxed.positions.iter().all(|&[x, y, z]| (0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y) && z == 0.0)
    );
    let margin = |samples: &Points<3>| {
        let at_boundary = |&&[x, y, _]: &&[f32; 3]| x.min(y).min(1.0 - x).min(1.0 - y) < 0.1;
        samples.positions.iter().filter(at_boundary).count() as f64 / samples.len() as f64
    };
    assert!((margin(&relaxed) / 0.36 - 1.0).abs() < 0.04, "{}", margin(&relaxed));
    let boundary = relaxed.positions.iter().map(|&[x, y, _]| f64::from(x.min(y).min(1.0 - x).min(1.0 - y)));
    assert!(boundary.fold(1.0, f64::min) > 0.2 * d_max(&mesh, samples.len()));
}

#[test]
fn the_two_sides_of_a_thin_wall_do_not_know_of_each_other() {
    let single = mesh(meshes::plane());
    let samples = darts(&single, 700.0);
    let double = mesh(meshes::sheets(1e-3));
    let twice = Points {
        triangles: samples
            .triangles
            .iter()
            .copied()
            .chain(samples.triangles.iter().map(|triangle| triangle + 2))
            .collect(),
        barycentrics: [&samples.barycentrics[..], &samples.barycentrics].concat(),
        positions: [0.0, 1e-3]
            .iter()
            .flat_map(|&z| samples.positions.iter().map(move |&[x, y, _]| [x, y, z]))
            .collect(),
        ..Default::default()
    };
    let (alone, report) = run(&single, &samples);
    let (both, joint) = run(&double, &twice);
    assert!(report.rho > 0.8 && joint.smallest_distance <= 1.001e-3, "{joint:?}");
    let (low, high) = both.positions.split_at(samples.len());
    for side in [low, high] {
        let side = Points { positions: side.to_vec(), ..alone.clone() };
        assert!(smallest_distance(&side) > 0.8 * d_max(&single, samples.len()));
    }
}

/// A blade of this thickness: a wedge that is closed but for its back.
fn fin(thickness: f32) -> Soup {
    let (z, y) = (0.5 * thickness, 0.6);
    let positions = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, y, z], [1.0, y, z], [0.0, y, -z], [1.0, y, -z]];
    (positions, vec![[0, 1, 3], [0, 3, 2], [1, 0, 4], [1, 4, 5], [0, 2, 4], [1, 5, 3]])
}

/// A cone of height 1 on a base of this radius, which is open.
fn cone(radius: f32) -> Soup {
    let around = 24;
    let at = |i: u32| (i as f32 / around as f32 * std::f32::consts::TAU).sin_cos();
    let base = (0..around).map(|i| [radius * at(i).1, radius * at(i).0, 0.0]);
    let positions = base.chain([[0.0, 0.0, 1.0]]).collect();
    (positions, (0..around).map(|i| [i, (i + 1) % around, around]).collect())
}

/// Thirty needles in one place, a tenth to a thousandth as wide as they are long.
fn urchin() -> Soup {
    let needle = |i: u32| {
        let (s, c) = (i as f32 * 2.4).sin_cos();
        let (z, width) = (i as f32 / 15.0 - 1.0, 0.1 / (1.0 + i as f32).powi(2).min(100.0));
        let across = [-s * width, c * width, 0.0];
        let root = [0.02 * c, 0.02 * s, 0.02 * z];
        (vec![root, [c, s, z], std::array::from_fn(|axis| root[axis] + across[axis])], vec![[0, 1, 2]])
    };
    meshes::join((0..30).map(needle))
}

/// Meshes on which forces along the surface lead samples together through space; and what rho they reach at least, on each
/// less than the least of six seeds by as much as these differ.
fn sharp() -> [(&'static str, Soup, f64); 6] {
    [
        ("blade", fin(0.03), 0.74),
        ("thick blade", fin(0.15), 0.823),
        ("cone", cone(0.08), 0.832),
        ("cube", cube(), 0.85),
        ("thin wall", meshes::sheets(0.03), 0.827),
        ("crossing triangles", meshes::random_soup(5, 12), 0.831),
    ]
}

/// `run` compares the smallest distances of all pairs.
#[test]
fn no_two_samples_get_nearer_than_the_nearest_two_were() {
    let torn = [("needles", urchin()), ("slivers", meshes::slivers()), ("book", meshes::book(4))];
    for (name, soup) in sharp().map(|(name, soup, _)| (name, soup)).into_iter().chain(torn) {
        let mesh = mesh(soup);
        for count in [5.0, 60.0, 1200.0] {
            let maximal = darts(&mesh, count);
            // A set that has holes, and pairs as near as they can be for its radius.
            let every = |nth: usize| {
                let kept: Vec<usize> = (0..maximal.len()).filter(|i| i % nth != 1).collect();
                let triangles = kept.iter().map(|&i| maximal.triangles[i]).collect();
                let barycentrics = kept.iter().map(|&i| maximal.barycentrics[i]).collect();
                let positions = kept.iter().map(|&i| maximal.positions[i]).collect();
                Points { triangles, barycentrics, positions, ..Default::default() }
            };
            for (steps, samples) in [(1, &maximal), (9, &maximal), (100, &maximal), (30, &every(2)), (100, &every(3))] {
                let (relaxed, _) = run_steps(&mesh, samples, steps);
                assert!(relaxed.positions != samples.positions || samples.len() < 2, "{name}: nothing moves");
            }
        }
    }
}

#[test]
fn few_samples_that_are_far_apart_stay_so() {
    let mesh = mesh(meshes::plane());
    let strip =
        Mesh::new(mesh.positions().iter().map(|&[x, y, _]| [1e5 * x, y, 0.0]).collect(), mesh.triangles().to_vec());
    let strip = strip.unwrap();
    // The first triangle's corners, two of them far away; their distance is hundreds of spacings.
    let barycentrics = vec![[0.1, 0.1], [0.8, 0.1], [0.4, 0.3]];
    let positions = barycentrics.iter().map(|&uv| strip.point(0, uv)).collect();
    let samples = Points { triangles: vec![0; 3], barycentrics, positions, ..Default::default() };
    let (_, report) = run(&strip, &samples);
    assert!(report.rho > 50.0, "{report:?}");
}

#[test]
fn on_sharp_edges_and_thin_blades_distances_grow() {
    for (name, soup, goal) in sharp() {
        let mesh = mesh(soup);
        let samples = darts(&mesh, 2500.0);
        let before = smallest_distance(&samples) / d_max(&mesh, samples.len());
        let (_, report) = run(&mesh, &samples);
        assert!(report.rho > goal && goal > before, "{name}: {before} to {report:?}");
    }
}

#[test]
fn neither_the_indices_nor_the_winding_of_a_mesh_matter() {
    let (positions, triangles) = meshes::sphere();
    let whole = mesh((positions.clone(), triangles.clone()));
    let samples = darts(&whole, 1000.0);
    let corners = triangles.iter().flatten().map(|&vertex| positions[vertex as usize]).collect();
    let split = (0..triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let (relaxed, _) = run(&whole, &samples);
    assert_eq!(run(&mesh((corners, split)), &samples).0, relaxed);
    let turned = triangles.iter().enumerate().map(|(i, &[a, b, c])| if i % 3 == 0 { [a, c, b] } else { [a, b, c] });
    let turned = mesh((positions, turned.collect()));
    let (_, report) = run(&turned, &darts(&turned, 1000.0));
    assert!(report.rho > 0.85, "{report:?}");
}

/// Two walls of many triangles each, every third of them turned over: parts of the surface are told apart by their
/// edges, not by normals.
#[test]
fn walls_of_many_triangles_are_relaxed_each_for_itself() {
    let wall = |z: f32| {
        let (side, at) = (60, |i: u32| i as f32 / 60.0);
        let positions = (0..61 * 61).map(|i| [at(i % 61), at(i / 61), z + 0.01 * at(i % 61)]).collect();
        let quads = (0..side * side).map(move |i| i / side * 61 + i % side);
        let halves = quads.flat_map(|a| [[a, a + 1, a + 62], [a, a + 62, a + 61]]);
        let turned = |(i, [a, b, c]): (usize, [u32; 3])| if i.is_multiple_of(3) { [a, c, b] } else { [a, b, c] };
        (positions, halves.enumerate().map(turned).collect())
    };
    let single = mesh(wall(0.0));
    let samples = darts(&single, 600.0);
    let double = mesh(meshes::join([wall(0.0), wall(2e-3)]));
    let above = samples.triangles.iter().map(|triangle| triangle + single.triangles().len() as u32);
    let triangles: Vec<u32> = samples.triangles.iter().copied().chain(above).collect();
    let barycentrics = [&samples.barycentrics[..], &samples.barycentrics].concat();
    let positions = triangles.iter().zip(&barycentrics).map(|(&triangle, &uv)| double.point(triangle, uv)).collect();
    let twice = Points { triangles, barycentrics, positions, ..Default::default() };
    let (both, _) = run(&double, &twice);
    for side in both.positions.chunks(samples.len()) {
        let side = Points { positions: side.to_vec(), ..Default::default() };
        assert!(smallest_distance(&side) > 0.8 * d_max(&single, samples.len()));
    }
}

#[test]
fn random_soups_and_coincident_samples_are_held_out() {
    for soup in [meshes::random_soup(3, 40), meshes::book(5), meshes::slivers(), meshes::duplicated(meshes::torus())] {
        let mesh = mesh(soup);
        run(&mesh, &darts(&mesh, 500.0));
    }
    let mesh = mesh(meshes::plane());
    let samples = Points { triangles: vec![0; 60], barycentrics: vec![[0.25, 0.5]; 60], ..Default::default() };
    let samples = Points { positions: vec![[0.0; 3]; 60], ..samples };
    let (_, report) = run(&mesh, &samples);
    assert!(report.rho > 0.8, "{report:?}");
}

#[test]
fn the_result_does_not_depend_on_the_threads() {
    let mesh = mesh(meshes::torus());
    let samples = darts(&mesh, 1500.0);
    let relaxed = [1, 4].map(|threads| {
        let context = Context::new(threads).unwrap();
        let quiet = |_| ControlFlow::Continue(());
        relax(&context, &mesh, &samples.triangles, &samples.barycentrics, &Options::default(), Some(&quiet)).unwrap()
    });
    assert_eq!(relaxed[0], relaxed[1]);
    let triangles = [1, 4].map(|threads| {
        triangulate(&Context::new(threads).unwrap(), &mesh, &samples.triangles, &samples.barycentrics, None).unwrap()
    });
    assert_eq!(triangles[0], triangles[1]);
}

#[test]
fn a_cancelled_call_returns_its_last_whole_step() {
    let mesh = mesh(meshes::torus());
    let samples = darts(&mesh, 1500.0);
    let context = Context::new(2).unwrap();
    let call = |options: &Options, limit: f64| {
        let told = Cell::new(0.0);
        let progress = |share| {
            assert!(share >= told.replace(share));
            if share >= limit { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        relax(&context, &mesh, &samples.triangles, &samples.barycentrics, options, Some(&progress)).unwrap()
    };
    let (start, report) = call(&Options::default(), 0.0);
    assert_eq!((start, report.iterations, report.stopped), (samples.clone(), 0, Stopped::Cancelled));
    let (cancelled, report) = call(&Options::default(), 0.3);
    assert!(report.stopped == Stopped::Cancelled && (1..=31).contains(&report.iterations), "{report:?}");
    let steps = Options::default().max_iterations(report.iterations);
    assert_eq!(call(&steps, 2.0).0, cancelled);
    let none = Options::default().max_iterations(0);
    assert_eq!(call(&none, 2.0).0, samples);
}

/// Euler's formula: a closed surface of genus 0 has two triangles per sample but four.
#[test]
fn the_triangles_of_a_relaxed_sphere_are_a_sphere() {
    let mesh = mesh(meshes::sphere());
    let (samples, _) = run(&mesh, &darts(&mesh, 3000.0));
    let made = triangulate(&Context::new(2).unwrap(), &mesh, &samples.triangles, &samples.barycentrics, None).unwrap();
    assert!(made.agreement > 0.997, "{}", made.agreement);
    let all = 2 * samples.len() - 4;
    assert!(made.triangles.len() <= all && made.triangles.len() > all - all / 300, "{} of {all}", made.triangles.len());
    for corners in &made.triangles {
        let [a, b, c] = corners.map(|i| glam::Vec3::from(samples.positions[i as usize]));
        assert!((b - a).cross(c - a).dot(a + b + c) > 0.0, "a triangle faces inwards");
    }
}

#[test]
fn what_is_no_place_on_the_mesh_is_refused() {
    let mesh = Mesh::new(meshes::plane().0, vec![[0, 1, 3], [0, 3, 2], [0, 0, 1]]).unwrap();
    let context = Context::new(1).unwrap();
    let refused = |mesh: &Mesh, triangles: &[u32], barycentrics: &[[f32; 2]], tolerance: f64| {
        let options = Options::default().tolerance(tolerance);
        match relax(&context, mesh, triangles, barycentrics, &options, None) {
            Err(Error::InvalidArgument { argument, .. }) => argument,
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(refused(&mesh, &[0, 3], &[[0.2; 2]; 2], 0.0), "triangles");
    assert_eq!(refused(&mesh, &[0, 2], &[[0.2; 2]; 2], 0.0), "triangles");
    assert_eq!(refused(&mesh, &[0, 1], &[[0.2; 2]], 0.0), "barycentrics");
    for bad in [[f32::NAN, 0.2], [0.2, f32::NAN], [f32::INFINITY, 0.0], [-0.01, 0.5], [0.5, 0.51]] {
        assert_eq!(refused(&mesh, &[0, 1], &[[0.2; 2], bad], 0.0), "barycentrics");
    }
    for tolerance in [-1.0, f64::NAN] {
        assert_eq!(refused(&mesh, &[0], &[[0.2; 2]], tolerance), "tolerance");
    }
    let masked = mesh.clone().with_mask(vec![false, true, true]).unwrap();
    assert_eq!(refused(&masked, &[1, 0], &[[0.2; 2]; 2], 0.0), "triangles");
    let rounded = [[0.5, 0.500_000_06]];
    assert!(relax(&context, &mesh, &[0], &rounded, &Options::default(), None).is_ok());
    assert!(relax(&context, &mesh, &[], &[], &Options::default(), None).unwrap().0.is_empty());
}
