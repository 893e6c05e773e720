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

/// Attempts on one thread and as many on all.
pub const ATTEMPTS: usize = 3;

/// The seconds of the same work on one thread and on all.
pub struct SpeedUp {
    pub one_thread: [f64; ATTEMPTS],
    pub all_threads: [f64; ATTEMPTS],
}

impl SpeedUp {
    /// In turns: what else the machine does comes to both alike.
    fn measure(context: &Context, scene: &Scene, count: f64) -> Result<Self> {
        let single = Context::new(1)?;
        let (mut one_thread, mut all_threads) = ([0.0; ATTEMPTS], [0.0; ATTEMPTS]);
        for (one, all) in one_thread.iter_mut().zip(&mut all_threads) {
            for (context, seconds) in [(&single, one), (context, all)] {
                *seconds = Stages::of(context, scene, count, Priority::Squareness, 1)?.seconds();
            }
        }
        Ok(Self { one_thread, all_threads })
    }

    /// The least of one thread over the least of all: noise only adds.
    pub fn factor(&self) -> f64 {
        let least = |seconds: &[f64]| seconds.iter().copied().fold(f64::INFINITY, f64::min);
        least(&self.one_thread) / least(&self.all_threads)
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
    /// One iteration and a fill on one thread and on all, in turns.
    pub speed_up: SpeedUp,
    pub again: Again,
}

/// What a second fill adds to a set that is maximal.
pub struct Again {
    pub samples: usize,
    /// How much more than the radius the farthest of them is from all samples before, in float spacings at the largest
    /// coordinate of the mesh: to [`TOLERANCE`](azulejo::psp::TOLERANCE) a surface may be uncovered.
    pub beyond: f64,
}

impl Again {
    fn measure(context: &Context, scene: &Scene, count: f64) -> Result<Self> {
        let radius = radius(&scene.mesh, count);
        let mut psp = Psp::new(&scene.mesh, &Options::new(radius))?;
        psp.advance(context, 1, None)?;
        psp.fill(context, None)?;
        let before = psp.samples().positions;
        psp.fill(context, None)?;
        let after = psp.samples().positions;
        let squared = |p: &[f32; 3], q: &[f32; 3]| (0..3).map(|k| (f64::from(p[k]) - f64::from(q[k])).powi(2)).sum();
        let nearest = |p: &[f32; 3]| before.iter().map(|q| squared(p, q)).fold(f64::INFINITY, f64::min).sqrt();
        let farthest = after[before.len()..].iter().map(nearest).fold(0.0, f64::max);
        let (low, high) = scene.mesh.bounds();
        let largest = low.into_iter().chain(high).fold(0.0f32, |largest, x| largest.max(x.abs()));
        let spacing = f64::from(largest) - f64::from(largest.next_down());
        Ok(Self { samples: after.len() - before.len(), beyond: (farthest - radius) / spacing })
    }
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
        let speed_up = SpeedUp::measure(context, scene, effort.samples)?;
        _ = progress(0.9);
        let again = Again::measure(context, scene, effort.samples)?;
        Ok(Self { by_count, by_iterations, by_projector, speed_up, again })
    }
}
