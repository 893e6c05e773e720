//! Any part of a plane without the rest: a window of it as a set, or all of it as a stream.
//!
//! Both are made of the windows of fill blocks that [`crate::kdrt::sample`] is made of (`plane.rs`), in the same order.

use std::ops::ControlFlow;

use crate::error::{Error, Result};
use crate::job::{Context, Progress};
use crate::plane::lattice::{self, Lattice};
use crate::points::{Boundary, Domain};
use crate::{maximal, memory};

use crate::kdrt::options::{Options, check_leaf_size};
use crate::kdrt::output::capacity;
use crate::kdrt::sample::{BYTES_PER_SAMPLE, PATTERN_SHARE};
use crate::kdrt::tiling::Tiling;

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
///
/// O(n) in time and memory for the n samples of the window and those around it, after the making of the pattern, which
/// is the same for every window (about 28,000 samples with leaves of the default size). The domain may have any number
/// of samples that floats can carry: up to about 10^11 around the origin. One that is not tiled is made as a whole.
///
/// # Errors
/// Those of [`sample`](super::sample), where limits are those of the window; [`Error::InvalidArgument`] for
/// `window_min` and `window_max` if the window is empty or reaches beyond the domain.
pub fn sample_window(
    context: &Context,
    options: &Options,
    window_min: [f64; 2],
    window_max: [f64; 2],
    progress: Option<&Progress>,
) -> Result<Vec<[f32; 2]>> {
    let &Options { radius, domain, leaf_size, seed } = options;
    check_leaf_size(leaf_size)?;
    let window = part(&domain, window_min, window_max)?;
    let expected = lattice::estimate(window.extent(), radius)?;
    let lattice = Lattice::of_any_size(&domain, radius)?;
    let inside = |mut samples: Vec<[f32; 2]>| {
        samples.retain(|&sample| window.contains(sample));
        samples
    };
    if !Tiling::is_worthwhile(&lattice, leaf_size) {
        lattice::estimate(domain.extent(), radius)?;
        return context.run(progress, |job| maximal::sample_lattice(job, &lattice, seed).map(inside));
    }
    memory::require(expected * BYTES_PER_SAMPLE, "radius", &format!("about {expected:.0} samples"))?;
    let points = lattice.points_in(&window);
    if points.is_empty() {
        return context.run(progress, |_| Ok(Vec::new()));
    }
    context.run(progress, |job| {
        let tiling = Tiling::new(&job.part(0.0, PATTERN_SHARE), lattice, leaf_size, seed)?;
        let windows = tiling.windows_holding(&points);
        let task = |i: usize| inside(tiling.window(&windows[i]));
        job.part(PATTERN_SHARE, 1.0).concat_about(capacity(expected), windows.len(), task)
    })
}

/// Hands all samples of [`sample`](super::sample) to `visit`, in the same order, part by part, for sets that cannot or
/// need not be held.
///
/// The parts are windows of at most about 270 radii, 50,000 samples, and never empty. `visit` is called on the calling
/// thread and may use the library; meanwhile the threads of the context make the next parts. What the parts are, and
/// their order, depends on the options only. `Break` ends the call with [`Error::Cancelled`].
///
/// Memory: the pattern and at most 8 parts per thread, however many samples there are; the domain may have any number
/// that floats can carry: up to about 10^11 around the origin. A domain that is not tiled (see
/// [`sample`](super::sample)) is made as a whole and is one part.
///
/// # Errors
/// Those of [`sample`](super::sample), but limits of the number of samples only where the domain is not tiled.
pub fn sample_stream(
    context: &Context,
    options: &Options,
    mut visit: impl FnMut(&[[f32; 2]]) -> ControlFlow<()>,
    progress: Option<&Progress>,
) -> Result<()> {
    let &Options { radius, domain, leaf_size, seed } = options;
    check_leaf_size(leaf_size)?;
    let lattice = Lattice::of_any_size(&domain, radius)?;
    let mut visit = |samples: Vec<[f32; 2]>| {
        if samples.is_empty() || visit(&samples).is_continue() { Ok(()) } else { Err(Error::Cancelled) }
    };
    if !Tiling::is_worthwhile(&lattice, leaf_size) {
        lattice::estimate(domain.extent(), radius)?;
        return context.run(progress, |job| visit(maximal::sample_lattice(job, &lattice, seed)?));
    }
    context.run(progress, |job| {
        let tiling = Tiling::new(&job.part(0.0, PATTERN_SHARE), lattice, leaf_size, seed)?;
        let windows = tiling.windows();
        job.part(PATTERN_SHARE, 1.0).stream(windows.len(), |i| tiling.window(&windows[i]), visit)
    })
}

/// The part of a domain between two corners; it is bounded.
fn part(domain: &Domain, min: [f64; 2], max: [f64; 2]) -> Result<Domain> {
    domain.check()?;
    for axis in 0..2 {
        let (from, to) = (domain.min[axis], domain.max[axis]);
        for (argument, x) in [("window_min", min[axis]), ("window_max", max[axis])] {
            if !(from..=to).contains(&x) {
                return Err(Error::invalid(argument, format!("[{axis}] is {x}, outside the domain {from} to {to}")));
            }
        }
        if min[axis] >= max[axis] {
            let reason = format!("[{axis}] is {}, not above window_min {}", max[axis], min[axis]);
            return Err(Error::invalid("window_max", reason));
        }
    }
    Ok(Domain { min, max, boundary: Boundary::Bounded })
}
