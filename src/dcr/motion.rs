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

use super::forces::Particle;
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
    pub(super) fn new(step: f64, particles: &[Particle]) -> Self {
        Self { step, start: positions(particles), steps: 0, last: None }
    }

    /// Counts a step; the motion if a span ends with it.
    pub(super) fn after_step(&mut self, frame: &Frame, particles: &[Particle]) -> Option<f64> {
        self.steps += 1;
        if f64::from(self.steps) * self.step < SPAN {
            return None;
        }
        self.last = Some(self.since_start(frame, particles));
        self.start = positions(particles);
        self.steps = 0;
        self.last
    }

    /// The motion over the last whole span, or over all steps if there were fewer.
    pub(super) fn last(&self, frame: &Frame, particles: &[Particle]) -> f64 {
        self.last.unwrap_or_else(|| self.since_start(frame, particles))
    }

    fn since_start(&self, frame: &Frame, particles: &[Particle]) -> f64 {
        if self.steps == 0 {
            return 0.0;
        }
        let way = |(start, particle): (&DVec2, &Particle)| frame.offset(*start, particle.position).length_squared();
        let squares: f64 = self.start.iter().zip(particles).map(way).sum();
        (squares / particles.len() as f64).sqrt() / (f64::from(self.steps) * self.step)
    }
}

fn positions(particles: &[Particle]) -> Vec<DVec2> {
    particles.iter().map(|particle| particle.position).collect()
}
