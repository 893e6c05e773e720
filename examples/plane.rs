//! Exactly N samples of the unit torus as text, one `x y` per line: a tile that repeats without a seam.
//!
//! ```sh
//! cargo run --release --example plane -- 65536 7 > plane.xy      # count, seed
//! ```
//!
//! The example `verify` checks the set.

use std::env;
use std::error::Error;
use std::io::{self, BufWriter, Write};
use std::ops::ControlFlow;

use azulejo::{Context, kdrt};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let count = arguments.first().map_or(Ok(4096), |count| count.parse())?;
    let seed = arguments.get(1).map_or(Ok(0), |seed| seed.parse())?;

    let context = Context::new(0)?; // One thread per core; the set does not depend on it.
    let options = kdrt::CountOptions::new(count).seed(seed);
    let progress = |done: f64| {
        eprint!("\r{:3.0} %", 100.0 * done);
        ControlFlow::Continue(()) // Break cancels the call.
    };
    let (points, report) = kdrt::sample_count(&context, &options, Some(&progress))?;
    eprintln!("\nno two of the {} samples are closer than {}", points.len(), report.radius);

    let mut out = BufWriter::new(io::stdout().lock());
    for [x, y] in points.positions {
        writeln!(out, "{x} {y}")?;
    }
    out.flush()?;
    Ok(())
}
