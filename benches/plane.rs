//! The samplers of the plane side by side in one run: times by criterion, then a table of ratios to
//! `maximal` and one of the stages.
//!
//! 10^8 samples are added when the environment variable `AZULEJO_BENCH_LARGE` is set.

use std::hint::black_box;
use std::time::{Duration, Instant};

use azulejo::{Context, kdrt, maximal};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

const LEAF_SIZES: [f64; 4] = [6.0, 20.0, 40.0, 80.0];

/// `maximal` is not run above this many samples: it takes seconds per million.
const MOST_MAXIMAL: u32 = 1_000_000;

/// The radius at which a maximal set of the unit square has about `count` samples.
fn radius(count: u32) -> f64 {
    (0.69656 / f64::from(count)).sqrt()
}

fn options(count: u32, leaf_size: f64) -> kdrt::Options {
    kdrt::Options::new(radius(count)).leaf_size(leaf_size).seed(1)
}

fn kdrt(context: &Context, count: u32, leaf_size: f64) -> usize {
    kdrt::sample(context, &options(count, leaf_size), None).expect("a good domain").len()
}

fn maximal(context: &Context, count: u32) -> usize {
    let options = maximal::Options::new(radius(count)).seed(1);
    maximal::sample(context, &options, None).expect("a good domain").len()
}

/// What a call takes per sample at least, in ns, in a few attempts: noise only adds.
fn least_time_per_sample(mut call: impl FnMut() -> usize) -> f64 {
    let attempt = |_| {
        let start = Instant::now();
        let samples = black_box(call());
        // A duration has whole nanoseconds, which are too coarse for a sample.
        start.elapsed().as_secs_f64() * 1e9 / samples as f64
    };
    (0..3).map(attempt).fold(f64::INFINITY, f64::min)
}

fn plane(criterion: &mut Criterion) {
    let contexts = [1, 0].map(|threads| Context::new(threads).expect("threads"));
    let mut counts = vec![100_000, 1_000_000, 10_000_000];
    counts.extend(std::env::var_os("AZULEJO_BENCH_LARGE").map(|_| 100_000_000));
    for &count in &counts {
        let mut group = criterion.benchmark_group(format!("plane/{count}"));
        group.throughput(Throughput::Elements(u64::from(count))).sample_size(10);
        if count <= MOST_MAXIMAL {
            group.bench_function("maximal", |bencher| bencher.iter(|| maximal(&contexts[0], count)));
        }
        for leaf_size in LEAF_SIZES {
            for context in &contexts {
                let id = BenchmarkId::new(format!("kdrt/{leaf_size}r"), format!("{} threads", context.num_threads()));
                group.bench_function(id, |bencher| bencher.iter(|| kdrt(context, count, leaf_size)));
            }
        }
        group.finish();
    }
    print_ratios(&contexts, &counts);
    print_stages(&counts);
}

fn print_ratios(contexts: &[Context; 2], counts: &[u32]) {
    let threads = contexts[1].num_threads();
    println!("{:>10} {:>8} {:>10} {:>14} {:>10}", "samples", "leaf", "ns/sample", "times maximal", "threads");
    for &count in counts {
        let reference = least_time_per_sample(|| maximal(&contexts[0], count.min(MOST_MAXIMAL)));
        println!("{:>10} {:>8} {:>10.1}", count.min(MOST_MAXIMAL), "maximal", reference);
        for leaf_size in LEAF_SIZES {
            let [one, all] = [0, 1].map(|i: usize| least_time_per_sample(|| kdrt(&contexts[i], count, leaf_size)));
            println!(
                "{count:>10} {:>8} {:>10.1} {:>14.1} {:>10}",
                format!("{leaf_size}r"),
                one,
                reference / one,
                format!("{threads}: x{:.2}", one / all),
            );
        }
    }
}

/// Where the time of one thread goes, in ns per sample, and what copying the samples takes.
fn print_stages(counts: &[u32]) {
    let stages = ["pattern", "divide", "clip", "eliminate", "fill", "output", "memcpy", "sum / memcpy"];
    print!("{:>10} {:>8}", "samples", "leaf");
    stages.iter().for_each(|stage| print!(" {stage:>12}"));
    println!();
    for (&count, leaf_size) in counts.iter().flat_map(|count| LEAF_SIZES.map(|leaf_size| (count, leaf_size))) {
        let stages = kdrt::stages::measure(&options(count, leaf_size)).expect("a good domain");
        let per_sample = |time: Duration| time.as_secs_f64() * 1e9 / stages.samples as f64;
        let kdrt::stages::Stages { pattern, divide, clip, eliminate, fill, output, .. } = stages;
        let times = [pattern, divide, clip, eliminate, fill, output].map(per_sample);
        let source = vec![[0.5f32; 2]; stages.samples as usize];
        let mut target = source.clone();
        let copy = least_time_per_sample(|| {
            target.copy_from_slice(black_box(&source));
            target.len()
        });
        print!("{count:>10} {:>8}", format!("{leaf_size}r"));
        times.iter().for_each(|time| print!(" {time:>12.2}"));
        println!(" {copy:>12.2} {:>12.0}", times.iter().sum::<f64>() / copy);
        black_box(&target);
    }
}

criterion_group!(benches, plane);
criterion_main!(benches);
