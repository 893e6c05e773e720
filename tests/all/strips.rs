//! Strips far narrower than the radius: what is left of random sequential sampling is Rényi's parking of cars on a street,
//! of which theory knows the mean and the variance (Rényi 1958; Mackenzie 1962).

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::{self, Options};
use azulejo::{Context, Points};

use crate::common::surface_oracle as oracle;

const RADIUS: f64 = 1.0;
const LENGTH: f32 = 2000.0;

/// Rényi's constant, and the variance of the cars parked per length.
const PARKED: f64 = 0.747_597_920_253;
const VARIANCE: f64 = 0.038_156_4;

/// A strip of this width cut into so many quads along it, which reaches from `z` towards both sides of y; its normals
/// point up or down.
fn strip(width: f32, quads: u32, z: f32, is_up: bool) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let at = |i: u32| LENGTH * i as f32 / quads as f32;
    let positions = (0..=quads).flat_map(|i| [[at(i), -0.5 * width, z], [at(i), 0.5 * width, z]]).collect();
    let quad = |i: u32| [[2 * i, 2 * i + 2, 2 * i + 3], [2 * i, 2 * i + 3, 2 * i + 1]];
    let wind = |[a, b, c]: [u32; 3]| if is_up { [a, b, c] } else { [a, c, b] };
    (positions, (0..quads).flat_map(quad).map(wind).collect())
}

fn mesh((positions, triangles): (Vec<[f32; 3]>, Vec<[u32; 3]>)) -> Arc<Mesh> {
    Arc::new(Mesh::new(positions, triangles).unwrap())
}

/// Two strips so far apart, which look away from each other.
fn blade(width: f32, thickness: f32) -> Arc<Mesh> {
    let ((mut positions, mut triangles), (above, up)) = (strip(width, 3, 0.0, false), strip(width, 3, thickness, true));
    let first = positions.len() as u32;
    positions.extend(above);
    triangles.extend(up.into_iter().map(|triangle| triangle.map(|vertex| vertex + first)));
    mesh((positions, triangles))
}

fn sample(mesh: &Arc<Mesh>, seed: u64, cosine: f64) -> Points<3> {
    let options = Options::new(RADIUS).seed(seed).cosine(cosine);
    psp::sample(&Context::new(2).unwrap(), mesh, &options, None).unwrap().0
}

fn gap(mesh: &Mesh, samples: &Points<3>) -> Option<[f64; 3]> {
    let spacing = f64::from(LENGTH) - f64::from(LENGTH.next_down());
    oracle::gap(mesh, samples, RADIUS, psp::TOLERANCE * spacing)
}

/// The standard errors by which the mean count of sets is off that of cars of length 1 parked at random on a street. Cars
/// reach half a radius beyond the ends of the strip.
fn deviation(counts: &[usize]) -> f64 {
    let street = f64::from(LENGTH) / RADIUS + 1.0;
    let expected = PARKED * (street + 1.0) - 1.0;
    let mean = counts.iter().sum::<usize>() as f64 / counts.len() as f64;
    (mean - expected) / (VARIANCE * (street + 1.0) / counts.len() as f64).sqrt()
}

#[test]
fn samples_of_a_strip_are_parked_cars() {
    for (width, quads) in [(0.02, 1), (0.02, 5000), (1e-5, 1), (1e-5, 40)] {
        let mesh = mesh(strip(width, quads, 0.0, true));
        let counts: Vec<usize> = (0..40)
            .map(|seed| {
                let samples = sample(&mesh, seed, -1.0);
                assert_eq!(oracle::conflict(&samples, RADIUS), None);
                if seed == 0 {
                    assert_eq!(oracle::misplaced(&mesh, &samples), None);
                    assert_eq!(gap(&mesh, &samples), None, "{width}, {quads} quads");
                }
                samples.len()
            })
            .collect();
        assert!(deviation(&counts).abs() < 5.0, "{width}, {quads} quads: {}", deviation(&counts));
    }
}

/// The sides of a blade are one street, or with a cosine two that know nothing of each other.
#[test]
fn sides_of_a_blade_are_one_street_or_two() {
    let (width, thickness) = (0.02, 0.01);
    let blade = blade(width, thickness);
    let sides = [(0.0, false), (thickness, true)].map(|(z, is_up)| mesh(strip(width, 3, z, is_up)));
    let (mut shared, mut apart) = (Vec::new(), [Vec::new(), Vec::new()]);
    for seed in 0..20 {
        let samples = sample(&blade, seed, -1.0);
        assert_eq!(oracle::conflict(&samples, RADIUS), None);
        assert!(seed > 0 || gap(&blade, &samples).is_none());
        shared.push(samples.len());

        let samples = sample(&blade, seed, 0.0);
        for (side, (mesh, counts)) in sides.iter().zip(&mut apart).enumerate() {
            let on_side = samples.positions.iter().zip(&samples.triangles).filter(|(_, t)| (**t >= 6) == (side == 1));
            let of_side = Points { positions: on_side.map(|(p, _)| *p).collect(), ..Default::default() };
            assert_eq!(oracle::conflict(&of_side, RADIUS), None);
            assert!(seed > 0 || gap(mesh, &of_side).is_none());
            counts.push(of_side.positions.len());
        }
    }
    for counts in [&shared, &apart[0], &apart[1]] {
        assert!(deviation(counts).abs() < 5.0, "{}", deviation(counts));
    }
}

/// The checks notice a sample that is missing, one that is too near, and sets of one percent more.
#[test]
fn checks_notice_what_they_are_made_for() {
    let mesh = mesh(strip(0.02, 1, 0.0, true));
    let mut samples = sample(&mesh, 0, -1.0);
    let first = samples.positions.remove(0);
    assert!(gap(&mesh, &samples).is_some());
    samples.positions.push([first[0] + 0.9, first[1], first[2]]);
    samples.positions.push(first);
    assert!(oracle::conflict(&samples, RADIUS).is_some());

    let parked = (PARKED * (f64::from(LENGTH) + 2.0) - 1.0).round() as usize;
    assert!(deviation(&[parked; 20]).abs() < 1.0);
    assert!(deviation(&[parked + parked / 100; 20]) > 5.0);
    assert!(deviation(&[parked - parked / 100; 20]) < -5.0);
}
