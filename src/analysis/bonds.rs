//! Bond order: how far the directions to the neighbours of a point agree on a hexagonal lattice.

use glam::DVec2;

use crate::analysis::BYTES_PER_TRIANGULATED_POINT;
use crate::error::Result;
use crate::geometry::{Delaunay, Frame};
use crate::job::{Context, Job, Progress, chunks};
use crate::math::{atan2, direction};
use crate::memory;
use crate::points::Domain;

/// The bond order ψ6 of a set (Nelson and Halperin 1979, "Dislocation-mediated melting in two dimensions"): the mean
/// over all points of |Σ exp(6iθ)| / n, θ being the directions of the n edges of a point in the Delaunay triangulation.
///
/// 1 in a hexagonal lattice of any orientation, about 0.36 in a Poisson process. The mean is one of local orders: many
/// small crystals are as regular as one. A bounded domain is mirrored by its boundary, and mirror images are
/// neighbours. Points without neighbours, as all but one of coincident points are, do not count; 0 if there are no
/// others. Lattices with more than three points on an empty circle have more than one triangulation, and the result is
/// that of one.
///
/// Takes O(n log n).
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for an invalid domain and for points outside it (`positions`);
/// [`Error::TooLarge`](crate::Error::TooLarge) for more points than memory holds;
/// [`Error::Cancelled`](crate::Error::Cancelled).
pub fn bond_order(context: &Context, domain: &Domain, points: &[[f32; 2]], progress: Option<&Progress>) -> Result<f64> {
    domain.check_set(points)?;
    if points.is_empty() {
        return Ok(0.0);
    }
    memory::require_points("positions", points.len(), BYTES_PER_TRIANGULATED_POINT)?;
    let frame = Frame::new(*domain, points.len());
    context.run(progress, |job| {
        let delaunay = Delaunay::new(&job.part(0.0, 0.8), &frame, frame.enter(points).into_iter())?;
        mean_order(&job.part(0.8, 1.0), &delaunay)
    })
}

/// The bond order of a set by its triangulation.
pub(super) fn mean_order(job: &Job, delaunay: &Delaunay) -> Result<f64> {
    let chunks = chunks(delaunay.len());
    let orders: Vec<f64> = job.flat_map(chunks.len(), |chunk| {
        chunks.range(chunk).filter_map(|point| order(delaunay.ring(point))).collect()
    })?;
    Ok(orders.iter().sum::<f64>() / orders.len().max(1) as f64)
}

/// The order of a point by the offsets of its neighbours.
fn order(ring: impl Iterator<Item = DVec2>) -> Option<f64> {
    let add =
        |(sum, count): (DVec2, f64), offset: DVec2| (sum + direction(6.0 * atan2(offset.y, offset.x)), count + 1.0);
    let (sum, count) = ring.fold((DVec2::ZERO, 0.0), add);
    (count > 0.0).then(|| sum.length() / count)
}
