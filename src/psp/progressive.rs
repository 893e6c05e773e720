//! Sets of one radius or count: in one call, by the faster way or level by level ([`sample`]), by projection ([`project`]),
//! or growing call by call ([`Psp`]).

use std::f64::consts::PI;
use std::sync::Arc;

use crate::error::{Error, Result};
use crate::host::Stopwatch;
use crate::job::{Context, Job, Progress};
use crate::levels::{self, Amount, Levels};
use crate::memory;
use crate::mesh::Mesh;
use crate::order::Order;
use crate::points::{Points, finest_radius};
use crate::psp::editable::{EditableSet, OnMesh};
use crate::psp::fill::{BYTES_PER_SAMPLE, FillOptions, Measures, ONE_PIECE, Surface};
use crate::psp::fragment::Facing;
use crate::psp::given::{GivenSamples, balls};
use crate::psp::options::{FlatOptions, Options, ProjectionOptions, Projectors, Request, check_quotient};
use crate::psp::project::{Pass, Projection, is_sooner_projected, is_worth_projecting};
use crate::psp::report::{Report, rho};
use crate::psp::set::{Sample, SampleSet};

/// A set of samples on a mesh that grows, call by call.
///
/// After a cancelled or failed call it holds the samples accepted until then, which are a valid set, and remains
/// usable.
pub struct Psp {
    mesh: Arc<Mesh>,
    options: ProjectionOptions<'static>,
    given: GivenSamples,
    /// The position and the clearance of each given sample.
    obstacles: Vec<([f32; 3], f64)>,
    facing: Facing,
    samples: SampleSet,
    /// True if the set is known to be maximal.
    is_maximal: bool,
    measures: Arc<Measures>,
    /// True if iterations are worth their rays.
    projects: bool,
    /// Made by the first iteration.
    projection: Option<Projection>,
    iterations: u32,
}

impl Psp {
    /// An empty set on a mesh.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a `radius` that is not positive and finite, or below 64 float spacings at the
    /// largest coordinate of the mesh: floats are too coarse for it; for a `cosine` outside -1 to 1; for `given`
    /// samples out of range, by their index (`given_positions`, `given_clearances`). [`Error::TooLarge`] if the radius
    /// would require more than 2^32 samples on the bare surface, or more than memory holds.
    pub fn new(mesh: &Arc<Mesh>, options: &ProjectionOptions) -> Result<Self> {
        let radius = options.radius;
        let measures = mesh.kept(|| Ok(()), || Ok(Measures::of(mesh)))?;
        let estimate = measures.checked_samples(mesh, radius, BYTES_PER_SAMPLE, options.given)?;
        let (facing, samples) = (Facing::new(options.cosine)?, SampleSet::new(mesh, radius));
        Ok(Self {
            mesh: mesh.clone(),
            options: options.without_given(),
            given: GivenSamples::new(mesh, options.given, radius, &samples, facing)?,
            obstacles: balls(options.given, radius).collect(),
            facing,
            samples,
            is_maximal: false,
            measures,
            projects: is_worth_projecting(mesh, options, estimate),
            projection: None,
            iterations: 0,
        })
    }

    /// Makes more iterations. Samples are only added; two calls add the same samples as one call with the sum of their
    /// iterations.
    ///
    /// Time grows with the hits and the triangles; with global projectors, with the area of the mesh's box over the squared
    /// radius, and with the hits. Where that is out of all proportion to the surface, as for small parts far apart (more
    /// than 20 rays for each sample that can stand on the surface, and 10 million rays in all), nothing is done and the
    /// report counts no iteration: use [`Psp::fill`].
    ///
    /// # Errors
    /// [`Error::Cancelled`] by the progress callback: the interrupted iteration adds nothing and is repeated by the
    /// next call. [`Error::InvalidArgument`] for iterations with a `cosine` above -1. [`Error::Embree`] where Embree
    /// cannot take the mesh.
    pub fn advance(&mut self, context: &Context, iterations: u32, progress: Option<&Progress>) -> Result<Report> {
        let stopwatch = Stopwatch::start();
        self.check_iterations(iterations)?;
        self.require_candidates(iterations, BYTES_PER_CANDIDATE)?;
        let mut report = Report::default();
        context.run(progress, |job| self.iterate(job, iterations, &mut report))?;
        Ok(self.finish(report, &stopwatch))
    }

    /// Adds samples until the set is maximal. Every part of the mesh, however small, that no other sample covers gets
    /// one.
    ///
    /// # Errors
    /// [`Error::Cancelled`] by the progress callback: samples added until then stay.
    pub fn fill(&mut self, context: &Context, progress: Option<&Progress>) -> Result<Report> {
        let stopwatch = Stopwatch::start();
        let mut report = Report::default();
        context.run(progress, |job| self.complete(job, &mut report))?;
        Ok(self.finish(report, &stopwatch))
    }

