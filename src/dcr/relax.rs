//! Relaxation in the plane at a constant density, by either method.

use crate::dcr::ground::memory::require_memory;
use crate::dcr::options::{Method, Options};
use crate::dcr::relaxation::Relaxation;
use crate::dcr::report::Report;
use crate::dcr::run::{Observer, run};
use crate::dcr::thesis::ThesisRelaxation;
use crate::dcr::uniform::UniformRelaxation;
use crate::error::Result;
use crate::job::{Context, Progress};

/// Relaxes a set of points of the domain: returns as many points, in the same order, spread more evenly.
///
/// The result is the same for every number of threads and every order of calls; the points stay in
/// `min <= x < max`, around the torus or held back by the boundary. An empty set and a single point are returned as they
/// are. Coincident points, and all points of a set on one line, are first moved by 0.001 to 0.002 `d_max` in
/// directions keyed by `seed` and index: the forces alone would not separate them.
///
/// The momentum method levels a heaped set before the first step: one in which points are crowded in some places and
/// missing in others, as in a corner, on a line, at a single place. It is spread by the long waves of its density, as
/// smoothly as that goes, in up to 24 passes that take about the time of a step each. So any set ends with the figures
/// of a random one, and after about its time. Uniform random sets are not heaped, except on domains that are very long
/// for their width. A call that makes all of its steps succeeds whatever it has reached; the report says what that is.
///
/// The momentum method with Delaunay neighbours returns, of the set before the first step and the states after whole steps, the one
/// in which the fewest points have a neighbour closer than 0.85 `d_max` or a triangle whose circumradius is above 0.67
/// `d_max`; of several, the last. In all other cases the set after the last whole step is returned. A call that is
/// cancelled returns the same, with [`Stopped::Cancelled`](super::Stopped::Cancelled).
///
/// Each step is O(n) for sets without dense clusters, but O(n log n) where a Delaunay triangulation is built anew:
/// always by the thesis's method, and by the momentum method in sets of a few points, with holes as wide as the domain,
/// or with points that have dozens of neighbours. A bounded domain costs up to four times the time and memory of a
/// periodic one, as the momentum method works on it and its mirror images. Memory is O(n).
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for options out of their range and for points outside the
/// domain or not finite (`xy`, with index and value), [`Error::TooLarge`](crate::Error::TooLarge) for more than 2^32 - 1
/// points.
pub fn relax(
    context: &Context,
    options: &Options,
    points: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<(Vec<[f32; 2]>, Report)> {
    relax_observed(context, options, points, progress, None)
}

/// As [`relax`], and calls `observe` after every step, on the calling thread.
///
/// # Errors
/// As [`relax`].
pub fn relax_observed(
    context: &Context,
    options: &Options,
    points: &[[f32; 2]],
    progress: Option<&Progress>,
    observe: Option<&mut Observer>,
) -> Result<(Vec<[f32; 2]>, Report)> {
    options.check()?;
    options.domain.check_points(points)?;
    require_memory("xy", points.len())?;
    let Options { domain, neighbourhood, seed, .. } = *options;
    let mut set: Box<dyn Relaxation> = match &options.method {
        Method::Momentum => Box::new(UniformRelaxation::new(domain, neighbourhood, seed, points)),
        Method::Thesis(thesis) => Box::new(ThesisRelaxation::new(domain, neighbourhood, thesis, seed, points)),
    };
    run(context, options, points, &mut *set, progress, observe)
}
