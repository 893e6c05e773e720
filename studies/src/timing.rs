//! Times that are compared with each other.

use std::time::Instant;

use azulejo::Result;

/// The least seconds of each of some calls in a number of rounds, in each of which all are made once: noise only adds,
/// and comes to all of them alike.
pub fn least_seconds(rounds: usize, calls: &[&dyn Fn() -> Result<usize>]) -> Result<Vec<Timed>> {
    let mut least = vec![Timed { samples: 0, seconds: f64::INFINITY }; calls.len()];
    for _ in 0..rounds {
        for (call, least) in calls.iter().zip(&mut least) {
            let start = Instant::now();
            let samples = call()?;
            let seconds = start.elapsed().as_secs_f64();
            if seconds < least.seconds {
                *least = Timed { samples, seconds };
            }
        }
    }
    Ok(least)
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
