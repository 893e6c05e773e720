//! DCR: relaxation of a point set by distance constraints (thesis ch. 4).
//!
//! All points move at once, by what they gather from their neighbours; nothing depends on the order of the points or on
//! the threads. There are two ways to do so ([`Method`]):
//!
//! * [`Method::Momentum`], the default: neighbours in conflict push each other away, holes pull their borders in, points have
//!   momentum, and long waves of the density are removed by Fourier transform. It ends after 100 steps, or sooner if the
//!   points have come to rest.
//! * [`Method::Thesis`]: what the thesis's algorithm says, with all that it can be varied by.
//!
//! What the best method makes of sets of the unit torus in 100 steps, with Delaunay neighbours (means of 64, 16, 2 and 1 sets;
//! `azulejo-studies dcr` writes `docs/dcr.md`, where there is more). The seeds, from 31,000 on, had not been looked at when
//! the settings were chosen. rho is the smallest, cover the largest distance in `d_max`; ψ6 is the
//! [bond order](crate::analysis::bonds), 0.36 in random sets; P is the mean power below a quarter of sqrt(density).
//!
//! | points | start | rho | cover | ψ6 | P | obtuse | edge CV² |
//! |---|---|---|---|---|---|---|---|
//! | 1,000 | random | 0.862 | 0.660 | 0.460 | 5.1e-6 | 5.5 % | 0.0177 |
//! | 1,000 | KDRT | 0.862 | 0.660 | 0.462 | 5.0e-6 | 5.5 % | 0.0176 |
//! | 4,096 | random | 0.861 | 0.660 | 0.462 | 4.8e-6 | 5.6 % | 0.0177 |
//! | 4,096 | KDRT | 0.862 | 0.660 | 0.464 | 5.1e-6 | 5.3 % | 0.0175 |
//! | 65,536 | random | 0.860 | 0.661 | 0.463 | 4.2e-6 | 5.4 % | 0.0177 |
//! | 65,536 | KDRT | 0.861 | 0.661 | 0.464 | 3.5e-6 | 5.4 % | 0.0177 |
//! | 1,000,000 | random | 0.856 | 0.664 | 0.463 | 4.7e-6 | 5.4 % | 0.0177 |
//! | 1,000,000 | KDRT | 0.860 | 0.662 | 0.466 | 3.8e-6 | 5.3 % | 0.0176 |
//! | | push-pull (Ahmed et al. 2016) | 0.850 | 0.670 | 0.475 | 2.2e-3 | 5.9 % | 0.019 |
//!
//! These are means: single sets of 1,000 points may have more obtuse triangles than push-pull's.
//!
//! Bounded domains are relaxed nearly as well: rho 0.851 to 0.860, cover 0.662 to 0.667. Density and spacing of the strip along
//! the border, one `d_max` wide, are those of the inside within 3 %; the next strip is 11 % denser (section "Bounded" there).
//!
//! Samples of a mesh are relaxed on it by [`surface`].
//!
//! Convergence is judged by motion ([`Report::motion`]), unless [`Convergence::Variance`] asks for the thesis's own test.

mod density;
mod ground;
pub mod surface;
mod thesis;
mod uniform;

pub use density::{Density, DensityFunction, relax_with_density, scatter};
use thesis::Tensioned;
pub use thesis::{Convergence, Distribution, Thesis, Visits};
use uniform::Spread;

use crate::error::{Error, Result};
use crate::geometry::grid2::Grid2;
use crate::job::{Context, Job, Progress, chunks};
use crate::memory;
use crate::points::Domain;
use crate::setters::setters;

/// Who is a neighbour of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Neighbourhood {
    /// Its neighbours in the Delaunay triangulation: they keep their distance and close holes (§4.3.3).
    Delaunay,
    /// Its nearest points: they only repel (§4.3.4). The smallest distance gets larger than with Delaunay neighbours, and
    /// so do the holes.
    Nearest,
}

/// How points are moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Push, pull, momentum and waves; see the page of this module.
    Momentum,
    /// The algorithm of the thesis.
    Thesis(Thesis),
}

/// The options of [`relax`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The rectangle in which the points lie and stay.
    pub domain: Domain,
    /// Who is a neighbour of whom.
    pub neighbourhood: Neighbourhood,
    /// How points are moved.
    pub method: Method,
    /// The largest number of steps. 0 returns the points as they are.
    pub max_iterations: u32,
    /// Where points of degenerate sets are moved; used for nothing else.
    pub seed: u64,
    /// The motion ([`Report::motion`]) at which the set has converged, if the constraints are kept ([`Stopped::Converged`]);
    /// 0 makes all steps unless nothing moves at all.
    /// [`Convergence::Variance`] does not ask for it.
    pub tolerance: f64,
}

