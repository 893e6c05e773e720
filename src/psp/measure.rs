//! How long each stage of PSP takes, for the benchmark.

use std::sync::Arc;
use std::time::Duration;

use crate::error::Result;
use crate::job::Context;
use crate::mesh::{Mesh, exact};
use crate::points::SurfaceSamples;
use crate::psp::project::pattern::Pattern;
use crate::psp::{Options, Psp, Stopwatch};

/// What the stages of a maximal set by one iteration did and took.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stages {
    /// Samples that the iteration found.
    pub found: u64,
    /// Samples of the maximal set.
    pub samples: u64,
    /// Rays traced by the iteration.
    pub rays: u64,
    /// Making the pattern.
    pub pattern: Duration,
    /// Building Embree's scene.
    pub scene: Duration,
    /// Making and tracing rays, and sorting the hits by blocks.
    pub project: Duration,
    /// Choosing among the hits, which puts the chosen ones into the set.
    pub merge: Duration,
    /// Filling what is uncovered.
    pub fill: Duration,
    /// Handing out the samples.
    pub output: Duration,
}

/// Measures the stages of [`sample`](super::sample) with one iteration, with the set that it would make.
///
/// The scene is built together with the pattern; the pattern is made once more to tell them apart.
///
/// # Errors
/// Those of [`sample`](super::sample).
pub fn measure(context: &Context, mesh: &Arc<Mesh>, options: &Options) -> Result<(SurfaceSamples, Stages)> {
    let (mut psp, mut stages) = (Psp::new(mesh, options)?, Stages::default());
    let (low, high) = mesh.bounds();
    let extent = (exact(high) - exact(low)).length() / options.radius;
    let (mut watch, seconds) = (Stopwatch::start(), Duration::from_secs_f64);
    context.run(None, |job| Pattern::new(job, extent, options.seed).map(drop))?;
    stages.pattern = seconds(watch.lap());
    let report = psp.advance(context, 1, None)?;
    stages.scene = seconds(report.prepare_seconds).saturating_sub(stages.pattern);
    stages.project = seconds(report.project_seconds);
    stages.merge = seconds(report.merge_seconds);
    (stages.rays, stages.found) = (report.rays, report.accepted);
    stages.fill = seconds(psp.fill(context, None)?.fill_seconds);
    stages.samples = psp.len() as u64;
    watch.lap();
    let samples = psp.samples();
    stages.output = seconds(watch.lap());
    Ok((samples, stages))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stages_make_the_set_that_sampling_makes() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.2], [0.0, 1.0, 0.4], [1.0, 1.0, 1.0]];
        let mesh = Arc::new(Mesh::new(corners.into(), vec![[0, 1, 2], [3, 2, 1]]).unwrap());
        let options = Options::new(0.03).iterations(1).seed(4);
        let context = Context::new(2).unwrap();
        let (samples, stages) = measure(&context, &mesh, &options).unwrap();
        let (expected, report) = crate::psp::sample(&context, &mesh, &options, None).unwrap();
        assert_eq!(samples, expected);
        assert_eq!((stages.samples, stages.rays), (report.samples, report.rays));
        assert!(0 < stages.found && stages.found < stages.samples);
    }
}
