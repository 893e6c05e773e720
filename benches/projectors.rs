//! A maximal set with an iteration of local projectors before the fill, and without: the rule of the default against the
//! better way, on nine meshes and four counts; and the iteration alone by both engines. In one run.
//!
//! One thread, its processor time where the system tells it (other programs then do not count), the least of some rounds
//! in turns. Procedural meshes, and the bunny and the dragon where they are found (`common/mod.rs`).

mod common;
#[path = "../cli/src/procedural/shapes.rs"]
#[allow(dead_code)]
mod shapes;

use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use azulejo::mesh::Mesh;
use azulejo::psp::{self, Engine, Options, ProjectionOptions};
use azulejo::{Context, MAXIMAL_DENSITY};

const ROUNDS: u64 = 2;

/// A sphere with waves of many lengths on it.
fn rough(around: u32) -> shapes::Soup {
    let (mut positions, triangles) = shapes::sphere(around);
    for place in &mut positions {
        let [x, y, z] = place.map(f64::from);
        let wave = |octave: i32| {
            let [frequency, phase] = [4.0 * 1.2f64.powi(octave), f64::from(octave)];
            let along = (phase.sin() * x + (1.7 * phase).cos() * y + (2.3 * phase).sin() * z) * frequency;
            0.2 / frequency * (along + phase).sin()
        };
        let height = 1.0 + (0..24).map(wave).sum::<f64>();
        *place = place.map(|x| (f64::from(x) * height) as f32);
    }
    (positions, triangles)
}

fn meshes() -> impl Iterator<Item = (&'static str, Arc<Mesh>)> {
    let soups = [
        ("sphere", shapes::sphere(346)),
        ("coarse sphere", shapes::sphere(46)),
        ("fine sphere", shapes::sphere(1414)),
        ("torus", shapes::torus(400, 200)),
        ("hall", shapes::hall(48)),
        ("coarse hall", shapes::hall(8)),
        ("rough sphere", rough(346)),
    ];
    let mesh = |(name, (positions, triangles))| (name, Arc::new(Mesh::new(positions, triangles).expect("a good mesh")));
    soups.into_iter().map(mesh).chain(common::loaded())
}

/// The processor time of this thread in seconds; wall time where the system does not tell.
fn seconds(start: Instant) -> f64 {
    let ran = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = ran.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| start.elapsed().as_secs_f64(), |ran| ran * 1e-9)
}

fn main() {
    let (context, start) = (Context::new(1).expect("a thread"), Instant::now());
    let is_test = std::env::args().any(|argument| argument == "--test");
    let counts = if is_test { vec![3e4] } else { vec![3e4, 1e5, 3e5, 1e6] };
    // The pattern is kept with the context.
    psp::project(&context, &Arc::new(shape_of_one()), &ProjectionOptions::new(0.1), 1, true, None).expect("a set");
    println!(
        "{:>13} {:>9} {:>9} | {:>4} {:>9} | {:>9} {:>5} | {:>5} {:>6} | {:>6}",
        "mesh", "triangles", "samples", "fill", "projected", "rule", "loss", "alone", "Embree", "share"
    );
    for (name, mesh) in meshes() {
        for &count in &counts {
            let radius = (MAXIMAL_DENSITY * mesh.area() / count).sqrt();
            let project = |seed: u64, engine: Engine, iterations: u32, maximal: bool| {
                let options = ProjectionOptions::new(radius).seed(seed).engine(engine);
                psp::project(&context, &mesh, &options, iterations, maximal, None).expect("a set").0.len()
            };
            let embree = Engine::AVAILABLE[0];
            let ways: [&dyn Fn(u64) -> usize; 4] = [
                &|seed| project(seed, Engine::Auto, 0, true),
                &|seed| project(seed, Engine::Auto, 1, true),
                &|seed| project(seed, Engine::Auto, 1, false),
                &|seed| project(seed, embree, 1, false),
            ];
            let (mut least, mut samples) = ([f64::INFINITY; 4], [0; 4]);
            for round in 0..ROUNDS {
                for ((least, samples), way) in least.iter_mut().zip(&mut samples).zip(ways) {
                    let began = seconds(start);
                    *samples = black_box(way(round));
                    *least = least.min(seconds(start) - began);
                }
            }
            let (_, report) = psp::sample(&context, &mesh, &Options::new(radius), None).expect("a set");
            let [filled, projected, alone, by_embree] = least.map(|seconds| seconds / samples[0] as f64 * 1e9);
            let (rule, chosen) = if report.iterations > 0 { ("projected", projected) } else { ("fill", filled) };
            println!(
                "{name:>13} {:>9} {:>9} | {filled:>4.0} {:>9.3} | {rule:>9} {:>5.3} | {:>5.3} {:>6.2} | {:>6.3}",
                mesh.triangles().len(),
                samples[0],
                projected / filled,
                chosen / filled.min(projected),
                alone / filled,
                by_embree / alone,
                samples[2] as f64 / samples[0] as f64,
            );
        }
    }
}

/// Any mesh.
fn shape_of_one() -> Mesh {
    let (positions, triangles) = shapes::sphere(16);
    Mesh::new(positions, triangles).expect("a good mesh")
}
