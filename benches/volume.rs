//! Sets of cuboids, and of the inside of meshes: microseconds per sample at 10^5 and 10^6 samples, periodic and bounded, on one thread and on two.

use std::hint::black_box;
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::volume::adaptive::{self, Radius};
use azulejo::volume::{InsideOptions, Options, Surface, sample, sample_inside};
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
    let radius = f64::cbrt(MAXIMAL_DENSITY_IN_SPACE / 1e6);
    // The pattern is that of the first call.
    for leaf_size in [20.0, 40.0] {
        let (context, options) = (Context::new(1).unwrap(), Options::new(radius).leaf_size(leaf_size));
        let samples = sample(&context, &options, None).unwrap().0.len();
        group.throughput(Throughput::Elements(samples as u64));
        group.bench_function(format!("1e6 periodic, leaves of {leaf_size} radii"), |bencher| {
            bencher.iter(|| sample(&context, black_box(&options), None).unwrap());
        });
    }
    group.finish();
}

/// A mesh with its holes closed by fans around one vertex of each: an edge without a neighbour gets one.
fn closed(mesh: &Mesh) -> Mesh {
    let mut sides = std::collections::BTreeMap::<[u32; 2], u32>::new();
    for &[a, b, c] in mesh.triangles() {
        [[a, b], [b, c], [c, a]].into_iter().for_each(|side| *sides.entry(side).or_default() += 1);
    }
    let missing = |&[from, to]: &[u32; 2]| !sides.contains_key(&[to, from]);
    let next: std::collections::BTreeMap<u32, u32> =
        sides.keys().filter(|side| missing(side)).map(|&[from, to]| (to, from)).collect();
    let (mut left, mut triangles) = (next.clone(), mesh.triangles().to_vec());
    while let Some((first, mut at)) = left.pop_first() {
        while at != first {
            let Some(to) = left.remove(&at) else { break };
            if to != first {
                triangles.push([first, at, to]);
            }
            at = to;
        }
    }
    Mesh::new(mesh.positions().to_vec(), triangles).unwrap()
}

/// The bunny with 10^6 samples, and the dragon with 10^5, their holes closed: set AZULEJO_BENCH_BUNNY and AZULEJO_BENCH_DRAGON
/// to their files.
fn insides(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("volume inside");
    group.sample_size(10);
    let context = Context::new(1).unwrap();
    for (variable, count) in [("AZULEJO_BENCH_BUNNY", 1e6), ("AZULEJO_BENCH_DRAGON", 1e5)] {
        let Ok(path) = std::env::var(variable) else { continue };
        let mesh = Arc::new(closed(&Mesh::load(path).unwrap()));
        let radius = sample_inside(&context, &mesh, &InsideOptions::by_count(10_000), None).unwrap().1.radius;
        let radius = radius * f64::cbrt(1e4 / count);
        for surface in [Surface::Open, Surface::First] {
            let options = InsideOptions::new(radius).surface(surface);
            let samples = sample_inside(&context, &mesh, &options, None).unwrap().0.len();
            group.throughput(Throughput::Elements(samples as u64));
            group.bench_function(format!("{variable} {surface:?}"), |bencher| {
                bencher.iter(|| sample_inside(&context, &mesh, black_box(&options), None).unwrap());
            });
        }
    }
    group.finish();
}

/// Ramps of the radius along x by these factors, with about 10^6 samples on one thread.
fn ramps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("volume adaptive");
    group.sample_size(10);
    let context = Context::new(1).unwrap();
    for ratio in [1.0, 4.0, 16.0] {
        // The mean of 1 / radius^3 where the least radius is 1.
        let mean = 0.5 * (1.0 + 1.0 / ratio) / ratio;
        let least = f64::cbrt(MAXIMAL_DENSITY_IN_SPACE * mean / 1e6);
        let slope = (ratio - 1.0) * least;
        let at = move |[x, _, _]: [f64; 3]| least + slope * x;
        let options =
            adaptive::Options::new(Radius::Function { at: &at, smallest: least, largest: ratio * least, slope });
        let samples = adaptive::sample(&context, &options, None).unwrap().0.len();
        group.throughput(Throughput::Elements(samples as u64));
        group.bench_function(format!("1e6 periodic, ramp 1:{ratio}"), |bencher| {
            bencher.iter(|| adaptive::sample(&context, black_box(&options), None).unwrap());
        });
    }
    group.finish();
}

criterion_group!(benches, cuboids, ramps, insides);
criterion_main!(benches);
