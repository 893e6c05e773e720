//! One iteration of local projectors against a maximal set of the same radius, in one run: time and samples.
//!
//! One thread, its processor time where the system tells it (other programs then do not count), the least of some rounds
//! in turns. A sphere, and the bunny and the dragon where they are found (`common/mod.rs`).

mod common;
#[path = "../cli/src/procedural/shapes.rs"]
#[allow(dead_code)]
mod shapes;

use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use azulejo::mesh::Mesh;
use azulejo::psp::{self, Options, ProjectionOptions};
use azulejo::{Context, MAXIMAL_DENSITY};

fn meshes() -> impl Iterator<Item = (&'static str, Arc<Mesh>)> {
    let (positions, triangles) = shapes::sphere(346);
    let sphere = Arc::new(Mesh::new(positions, triangles).expect("a good mesh"));
    std::iter::once(("sphere", sphere)).chain(common::loaded())
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
