//! What the relaxation methods of the plane have in common: a set that moves in steps.

use crate::error::Result;
use crate::job::Job;

/// A point set that is being relaxed.
pub(super) trait Relaxation {
    /// Prepares the set for the first step: one that is heaped is spread. If it is cancelled, no point has moved.
    fn begin(&mut self, _: &Job) -> Result<()> {
        Ok(())
    }

    /// Moves all points. If it is cancelled, all have moved or none.
    fn step(&mut self, job: &Job) -> Result<()>;

    /// The number of steps made.
    fn iterations(&self) -> u32;

    /// [`Report::motion`](super::Report::motion).
    fn motion(&self) -> f64;

    /// Whether a whole span of steps was made, and the motion in the last is at most the tolerance.
    fn has_settled(&self, tolerance: f64) -> bool;

    /// Returns to the state with the fewest violated constraints, if that is not the last; without any step, to the
    /// points with which the set began.
    fn finish(&mut self, _: &Job) -> Result<()> {
        Ok(())
    }

    /// The points in the user's order; `points` are those with which it began.
    fn points(&self, points: &[[f32; 2]]) -> Vec<[f32; 2]>;

    /// [`Report::rho`](super::Report::rho) of these points, if it is not simply the smallest distance in units of
    /// `d_max`.
    fn relative_spacing(&self, _job: &Job, _points: &[[f32; 2]]) -> Result<Option<f64>> {
        Ok(None)
    }

    /// The largest distance from the set, in units of the domain; if the spacing varies, as large as it would be at the
    /// mean spacing.
    fn coverage(&mut self, job: &Job) -> Result<f64>;
}
