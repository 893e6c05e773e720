//! What a neighbourhood offers to the forces.

use glam::DVec2;

/// A constraint between a point and one of its neighbours, as the point sees it.
pub(crate) struct Link {
    /// The neighbour, or the point that the neighbour is a copy of.
    pub(crate) other: u32,
    /// The way to the neighbour, in spacings.
    pub(crate) offset: DVec2,
    /// Whether the neighbour is in the neighbourhood of the point.
    pub(crate) outgoing: bool,
    /// Whether the point is in the neighbourhood of the neighbour.
    pub(crate) incoming: bool,
}

/// Who is a neighbour of whom, for one state of the points.
pub(crate) trait Links: Sync {
    /// Visits every link of a point, always in the same order.
    fn for_each(&self, point: usize, visit: impl FnMut(Link));
}
