//! Samples whose radius varies, held against the definitions by plain checkers.

use std::collections::HashSet;

use azulejo::mesh::Mesh;
use azulejo::psp::Report;
use azulejo::psp::adaptive::{self, Options, Radius};
use azulejo::{Context, Error, MAXIMAL_DENSITY, Points};
use proptest::prelude::*;

use crate::common::adaptive_oracle as oracle;
use crate::common::adaptive_oracle::Field;
use crate::common::meshes::{self, Soup};

fn mesh((positions, triangles): Soup) -> Mesh {
    Mesh::new(positions, triangles).unwrap()
}

/// A radius for each vertex, by its position.
fn radii(mesh: &Mesh, radius: impl Fn([f64; 3]) -> f64) -> Vec<f32> {
    mesh.positions().iter().map(|position| radius(position.map(f64::from)) as f32).collect()
}

fn sample(mesh: &Mesh, options: &Options) -> Points<3> {
    adaptive::sample(&Context::new(2).unwrap(), mesh, options, None).unwrap().0
}

/// Samples a mesh on one thread and on three, and checks everything that the set owes.
fn check_all(mesh: &Mesh, options: &Options, field: &Field) -> Points<3> {
    let [(set, report), (again, _)] =
        [1, 3].map(|threads| adaptive::sample(&Context::new(threads).unwrap(), mesh, options, None).unwrap());
    let (samples, radii) = (&set, &set.radii);
    assert_eq!(set, again, "depends on the number of threads");
    assert_eq!(oracle::wrong_radius(mesh, field, samples, radii), None);
    assert_eq!(oracle::conflict(samples, radii, options.cosine), None);
    assert_eq!(oracle::gap(mesh, field, samples, radii, options.cosine, oracle::tolerance(mesh, field, 1.0)), None);
    let Report { samples: count, accepted, darts, conflicts, iterations, rays, .. } = report;
    assert_eq!((count, accepted, darts), (samples.len() as u64, count, accepted + conflicts));
    assert_eq!((iterations, rays), (0, 0));
    set
}

/// [`check_all`] with radii of vertices.
fn check_vertices(mesh: &Mesh, radii: &[f32]) -> Points<3> {
    check_all(mesh, &Options::new(Radius::PerVertex(radii)), &Field::PerVertex(radii))
}

#[test]
fn radii_of_vertices_that_differ_by_up_to_a_thousand() {
    for ratio in [1.0, 3.0, 30.0, 1000.0f64] {
        let sphere = mesh(meshes::sphere());
        let least = 0.1 / ratio.powf(0.45);
        let set = check_vertices(&sphere, &radii(&sphere, |[_, _, z]| least * ratio.powf(0.5 * (z + 1.0))));
        assert!(set.len() > 300, "{}", set.len());
        let plane = mesh(meshes::plane());
        check_vertices(&plane, &radii(&plane, |[x, y, _]| if x + y == 0.0 { 0.3 / ratio.sqrt() } else { 0.3 }));
    }
}

#[test]
fn radii_by_position() {
    let torus = mesh(meshes::torus());
    for slope in [0.0, 0.3, 1.0, 4.0] {
        let at = |[x, y, z]: [f64; 3]| 0.05 + slope * (0.05 * (3.0 * x + 2.0 * y - z)).sin().abs();
        let (smallest, largest) = (0.05, 0.05 + slope);
        let radius = Radius::Function { at: &at, smallest, largest, slope: 0.19 * slope };
        check_all(&torus, &Options::new(radius).seed(3), &Field::Function(&at, 0.19 * slope));
    }
}

#[test]
fn every_seed_gives_another_good_set() {
    let sphere = mesh(meshes::sphere());
    let radii = radii(&sphere, |[x, ..]| 0.2 + 0.15 * x);
    let mut before = None;
    for seed in 0..20 {
        let options = Options::new(Radius::PerVertex(&radii)).seed(seed);
        let set = check_all(&sphere, &options, &Field::PerVertex(&radii));
        assert_ne!(Some(&set), before.as_ref());
        before = Some(set);
    }
}

#[test]
fn steep_edges_and_noise() {
    let soup = mesh(meshes::random_soup(3, 8));
    let noise = |[x, y, z]: [f64; 3]| 0.05 * 20f64.powf((1e3 * (x + 2.0 * y + 3.0 * z)).fract());
    check_vertices(&soup, &radii(&soup, noise));
    let torus = mesh(meshes::torus());
    check_vertices(&torus, &radii(&torus, |[x, ..]| if x < 0.0 { 0.06 } else { 0.9 }));
    for aspect in [1e-2, 1e-6] {
        let needles = mesh(meshes::needles(aspect));
        check_vertices(&needles, &radii(&needles, |[x, y, _]| 0.003 + 0.1 * x * y));
    }
}

