//! PSP on meshes: times by criterion on a torus, then a table of stages and rates in one run.
//!
//! The table takes a hall, and the bunny and the dragon (`AZULEJO_BENCH_DRAGON`, or out/dragon.ply, which the demo fetches)
//! where they are found, at 10^5, 10^6 and 10^7 samples. The last takes a minute or two; with `--test` it is left out
//! unless the environment variable `AZULEJO_BENCH_LARGE` is set.

#[path = "surface/bare.rs"]
mod bare;
#[path = "../tests/common/meshes.rs"]
#[allow(dead_code)]
mod meshes;
#[path = "surface/tracing.rs"]
mod tracing;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use azulejo::Context;
use azulejo::mesh::Mesh;
use azulejo::psp::{self, DEFAULT_ITERATIONS, Options, Stages};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// The radius at which a maximal set has about `count` samples.
fn radius(mesh: &Mesh, count: f64) -> f64 {
    (0.69656 * mesh.area() / count).sqrt()
}

fn mesh((positions, triangles): meshes::Soup) -> Arc<Mesh> {
    Arc::new(Mesh::new(positions, triangles).expect("a good mesh"))
}

fn surface(criterion: &mut Criterion) {
    let mesh = mesh(meshes::fine_torus(500, 200));
    let options = Options::new(radius(&mesh, 1e5));
    let cases = [
        ("one iteration", options.iterations(1).maximal(false)),
        ("three iterations", options.iterations(3).maximal(false)),
        ("maximal", options.iterations(DEFAULT_ITERATIONS)),
        ("maximal, filled only", options.iterations(0)),
    ];
    let contexts = [1, 0].map(|threads| Context::new(threads).expect("threads"));
    let mut group = criterion.benchmark_group("surface");
    group.sample_size(10);
    for context in &contexts {
        for (name, options) in cases {
            let sample = || psp::sample(context, &mesh, &options, None).expect("samples");
            group.throughput(Throughput::Elements(sample().1.samples));
            group.bench_function(format!("{name}, {} threads", context.num_threads()), |bencher| bencher.iter(sample));
        }
    }
    group.finish();
    print_table(&contexts);
}

/// The meshes of the table that can be had here.
fn table_meshes() -> Vec<(&'static str, Arc<Mesh>)> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let file = |variable: &str, path: &str| std::env::var_os(variable).map_or(root.join(path), PathBuf::from);
    let files = [
        ("bunny", file("AZULEJO_BENCH_BUNNY", "../shared/meshes/bunny.obj")),
        ("dragon", file("AZULEJO_BENCH_DRAGON", "out/dragon.ply")),
    ];
    let loaded = files.into_iter().filter_map(|(name, path)| Some((name, Arc::new(Mesh::load(path).ok()?))));
    std::iter::once(("hall", mesh(meshes::hall(48)))).chain(loaded).collect()
}

/// Wall times of a maximal set by one iteration, in seconds.
struct Times(Stages);

impl Times {
    /// The least of a few attempts: noise only adds.
    fn least(context: &Context, mesh: &Arc<Mesh>, radius: f64, attempts: usize) -> Self {
        let attempt = |_| Self(psp::measure(context, mesh, &Options::new(radius)).expect("a set").1);
        let attempts = (0..attempts).map(attempt);
        attempts.min_by(|a, b| a.total().total_cmp(&b.total())).expect("an attempt")
    }

    fn first(&self) -> f64 {
        let Stages { pattern, scene, project, merge, .. } = self.0;
        (pattern + scene + project + merge).as_secs_f64()
    }

    fn total(&self) -> f64 {
        self.first() + self.0.fill.as_secs_f64()
    }
}

/// Stages in ns per sample of the maximal set on all threads, rates in million samples and million rays per second.
fn print_table(contexts: &[Context; 2]) {
    let threads = contexts[1].num_threads();
    println!(
        "{:>7} {:>9} | {:>7} {:>5} {:>7} {:>5} {:>5} {:>6} | {:>5} {:>5} {:>10} {:>10} | {:>9} {:>10} {:>5}",
        "mesh",
        "samples",
        "pattern",
        "scene",
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
            let stages = all.0;
            let samples = stages.samples as f64;
            let ns = |time: Duration| time.as_secs_f64() / samples * 1e9;
            println!(
                "{name:>7} {samples:>9} | {:>7.0} {:>5.0} {:>7.0} {:>5.0} {:>5.0} {:>6.0} | {:>5.2} {:>5.2} {:>10.2} {:>10} | {:>9.1} {:>10.1} {:>5.2}",
                ns(stages.pattern),
                ns(stages.scene),
                ns(stages.project),
                ns(stages.merge),
                ns(stages.fill),
                ns(stages.output),
                stages.found as f64 / all.first() / 1e6,
                samples / all.total() / 1e6,
                stages.fill.as_secs_f64() / all.first(),
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
