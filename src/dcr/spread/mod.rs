//! The best mode: push, pull, and long waves removed.
//!
//! What it has from the thesis: neighbours in conflict repel each other, neighbourhoods are Delaunay stars or nearest
//! points, all points move at once by what they gather. What is better known today, or measured here:
//!
//! * holes attract, not long edges (`constraints.rs`);
//! * points have momentum instead of activeness: what pulls to and fro cancels out, what keeps pulling adds up;
//! * the density's long waves are removed directly, every few steps (`waves.rs`);
//! * constraints grow stiffer: soft ones let the set stay irregular while it finds its places, stiff ones make sure of
//!   the last point;
//! * the triangulation is kept and repaired by flips (`mesh.rs`). Where it cannot be, with a few points or large holes, it
//!   is built anew in every step.

mod cells;
pub(super) mod constraints;
mod mesh;
mod torus;
mod waves;

use glam::Vec2;

use self::cells::Cells;
use self::constraints::{Constraints, Force};
use self::mesh::Mesh;
use self::torus::{Place, Torus, along_curve};
use self::waves::Waves;
use super::delaunay::Delaunay;
use super::motion::Motion;
use super::{Neighbourhood, Options, Relaxation};
use crate::error::Result;
use crate::job::{Job, chunks};

/// The share of its way that a point makes again in the next step.
const MOMENTUM: f32 = 0.78;

/// Long waves are removed in every so manieth step.
const WAVES_EVERY: u32 = 5;

/// How far points may move in the room that they have: less than half, so that no triangle turns over.
const ROOM: f32 = 0.45;

/// The room, in spacings, of points that are in no mesh.
const WIDE: f32 = 1.0;

/// The steps over which constraints grow stiffer.
const STIFFENING: u32 = 60;

/// The step size by which motion is measured: a span is 10 steps, in which long waves are removed twice.
const STEP: f64 = 0.2;

/// What knows the neighbours of each point.
enum Neighbours {
    Mesh(Mesh),
    /// Where there can be no mesh.
    Stars(Delaunay),
    Cells(Cells),
}

/// A set in the making.
pub(super) struct Spread {
    torus: Torus,
    waves: Waves,
    neighbourhood: Neighbourhood,
    /// The user's index of each point: points are kept along a curve.
    order: Vec<u32>,
    /// Where the points began.
    start: Vec<Place>,
    /// Where they are, and after them their images on the torus.
    places: Vec<Place>,
    velocities: Vec<Vec2>,
    /// The mesh of the places, once there is one.
    mesh: Option<Mesh>,
    motion: Motion,
    iterations: u32,
}

impl Spread {
    /// The points before the first step.
    pub(super) fn new(options: &Options, points: &[[f32; 2]]) -> Self {
        let torus = Torus::new(options.domain, points.len());
        let entered = torus.enter(points, options.seed);
        let order = along_curve(&entered);
        let start: Vec<Place> = order.iter().map(|&point| entered[point as usize]).collect();
        Self {
            waves: Waves::new(&torus, start.len()),
            neighbourhood: options.neighbourhood,
            places: torus.with_images(&start),
            velocities: vec![Vec2::ZERO; start.len()],
            mesh: None,
            motion: Motion::new(STEP, start.iter().map(|&place| torus.position(place)).collect()),
            iterations: 0,
            torus,
            order,
            start,
        }
    }

    fn neighbours(&mut self, job: &Job) -> Result<Neighbours> {
        if let Some(mesh) = self.mesh.take() {
            return Ok(Neighbours::Mesh(mesh));
        }
        if self.neighbourhood == Neighbourhood::Nearest {
            return Ok(Neighbours::Cells(Cells::new(&self.torus, &self.places, self.constraints().conflict_radius)));
        }
        let delaunay = self.triangulate(&job.part(0.0, 0.9))?;
        if let Some(mut mesh) = Mesh::new(&delaunay, &self.torus, &self.places)
            && mesh.repair(&job.part(0.9, 1.0), &self.places)?
        {
            return Ok(Neighbours::Mesh(mesh));
        }
        Ok(Neighbours::Stars(delaunay))
    }

    fn triangulate(&self, job: &Job) -> Result<Delaunay> {
        Delaunay::new(job, &self.torus.frame, self.torus.nudged(&self.places).into_iter())
    }