#[test]
fn radii_larger_than_the_mesh_give_one_sample() {
    let torus = mesh(meshes::torus());
    for large in [20.0, 1e30f32] {
        let radii = radii(&torus, |[x, ..]| f64::from(large) * (2.0 + x));
        let set = sample(&torus, &Options::new(Radius::PerVertex(&radii)));
        assert_eq!(set.len(), 1);
        assert!(set.radii[0] <= f64::from(large) * 4.0);
    }
    // Large radii among small ones, cut at four diagonals.
    let (low, high) = torus.bounds();
    let diagonal = (0..3).map(|axis| f64::from(high[axis] - low[axis]).powi(2)).sum::<f64>().sqrt();
    let [large, cut] = [1e38, 3.999 * diagonal].map(|large| radii(&torus, |[x, ..]| if x > 1.2 { large } else { 0.2 }));
    let mut most = [0; 2];
    for seed in 0..20 {
        let options = |radii| Options::new(Radius::PerVertex(radii)).seed(seed);
        let set = check_all(&torus, &options(&cut), &Field::PerVertex(&cut));
        most[0] = most[0].max(set.len());
        let set = sample(&torus, &options(&large));
        assert_eq!(oracle::conflict(&set, &set.radii, -1.0), None);
        assert!(set.radii.iter().all(|&radius| radius <= 4.001 * diagonal));
        most[1] = most[1].max(set.len());
    }
    // Mostly the first sample is so large that it stands alone.
    assert!(most.into_iter().all(|samples| samples > 100), "{most:?}");
}

#[test]
fn any_size_and_any_distance_from_the_origin() {
    for (scale, offset) in [(1e-6, 0.0), (1e6, 0.0), (1.0, 1000.0), (1e-30, 0.0), (1e30, 3e31)] {
        let torus = mesh(meshes::placed(meshes::torus(), scale, offset));
        check_vertices(&torus, &radii(&torus, |[x, ..]| 0.25 * scale + 0.1 * (x - offset)));
    }
}

/// The sides of a wall that is thinner than the radius. The triangles change sides all the time.
fn wall() -> Mesh {
    let (mut positions, triangles) = strips(16);
    let count = positions.len() as u32;
    positions.iter_mut().for_each(|position| position[0] /= 4.0);
    positions.extend_from_within(..);
    positions[count as usize..].iter_mut().for_each(|position| position[2] = 0.02);
    let both = |[a, b, c]: [u32; 3]| [[a, b, c], [a, c, b].map(|vertex| count + vertex)];
    mesh((positions, triangles.into_iter().flat_map(both).collect()))
}

#[test]
fn sides_of_a_thin_wall_ignore_each_other_if_wanted() {
    let wall = wall();
    let radii = radii(&wall, |[x, ..]| 0.05 + 0.05 * x);
    let with = |cosine| Options::new(Radius::PerVertex(&radii)).cosine(cosine);
    let field = Field::PerVertex(&radii);
    let [shared, apart, together] = [-1.0, 0.0, -0.999].map(|cosine| check_all(&wall, &with(cosine), &field));
    let side = |set: &Points<3>| set.triangles.iter().filter(|&&triangle| triangle % 2 == 0).count() as f64;
    let ratio = apart.len() as f64 / shared.len() as f64;
    assert!((1.8..2.1).contains(&ratio), "{ratio}");
    assert!((0.47..0.53).contains(&(side(&apart) / apart.len() as f64)));
    assert_eq!(apart.len(), together.len());
    // Normals of one side agree exactly.
    assert_eq!(check_all(&wall, &with(1.0), &field), apart);
    // A bent surface, where neighbours differ by some degrees.
    let torus = mesh(meshes::torus());
    let radii = vec![0.2; torus.positions().len()];
    let options = Options::new(Radius::PerVertex(&radii)).cosine(0.9);
    check_all(&torus, &options, &Field::PerVertex(&radii));
}

/// The square of a rounded normal can be below 1: samples of one triangle ignored each other, and there was no end of them.
#[test]
fn with_a_cosine_of_one_triangles_are_sampled_each_for_itself() {
    let torus = mesh(meshes::torus());
    let radii = vec![0.05; torus.positions().len()];
    let options = Options::new(Radius::PerVertex(&radii)).cosine(1.0);
    let set = check_all(&torus, &options, &Field::PerVertex(&radii));
    let triangles: HashSet<_> = set.triangles.iter().collect();
    assert_eq!(triangles.len(), torus.triangles().len());
}

