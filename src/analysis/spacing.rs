//! Spacing: the distances between samples, in `f64` from the floats, around the torus on a periodic domain.

use crate::analysis::distribution::check_bins;
use crate::check;
use crate::error::Result;
use crate::index::{SortedGrid, smallest_distance};
use crate::job::{Context, Job, Progress, chunks_of};
use crate::memory;
use crate::points::Domain;

/// The points of a task: so few that a call can be cancelled soon even where most points are in one cell of the grid.
const TASK: usize = 256;

/// The most bytes per point of the plane, with its distance, and per point of space.
const BYTES_PER_POINT: f64 = 46.0;
const BYTES_PER_POINT_OF_SPACE: f64 = 28.0;

/// The distance of each point of the plane to its nearest neighbour; infinite for a point that is alone.
///
/// Takes O(n) for sets without large clusters.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for an invalid domain and for points outside it (`positions`);
/// [`Error::TooLarge`](crate::Error::TooLarge) for more points than memory holds;
/// [`Error::Cancelled`](crate::Error::Cancelled).
pub fn nearest_distances_2d(
    context: &Context,
    domain: &Domain,
    points: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<Vec<f64>> {
    domain.check_set(points)?;
    memory::require_points("positions", points.len(), BYTES_PER_POINT)?;
    context.run(progress, |job| nearest_distances(job, domain, points))
}

/// The distances of points of the plane or of a cuboid, which have been checked, to their nearest neighbours.
pub(super) fn nearest_distances<const D: usize>(
    job: &Job,
    domain: &Domain<D>,
    points: &[[f32; D]],
) -> Result<Vec<f64>> {
    let position = |point: &[f32; D]| point.map(f64::from);
    let cell_size = domain.cell_side(points.len() as f64);
    let grid = SortedGrid::new(*domain, points.iter().map(position), cell_size);
    let chunks = chunks_of(points.len(), TASK);
    job.flat_map(chunks.len(), |chunk| {
        let nearest = |i: usize| grid.nearest_squared(position(&points[i]), Some(i as u32)).sqrt();
        chunks.range(chunk).map(nearest).collect()
    })
}

/// The smallest distance between two points of the plane; infinite for fewer than two points.
///
/// # Errors
/// As [`nearest_distances_2d`].
pub fn smallest_distance_2d(
    context: &Context,
    domain: &Domain,
    points: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<f64> {
    Ok(nearest_distances_2d(context, domain, points, progress)?.into_iter().fold(f64::INFINITY, f64::min))
}

/// The smallest distance in units of `d_max = sqrt(2 A / (sqrt(3) N))`, the distance of neighbours in the hexagonal
/// arrangement of as many points: 1 at most on a torus, about 0.77 for maximal Poisson-disk sets, infinite for fewer
/// than two points.
///
/// # Errors
/// As [`nearest_distances_2d`].
pub fn rho(context: &Context, domain: &Domain, points: &[[f32; 2]], progress: Option<&Progress>) -> Result<f64> {
    let smallest = smallest_distance_2d(context, domain, points, progress)?;
    Ok(smallest / domain.hexagonal_distance(points.len().max(1)))
}

/// The distances of the points of a set to their nearest neighbours, in three numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Spacing {
    /// The smallest; infinite for fewer than two points.
    pub smallest: f64,
    /// The mean; infinite for fewer than two points.
    pub mean: f64,
    /// `d_max = sqrt(2 A / (sqrt(3) N))`, the distance of neighbours in the hexagonal arrangement of as many points:
    /// [`rho`] is `smallest / hexagonal`. Infinite for no point.
    pub hexagonal: f64,
}

/// Sums up the [`nearest_distances_2d`] of a set. The mean is 0.465 `hexagonal` for a Poisson process, 1 for a
/// hexagonal lattice.
pub fn spacing_2d(domain: &Domain, nearest: &[f64]) -> Spacing {
    let mean = if nearest.is_empty() { f64::INFINITY } else { nearest.iter().sum::<f64>() / nearest.len() as f64 };
    let smallest = nearest.iter().copied().fold(f64::INFINITY, f64::min);
    Spacing { smallest, mean, hexagonal: domain.hexagonal_distance(nearest.len()) }
}

/// The histogram of the [`nearest_distances_2d`] of a set: the number in each of `bins` bins of equal width from 0 to
/// `reach`, in units of `d_max`. Distances of that length and above are in no bin. Histograms of several sets add up.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for `bins` outside of 1 to
/// [`MAX_BINS`](super::distribution::MAX_BINS), and for a `reach` that is not a positive finite number.
pub fn nearest_histogram_2d(domain: &Domain, nearest: &[f64], reach: f64, bins: usize) -> Result<Vec<u64>> {
    check_bins(reach, bins)?;
    let per_length = bins as f64 / (reach * domain.hexagonal_distance(nearest.len().max(1)));
    let mut histogram = vec![0; bins];
    for distance in nearest {
        let bin = distance * per_length;
        if bin < bins as f64 {
            histogram[bin as usize] += 1;
        }
    }
    Ok(histogram)
}

/// The smallest distance between two points of space; infinite for fewer than two points.
///
/// Takes O(n log n) for sets that are neither clustered in space nor lined up in planes across their longest extent.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for positions that are not finite (`positions`);
/// [`Error::TooLarge`](crate::Error::TooLarge) for more points than memory holds;
/// [`Error::Cancelled`](crate::Error::Cancelled).
pub fn smallest_distance_3d(context: &Context, positions: &[[f32; 3]], progress: Option<&Progress>) -> Result<f64> {
    check::finite("positions", "position", positions)?;
    memory::require_points("positions", positions.len(), BYTES_PER_POINT_OF_SPACE)?;
    context.run(progress, |job| smallest_distance(job, positions))
}
