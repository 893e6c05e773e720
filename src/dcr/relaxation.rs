//! The frame of all relaxations, in the plane and on surfaces: one loop of steps, one test of convergence.
//!
//! A [`Relaxation`] is a set with its law of motion. All else is here: the number of steps, the measure of motion, the
//! report, and the success of cancelled calls.
//!
//! The thesis's test of convergence (`thesis/mod.rs`) depends on the step size and fires early: halving λ halves the
//! change per step. Motion per step does not work either: activeness keeps points jittering for ever, by more per step
//! the larger λ is. So the distance covered is measured: the root mean square distance from where the points were, over
//! a span of steps whose step sizes add up to 2, divided by that sum. The jitter cancels out over longer spans, and
//! runs with λ = 0.025 to 0.2 have the same motion at the same sum of step sizes, within a third.

use crate::error::{Error, Result};
use crate::index::Grid2;
use crate::job::{Context, Job, Progress, chunks};
pub use crate::memory::require_points;
use crate::points::Domain;
use crate::setters::setters;

/// The share of the progress of all steps that the preparation takes.
const BEGIN: f64 = 0.01;

/// The sum of the step sizes in one span.
const SPAN: f64 = 2.0;

/// The rounding error of a sum of steps.
const ROUNDING: f64 = 1e-9;

/// The step size by which the motion of the momentum method is measured: a span is 10 steps, in which long waves are
/// removed twice.
const STEP: f64 = 0.2;

/// A space in which points have distances.
pub trait Space<P> {
    /// The squared distance, in spacings.
    fn distance_squared(&self, from: P, to: P) -> f64;
}

/// A point set under relaxation, in any space and by any law.
pub trait Relaxation {
    /// The position of a point.
    type Position: Copy;
    /// The space in which its motion is measured.
    type Space: Space<Self::Position>;

    /// The space of the points.
    fn space(&self) -> Self::Space;

    /// The positions of all points, always in the same order after [`Relaxation::begin`].
    fn positions(&self) -> impl ExactSizeIterator<Item = Self::Position>;

    /// Prepares the set for the first step: a clustered one is spread. If it is cancelled, no point has moved.
    fn begin(&mut self, _: &Job) -> Result<()> {
        Ok(())
    }

    /// Moves all points; `iteration` is the number of steps made before. If it is cancelled, none has moved.
    fn step(&mut self, job: &Job, iteration: u32) -> Result<()>;

    /// Updates the data kept about the points' neighbours after a step, in the rest of its job. The step counts even if
    /// this is cancelled.
    fn follow(&mut self, job: &Job) -> Result<()> {
        job.report(1.0)
    }

    /// The size of the next step, in the units of [`Report::motion`](Report::motion).
    fn step_size(&self) -> f64 {
        STEP
    }

    /// True if the set has converged; `is_at_rest` is true if its motion has ended.
    fn has_converged(&self, is_at_rest: bool) -> bool {
        is_at_rest
    }

    /// Returns to the state with the fewest violated constraints, if that is not the last; without any step, to the
    /// points with which the set began.
    fn finish(&mut self, _: &Job, _iterations: u32) -> Result<()> {
        Ok(())
    }
}

/// The reason why a relaxation ended.
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

/// The conditions that end the steps.
#[derive(Clone, Copy)]
pub struct Limits {
    pub max_iterations: u32,
    /// The motion at which the set is at rest.
    pub tolerance: f64,
}

impl Limits {
    /// Refuses a tolerance that is out of range.
    pub fn check(&self) -> Result<()> {
        if (0.0..).contains(&self.tolerance) {
            return Ok(());
        }
        Err(Error::invalid("tolerance", format!("{} is not at least 0", self.tolerance)))
    }
}

/// The steps that were made: the common part of the reports of all relaxations.
#[derive(Clone, Copy)]
pub struct Steps {
    pub iterations: u32,
    pub stopped: Stopped,
    /// The motion over the last whole span, or over all steps if there were fewer.
    pub motion: f64,
}

