//! The two engines of PSP: one iteration by criterion on a torus, then a table of both in one run.
//!
//! The number of hits for each triangle decides: the rays of Embree cost the same whatever they hit, while the
//! rasteriser looks at each triangle, hit or not. The table takes tori from coarse to fine, a hall, and the bunny and the
//! dragon (`AZULEJO_BENCH_DRAGON`, or out/dragon.ply, which the demo fetches) where they are found.

#[path = "../tests/all/common/meshes.rs"]
#[allow(dead_code)]
mod meshes;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::{Engine, ProjectionOptions, Projectors, Psp, Report};
use azulejo::{Context, MAXIMAL_DENSITY};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

const ENGINES: [Engine; 2] = [Engine::Embree, Engine::Rasteriser];

fn mesh((positions, triangles): meshes::Soup) -> Arc<Mesh> {
    Arc::new(Mesh::new(positions, triangles).expect("a good mesh"))
}

/// ProjectionOptions for a set that has about `count` samples once it is maximal.
fn options(mesh: &Mesh, count: f64, engine: Engine) -> ProjectionOptions<'static> {
    ProjectionOptions::new((MAXIMAL_DENSITY * mesh.area() / count).sqrt()).projectors(Projectors::Global).engine(engine)
}

fn iterate(context: &Context, mesh: &Arc<Mesh>, options: &ProjectionOptions) -> Report {
    Psp::new(mesh, options).expect("a good radius").advance(context, 1, None).expect("an iteration")
}

fn engines(criterion: &mut Criterion) {
    let mesh = mesh(meshes::fine_torus(500, 200));
    let context = Context::new(1).expect("threads");
    let mut group = criterion.benchmark_group("engines");
    group.sample_size(10);
    for engine in ENGINES {
        let options = options(&mesh, 1e5, engine);
        let iterate = || iterate(&context, &mesh, &options);
        group.throughput(Throughput::Elements(iterate().hits));
        group.bench_function(format!("one iteration, {engine:?}"), |bencher| bencher.iter(iterate));
    }
    group.finish();
    print_engines(&context);
}

/// The meshes of the table that can be had here.
fn table_meshes() -> Vec<(String, Arc<Mesh>)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let dragon = std::env::var_os("AZULEJO_BENCH_DRAGON").map_or(root.join("out/dragon.ply"), PathBuf::from);
    let files = [("bunny", root.join("../shared/meshes/bunny.obj")), ("dragon", dragon)];
    let loaded = files.into_iter().filter_map(|(name, path)| Some((name.into(), Arc::new(Mesh::load(path).ok()?))));
    let tori = [20, 100, 400, 1200].map(|n| (format!("torus {n}"), mesh(meshes::fine_torus(n, n / 2))));
    tori.into_iter().chain([("hall".into(), mesh(meshes::hall(48)))]).chain(loaded).collect()
}

/// Nanoseconds per hit on one thread: the least of a few attempts, in turns; noise only adds.
fn print_engines(context: &Context) {
    println!("ns per hit, Embree / rasteriser; x: how many times as fast the rasteriser is");
    println!(
        "{:>10} {:>9} {:>9} {:>9} {:>15} {:>15} {:>7} {:>9}",
        "mesh", "triangles", "samples", "hits/tri", "prepare", "project", "project", "with prep"
    );
    for (name, mesh) in table_meshes() {
        for count in [1e4, 1e5, 1e6] {
            let mut least = [[f64::INFINITY; 2]; 2];
            let mut hits = 0.0;
            for _ in 0..3 {
                // A mesh keeps its scene; a new one has none.
                let mesh = Mesh::new(mesh.positions().to_vec(), mesh.triangles().to_vec()).expect("a good mesh");
                let mesh = Arc::new(mesh);
                for (least, engine) in least.iter_mut().zip(ENGINES) {
                    let report = iterate(context, &mesh, &options(&mesh, count, engine));
                    hits = report.hits as f64;
                    *least = [least[0].min(report.prepare_seconds), least[1].min(report.project_seconds)];
                }
            }
            let ns =
                |stage: usize| format!("{:.0} / {:.0}", least[0][stage] / hits * 1e9, least[1][stage] / hits * 1e9);
            let triangles = mesh.triangles().len();
            println!(
                "{name:>10} {triangles:>9} {count:>9} {:>9.3} {:>15} {:>15} {:>7} {:>9}",
                hits / (3 * triangles) as f64,
                ns(0),
                ns(1),
                format!("x{:.2}", least[0][1] / least[1][1]),
                format!("x{:.2}", least[0].iter().sum::<f64>() / least[1].iter().sum::<f64>()),
            );
        }
    }
}

criterion_group!(benches, engines);
criterion_main!(benches);
