//! DCR of a few points: whole calls from random starts, on a torus and in a bounded domain. One thread.

#[path = "../tests/all/common/random.rs"]
mod random;

use azulejo::dcr::{Neighbourhood, Options, relax};
use azulejo::{Boundary, Context, Domain};
use criterion::{Criterion, criterion_group, criterion_main};
use random::Random;

fn few(criterion: &mut Criterion) {
    let context = Context::new(1).expect("a thread");
    for (name, boundary) in [("periodic", Boundary::Periodic), ("bounded", Boundary::Bounded)] {
        let options = Options::new(Domain::unit(boundary), Neighbourhood::Delaunay);
        let mut group = criterion.benchmark_group(format!("relax a few, {name}"));
        for count in [4, 16, 64] {
            // Sets differ in the steps that they need: every call relaxes another one.
            let mut random = Random::new(1);
            let starts: Vec<Vec<[f32; 2]>> =
                (0..32).map(|_| (0..count).map(|_| [random.unit(), random.unit()]).collect()).collect();
            let mut next = starts.iter().cycle();
            group.bench_function(count.to_string(), |bencher| {
                bencher.iter(|| relax(&context, &options, next.next().expect("endless"), None).expect("relaxed"))
            });
        }
        group.finish();
    }
}

criterion_group!(benches, few);
criterion_main!(benches);
