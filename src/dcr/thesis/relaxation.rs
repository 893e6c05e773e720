//! A set that is being relaxed by the method of the thesis.

use glam::DVec2;

use crate::dcr::ground::motion::Motion;
use crate::dcr::neighbourhood::Neighbourhood;
use crate::dcr::relaxation::Relaxation;
use crate::dcr::thesis::delaunay::DelaunayLinks;
use crate::dcr::thesis::forces::{Forces, Particle};
use crate::dcr::thesis::links::Links;
use crate::dcr::thesis::nearest::NearestLinks;
use crate::dcr::thesis::settings::{Convergence, Thesis};
use crate::dcr::thesis::variance::Variance;
use crate::error::Result;
use crate::geometry::Delaunay;
use crate::geometry::{Frame, along_strips};
use crate::job::{Job, chunks};
use crate::points::Domain;

/// The points, their activeness and the test that ends the steps.
pub(in crate::dcr) struct ThesisRelaxation {
    thesis: Thesis,
    forces: Forces,
    neighbourhood: Neighbourhood,
    frame: Frame,
    /// The user's index of each particle.
    order: Vec<u32>,
    particles: Vec<Particle>,
    motion: Motion<DVec2>,
    /// The thesis's test, if that is what ends the steps.
    variance: Option<Variance>,
    iterations: u32,
}

impl ThesisRelaxation {
    /// The points before the first step.
    pub(in crate::dcr) fn new(
        domain: Domain,
        neighbourhood: Neighbourhood,
        thesis: &Thesis,
        seed: u64,
        points: &[[f32; 2]],
    ) -> Self {
        let frame = Frame::new(domain, points.len());
        let mut positions = frame.enter(points);
        frame.part(&mut positions, seed);
        let order = along_strips(&positions);
        let positions: Vec<_> = order.iter().map(|&point| positions[point as usize]).collect();
        Self {
            thesis: *thesis,
            forces: Forces::new(neighbourhood, thesis, seed),
            neighbourhood,
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

    fn positions(&self) -> impl ExactSizeIterator<Item = DVec2> + Clone {
        self.particles.iter().map(|particle| particle.position)
    }
}

impl Relaxation for ThesisRelaxation {
    fn step(&mut self, job: &Job) -> Result<()> {
        let (prepare, gather, judge) = (job.part(0.0, 0.5), job.part(0.5, 0.9), job.part(0.9, 1.0));
        let moved = match self.neighbourhood {
            Neighbourhood::Delaunay => {
                self.gather(&gather, &DelaunayLinks::new(&prepare, &self.frame, self.positions())?)?
            }
            Neighbourhood::Nearest => {
                let (radius, count) = (self.thesis.conflict_radius, self.thesis.neighbours as usize);
                self.gather(&gather, &NearestLinks::new(&prepare, &self.frame, self.positions(), radius, count)?)?
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
