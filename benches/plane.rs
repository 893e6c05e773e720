//! The samplers of the plane side by side, in samples per second.

use azulejo::{Boundary, Context, Domain, kdrt, maximal};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

fn plane(criterion: &mut Criterion) {
    let domain = Domain::unit(Boundary::Periodic);
    for count in [100_000, 1_000_000] {
        let radius = (0.69656 / f64::from(count)).sqrt();
        let mut group = criterion.benchmark_group(format!("plane/{count}"));
        group.throughput(Throughput::Elements(count as u64)).sample_size(10);
        let context = Context::new(1).expect("one thread");
        let options = maximal::Options { radius, domain, seed: 1 };
        group.bench_function("maximal", |bencher| bencher.iter(|| maximal::sample(&context, &options, None)));
        for leaf_size in [6.0, 20.0, 40.0] {
            for threads in [1, 4] {
                let context = Context::new(threads).expect("a few threads");
                let options = kdrt::Options { radius, domain, leaf_size, seed: 1 };
                let id = BenchmarkId::new(format!("kdrt/{leaf_size}r"), format!("{threads} threads"));
                group.bench_function(id, |bencher| bencher.iter(|| kdrt::sample(&context, &options, None)));
            }
        }
        group.finish();
    }
}

criterion_group!(benches, plane);
criterion_main!(benches);