/// Makes the steps of a set, calls `observe` after each, and measures the result. If the call is cancelled, the set
/// after its last whole step is measured, without another call to `observe`.
pub fn run<R: Relaxation, T>(
    context: &Context,
    limits: Limits,
    set: &mut R,
    progress: Option<&Progress>,
    mut observe: impl FnMut(&R),
    measure: impl Fn(&Job, &mut R, Steps) -> Result<T>,
) -> Result<T> {
    let mut course = Course { iterations: 0, motion: None };
    let relaxed = context.run(progress, |job| {
        let stopped = course.make_steps(&job.part(0.0, 0.98), limits, set, &mut observe)?;
        course.finish(&job.part(0.98, 1.0), set, stopped, &measure)
    });
    match relaxed {
        Err(Error::Cancelled) => context.run(None, |job| course.finish(job, set, Stopped::Cancelled, &measure)),
        relaxed => relaxed,
    }
}

/// The steps made so far.
struct Course<P> {
    iterations: u32,
    /// None before the first step.
    motion: Option<Motion<P>>,
}

impl<P: Copy> Course<P> {
    /// Makes steps until the motion ends or the steps are used up.
    fn make_steps<R: Relaxation<Position = P>>(
        &mut self,
        job: &Job,
        limits: Limits,
        set: &mut R,
        observe: &mut impl FnMut(&R),
    ) -> Result<Stopped> {
        if set.positions().len() < 2 {
            return Ok(Stopped::Converged);
        }
        if limits.max_iterations == 0 {
            return Ok(Stopped::Steps);
        }
        set.begin(&job.part(0.0, BEGIN))?;
        let motion = self.motion.insert(Motion::new(set.positions()));
        let share = |iteration: u32| BEGIN + (1.0 - BEGIN) * f64::from(iteration) / f64::from(limits.max_iterations);
        while self.iterations < limits.max_iterations {
            let (iteration, size) = (self.iterations, set.step_size());
            let job = job.part(share(iteration), share(iteration + 1));
            set.step(&job, iteration)?;
            self.iterations += 1;
            motion.add(size, set);
            set.follow(&job)?;
            observe(set);
            if set.has_converged(motion.has_ended(limits.tolerance)) {
                return Ok(Stopped::Converged);
            }
        }
        Ok(Stopped::Steps)
    }

    fn finish<R: Relaxation<Position = P>, T>(
        &self,
        job: &Job,
        set: &mut R,
        stopped: Stopped,
        measure: &impl Fn(&Job, &mut R, Steps) -> Result<T>,
    ) -> Result<T> {
        set.finish(&job.part(0.0, 0.2), self.iterations)?;
        let motion = self.motion.as_ref().map_or(0.0, |motion| motion.last(set));
        measure(&job.part(0.2, 1.0), set, Steps { iterations: self.iterations, stopped, motion })
    }
}

/// The motion of points, measured over span after span.
struct Motion<P> {
    /// The positions when the span began.
    start: Vec<P>,
    /// The sum of the step sizes since then.
    steps: f64,
    /// The motion in the last whole span.
    last: Option<f64>,
}

impl<P: Copy> Motion<P> {
    /// Begins the first span.
    fn new(positions: impl Iterator<Item = P>) -> Self {
        Self { start: positions.collect(), steps: 0.0, last: None }
    }

    /// Counts a step of this size.
    fn add(&mut self, size: f64, set: &impl Relaxation<Position = P>) {
        self.steps += size;
        if self.steps >= SPAN - ROUNDING {
            self.last = Some(self.since_start(set));
            self.start.clear();
            self.start.extend(set.positions());
            self.steps = 0.0;
        }
    }

    /// True if a whole span was made, and the motion in the last is at most the tolerance.
    fn has_ended(&self, tolerance: f64) -> bool {
        self.last.is_some_and(|motion| motion <= tolerance)
    }

    /// The motion over the last whole span, or over all steps if there were fewer.
    fn last(&self, set: &impl Relaxation<Position = P>) -> f64 {
        self.last.unwrap_or_else(|| self.since_start(set))
    }

    fn since_start(&self, set: &impl Relaxation<Position = P>) -> f64 {
        if self.steps == 0.0 {
            return 0.0;
        }
        let (space, pairs) = (set.space(), self.start.iter().zip(set.positions()));
        let squares: f64 = pairs.map(|(&from, to)| space.distance_squared(from, to)).sum();
        (squares / self.start.len() as f64).sqrt() / self.steps
    }
}

// The common part of the calls in the plane.

/// The options of [`relax_with_density`](super::relax_with_density) and [`relax_classes`](super::relax_classes), which
/// are those of [`Options`](super::Options): the method is momentum with Delaunay neighbours.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct DelaunayOptions {
    /// As [`Options::domain`](super::Options::domain).
    pub domain: Domain,
    /// As [`Options::max_iterations`](super::Options::max_iterations).
    pub max_iterations: u32,
    /// As [`Options::seed`](super::Options::seed).
    pub seed: u64,
    /// As [`Options::tolerance`](super::Options::tolerance).
    pub tolerance: f64,
}

