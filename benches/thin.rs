//! Thinning: seconds for clouds of a million points in a plane, on a sphere and in a cube, on one thread and on four.
//!
//! Wall times of a shared machine vary: the least of several runs is printed.

#[path = "../tests/all/common/random.rs"]
mod random;

use std::hint::black_box;
use std::time::Instant;

use azulejo::Context;
use azulejo::thin::{Options, thin};
use random::Random;

const POINTS: usize = 1_000_000;

/// Prints the times of one cloud. About a tenth of it is farther apart than `radius`.
fn measure<const D: usize>(name: &str, contexts: &[(&str, Context)], cloud: &[[f32; D]], radius: f64) {
    for (kind, options) in [
        ("a tenth, farthest-first", Options::by_count(cloud.len() / 10)),
        ("by radius", Options::by_radius(radius)),
        ("all, farthest-first", Options::progressive()),
    ] {
        for (threads, context) in contexts {
            let mut selected = 0;
            let mut run = || {
                let start = Instant::now();
                selected = thin(context, &options, black_box(cloud), None).unwrap().indices.len();
                start.elapsed().as_secs_f64()
            };
            let seconds = (0..3).map(|_| run()).fold(f64::INFINITY, f64::min);
            println!("{name:<8} {kind:<24} {threads:>7} {selected:>9} {seconds:>8.3}");
        }
    }
}

fn main() {
    let contexts = [("1", Context::new(1).unwrap()), ("4", Context::new(4).unwrap())];
    let mut random = Random::new(1);
    let plane: Vec<[f32; 2]> = (0..POINTS).map(|_| [random.unit(), random.unit()]).collect();
    let cube: Vec<[f32; 3]> = (0..POINTS).map(|_| [random.unit(), random.unit(), random.unit()]).collect();
    let sphere: Vec<[f32; 3]> = (0..POINTS)
        .map(|_| {
            let (z, turn) = (2.0 * random.unit() - 1.0, std::f32::consts::TAU * random.unit());
            let around = (1.0 - z * z).sqrt();
            [around * turn.cos(), around * turn.sin(), z]
        })
        .collect();
    println!("{:<8} {:<24} {:>7} {:>9} {:>8}", "cloud", "selected", "threads", "points", "seconds");
    let tenth = 7.0 / POINTS as f64;
    measure("plane", &contexts, &plane, tenth.sqrt());
    measure("sphere", &contexts, &sphere, (4.0 * std::f64::consts::PI * tenth).sqrt());
    measure("cube", &contexts, &cube, tenth.cbrt());
}
