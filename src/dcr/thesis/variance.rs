//! The thesis's own test of convergence (§4.4.2): the variance of the distances to the nearest point no longer changes, and
//! more than 99 % of the points are stable.
//!
//! It does not define a stable point. With the definition chosen here the second condition was never decisive in the runs
//! examined: when the variance is constant, points are at rest.

use glam::DVec2;

use crate::error::Result;
use crate::geometry::Frame;
use crate::index::Grid2;
use crate::job::{Job, chunks};
use crate::math::square;
use crate::points::Domain;

/// The largest relative change in a step at which the variance rests.
const CHANGE: f64 = 1e-3;

/// The number of times in a row that it must rest.
const STEPS: u32 = 10;

/// A point that moves by less than this in a step, in spacings, is stable; and the fraction of the points that must be.
const STABLE_MOTION: f64 = 0.01;
const STABLE_SHARE: f64 = 0.99;

/// The variance of nearest distances, step after step.
#[derive(Default)]
pub struct Variance {
    last: Option<f64>,
    resting: u32,
}

impl Variance {
    /// Updates the test with a step from `before` to `after`.
    pub fn after_step(&mut self, job: &Job, frame: &Frame, before: &[DVec2], after: &[DVec2]) -> Result<()> {
        let variance = variance(&nearest_distances(job, frame, after)?);
        let is_stable = |&(&from, &to): &(&DVec2, &DVec2)| frame.offset(from, to).length() < STABLE_MOTION;
        let stable = before.iter().zip(after).filter(is_stable).count();
        let rests = self.last.is_some_and(|last| (variance - last).abs() < CHANGE * last)
            && stable as f64 > STABLE_SHARE * after.len() as f64;
        self.resting = if rests { self.resting + 1 } else { 0 };
        self.last = Some(variance);
        Ok(())
    }

    /// True if the test is met.
    pub fn has_settled(&self) -> bool {
        self.resting >= STEPS
    }
}

/// The distance of each point to the nearest other one, in spacings; on a torus around it.
fn nearest_distances(job: &Job, frame: &Frame, positions: &[DVec2]) -> Result<Vec<f64>> {
    let domain = Domain { min: [0.0; 2], max: frame.size().to_array(), boundary: frame.boundary() };
    let grid = Grid2::new(domain, positions.iter().map(DVec2::to_array), 1.0);
    let chunks = chunks(positions.len());
    job.flat_map(chunks.len(), |chunk| {
        let nearest = |i: usize| grid.nearest_squared(positions[i].to_array(), Some(i as u32)).sqrt();
        chunks.range(chunk).map(nearest).collect()
    })
}

fn variance(values: &[f64]) -> f64 {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    values.iter().map(|value| square(value - mean)).sum::<f64>() / count
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::job::Context;
    use crate::points::Boundary;

    #[test]
    fn distances_go_around_the_torus_and_their_variance_is_that_of_all() {
        let points = [[0.0, 0.1], [0.0, 0.9], [0.5, 0.5], [0.5, 0.6]].map(|[x, y]| DVec2::new(x, y));
        for (boundary, expected) in
            [(Boundary::Periodic, [0.2, 0.2, 0.1, 0.1]), (Boundary::Bounded, [0.64, 0.58, 0.1, 0.1])]
        {
            let domain = Domain::unit(boundary);
            let frame = Frame::new(domain, 4);
            let positions: Vec<_> = points.iter().map(|&point| point / frame.spacing()).collect();
            let find = |job: &Job| nearest_distances(job, &frame, &positions);
            let found = Context::new(1).unwrap().run(None, find).unwrap();
            for (found, expected) in found.into_iter().zip(expected) {
                assert!((found * frame.spacing() - expected).abs() < 0.005, "{found} {expected}");
            }
        }
        assert!((variance(&[1.0, 2.0, 3.0, 6.0]) - 3.5).abs() < 1e-12);
    }

    #[test]
    fn ten_calm_steps_in_a_row_meet_the_test() {
        let frame = Frame::new(Domain::unit(Boundary::Periodic), 3);
        let context = Context::new(1).unwrap();
        let calm = [DVec2::ZERO, DVec2::new(0.3, 0.0), DVec2::new(0.0, 0.5)];
        let mut variance = Variance::default();
        let mut step = |before: &[DVec2], after: &[DVec2]| {
            context.run(None, |job| variance.after_step(job, &frame, before, after)).unwrap();
            variance.has_settled()
        };
        // The first step has no change to compare with; a point that jumps starts the count again, as does a new
        // variance.
        assert!((0..10).all(|_| !step(&calm, &calm)));
        let elsewhere = calm.map(|point| point + 0.02);
        assert!(!step(&calm, &elsewhere));
        assert!((0..9).all(|_| !step(&calm, &calm)));
        let wider = [calm[0], calm[1], calm[2] * 1.02];
        assert!(!step(&wider, &wider));
        assert!((0..9).all(|_| !step(&wider, &wider)));
        assert!(step(&wider, &wider));
    }
}
