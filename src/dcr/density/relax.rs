//! Relaxation to a density, and a start for it.

use crate::dcr::density::raster::Raster;
use crate::dcr::density::relaxation::DensityRelaxation;
use crate::dcr::density::source::Density;
use crate::dcr::ground::memory::require_memory;
use crate::dcr::ground::torus::Torus;
use crate::dcr::options::{Method, Neighbourhood, Options};
use crate::dcr::relax::{Report, relax_set};
use crate::error::{Error, Result};
use crate::job::{Context, Progress};
use crate::points::Domain;

/// Relaxes a set of points to a density: returns as many points, in the same order, with the local density that is asked
/// for, and evenly spread. A start with about that density, such as [`scatter`] or
/// [`psp::adaptive`](crate::psp::adaptive) make, needs no more than the usual 100 steps.
///
/// A start that is far from it is dealt out before the first step onto the points that [`scatter`] makes from `seed`, in
/// the order of a curve, so that points that were near each other mostly stay so. Far is a number of points that differs
/// in some cell of a quadtree by more than 64, by a quarter and by 16 times the square root from that of the points of
/// [`scatter`]. Starts in between may take more steps.
///
/// As [`relax`](fn@crate::dcr::relax), with these differences. In the report, lengths are in units of the *local
/// spacing*: `d_max` for the mean density, as 1 / sqrt(density) elsewhere, but it grows by no more than half of the
/// distance between positions, so that it is finite where the density is 0. [`Report::rho`] is the least of all
/// distances over the mean of the spacings of the two points, [`Report::coverage`] the largest circumradius of a
/// triangle over the spacing at its centre, there without the limit to its growth. [`Report::motion`] is in units of
/// `d_max`. Details of the density that are finer than an eighth of `d_max` are lost. A call that is cancelled before
/// the first step returns the points as they are.
///
/// The density is sampled at 13 to 55 positions per point, and then each step is O(n), with a factor for densities that
/// vary by octaves.
///
/// # Errors
/// [`Error::InvalidArgument`] for a density that is not 0 or above and finite, or is 0 everywhere (`density`; of
/// several such positions the reported one does not depend on chance), for an image without pixels (`width`, `height`) or
/// of another size than its values, and for all options but [`Method::Momentum`] (`method`) with Delaunay neighbours (`neighbourhood`); those of
/// [`relax`](fn@crate::dcr::relax).
pub fn relax_with_density(
    context: &Context,
    options: &Options,
    density: &Density,
    points: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<(Vec<[f32; 2]>, Report)> {
    options.check()?;
    density.check()?;
    if options.method != Method::Momentum {
        return Err(Error::invalid("method", "only the momentum method supports densities"));
    }
    if options.neighbourhood != Neighbourhood::Delaunay {
        return Err(Error::invalid("neighbourhood", "densities need Delaunay neighbours"));
    }
    options.domain.check_points(points)?;
    require_memory("xy", points.len())?;
    let mut set = context.run(None, |job| {
        let raster = Raster::new(&job.part(0.0, 0.5), &options.domain, density, points.len())?;
        DensityRelaxation::new(&job.part(0.5, 1.0), options.domain, options.seed, raster, points)
    })?;
    relax_set(context, options, points, &mut set, progress, None)
}

/// Random points of a domain, as dense as asked for: a start for [`relax_with_density`]. Point `i` depends on the
/// arguments and on nothing else.
///
/// # Errors
/// [`Error::InvalidArgument`] for a domain or a density that is invalid, [`Error::TooLarge`] for more than 2^32 - 1 points,
/// or than memory holds, [`Error::Cancelled`].
pub fn scatter(
    context: &Context,
    domain: &Domain,
    density: &Density,
    count: usize,
    seed: u64,
    progress: Option<&Progress>,
) -> Result<Vec<[f32; 2]>> {
    domain.check()?;
    density.check()?;
    if count > u32::MAX as usize {
        return Err(Error::too_large("count", format!("{count} points; the limit is {}", u32::MAX)));
    }
    context.run(progress, |job| {
        let raster = Raster::new(&job.part(0.0, 0.9), domain, density, count)?;
        Ok(raster.scatter(&Torus::new(*domain, count), count, seed))
    })
}
