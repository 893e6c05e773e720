//! Meshes of any size, in any place and of any proportions: the same promises, to the rounding of their floats.

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::{self, Options, ProjectionOptions, Psp};
use azulejo::{Context, Error, Points};

use crate::common::meshes::{self, Soup};
use crate::common::surface_oracle as oracle;

/// Scaled along each axis, then moved.
fn placed((mut positions, triangles): Soup, scale: [f64; 3], offset: [f64; 3]) -> Arc<Mesh> {
    for position in &mut positions {
        *position = std::array::from_fn(|axis| (f64::from(position[axis]) * scale[axis] + offset[axis]) as f32);
    }
    Arc::new(Mesh::new(positions, triangles).unwrap())
}

/// The distance from a float to the next larger one.
fn spacing(x: f32) -> f64 {
    f64::from(x.abs().next_up()) - f64::from(x.abs())
}

/// The spacing of floats at the largest coordinate, as the documentation of the radius has it.
fn largest_spacing(mesh: &Mesh) -> f64 {
    let (low, high) = mesh.bounds();
    let largest = low.into_iter().chain(high).fold(0.0f32, |largest, x| largest.max(x.abs()));
    f64::from(largest) - f64::from(largest.next_down())
}

/// Every sample is a point of its triangle, rounded once.
fn check_positions(mesh: &Mesh, samples: &Points<3>) {
    for (i, position) in samples.positions.iter().enumerate() {
        let [u, v] = samples.barycentrics[i];
        assert!(u >= 0.0 && v >= 0.0 && f64::from(u) + f64::from(v) <= 1.0, "sample {i} has barycentrics {u}, {v}");
        let [a, b, c] = mesh.corners(samples.triangles[i]).map(|corner| corner.map(f64::from));
        let [u, v] = [u, v].map(f64::from);
        for axis in 0..3 {
            let exact = (1.0 - u - v) * a[axis] + u * b[axis] + v * c[axis];
            let error = (f64::from(position[axis]) - exact).abs();
            assert!(error <= 0.5 * spacing(position[axis]), "sample {i} is {error:e} away from its triangle");
        }
    }
}

/// Samples by three methods, and checks everything that the sets owe.
fn check(mesh: &Arc<Mesh>, radius: f64) {
    let context = Context::new(2).unwrap();
    let mut counts = Vec::new();
    for (iterations, maximal) in [(0, true), (2, false), (1, true)] {
        let options = ProjectionOptions::new(radius);
        let (samples, report) = psp::project(&context, mesh, &options, iterations, maximal, None).unwrap();
        assert_eq!(report.iterations, iterations);
        check_positions(mesh, &samples);
        assert_eq!(oracle::misplaced(mesh, &samples), None);
        assert_eq!(oracle::conflict(&samples, radius), None);
        if maximal {
            assert_eq!(oracle::gap(mesh, &samples, radius, psp::TOLERANCE * largest_spacing(mesh)), None);
        }
        counts.push(samples.len() as f64);
    }
    // The projectors do find the surface, wherever it is. They hit by area: where it is thinner than the radius a maximal set
    // has samples by length, several times as many.
    assert!(counts[1] > 0.04 * counts[0] && counts[1] < 1.1 * counts[2], "{counts:?}");
}

#[test]
fn any_size() {
    // Down to where floats are denormal, up to where the next power of ten is infinite.
    for scale in [1e-6, 1e6, 1e-20, 1e-30, 1e30, 1e-38, 1e38] {
        check(&placed(meshes::torus(), [scale; 3], [0.0; 3]), 0.2 * scale);
        check(&placed(meshes::random_soup(3, 6), [scale; 3], [0.0; 3]), 0.15 * scale);
    }
}

#[test]
fn powers_of_two_change_nothing_but_the_size() {
    for iterations in [0, 1] {
        let sample = |scale: f64| {
            let mesh = placed(meshes::torus(), [scale; 3], [0.0; 3]);
            let options = ProjectionOptions::new(0.1 * scale);
            psp::project(&Context::new(2).unwrap(), &mesh, &options, iterations, true, None).unwrap().0
        };
        let unit = sample(1.0);
        for exponent in [-100, -20, -1, 20, 100] {
            let samples = sample(f64::from(exponent).exp2());
            assert_eq!((&samples.triangles, &samples.normals), (&unit.triangles, &unit.normals), "2^{exponent}");
            assert_eq!(samples.barycentrics, unit.barycentrics, "2^{exponent}");
        }
    }
}

