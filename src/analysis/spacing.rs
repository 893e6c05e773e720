//! Spacing: the distances between samples, in `f64` from the floats, around the torus on a periodic domain.

use crate::error::Result;
use crate::grid2::Grid2;
use crate::grid3;
use crate::job::{Context, chunks};
use crate::points::Domain;

/// The distance of each point of the plane to its nearest neighbour; infinite for a point that is alone.
///
/// Takes O(n) for sets without large clusters.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for a domain that is none and for points outside it (`xy`).
pub fn nearest_distances_2d(context: &Context, domain: &Domain, points: &[[f32; 2]]) -> Result<Vec<f64>> {
    domain.check()?;
    domain.check_points(points)?;
    let position = |point: &[f32; 2]| point.map(f64::from);
    let cell_size = (domain.area() / points.len() as f64).sqrt();
    let grid = Grid2::new(*domain, points.iter().map(position), cell_size);
    let chunks = chunks(points.len());
    context.run(None, |job| {
        job.flat_map(chunks.len(), |chunk| {
            let nearest = |i: usize| grid.nearest_squared(position(&points[i]), Some(i as u32)).sqrt();
            chunks.range(chunk).map(nearest).collect()
        })
    })
}

/// The smallest distance between two points of the plane; infinite for less than two points.
///
/// # Errors
/// As [`nearest_distances_2d`].
pub fn smallest_distance_2d(context: &Context, domain: &Domain, points: &[[f32; 2]]) -> Result<f64> {
    Ok(nearest_distances_2d(context, domain, points)?.into_iter().fold(f64::INFINITY, f64::min))
}

/// The smallest distance in units of `d_max = sqrt(2 A / (sqrt(3) N))`, the distance of neighbours in the hexagonal
/// arrangement of as many points: 1 at most on a torus, about 0.77 for maximal Poisson-disk sets, infinite for less than
/// two points.
///
/// # Errors
/// As [`nearest_distances_2d`].
pub fn rho(context: &Context, domain: &Domain, points: &[[f32; 2]]) -> Result<f64> {
    let smallest = smallest_distance_2d(context, domain, points)?;
    Ok(smallest / domain.hexagonal_distance(points.len().max(1)))
}

/// The smallest distance between two points of space; infinite for less than two points.
///
/// Takes O(n log n) for sets that are neither clustered in space nor lined up in planes across their longest extent.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for positions that are not finite (`positions`).
pub fn smallest_distance_3d(context: &Context, positions: &[[f32; 3]]) -> Result<f64> {
    super::check_positions(positions)?;
    context.run(None, |job| grid3::smallest_distance(job, positions))
}
