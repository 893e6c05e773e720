//! A set that grows, call by call: iterations of three projectors, and filling.

use std::sync::Arc;
use std::time::Instant;

use glam::DMat3;

use crate::error::{Error, Result};
use crate::job::{Context, Job, Progress};
use crate::mesh::Mesh;
use crate::points::{SurfaceSamples, check_radius, check_resolution};
use crate::psp::estimate::{expected_samples, is_worth_projecting};
use crate::psp::fill;
use crate::psp::fill::triangles::Measures;
use crate::psp::merge;
use crate::psp::options::Options;
use crate::psp::project::collector::Collector;
use crate::psp::project::projection::Projection;
use crate::psp::project::projector::{self, Projector};
use crate::psp::report::Report;
use crate::psp::samples::SampleSet;

/// Memory per sample at the peak, twice of what was measured (bunny with three million samples: 110 bytes when a fill starts
/// from nothing, 145 with an iteration, the samples handed out included): what lies scattered takes more.
const BYTES_PER_SAMPLE: f64 = 300.0;

/// A set of samples on a mesh that grows, call by call.
///
/// After a cancelled or failed call it holds what was accepted until then, which is a valid set, and can be used on.
pub struct Psp {
    mesh: Arc<Mesh>,
    options: Options,
    samples: SampleSet,
    measures: Arc<Measures>,
    /// Whether iterations are worth their rays.
    projects: bool,
    /// Made by the first iteration.
    projection: Option<Projection>,
    iterations: u32,
    /// The frame of the last iteration.
    frame: Option<DMat3>,
}

impl Psp {
    /// An empty set on a mesh.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a `radius` that is not positive and finite, or below 64 float spacings at the
    /// largest coordinate of the mesh: floats cannot carry it. [`Error::TooLarge`] where it would ask for more than
    /// 2^32 samples, or more than memory holds.
    pub fn new(mesh: &Arc<Mesh>, options: &Options) -> Result<Self> {
        let radius = options.radius;
        check_radius(radius)?;
        let measures = mesh.kept(|| Ok(()), || Ok(Measures::of(mesh)))?;
        let estimate = expected_samples(mesh, &measures, radius);
        if estimate > u32::MAX as f64 {
            let reason = format!("{radius:?} asks for about {estimate:.3e} samples; the limit is {}", u32::MAX);
            return Err(Error::too_large("radius", reason));
        }
        check_resolution("radius", radius, mesh.float_spacing(), "the largest coordinate of the mesh")?;
        crate::memory::require(estimate * BYTES_PER_SAMPLE, "radius", &format!("about {estimate:.3e} samples"))?;
        Ok(Self {
            mesh: mesh.clone(),
            options: *options,
            samples: SampleSet::new(mesh, radius),
            measures,
            projects: is_worth_projecting(mesh, radius, estimate),
            projection: None,
            iterations: 0,
            frame: None,
        })
    }

    /// Makes more iterations. Samples are only added; two calls add what one call with the sum of their iterations adds.
    ///
    /// Time grows with the area of the mesh's box over the squared radius, and with the hits. Where that is out of all
    /// proportion to the surface, as for small parts far apart (more than 20 rays for each sample that can stand
    /// on the surface, and 10 million rays in all), nothing is done and the report counts no iteration: use [`Psp::fill`].
    ///
    /// # Errors
    /// [`Error::Cancelled`] by the progress callback: the interrupted iteration adds nothing and is made anew by the next
    /// call. [`Error::Embree`] where Embree cannot take the mesh.
    pub fn advance(&mut self, context: &Context, iterations: u32, progress: Option<&Progress>) -> Result<Report> {
        let start = Instant::now();
        let mut report = Report::default();
        context.run(progress, |job| self.iterate(job, iterations, &mut report))?;
        Ok(self.finish(report, start))
    }

    /// Adds samples until the set is maximal. Every part of the mesh, however small, that no other sample covers gets one.
    ///
    /// # Errors
    /// [`Error::Cancelled`] by the progress callback: samples added until then stay.
    pub fn fill(&mut self, context: &Context, progress: Option<&Progress>) -> Result<Report> {
        let start = Instant::now();
        let mut report = Report::default();
        context.run(progress, |job| self.complete(job, &mut report))?;
        Ok(self.finish(report, start))
    }

    /// A copy of the samples, in the order in which they were accepted.
    pub fn samples(&self) -> SurfaceSamples {
        self.samples.to_surface_samples(&self.mesh)
    }