#[test]
fn any_place() {
    for scale in [1e-6, 1.0, 1e6] {
        for offset in [[1e3; 3], [-1e3, 0.0, 0.0], [0.0, 0.0, 1e4], [1e4, -1e4, 1e2]] {
            let mesh = placed(meshes::torus(), [scale; 3], offset.map(|x| scale * x));
            check(&mesh, (0.2 * scale).max(65.0 * largest_spacing(&mesh)));
        }
    }
    let far = placed(meshes::torus(), [100.0; 3], [1e6; 3]);
    check(&far, 64.5 * largest_spacing(&far));
}

/// At 10^6 floats are 1/16 apart, and a torus of size 1 has some twenty of them across.
#[test]
fn what_floats_cannot_carry_is_refused() {
    let far = placed(meshes::torus(), [1.0; 3], [1e6; 3]);
    assert_eq!(largest_spacing(&far), 0.0625);
    match Psp::new(&far, &ProjectionOptions::new(3.99)).err() {
        Some(Error::InvalidArgument { argument: "radius", reason }) => {
            assert!(reason.contains("64 times the float spacing 0.0625"), "{reason}")
        }
        other => panic!("{other:?}"),
    }
    let (samples, _) = psp::sample(&Context::new(1).unwrap(), &far, &Options::new(4.0), None).unwrap();
    check_positions(&far, &samples);
    assert_eq!(oracle::gap(&far, &samples, 4.0, psp::TOLERANCE * 0.0625), None);
}

#[test]
fn bad_radii_are_refused_before_work_starts() {
    let mesh = |soup| placed(soup, [1.0; 3], [0.0; 3]);
    let near = mesh(meshes::plane());
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let refused = Psp::new(&near, &ProjectionOptions::new(radius)).err();
        assert!(matches!(refused, Some(Error::InvalidArgument { argument: "radius", .. })), "{radius}");
    }
    // Floats cannot carry it: the plane is 1000 away from the origin, where they are 6e-5 apart.
    let far = placed(meshes::plane(), [1.0; 3], [1000.0; 3]);
    assert!(Psp::new(&far, &ProjectionOptions::new(0.004)).is_ok());
    match Psp::new(&far, &ProjectionOptions::new(0.0038)).err() {
        Some(Error::InvalidArgument { argument: "radius", reason }) => assert!(reason.contains("spacing"), "{reason}"),
        other => panic!("{other:?}"),
    }
    // 10^10 samples: a thousand large sheets.
    let large = mesh(meshes::join((0..1000).map(|_| meshes::plane())));
    match Psp::new(&large, &ProjectionOptions::new(1e-5)).err() {
        Some(Error::TooLarge { argument: "radius", reason }) => assert!(reason.contains("7.000e12"), "{reason}"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn any_proportions() {
    for scale in [[1.0, 1e-3, 1.0], [1e3, 1.0, 1e-3], [1e-4, 1e-4, 1.0], [1.0, 1e7, 1e7]] {
        for offset in [[0.0; 3], [1.0, -2.0, 3.0]] {
            let offset = std::array::from_fn(|axis| offset[axis] * scale[axis]);
            for soup in [meshes::torus(), meshes::sphere(), meshes::random_soup(5, 8)] {
                let mesh = placed(soup, scale, offset);
                let radius = (mesh.area() / 100.0).sqrt();
                check(&mesh, radius.max(65.0 * largest_spacing(&mesh)));
            }
        }
    }
}

#[test]
fn a_flat_box() {
    for flat in 0..3 {
        for height in [0.0, 7.0, -1e3] {
            let (mut positions, triangles) = meshes::plane();
            for position in &mut positions {
                position[2] = height;
                position.rotate_left(flat);
            }
            let mesh = Arc::new(Mesh::new(positions, triangles).unwrap());
            let (low, high) = mesh.bounds();
            assert_eq!((0..3).filter(|&axis| low[axis] == high[axis]).count(), 1);
            check(&mesh, 0.08);
        }
    }
}
