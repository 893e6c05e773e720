//! How long KDRT takes: against the number of samples, by stage, on one thread and on all.

use std::time::Instant;

use azulejo::kdrt;
use azulejo::kdrt::stages::Stages;
use azulejo::{Boundary, Context, Domain, Progress, Result};

use super::{Effort, LEAF_SIZES, Sampler, radius};

/// The times of one leaf size.
pub struct LeafTimes {
    pub leaf_size: f64,
    /// Samples and the seconds that they take on one thread.
    pub one_thread: Vec<[f64; 2]>,
    /// Samples per second of a set of [`Effort::timed`], on one thread and on all.
    pub rates: [f64; 2],
    pub stages: Stages,
}

/// All times.
pub struct Times {
    pub leaves: Vec<LeafTimes>,
    /// Samples and seconds of the unbiased reference at [`Effort::timed`].
    pub reference: [f64; 2],
    pub threads: usize,
}

impl Times {
    pub fn measure(context: &Context, effort: &Effort, progress: &Progress) -> Result<Self> {
        let one = Context::new(1)?;
        let counts: Vec<_> =
            (8..).map(|k| 10f64.powf(0.5 * f64::from(k))).take_while(|&n| n < effort.largest * 1.1).collect();
        let mut leaves = Vec::new();
        for (i, leaf_size) in LEAF_SIZES.into_iter().enumerate() {
            let sampler = Sampler::Leaves(leaf_size);
            let one_thread = counts.iter().map(|&count| least_time(&one, sampler, count)).collect::<Result<_>>()?;
            let rate = |context: &Context| least_time(context, sampler, effort.timed).map(|[samples, s]| samples / s);
            let domain = Domain::unit(Boundary::Periodic);
            let options = kdrt::Options::new(radius(effort.timed)).domain(domain).leaf_size(leaf_size).seed(1);
            leaves.push(LeafTimes {
                leaf_size,
                one_thread,
                rates: [rate(&one)?, rate(context)?],
                stages: kdrt::stages::measure(&options)?,
            });
            _ = progress((i + 1) as f64 / LEAF_SIZES.len() as f64);
        }
        let reference = least_time(&one, Sampler::Maximal, effort.timed)?;
        Ok(Self { leaves, reference, threads: context.num_threads() })
    }
}

/// Samples of a set and the least seconds that it takes in a few attempts: noise only adds.
fn least_time(context: &Context, sampler: Sampler, count: f64) -> Result<[f64; 2]> {
    let mut least = [0.0, f64::INFINITY];
    for _ in 0..3 {
        let start = Instant::now();
        let samples = sampler.sample(context, count, 1)?;
        let seconds = start.elapsed().as_secs_f64();
        if seconds < least[1] {
            least = [samples.len() as f64, seconds];
        }
    }
    Ok(least)
}
