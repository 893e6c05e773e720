//! Thinning: some points of a cloud are selected, far from each other and near to all the others.
//!
//! There are two rules, both exact. *By radius*: a point is selected if no selected one of lower index is nearer than
//! the radius. *Farthest-first* (Gonzalez 1985): each next point is the farthest from those before. One loop makes
//! both: the points know how far they are from the selected ones, and the farthest is selected next, the lowest index
//! on ties. By radius all distances that are large enough count as equal (`selecting.rs`).
//!
//! A tree of boxes, each with its farthest point, finds the next one and the few that it is nearer to (`tree.rs`). Its
//! shape has no effect on the result. A tree that keeps these is that of Han et al. 2023, "QuickFPS"; its wide nodes,
//! and the rule by radius, are ours.
//!
//! Distances are compared as squares, computed in `f64` from the given floats. That rounds, but monotonically: a box is
//! never farther, as computed, than a point in it, and what the tree skips would not have changed.

mod selecting;
mod tree;

use crate::check;
use crate::error::{Error, Result};
use crate::job::{Context, Progress};
use crate::memory;
use crate::order::Order;
use crate::setters::setters;
use crate::simd::Level;

use selecting::select;

/// The most bytes that a point takes at the peak, and for each of its coordinates; and that a place for a point in the
/// tree takes, of which there are up to twice as many.
const BYTES_PER_POINT: [f64; 2] = [6.0, 4.0];
const BYTES_PER_SLOT: [f64; 2] = [29.0, 8.5];

/// The rule of a selection, and its end.
///
/// | `order` | `radius` | `count` | selected |
/// |---|---|---|---|
/// | any | r | 0 | each point that no selected one of lower index is nearer to than r |
/// | any | 0 or r | n | what the progressive order selects |
/// | any | 0 | 0 | refused |
/// | progressive | 0 | 0 | all points |
/// | progressive | 0 | n | the first n |
/// | progressive | r | 0 | until no point is left that is at least r from all selected ones |
/// | progressive | r | n | until either happens |
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The smallest centre-to-centre distance of selected points; 0 sets none.
    pub radius: f64,
    /// The number of points to select; a cloud that has fewer is selected whole. 0 sets none.
    pub count: usize,
    /// The order of the selected points: any is that of the cloud, where indices ascend; progressive is farthest-first,
    /// where each next point is the farthest from those before, the lowest index on ties.
    pub order: Order,
    /// The seed, which decides the first point of the progressive order, and so all others. Selection by a radius in
    /// any order uses no random numbers.
    pub seed: u64,
}

impl Options {
    /// Points at least `radius` apart, in the order of the cloud.
    pub fn by_radius(radius: f64) -> Self {
        Self { radius, ..Self::default() }
    }

    /// The first `count` points of the progressive order, in the order of the cloud.
    pub fn by_count(count: usize) -> Self {
        Self { count, ..Self::default() }
    }

    /// All points in progressive order.
    pub fn progressive() -> Self {
        Self { order: Order::Progressive, ..Self::default() }
    }

    /// Refuses options out of range.
    fn check(&self) -> Result<()> {
        if self.radius != 0.0 {
            check::radius(self.radius)?;
        } else if self.count == 0 && self.order == Order::Any {
            return Err(Error::invalid("radius", "0, and so is count; give one of them, or ask for progressive order"));
        }
        Ok(())
    }
}

setters!(Options { radius: f64, count: usize, order: Order, seed: u64 });

/// The points of a cloud that are selected.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Selection {
    /// Their indices in the cloud.
    pub indices: Vec<u32>,
    /// In progressive order: the distance of each from the nearest of those before it, rounded down to a float. It
    /// never rises. Infinite for the first point, 0 for points that coincide with one before. Empty in any order.
    ///
    /// The points of ranks of at least r are at least r apart, and every point of the cloud is within the next rank of
    /// one of them, up to the rounding.
    pub ranks: Vec<f32>,
    /// No two selected points are closer: the radius by which they were selected, otherwise the smallest distance of
    /// two. Infinite for less than two points.
    pub radius: f64,
}

/// Selects points of a cloud, in the plane (`D` = 2), in space (3) or with any number of coordinates.
///
/// * [`Options::radius`]: the selected points are at least the radius apart, and every other point is nearer than the
///   radius to one of them. A distance is `sqrt(dx² + dy² + ..)` in `f64` from the given floats, without tolerance.
/// * [`Options::count`]: this many points, by farthest-first selection. Every other point is no farther from one of
///   them than any two of them are apart.
/// * In progressive order all prefixes have these properties.
///
/// Points that coincide are allowed: by radius one of them is selected, farthest-first they come last, with rank 0. The
/// result is the same for every number of threads; the threads share the construction of the tree, the selection itself
/// runs on one thread.
///
/// O(n log n) for n points, whether or not their density varies; O(n · selected) at worst, in clouds made for it, such
/// as a sphere of points around the first. Memory is O(n).
///
/// # Errors
/// [`Error::InvalidArgument`] for an option out of range, and for points that are not finite (`positions`, with the
/// index); [`Error::TooLarge`] for more than 2^32 - 1 points or the available memory; [`Error::Cancelled`].
///
/// ```
/// use azulejo::{Context, thin};
///
/// let cloud = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [1.0, 0.0, 0.0], [0.4, 0.0, 0.0f32]];
/// let context = Context::new(0)?;
/// let apart = thin::thin(&context, &thin::Options::by_radius(0.3), &cloud, None)?;
/// assert_eq!(apart.indices, [0, 2, 3]);
/// let ordered = thin::thin(&context, &thin::Options::progressive(), &cloud, None)?;
/// assert_eq!(ordered.indices.len(), 4);
/// assert!(ordered.ranks.is_sorted_by(|a, b| a >= b));
/// # Ok::<(), azulejo::Error>(())
/// ```
pub fn thin<const D: usize>(
    context: &Context,
    options: &Options,
    positions: &[[f32; D]],
    progress: Option<&Progress>,
) -> Result<Selection> {
    options.check()?;
    let count = positions.len();
    check::indexable("positions", "points", count)?;
    check::finite("positions", "point", positions)?;
    let [point, slot] = [BYTES_PER_POINT, BYTES_PER_SLOT].map(|bytes| bytes[0] + D as f64 * bytes[1]);
    let bytes = count as f64 * point + tree::slots(count) as f64 * slot;
    memory::require(bytes, "positions", &format!("{count} points"))?;
    context.run(progress, |job| {
        if positions.is_empty() {
            return Ok(Selection { indices: Vec::new(), ranks: Vec::new(), radius: f64::INFINITY });
        }
        select(job, Level::widest(), options, positions)
    })
}
