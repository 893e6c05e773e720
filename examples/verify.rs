//! Verifies points of the unit torus, made by any program: is the set conflict-free and maximal for a radius?
//!
//! ```sh
//! cargo run --release --example verify -- RADIUS < plane.xy      # the radius that the example `plane` prints
//! ```
//!
//! The exit code is 0 if it is both, 1 if it is not, and 2 if the input cannot be read.

use std::error::Error;
use std::process::ExitCode;
use std::{env, io};

use azulejo::analysis::{coverage::coverage_2d, spacing::smallest_distance_2d};
use azulejo::{Boundary, Context, Domain};

/// The largest distance beyond the radius of a point of the domain from a maximal set: coordinates are floats, the
/// largest of which is 1.
const TOLERANCE: f64 = 3.0 * f32::EPSILON as f64;

/// The points of a text, one `x y` per line.
fn parse(text: &str) -> Result<Vec<[f32; 2]>, Box<dyn Error>> {
    let point = |line: &str| {
        let (x, y) = line.trim().split_once(' ').ok_or_else(|| format!("no point: {line:?}"))?;
        Ok([x.parse()?, y.trim().parse()?])
    };
    text.lines().map(point).collect()
}

fn verify() -> Result<bool, Box<dyn Error>> {
    let radius: f64 = env::args().nth(1).ok_or("usage: verify RADIUS < POINTS")?.parse()?;
    let points = parse(&io::read_to_string(io::stdin())?)?;

    let (context, domain) = (Context::new(0)?, Domain::unit(Boundary::Periodic));
    let smallest = smallest_distance_2d(&context, &domain, &points, None)?;
    let coverage = coverage_2d(&context, &domain, &points, radius + TOLERANCE, None)?;
    println!("points             {}", points.len());
    println!("smallest distance  {smallest:.9} ({:.9} radii)", smallest / radius);
    println!("covering radius    {:.9} ({:.9} radii)", coverage.farthest, coverage.farthest / radius);
    println!("gaps               {}", coverage.gaps);
    Ok(smallest >= radius && coverage.gaps == 0)
}

fn main() -> ExitCode {
    match verify() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}
