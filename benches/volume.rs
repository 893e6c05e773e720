//! Sets of cuboids: microseconds per sample at 10^5 and 10^6 samples, periodic and bounded, on one thread and on two.

use std::hint::black_box;

use azulejo::volume::{Options, sample};
use azulejo::{Boundary, Context, Domain, MAXIMAL_DENSITY_IN_SPACE};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

fn cuboids(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("volume");
    group.sample_size(10);
    for (samples, count) in [("1e5", 1e5), ("1e6", 1e6)] {
        group.throughput(Throughput::Elements(count as u64));
        let radius = f64::cbrt(MAXIMAL_DENSITY_IN_SPACE / count);
        for (name, boundary) in [("periodic", Boundary::Periodic), ("bounded", Boundary::Bounded)] {
            let options = Options::new(radius).domain(Domain::unit(boundary));
            for threads in [1, 2] {
                let context = Context::new(threads).unwrap();
                group.bench_function(format!("{samples} {name}, {threads} threads"), |bencher| {
                    bencher.iter(|| sample(&context, black_box(&options), None).unwrap());
                });
            }
        }
    }
    group.finish();
}

criterion_group!(benches, cuboids);
criterion_main!(benches);
