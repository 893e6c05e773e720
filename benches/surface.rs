//! PSP on meshes: times by criterion on a torus, then a table of stages and rates in one run.
//!
//! The table takes a hall, and the bunny and the dragon (`AZULEJO_BENCH_DRAGON`, or out/dragon.ply, which the demo fetches)
//! where they are found, at 10^5, 10^6 and 10^7 samples. The last takes a minute or two; with `--test` it is left out
//! unless the environment variable `AZULEJO_BENCH_LARGE` is set.

#[path = "surface/bare.rs"]
mod bare;
mod common;
#[path = "../tests/all/common/meshes.rs"]
#[allow(dead_code)]
mod meshes;
#[path = "surface/tracing.rs"]
mod tracing;

use std::sync::Arc;
use std::time::Instant;

use azulejo::mesh::Mesh;
use azulejo::psp::{self, ProjectionOptions, Projectors, Psp};
use azulejo::{Context, MAXIMAL_DENSITY};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// The radius at which a maximal set has about `count` samples.
fn radius(mesh: &Mesh, count: f64) -> f64 {
    (MAXIMAL_DENSITY * mesh.area() / count).sqrt()
}

fn mesh((positions, triangles): meshes::Soup) -> Arc<Mesh> {
    Arc::new(Mesh::new(positions, triangles).expect("a good mesh"))
}

fn surface(criterion: &mut Criterion) {
    let mesh = mesh(meshes::fine_torus(500, 200));
    let options = ProjectionOptions::new(radius(&mesh, 1e5)).projectors(Projectors::Global);
    let cases = [
        ("one iteration", 1, false),
        ("three iterations", 3, false),
        ("maximal after one iteration", 1, true),
        ("maximal, filled only", 0, true),
    ];
    let contexts = [1, 0].map(|threads| Context::new(threads).expect("threads"));
    let mut group = criterion.benchmark_group("surface");
    group.sample_size(10);
    for context in &contexts {
        for (name, iterations, maximal) in cases {
            let sample = || psp::project(context, &mesh, &options, iterations, maximal, None).expect("samples");
            group.throughput(Throughput::Elements(sample().1.samples));
            group.bench_function(format!("{name}, {} threads", context.num_threads()), |bencher| bencher.iter(sample));
        }
    }
    group.finish();
    print_table(&contexts);
}

/// The meshes of the table that can be had here.
fn table_meshes() -> Vec<(&'static str, Arc<Mesh>)> {
    std::iter::once(("hall", mesh(meshes::hall(48)))).chain(common::loaded()).collect()
}

/// Wall times of the stages of a maximal set by one iteration, in seconds.
struct Times {
    prepare: f64,
    project: f64,
    merge: f64,
    fill: f64,
    /// Handing out the samples.
    output: f64,
    /// Samples that the iteration found, and those of the maximal set.
    found: u64,
    samples: u64,
}

impl Times {
    fn of(context: &Context, mesh: &Arc<Mesh>, radius: f64) -> Self {
        let mut psp =
            Psp::new(mesh, &ProjectionOptions::new(radius).projectors(Projectors::Global)).expect("a good radius");
        let first = psp.advance(context, 1, None).expect("an iteration");
        let filled = psp.fill(context, None).expect("a maximal set");
        let start = Instant::now();
        std::hint::black_box(psp.samples());
        Self {
            prepare: first.prepare_seconds,
            project: first.project_seconds,
            merge: first.merge_seconds,
            fill: filled.fill_seconds,
            output: start.elapsed().as_secs_f64(),
            found: first.accepted,
            samples: filled.samples,
        }
    }

    /// The least of a few attempts: noise only adds. Each on a new mesh, which has no scene yet.
    fn least(context: &Context, mesh: &Mesh, radius: f64, attempts: usize) -> Self {
        let new = || Mesh::new(mesh.positions().to_vec(), mesh.triangles().to_vec()).expect("a good mesh");
        let attempts = (0..attempts).map(|_| Self::of(context, &Arc::new(new()), radius));
        attempts.min_by(|a, b| a.total().total_cmp(&b.total())).expect("an attempt")
    }

    fn first(&self) -> f64 {
        self.prepare + self.project + self.merge
    }

    fn total(&self) -> f64 {
        self.first() + self.fill
    }
}

/// Stages in ns per sample of the maximal set on all threads, rates in million samples and million rays per second.
fn print_table(contexts: &[Context; 2]) {
    let threads = contexts[1].num_threads();
    println!(
        "{:>7} {:>9} | {:>7} {:>7} {:>5} {:>5} {:>6} | {:>5} {:>5} {:>10} {:>10} | {:>9} {:>10} {:>5}",
        "mesh",
        "samples",
        "prepare",
        "project",
        "merge",
        "fill",
        "output",
        "first",
        "all",
        "fill/first",
        "threads",
        "trace M/s",
        "Embree M/s",
        "ratio"
    );
    let is_test = std::env::args().any(|argument| argument == "--test");
    let large = (!is_test || std::env::var_os("AZULEJO_BENCH_LARGE").is_some()).then_some(1e7);
    for (name, mesh) in table_meshes() {
        for count in [1e5, 1e6].into_iter().chain(large) {
            let (radius, attempts) = (radius(&mesh, count), if count < 1e7 { 3 } else { 1 });
            let [one, all] = [0, 1].map(|i: usize| Times::least(&contexts[i], &mesh, radius, attempts));
            let [traced, bare] = tracing::rates(&contexts[1], &mesh, radius);
            let samples = all.samples as f64;
            let ns = |seconds: f64| seconds / samples * 1e9;
            println!(
                "{name:>7} {samples:>9} | {:>7.0} {:>7.0} {:>5.0} {:>5.0} {:>6.0} | {:>5.2} {:>5.2} {:>10.2} {:>10} | {:>9.1} {:>10.1} {:>5.2}",
                ns(all.prepare),
                ns(all.project),
                ns(all.merge),
                ns(all.fill),
                ns(all.output),
                all.found as f64 / all.first() / 1e6,
                samples / all.total() / 1e6,
                all.fill / all.first(),
                format!("{threads}: x{:.2}", one.total() / all.total()),
                traced / 1e6,
                bare / 1e6,
                traced / bare,
            );
        }
    }
}

criterion_group!(benches, surface);
criterion_main!(benches);
