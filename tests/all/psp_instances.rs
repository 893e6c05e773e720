//! Sets on instances, held against plain checkers on the mesh of all their triangles.

use std::ops::ControlFlow;
use std::slice;
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::{Instance, InstanceOptions, sample_instances};
use azulejo::{Context, Error, Given, Points};

use crate::common::adaptive_oracle::{self as oracle, Ball, Field};
use crate::common::meshes;
use crate::common::random::Random;
use crate::common::tolerance::tolerance;
use crate::common::triangle::{exact, is_normal};

const STANDING: Instance =
    Instance { prototype: 0, transform: [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]] };

fn prototypes() -> Vec<Arc<Mesh>> {
    let soups = [meshes::torus(), meshes::sphere(), meshes::needles(1e-4), meshes::random_soup(5, 12)];
    soups.into_iter().map(|(positions, triangles)| Arc::new(Mesh::new(positions, triangles).unwrap())).collect()
}

/// Instances in a box of this side: turned, mirrored, sheared and stretched at random.
fn scattered(random: &mut Random, count: usize, side: f32) -> Vec<Instance> {
    let mut instance = || {
        let mut entry = |column: usize| {
            let unit = random.unit();
            f64::from(if column == 3 { side * unit } else { 1.4 * unit - 0.7 })
        };
        let transform = [(); 3].map(|()| [0, 1, 2, 3].map(&mut entry));
        Instance { prototype: (4.0 * random.unit()) as u32, transform }
    };
    (0..count).map(|_| instance()).collect()
}

/// All triangles as one mesh, and the number of the first one of each instance.
fn flattened(prototypes: &[Arc<Mesh>], instances: &[Instance]) -> (Mesh, Vec<u32>) {
    let (mut positions, mut triangles, mut first) = (Vec::new(), Vec::new(), Vec::new());
    for instance in instances {
        let (mesh, vertices) = (&prototypes[instance.prototype as usize], positions.len() as u32);
        first.push(triangles.len() as u32);
        triangles.extend(mesh.triangles().iter().map(|triangle| triangle.map(|vertex| vertices + vertex)));
        let place = |row: [f64; 4], [x, y, z]: [f64; 3]| (row[0] * x + row[1] * y + row[2] * z + row[3]) as f32;
        positions
            .extend(mesh.positions().iter().map(|&vertex| instance.transform.map(|row| place(row, exact(vertex)))));
    }
    (Mesh::new(positions, triangles).unwrap(), first)
}

/// The determinant of the linear part of a transform.
fn determinant(transform: &[[f64; 4]; 3]) -> f64 {
    let [[a, b, c, _], [d, e, f, _], [g, h, i, _]] = transform;
    a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
}

/// The fault in a set that should be maximal on all instances together, if there is one.
fn fault(
    prototypes: &[Arc<Mesh>],
    instances: &[Instance],
    samples: &Points<3>,
    radius: f64,
    balls: &[Ball],
) -> Option<String> {
    let (mesh, first) = flattened(prototypes, instances);
    let sorted = samples.instances.is_sorted() && samples.instances.len() == samples.len();
    let misplaced = (0..samples.len()).find(|&i| {
        let instance = samples.instances[i] as usize;
        let triangle = first[instance] + samples.triangles[i];
        let corners = mesh.corners(triangle).map(exact);
        let mirrored = determinant(&instances[instance].transform) < 0.0;
        let normal = samples.normals[i].map(|x| if mirrored { -x } else { x });
        samples.positions[i] != mesh.point(triangle, samples.barycentrics[i]) || !is_normal(corners, normal)
    });
    let wrong = (!sorted).then(|| "instances".into()).or(misplaced.map(|index| format!("{index} is misplaced")));
    let radii = vec![radius; samples.len()];
    let conflict = || oracle::conflict(samples, &radii, -1.0).map(|pair| format!("conflict of {pair:?}"));
    let near = || oracle::too_near(samples, balls).map(|index| format!("{index} is too near to a given sample"));
    let at = |_: [f64; 3]| radius;
    let field = Field::Function(&at, 0.0);
    let gap = || oracle::gap_around(&mesh, &field, samples, &radii, -1.0, tolerance(&mesh), balls);
    wrong.or_else(conflict).or_else(near).or_else(|| gap().map(|gap| format!("gap at {gap:?}")))
}