impl Options {
    /// The best method: at most 100 steps, tolerance 0.001.
    pub fn new(domain: Domain, neighbourhood: Neighbourhood) -> Self {
        Self { domain, neighbourhood, method: Method::Momentum, max_iterations: 100, seed: 0, tolerance: 0.001 }
    }

    /// The thesis's algorithm with its settings: at most 1000 steps. The tolerance is 0.02 for Delaunay and 0.005 for
    /// nearest neighbours, which are slower to spread and do not jitter. Activeness keeps Delaunay neighbourhoods moving
    /// by 0.01 for ever, so lower values are reached only by constant distributions.
    pub fn thesis(domain: Domain, neighbourhood: Neighbourhood) -> Self {
        let tolerance = match neighbourhood {
            Neighbourhood::Delaunay => 0.02,
            Neighbourhood::Nearest => 0.005,
        };
        let method = Method::Thesis(Thesis::default());
        Self { domain, neighbourhood, method, max_iterations: 1000, seed: 0, tolerance }
    }

    fn check(&self) -> Result<()> {
        self.domain.check()?;
        if let Method::Thesis(thesis) = &self.method {
            thesis.check()?;
        }
        if !(0.0..).contains(&self.tolerance) {
            return Err(Error::invalid("tolerance", format!("{} is not at least 0", self.tolerance)));
        }
        Ok(())
    }
}

setters!(Options {
    domain: Domain,
    neighbourhood: Neighbourhood,
    method: Method,
    max_iterations: u32,
    seed: u64,
    tolerance: f64,
});

/// Why [`relax`] made no more steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stopped {
    /// The set converged, or there was nothing to move. With the best method and Delaunay neighbours no points are closer
    /// than 0.85 `d_max` then, nor a circumradius above 0.67 `d_max`, up to the last step.
    Converged,
    /// All steps were made.
    Steps,
    /// The caller cancelled.
    Cancelled,
}

/// What [`relax`] did. `d_max` is [`Domain::hexagonal_distance`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// The number of steps made.
    pub iterations: u32,
    /// Why there were no more.
    pub stopped: Stopped,
    /// Half of how far points got over the last span of steps, or since the start if it was shorter: root mean square, in
    /// units of `d_max`. A span is 10 steps, or in the thesis's method the steps whose λ add up to 2, so that the motion
    /// is per unit of λ: the same for small and large steps at the same state.
    pub motion: f64,
    /// The smallest distance between two of the returned points, in the units of the domain, around the torus on a
    /// periodic domain; infinite for less than two points.
    pub smallest_distance: f64,
    /// The smallest distance in units of `d_max`; at most 1 on a torus; infinite for less than two points.
    pub rho: f64,
    /// The largest distance of a place in the domain from the set, in units of `d_max`, up to the rounding of the returned
    /// floats; infinite for no point.
    pub coverage: f64,
}

/// A set in the making.
trait Relaxation {
    /// Moves all points. If it is cancelled, all have moved or none.
    fn step(&mut self, job: &Job) -> Result<()>;

    /// The number of steps made.
    fn iterations(&self) -> u32;

    /// [`Report::motion`].
    fn motion(&self) -> f64;

    /// Whether there was a whole span, and no more motion in the last than this.
    fn has_settled(&self, tolerance: f64) -> bool;

    /// Goes back to the best state so far, if that is not the last.
    fn finish(&mut self, _: &Job) -> Result<()> {
        Ok(())
    }

    /// The points in the user's order; `points` is what they were.
    fn points(&self, points: &[[f32; 2]]) -> Vec<[f32; 2]>;

    /// [`Report::rho`] of these points, if it is not simply the smallest distance in units of `d_max`.
    fn relative_spacing(&self, _job: &Job, _points: &[[f32; 2]]) -> Result<Option<f64>> {
        Ok(None)
    }

    /// The largest distance from the set, in units of the domain; if the spacing varies, as large as it would be at the
    /// mean spacing.
    fn coverage(&mut self, job: &Job) -> Result<f64>;
}

