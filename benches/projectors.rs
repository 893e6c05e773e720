//! One iteration of local projectors against a maximal set of the same radius, in one run: time and samples.
//!
//! One thread, its processor time where the system tells it (other programs then do not count), the least of some rounds
//! in turns. A sphere, and the bunny and the dragon (`AZULEJO_BENCH_BUNNY`, `AZULEJO_BENCH_DRAGON`) where they are found.

use std::hint::black_box;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use azulejo::mesh::Mesh;
use azulejo::psp::{self, Options, ProjectionOptions};
use azulejo::{Context, MAXIMAL_DENSITY};
use glam::DVec3;

/// A sphere with `rows` of triangles from pole to pole.
fn sphere(rows: u32) -> Arc<Mesh> {
    let columns = 2 * rows;
    let place = |row: u32, column: u32| {
        let (sin, cos) = (std::f64::consts::PI * f64::from(row) / f64::from(rows)).sin_cos();
        let (y, x) = (std::f64::consts::TAU * f64::from(column % columns) / f64::from(columns)).sin_cos();
        DVec3::new(sin * x, sin * y, cos).as_vec3().to_array()
    };
    let number = |row: u32, column: u32| row * columns + column % columns;
    let positions = (0..=rows).flat_map(|row| (0..columns).map(move |column| place(row, column))).collect();
    let halves = |row: u32, column: u32| {
        let [a, b] = [number(row, column), number(row, column + 1)];
        let [c, d] = [number(row + 1, column), number(row + 1, column + 1)];
        [(row > 0).then_some([a, c, b]), (row + 1 < rows).then_some([b, c, d])]
    };
    let triangles = (0..rows).flat_map(|row| (0..columns).flat_map(move |column| halves(row, column))).flatten();
    Arc::new(Mesh::new(positions, triangles.collect()).expect("a good mesh"))
}

fn meshes() -> Vec<(&'static str, Arc<Mesh>)> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let file = |variable: &str, path: &str| std::env::var_os(variable).map_or(root.join(path), PathBuf::from);
    let files = [
        ("bunny", file("AZULEJO_BENCH_BUNNY", "../shared/meshes/bunny.obj")),
        ("dragon", file("AZULEJO_BENCH_DRAGON", "out/dragon.ply")),
    ];
    let loaded = files.into_iter().filter_map(|(name, path)| Some((name, Arc::new(Mesh::load(path).ok()?))));
    std::iter::once(("sphere", sphere(173))).chain(loaded).collect()
}

/// The processor time of this thread in seconds; wall time where the system does not tell.
fn seconds(start: Instant) -> f64 {
    let ran = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = ran.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| start.elapsed().as_secs_f64(), |ran| ran * 1e-9)
}

fn main() {
    let (context, start) = (Context::new(1).expect("a thread"), Instant::now());
    let counts = if std::env::args().any(|argument| argument == "--test") { vec![1e4] } else { vec![1e5, 1e6] };
    println!("{:>7} {:>9} | maximal ns | iteration ns, ratio | samples, relative radius", "mesh", "samples");
    for (name, mesh) in meshes() {
        for &count in &counts {
            let radius = (MAXIMAL_DENSITY * mesh.area() / count).sqrt();
            let (mut least, mut samples) = ([f64::INFINITY; 2], [0; 2]);
            for round in 0..5 {
                for (way, (least, samples)) in least.iter_mut().zip(&mut samples).enumerate() {
                    let began = seconds(start);
                    let (set, _) = if way == 0 {
                        psp::sample(&context, &mesh, &Options::new(radius).seed(round), None).expect("a set")
                    } else {
                        let options = ProjectionOptions::new(radius).seed(round);
                        psp::project(&context, &mesh, &options, 1, false, None).expect("a set")
                    };
                    *least = least.min(seconds(start) - began);
                    *samples = black_box(set).len();
                }
            }
            let [maximal, iterated] = least.map(|seconds| seconds / samples[0] as f64 * 1e9);
            let share = samples[1] as f64 / samples[0] as f64;
            println!(
                "{name:>7} {:>9} | {maximal:>10.0} | {iterated:>12.0}, {:>5.3} | {share:>7.3}, {:>15.3}",
                samples[0],
                iterated / maximal,
                share.sqrt()
            );
        }
    }
}
