//! The integer lattice of a projector, on which all is exact.

use glam::DVec3;

use crate::mesh::{Mesh, exact};
use crate::psp::project::projector::Projector;

/// No coordinate is this large: products of coordinates, and sums of a few of them, are `i64`.
pub(super) const END: i64 = 1 << 30;

/// A point on a projector, in units of its lattice.
pub(super) type LatticePoint = [i64; 2];

/// By how much rounding can move a point against the boundary of its cell or tile, in units of the lattice, and some more.
pub(super) const MARGIN: f64 = 2.0;

/// How a mesh is seen on a projector.
pub(super) struct ProjectorLattice {
    centre: DVec3,
    per_radius: f64,
    /// Half the width of a projector, in radii.
    pub reach: f64,
    /// Units of the lattice in a radius.
    pub units: f64,
}

impl ProjectorLattice {
    /// The lattice of projectors that extend to `reach`, in radii from the centre of the mesh.
    pub fn new(mesh: &Mesh, radius: f64, reach: f64) -> Self {
        let (low, high) = mesh.bounds();
        let centre = 0.5 * (exact(low) + exact(high));
        Self { centre, per_radius: 1.0 / radius, reach, units: 0.5 * END as f64 / reach }
    }

    /// The corners of a triangle as seen from the centre of the mesh, in radii.
    pub fn corners(&self, mesh: &Mesh, triangle: u32) -> [DVec3; 3] {
        mesh.corners(triangle).map(|corner| (exact(corner) - self.centre) * self.per_radius)
    }

    /// Corners on a projector.
    pub fn see(&self, projector: &Projector, corners: &[DVec3; 3]) -> [LatticePoint; 3] {
        corners.map(|corner| self.round([projector.right.dot(corner), projector.up.dot(corner)]))
    }

    /// The place on the lattice of a point on a projector, in radii from its centre.
    pub fn round(&self, point: [f64; 2]) -> LatticePoint {
        // None is below zero, where truncation would round up.
        point.map(|x| ((x + self.reach) * self.units) as i64)
    }
}

/// The least and the largest coordinate of a triangle on an axis.
pub(super) fn extent(corners: &[LatticePoint; 3], axis: usize) -> [f64; 2] {
    let [a, b, c] = corners.map(|corner| corner[axis]);
    [a.min(b).min(c), a.max(b).max(c)].map(|x| x as f64)
}

/// The least and the largest x of the part of a triangle between two heights, of which there is some.
pub(super) fn extent_between(corners: &[LatticePoint; 3], low: f64, high: f64) -> [f64; 2] {
    let corners = corners.map(|corner| corner.map(|x| x as f64));
    let mut extent = [f64::INFINITY, f64::NEG_INFINITY];
    for i in 0..3 {
        let ([p, q], [r, s]) = (corners[i], corners[(i + 1) % 3]);
        let ends = [low, high].map(|y| y.clamp(q.min(s), q.max(s)));
        if ends[0] <= high && ends[1] >= low {
            for y in ends {
                let x = if q == s { p } else { p + (r - p) * ((y - q) / (s - q)) };
                extent = [extent[0].min(x), extent[1].max(x)];
            }
            if q == s {
                extent = [extent[0].min(r), extent[1].max(r)];
            }
        }
    }
    extent
}
