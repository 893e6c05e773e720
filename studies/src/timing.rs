//! Times that are compared with each other.

use std::time::Instant;

use azulejo::Result;

/// The least seconds of each of some calls in a number of rounds, in each of which all are made once: noise only adds,
/// and comes to all of them alike.
pub fn least_seconds(rounds: usize, calls: &[&dyn Fn() -> Result<usize>]) -> Result<Vec<Timed>> {
    let least = |rounds: &Rounds| Timed { samples: rounds.samples, seconds: rounds.least() };
    Ok(in_turns(rounds, calls)?.iter().map(least).collect())
}

/// The seconds of each of some calls in a number of rounds, in each of which all are made once.
pub fn in_turns(rounds: usize, calls: &[&dyn Fn() -> Result<usize>]) -> Result<Vec<Rounds>> {
    let mut all = vec![Rounds::default(); calls.len()];
    for _ in 0..rounds {
        for (call, of_call) in calls.iter().zip(&mut all) {
            of_call.add(call)?;
        }
    }
    Ok(all)
}

/// The seconds of a call, round by round, and the samples that it makes.
#[derive(Clone, Debug, Default)]
pub struct Rounds {
    pub samples: usize,
    pub seconds: Vec<f64>,
}

impl Rounds {
    /// Makes the call once more.
    pub fn add(&mut self, call: impl FnOnce() -> Result<usize>) -> Result<()> {
        let start = Instant::now();
        self.samples = call()?;
        self.seconds.push(start.elapsed().as_secs_f64());
        Ok(())
    }

    pub fn least(&self) -> f64 {
        self.seconds.iter().copied().fold(f64::INFINITY, f64::min)
    }
}

/// A number of samples and the seconds that they took.
#[derive(Clone, Copy)]
pub struct Timed {
    pub samples: usize,
    pub seconds: f64,
}

impl Timed {
    /// Seconds per sample.
    pub fn per_sample(&self) -> f64 {
        self.seconds / self.samples.max(1) as f64
    }
}
