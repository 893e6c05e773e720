//! Processor time: on a machine that others use, too, it varies less than the time on the wall.

use std::fs;
use std::path::PathBuf;
use std::time::Instant;

use azulejo::Result;

use crate::timing::Rounds;

/// Linux's account of the threads of this process.
const TASKS: &str = "/proc/self/task";

/// The seconds for which the threads of this process have had a processor; `None` where the system does not tell.
fn processor_seconds() -> Option<f64> {
    let threads: Vec<PathBuf> = fs::read_dir(TASKS).ok()?.flatten().map(|thread| thread.path()).collect();
    let nanoseconds = |thread: &PathBuf| {
        let account = fs::read_to_string(thread.join("schedstat")).ok()?;
        account.split_whitespace().next()?.parse::<f64>().ok()
    };
    let all: f64 = threads.iter().filter_map(nanoseconds).sum();
    (all > 0.0).then_some(1e-9 * all)
}

/// The processor seconds of each of some calls in a number of rounds, in each of which all are made once. The threads of the
/// calls' contexts live as long as they.
pub fn in_turns(rounds: usize, calls: &[&dyn Fn() -> Result<usize>]) -> Result<Vec<Rounds>> {
    let mut all = vec![Rounds::default(); calls.len()];
    for _ in 0..rounds {
        for (call, of_call) in calls.iter().zip(&mut all) {
            let (samples, seconds) = timed(call)?;
            of_call.samples = samples;
            of_call.seconds.push(seconds);
        }
    }
    Ok(all)
}

/// The result of a call and its processor seconds; those on the wall where the system does not account for processors, or
/// not as finely as the call is short.
pub fn timed<T>(call: impl FnOnce() -> Result<T>) -> Result<(T, f64)> {
    let (before, start) = (processor_seconds(), Instant::now());
    let result = call()?;
    let (after, seconds) = (processor_seconds(), start.elapsed().as_secs_f64());
    let busy = before.zip(after).map(|(before, after)| after - before).filter(|&busy| busy > 0.0);
    Ok((result, busy.unwrap_or(seconds)))
}
