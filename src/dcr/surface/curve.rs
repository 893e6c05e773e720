//! A Z-curve through the bounds of a mesh: what is close on the surface is mostly close along it.

use crate::dcr::surface::walk::SurfacePoint;
use crate::index::curve::{SPACE_BITS, morton3, sorted};
use crate::mesh::{Mesh, exact};

/// The places of points along the curve, in order, with the points' numbers.
pub(super) fn along_curve(mesh: &Mesh, points: &[SurfacePoint]) -> Vec<(u64, u32)> {
    let (low, high) = mesh.bounds();
    let extent = (exact(high) - exact(low)).max_element().max(f64::MIN_POSITIVE);
    let last = f64::from((1u32 << SPACE_BITS) - 1);
    sorted(points.iter().map(|point| {
        let place = (point.position(mesh) - exact(low)) / extent * last;
        morton3(place.to_array().map(|x| x as u32))
    }))
}