#[test]
fn one_radius_gives_the_density_of_the_uniform_set() {
    let sphere = mesh(meshes::sphere());
    let radius = 0.02f32;
    let radii = vec![radius; sphere.positions().len()];
    let set = sample(&sphere, &Options::new(Radius::PerVertex(&radii)));
    let ratio = set.len() as f64 * f64::from(radius).powi(2) / sphere.area() / MAXIMAL_DENSITY;
    assert!((0.997..1.012).contains(&ratio), "{ratio}");
    assert!(set.radii.iter().all(|&r| (r / f64::from(radius) - 1.0).abs() < 1e-15));
}

/// The triangles at the poles are needles without width, as the corners there differ by rounding: by their area darts
/// would not hit them, and they would be cut up without end.
#[test]
fn needles_among_other_triangles_are_hit() {
    let sphere = mesh(meshes::sphere());
    let radii = vec![0.02f32; sphere.positions().len()];
    for seed in 0..20 {
        let options = Options::new(Radius::PerVertex(&radii)).seed(seed);
        let (set, report) = adaptive::sample(&Context::new(2).unwrap(), &sphere, &options, None).unwrap();
        assert!(report.darts < 10 * set.len() as u64, "{seed}: {report:?}");
    }
}

/// A rectangle 4 wide and 1 high, in as many strips.
fn strips(count: u32) -> Soup {
    let x = |column: u32| 4.0 * column as f32 / count as f32;
    let positions = (0..=count).flat_map(|column| [[x(column), 0.0, 0.0], [x(column), 1.0, 0.0]]).collect();
    let triangles = (0..count).flat_map(|i| [[2 * i, 2 * i + 2, 2 * i + 3], [2 * i, 2 * i + 3, 2 * i + 1]]).collect();
    (positions, triangles)
}

/// Thesis fig. 3.19: dots in bands of a ramp against its density, from white to black.
#[test]
fn a_ramp_of_density_is_met_in_every_band() {
    const BANDS: usize = 16;
    let plane = mesh(strips(256));
    // Samples on an area of 1 at the black end, and the share of that at the other.
    let (full, least) = (20_000.0, 0.05);
    let density = |x: f64| full * (least + (1.0 - least) * x / 4.0);
    let radii = radii(&plane, |[x, ..]| (MAXIMAL_DENSITY / density(x)).sqrt());
    // Within a radius of the boundary samples stand closer.
    let margin = 2.0 * f64::from(radii[0]);
    let mut counts = [0.0; BANDS];
    let seeds = 4;
    for seed in 0..seeds {
        let set = sample(&plane, &Options::new(Radius::PerVertex(&radii)).seed(seed));
        for [x, y, _] in set.positions.iter().map(|position| position.map(f64::from)) {
            if (margin..1.0 - margin).contains(&y) {
                counts[(x / 4.0 * BANDS as f64) as usize] += 1.0;
            }
        }
    }
    let width = 4.0 / BANDS as f64;
    for (band, count) in counts.iter().enumerate().skip(1).take(BANDS - 2) {
        let expected = f64::from(seeds as u32) * density((band as f64 + 0.5) * width) * width * (1.0 - 2.0 * margin);
        assert!((count / expected - 1.0).abs() < 0.025, "band {band}: {count} of {expected}");
    }
}

fn refused(mesh: &Mesh, options: &Options) -> (&'static str, String) {
    match adaptive::sample(&Context::new(2).unwrap(), mesh, options, None) {
        Err(Error::InvalidArgument { argument, reason } | Error::TooLarge { argument, reason }) => (argument, reason),
        other => panic!("{:?}", other.map(|(set, _)| set.radii.len())),
    }
}

#[test]
fn bad_radii_of_vertices_are_refused() {
    let plane = mesh(meshes::plane());
    let of = |radii: &[f32]| refused(&plane, &Options::new(Radius::PerVertex(radii)));
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let (argument, reason) = of(&[0.1, 0.1, bad, 0.1]);
        assert!(argument == "vertex_radii" && reason.contains("vertex 2"), "{reason}");
    }
    assert_eq!(of(&[0.1; 3]), ("vertex_count", "3 radii for 4 vertices".to_owned()));
    let (argument, reason) = of(&[0.1, 0.1, 1e-6, 0.1]);
    assert!(argument == "vertex_radii" && reason.contains("64 times the float spacing"), "{reason}");
    let many = mesh(meshes::join((0..100).map(|_| meshes::plane())));
    let (argument, reason) = refused(&many, &Options::new(Radius::PerVertex(&[1e-5; 400])));
    assert!(argument == "vertex_radii" && reason.contains("7.010e11 samples"), "{reason}");
}

