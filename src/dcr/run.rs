//! The loop that runs a relaxation, reports its progress, and lets a cancelled call succeed.

use crate::dcr::options::Options;
use crate::dcr::relaxation::Relaxation;
use crate::dcr::report::{Report, Stopped, measure};
use crate::error::{Error, Result};
use crate::job::{Context, Job, Progress};

/// The share of the steps' progress that is that of the preparation.
const BEGIN: f64 = 0.01;

/// Receives the points after a step, in the user's order.
pub type Observer<'a> = dyn FnMut(&[[f32; 2]]) + 'a;

/// Makes the steps of a set and measures the result. A cancelled call returns the set after its last whole step.
pub(super) fn run(
    context: &Context,
    options: &Options,
    points: &[[f32; 2]],
    set: &mut dyn Relaxation,
    progress: Option<&Progress>,
    observe: Option<&mut Observer>,
) -> Result<(Vec<[f32; 2]>, Report)> {
    let relaxed = context.run(progress, |job| {
        let stopped = make_steps(&job.part(0.0, 0.98), options, points, set, observe)?;
        measure(&job.part(0.98, 1.0), &options.domain, points, set, stopped)
    });
    match relaxed {
        // The state after the last whole step is measured without asking the caller again.
        Err(Error::Cancelled) => {
            context.run(None, |job| measure(job, &options.domain, points, set, Stopped::Cancelled))
        }
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
    if options.max_iterations > 0 {
        set.begin(&job.part(0.0, BEGIN))?;
    }
    let share = |iteration: u32| BEGIN + (1.0 - BEGIN) * f64::from(iteration) / f64::from(options.max_iterations);
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