fn sampled(threads: usize, prototypes: &[Arc<Mesh>], instances: &[Instance], options: &InstanceOptions) -> Points<3> {
    let context = Context::new(threads).unwrap();
    sample_instances(&context, prototypes, instances, options, None).unwrap().0
}

#[test]
fn sets_on_instances_are_conflict_free_and_maximal_on_all_of_them() {
    let prototypes = prototypes();
    for seed in 0..6 {
        let mut random = Random::new(seed);
        let (count, side) = [(1, 1.0), (6, 1.0), (30, 6.0), (12, 40.0), (2, 0.1), (60, 3.0)][seed as usize];
        let instances = scattered(&mut random, count, side);
        let radius = f64::from(0.06 + 0.1 * random.unit());
        let options = InstanceOptions::new(radius).seed(seed);
        let samples = sampled(1, &prototypes, &instances, &options);
        assert!(samples.len() > 20 && samples.interpolated_normals.is_empty());
        assert_eq!(fault(&prototypes, &instances, &samples, radius, &[]), None, "seed {seed}");
        for threads in [2, 3] {
            assert_eq!(sampled(threads, &prototypes, &instances, &options), samples, "seed {seed}");
        }
        assert_ne!(sampled(1, &prototypes, &instances, &options.seed(99)), samples);
    }
}

#[test]
fn given_samples_keep_their_clearances_on_all_instances() {
    let prototypes = prototypes();
    for seed in 0..3 {
        let mut random = Random::new(40 + seed);
        let instances = scattered(&mut random, 10, 2.0);
        let positions: Vec<[f32; 3]> = (0..60).map(|_| [(); 3].map(|()| 3.0 * random.unit() - 0.5)).collect();
        let clearances: Vec<f64> = (0..60).map(|_| f64::from(0.6 * random.unit())).collect();
        let own: Vec<Ball> =
            positions.iter().zip(&clearances).map(|(&at, &clearance)| (exact(at), clearance)).collect();
        let alike: Vec<Ball> = positions.iter().map(|&at| (exact(at), 0.1)).collect();
        for (given, balls) in [(Given::with_clearances(&positions, &clearances), own), (Given::at(&positions), alike)] {
            let samples = sampled(2, &prototypes, &instances, &InstanceOptions::new(0.1).given(given));
            assert_eq!(fault(&prototypes, &instances, &samples, 0.1, &balls), None, "seed {seed}");
        }
    }
}

/// Instances far from each other are sets of their own; a flat one, of which no area is left, has no samples.
#[test]
fn an_instance_depends_on_those_before_it_that_are_near() {
    let prototypes = prototypes();
    let at = |x: f64| {
        let mut instance = STANDING;
        instance.transform[0][3] = x;
        instance
    };
    let flat = Instance { prototype: 1, transform: [[0.0; 4]; 3] };
    let options = InstanceOptions::new(0.1);
    let of = |samples: &Points<3>, instance: u32| -> Vec<[f32; 3]> {
        let own = samples.positions.iter().zip(&samples.instances).filter(|&(_, &own)| own == instance);
        own.map(|(&position, _)| position).collect()
    };
    let apart = sampled(2, &prototypes, &[at(0.0), at(4.0), flat], &options);
    let alone = sampled(2, &prototypes, &[at(9.0), at(4.0)], &options);
    let near = sampled(2, &prototypes, &[at(2.0), at(4.0), at(0.0)], &options);
    assert_eq!(of(&apart, 1), of(&alone, 1));
    assert!(of(&apart, 1) != of(&near, 1) && of(&apart, 2).is_empty());
    assert!(of(&apart, 0).iter().zip(of(&apart, 1)).any(|(a, b)| (a[0] + 4.0 - b[0]).abs() > 0.01), "seeds differ");
    assert!(sampled(1, &prototypes, &[], &options).is_empty());
}

