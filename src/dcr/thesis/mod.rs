//! The method of the thesis (§4.3): tensions shared by activeness, in a neighbourhood of every state.
//!
//! The neighbourhood is kept from step to step and repaired: a Delaunay mesh by flips ([`KeptMesh`]), nearest points in
//! lists with a skin ([`KeptLists`]). Where that is not possible it is found anew ([`Links`]).
//!
//! This module follows the thesis's algorithm (§4.3.3) where the thesis contradicts itself:
//!
//! * Every edge is visited from both ends, so each end receives twice its share of the tension. The constant
//!   distributions of Fig. 4.19 then coincide on the Delaunay neighbourhood, which is symmetric; with
//!   [`Visits::OneEnd`] they differ.
//! * High activeness moves a point *less*; the formulas of §4.3.2 state the opposite.
//! * Activeness is computed from the tensions themselves, not from the forces that it has weighted.
//! * The tension is divided by its radius; eq. 4.10 is not.
//! * Radii are centre-to-centre distances in units of `d_max = sqrt(2 A / (sqrt(3) N))`; the formula for `r_max`
//!   printed in §4.4.2 lacks a fraction bar.
//! * A point oscillates if the cosine of its force and the reverse of the one before is above 0.95 (§4.4.2); §4.3.5
//!   says 0.9, of the longer of the two. Its activeness is then infinite: its neighbours move instead.
//! * λ is constant, as in the thesis's experiments, or decays by a factor per step, where the thesis gives no rule.
//!
//! Convergence is judged by motion: [`Report::motion`](crate::dcr::Report::motion) is the distance covered in the last
//! steps whose λ add up to 2 (40 steps of 0.05), per unit of λ: the same for small and large steps at the same state.
//! The thesis's own test ([`Variance`]) depends on the step size; [`Convergence::Variance`] asks for it.
//!
//! The thesis's radii cost Delaunay neighbours some of the spacing that thrown darts have, as an attraction radius of
//! 1.05 cannot be met everywhere; they gain coverage and well-shaped triangles. Nearest neighbours gain spacing at the
//! price of holes, as nothing attracts. `docs/dcr.md` compares both with the thesis's tables.

mod forces;
mod kept;
mod links;
mod lists;
mod settings;
mod variance;

pub use settings::{Convergence, Distribution, Thesis, Visits};

use glam::DVec2;

use crate::dcr::law::Neighbourhood;
use crate::dcr::relaxation::{PlaneRelaxation, Relaxation, Space};
use crate::dcr::thesis::forces::{Forces, Particle};
use crate::dcr::thesis::kept::KeptMesh;
use crate::dcr::thesis::links::{DelaunayLinks, Links, NearestLinks};
use crate::dcr::thesis::lists::KeptLists;
use crate::dcr::thesis::variance::Variance;
use crate::error::Result;
use crate::geometry::{Delaunay, Frame, along_strips};
use crate::job::{Job, chunks};
use crate::points::Domain;

/// The points, their activeness and the test that ends the steps.
pub struct ThesisRelaxation {
    thesis: Thesis,
    forces: Forces,
    neighbourhood: Neighbourhood,
    frame: Frame,
    /// The user's index of each particle.
    order: Vec<u32>,
    /// The positions of the particles before degenerate arrangements are parted.
    start: Vec<DVec2>,
    particles: Vec<Particle>,
    mesh: KeptMesh,
    lists: KeptLists,
    /// The thesis's test, if it is the one that ends the steps.
    variance: Option<Variance>,
}