impl DelaunayOptions {
    /// At most 100 steps, tolerance 0.001.
    pub fn new(domain: Domain) -> Self {
        Self { domain, max_iterations: 100, seed: 0, tolerance: 0.001 }
    }

    /// Refuses values out of their range.
    pub fn check(&self) -> Result<()> {
        self.domain.check()?;
        self.limits().check()
    }

    /// The conditions that end the steps.
    pub(super) fn limits(&self) -> Limits {
        Limits { max_iterations: self.max_iterations, tolerance: self.tolerance }
    }
}

setters!(DelaunayOptions { domain: Domain, max_iterations: u32, seed: u64, tolerance: f64 });

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
    pub relative_covering_radius: f64,
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
    fn covering_radius(&mut self, job: &Job) -> Result<f64>;
}

/// Makes the steps of a set of the plane and measures the result.
pub fn relax_set<R: PlaneRelaxation>(
    context: &Context,
    domain: &Domain,
    limits: Limits,
    points: &[[f32; 2]],
    set: &mut R,
    progress: Option<&Progress>,
    mut observe: Option<&mut Observer>,
) -> Result<(Vec<[f32; 2]>, Report)> {
    let observe = |set: &R| {
        if let Some(observe) = &mut observe {
            observe(&set.points(points));
        }
    };
    run(context, limits, set, progress, observe, |job, set, steps| measure(job, domain, points, set, steps))
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
    let covering_radius = if points.is_empty() { f64::INFINITY } else { set.covering_radius(&job.part(0.5, 1.0))? };
    let unit = domain.hexagonal_distance(points.len().max(1));
    let report = Report {
        iterations,
        stopped,
        motion,
        smallest_distance,
        rho: relative_spacing.unwrap_or(smallest_distance / unit),
        relative_covering_radius: covering_radius / unit,
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

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use super::*;

    /// Two points that move by 1 in each step, along the axis of numbers.
    struct Walkers([f64; 2]);

    struct Axis;

    impl Space<f64> for Axis {
        fn distance_squared(&self, from: f64, to: f64) -> f64 {
            (to - from) * (to - from)
        }
    }

    impl Relaxation for Walkers {
        type Position = f64;
        type Space = Axis;

        fn space(&self) -> Axis {
            Axis
        }

        fn positions(&self) -> impl ExactSizeIterator<Item = f64> {
            self.0.into_iter()
        }

        fn step(&mut self, _: &Job, iteration: u32) -> Result<()> {
            assert_eq!(f64::from(iteration), self.0[0]);
            self.0 = self.0.map(|x| x + 1.0);
            Ok(())
        }
    }

    /// The steps of walkers until the progress is that share, and their positions then.
    fn walk(tolerance: f64, cancelled_at: f64) -> (Steps, f64) {
        let limits = Limits { max_iterations: 25, tolerance };
        let progress = |share| if share >= cancelled_at { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        let (context, mut walkers) = (Context::new(1).unwrap(), Walkers([0.0, 7.0]));
        let measure = |_: &Job, walkers: &mut Walkers, steps: Steps| Ok((steps, walkers.0[0]));
        run(&context, limits, &mut walkers, Some(&progress), |_| {}, measure).unwrap()
    }

    #[test]
    fn a_step_counts_once_its_points_have_moved() {
        for cancelled_at in [0.02, 0.1, 0.3, 0.9] {
            let (steps, walked) = walk(0.0, cancelled_at);
            assert!(steps.stopped == Stopped::Cancelled && walked >= 1.0, "{cancelled_at}: {walked}");
            assert_eq!(f64::from(steps.iterations), walked, "{cancelled_at}");
        }
    }

    /// In steps of size 0.2, a span of 10 steps by 1 is a motion of 5.
    #[test]
    fn steps_end_with_the_motion_or_all_are_made() {
        for (tolerance, stopped, iterations) in [(4.9, Stopped::Steps, 25), (5.1, Stopped::Converged, 10)] {
            let (steps, walked) = walk(tolerance, 2.0);
            assert_eq!((steps.stopped, steps.iterations, walked), (stopped, iterations, f64::from(iterations)));
            assert!((steps.motion - 5.0).abs() < 1e-9, "{}", steps.motion);
        }
    }
}
