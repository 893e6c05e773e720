//! Progressive sample projection (PSP): Poisson-disk samples on triangle meshes (thesis chapter 3).
//!
//! A planar Poisson-disk pattern is projected along three orthogonal directions through the mesh; all hits on all rays
//! are candidates; those that conflict with nothing of higher priority become samples. More iterations from other
//! directions only add. [`Psp::fill`] then finds what is still uncovered and closes it, which makes the set maximal.
//!
//! * *Conflict-free*: no two samples are closer than the radius, in `f64` from the returned floats, in straight lines
//!   through space (not along the surface).
//! * *Maximal*: no point of the surface, but for what the mesh's mask leaves out, is farther from every sample than the
//!   radius and [`TOLERANCE`] float spacings at the largest coordinate of the mesh.
//! * *Deterministic*: the samples and their order depend on mesh, radius, seed and the sequence of calls, not on the
//!   number of threads. Between machines whose Embree traces packets of another width the last bits of a hit can differ.

use std::sync::Arc;
use std::time::Instant;

use glam::DMat3;

use crate::error::{Error, Result};
use crate::job::{Context, Job, Progress};
use crate::mesh::{Mesh, exact};
use crate::points::{SurfaceSamples, check_radius};
use crate::setters::setters;

pub mod adaptive;
mod blocks;
mod cover;
mod coverage;
mod fill;
mod measure;
mod merge;
mod near;
mod pieces;
mod project;
mod room;
mod samples;
#[allow(unsafe_code)] // Vector instructions.
mod vectors;

pub use fill::TOLERANCE;
#[doc(hidden)]
pub use measure::{Stages, measure};
use project::projector::{Collector, Projection, Projector};
use samples::SampleSet;

/// The number of iterations after which a maximal set is finished soonest: what the projectors do not find is filled.
/// (10^9 cycles to the end, a million samples, for 0, 1, 2, 3: 12.5, 6.8, 8.9, 11.0 on the bunny, 15.8, 11.1, 14.2, 17.2 on
/// the dragon, of which 1 and 5 are those of loading it.)
pub const DEFAULT_ITERATIONS: u32 = 1;

/// Samples of a maximal set on an area of radius²: the jamming limit of disks that arrive at random covers 0.547 of the
/// plane, which is 0.6966 samples (Feder 1980). Rounded up.
const DENSITY: f64 = 0.7;
/// Memory per sample at the peak, twice of what was measured (bunny with three million samples: 110 bytes when a fill starts
/// from nothing, 145 with an iteration, the samples handed out included): what lies scattered takes more.
const BYTES_PER_SAMPLE: f64 = 300.0;

/// An iteration is left out where it would trace more rays than this for each sample that there is room for. Parts far apart
/// in a large box are hit that rarely. (Filling alone is as fast from 5 rays per sample on, measured on dust, and nearly
/// twice as fast with 27; up to there an iteration that was asked for is made.) ...
const RAYS_PER_SAMPLE: f64 = 20.0;
/// ... unless it has no more rays than this, a moment's work.
const RAYS_ALWAYS: f64 = 1e7;

/// Which of an iteration's candidates comes first where two of them are too close. Existing samples come before all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Priority {
    /// That which its projector faces more squarely: there the pattern is stretched less. Finds more samples.
    #[default]
    Squareness,
    /// That of the projector with the lower number (thesis §3.3.2).
    Projector,
}

/// What finds the hits of the projectors. Both find the same ones, up to rounding: points and edges move against each
/// other by up to 2e-7 of the mesh's diagonal, as their projector sees them. A point that near to an edge may fall on
/// the other side, and barycentrics differ by up to this over the height of their triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Engine {
    /// Packets of rays through the hierarchy of Embree: it takes the longer the more rays there are.
    #[default]
    Embree,
    /// Triangles drawn over the pattern in exact integer arithmetic (thesis §3.4.3): it takes the longer the more triangles
    /// there are. A point on an edge that triangles share hits one of them on either side, never none or both.
    Rasteriser,
}

/// What to sample.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The smallest distance of two samples, in the units of the mesh; positive and finite.
    pub radius: f64,
    /// Iterations of three projectors each, 0 and up. Used by [`sample`] only.
    pub iterations: u32,
    /// Whether to fill what the projectors leave uncovered. Used by [`sample`] only.
    pub maximal: bool,
    /// Selects one of 2^64 sets.
    pub seed: u64,
    /// Which candidates come first.
    pub priority: Priority,
    /// What finds the hits.
    pub engine: Engine,
}

impl Options {
    /// A maximal set, by the default number of iterations.
    pub fn new(radius: f64) -> Self {
        Self {
            radius,
            iterations: DEFAULT_ITERATIONS,
            maximal: true,
            seed: 0,
            priority: Priority::default(),
            engine: Engine::default(),
        }
    }
}

setters!(Options { radius: f64, iterations: u32, maximal: bool, seed: u64, priority: Priority, engine: Engine });

