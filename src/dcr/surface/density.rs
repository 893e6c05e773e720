//! Relaxation on a mesh to a density that varies over it, as stippling asks for (thesis §4.2.3).

use crate::dcr::surface::grading::Graded;
use crate::dcr::surface::{BYTES_PER_SAMPLE, Options, Report, check, relaxed};
use crate::error::Result;
use crate::job::{Context, Progress};
use crate::memory;
use crate::mesh::Mesh;
use crate::points::Points;
use crate::psp::adaptive::{Density, PIECES};

/// The peak memory for a piece over which the density is integrated.
const BYTES_PER_PIECE: f64 = 170.0;

/// Relaxes samples on a mesh to a density, in any unit: returns as many samples, in their order, about as dense at each
/// place as it asks for, and evenly spread. A start of about that density, such as
/// [`psp::adaptive`](crate::psp::adaptive) makes of the same density, needs no more than the usual 100 steps.
///
/// Like [`relax`](super::relax), with these differences:
///
/// * The *local spacing* is `d_max` for the mean density of the mesh, as 1 / sqrt(density) elsewhere, but at most 8
///   times that at the density that a thousandth of the samples exceed. [`Report::rho`] is the smallest of all
///   distances over the mean of the spacings of the two samples, [`Report::motion`] is in units of `d_max`.
/// * Where the density is 0 no sample ends, unless no step is made; samples that begin there are thrown at random over
///   the surface, by the density.
/// * Samples whose numbers are far from the integral of the density are redistributed by it.
/// * Samples may get closer to each other than the closest two were.
///
/// The density is integrated over some 100,000 pieces of the surface, and asked for once per sample and step.
///
/// # Errors
/// Those of [`relax`](super::relax), and [`Error::InvalidArgument`](crate::Error::InvalidArgument) for a density that
/// is not finite and 0 or above, or is 0 everywhere (`density`), or whose values are not those of the mesh's vertices
/// or of the image (`vertex_count`, `width`, `height`, `texture`).
pub fn relax_with_density(
    context: &Context,
    mesh: &Mesh,
    triangles: &[u32],
    barycentrics: &[[f32; 2]],
    density: Density,
    options: &Options,
    progress: Option<&Progress>,
) -> Result<(Points<3>, Report)> {
    check(mesh, triangles, barycentrics)?;
    options.check()?;
    let pieces = PIECES + mesh.triangles().len() as f64;
    let bytes = BYTES_PER_SAMPLE * triangles.len() as f64 + BYTES_PER_PIECE * pieces;
    memory::require(bytes, "triangles", &format!("{} points of a density", triangles.len()))?;
    let grading = context.run(None, |job| Graded::new(job, mesh, density))?;
    relaxed(context, mesh, (triangles, barycentrics), &grading, options, progress)
}
