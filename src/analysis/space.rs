//! The figures of a set in a cuboid, measured together.

use crate::analysis::coverage::covering_radius;
use crate::analysis::spacing::nearest_distances;
use crate::check;
use crate::error::Result;
use crate::index::{Entry, SortedGrid};
use crate::job::{Context, Job, Progress, chunks_of};
use crate::memory;
use crate::points::Domain;

/// The points of a task: few, since most may be in one cell of the grid.
const TASK: usize = 256;

/// The most bytes per point.
const BYTES_PER_POINT: f64 = 86.0;

/// The figures of a set in a cuboid, in `f64` from the floats, around the torus on a periodic domain.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SpaceFigures {
    /// The number of points.
    pub count: usize,
    /// The smallest distance of two points; infinite for fewer than two.
    pub smallest: f64,
    /// The mean distance of a point to its nearest neighbour; infinite for fewer than two points.
    pub mean: f64,
    /// `d_max = cbrt(sqrt(2) V / N)`, the distance of neighbours in the densest packing of as many points, face-centred
    /// cubic; infinite for no point.
    pub packed: f64,
    /// The covering radius, as [`covering_radius_3d`](super::coverage::covering_radius_3d) finds it.
    pub covering_radius: f64,
    /// The number of pairs of points that are nearer to each other than the radius asked for.
    pub conflicts: u64,
}

impl SpaceFigures {
    /// The smallest distance in units of `d_max`: 1 at most on a torus, about 0.80 for maximal Poisson-disk sets, infinite
    /// for fewer than two points.
    pub fn rho(&self) -> f64 {
        if self.count == 0 { f64::INFINITY } else { self.smallest / self.packed }
    }

    /// The covering radius in units of `d_max`: `1 / sqrt(2)` for the face-centred lattice, 0.63 for the body-centred one,
    /// which covers best; infinite for no point.
    pub fn relative_covering_radius(&self) -> f64 {
        if self.count == 0 { f64::INFINITY } else { self.covering_radius / self.packed }
    }
}

/// Measures a set in a cuboid. Pairs nearer than `radius` are counted as conflicts, none for 0.
///
/// Takes O(n log n) for sets without large clusters, and O(1) for each conflict.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for an invalid domain, for points outside it (`positions`) and for
/// a `radius` that is negative or not finite;
/// [`Error::TooLarge`](crate::Error::TooLarge) for more points than memory holds;
/// [`Error::Cancelled`](crate::Error::Cancelled).
pub fn figures_3d(
    context: &Context,
    domain: &Domain<3>,
    points: &[[f32; 3]],
    radius: f64,
    progress: Option<&Progress>,
) -> Result<SpaceFigures> {
    check::from_zero("radius", radius)?;
    domain.check_set(points)?;
    memory::require_points("positions", points.len(), BYTES_PER_POINT)?;
    context.run(progress, |job| {
        let nearest = nearest_distances(&job.part(0.0, 0.2), domain, points)?;
        let smallest = nearest.iter().copied().fold(f64::INFINITY, f64::min);
        let mean = nearest.iter().sum::<f64>() / nearest.len() as f64;
        Ok(SpaceFigures {
            count: points.len(),
            smallest,
            mean: if nearest.is_empty() { f64::INFINITY } else { mean },
            packed: domain.packed_distance(points.len()),
            covering_radius: covering_radius(&job.part(0.2, 0.8), domain, points)?,
            conflicts: if smallest < radius { conflicts(&job.part(0.8, 1.0), domain, points, radius)? } else { 0 },
        })
    })
}

/// The number of pairs of which one is nearer to the other than `radius`.
fn conflicts(job: &Job, domain: &Domain<3>, points: &[[f32; 3]], radius: f64) -> Result<u64> {
    let cell_size = domain.cell_side(points.len() as f64).min(radius);
    let grid = SortedGrid::new(*domain, points.iter().map(|point| point.map(f64::from)), cell_size);
    let chunks = chunks_of(points.len(), TASK);
    let counts = job.map(chunks.len(), |chunk| {
        let mut count = 0;
        for &Entry { id, point } in &grid.entries()[chunks.range(chunk)] {
            grid.for_each_within(point, radius, |other, _, squared| {
                count += u64::from(other < id && squared.sqrt() < radius);
            });
        }
        count
    })?;
    Ok(counts.into_iter().sum())
}