    /// The set as one that can be edited, in which its samples, in their order, have the ids 0, 1, 2 and so on, and so
    /// have its given samples. No more iterations can be made. O(samples).
    pub fn into_editable(self) -> EditableSet {
        let Self { mesh, options, obstacles, facing, samples, is_maximal, measures, .. } = self;
        let ground = OnMesh::new(mesh, measures, options.radius, facing);
        EditableSet::begin(ground, options.seed, samples.into_samples(), obstacles, is_maximal)
    }

    /// A copy of the samples, in the order in which they were accepted.
    pub fn samples(&self) -> Points<3> {
        self.samples.to_surface_samples(&self.mesh)
    }

    /// The number of samples.
    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// True if there is no sample yet.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The viewing directions of the global projectors in the last iteration: orthogonal unit vectors, by the number of
    /// the projector. They depend on the seed and the iterations, not on the mesh. For measurements.
    #[doc(hidden)]
    pub fn directions(&self) -> Option<[[f64; 3]; 3]> {
        match &self.projection {
            Some(Projection::Global(global)) => global.frame.map(|frame| frame.to_cols_array_2d()),
            _ => None,
        }
    }

    /// Refuses iterations of a set whose samples ignore others by their normals.
    fn check_iterations(&self, iterations: u32) -> Result<()> {
        if iterations > 0 && self.facing.asks_normals() {
            let reason = format!("{:?} with iterations; iterations require cosine = -1", self.options.cosine);
            return Err(Error::invalid("cosine", reason));
        }
        Ok(())
    }

    /// True if a maximal set takes less time if an iteration precedes the fill.
    fn is_sooner_projected(&self) -> Result<bool> {
        let Self { mesh, measures, options, .. } = self;
        if options.projectors != Projectors::Local || self.facing.asks_normals() {
            return Ok(false);
        }
        let covered = self.obstacles.iter().map(|(_, clearance)| PI * clearance * clearance).sum();
        is_sooner_projected(mesh, measures, options.radius, covered)
    }

    /// Refuses iterations for which memory does not suffice, with so many bytes per sample.
    fn require_candidates(&self, iterations: u32, bytes: f64) -> Result<()> {
        if iterations == 0 || self.iterations > 0 || !self.projects {
            return Ok(());
        }
        self.measures.require(&self.mesh, self.options.radius, bytes)
    }

    fn iterate(&mut self, job: &Job, iterations: u32, report: &mut Report) -> Result<()> {
        let iterations = if self.projects { iterations } else { 0 };
        for step in 0..iterations {
            let share = |step: u32| f64::from(step) / f64::from(iterations);
            let job = job.part(share(step), share(step + 1));
            let mut stage = Stopwatch::start();
            let prepared = if self.projection.is_some() { 0.0 } else { 0.3 };
            let Self { mesh, measures, given, options, iterations, .. } = self;
            let projection = match &mut self.projection {
                Some(projection) => projection,
                none => none.insert(Projection::new(&job.part(0.0, prepared), mesh, options)?),
            };
            report.prepare_seconds += stage.lap();
            let pass = Pass { mesh, measures, given, options, iteration: *iterations };
            projection.advance(&job.part(prepared, 1.0), &pass, &mut self.samples, report)?;
            self.iterations += 1;
        }
        Ok(())
    }

    fn complete(&mut self, job: &Job, report: &mut Report) -> Result<()> {
        let (mut stage, before) = (Stopwatch::start(), self.len());
        let Self { mesh, measures, given, facing, .. } = self;
        let surface = Surface { mesh, measures, given, facing: *facing };
        let options = FillOptions::around(&self.samples, self.options.seed);
        let filled = surface.fill(job, &mut self.samples, options)?;
        let accepted = (self.len() - before) as u64;
        report.fill_seconds += stage.lap();
        report.accepted += accepted;
        report.darts += filled.darts;
        report.conflicts += filled.darts - accepted;
        let area = self.mesh.area();
        report.uncovered_before = Some(if area > 0.0 { filled.open_area / area } else { 0.0 });
        report.uncovered_after = Some(0.0);
        self.is_maximal = true;
        Ok(())
    }

    fn finish(&self, report: Report, stopwatch: &Stopwatch) -> Report {
        Report {
            samples: self.len() as u64,
            seconds: stopwatch.seconds(),
            rho: rho(&self.mesh, self.len(), self.options.radius),
            radius: self.options.radius,
            covering_radius: report.uncovered_after.map(|_| self.options.radius),
            ..report
        }
    }
}

