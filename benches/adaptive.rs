//! Adaptive sampling on a torus against the uniform fill at the same number of samples: by radii of vertices and by a
//! function, for several ratios of the largest to the smallest radius. One thread.

#[path = "../tests/all/common/meshes.rs"]
#[allow(dead_code)]
mod meshes;

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::{
    self,
    adaptive::{self, Radius},
};
use azulejo::{Context, MAXIMAL_DENSITY};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

const SAMPLES: f64 = 1e5;
/// Half the height of the torus.
const HEIGHT: f64 = 0.4;

/// The growth of the radius from the bottom to the top.
fn growth(ratio: f64, height: f64) -> f64 {
    ratio.powf((0.5 * (height / HEIGHT + 1.0)).clamp(0.0, 1.0))
}

/// The radius at the bottom with which a maximal set has about [`SAMPLES`].
fn least(mesh: &Mesh, ratio: f64) -> f64 {
    let samples = |triangle: u32| {
        let height = mesh.corners(triangle).iter().map(|corner| f64::from(corner[2])).sum::<f64>() / 3.0;
        MAXIMAL_DENSITY * mesh.triangle_area(triangle) / growth(ratio, height).powi(2)
    };
    ((0..mesh.triangles().len() as u32).map(samples).sum::<f64>() / SAMPLES).sqrt()
}

fn adaptive(criterion: &mut Criterion) {
    let (positions, triangles) = meshes::fine_torus(500, 200);
    let mesh = Arc::new(Mesh::new(positions, triangles).expect("a good mesh"));
    let context = Context::new(1).expect("a thread");
    let mut group = criterion.benchmark_group("adaptive");
    group.sample_size(10).throughput(Throughput::Elements(SAMPLES as u64));

    let options = psp::Options::new(least(&mesh, 1.0));
    group.bench_function("uniform fill", |bencher| {
        bencher.iter(|| psp::sample(&context, &mesh, &options, None).expect("samples"))
    });
    for ratio in [1.0, 4.0, 30.0, 100.0] {
        let least = least(&mesh, ratio);
        let at = |[_, _, z]: [f64; 3]| least * growth(ratio, z);
        let radii: Vec<_> = mesh.positions().iter().map(|p| at(p.map(f64::from)) as f32).collect();
        let sample =
            |radius| adaptive::sample(&context, &mesh, &adaptive::Options::new(radius), None).expect("samples");
        group.bench_function(format!("radii of vertices, 1 to {ratio}"), |bencher| {
            bencher.iter(|| sample(Radius::PerVertex(&radii)))
        });
        let [smallest, largest] = [least * (1.0 - 1e-9), least * ratio * (1.0 + 1e-9)];
        let slope = 1.001 * least * ratio * ratio.ln() / (2.0 * HEIGHT);
        group.bench_function(format!("function of slope {slope:.2}, 1 to {ratio}"), |bencher| {
            bencher.iter(|| sample(Radius::Function { at: &at, smallest, largest, slope }))
        });
    }
    group.finish();
}

criterion_group!(benches, adaptive);
criterion_main!(benches);
