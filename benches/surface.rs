//! PSP on a torus of 200,000 triangles at about 100,000 samples: one iteration, and to the end.

#[path = "../tests/common/meshes.rs"]
#[allow(dead_code)]
mod meshes;

use std::sync::Arc;

use azulejo::Context;
use azulejo::mesh::Mesh;
use azulejo::psp::{self, DEFAULT_ITERATIONS, Options};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

fn surface(criterion: &mut Criterion) {
    let (positions, triangles) = meshes::fine_torus(500, 200);
    let mesh = Arc::new(Mesh::new(positions, triangles).expect("a good mesh"));
    let radius = (0.69656 * mesh.area() / 1e5).sqrt();
    let cases = [
        ("one iteration", Options { iterations: 1, maximal: false, ..Options::new(radius) }),
        ("thesis, 3 iterations", Options { iterations: 3, maximal: false, ..Options::new(radius) }),
        ("maximal", Options { iterations: DEFAULT_ITERATIONS, ..Options::new(radius) }),
        ("maximal, filled only", Options { iterations: 0, ..Options::new(radius) }),
    ];
    let mut group = criterion.benchmark_group("surface");
    group.sample_size(10);
    for threads in [1, 0] {
        let context = Context::new(threads).expect("threads");
        for (name, options) in cases {
            let sample = || psp::sample(&context, &mesh, &options, None).expect("samples");
            group.throughput(Throughput::Elements(sample().1.samples));
            group.bench_function(format!("{name}, {} threads", context.num_threads()), |bencher| bencher.iter(sample));
        }
    }
}

criterion_group!(benches, surface);
criterion_main!(benches);
