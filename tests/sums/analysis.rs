//! Measurements of sets.

use azulejo::analysis::coverage::{coverage_2d, coverage_3d, surface_coverage};
use azulejo::analysis::differential::surface_differences;
use azulejo::analysis::distribution::radial_distribution;
use azulejo::analysis::figures::figures_2d;
use azulejo::analysis::space::figures_3d;
use azulejo::analysis::spectrum::periodogram;
use azulejo::{Boundary, Context, Domain, Result, volume};

use super::list::{List, little_endian};
use super::plane::{SQUARE, Sets, TORUS};
use super::surface::Surface;

/// Adds the sums.
pub fn sums(context: &Context, sets: &Sets, surface: &Surface, list: &mut List) -> Result<()> {
    let spectrum = periodogram(context, &TORUS, &sets.large, 128, None)?;
    list.bytes("spectrum", &little_endian(spectrum.power(), f32::to_le_bytes));
    let figures = figures_2d(context, &SQUARE, &sets.bounded, None)?;
    list.bytes("figures", format!("{figures:?}").as_bytes());
    let distribution = radial_distribution(context, &TORUS, &sets.large, 6.0, 64, None)?;
    list.numbers("radial distribution", &distribution.density());
    let coverage = coverage_2d(context, &TORUS, &sets.random, 0.02, None)?;
    list.bytes("coverage", format!("{coverage:?}").as_bytes());
    let Surface { closed, maximal, open, few } = surface;
    let coverage = surface_coverage(context, open, &few.positions, 0.05, None)?;
    list.bytes("coverage of a mesh", format!("{coverage:?}").as_bytes());
    let (positions, normals) = (&maximal.positions, &maximal.normals);
    let differences = surface_differences(context, closed, positions, normals, [1.0, 0.0, 0.0], 38, None)?;
    list.numbers("differences", &differences.density());
    space(context, list)
}

/// Those of cuboids.
fn space(context: &Context, list: &mut List) -> Result<()> {
    for (name, boundary) in [("torus", Boundary::Periodic), ("cuboid", Boundary::Bounded)] {
        let domain = Domain { min: [-1.5, 0.0, 3.0], max: [-0.5, 0.7, 4.1], boundary };
        let samples = volume::sample(context, &volume::Options::new(0.06).domain(domain).seed(39), None)?.0.positions;
        let figures = figures_3d(context, &domain, &samples, 0.062, None)?;
        list.bytes(&format!("figures of a {name}"), format!("{figures:?}").as_bytes());
        let coverage = coverage_3d(context, &domain, &samples, 0.053, None)?;
        list.bytes(&format!("coverage of a {name}"), format!("{coverage:?}").as_bytes());
    }
    Ok(())
}
