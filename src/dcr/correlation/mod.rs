//! Relaxation to a pair correlation that is given: sets with general spectra (thesis eq. 4.3, 4.4 and §5.2; Öztireli and
//! Gross 2012, "Analysis and synthesis of point distributions based on pair correlation"; Heck et al. 2013).
//!
//! In every step the pairs of points are counted by their distance, the forces are made that remove the excess of power
//! over the one wanted (`tension.rs`), and each point moves by those of all points in reach (`rows.rs`).

mod rows;
mod target;
mod tension;

pub use target::PairCorrelation;

use glam::Vec2;

use crate::dcr::correlation::rows::{Law, Rows, WIDEST};
use crate::dcr::correlation::target::MEAN_SPACING;
use crate::dcr::correlation::tension::{TABLE, Table, Tension, residual};
use crate::dcr::relaxation::{Limits, PlaneRelaxation, Relaxation, Report, relax_set, require_points};
use crate::dcr::torus::{CLUSTERED, CurveOrder, Torus, TorusPoint, WaveGrid, leveled};
use crate::error::{Error, Result};
use crate::geometry::Delaunay;
use crate::job::{Context, Job, Progress, chunks_of};
use crate::points::{Boundary, Domain};
use crate::setters::setters;
use crate::simd::Level;

/// The peak memory for a point and all of its data.
const BYTES_PER_POINT: f64 = 260.0;

/// The distance up to which correlations are matched, in mean spacings, where the target and the torus reach as far.
const REACH: f64 = 12.0;

/// The longest displacement of a point in a step, in spacings.
const LONGEST: f32 = 0.2;

/// The points of a task.
const CHUNK: usize = 256;

/// The options of [`relax_to_correlation`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CorrelationOptions {
    /// The rectangle in which the points lie; periodic.
    pub domain: Domain,
    /// The largest number of steps. 0 returns the points unchanged.
    pub max_iterations: u32,
    /// The key of the moves of coincident points, and of those of a set that lies on one line.
    pub seed: u64,
    /// The residual ([`CorrelationReport::residual`]) at which the set has converged.
    pub tolerance: f64,
}

impl CorrelationOptions {
    /// At most 100 steps, tolerance 0.005.
    pub fn new(domain: Domain) -> Self {
        Self { domain, max_iterations: 100, seed: 0, tolerance: 0.005 }
    }

    /// Refuses values out of their range.
    pub fn check(&self) -> Result<()> {
        self.domain.check()?;
        if self.domain.boundary == Boundary::Bounded {
            return Err(Error::invalid("boundary", "pair correlations are matched on periodic domains only"));
        }
        self.limits().check()
    }

    fn limits(&self) -> Limits {
        Limits { max_iterations: self.max_iterations, tolerance: self.tolerance }
    }
}

setters!(CorrelationOptions { domain: Domain, max_iterations: u32, seed: u64, tolerance: f64 });

/// The report of [`relax_to_correlation`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CorrelationReport {
    /// The steps and distances. [`Stopped::Converged`](super::Stopped::Converged) says that the residual is at most the
    /// tolerance, or that there are fewer than two points.
    pub set: Report,
    /// The root mean square, over frequencies up to 2 sqrt(density), of the difference between the radial power of the
    /// returned points and the one wanted, both smoothed over about 1 / `reach`. 0 for fewer than two points.
    pub residual: f64,
    /// The distance up to which the correlation was matched, in units of `d_max`: that of the target, at most 11.2, and
    /// at most 0.42 of the shorter period.
    pub reach: f64,
}

/// The points on their way to a pair correlation.
struct CorrelationRelaxation {
    torus: Torus,
    waves: WaveGrid,
    level: Level,
    seed: u64,
    /// The residual that is small enough.
    tolerance: f64,
    tension: Tension,
    /// The reach, in spacings of the torus, and the length of such a spacing in mean spacings.
    reach: f32,
    mean_spacings: f64,
    order: CurveOrder,
    places: Vec<TorusPoint>,
    /// The forces of the next step; none before the first.
    table: Option<Box<Table>>,
    /// The places with the least residual, and that; infinite before any was measured.
    best: Vec<TorusPoint>,
    residual: f64,
}

impl CorrelationRelaxation {
    fn new(options: &CorrelationOptions, target: &PairCorrelation, points: &[[f32; 2]]) -> Self {
        let torus = Torus::new(options.domain, points.len());
        let size = torus.frame.size();
        let mean_spacings = (points.len().max(1) as f64 / (size.x * size.y)).sqrt();
        // In mean spacings, as is the target in units of d_max.
        let reach = REACH.min(WIDEST * size.min_element() * mean_spacings).min(target.reach() / MEAN_SPACING);
        let order = CurveOrder::new(&torus, points, options.seed);
        Self {
            waves: WaveGrid::new(&torus, None, points.len()),
            level: Level::widest(),
            seed: options.seed,
            tolerance: options.tolerance,
            tension: Tension::new(reach, |distance| target.at(distance * MEAN_SPACING)),
            reach: (reach / mean_spacings) as f32,
            mean_spacings,
            places: order.start().to_vec(),
            table: None,
            best: order.given().to_vec(),
            residual: f64::INFINITY,
            torus,
            order,
        }
    }

