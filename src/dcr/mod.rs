//! DCR: relaxation of a point set by distance constraints (thesis ch. 4).
//!
//! Neighbours closer than the conflict radius push each other apart, Delaunay neighbours farther apart than the
//! attraction radius pull each other together, and the activeness of both ends decides who moves. All points move at
//! once, by what they gather from their neighbours; nothing depends on the order of the points or on the threads.
//!
//! Where the thesis contradicts itself, this module does what its algorithm (§4.3.3) says:
//!
//! * Every edge is visited from both ends, so each end receives twice its share of the tension. The constant
//!   distributions of Fig. 4.19 then coincide on the Delaunay neighbourhood, which is symmetric: see [`Distribution`].
//! * High activeness moves a point *less*; the formulas of §4.3.2 have it the other way round.
//! * Activeness is computed from the tensions themselves, not from the forces that it has weighted.
//! * The tension is divided by its radius; eq. 4.10 is not.
//! * Radii are centre-to-centre distances in units of `d_max = sqrt(2 A / (sqrt(3) N))`; the formula for `r_max`
//!   printed in §4.4.2 lacks a fraction bar.
//!
//! Convergence is judged by motion and not by the thesis's test on the variance of nearest distances (§4.4.2), which
//! depends on the step size and fires early. [`Report::motion`] is how far points got over the last steps whose λ add
//! up to 2 (40 steps of 0.05), per unit of λ: the same for small and large steps at the same state.
//!
//! What to expect, measured on 4,096 points of a torus with the settings of the thesis. rho is the smallest distance,
//! cover the largest distance from the set, both in `d_max`; the variance is that of nearest distances.
//!
//! | start | neighbourhood | steps (thesis) | rho | variance | cover |
//! |---|---|---|---|---|---|
//! | random | Delaunay | 240 (276) | 0.005 → 0.62 | 6.0e-2 → 4.4e-3 | 1.73 → 0.81 |
//! | darts | Delaunay | 120 (132) | 0.766 → 0.72 | 2.4e-3 → 3.0e-3 | 0.80 → 0.73 |
//! | random | nearest | 680 | 0.005 → 0.83 | 6.0e-2 → 2.4e-4 | 1.73 → 1.18 |
//! | darts | nearest | 400 | 0.766 → 0.88 | 2.4e-3 → 1.2e-4 | 0.80 → 0.87 |
//!
//! So the thesis's radii cost Delaunay neighbours some of the spacing that thrown darts have, as an attraction radius
//! of 1.05 cannot be met everywhere; what they gain is coverage and triangles of good shape. Nearest neighbours gain
//! spacing at the price of holes, as nothing pulls.

pub(crate) mod delaunay;
mod forces;
pub(crate) mod frame;
mod knn;
mod links;
mod motion;

use delaunay::Delaunay;
use forces::{Forces, Particle};
use frame::{Frame, along_strips};
use knn::Nearest;
use links::Links;
use motion::Motion;

use crate::error::{Error, Result};
use crate::grid2::Grid2;
use crate::job::{Context, Job, Progress, chunks};
use crate::points::Domain;

/// Who is a neighbour of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Neighbourhood {
    /// Its neighbours in the Delaunay triangulation, rebuilt in every step: they repel and attract (§4.3.3).
    Delaunay,
    /// Its [`Options::neighbours`] nearest points: they only repel (§4.3.4).
    Nearest,
}

/// How a tension is divided between the point that visits an edge and the neighbour at its other end (Fig. 4.19).
///
/// Delaunay edges are visited from both ends, so there all but [`Distribution::Activeness`] give the same
/// displacements. On the nearest neighbourhood, where only one end may count the other among its nearest, all differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distribution {
    /// By activeness: whose tensions cancel out moves its neighbours, whose tensions agree moves itself.
    Activeness,
    /// Half to each end.
    Average,
    /// All to the neighbour.
    Dominant,
    /// All to the visiting point itself.
    Zero,
    /// 80 % to the visiting point, 20 % to the neighbour. (Of the thesis's two descriptions, the one in the list of
    /// strategies that names the numbers in this order.)
    EightyTwenty,
}

