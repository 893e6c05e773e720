//! Relaxation in the plane: the call at a constant density, and the parts shared by all calls in the plane.

use crate::dcr::options::{Method, Options};
use crate::dcr::relaxation::{Limits, Relaxation, Steps, Stopped, run};
use crate::dcr::thesis::ThesisRelaxation;
use crate::dcr::uniform::UniformRelaxation;
use crate::error::Result;
use crate::index::Grid2;
use crate::job::{Context, Job, Progress, chunks};
use crate::memory;
use crate::points::Domain;

/// Receives the points after a step, in the user's order.
pub type Observer<'a> = dyn FnMut(&[[f32; 2]]) + 'a;

/// The report of [`relax`](fn@super::relax). `d_max` is [`Domain::hexagonal_distance`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// The number of steps made.
    pub iterations: u32,
    /// The reason why the steps ended.
    pub stopped: Stopped,
    /// Half of the distance that points covered in the last span of steps, or since the start if that was shorter: root
    /// mean square, in units of `d_max`. A span is 10 steps, or in the thesis's method the steps whose λ add up to 2,
    /// so that the motion is per unit of λ: the same for small and large steps at the same state.
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

/// Relaxes a set of points of the domain: returns as many points, in the same order, spread more evenly.
///
/// The result is the same for every number of threads and every order of calls; the points stay in `min <= x < max`,
/// wrapped around the torus or held back by the boundary. An empty set and a single point are returned unchanged.
/// Coincident points, and all points of a set on one line, are first moved by 0.001 to 0.002 `d_max` in directions
/// keyed by `seed` and index: the forces alone would not separate them.
///
/// The momentum method levels a clustered set before the first step: one in which points are crowded in some places and
/// missing in others, as in a corner, on a line, at a single place. It is spread by the long waves of its density, as
/// smoothly as possible, in up to 24 passes that take about the time of a step each. So any set ends with the figures
/// of a random one, and in about the same time. Uniform random sets are not clustered, except on domains that are very
/// long for their width. A call that makes all of its steps succeeds whatever the quality reached, which is in the
/// report.
///
/// The momentum method with Delaunay neighbours returns, of the set before the first step and the states after whole
/// steps, the one in which the fewest points have a neighbour closer than 0.85 `d_max` or a triangle whose circumradius
/// is above 0.67 `d_max`; of several, the last. In all other cases the set after the last whole step is returned. A
/// call that is cancelled returns the same, with [`Stopped::Cancelled`](super::Stopped::Cancelled).
///
/// Each step is O(n) for sets without dense clusters, but O(n log n) where a Delaunay triangulation is built anew:
/// always by the thesis's method, and by the momentum method in sets of a few points, with holes as wide as the domain,
/// or with points that have dozens of neighbours. A bounded domain costs up to four times the time and memory of a
/// periodic one, as the momentum method works on it and its mirror images. Memory is O(n).
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for options out of their range and for points outside the
/// domain or not finite (`xy`, with index and value), [`Error::TooLarge`](crate::Error::TooLarge) for more than
/// 2^32 - 1 points.
pub fn relax(
    context: &Context,
    options: &Options,
    points: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<(Vec<[f32; 2]>, Report)> {
    relax_observed(context, options, points, progress, None)
}

/// As [`relax`], and calls `observe` after every step, on the calling thread.
///
/// # Errors
/// As [`relax`].
pub fn relax_observed(
    context: &Context,
    options: &Options,
    points: &[[f32; 2]],
    progress: Option<&Progress>,
    observe: Option<&mut Observer>,
) -> Result<(Vec<[f32; 2]>, Report)> {
    options.check()?;
    options.domain.check_points(points)?;
    require_memory("xy", points.len())?;
    let Options { domain, neighbourhood, seed, .. } = *options;
    match &options.method {
        Method::Momentum => {
            let mut set = UniformRelaxation::new(domain, neighbourhood, seed, points);
            relax_set(context, options, points, &mut set, progress, observe)
        }
        Method::Thesis(thesis) => {
            let mut set = ThesisRelaxation::new(domain, neighbourhood, thesis, seed, points);
            relax_set(context, options, points, &mut set, progress, observe)
        }
    }
}

/// A set in the plane, for its report.
pub trait PlaneRelaxation: Relaxation {
    /// The points in the user's order; `points` are those with which it began.
    fn points(&self, points: &[[f32; 2]]) -> Vec<[f32; 2]>;

    /// [`Report::rho`] of these points, if it is not simply the smallest distance in units of `d_max`.
    fn relative_spacing(&self, _job: &Job, _points: &[[f32; 2]]) -> Result<Option<f64>> {
        Ok(None)
    }

    /// The largest distance from the set, in units of the domain; if the spacing varies, as large as it would be at the
    /// mean spacing.
    fn coverage(&mut self, job: &Job) -> Result<f64>;
}

/// Makes the steps of a set of the plane and measures the result.
pub fn relax_set<R: PlaneRelaxation>(
    context: &Context,
    options: &Options,
    points: &[[f32; 2]],
    set: &mut R,
    progress: Option<&Progress>,
    mut observe: Option<&mut Observer>,
) -> Result<(Vec<[f32; 2]>, Report)> {
    let limits = Limits { max_iterations: options.max_iterations, tolerance: options.tolerance };
    let observe = |set: &R| {
        if let Some(observe) = &mut observe {
            observe(&set.points(points));
        }
    };
    run(context, limits, set, progress, observe, |job, set, steps| measure(job, &options.domain, points, set, steps))
}

/// The current points and their report.
pub fn measure(
    job: &Job,
    domain: &Domain,
    points: &[[f32; 2]],
    set: &mut impl PlaneRelaxation,
    Steps { iterations, stopped, motion }: Steps,
) -> Result<(Vec<[f32; 2]>, Report)> {
    let relaxed = if iterations > 0 { set.points(points) } else { points.to_vec() };
    let smallest_distance = smallest_distance(&job.part(0.0, 0.25), domain, &relaxed)?;
    let relative_spacing = set.relative_spacing(&job.part(0.25, 0.5), &relaxed)?;
    let coverage = if points.is_empty() { f64::INFINITY } else { set.coverage(&job.part(0.5, 1.0))? };
    let unit = domain.hexagonal_distance(points.len().max(1));
    let report = Report {
        iterations,
        stopped,
        motion,
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

/// The peak memory for a point or a sample and all of its data.
const BYTES_PER_POINT: f64 = 300.0;

/// Refuses more points than fit in memory.
pub fn require_memory(argument: &'static str, count: usize) -> Result<()> {
    memory::require(BYTES_PER_POINT * count as f64, argument, &format!("{count} points"))
}
