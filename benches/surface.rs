//! PSP on meshes: times by criterion on a torus, then a table of stages and rates in one run.
//!
//! The table takes a hall, and the bunny and the dragon (`AZULEJO_BENCH_DRAGON`, or out/dragon.ply, which the demo fetches)
//! where they are found. 10^7 samples are added when the environment variable `AZULEJO_BENCH_LARGE` is set.

#[path = "../tests/common/meshes.rs"]
#[allow(dead_code)]
mod meshes;

use std::path::PathBuf;
use std::sync::Arc;

use azulejo::Context;
use azulejo::mesh::Mesh;
use azulejo::psp::{self, DEFAULT_ITERATIONS, Options, Psp};
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
        ("one iteration", Options { iterations: 1, maximal: false, ..options }),
        ("three iterations", Options { iterations: 3, maximal: false, ..options }),
        ("maximal", Options { iterations: DEFAULT_ITERATIONS, ..options }),
        ("maximal, filled only", Options { iterations: 0, ..options }),
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
    print_stages(&contexts);
}

/// The meshes of the table that can be had here.
fn table_meshes() -> Vec<(&'static str, Arc<Mesh>)> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let dragon = std::env::var_os("AZULEJO_BENCH_DRAGON").map_or(root.join("out/dragon.ply"), PathBuf::from);
    let files = [("bunny", root.join("../shared/meshes/bunny.obj")), ("dragon", dragon)];
    let loaded = files.into_iter().filter_map(|(name, path)| Some((name, Arc::new(Mesh::load(path).ok()?))));
    std::iter::once(("hall", mesh(meshes::hall(48)))).chain(loaded).collect()
}

/// Wall times in seconds on the way to a maximal set.
#[derive(Clone, Copy)]
struct Stages {
    /// Scene, pattern and the first iteration.
    first: f64,
    /// An iteration of which scene and pattern are there: on an empty set it would take as long.
    iteration: f64,
    fill: f64,
    found: f64,
    samples: f64,
}

impl Stages {
    /// Two iterations and a fill of one set; a fill after one of another.
    fn of(context: &Context, mesh: &Arc<Mesh>, radius: f64) -> Self {
        let new = || Psp::new(mesh, &Options::new(radius)).expect("a good radius");
        let mut psp = new();
        let first = psp.advance(context, 1, None).expect("an iteration");
        let iteration = psp.advance(context, 1, None).expect("an iteration").seconds;
        let mut psp = new();
        psp.advance(context, 1, None).expect("an iteration");
        let fill = psp.fill(context, None).expect("a fill");
        let [found, samples] = [first.accepted, fill.samples].map(|count| count as f64);
        Self { first: first.seconds, iteration, fill: fill.seconds, found, samples }
    }

    fn total(&self) -> f64 {
        self.first + self.fill
    }

    /// The least of a few attempts: noise only adds.
    fn least(context: &Context, mesh: &Arc<Mesh>, radius: f64) -> Self {
        let attempts = (0..3).map(|_| Self::of(context, mesh, radius));
        attempts.min_by(|a, b| a.total().total_cmp(&b.total())).expect("three attempts")
    }
}

/// Stages in ns per sample of the maximal set on all threads, and rates in million samples per second.
fn print_stages(contexts: &[Context; 2]) {
    let threads = contexts[1].num_threads();
    println!(
        "{:>8} {:>9} {:>8} {:>8} {:>6} {:>10} {:>9} {:>8}",
        "mesh", "samples", "prepare", "iterate", "fill", "first M/s", "all M/s", "threads"
    );
    let large = std::env::var_os("AZULEJO_BENCH_LARGE").map(|_| 1e7);
    for (name, mesh) in table_meshes() {
        for count in [1e5, 1e6].into_iter().chain(large) {
            let [one, all] = [0, 1].map(|i: usize| Stages::least(&contexts[i], &mesh, radius(&mesh, count)));
            let ns = |seconds: f64| seconds / all.samples * 1e9;
            println!(
                "{name:>8} {:>9} {:>8.0} {:>8.0} {:>6.0} {:>10.2} {:>9.2} {:>8}",
                all.samples,
                ns(all.first - all.iteration),
                ns(all.iteration),
                ns(all.fill),
                all.found / all.first / 1e6,
                all.samples / all.total() / 1e6,
                format!("{threads}: x{:.2}", one.total() / all.total()),
            );
        }
    }
}

criterion_group!(benches, surface);
criterion_main!(benches);