/// A maximal set in one call: by filling, and where that takes less time by an iteration of projection before it
/// ([`Options::projected`]).
///
/// With [`Amount::Count`] the set has exactly so many samples, and the report has the radius and a bound of the
/// covering radius. Takes about twice the time of a set of known radius.
///
/// In [`Order::Progressive`] the samples are sorted coarse to fine, and have [ranks](Points::ranks). For every prefix,
/// from the first sample on: no two samples of it are closer than the rank of its last one, and every place of the
/// surface is within [`Options::quotient`] times this rank of a sample of it, up to [`TOLERANCE`](super::TOLERANCE). A
/// set of fewer samples is a prefix of a set of more, on the same mesh with the same quotient and seed, to the bit.
/// Sets of two radii share the levels above both: all samples with a rank of at least the quotient times the larger
/// radius. Takes several times as long as a set in any order (docs/order.md), and more with many triangles for each
/// sample, as each of some `log(diagonal / radius) / log(quotient)` levels visits all triangles.
///
/// # Errors
/// Those of [`Psp::new`] and [`Psp::fill`], and [`Error::InvalidArgument`] for a count of 0 or of more than float
/// precision allows on the mesh, and for a `quotient` out of range in progressive order. Where the call is cancelled
/// nothing is returned.
pub fn sample(
    context: &Context,
    mesh: &Arc<Mesh>,
    options: &Options,
    progress: Option<&Progress>,
) -> Result<(Points<3>, Report)> {
    match (options.amount, options.order) {
        (Amount::Radius(radius), Order::Any) => {
            let &Options { seed, given, cosine, projected, .. } = options;
            let options = ProjectionOptions::new(radius).seed(seed).given(given).cosine(cosine);
            make(context, mesh, &options, if projected { None } else { Some(0) }, true, progress)
        }
        _ => sample_levels(context, mesh, options, progress),
    }
}

/// A set in one call: [`Psp::new`], [`Psp::advance`] by so many `iterations` and, if it is to be `maximal`,
/// [`Psp::fill`].
///
/// # Errors
/// Those of the three. Where the call is cancelled nothing is returned.
pub fn project(
    context: &Context,
    mesh: &Arc<Mesh>,
    options: &ProjectionOptions,
    iterations: u32,
    maximal: bool,
    progress: Option<&Progress>,
) -> Result<(Points<3>, Report)> {
    make(context, mesh, options, Some(iterations), maximal, progress)
}

/// A set in one call, by the rule where the number of iterations is not given.
fn make(
    context: &Context,
    mesh: &Arc<Mesh>,
    options: &ProjectionOptions,
    iterations: Option<u32>,
    maximal: bool,
    progress: Option<&Progress>,
) -> Result<(Points<3>, Report)> {
    let stopwatch = Stopwatch::start();
    let mut psp = Psp::new(mesh, options)?;
    let iterations = match iterations {
        Some(iterations) => iterations,
        None => u32::from(!maximal || psp.is_sooner_projected()?),
    };
    psp.check_iterations(iterations)?;
    let is_one_local = iterations == 1 && options.projectors == Projectors::Local;
    psp.require_candidates(iterations, if is_one_local { BYTES_PER_HIT } else { BYTES_PER_CANDIDATE })?;
    let mut report = Report::default();
    context.run(progress, |job| {
        let share = match (maximal, iterations) {
            (false, _) => 1.0,
            (true, 0) => 0.0,
            (true, _) => 0.5,
        };
        psp.iterate(&job.part(0.0, share), iterations, &mut report)?;
        if maximal {
            psp.complete(&job.part(share, 1.0), &mut report)?;
        }
        Ok(())
    })?;
    Ok((psp.samples(), psp.finish(report, &stopwatch)))
}

impl FlatOptions<'_> {
    /// Samples a mesh: by [`sample`] level by level, in any order by [`project`] or by the rule of [`sample`].
    ///
    /// # Errors
    /// Those of the two calls, and [`Error::InvalidArgument`] for `iterations`, sets that are not `maximal` and a
    /// `radius` beside a `count`, and for the first two in progressive order.
    pub fn sample(
        &self,
        context: &Context,
        mesh: &Arc<Mesh>,
        progress: Option<&Progress>,
    ) -> Result<(Points<3>, Report)> {
        match self.request()? {
            Request::Levels(options) => sample(context, mesh, &options, progress),
            Request::Project { options, iterations, maximal } => {
                make(context, mesh, &options, iterations, maximal, progress)
            }
        }
    }
}

/// Peak memory per sample of a set in progressive order; of an exact number of samples; of both; of a set that grows by
/// iterations; and of one of a single iteration of local projectors.
const BYTES_PER_RANKED_SAMPLE: f64 = 210.0;
const BYTES_PER_COUNTED_SAMPLE: f64 = 160.0;
const BYTES_PER_PROJECTED_SAMPLE: f64 = 215.0;
const BYTES_PER_FIRST_SAMPLE: f64 = 250.0;
const BYTES_PER_CANDIDATE: f64 = 181.0;
const BYTES_PER_HIT: f64 = 152.0;

