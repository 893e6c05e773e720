//! Density: relaxation of sets that are denser here than there, as stippling needs them (thesis §4.2.3).
//!
//! The thesis says that its radii are to be multiplied by a map of the user's, and leaves it at that. Here:
//!
//! * The *local spacing* follows from the density, as 1 / sqrt(density) (`raster.rs`). The length between two points is
//!   measured in the mean of their spacings, as `psp::adaptive` does, a hole in that of its three corners (`forces.rs`).
//! * Constraints between neighbours only relax what stands where it stands. That there are as many points as the density
//!   asks for is brought about by long waves of what is too much or missing, whose lengths scale with the local spacing
//!   (`levels.rs`).
//!
//! All else is the best method's: momentum, constraints that grow stiffer, a border in which points do not see themselves, a
//! mesh that is kept (`set.rs`), also where wide areas have no points (`anchors.rs`). The border has no excess of points, which
//! would show as a frame.

mod anchors;
mod forces;
mod levels;
mod mesh;
mod raster;
mod set;

use self::raster::Raster;
use self::set::Graded;
use crate::dcr::ground::torus::Torus;
use crate::dcr::{Method, Neighbourhood, Options, Report};
use crate::error::{Error, Result};
use crate::job::{Context, Progress};
use crate::points::Domain;

/// A density for every place of the domain; called from several threads at once, unless the context has only one.
pub type DensityFunction<'a> = dyn Fn([f64; 2]) -> f64 + Sync + 'a;

/// How dense points shall be from place to place, in any unit: twice the density gives the same set.
///
/// Densities are 0 or above and finite, and not 0 everywhere. Where they are 0 no points are wanted, and points that
/// start there leave.
#[derive(Clone, Copy)]
pub enum Density<'a> {
    /// An image that is stretched over the domain, linear between the centres of its pixels.
    Image {
        /// The pixels, row by row; the first row lies along the lower border (`min[1]`) of the domain.
        values: &'a [f32],
        /// Pixels in a row; at least 1.
        width: usize,
        /// Rows; at least 1.
        height: usize,
    },
    /// A density for each position. It is called once for each place of a lattice of 100 to 200 places per point, all
    /// before the first step.
    Function(&'a DensityFunction<'a>),
}

impl Density<'_> {
    /// Refuses images that are not one, and pixels that are no density.
    pub(super) fn check(&self) -> Result<()> {
        let Self::Image { values, width, height } = *self else { return Ok(()) };
        for (argument, length) in [("width", width), ("height", height)] {
            if length == 0 {
                return Err(Error::invalid(argument, "0 is not at least 1"));
            }
        }
        if width.checked_mul(height) != Some(values.len()) {
            let reason = format!("{} values are not those of an image of {width} by {height}", values.len());
            return Err(Error::invalid("density", reason));
        }
        match values.iter().position(|&value| !is_density(value.into())) {
            None => Ok(()),
            Some(i) => {
                let reason =
                    format!("pixel ({}, {}) is {:?}, not 0 or above and finite", i % width, i / width, values[i]);
                Err(Error::invalid("density", reason))
            }
        }
    }
}

/// Whether a number is a density that floats can hold.
fn is_density(value: f64) -> bool {
    (0.0..=f32::MAX.into()).contains(&value)
}

/// Relaxes a set of points to a density: returns as many points, in the same order, as dense from place to place as the
/// density asks for, and evenly spread. A start that is about as dense as it shall be, such as [`scatter`] or
/// [`psp::adaptive`](crate::psp::adaptive) make, needs no more than the usual 100 steps; others may take 800.
///
/// As [`relax`](super::relax), with these differences. In the report, lengths are in units of the *local spacing*: `d_max` for
/// the mean density, as 1 / sqrt(density) elsewhere, but it grows by no more than half of the distance from place to place, so
/// that it is finite where the density is 0. [`Report::rho`] is the least of all distances over the mean of the spacings
/// of the two points, [`Report::coverage`] the largest circumradius of a triangle over the spacing at its centre, there
/// without the limit to its growth.
/// [`Report::motion`] is in units of `d_max`. Details of the density that are finer than an eighth of `d_max` are lost.
/// A call that is cancelled before the first step returns the points as they are.
///
/// The density is sampled at 13 to 55 places per point, and then each step is O(n), with a factor for densities that
/// vary by octaves.
///
/// # Errors
/// [`Error::InvalidArgument`] for a density that is not 0 or above and finite, or is 0 everywhere (`density`; which of
/// several bad places is told is not chance), for an image without pixels (`width`, `height`) or of another size than its
/// values, and for all options but [`Method::Momentum`] (`method`) with Delaunay neighbours (`neighbourhood`); those of
/// [`relax`](super::relax).
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
        return Err(Error::invalid("method", "only the best method knows densities"));
    }
    if options.neighbourhood != Neighbourhood::Delaunay {
        return Err(Error::invalid("neighbourhood", "densities take Delaunay neighbours"));
    }
    options.domain.check_points(points)?;
    crate::dcr::require_memory("xy", points.len())?;
    let mut set = context.run(None, |job| {
        let raster = Raster::new(&job.part(0.0, 0.5), &options.domain, density, points.len())?;
        Graded::new(&job.part(0.5, 1.0), options, raster, points)
    })?;
    crate::dcr::run(context, options, points, &mut set, progress, None)
}

/// Random points of a domain, as dense as asked for: a start for [`relax_with_density`]. Point `i` depends on the
/// arguments and on nothing else.
///
/// # Errors
/// [`Error::InvalidArgument`] for a domain or a density that is none, [`Error::TooLarge`] for more than 2^32 - 1 points, or
/// than memory holds, [`Error::Cancelled`].
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
