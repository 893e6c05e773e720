//! The times of KDRT: against the number of samples, by stage, on one thread and on all.

use azulejo::kdrt;
use azulejo::kdrt::stages::Stages;
use azulejo::{Boundary, Context, Domain, Progress, Result};

use super::{Effort, LEAF_SIZES, Sampler, radius};
use crate::timing::{Rounds, in_turns};

/// The times of one leaf size.
pub struct LeafTimes {
    pub leaf_size: f64,
    /// On one thread, from few samples to many.
    pub one_thread: Vec<Rounds>,
    /// A set of [`Effort::timed`] on all threads.
    pub all_threads: Rounds,
    pub stages: Stages,
}

/// All times.
pub struct Times {
    pub leaves: Vec<LeafTimes>,
    /// The unbiased reference at [`Effort::timed`].
    pub reference: Rounds,
    /// The index of that number of samples.
    pub timed: usize,
    pub threads: usize,
}

impl Times {
    /// In each round all leaf sizes take turns.
    pub fn measure(context: &Context, effort: &Effort, progress: &Progress) -> Result<Self> {
        let one = Context::new(1)?;
        let counts: Vec<_> =
            (8..).map(|k| 10f64.powf(0.5 * f64::from(k))).take_while(|&n| n < effort.largest * 1.1).collect();
        let timed = counts.partition_point(|&count| count < 0.99 * effort.timed);
        let (mut by_count, mut reference, mut all_threads) = (Vec::new(), None, None);
        for (i, &count) in counts.iter().enumerate() {
            let made = |context, sampler: Sampler| move || Ok(sampler.sample(context, count, 1)?.len());
            let mut samplers: Vec<_> = LEAF_SIZES.map(|size| made(&one, Sampler::Leaves(size))).into();
            if i == timed {
                samplers.push(made(&one, Sampler::Maximal));
                samplers.extend(LEAF_SIZES.map(|size| made(context, Sampler::Leaves(size))));
            }
            let calls: Vec<_> = samplers.iter().map(|made| made as &dyn Fn() -> Result<usize>).collect();
            let mut measured = in_turns(effort.rounds, &calls)?;
            let mut others = measured.split_off(LEAF_SIZES.len()).into_iter();
            by_count.push(measured);
            if i == timed {
                (reference, all_threads) = (others.next(), Some(others.collect::<Vec<_>>()));
            }
            _ = progress((i + 1) as f64 / counts.len() as f64);
        }
        let (reference, all_threads) = reference.zip(all_threads).expect("the rates are those of one of the numbers");
        let leaf = |(leaf, leaf_size): (usize, f64)| {
            let domain = Domain::unit(Boundary::Periodic);
            let options = kdrt::Options::new(radius(effort.timed)).domain(domain).leaf_size(leaf_size).seed(1);
            Ok(LeafTimes {
                leaf_size,
                one_thread: by_count.iter().map(|leaves: &Vec<Rounds>| leaves[leaf].clone()).collect(),
                all_threads: all_threads[leaf].clone(),
                stages: kdrt::stages::measure(&options)?,
            })
        };
        let leaves = LEAF_SIZES.into_iter().enumerate().map(leaf).collect::<Result<_>>()?;
        Ok(Self { leaves, reference, timed, threads: context.num_threads() })
    }
}