    /// The displacements of all points by a law of forces, and the excess of power that they have.
    fn gather(&self, job: &Job, table: &Table) -> Result<(Vec<Vec2>, Vec<f64>)> {
        let rows = Rows::new(&self.torus, &self.places, self.reach);
        let per_spacing = (self.tension.per_spacing() * self.mean_spacings) as f32;
        let law = Law { table, per_spacing, beyond: self.tension.beyond() };
        let (mut all, mut counts) = (Vec::with_capacity(self.places.len()), vec![0u64; TABLE]);
        let chunks = chunks_of(self.places.len(), CHUNK);
        let gather = |chunk: usize| {
            let (here, mut counts) = (&self.places[chunks.range(chunk)], Box::new([0; TABLE]));
            let mut forces = Vec::with_capacity(here.len());
            rows.gather(self.level, &law, here, &mut forces, &mut counts);
            (forces, counts)
        };
        job.stream(chunks.len(), gather, |(forces, found)| {
            all.extend(forces);
            counts.iter_mut().zip(found.iter()).for_each(|(sum, &count)| *sum += u64::from(count));
            Ok(())
        })?;
        // Each point is at no distance from itself.
        counts[0] -= self.places.len() as u64;
        Ok((all, self.tension.excess(&counts, self.places.len())))
    }

    /// Keeps the places if none had a smaller residual.
    fn keep(&mut self, excess: &[f64]) {
        let residual = residual(excess);
        if residual <= self.residual {
            self.residual = residual;
            self.best.clone_from(&self.places);
        }
    }
}

impl Relaxation for CorrelationRelaxation {
    type Position = TorusPoint;
    type Space = Torus;

    fn space(&self) -> Torus {
        self.torus
    }

    fn positions(&self) -> impl ExactSizeIterator<Item = TorusPoint> {
        self.places.iter().copied()
    }

    fn begin(&mut self, job: &Job) -> Result<()> {
        if let Some(leveled) = leveled(job, &self.torus, &self.waves, &self.places, &CLUSTERED, self.seed)? {
            (self.order, self.places) = self.order.reordered(&leveled);
            self.best.clone_from(&self.places);
        }
        Ok(())
    }

    fn step(&mut self, job: &Job, iteration: u32) -> Result<()> {
        let table = match self.table.take() {
            Some(table) => table,
            None => {
                let (_, excess) = self.gather(&job.part(0.0, 0.4), &[0.0; TABLE])?;
                Box::new(self.tension.table(&excess, iteration))
            }
        };
        // The forces are those of the pairs one step before: so one pass both moves and counts.
        let (forces, excess) = self.gather(&job.part(0.4, 0.9), &table)?;
        self.table = Some(Box::new(self.tension.table(&excess, iteration + 1)));
        self.keep(&excess);
        if self.residual > self.tolerance {
            for (place, force) in self.places.iter_mut().zip(&forces) {
                *place = self.torus.moved(*place, force.clamp_length_max(LONGEST));
            }
        }
        Ok(())
    }

    fn has_converged(&self, _: bool) -> bool {
        self.residual <= self.tolerance
    }

    fn finish(&mut self, job: &Job, iterations: u32) -> Result<()> {
        if self.places.len() < 2 {
            self.residual = 0.0;
            return Ok(());
        }
        if iterations == 0 {
            self.places = self.order.given().to_vec();
        }
        if self.residual > self.tolerance {
            let (_, excess) = self.gather(job, &[0.0; TABLE])?;
            self.keep(&excess);
        }
        self.places.clone_from(&self.best);
        Ok(())
    }
}

impl PlaneRelaxation for CorrelationRelaxation {
    fn points(&self, points: &[[f32; 2]]) -> Vec<[f32; 2]> {
        self.order.leave(&self.torus, &self.places, points)
    }

    fn covering_radius(&mut self, job: &Job) -> Result<f64> {
        let places = self.torus.nudged(&self.places).into_iter();
        Ok(Delaunay::new(job, &self.torus.frame, places)?.covering_radius() * self.torus.frame.spacing())
    }
}

/// Moves points of a torus until their pair correlation, and with it the radial mean of their power, is the one wanted:
/// returns as many points, in the same order.
///
/// Any set may be the start; uniform random points are as good as any. As with [`relax`](fn@super::relax), coincident points
/// are parted and clustered sets are levelled first. Of the states, the one with the least residual is returned. Not all
/// correlations exist (g below 0 never does): the call then makes all of its steps, succeeds, and returns the nearest that
/// it found, with its [`residual`](CorrelationReport::residual). A cancelled call returns the nearest so far.
///
/// The result is the same for every number of threads. A step takes O(n · reach²), with 450 pairs for each point at the
/// full reach; memory is O(n).
///
/// # Errors
/// [`Error::InvalidArgument`] for options out of their range, a domain that is not periodic (`boundary`), and for points
/// outside the domain or not finite (`positions`); [`Error::TooLarge`] for more points than fit in memory.
pub fn relax_to_correlation(
    context: &Context,
    options: &CorrelationOptions,
    points: &[[f32; 2]],
    target: &PairCorrelation,
    progress: Option<&Progress>,
) -> Result<(Vec<[f32; 2]>, CorrelationReport)> {
    options.check()?;
    options.domain.check_points(points)?;
    require_points("positions", points.len(), BYTES_PER_POINT)?;
    let mut set = CorrelationRelaxation::new(options, target, points);
    let (relaxed, report) = relax_set(context, &options.domain, options.limits(), points, &mut set, progress, None)?;
    let reach = f64::from(set.reach) * set.mean_spacings * MEAN_SPACING;
    Ok((relaxed, CorrelationReport { set: report, residual: set.residual, reach }))
}
