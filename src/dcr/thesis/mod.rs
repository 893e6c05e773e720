//! The thesis's mode (§4.3): tensions shared by activeness, on a neighbourhood that is found anew in every step.
//!
//! Where the thesis contradicts itself, this module does what its algorithm (§4.3.3) says:
//!
//! * Every edge is visited from both ends, so each end receives twice its share of the tension. The constant
//!   distributions of Fig. 4.19 then coincide on the Delaunay neighbourhood, which is symmetric;
//!   [`Visits::OneEnd`](super::Visits::OneEnd) tells them apart.
//! * High activeness moves a point *less*; the formulas of §4.3.2 have it the other way round.
//! * Activeness is computed from the tensions themselves, not from the forces that it has weighted.
//! * The tension is divided by its radius; eq. 4.10 is not.
//! * Radii are centre-to-centre distances in units of `d_max = sqrt(2 A / (sqrt(3) N))`; the formula for `r_max`
//!   printed in §4.4.2 lacks a fraction bar.
//! * A point oscillates if the cosine of its force and the reverse of the one before is above 0.95 (§4.4.2); §4.3.5 says
//!   0.9, of the longer of the two. Its activeness is then infinite: its neighbours move instead.
//! * λ is constant, as in the thesis's experiments, or decays by a factor per step, where the thesis gives no rule.
//!
//! Convergence is judged by motion: [`Report::motion`](super::Report::motion) is how far points got over the last steps
//! whose λ add up to 2 (40 steps of 0.05), per unit of λ: the same for small and large steps at the same state. The
//! thesis's own test (`variance.rs`) depends on the step size; [`Convergence::Variance`] asks for it.
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

mod forces;
mod knn;
mod settings;
mod variance;

pub use settings::{Convergence, Distribution, Thesis, Visits};

use crate::dcr::ground::motion::Motion;
use crate::dcr::thesis::forces::{Forces, Particle};
use crate::dcr::thesis::knn::Nearest;
use crate::dcr::thesis::variance::Variance;
use crate::dcr::{Neighbourhood, Options, Relaxation};
use crate::error::Result;
use crate::geometry::delaunay::Delaunay;
use crate::geometry::frame::{Frame, along_strips};
use crate::geometry::links::Links;
use crate::job::{Job, chunks};

/// A set in the making.
pub(super) struct Tensioned {
    thesis: Thesis,
    forces: Forces,
    neighbourhood: Neighbourhood,
    frame: Frame,
    /// The user's index of each particle.
    order: Vec<u32>,
    particles: Vec<Particle>,
    motion: Motion,
    /// The thesis's test, if that is what ends the steps.
    variance: Option<Variance>,
    iterations: u32,
}

impl Tensioned {
    /// The points before the first step.
    pub(super) fn new(options: &Options, thesis: &Thesis, points: &[[f32; 2]]) -> Self {
        let frame = Frame::new(options.domain, points.len());
        let mut positions = frame.enter(points);
        frame.part(&mut positions, options.seed);
        let order = along_strips(&positions);
        let positions: Vec<_> = order.iter().map(|&point| positions[point as usize]).collect();
        Self {
            thesis: *thesis,
            forces: Forces::new(options.neighbourhood, thesis, options.seed),
            neighbourhood: options.neighbourhood,
            frame,
            order,
            particles: positions.iter().copied().map(Particle::new).collect(),
            motion: Motion::new(thesis.step, positions),
            variance: (thesis.convergence == Convergence::Variance).then(Variance::default),
            iterations: 0,
        }
    }

    /// Moves every point by the forces that it gathers along its links.
    fn gather(&self, job: &Job, links: &impl Links) -> Result<Vec<Particle>> {
        let chunks = chunks(self.particles.len());
        job.flat_map(chunks.len(), |chunk| {
            let moved = |point| {
                let particle = self.forces.advance(links, &self.particles, point);
                Particle { position: self.frame.fold(particle.position), ..particle }
            };
            chunks.range(chunk).map(moved).collect()
        })
    }

    fn positions(&self) -> impl ExactSizeIterator<Item = glam::DVec2> + Clone {
        self.particles.iter().map(|particle| particle.position)
    }
}

impl Relaxation for Tensioned {
    fn step(&mut self, job: &Job) -> Result<()> {
        let (prepare, gather, judge) = (job.part(0.0, 0.5), job.part(0.5, 0.9), job.part(0.9, 1.0));
        let moved = match self.neighbourhood {
            Neighbourhood::Delaunay => {
                self.gather(&gather, &Delaunay::new(&prepare, &self.frame, self.positions())?)?
            }
            Neighbourhood::Nearest => {
                let (radius, count) = (self.thesis.conflict_radius, self.thesis.neighbours as usize);
                self.gather(&gather, &Nearest::new(&prepare, &self.frame, self.positions(), radius, count)?)?
            }
        };
        if let Some(variance) = &mut self.variance {
            let positions = |particles: &[Particle]| particles.iter().map(|p| p.position).collect::<Vec<_>>();
            variance.after_step(&judge, &self.frame, &positions(&self.particles), &positions(&moved))?;
        }
        self.particles = moved;
        self.iterations += 1;
        let particles = &self.particles;
        self.motion.after_step(&self.frame, || particles.iter().map(|particle| particle.position));
        self.forces.step *= self.thesis.decay;
        self.motion.set_step(self.forces.step);
        Ok(())
    }

    fn iterations(&self) -> u32 {
        self.iterations
    }

    fn motion(&self) -> f64 {
        self.motion.last(&self.frame, self.positions())
    }

    fn has_settled(&self, tolerance: f64) -> bool {
        match &self.variance {
            Some(variance) => variance.has_settled(),
            None => self.motion.has_settled(tolerance),
        }
    }

    fn points(&self, points: &[[f32; 2]]) -> Vec<[f32; 2]> {
        let mut relaxed = points.to_vec();
        for (&point, particle) in self.order.iter().zip(&self.particles) {
            relaxed[point as usize] = self.frame.leave(particle.position);
        }
        relaxed
    }

    fn coverage(&mut self, job: &Job) -> Result<f64> {
        Ok(Delaunay::new(job, &self.frame, self.positions())?.coverage() * self.frame.spacing())
    }
}
