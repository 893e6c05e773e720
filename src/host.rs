//! Queries that not every system can answer: WebAssembly without an interface to a system (`wasm32-unknown-unknown`)
//! knows neither processes nor time, and the standard library panics if it is asked.

use std::time::Instant;

/// The number of the process, which tells that it was forked; 0 on WebAssembly, which has no processes.
pub(crate) fn process_id() -> u32 {
    if cfg!(target_family = "wasm") { 0 } else { std::process::id() }
}

/// Wall time in seconds, of one stage after another; 0 where there is no clock.
pub struct Stopwatch(Option<Instant>);

impl Stopwatch {
    pub fn start() -> Self {
        let has_clock = !cfg!(all(target_family = "wasm", target_os = "unknown"));
        Self(has_clock.then(Instant::now))
    }

    /// The seconds since the start or the last lap.
    pub fn seconds(&self) -> f64 {
        self.0.map_or(0.0, |start| start.elapsed().as_secs_f64())
    }

    /// [`Stopwatch::seconds`], and the next lap begins.
    pub fn lap(&mut self) -> f64 {
        let now = Self::start();
        let seconds = match (self.0, now.0) {
            (Some(start), Some(end)) => (end - start).as_secs_f64(),
            _ => 0.0,
        };
        *self = now;
        seconds
    }
}
