//! A set that is being relaxed by the method of the thesis.

use glam::DVec2;

use crate::dcr::options::Neighbourhood;
use crate::dcr::relax::PlaneRelaxation;
use crate::dcr::relaxation::{Relaxation, Space};
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
    /// The thesis's test, if that is what ends the steps.
    variance: Option<Variance>,
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
            variance: (thesis.convergence == Convergence::Variance).then(Variance::default),
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

    fn particle_positions(&self) -> impl ExactSizeIterator<Item = DVec2> + Clone {
        self.particles.iter().map(|particle| particle.position)
    }
}

impl Space<DVec2> for Frame {
    fn distance_squared(&self, from: DVec2, to: DVec2) -> f64 {
        self.offset(from, to).length_squared()
    }
}

impl Relaxation for ThesisRelaxation {
    type Position = DVec2;
    type Space = Frame;

    fn space(&self) -> Frame {
        self.frame
    }

    fn positions(&self) -> impl ExactSizeIterator<Item = DVec2> {
        self.particle_positions()
    }

    fn step_size(&self) -> f64 {
        self.forces.step
    }

    fn step(&mut self, job: &Job, _: u32) -> Result<()> {
        let (prepare, gather, judge) = (job.part(0.0, 0.5), job.part(0.5, 0.9), job.part(0.9, 1.0));
        let moved = match self.neighbourhood {
            Neighbourhood::Delaunay => {
                self.gather(&gather, &DelaunayLinks::new(&prepare, &self.frame, self.particle_positions())?)?
            }
            Neighbourhood::Nearest => {
                let (radius, count) = (self.thesis.conflict_radius, self.thesis.neighbours as usize);
                self.gather(
                    &gather,
                    &NearestLinks::new(&prepare, &self.frame, self.particle_positions(), radius, count)?,
                )?
            }
        };
        if let Some(variance) = &mut self.variance {
            let positions = |particles: &[Particle]| particles.iter().map(|p| p.position).collect::<Vec<_>>();
            variance.after_step(&judge, &self.frame, &positions(&self.particles), &positions(&moved))?;
        }
        self.particles = moved;
        self.forces.step *= self.thesis.decay;
        Ok(())
    }

    fn has_converged(&self, is_at_rest: bool) -> bool {
        self.variance.as_ref().map_or(is_at_rest, Variance::has_settled)
    }
}

impl PlaneRelaxation for ThesisRelaxation {
    fn points(&self, points: &[[f32; 2]]) -> Vec<[f32; 2]> {
        let mut relaxed = points.to_vec();
        for (&point, particle) in self.order.iter().zip(&self.particles) {
            relaxed[point as usize] = self.frame.leave(particle.position);
        }
        relaxed
    }

    fn coverage(&mut self, job: &Job) -> Result<f64> {
        Ok(Delaunay::new(job, &self.frame, self.particle_positions())?.coverage() * self.frame.spacing())
    }
}