/// The options of [`relax`]. Lengths are in units of `d_max`, the distance of neighbours if the same number of points
/// stood in hexagonal arrangement on the domain's area (and never more than its shorter side).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The rectangle in which the points lie and stay.
    pub domain: Domain,
    /// Who is a neighbour of whom.
    pub neighbourhood: Neighbourhood,
    /// The largest number of steps. 0 returns the points as they are.
    pub max_iterations: u32,
    /// Where points of degenerate sets are moved; used for nothing else.
    pub seed: u64,
    /// Neighbours closer than this repel each other; above 0, at most 1. The thesis: 0.8 to 0.99.
    pub conflict_radius: f64,
    /// Delaunay neighbours farther apart attract each other; at least the conflict radius. The thesis: 1.01 to 1.2.
    pub attraction_radius: f64,
    /// The step size λ: the displacement by a tension of 1; above 0, at most 1.
    pub step: f64,
    /// `K` of the nearest neighbourhood; at least 1.
    pub neighbours: u32,
    /// How tensions are divided.
    pub distribution: Distribution,
    /// The motion ([`Report::motion`]) at which the set has converged; 0 makes all steps. Activeness keeps Delaunay
    /// neighbourhoods moving by 0.01 for ever, so lower values are reached only by constant distributions.
    pub tolerance: f64,
}

impl Options {
    /// The settings of the thesis: radii 0.95 and 1.05, λ = 0.05, activeness; 6 nearest neighbours, the number that a
    /// point of the plane has on average, as the thesis names none; at most 1000 steps. The tolerance is 0.02 for
    /// Delaunay and 0.005 for nearest neighbours, which are slower to spread and do not jitter.
    pub fn new(domain: Domain, neighbourhood: Neighbourhood) -> Self {
        Self {
            domain,
            neighbourhood,
            max_iterations: 1000,
            seed: 0,
            conflict_radius: 0.95,
            attraction_radius: 1.05,
            step: 0.05,
            neighbours: 6,
            distribution: Distribution::Activeness,
            tolerance: match neighbourhood {
                Neighbourhood::Delaunay => 0.02,
                Neighbourhood::Nearest => 0.005,
            },
        }
    }

    fn check(&self) -> Result<()> {
        self.domain.check()?;
        let within = |argument, value: f64, low: f64, high: f64, range: &str| {
            // The comparison fails for NaN too.
            if value > low && value <= high {
                Ok(())
            } else {
                Err(Error::invalid(argument, format!("{value} {range}")))
            }
        };
        within("conflict_radius", self.conflict_radius, 0.0, 1.0, "is not above 0 and at most 1")?;
        within("step", self.step, 0.0, 1.0, "is not above 0 and at most 1")?;
        if !(self.conflict_radius..).contains(&self.attraction_radius) {
            let reason = format!("{} is below conflict_radius {}", self.attraction_radius, self.conflict_radius);
            return Err(Error::invalid("attraction_radius", reason));
        }
        if self.neighbours == 0 {
            return Err(Error::invalid("neighbours", "0 is not at least 1"));
        }
        if !(0.0..).contains(&self.tolerance) {
            return Err(Error::invalid("tolerance", format!("{} is not at least 0", self.tolerance)));
        }
        Ok(())
    }
}

/// What [`relax`] did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// The number of steps made.
    pub iterations: u32,
    /// Whether the motion came to its end before the steps did.
    pub converged: bool,
    /// How far points got, root mean square: in units of `d_max` and per unit of λ, over the last span of steps whose
    /// λ add up to 2, or over all steps if there were fewer.
    pub motion: f64,
    /// The smallest distance between two of the returned points, in the units of the domain, around the torus on a
    /// periodic domain; infinite for less than two points.
    pub smallest_distance: f64,
    /// The smallest distance in units of `d_max`; at most 1 on a torus; infinite for less than two points.
    pub rho: f64,
}