impl ThesisRelaxation {
    /// The points before the first step.
    pub fn new(domain: Domain, neighbourhood: Neighbourhood, thesis: &Thesis, seed: u64, points: &[[f32; 2]]) -> Self {
        let frame = Frame::new(domain, points.len());
        let entered = frame.enter(points);
        let mut positions = entered.clone();
        frame.part(&mut positions, seed);
        let order = along_strips(&positions);
        let in_order = |positions: &[DVec2]| order.iter().map(|&point| positions[point as usize]).collect::<Vec<_>>();
        let (start, positions) = (in_order(&entered), in_order(&positions));
        Self {
            thesis: *thesis,
            forces: Forces::new(neighbourhood, thesis, seed),
            neighbourhood,
            frame,
            order,
            start,
            particles: positions.iter().copied().map(Particle::new).collect(),
            mesh: KeptMesh::new(domain, frame, points.len()),
            lists: KeptLists::new(frame, thesis.conflict_radius, thesis.neighbours as usize, points.len()),
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

    fn delaunay_links(&self, job: &Job) -> Result<DelaunayLinks> {
        DelaunayLinks::new(job, &self.frame, self.particle_positions())
    }

    fn nearest_links(&self, job: &Job) -> Result<NearestLinks> {
        let (radius, count) = (self.thesis.conflict_radius, self.thesis.neighbours as usize);
        NearestLinks::new(job, &self.frame, self.particle_positions(), radius, count)
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
        let (follow, find) = (job.part(0.0, 0.3), job.part(0.3, 0.5));
        let (gather, judge) = (job.part(0.5, 0.9), job.part(0.9, 1.0));
        let moved = match self.neighbourhood {
            Neighbourhood::Delaunay => {
                self.mesh.follow(&follow, &self.particles)?;
                match self.mesh.links(&self.particles) {
                    Some(links) => self.gather(&gather, &links)?,
                    None => self.gather(&gather, &self.delaunay_links(&find)?)?,
                }
            }
            Neighbourhood::Nearest => {
                self.lists.follow(&follow, &self.particles)?;
                match self.lists.links(&self.particles) {
                    Some(links) => self.gather(&gather, &links)?,
                    None => self.gather(&gather, &self.nearest_links(&find)?)?,
                }
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

    /// Without a step the points are returned as they were given, and so they are measured.
    fn finish(&mut self, _: &Job, iterations: u32) -> Result<()> {
        // What was kept takes memory that the measures need.
        self.mesh.forget();
        self.lists.forget();
        if iterations == 0 {
            self.particles = self.start.iter().copied().map(Particle::new).collect();
        }
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

    fn covering_radius(&mut self, job: &Job) -> Result<f64> {
        Ok(Delaunay::new(job, &self.frame, self.particle_positions())?.covering_radius() * self.frame.spacing())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::job::Context;
    use crate::points::Boundary;
    use crate::rng::{Draw, Rng};

    /// From random starts, which turn triangles over, and on domains of all shapes: after every step the points are
    /// where a neighbourhood that is found anew moves them.
    #[test]
    fn kept_neighbourhoods_move_points_as_those_that_are_found_anew() {
        let context = Context::new(1).unwrap();
        let mut kept = 0;
        for (boundary, width, count) in [
            (Boundary::Periodic, 1.0, 900),
            (Boundary::Bounded, 1.0, 900),
            (Boundary::Periodic, 7.0, 700),
            (Boundary::Bounded, 7.0, 700),
            (Boundary::Periodic, 1.0, 40),
            (Boundary::Bounded, 300.0, 500),
        ] {
            let domain = Domain { min: [0.0; 2], max: [width, 1.0], boundary };
            let mut rng = Rng::at(11, Draw::Probe, &[count as u64]);
            let points: Vec<_> = (0..count).map(|_| [(width * rng.unit()) as f32, rng.unit() as f32]).collect();
            for neighbourhood in [Neighbourhood::Delaunay, Neighbourhood::Nearest] {
                // Few nearest neighbours, so that it matters which ones are nearest, and a step with which points stray.
                let thesis = Thesis::default().neighbours(2).step(0.1);
                let mut set = ThesisRelaxation::new(domain, neighbourhood, &thesis, 3, &points);
                let step = |job: &Job| {
                    for iteration in 0..50 {
                        let anew = match neighbourhood {
                            Neighbourhood::Delaunay => set.gather(job, &set.delaunay_links(job)?)?,
                            Neighbourhood::Nearest => set.gather(job, &set.nearest_links(job)?)?,
                        };
                        set.step(job, iteration)?;
                        for (moved, anew) in set.particles.iter().zip(&anew) {
                            let apart = set.frame.offset(moved.position, anew.position).length();
                            assert!(apart < 1e-9, "{neighbourhood:?} {domain:?}, step {iteration}: {apart}");
                        }
                        kept += u32::from(set.mesh.links(&set.particles).is_some());
                        kept += u32::from(set.lists.links(&set.particles).is_some());
                    }
                    Ok(())
                };
                context.run(None, step).unwrap();
            }
        }
        // All but the meshes of a few points, the lists of the strip, and meshes of a few steps with wide holes.
        assert!((480..=500).contains(&kept), "{kept}");
    }

    /// In a heap of points everything would be listed.
    #[test]
    fn clusters_are_not_listed() {
        let frame = Frame::new(Domain::unit(Boundary::Periodic), 4000);
        let heap: Vec<_> = (0..4000).map(|i| Particle::new(DVec2::new(1e-6 * f64::from(i), 1.0))).collect();
        let mut lists = KeptLists::new(frame, 0.95, 6, heap.len());
        Context::new(1).unwrap().run(None, |job| lists.follow(job, &heap)).unwrap();
        assert!(lists.links(&heap).is_none());
    }
}
