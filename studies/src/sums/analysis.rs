//! Measurements of sets.

use azulejo::analysis::coverage::{coverage_2d, surface_coverage};
use azulejo::analysis::differential::surface_differences;
use azulejo::analysis::distribution::radial_distribution;
use azulejo::analysis::figures::figures_2d;
use azulejo::analysis::spectrum::periodogram;
use azulejo::{Context, Result};

use super::plane::{SQUARE, Sets, TORUS};
use super::print;
use super::surface::Surface;

/// Prints the sums.
pub fn print(context: &Context, sets: &Sets, surface: &Surface) -> Result<()> {
    let spectrum = periodogram(context, &TORUS, &sets.large, 128, None)?;
    print::bytes("spectrum", &print::little_endian(spectrum.power(), f32::to_le_bytes))?;
    let figures = figures_2d(context, &SQUARE, &sets.bounded, None)?;
    print::bytes("figures", format!("{figures:?}").as_bytes())?;
    let distribution = radial_distribution(context, &TORUS, &sets.large, 6.0, 64, None)?;
    print::numbers("radial distribution", &distribution.density())?;
    let coverage = coverage_2d(context, &TORUS, &sets.random, 0.02, None)?;
    print::bytes("coverage", format!("{coverage:?}").as_bytes())?;
    let Surface { closed, maximal, open, few } = surface;
    let coverage = surface_coverage(context, open, &few.positions, 0.05, None)?;
    print::bytes("coverage of a mesh", format!("{coverage:?}").as_bytes())?;
    let (positions, normals) = (&maximal.positions, &maximal.normals);
    let differences = surface_differences(context, closed, positions, normals, [1.0, 0.0, 0.0], 38, None)?;
    print::numbers("differences", &differences.density())
}