/// Relaxes a set of points of the domain: returns as many points, in the same order, spread more evenly.
///
/// The result is the same for every number of threads and every order of calls; the points stay in
/// `min <= x < max`, around the torus or held back by the border. An empty set and a single point are returned as they
/// are. Coincident points, and all points of a set on one line, are first moved by 0.001 to 0.002 `d_max` in
/// directions keyed by `seed` and index: the forces alone would not lead them apart.
///
/// A step takes O(n log n) on the Delaunay neighbourhood, O(n) on the nearest one; memory is O(n).
///
/// # Errors
/// [`Error::InvalidArgument`] for options out of their range and for points outside the domain or not finite (`xy`,
/// with index and value), [`Error::TooLarge`] for more than 2^32 - 1 points, [`Error::Cancelled`].
pub fn relax(
    context: &Context,
    options: &Options,
    points: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<(Vec<[f32; 2]>, Report)> {
    options.check()?;
    options.domain.check_points(points)?;
    context.run(progress, |job| {
        let (mut relaxed, mut run) = (points.to_vec(), Run { iterations: 0, converged: points.len() < 2, motion: 0.0 });
        if !run.converged && options.max_iterations > 0 {
            (relaxed, run) = run_steps(&job.part(0.0, 0.99), options, points)?;
        }
        let smallest_distance = smallest_distance(&job.part(0.99, 1.0), &options.domain, &relaxed)?;
        let rho = smallest_distance / options.domain.hexagonal_distance(points.len().max(1));
        let Run { iterations, converged, motion } = run;
        Ok((relaxed, Report { iterations, converged, motion, smallest_distance, rho }))
    })
}

/// How the steps went.
struct Run {
    iterations: u32,
    converged: bool,
    motion: f64,
}

/// Steps until the motion ends or the steps do.
fn run_steps(job: &Job, options: &Options, points: &[[f32; 2]]) -> Result<(Vec<[f32; 2]>, Run)> {
    let frame = Frame::new(options.domain, points.len());
    let mut positions = frame.enter(points);
    frame.part(&mut positions, options.seed);
    let order = along_strips(&positions);
    let mut particles: Vec<Particle> = order.iter().map(|&i| Particle::new(positions[i as usize])).collect();

    let mut motion = Motion::new(options.step, &particles);
    let share = |iteration: u32| f64::from(iteration) / f64::from(options.max_iterations);
    let (mut iterations, mut converged) = (0, false);
    while iterations < options.max_iterations && !converged {
        particles = advance(&job.part(share(iterations), share(iterations + 1)), options, &frame, &particles)?;
        iterations += 1;
        converged = motion.after_step(&frame, &particles).is_some_and(|motion| motion <= options.tolerance);
    }
    let mut relaxed = points.to_vec();
    for (&i, particle) in order.iter().zip(&particles) {
        relaxed[i as usize] = frame.leave(particle.position);
    }
    Ok((relaxed, Run { iterations, converged, motion: motion.last(&frame, &particles) }))
}

/// One step of all points.
fn advance(job: &Job, options: &Options, frame: &Frame, particles: &[Particle]) -> Result<Vec<Particle>> {
    let positions = particles.iter().map(|particle| particle.position);
    let (prepare, gather) = (job.part(0.0, 0.5), job.part(0.5, 1.0));
    match options.neighbourhood {
        Neighbourhood::Delaunay => {
            gather_forces(&gather, options, frame, &Delaunay::new(&prepare, frame, positions)?, particles)
        }
        Neighbourhood::Nearest => {
            let (radius, count) = (options.conflict_radius, options.neighbours as usize);
            gather_forces(&gather, options, frame, &Nearest::new(&prepare, frame, positions, radius, count)?, particles)
        }
    }
}

/// Moves every point by the forces that it gathers along its links.
fn gather_forces(
    job: &Job,
    options: &Options,
    frame: &Frame,
    links: &impl Links,
    particles: &[Particle],
) -> Result<Vec<Particle>> {
    let forces = Forces::new(options);
    let chunks = chunks(particles.len());
    job.flat_map(chunks.len(), |chunk| {
        let moved = |point| {
            let particle = forces.advance(links, particles, point);
            Particle { position: frame.fold(particle.position), ..particle }
        };
        chunks.range(chunk).map(moved).collect()
    })
}

/// The smallest distance between two points, in `f64` from the floats.
fn smallest_distance(job: &Job, domain: &Domain, points: &[[f32; 2]]) -> Result<f64> {
    let position = |point: &[f32; 2]| point.map(f64::from);
    let grid = Grid2::new(*domain, points.iter().map(position), domain.hexagonal_distance(points.len()));
    let chunks = chunks(points.len());
    let nearest = job.map(chunks.len(), |chunk| {
        let squared = |i: usize| grid.nearest_squared(position(&points[i]), Some(i as u32));
        chunks.range(chunk).map(squared).fold(f64::INFINITY, f64::min)
    })?;
    Ok(nearest.into_iter().fold(f64::INFINITY, f64::min).sqrt())
}