    /// The number of samples.
    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// Whether there is no sample yet.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The directions in which the projectors of the last iteration looked: orthogonal unit vectors, by the number of the
    /// projector. They depend on the seed and the iterations, not on the mesh. For measurements.
    #[doc(hidden)]
    pub fn directions(&self) -> Option<[[f64; 3]; 3]> {
        self.frame.map(|frame| frame.to_cols_array_2d())
    }

    fn iterate(&mut self, job: &Job, iterations: u32, report: &mut Report) -> Result<()> {
        let iterations = if self.projects { iterations } else { 0 };
        for step in 0..iterations {
            let share = |step: u32| f64::from(step) / f64::from(iterations);
            let job = job.part(share(step), share(step + 1));
            let mut stage = Stopwatch::start();
            let prepared = if self.projection.is_some() { 0.0 } else { 0.3 };
            let projection = match &mut self.projection {
                Some(projection) => projection,
                none => none.insert(Projection::new(&job.part(0.0, prepared), &self.mesh, &self.options)?),
            };
            report.prepare_seconds += stage.lap();
            let Options { seed, priority, .. } = self.options;
            let frame = projector::frame(seed, self.iterations, self.frame);
            let projectors = &Projector::all(frame, seed, self.iterations);
            let collector = Collector { mesh: &self.mesh, samples: &self.samples, priority, projectors };
            let (candidates, projected) = projection.project(&job.part(prepared, 0.7), projectors, &collector)?;
            report.project_seconds += stage.lap();
            let accepted = merge::merge(&job.part(0.7, 1.0), &mut self.samples, &candidates)?;
            report.merge_seconds += stage.lap();
            self.iterations += 1;
            self.frame = Some(frame);

            report.iterations += 1;
            report.accepted += accepted;
            report.rays += projected.rays;
            report.hits += projected.hits;
            report.restart_conflicts += projected.restart_conflicts;
            report.conflicts += projected.hits - projected.restart_conflicts - accepted;
        }
        Ok(())
    }

    fn complete(&mut self, job: &Job, report: &mut Report) -> Result<()> {
        let (mut stage, before) = (Stopwatch::start(), self.len());
        let filled = fill::fill(job, &self.mesh, &self.measures, &mut self.samples, self.options.seed)?;
        let accepted = (self.len() - before) as u64;
        report.fill_seconds += stage.lap();
        report.accepted += accepted;
        report.darts += filled.darts;
        report.conflicts += filled.darts - accepted;
        let area = self.mesh.area();
        report.uncovered_before = Some(if area > 0.0 { filled.open_area / area } else { 0.0 });
        report.uncovered_after = Some(0.0);
        Ok(())
    }

    fn finish(&self, report: Report, start: Instant) -> Report {
        let hexagonal = (2.0 * self.mesh.area() / (3f64.sqrt() * self.len() as f64)).sqrt();
        Report {
            samples: self.len() as u64,
            seconds: start.elapsed().as_secs_f64(),
            rho: if self.is_empty() { 0.0 } else { self.options.radius / hexagonal },
            ..report
        }
    }
}

/// Wall times of stages that follow each other.
struct Stopwatch(Instant);

impl Stopwatch {
    fn start() -> Self {
        Self(Instant::now())
    }

    /// The seconds since the start or the last lap.
    fn lap(&mut self) -> f64 {
        let start = std::mem::replace(&mut self.0, Instant::now());
        (self.0 - start).as_secs_f64()
    }
}

/// Samples a mesh in one call: [`Psp::new`], [`Psp::advance`] by [`Options::iterations_by_rule`] and, if `maximal`,
/// [`Psp::fill`].
///
/// # Errors
/// Those of the three. Where the call is cancelled nothing is returned.
pub fn sample(
    context: &Context,
    mesh: &Arc<Mesh>,
    options: &Options,
    progress: Option<&Progress>,
) -> Result<(SurfaceSamples, Report)> {
    let start = Instant::now();
    let mut psp = Psp::new(mesh, options)?;
    let mut report = Report::default();
    context.run(progress, |job| {
        let iterations = options.iterations_by_rule();
        let share = match (options.maximal, iterations) {
            (false, _) => 1.0,
            (true, 0) => 0.0,
            (true, _) => 0.5,
        };
        psp.iterate(&job.part(0.0, share), iterations, &mut report)?;
        if options.maximal {
            psp.complete(&job.part(share, 1.0), &mut report)?;
        }
        Ok(())
    })?;
    Ok((psp.samples(), psp.finish(report, start)))
}
