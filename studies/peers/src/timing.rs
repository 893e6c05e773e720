//! The time and memory of a call, as Linux records them for this process.

use std::fs;
use std::time::Instant;

/// The cost of a call.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    pub seconds: f64,
    /// Processor time, of all threads together.
    pub busy: f64,
    /// The most memory that it needed on top of what was there before it.
    pub megabytes: f64,
}

/// The ticks of Linux's clock of processor time.
const TICKS: f64 = 100.0;

/// Makes the call.
pub fn timed<T>(call: impl FnOnce() -> T) -> (T, Cost) {
    let (held, busy, start) = (memory("VmRSS"), processor_time(), Instant::now());
    let result = call();
    let seconds = start.elapsed().as_secs_f64();
    (result, Cost { seconds, busy: processor_time() - busy, megabytes: memory("VmHWM") - held })
}

fn memory(field: &str) -> f64 {
    let status = fs::read_to_string("/proc/self/status").expect("Linux has it");
    let line = status.lines().find(|line| line.starts_with(field)).expect("Linux tells it");
    line.split_whitespace().nth(1).and_then(|number| number.parse::<f64>().ok()).expect("a number of kB") / 1024.0
}

fn processor_time() -> f64 {
    let stat = fs::read_to_string("/proc/self/stat").expect("Linux has it");
    // After the name, which may hold anything, come the fields from the third on; 14 and 15 are user's and system's
    // ticks.
    let fields = stat.rsplit(')').next().expect("a name").split_whitespace();
    fields.skip(11).take(2).map(|ticks| ticks.parse::<f64>().expect("ticks")).sum::<f64>() / TICKS
}
