//! Which points are the neighbours of a point.

/// Which points are the neighbours of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Neighbourhood {
    /// Its neighbours in the Delaunay triangulation: they keep their distance and close holes (§4.3.3).
    Delaunay,
    /// Its nearest points: they only repel (§4.3.4). The smallest distance gets larger than with Delaunay neighbours,
    /// and so do the holes.
    Nearest,
}