    /// The constraints of this step. Radii and stiffness, and the momentum, are the best of those tried on sets of
    /// 1,000 to 65,536 points: with more momentum sets get more regular, with stiffer pulls too.
    fn constraints(&self) -> Constraints {
        let stiff = self.iterations.min(STIFFENING) as f32 / STIFFENING as f32;
        let (push, pull) = (0.1 + 0.3 * stiff, 0.1 + 0.1 * stiff);
        match self.neighbourhood {
            Neighbourhood::Delaunay => Constraints { conflict_radius: 0.862, coverage_radius: 0.66, push, pull },
            Neighbourhood::Nearest => Constraints { conflict_radius: 0.92, coverage_radius: f32::INFINITY, push, pull },
        }
    }

    /// Where every point gets, and how fast.
    fn gather(&self, job: &Job, neighbours: &Neighbours, drift: &[Vec2]) -> Result<Vec<(Place, Vec2)>> {
        let constraints = self.constraints();
        let chunks = chunks(self.order.len());
        job.concat(chunks.len(), |chunk| {
            let mut ring = Vec::new();
            let advance = |point: usize| {
                ring.clear();
                let Force { sum, room } = match neighbours {
                    Neighbours::Cells(cells) => {
                        Force { sum: cells.force(&constraints, self.places[point]), room: WIDE }
                    }
                    Neighbours::Mesh(mesh) => {
                        mesh.star(&self.places, point, &mut ring);
                        constraints.force(&ring)
                    }
                    Neighbours::Stars(delaunay) => {
                        ring.extend(delaunay.ring(point).map(|offset| offset.as_vec2()));
                        Force { room: WIDE, ..constraints.force(&ring) }
                    }
                };
                let velocity = MOMENTUM * self.velocities[point] + sum;
                let limit = ROOM * room;
                let place = self.torus.moved(self.places[point], (velocity + drift[point]).clamp_length_max(limit));
                (place, velocity.clamp_length_max(limit))
            };
            chunks.range(chunk).map(advance).collect()
        })
    }
}

impl Relaxation for Spread {
    fn step(&mut self, job: &Job) -> Result<()> {
        let count = self.order.len();
        let drift = match self.iterations.is_multiple_of(WAVES_EVERY) {
            true => self.waves.drift(&job.part(0.0, 0.2), &self.places, count)?,
            false => vec![Vec2::ZERO; count],
        };
        let neighbours = self.neighbours(&job.part(0.2, 0.4))?;
        let moved = self.gather(&job.part(0.4, 0.7), &neighbours, &drift)?;
        let (places, velocities): (Vec<Place>, Vec<Vec2>) = moved.into_iter().unzip();
        (self.places, self.velocities) = (self.torus.with_images(&places), velocities);
        self.iterations += 1;
        self.motion.after_step(&self.torus.frame, || places.iter().map(|&place| self.torus.position(place)));
        if let Neighbours::Mesh(mut mesh) = neighbours {
            self.mesh = mesh.repair(&job.part(0.7, 1.0), &self.places)?.then_some(mesh);
        }
        Ok(())
    }

    fn iterations(&self) -> u32 {
        self.iterations
    }

    fn motion(&self) -> f64 {
        let places = self.places[..self.order.len()].iter();
        self.motion.last(&self.torus.frame, places.map(|&place| self.torus.position(place)))
    }

    fn has_settled(&self, tolerance: f64) -> bool {
        self.motion.has_settled(tolerance)
    }

    /// Points that have not moved are returned as they came.
    fn points(&self, points: &[[f32; 2]]) -> Vec<[f32; 2]> {
        let mut relaxed = points.to_vec();
        for ((&point, &start), &place) in self.order.iter().zip(&self.start).zip(&self.places) {
            if place != start {
                relaxed[point as usize] = self.torus.leave(place);
            }
        }
        relaxed
    }

    fn coverage(&self, job: &Job) -> Result<f64> {
        let radius = match &self.mesh {
            Some(mesh) => mesh.coverage(job, &self.places)?,
            None => self.triangulate(job)?.coverage(),
        };
        Ok(radius * self.torus.frame.spacing())
    }
}