/// The largest number of samples that can be indexed.
const INDEXABLE: usize = u32::MAX as usize;

/// A set that is made level by level: of a count, or in progressive order.
fn sample_levels(
    context: &Context,
    mesh: &Arc<Mesh>,
    options: &Options,
    progress: Option<&Progress>,
) -> Result<(Points<3>, Report)> {
    let stopwatch = Stopwatch::start();
    let &Options { amount, order, quotient, seed, given, cosine, projected } = options;
    if let Amount::Count(count) = amount {
        check_count(count)?;
    }
    if order == Order::Progressive {
        check_quotient(quotient)?;
    }
    let facing = Facing::new(cosine)?;
    let measures = mesh.kept(|| Ok(()), || Ok(Measures::of(mesh)))?;
    let given = match amount {
        Amount::Radius(radius) => {
            let given = GivenSamples::of_levels(mesh, given, Some(radius))?;
            measures.checked_samples(mesh, radius, BYTES_PER_RANKED_SAMPLE, options.given)?;
            given
        }
        Amount::Count(count) => {
            let given = GivenSamples::of_levels(mesh, given, None)?;
            if mesh.area() == 0.0 {
                return Err(Error::invalid("count", format!("{count}, but the mesh's mask leaves no surface")));
            }
            let bytes = if order == Order::Progressive { BYTES_PER_FIRST_SAMPLE } else { BYTES_PER_COUNTED_SAMPLE };
            memory::require(bytes * count as f64, "count", &format!("{count} samples"))?;
            given
        }
    };
    let surface = Surface { mesh, measures: &measures, given: &given, facing };
    let (levels, finest) = (Levels::new(surface, seed), finest_radius(mesh.float_spacing()));
    let mut projection = Report::default();
    let found = context.run(progress, |job| match (amount, order) {
        (Amount::Radius(radius), _) => levels::by_radius(job, levels, quotient, radius),
        (Amount::Count(count), Order::Progressive) => levels::by_count(job, levels, quotient, count, finest),
        (Amount::Count(count), Order::Any) => {
            let (mut job, mut levels) = (*job, levels);
            if projected && given.is_empty() && count as f64 > ONE_PIECE {
                let radius = levels::first_radius(&levels.surface, count, finest);
                let first = job.part(0.0, 0.6);
                if let Some((samples, report)) = begin_projected(&first, mesh, (radius, cosine, seed), count)? {
                    levels = levels.begun(samples, radius, report.darts);
                    (projection, job) = (report, job.part(0.6, 1.0));
                }
            }
            levels::exactly(&job, levels, count, finest)
        }
    })?;
    let samples = found.to_points(mesh, order);
    let len = samples.len();
    let report = Report {
        rho: rho(mesh, len, found.radius),
        uncovered_before: given.is_empty().then_some(if mesh.area() > 0.0 { 1.0 } else { 0.0 }),
        uncovered_after: matches!(amount, Amount::Radius(_)).then_some(0.0),
        radius: found.radius,
        covering_radius: Some(found.covering_radius),
        ..projection.with_fill(len, found.darts, &stopwatch)
    };
    Ok((samples, report))
}

/// The first level on the way to an exact count, of this radius, where it takes less time if an iteration precedes its
/// fill; it has fewer samples. Ranks need no projection: on a first level there are none.
fn begin_projected(
    job: &Job,
    mesh: &Arc<Mesh>,
    (radius, cosine, seed): (f64, f64, u64),
    count: usize,
) -> Result<Option<(Vec<Sample>, Report)>> {
    let mut psp = Psp::new(mesh, &ProjectionOptions::new(radius).cosine(cosine).seed(seed))?;
    if !psp.is_sooner_projected()? {
        return Ok(None);
    }
    memory::require(BYTES_PER_PROJECTED_SAMPLE * count as f64, "count", &format!("{count} samples"))?;
    let mut report = Report::default();
    psp.iterate(&job.part(0.0, 0.5), 1, &mut report)?;
    psp.complete(&job.part(0.5, 1.0), &mut report)?;
    Ok((psp.len() < count).then(|| (psp.samples.into_samples(), report)))
}

/// Refuses a count that is 0 or cannot be indexed.
fn check_count(count: usize) -> Result<()> {
    match count {
        0 => Err(Error::invalid("count", "0 is not at least 1")),
        1..=INDEXABLE => Ok(()),
        _ => Err(Error::too_large("count", format!("{count}; the limit is {INDEXABLE}"))),
    }
}