#[test]
fn bad_functions_and_cosines_are_refused() {
    let plane = mesh(meshes::plane());
    type At = fn([f64; 3]) -> f64;
    let of = |at: At, smallest, largest, slope| {
        refused(&plane, &Options::new(Radius::Function { at: &at, smallest, largest, slope }))
    };
    let good: At = |_| 0.1;
    for bad in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        assert_eq!(of(good, bad, 0.1, 0.0).0, "smallest");
    }
    for bad in [0.0, 0.09, f64::NAN, f64::INFINITY] {
        assert_eq!(of(good, 0.1, bad, 0.0).0, "largest");
    }
    for bad in [-0.1, f64::NAN, f64::INFINITY] {
        assert_eq!(of(good, 0.1, 0.1, bad).0, "slope");
    }
    assert_eq!(of(|_| 1e-7, 1e-7, 0.1, 0.0).0, "smallest");
    assert_eq!(of(good, 0.1, 0.1, 1e5).0, "slope");
    // Wrong everywhere, and in a corner only.
    let bad: [At; 6] = [
        |_| f64::NAN,
        |_| -1.0,
        |_| 1.0,
        |[x, y, _]| if x + y > 1.9 { f64::NAN } else { 0.1 },
        |[x, y, _]| if x + y > 1.9 { 0.049 } else { 0.1 },
        |[x, y, _]| if x + y > 1.9 { f64::INFINITY } else { 0.1 },
    ];
    for at in bad {
        let (argument, reason) = of(at, 0.05, 0.1, 0.1);
        assert!(argument == "radius_function" && reason.contains("is not in 0.05..=0.1"), "{reason}");
    }
    // Steeper than was promised.
    let (argument, reason) = of(|[x, ..]| 0.05 + 0.05 * x, 0.05, 0.1, 0.001);
    assert!(argument == "radius_function" && reason.contains("slope"), "{reason}");
    // Too many samples.
    let many = mesh(meshes::join((0..100).map(|_| meshes::plane())));
    let radius = Radius::Function { at: &|_| 1e-5, smallest: 1e-5, largest: 1.0, slope: 0.0 };
    assert_eq!(refused(&many, &Options::new(radius)).0, "radius_function");
    for cosine in [-1.1, 1.1, f64::NAN] {
        let options = Options::new(Radius::PerVertex(&[0.1; 4])).cosine(cosine);
        assert_eq!(refused(&plane, &options).0, "cosine");
    }
}

#[test]
fn the_checkers_see_what_is_wrong() {
    let wall = wall();
    let radii = radii(&wall, |[x, ..]| 0.1 + 0.1 * x);
    let field = Field::PerVertex(&radii);
    for cosine in [-1.0, 0.0] {
        let good = sample(&wall, &Options::new(Radius::PerVertex(&radii)).cosine(cosine));
        for removed in (0..good.radii.len()).step_by(10) {
            let mut bad = good.clone();
            bad.positions.remove(removed);
            bad.normals.remove(removed);
            bad.radii.remove(removed);
            let gap = oracle::gap(&wall, &field, &bad, &bad.radii, cosine, oracle::tolerance(&wall, &field, 1.0));
            assert!(gap.is_some(), "sample {removed} is missing");
        }
        let mut bad = good.clone();
        bad.radii.iter_mut().for_each(|radius| *radius *= 1.05);
        assert!(oracle::conflict(&bad, &bad.radii, cosine).is_some());
        assert_eq!(oracle::wrong_radius(&wall, &field, &bad, &bad.radii), Some(0));
    }
    // What is good if the sides ignore each other is not if they do not.
    let apart = sample(&wall, &Options::new(Radius::PerVertex(&radii)).cosine(0.0));
    assert!(oracle::conflict(&apart, &apart.radii, -1.0).is_some());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn random_soups(seed: u64, triangles in 1u32..8, size in -2.0f64..0.5, ratio in 0.0f64..2.0, offset in 0.0f64..30.0) {
        let mesh = mesh(meshes::placed(meshes::random_soup(seed, triangles), 1.0, offset));
        let largest = (mesh.area().sqrt() * 10f64.powf(size)).max(0.02);
        let noise = |[x, y, z]: [f64; 3]| (largest * 10f64.powf(-ratio * (777.0 * (x + y + z)).fract())).max(0.02);
        let radii = radii(&mesh, noise);
        let options = Options::new(Radius::PerVertex(&radii)).seed(seed).cosine(if triangles % 2 == 0 { -1.0 } else { 0.3 });
        check_all(&mesh, &options, &Field::PerVertex(&radii));
    }
}
