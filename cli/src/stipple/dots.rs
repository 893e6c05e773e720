//! Dots, as dense as an image is dark.

use azulejo::dcr::{self, DelaunayOptions, Report};
use azulejo::psp::adaptive::{self, Radius};
use azulejo::{Context, Given, Progress, Result};

use super::darkness::Darkness;
use crate::sheet::sheet;

/// The least darkness for PSP: lighter pixels, unless they are white, are sampled as if they were this dark, the step
/// from white to the next grey value of a byte.
pub(super) const LIGHTEST: f64 = 1.0 / 255.0;

/// Dots at random.
pub fn random(context: &Context, darkness: &Darkness, count: usize, seed: u64) -> Result<Vec<[f32; 2]>> {
    dcr::scatter(context, &darkness.domain(), &darkness.density(), count, seed, None)
}

/// Dots that have been relaxed.
pub fn relaxed(
    context: &Context,
    darkness: &Darkness,
    dots: &[[f32; 2]],
    max_iterations: u32,
    progress: &Progress,
) -> Result<(Vec<[f32; 2]>, Report)> {
    let options = DelaunayOptions::new(darkness.domain()).max_iterations(max_iterations);
    dcr::relax_with_density(context, &options, &darkness.density(), dots, Some(progress))
}

/// A maximal Poisson-disk set of about this many dots around given ones, on a mesh with a vertex at each pixel corner.
pub fn poisson(
    context: &Context,
    darkness: &Darkness,
    count: f64,
    given: Given<3>,
    seed: u64,
    progress: &Progress,
) -> Result<Vec<[f32; 2]>> {
    let [width, height] = darkness.size();
    let around = |index: usize, length: usize| [index.saturating_sub(1), index.min(length - 1)];
    let corner = |column: usize, row: usize| {
        let rows = around(row, height).into_iter();
        rows.flat_map(|row| around(column, width).map(|column| darkness.at(column, row))).sum::<f64>() / 4.0
    };
    let corners = (0..=height).flat_map(|row| (0..=width).map(move |column| corner(column, row)));
    let (mesh, radii) = sheet(&corners.collect::<Vec<_>>(), width + 1, LIGHTEST, count)?;
    let options = adaptive::Options::new(Radius::PerVertex(&radii)).seed(seed).given(given);
    let (set, _) = adaptive::sample(context, &mesh, &options, Some(progress))?;
    // The far boundaries belong to the mesh, but not to the domain.
    let inside = |x: f32, length: usize| x.min(length as f32 * (1.0 - f32::EPSILON));
    Ok(set.positions.iter().map(|&[x, y, _]| [inside(x, width), inside(y, height)]).collect())
}
