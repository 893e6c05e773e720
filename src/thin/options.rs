//! The options of thinning, and what it returns.

use crate::error::{Error, Result};
use crate::order::Order;
use crate::points::check_radius;
use crate::setters::setters;

/// How to thin, and when to stop.
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
    /// The order of what is selected: any is that of the cloud, where indices ascend; progressive is farthest-first, where
    /// each next point is the farthest from those before, the lowest index on ties.
    pub order: Order,
    /// Which point is the first of the progressive order, and with it which others follow. Selection by a radius in any
    /// order uses no random numbers.
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

    /// Refuses what is out of its range.
    pub(super) fn check(&self) -> Result<()> {
        if self.radius != 0.0 {
            check_radius(self.radius)?;
        } else if self.count == 0 && self.order == Order::Any {
            return Err(Error::invalid("radius", "0, as is count; any order needs one of them to stop at"));
        }
        Ok(())
    }
}

setters!(Options { radius: f64, count: usize, order: Order, seed: u64 });

/// The points of a cloud that are selected.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Selection {
    /// Their indices in the cloud.
    pub indices: Vec<u32>,
    /// In progressive order: the distance of each from the nearest of those before it, rounded down to a float. It never
    /// rises. Infinite for the first point, 0 for points that coincide with one before. Empty in any order.
    ///
    /// The points of ranks of at least r are at least r apart, and every point of the cloud is within the next rank of
    /// one of them, up to the rounding.
    pub ranks: Vec<f32>,
}
