//! What a relaxation in the plane reports.

use crate::dcr::relaxation::Relaxation;
use crate::error::Result;
use crate::index::Grid2;
use crate::job::{Job, chunks};
use crate::points::Domain;

/// Why a relaxation made no more steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stopped {
    /// The set converged, or there was nothing to move. With the momentum method and Delaunay neighbours no points are
    /// then closer than 0.85 `d_max` and no circumradius is above 0.67 `d_max`, up to the last step.
    Converged,
    /// All steps were made.
    Steps,
    /// The caller cancelled.
    Cancelled,
}

/// What [`relax`](fn@super::relax) did. `d_max` is [`Domain::hexagonal_distance`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// The number of steps made.
    pub iterations: u32,
    /// Why there were no more.
    pub stopped: Stopped,
    /// Half of the distance that points covered in the last span of steps, or since the start if that was shorter: root
    /// mean square, in units of `d_max`. A span is 10 steps, or in the thesis's method the steps whose λ add up to 2, so
    /// that the motion is per unit of λ: the same for small and large steps at the same state.
    pub motion: f64,
    /// The smallest distance between two of the returned points, in the units of the domain, around the torus on a
    /// periodic domain; infinite for less than two points.
    pub smallest_distance: f64,
    /// The smallest distance in units of `d_max`; at most 1 on a torus; infinite for less than two points.
    pub rho: f64,
    /// The largest distance of a position in the domain from the set, in units of `d_max`, up to the rounding of the
    /// returned floats; infinite for no point.
    pub coverage: f64,
}

/// The points as they are, and their report.
pub(super) fn measure(
    job: &Job,
    domain: &Domain,
    points: &[[f32; 2]],
    set: &mut dyn Relaxation,
    stopped: Stopped,
) -> Result<(Vec<[f32; 2]>, Report)> {
    set.finish(&job.part(0.0, 0.2))?;
    let relaxed = if set.iterations() > 0 { set.points(points) } else { points.to_vec() };
    let smallest_distance = smallest_distance(&job.part(0.2, 0.4), domain, &relaxed)?;
    let relative_spacing = set.relative_spacing(&job.part(0.4, 0.6), &relaxed)?;
    let coverage = if points.is_empty() { f64::INFINITY } else { set.coverage(&job.part(0.6, 1.0))? };
    let unit = domain.hexagonal_distance(points.len().max(1));
    let report = Report {
        iterations: set.iterations(),
        stopped,
        motion: if set.iterations() > 0 { set.motion() } else { 0.0 },
        smallest_distance,
        rho: relative_spacing.unwrap_or(smallest_distance / unit),
        coverage: coverage / unit,
    };
    Ok((relaxed, report))
}

/// The smallest distance between two points, in `f64` from the floats.
fn smallest_distance(job: &Job, domain: &Domain, points: &[[f32; 2]]) -> Result<f64> {
    let position = |point: &[f32; 2]| point.map(f64::from);
    let grid = Grid2::new(*domain, points.iter().map(position), domain.hexagonal_distance(points.len()));
    let chunks = chunks(points.len());
    let nearest = job.map(chunks.len(), |chunk| {
        let squared = |i: usize| grid.nearest_squared(position(&points[i]), Some(i as u32));
        chunks.range(chunk).map(squared).fold(f64::INFINITY, f64::min)
    })?;
    Ok(nearest.into_iter().fold(f64::INFINITY, f64::min).sqrt())
}