/// A small radius makes more samples than are filled in one piece, and a projected pass.
#[test]
fn large_instances_that_overlap_have_no_seam() {
    let torus = [Arc::new({
        let (positions, triangles) = meshes::fine_torus(100, 50);
        Mesh::new(positions, triangles).unwrap()
    })];
    let turned =
        Instance { prototype: 0, transform: [[0.8, 0.0, -0.6, 0.5], [0.0, 1.0, 0.0, 0.1], [0.6, 0.0, 0.8, 0.0]] };
    let instances = [STANDING, turned];
    let options = InstanceOptions::new(0.017).seed(3);
    let (samples, report) = sample_instances(&Context::new(2).unwrap(), &torus, &instances, &options, None).unwrap();
    assert!(samples.len() > 60_000 && report.samples == samples.len() as u64 && report.accepted == report.samples);
    assert!((0.76..0.8).contains(&report.rho) && report.covering_radius == Some(0.017), "{report:?}");
    assert_eq!(fault(&torus, &instances, &samples, 0.017, &[]), None);
}

#[test]
fn carried_normals_follow_the_instance() {
    let (positions, triangles) = meshes::sphere();
    let normals = positions.clone();
    let sphere = Mesh::new(positions, triangles).unwrap().with_normals(normals, None).unwrap();
    let plain = prototypes().remove(0);
    let stretched =
        Instance { prototype: 0, transform: [[-2.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]] };
    let instances = [stretched, Instance { prototype: 1, ..STANDING }];
    let samples = sampled(1, &[Arc::new(sphere), plain], &instances, &InstanceOptions::new(0.2));
    assert_eq!(samples.interpolated_normals.len(), samples.len());
    for i in 0..samples.len() {
        let ([x, y, z], normal) = (samples.positions[i], samples.interpolated_normals[i]);
        if samples.instances[i] == 1 {
            assert_eq!(normal, samples.normals[i]);
            continue;
        }
        // Outwards of the ellipsoid (x / 2)^2 + y^2 + z^2 = 1.
        let gradient = [x / 4.0, y, z];
        let length = gradient.iter().map(|x| x * x).sum::<f32>().sqrt();
        let cosine = |normal: [f32; 3]| (0..3).map(|axis| gradient[axis] / length * normal[axis]).sum::<f32>();
        assert!(cosine(normal) > 0.999 && cosine(samples.normals[i]) > 0.9, "{normal:?} at {x} {y} {z}");
    }
}

#[test]
fn what_is_out_of_range_is_refused() {
    let (context, prototypes) = (Context::new(1).unwrap(), prototypes());
    let said = |instances: &[Instance], options: &InstanceOptions| {
        sample_instances(&context, &prototypes, instances, options, None).unwrap_err().to_string()
    };
    let (plain, changed) = (InstanceOptions::new(0.1), |row: usize, column: usize, value: f64| {
        let mut instance = STANDING;
        instance.transform[row][column] = value;
        instance
    });
    let unknown = Instance { prototype: 4, ..STANDING };
    assert_eq!(said(&[STANDING, unknown], &plain), "instances: [1]: prototype is 4, and there are 4");
    assert_eq!(said(&[changed(1, 2, f64::NAN)], &plain), "instances: [0]: transform[6] is NaN, not finite");
    let range = "instances: [0]: the transform takes the mesh out of the range of floats";
    assert_eq!(said(&[changed(0, 0, 1e300)], &plain), range);
    assert_eq!(said(&[changed(0, 3, -1e39)], &plain), range);
    assert_eq!(
        said(slice::from_ref(&STANDING), &InstanceOptions::new(f64::NAN)),
        "radius: NaN is not a positive finite number"
    );
    assert!(said(&[changed(2, 3, 1e6)], &plain).starts_with("radius: 0.1 is below 4.0, 64 times the float spacing"));
    assert!(said(&[STANDING; 3], &InstanceOptions::new(1e-6)).starts_with("radius: 1e-6"));
    assert!(said(&[STANDING; 3], &InstanceOptions::new(2e-5)).contains("samples"));
    assert!(said(&[STANDING], &plain.cosine(2.0)).starts_with("cosine: "));
    let given = Given::at(&[[f32::NAN; 3]]);
    assert!(said(&[STANDING], &plain.given(given)).starts_with("given_positions: "));
}

#[test]
fn a_cancelled_call_returns_nothing() {
    for threads in [1, 2] {
        let context = Context::new(threads).unwrap();
        let instances = scattered(&mut Random::new(1), 40, 3.0);
        let stop = |share: f64| if share > 0.5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        let result = sample_instances(&context, &prototypes(), &instances, &InstanceOptions::new(0.05), Some(&stop));
        assert!(matches!(result, Err(Error::Cancelled)), "{threads} threads");
    }
}
