//! Any part of a plane without the rest: a window of it as a set, or all of it as a stream.
//!
//! Both are made of the windows of fill blocks that [`crate::kdrt::sample`] is made of (`tiling/`), in the same order.

use std::ops::ControlFlow;

use crate::error::{Error, Result};
use crate::job::{Context, Progress};
use crate::order::Order;

use crate::kdrt::kept::{Plane, lattice_of, part};
use crate::kdrt::options::Options;
use crate::kdrt::progressive::Ranked;
use crate::kdrt::sample::PATTERN_SHARE;

/// The samples of [`sample`](super::sample) that lie in `window_min <= x < window_max`: the same floats in the same
/// order, without making the others.
///
/// So windows that partition the domain hold each sample once, and a window is made without the others. It may be of
/// any size, also smaller than the radius, and may have no sample. On a torus it lies in one period, as samples do.
///
/// # What a window depends on
/// Beyond its options a window depends only on its surroundings, as tiled: whether and where a sample lies is decided
/// by the leaves' points within 22 radii along x and 18 along y.
/// These are its fill block with two more along x and one along y, for the phases of filling, and 5 radii for the
/// chains of elimination.
/// In progressive order every level adds about 12 of its radii: see [`Options::quotient`] and [`Options::coarsest`].
///
/// O(n) in time and memory for the n samples of the window and those around it, after the making of the pattern, which
/// is the same for every window (about 28,000 samples with leaves of the default size): a [`Plane`] keeps it for many
/// windows. The domain may have any number of samples that floats can carry: up to about 10^11 around the origin. One
/// that is not tiled is made as a whole.
///
/// # Errors
/// Those of [`sample`](super::sample), where limits are those of the window;
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for `window_min` and `window_max` if the window is empty
/// or reaches beyond the domain.
pub fn sample_window(
    context: &Context,
    options: &Options,
    window_min: [f64; 2],
    window_max: [f64; 2],
    progress: Option<&Progress>,
) -> Result<Vec<[f32; 2]>> {
    sample_window_ranked(context, options, window_min, window_max, progress).map(|ranked| ranked.samples)
}

/// [`sample_window`] with the ranks of its samples, if the options ask for progressive order: those that they have in
/// the whole set.
///
/// # Errors
/// Those of [`sample_window`].
pub fn sample_window_ranked(
    context: &Context,
    options: &Options,
    window_min: [f64; 2],
    window_max: [f64; 2],
    progress: Option<&Progress>,
) -> Result<Ranked> {
    let lattice = lattice_of(options)?;
    let window = part(&options.domain, options.radius, window_min, window_max)?;
    context.run(progress, |job| {
        let plane = Plane::on_lattice(&job.part(0.0, PATTERN_SHARE), lattice, options)?;
        plane.window_on(&job.part(PATTERN_SHARE, 1.0), &window)
    })
}

/// Hands all samples of [`sample`](super::sample) to `visit`, in the same order, part by part, for sets that cannot or
/// need not be held.
///
/// The parts are windows of at most about 270 radii, 50,000 samples, and never empty. `visit` is called on the calling
/// thread and may use the library; meanwhile the threads of the context make the next parts. What the parts are, and
/// their order, depends on the options only. `Break` ends the call with [`Error::Cancelled`](crate::Error::Cancelled).
///
/// Memory: the pattern and at most 8 parts per thread, however many samples there are; the domain may have any number
/// that floats can carry: up to about 10^11 around the origin. A domain that is not tiled (see
/// [`sample`](super::sample)) is made as a whole and is one part.
///
/// # Errors
/// Those of [`sample`](super::sample), but limits of the number of samples only where the domain is not tiled;
/// [`Error::InvalidArgument`] for a progressive order, which is not that of places.
pub fn sample_stream(
    context: &Context,
    options: &Options,
    visit: impl FnMut(&[[f32; 2]]) -> ControlFlow<()>,
    progress: Option<&Progress>,
) -> Result<()> {
    if options.order != Order::Any {
        return Err(Error::invalid("order", "a stream comes place by place, in no progressive order"));
    }
    let lattice = lattice_of(options)?;
    context.run(progress, |job| {
        let plane = Plane::on_lattice(&job.part(0.0, PATTERN_SHARE), lattice, options)?;
        plane.stream(&job.part(PATTERN_SHARE, 1.0), visit)
    })
}
