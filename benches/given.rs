//! Sets around given samples, against the same set around none: half of a maximal set, which has the clearance of the
//! samples, and 10^5 obstacles with clearances from a thousandth to thirty times the radius, scattered where the set is. In
//! the plane and on a torus, one thread.

#[path = "../tests/all/common/meshes.rs"]
#[allow(dead_code)]
mod meshes;
#[path = "../tests/all/common/random.rs"]
mod random;

use std::hint::black_box;
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::{Context, Given, MAXIMAL_DENSITY, kdrt, psp};
use criterion::{Criterion, criterion_group, criterion_main};
use random::Random;

const SAMPLES: f64 = 1e6;
const OBSTACLES: usize = 100_000;

/// From a thousandth to thirty radii; most of them less than a hundredth.
fn clearances(random: &mut Random, radius: f64) -> Vec<f64> {
    (0..OBSTACLES).map(|_| radius * 0.001 * 30_000f64.powf(f64::from(random.unit()).powi(3))).collect()
}

/// Times sets around nothing, around half of a set, and around obstacles.
fn compare<const AXES: usize>(
    criterion: &mut Criterion,
    name: &str,
    half: &[[f32; AXES]],
    obstacles: Given<AXES>,
    sample: impl Fn(Given<AXES>),
) {
    let mut group = criterion.benchmark_group(name);
    group.sample_size(10);
    for (name, given) in [("none given", Given::default()), ("half given", Given::at(half)), ("obstacles", obstacles)] {
        group.bench_function(name, |bencher| bencher.iter(|| sample(given)));
    }
    group.finish();
}

fn plane(criterion: &mut Criterion) {
    let (context, radius) = (Context::new(1).expect("a thread"), (MAXIMAL_DENSITY / SAMPLES).sqrt());
    let options = kdrt::Options::new(radius);
    let whole = kdrt::sample(&context, &options, None).expect("samples").positions;
    let half: Vec<_> = whole.into_iter().step_by(2).collect();
    let mut random = Random::new(1);
    let positions: Vec<_> = (0..OBSTACLES).map(|_| [random.unit(), random.unit()]).collect();
    let clearances = clearances(&mut random, radius);
    compare(criterion, "plane", &half, Given::with_clearances(&positions, &clearances), |given| {
        black_box(kdrt::sample(&context, &options.given(given), None).expect("samples"));
    });
}

fn surface(criterion: &mut Criterion) {
    let (positions, triangles) = meshes::fine_torus(500, 200);
    let mesh = Arc::new(Mesh::new(positions, triangles).expect("a good mesh"));
    let (context, radius) = (Context::new(1).expect("a thread"), (MAXIMAL_DENSITY * mesh.area() / SAMPLES).sqrt());
    let options = psp::Options::new(radius);
    let (whole, _) = psp::sample(&context, &mesh, &options, None).expect("samples");
    let half: Vec<_> = whole.positions.iter().copied().step_by(2).collect();
    let mut random = Random::new(2);
    // Near the surface, on both sides of it.
    let near = |position: &[f32; 3]| position.map(|x| x + radius as f32 * (random.unit() - 0.5));
    let positions: Vec<_> = whole.positions.iter().step_by(whole.len() / OBSTACLES).take(OBSTACLES).map(near).collect();
    let clearances = clearances(&mut Random::new(3), radius);
    compare(criterion, "surface", &half, Given::with_clearances(&positions, &clearances), |given| {
        black_box(psp::sample(&context, &mesh, &options.given(given), None).expect("samples"));
    });
}

criterion_group!(benches, plane, surface);
criterion_main!(benches);
