//! Blue-noise masks: seconds of the plane and of space on one thread, and of two channels on two.
//!
//! Wall times of a shared machine vary: the least of several runs is printed.

use std::time::Instant;

use azulejo::Context;
use azulejo::mask::{Options, create};

fn main() {
    let contexts = [1, 2].map(|threads| Context::new(threads).unwrap());
    println!("{:<16} {:>8} {:>8} {:>8} {:>8}", "pixels", "channels", "threads", "moves", "seconds");
    for ([width, height, depth], runs) in [([256, 256, 1], 5), ([1024, 1024, 1], 1), ([64, 64, 64], 1)] {
        for (channels, context) in [(1, &contexts[0]), (2, &contexts[1])] {
            let options = Options::new(width, height).depth(depth).channels(channels);
            let run = || {
                let start = Instant::now();
                let (_, report) = create(context, &options, None).unwrap();
                (start.elapsed().as_secs_f64(), report.moves)
            };
            let (seconds, moves) = (0..runs).map(|_| run()).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
            let pixels = format!("{width} x {height} x {depth}");
            println!("{pixels:<16} {channels:>8} {:>8} {moves:>8} {seconds:>8.3}", context.num_threads());
        }
    }
}
