//! Progressive order: levels (`levels.rs`) down a ladder of radii, each a quotient below the one before.
//!
//! The ladder begins where one sample covers the mesh. As long as a level has no more than [`Order::FIRST_COUNT`]
//! samples it falls by about two instead (see [`first_stride`]). What the next level is does not depend on where the
//! ladder ends. So sets of different radii and counts share their levels, and a set of fewer samples is a prefix of
//! one of more: to the bit, where both are cut out of the ladder by their counts, and down to the last common level,
//! where one ends with a level at its radius.
//!
//! For any prefix, let k be the level in which it ends. It holds all of the level before, which covers the surface within
//! the quotient times the radius of level k; and no rank of level k is below this radius.

use crate::error::Result;
use crate::job::Job;
use crate::math::{power, square};
use crate::order::{Order, first_stride};
use crate::psp::count::{Found, check_room, expected_radius, no_place, none_finer};
use crate::psp::levels::{Levelled, Levels};

/// Levels, down to a radius.
struct Ladder<S: Levelled> {
    levels: Levels<S>,
    quotient: f64,
    /// The quotient of the first levels, until one has too many samples.
    first: Option<f64>,
    /// No level has a smaller radius.
    finest: f64,
    /// The number of the next level.
    key: u64,
    /// The radius at which all work is expected to be done, and the share that is.
    last: f64,
    done: f64,
}

impl<S: Levelled> Ladder<S> {
    fn new(levels: Levels<S>, quotient: f64, finest: f64, last: f64) -> Self {
        let first = Some(power(quotient, first_stride(quotient)));
        Self { levels, quotient, first, finest, key: 0, last, done: 0.0 }
    }

    /// The radius of the next level, if that has no more samples than the first levels may have.
    fn next(&self) -> f64 {
        let former = self.levels.radius();
        let next =
            if former.is_finite() { former / self.first.unwrap_or(self.quotient) } else { self.levels.surface.top() };
        next.max(self.finest)
    }

    /// Adds a level.
    fn descend(&mut self, job: &Job) -> Result<()> {
        let (len, former) = (self.levels.len(), self.levels.radius());
        self.add(job)?;
        if self.first.is_some() && former.is_finite() && self.levels.len() > Order::FIRST_COUNT {
            self.levels.take_back(len, former);
            (self.first, self.key) = (None, self.key - 1);
            self.add(job)?;
        }
        Ok(())
    }

    /// Adds a level of the next radius. The work that is done by then grows as the samples do.
    fn add(&mut self, job: &Job) -> Result<()> {
        let radius = self.next();
        let done = square(self.last / radius).clamp(self.done, 1.0);
        self.levels.refine(&job.part(self.done, done), radius, self.key)?;
        (self.key, self.done) = (self.key + 1, done);
        Ok(())
    }
}

/// A maximal set of a radius: the levels above it, and one at the radius itself.
pub fn by_radius<S: Levelled>(job: &Job, levels: Levels<S>, quotient: f64, radius: f64) -> Result<Found<S::Sample>> {
    let mut ladder = Ladder::new(levels, quotient, radius, radius);
    while ladder.levels.radius() > radius {
        ladder.descend(job)?;
    }
    let darts = ladder.levels.darts;
    Ok(Found { samples: ladder.levels.into_sorted(), radius, coverage: radius, darts })
}

/// As many samples of the ladder as asked for. No radius is below the finest.
pub fn by_count<S: Levelled>(
    job: &Job,
    levels: Levels<S>,
    quotient: f64,
    count: usize,
    finest: f64,
) -> Result<Found<S::Sample>> {
    let expected = expected_radius(&levels.surface, count as f64, finest);
    let mut ladder = Ladder::new(levels, quotient, finest, expected);
    loop {
        let former = ladder.levels.radius();
        if former == finest {
            return Err(none_finer(count, ladder.levels.len(), finest));
        }
        check_room(&ladder.levels.surface, ladder.next(), count)?;
        ladder.descend(job)?;
        if ladder.levels.len() == 0 {
            return Err(no_place(count));
        }
        if ladder.levels.len() >= count {
            return Ok(Found::cut(ladder.levels, count, former));
        }
    }
}
