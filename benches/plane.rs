//! The samplers of the plane side by side in one run: times by criterion, then a table of ratios to
//! `maximal`, one of the stages and one of windows of a kept plane.
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

fn options(count: u32, leaf_size: f64) -> kdrt::Options<'static> {
    kdrt::Options::new(radius(count)).leaf_size(leaf_size).seed(1)
}

fn kdrt(context: &Context, count: u32, leaf_size: f64) -> usize {
    kdrt::sample(context, &options(count, leaf_size), None).expect("a good domain").len()
}

fn maximal(context: &Context, count: u32) -> usize {
    let options = maximal::Options::new(radius(count)).seed(1);
    maximal::sample(context, &options, None).expect("a good domain").len()
}

/// The least time of a call per sample in ns, of a few attempts: noise only adds.
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
    print_windows(&contexts[0]);
    print_order(&contexts);
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

/// Prints the time per sample in progressive order, and that of a window of 2,000 samples of a kept plane of 10^9.
fn print_order(contexts: &[Context; 2]) {
    println!(
        "{:>10} {:>10} {:>10} {:>10} {:>10} {:>14}",
        "quotient", "samples", "ns/sample", "times any", "threads", "window, ms"
    );
    let any = least_time_per_sample(|| kdrt(&contexts[0], 1_000_000, kdrt::DEFAULT_LEAF_SIZE));
    for steps in [2.0, 4.0, 8.0] {
        let levels = kdrt::Progressive::new().quotient(2f64.powf(1.0 / steps));
        let ordered = kdrt::Options::progressive(radius(1_000_000), levels).seed(1);
        let [one, all] = contexts.each_ref().map(|context| {
            least_time_per_sample(|| kdrt::sample(context, &ordered, None).expect("a good domain").len())
        });
        let fine = radius(1_000_000_000);
        let large = kdrt::Options::progressive(fine, levels.coarsest(16.0 * fine)).seed(1);
        let plane = kdrt::Plane::new(&contexts[0], &large, None).expect("a good domain");
        let window = median_time(5, |i| {
            let min = [0.618_034, 0.414_214].map(|step| (f64::from(i) * step).fract() * 0.99);
            plane.window(min, min.map(|x| x + 0.001_414)).expect("a good window").len()
        });
        let speed = format!("x{:.2}", one / all);
        println!(
            "{:>10} {:>10} {one:>10.0} {:>10.1} {speed:>10} {:>14.1}",
            format!("2^(1/{steps})"),
            1_000_000,
            one / any,
            window * 1e3
        );
    }
}

/// Prints the times of windows of a plane of 10^9 samples on one thread, kept and not, and those per sample beside a
/// whole set.
fn print_windows(context: &Context) {
    const PLANE: u32 = 1_000_000_000;
    let whole = least_time_per_sample(|| kdrt(context, 1_000_000, kdrt::DEFAULT_LEAF_SIZE));
    println!("{:>10} {:>8} {:>14} {:>14} {:>10} {:>10}", "window", "leaf", "µs", "sample_window", "ns/sample", "whole");
    for leaf_size in LEAF_SIZES {
        let options = options(PLANE, leaf_size);
        let plane = kdrt::Plane::new(context, &options, None).expect("a good domain");
        for (count, places) in [(64.0, 1_000), (2_000.0, 400), (50_000.0, 40)] {
            let side = (count / f64::from(PLANE)).sqrt();
            let corners = |i: i32| {
                // Anywhere, by two irrational steps.
                let min = [0.618_034, 0.414_214].map(|step| (f64::from(i) * step).fract() * 0.99);
                (min, min.map(|x| x + side))
            };
            let kept = median_time(places, |i| {
                let (min, max) = corners(i);
                plane.window(min, max).expect("a good window").len()
            });
            let alone = median_time(5, |i| {
                let (min, max) = corners(i);
                kdrt::sample_window(context, &options, min, max, None).expect("a good window").len()
            });
            let leaf = format!("{leaf_size}r");
            println!(
                "{count:>10} {leaf:>8} {:>14.1} {:>14.1} {:>10.1} {whole:>10.1}",
                kept * 1e6,
                alone * 1e6,
                kept * 1e9 / count
            );
        }
    }
}

/// The median time of a call among many, in seconds.
fn median_time(calls: i32, mut call: impl FnMut(i32) -> usize) -> f64 {
    let timed = |i| {
        let start = Instant::now();
        black_box(call(i));
        start.elapsed().as_secs_f64()
    };
    let mut times: Vec<f64> = (0..calls).map(timed).collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

criterion_group!(benches, plane);
criterion_main!(benches);
