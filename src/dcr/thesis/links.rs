//! The neighbourhoods along which the thesis's forces act.

use glam::DVec2;

/// A constraint between a point and one of its neighbours, as seen from the point.
pub(super) struct Link {
    /// The neighbour, or the point that the neighbour is a copy of.
    pub(super) other: u32,
    /// The offset of the neighbour, in spacings.
    pub(super) offset: DVec2,
    /// Whether the neighbour is in the neighbourhood of the point.
    pub(super) outgoing: bool,
    /// Whether the point is in the neighbourhood of the neighbour.
    pub(super) incoming: bool,
}

/// The neighbours of all points, for one state of the set.
pub(super) trait Links: Sync {
    /// Visits every link of a point, always in the same order.
    fn for_each(&self, point: usize, visit: impl FnMut(Link));
}
