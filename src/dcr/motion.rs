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
pub(super) struct Motion {
    step: f64,
    /// Where the points were when the span began.
    start: Vec<DVec2>,
    steps: u32,
    last: Option<f64>,
}

impl Motion {
    /// Begins the first span.
    pub(super) fn new(step: f64, positions: Vec<DVec2>) -> Self {
        Self { step, start: positions, steps: 0, last: None }
    }

    /// Counts a step.
    pub(super) fn after_step<P: Iterator<Item = DVec2>>(&mut self, frame: &Frame, positions: impl Fn() -> P) {
        self.steps += 1;
        if f64::from(self.steps) * self.step >= SPAN {
            self.last = Some(self.since_start(frame, positions()));
            self.start = positions().collect();
            self.steps = 0;
        }
    }

    /// Whether there was a whole span, and no more motion in the last than this.
    pub(super) fn has_settled(&self, tolerance: f64) -> bool {
        self.last.is_some_and(|motion| motion <= tolerance)
    }

    /// The motion over the last whole span, or over all steps if there were fewer.
    pub(super) fn last(&self, frame: &Frame, positions: impl Iterator<Item = DVec2>) -> f64 {
        self.last.unwrap_or_else(|| self.since_start(frame, positions))
    }

    fn since_start(&self, frame: &Frame, positions: impl Iterator<Item = DVec2>) -> f64 {
        if self.steps == 0 {
            return 0.0;
        }
        let squares: f64 =
            self.start.iter().zip(positions).map(|(&from, to)| frame.offset(from, to).length_squared()).sum();
        (squares / self.start.len() as f64).sqrt() / (f64::from(self.steps) * self.step)
    }
}
