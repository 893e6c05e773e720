//! Convergence by motion.
//!
//! The thesis stops when the variance of nearest distances changes by less than 0.1 % ten times in a row (§4.4.2).
//! That depends on the step size and fires early: halving λ halves the change per step. Motion per step does not work
//! either: activeness keeps points jittering for ever, the more per step the larger λ is.
//!
//! So what is measured is how far points get: the root mean square way from where they were, over a span of steps
//! whose step sizes add up to 2, divided by that sum. The jitter of longer spans cancels out, and runs with λ = 0.025
//! to 0.2 have the same motion at the same sum of step sizes, within a third.

use glam::DVec2;

use super::frame::Frame;

/// The sum of the step sizes in one span.
const SPAN: f64 = 2.0;

/// The motion of the points, measured over span after span.
pub(super) struct Motion<P = DVec2> {
    step: f64,
    /// Where the points were when the span began.
    start: Vec<P>,
    steps: u32,
    last: Option<f64>,
}

/// Where points are: what knows how far they are apart.
pub(super) trait Space<P> {
    /// The squared distance.
    fn distance_squared(&self, from: P, to: P) -> f64;
}

impl Space<DVec2> for Frame {
    fn distance_squared(&self, from: DVec2, to: DVec2) -> f64 {
        self.offset(from, to).length_squared()
    }
}

impl<P: Copy> Motion<P> {
    /// Begins the first span.
    pub(super) fn new(step: f64, positions: Vec<P>) -> Self {
        Self { step, start: positions, steps: 0, last: None }
    }

    /// Counts a step.
    pub(super) fn after_step<I: Iterator<Item = P>>(&mut self, space: &impl Space<P>, positions: impl Fn() -> I) {
        self.steps += 1;
        if f64::from(self.steps) * self.step >= SPAN {
            self.last = Some(self.since_start(space, positions()));
            self.start = positions().collect();
            self.steps = 0;
        }
    }

    /// Whether there was a whole span, and no more motion in the last than this.
    pub(super) fn has_settled(&self, tolerance: f64) -> bool {
        self.last.is_some_and(|motion| motion <= tolerance)
    }

    /// The motion over the last whole span, or over all steps if there were fewer.
    pub(super) fn last(&self, space: &impl Space<P>, positions: impl Iterator<Item = P>) -> f64 {
        self.last.unwrap_or_else(|| self.since_start(space, positions))
    }

    fn since_start(&self, space: &impl Space<P>, positions: impl Iterator<Item = P>) -> f64 {
        if self.steps == 0 {
            return 0.0;
        }
        let squares: f64 = self.start.iter().zip(positions).map(|(&from, to)| space.distance_squared(from, to)).sum();
        (squares / self.start.len() as f64).sqrt() / (f64::from(self.steps) * self.step)
    }
}
