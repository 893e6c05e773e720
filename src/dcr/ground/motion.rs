//! Convergence by motion.
//!
//! The thesis's test (`variance.rs`) depends on the step size and fires early: halving λ halves the change per step. Motion
//! per step does not work either: activeness keeps points jittering for ever, the more per step the larger λ is.
//!
//! So what is measured is how far points get: the root mean square way from where they were, over a span of steps
//! whose step sizes add up to 2, divided by that sum. The jitter of longer spans cancels out, and runs with λ = 0.025
//! to 0.2 have the same motion at the same sum of step sizes, within a third.

use glam::DVec2;

use crate::geometry::frame::Frame;

/// The sum of the step sizes in one span.
const SPAN: f64 = 2.0;

/// What a sum of steps may lack by rounding.
const ROUNDING: f64 = 1e-9;

/// The motion of the points, measured over span after span.
pub(crate) struct Motion<P = DVec2> {
    /// The size of the next step.
    step: f64,
    /// Where the points were when the span began.
    start: Vec<P>,
    /// The sum of the steps since.
    way: f64,
    last: Option<f64>,
}

/// Where points are: what knows how far they are apart.
pub(crate) trait Space<P> {
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
    pub(crate) fn new(step: f64, positions: Vec<P>) -> Self {
        Self { step, start: positions, way: 0.0, last: None }
    }

    /// The steps from now on are of this size.
    pub(crate) fn set_step(&mut self, step: f64) {
        self.step = step;
    }

    /// Counts a step.
    pub(crate) fn after_step<I: Iterator<Item = P>>(&mut self, space: &impl Space<P>, positions: impl Fn() -> I) {
        self.way += self.step;
        if self.way >= SPAN - ROUNDING {
            self.last = Some(self.since_start(space, positions()));
            self.start = positions().collect();
            self.way = 0.0;
        }
    }

    /// Whether there was a whole span, and no more motion in the last than this.
    pub(crate) fn has_settled(&self, tolerance: f64) -> bool {
        self.last.is_some_and(|motion| motion <= tolerance)
    }

    /// The motion over the last whole span, or over all steps if there were fewer.
    pub(crate) fn last(&self, space: &impl Space<P>, positions: impl Iterator<Item = P>) -> f64 {
        self.last.unwrap_or_else(|| self.since_start(space, positions))
    }

    fn since_start(&self, space: &impl Space<P>, positions: impl Iterator<Item = P>) -> f64 {
        if self.way == 0.0 {
            return 0.0;
        }
        let squares: f64 = self.start.iter().zip(positions).map(|(&from, to)| space.distance_squared(from, to)).sum();
        (squares / self.start.len() as f64).sqrt() / self.way
    }
}
