//! Convergence by motion.
//!
//! The thesis's test (`thesis/variance.rs`) depends on the step size and fires early: halving λ halves the change per
//! step. Motion per step does not work either: activeness keeps points jittering for ever, the more per step the larger
//! λ is.
//!
//! So the distance covered is measured: the root mean square distance from where the points were, over a span of steps
//! whose step sizes add up to 2, divided by that sum. The jitter cancels out over longer spans, and runs with λ = 0.025
//! to 0.2 have the same motion at the same sum of step sizes, within a third.

use glam::DVec2;

use crate::dcr::ground::torus::{Torus, TorusPoint};
use crate::geometry::Frame;

/// The sum of the step sizes in one span.
const SPAN: f64 = 2.0;

/// What a sum of steps may lack by rounding.
const ROUNDING: f64 = 1e-9;

/// The step size by which the motion of the momentum method is measured: a span is 10 steps, in which long waves are
/// removed twice.
pub(in crate::dcr) const STEP: f64 = 0.2;

/// The motion of the points, measured over span after span.
pub(in crate::dcr) struct Motion<P> {
    /// The size of the next step.
    step: f64,
    /// Where the points were when the span began.
    start: Vec<P>,
    /// The sum of the steps since then.
    steps: f64,
    last: Option<f64>,
}

/// A space in which points have distances.
pub(in crate::dcr) trait Space<P> {
    /// The squared distance.
    fn distance_squared(&self, from: P, to: P) -> f64;
}

impl Space<DVec2> for Frame {
    fn distance_squared(&self, from: DVec2, to: DVec2) -> f64 {
        self.offset(from, to).length_squared()
    }
}

impl Space<TorusPoint> for Torus {
    fn distance_squared(&self, from: TorusPoint, to: TorusPoint) -> f64 {
        self.frame.offset(self.position(from), self.position(to)).length_squared()
    }
}

impl<P: Copy> Motion<P> {
    /// Begins the first span.
    pub(in crate::dcr) fn new(step: f64, positions: Vec<P>) -> Self {
        Self { step, start: positions, steps: 0.0, last: None }
    }

    /// The steps from now on are of this size.
    pub(in crate::dcr) fn set_step(&mut self, step: f64) {
        self.step = step;
    }

    /// Counts a step.
    pub(in crate::dcr) fn after_step<I: Iterator<Item = P>>(
        &mut self,
        space: &impl Space<P>,
        positions: impl Fn() -> I,
    ) {
        self.steps += self.step;
        if self.steps >= SPAN - ROUNDING {
            self.last = Some(self.since_start(space, positions()));
            self.start = positions().collect();
            self.steps = 0.0;
        }
    }

    /// Whether a whole span was made, and the motion in the last is at most the tolerance.
    pub(in crate::dcr) fn has_settled(&self, tolerance: f64) -> bool {
        self.last.is_some_and(|motion| motion <= tolerance)
    }

    /// The motion over the last whole span, or over all steps if there were fewer.
    pub(in crate::dcr) fn last(&self, space: &impl Space<P>, positions: impl Iterator<Item = P>) -> f64 {
        self.last.unwrap_or_else(|| self.since_start(space, positions))
    }

    fn since_start(&self, space: &impl Space<P>, positions: impl Iterator<Item = P>) -> f64 {
        if self.steps == 0.0 {
            return 0.0;
        }
        let squares: f64 = self.start.iter().zip(positions).map(|(&from, to)| space.distance_squared(from, to)).sum();
        (squares / self.start.len() as f64).sqrt() / self.steps
    }
}