/// Relaxes a set of points of the domain: returns as many points, in the same order, spread more evenly.
///
/// The result is the same for every number of threads and every order of calls; the points stay in
/// `min <= x < max`, around the torus or held back by the border. An empty set and a single point are returned as they
/// are. Coincident points, and all points of a set on one line, are first moved by 0.001 to 0.002 `d_max` in
/// directions keyed by `seed` and index: the forces alone would not lead them apart.
///
/// The best method with Delaunay neighbours returns, of the states after whole steps and the set as it came, the one in which
/// the fewest points have a neighbour closer than 0.85 `d_max` or a triangle whose circumradius is above 0.67 `d_max`; of
/// several, the last. All else returns the set after the last whole step. So does a call that is cancelled, with
/// [`Stopped::Cancelled`].
///
/// Each step is O(n), but O(n log n) where a Delaunay triangulation is built anew: by the thesis's method, and by the best
/// one in sets of a few points, with holes as wide as the domain, or with points that have dozens of neighbours. A bounded
/// domain costs up to four times the time and memory of a periodic one, as the best method works on it and its mirror
/// images. Memory is O(n).
///
/// # Errors
/// [`Error::InvalidArgument`] for options out of their range and for points outside the domain or not finite (`xy`,
/// with index and value), [`Error::TooLarge`] for more than 2^32 - 1 points.
pub fn relax(
    context: &Context,
    options: &Options,
    points: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<(Vec<[f32; 2]>, Report)> {
    relax_observed(context, options, points, progress, None)
}

/// Shown the points after a step, in the user's order.
pub type Observer<'a> = dyn FnMut(&[[f32; 2]]) + 'a;

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
    let mut set: Box<dyn Relaxation> = match &options.method {
        Method::Momentum => Box::new(Spread::new(options, points)),
        Method::Thesis(thesis) => Box::new(Tensioned::new(options, thesis, points)),
    };
    run(context, options, points, &mut *set, progress, observe)
}

/// Memory for a point or a sample and all that is known of it, at the peak.
const BYTES_PER_POINT: f64 = 300.0;

/// Refuses more points than memory holds.
fn require_memory(argument: &'static str, count: usize) -> Result<()> {
    memory::require(BYTES_PER_POINT * count as f64, argument, &format!("{count} points"))
}

/// Makes the steps of a set, measures what they made of it, and lets a cancelled call end well.
fn run(
    context: &Context,
    options: &Options,
    points: &[[f32; 2]],
    set: &mut dyn Relaxation,
    progress: Option<&Progress>,
    observe: Option<&mut Observer>,
) -> Result<(Vec<[f32; 2]>, Report)> {
    let relaxed = context.run(progress, |job| {
        let stopped = make_steps(&job.part(0.0, 0.98), options, points, set, observe)?;
        measure(&job.part(0.98, 1.0), options, points, set, stopped)
    });
    match relaxed {
        // What there is after the last whole step is measured without further questions.
        Err(Error::Cancelled) => context.run(None, |job| measure(job, options, points, set, Stopped::Cancelled)),
        relaxed => relaxed,
    }
}

/// Steps until the motion ends or the steps do.
fn make_steps(
    job: &Job,
    options: &Options,
    points: &[[f32; 2]],
    set: &mut dyn Relaxation,
    mut observe: Option<&mut Observer>,
) -> Result<Stopped> {
    if points.len() < 2 {
        return Ok(Stopped::Converged);
    }
    let share = |iteration: u32| f64::from(iteration) / f64::from(options.max_iterations);
    for iteration in 0..options.max_iterations {
        set.step(&job.part(share(iteration), share(iteration + 1)))?;
        if let Some(observe) = &mut observe {
            observe(&set.points(points));
        }
        if set.has_settled(options.tolerance) {
            return Ok(Stopped::Converged);
        }
    }
    Ok(Stopped::Steps)
}

/// The points as they are, and what they are like.
fn measure(
    job: &Job,
    options: &Options,
    points: &[[f32; 2]],
    set: &mut dyn Relaxation,
    stopped: Stopped,
) -> Result<(Vec<[f32; 2]>, Report)> {
    set.finish(&job.part(0.0, 0.2))?;
    let relaxed = if set.iterations() > 0 { set.points(points) } else { points.to_vec() };
    let smallest_distance = smallest_distance(&job.part(0.2, 0.4), &options.domain, &relaxed)?;
    let relative_spacing = set.relative_spacing(&job.part(0.4, 0.6), &relaxed)?;
    let coverage = if points.is_empty() { f64::INFINITY } else { set.coverage(&job.part(0.6, 1.0))? };
    let unit = options.domain.hexagonal_distance(points.len().max(1));
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
