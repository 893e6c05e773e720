//! Where points have their Delaunay neighbours from.

use crate::geometry::Delaunay;

/// The Delaunay neighbours of all points in one step.
pub(in crate::dcr) enum Neighbours<Mesh> {
    /// In a mesh that is kept from step to step and repaired by flips.
    Kept(Mesh),
    /// In a triangulation built for this step, where no mesh can be kept: sets of a few points, or with large holes.
    Built(Delaunay),
}