/// What a call did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// Samples there are after the call.
    pub samples: u64,
    /// Samples that the call added.
    pub accepted: u64,
    /// Iterations that the call made.
    pub iterations: u32,
    /// Rays traced: those that meet the mesh's box. With the rasteriser, the points of its tiles (at most 48 radii wide)
    /// that have triangles near them.
    pub rays: u64,
    /// Hits on the rays.
    pub hits: u64,
    /// Hits lost to an earlier hit on the same ray.
    pub restart_conflicts: u64,
    /// Darts thrown at uncovered surface by a fill.
    pub darts: u64,
    /// Hits and darts lost to other samples or candidates.
    pub conflicts: u64,
    /// Wall time of the call.
    pub seconds: f64,
    /// The part of it in which the pattern and, for Embree, the scene were made: in the first iteration only.
    pub prepare_seconds: f64,
    /// The part of it in which the hits were found.
    pub project_seconds: f64,
    /// The part of it in which samples were chosen among the hits.
    pub merge_seconds: f64,
    /// The part of it in which uncovered surface was searched and filled.
    pub fill_seconds: f64,
    /// The relative radius of the set after the call, `radius / d_max`: `d_max = sqrt(2 A / (sqrt(3) N))` would be the
    /// distance of N neighbours in hexagonal order on the area A. 0.78 for darts until nothing fits (thesis §1.4); 0 for
    /// no samples. The smallest distance is taken to be the radius; that of a large set is less than a millionth above.
    pub rho: f64,
    /// For a fill, the share of the mesh's area that was uncovered before it. It is an estimate from above, two or three
    /// times too large: the area of the small fragments that no single sample covers when the search comes to them.
    pub uncovered_before: Option<f64>,
    /// For a fill, the share of the area that is uncovered after it: 0, up to [`TOLERANCE`].
    pub uncovered_after: Option<f64>,
}

/// A set of samples on a mesh that grows, call by call.
///
/// After a cancelled or failed call it holds what was accepted until then, which is a valid set, and can be used on.
pub struct Psp {
    mesh: Arc<Mesh>,
    options: Options,
    samples: SampleSet,
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
        let estimate = expected_samples(mesh, radius);
        if estimate > u32::MAX as f64 {
            let reason = format!("{radius:?} asks for about {estimate:.3e} samples; the limit is {}", u32::MAX);
            return Err(Error::too_large("radius", reason));
        }
        let spacing = fill::float_spacing(mesh);
        if radius < 64.0 * spacing {
            let largest = mesh.largest_coordinate();
            let reason = format!(
                "{radius:?} is below 64 float spacings ({:e}) at the largest coordinate of the mesh, {largest}",
                64.0 * spacing
            );
            return Err(Error::invalid("radius", reason));
        }
        crate::memory::require(estimate * BYTES_PER_SAMPLE, "radius", &format!("about {estimate:.3e} samples"))?;
        Ok(Self {
            mesh: mesh.clone(),
            options: *options,
            samples: SampleSet::new(mesh, radius),
            projects: mesh.area() > 0.0 && expected_rays(mesh, radius) <= RAYS_ALWAYS.max(RAYS_PER_SAMPLE * estimate),
            projection: None,
            iterations: 0,
            frame: None,
        })
    }

    /// Makes more iterations. Samples are only added; two calls add what one call with the sum of their iterations adds.
    ///
    /// Time grows with the area of the mesh's box over the squared radius, and with the hits. Where that is out of all
    /// proportion to the surface, as for small parts far apart (more than 20 rays for each sample that there is room
    /// for, and 10 million rays at all), nothing is done and the report counts no iteration: [`Psp::fill`] is the way.
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
            let frame = project::projector::frame(seed, self.iterations, self.frame);
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
        let filled = fill::fill(job, &self.mesh, &mut self.samples, self.options.seed)?;
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

/// How many samples a maximal set has, rather too many: those of the area, and those along triangles that are longer
/// than the radius, since a needle has length and hardly any area.
fn expected_samples(mesh: &Mesh, radius: f64) -> f64 {
    let along = |triangle: u32| {
        let longest = longest_edge(mesh, triangle);
        if longest > radius { longest / radius } else { 0.0 }
    };
    let lengths: f64 = mesh.sampled_triangles().map(along).sum();
    DENSITY * mesh.area() / (radius * radius) + lengths
}

fn longest_edge(mesh: &Mesh, triangle: u32) -> f64 {
    let [a, b, c] = mesh.corners(triangle).map(exact);
    (b - a).length().max((c - b).length()).max((a - c).length())
}

/// What an iteration costs, counted in rays: one for each pattern point in the shadow of the mesh's box, and a sixteenth
/// for each point that has to be looked at on the way.
///
/// The shadows on three orthogonal planes are largest along the diagonals of a cube, sqrt(3) times its three sides.
fn expected_rays(mesh: &Mesh, radius: f64) -> f64 {
    let (low, high) = mesh.bounds();
    let diagonal = exact(high) - exact(low);
    let [a, b, c] = diagonal.to_array();
    let (shadows, projectors) = (3f64.sqrt() * (a * b + b * c + c * a), 3.0 * diagonal.length_squared());
    DENSITY * (shadows + projectors / 16.0) / (radius * radius)
}

/// Samples a mesh in one call: [`Psp::new`], [`Psp::advance`] and, if `maximal`, [`Psp::fill`].
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
        let share = if options.maximal { 0.5 } else { 1.0 };
        psp.iterate(&job.part(0.0, share), options.iterations, &mut report)?;
        if options.maximal {
            psp.complete(&job.part(share, 1.0), &mut report)?;
        }
        Ok(())
    })?;
    Ok((psp.samples(), psp.finish(report, start)))
}
