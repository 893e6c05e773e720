//! Relaxed dots whose density is a function of the position, as an SVG drawing: a sphere in stipples.
//!
//! ```sh
//! cargo run --release --example relax -- 20000 > sphere.svg      # exactly so many dots
//! ```

use std::env;
use std::error::Error;
use std::io::{self, BufWriter, Write};

use azulejo::dcr::{self, Density};
use azulejo::{Boundary, Context, Domain};

/// The darkness of the drawing at a position: a sphere that is lit from the upper left, on white.
fn darkness([x, y]: [f64; 2]) -> f64 {
    let (x, y) = (2.2 * x - 1.1, 1.1 - 2.2 * y);
    let depth = 1.0 - x * x - y * y;
    if depth < 0.0 {
        return 0.0;
    }
    let light = (0.6 * depth.sqrt() - 0.5 * x + 0.6 * y).max(0.0);
    1.05 - light.min(1.0)
}

fn main() -> Result<(), Box<dyn Error>> {
    let count: usize = env::args().nth(1).map_or(Ok(5000), |count| count.parse())?;
    let (context, domain) = (Context::new(0)?, Domain::unit(Boundary::Bounded));
    let density = Density::Function(&darkness);

    let start = dcr::scatter(&context, &domain, &density, count, 7, None)?;
    let options = dcr::DelaunayOptions::new(domain);
    let (dots, report) = dcr::relax_with_density(&context, &options, &density, &start, None)?;
    eprintln!("{count} dots after {} steps; the closest two are {:.2} spacings apart", report.iterations, report.rho);

    let mut out = BufWriter::new(io::stdout().lock());
    writeln!(out, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1 1\">")?;
    let radius = 0.3 / (count as f64).sqrt();
    for [x, y] in dots {
        writeln!(out, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius:.5}\"/>")?;
    }
    writeln!(out, "</svg>")?;
    out.flush()?;
    Ok(())
}
