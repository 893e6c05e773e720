//! DCR: time per step on one thread; divide by the number of points for the time per point and step.

use std::hint::black_box;
use std::time::Duration;

use azulejo::dcr::{Neighbourhood, Options, relax};
use azulejo::{Boundary, Context, Domain};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

/// Steps per measured call.
const STEPS: u32 = 4;

/// A jittered grid, relaxed a little: what sets look like during most steps.
fn start(side: usize, options: &Options) -> Vec<[f32; 2]> {
    // The fractions of multiples of the golden ratio and of the root of 2 scatter well enough.
    let jitter = |k: usize, ratio: f64| 0.9 * (k as f64 * ratio).fract();
    let at = |k: usize| {
        let (x, y) = (k % side, k / side);
        [(x as f64 + jitter(k, 0.618_033_988_749_895)) as f32, (y as f64 + jitter(k, 0.414_213_562_373_095)) as f32]
    };
    let grid: Vec<_> = (0..side * side).map(|k| at(k).map(|x| x / side as f32)).collect();
    relax(&Context::new(0).unwrap(), &Options { max_iterations: 10, ..*options }, &grid, None).unwrap().0
}

fn steps(criterion: &mut Criterion) {
    let context = Context::new(1).unwrap();
    let mut group = criterion.benchmark_group("dcr");
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
    for (name, neighbourhood) in [("delaunay", Neighbourhood::Delaunay), ("nearest", Neighbourhood::Nearest)] {
        for side in [64, 256] {
            let domain = Domain { min: [0.0; 2], max: [1.0; 2], boundary: Boundary::Periodic };
            let options = Options { max_iterations: STEPS, tolerance: 0.0, ..Options::new(domain, neighbourhood) };
            let points = start(side, &options);
            group.throughput(Throughput::Elements(u64::from(STEPS) * points.len() as u64));
            group.bench_function(BenchmarkId::new(name, points.len()), |bencher| {
                bencher.iter(|| relax(&context, &options, black_box(&points), None).unwrap());
            });
        }
    }
    group.finish();
}

criterion_group!(benches, steps);
criterion_main!(benches);
