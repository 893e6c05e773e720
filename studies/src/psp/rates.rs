//! How fast sets are made: by radius, by iterations before filling, on one thread and on all.

use azulejo::psp::{Options, Priority, Psp, Report};
use azulejo::{Context, Progress, Result};

use super::Effort;
use super::scenes::{Scene, radius};

/// How many iterations before filling are tried, of three directions each.
pub const ITERATIONS: std::ops::RangeInclusive<u32> = 0..=4;

/// A maximal set in the making: after the iterations, and filled.
#[derive(Clone, Copy)]
pub struct Stages {
    pub radius: f64,
    pub iterated: Report,
    pub filled: Report,
}

impl Stages {
    fn of(context: &Context, scene: &Scene, count: f64, priority: Priority, iterations: u32) -> Result<Self> {
        let radius = radius(&scene.mesh, count);
        let mut psp = Psp::new(&scene.mesh, &Options::new(radius).priority(priority))?;
        let iterated = psp.advance(context, iterations, None)?;
        Ok(Self { radius, iterated, filled: psp.fill(context, None)? })
    }

    /// The faster of two attempts: noise only adds.
    fn least(context: &Context, scene: &Scene, count: f64, priority: Priority, iterations: u32) -> Result<Self> {
        let [first, second] = [(); 2].map(|()| Self::of(context, scene, count, priority, iterations));
        let (first, second) = (first?, second?);
        Ok(if first.seconds() < second.seconds() { first } else { second })
    }

    pub fn seconds(&self) -> f64 {
        self.iterated.seconds + self.filled.seconds
    }

    /// Samples per second of the iterations alone.
    pub fn iterated_rate(&self) -> f64 {
        self.iterated.samples as f64 / self.iterated.seconds
    }

    /// Samples per second to the end.
    pub fn rate(&self) -> f64 {
        self.filled.samples as f64 / self.seconds()
    }
}

/// The rates on one scene.
pub struct Rates {
    /// One iteration and a fill, from few samples to many.
    pub by_count: Vec<Stages>,
    /// By [`ITERATIONS`], in order of squareness.
    pub by_iterations: Vec<Stages>,
    /// One iteration and a fill, in order of projectors.
    pub by_projector: Stages,
    /// One iteration and a fill on one thread.
    pub one_thread: Stages,
    /// Darts of a second fill, and samples that it added: none if the first one left nothing.
    pub again: Report,
}

impl Rates {
    pub fn measure(context: &Context, scene: &Scene, effort: &Effort, progress: &Progress) -> Result<Self> {
        let stages = |count, priority, iterations| Stages::least(context, scene, count, priority, iterations);
        let by_count = effort.counts.iter().map(|&count| stages(count, Priority::Squareness, 1));
        let by_count = by_count.collect::<Result<_>>()?;
        _ = progress(0.35);
        let by_iterations = ITERATIONS.map(|iterations| stages(effort.samples, Priority::Squareness, iterations));
        let by_iterations = by_iterations.collect::<Result<_>>()?;
        _ = progress(0.7);
        let by_projector = stages(effort.samples, Priority::Projector, 1)?;
        let one_thread = Stages::of(&Context::new(1)?, scene, effort.samples, Priority::Squareness, 1)?;
        _ = progress(0.9);
        let mut psp = Psp::new(&scene.mesh, &Options::new(radius(&scene.mesh, effort.samples)))?;
        psp.advance(context, 1, None)?;
        psp.fill(context, None)?;
        Ok(Self { by_count, by_iterations, by_projector, one_thread, again: psp.fill(context, None)? })
    }
}
