//! Sets of meshes of exactly so many samples, and in progressive order, against a fill of a known radius: on a torus of
//! few and of many triangles per sample. One thread.

#[path = "../tests/all/common/meshes.rs"]
#[allow(dead_code)]
mod meshes;

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::{self, Options};
use azulejo::{Context, MAXIMAL_DENSITY, Order};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

fn order(criterion: &mut Criterion) {
    let (positions, triangles) = meshes::fine_torus(500, 200);
    let mesh = Arc::new(Mesh::new(positions, triangles).expect("a good mesh"));
    let context = Context::new(1).expect("a thread");
    for count in [1000, 100_000] {
        let mut group = criterion.benchmark_group(format!("{count} samples on 200,000 triangles"));
        group.sample_size(10).throughput(Throughput::Elements(count as u64));
        let radius = (MAXIMAL_DENSITY * mesh.area() / count as f64).sqrt();
        let exactly = Options::by_count(count);
        for (name, options) in [
            ("radius", Options::new(radius)),
            ("count", exactly),
            ("progressive, 2^(1/8)", exactly.order(Order::Progressive)),
            ("progressive, 2^(1/4)", exactly.order(Order::Progressive).quotient(2f64.powf(0.25))),
            ("progressive, 1.5", exactly.order(Order::Progressive).quotient(1.5)),
        ] {
            group.bench_function(name, |bencher| {
                bencher.iter(|| psp::sample(&context, &mesh, &options, None).expect("samples"))
            });
        }
        group.finish();
    }
}

criterion_group!(benches, order);
criterion_main!(benches);
