//! The speed of sampling: by radius, by iterations before filling, on one thread and on all.

use std::ops::RangeInclusive;

use azulejo::analysis::coverage::surface_covering_radius;
use azulejo::psp::{Priority, ProjectionOptions, Projectors, Psp, Report};
use azulejo::{Context, Progress, Result};

use super::Effort;
use super::scenes::{Scene, radius};
use crate::repeated::Repeated;

/// The numbers of iterations before filling that are tried, of three directions each.
pub const ITERATIONS: RangeInclusive<u32> = 0..=4;

/// A maximal set that is made in some rounds: after the iterations, and filled.
#[derive(Clone)]
pub struct Stages {
    pub radius: f64,
    /// Samples after the iterations, and in the end.
    pub iterated: f64,
    pub filled: f64,
    /// The seconds of both stages.
    pub iterating: Repeated,
    pub filling: Repeated,
}

impl Stages {
    fn new(radius: f64, rounds: &[[Report; 2]]) -> Self {
        let [iterated, filled] = rounds[0].each_ref().map(|report| report.samples as f64);
        let [iterating, filling] =
            [0, 1].map(|stage| Repeated::new(rounds.iter().map(|reports| reports[stage].seconds).collect()));
        Self { radius, iterated, filled, iterating, filling }
    }

    pub fn seconds(&self) -> Repeated {
        self.iterating.with(&self.filling, |iterating, filling| iterating + filling)
    }

    /// Samples per second of the iterations alone.
    pub fn iterated_rate(&self) -> Repeated {
        self.iterating.map(|seconds| self.iterated / seconds)
    }

    /// Samples per second to the end.
    pub fn rate(&self) -> Repeated {
        self.seconds().map(|seconds| self.filled / seconds)
    }
}

/// Sets with the projectors of the thesis.
fn global(radius: f64) -> ProjectionOptions<'static> {
    ProjectionOptions::new(radius).projectors(Projectors::Global)
}

/// A way to make a set.
struct Way<'a> {
    context: &'a Context,
    count: f64,
    priority: Priority,
    iterations: u32,
}

impl Way<'_> {
    fn make(&self, scene: &Scene) -> Result<[Report; 2]> {
        let mut psp = Psp::new(&scene.mesh, &global(radius(&scene.mesh, self.count)).priority(self.priority))?;
        Ok([psp.advance(self.context, self.iterations, None)?, psp.fill(self.context, None)?])
    }

    /// Makes sets in all of these ways, in turns.
    fn make_all(ways: &[Self], scene: &Scene, rounds: usize) -> Result<Vec<Stages>> {
        let mut reports = vec![Vec::new(); ways.len()];
        for _ in 0..rounds {
            for (way, reports) in ways.iter().zip(&mut reports) {
                reports.push(way.make(scene)?);
            }
        }
        let all = ways.iter().zip(&reports);
        Ok(all.map(|(way, reports)| Stages::new(radius(&scene.mesh, way.count), reports)).collect())
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
    pub again: Again,
    /// The seconds of the first set by projection, which builds Embree's scene.
    pub first_call: f64,
}

impl Rates {
    pub fn measure(context: &Context, scene: &Scene, effort: &Effort, progress: &Progress) -> Result<Self> {
        let (single, count) = (Context::new(1)?, effort.samples);
        let usual = |iterations| Way { context, count, priority: Priority::Squareness, iterations };
        // The first call makes the data that are kept with the mesh. It is made before the rounds, which compare later
        // calls.
        let first_call = usual(1).make(scene)?.iter().map(|report| report.seconds).sum();
        // The calls that verdicts and sentences are about.
        let judged = [
            usual(0),
            usual(1),
            Way { priority: Priority::Projector, ..usual(1) },
            Way { context: &single, ..usual(1) },
        ];
        let mut judged = Way::make_all(&judged, scene, effort.judged_rounds)?.into_iter();
        let mut next = || judged.next().expect("a set is made in each way");
        let [none, one, by_projector, one_thread] = [(); 4].map(|()| next());
        _ = progress(0.5);
        let more: Vec<_> = ITERATIONS.skip(2).map(usual).collect();
        let by_iterations = [none, one.clone()].into_iter().chain(Way::make_all(&more, scene, effort.rounds)?);
        let by_iterations = by_iterations.collect();
        _ = progress(0.7);
        let others = effort.counts.iter().filter(|&&other| other != count);
        let others: Vec<_> = others.map(|&count| Way { count, ..usual(1) }).collect();
        // The set of the verdicts is one of these.
        let mut by_count = Way::make_all(&others, scene, effort.rounds)?;
        by_count.push(one);
        by_count.sort_by(|a, b| b.radius.total_cmp(&a.radius));
        _ = progress(0.9);
        let again = Again::measure(context, scene, count)?;
        Ok(Self { by_count, by_iterations, by_projector, one_thread, again, first_call })
    }

    /// One iteration and a fill on all threads, by squareness.
    pub fn usual(&self) -> &Stages {
        &self.by_iterations[1]
    }
}

/// The samples that are still found in a set that is maximal: up to [`TOLERANCE`](azulejo::psp::TOLERANCE) float
/// spacings at the largest coordinate of the mesh a surface may be uncovered.
pub struct Again {
    /// Samples that a second fill adds.
    pub samples: usize,
    /// The covering radius less the radius, in float spacings: of the place farthest from all samples.
    pub beyond: f64,
}

impl Again {
    fn measure(context: &Context, scene: &Scene, count: f64) -> Result<Self> {
        let radius = radius(&scene.mesh, count);
        let mut psp = Psp::new(&scene.mesh, &global(radius))?;
        psp.advance(context, 1, None)?;
        psp.fill(context, None)?;
        let farthest = surface_covering_radius(context, &scene.mesh, &psp.samples().positions, None)?;
        let before = psp.len();
        psp.fill(context, None)?;
        let (low, high) = scene.mesh.bounds();
        let largest = low.into_iter().chain(high).fold(0.0f32, |largest, x| largest.max(x.abs()));
        let spacing = f64::from(largest) - f64::from(largest.next_down());
        Ok(Self { samples: psp.len() - before, beyond: (farthest - radius) / spacing })
    }
}
