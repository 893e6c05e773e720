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
mod constraints;
mod mesh;
mod rings;
mod stars;
mod tiles;
mod torus;
#[allow(unsafe_code)] // Vector instructions.
mod vectors;
mod waves;

use std::ops::Range;

use glam::Vec2;

use self::cells::Cells;
use self::constraints::{Constraints, Force};
use self::mesh::{Edge, Mesh};
use self::torus::{Place, Torus, along_curve};
use self::waves::Waves;
use super::delaunay::Delaunay;
use super::motion::Motion;
use super::{Neighbourhood, Options, Relaxation};
use crate::error::Result;
use crate::job::{Job, chunks};
use crate::maximal::Vectors;

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

/// Where points are, and how fast.
#[derive(Default)]
struct State {
    /// The places of the points, and after them those of their images on the torus.
    places: Vec<Place>,
    velocities: Vec<Vec2>,
}

/// A set in the making.
pub(super) struct Spread {
    torus: Torus,
    waves: Waves,
    neighbourhood: Neighbourhood,
    vectors: Vectors,
    /// The user's index of each point: points are kept along a curve.
    order: Vec<u32>,
    /// Where the points began.
    start: Vec<Place>,
    state: State,
    /// What the next state is written to.
    next: State,
    /// The mesh of the places, once there is one.
    mesh: Option<Mesh>,
    motion: Motion,
    iterations: u32,
}

/// What was seen while points gathered.
#[derive(Default)]
struct Seen {
    /// The edges that may have to be flipped, in the order of the points.
    suspects: Vec<Edge>,
    /// Whether a triangle had turned over.
    is_unsound: bool,
}

/// A part of the points, and where their next state goes; nowhere for images, which follow their points.
struct Part<'a> {
    points: Range<usize>,
    places: &'a mut [Place],
    velocities: &'a mut [Vec2],
}

impl Spread {
    /// The points before the first step.
    pub(super) fn new(options: &Options, points: &[[f32; 2]]) -> Self {
        let torus = Torus::new(options.domain, points.len());
        let entered = torus.enter(points, options.seed);
        let order = along_curve(&entered);
        let start: Vec<Place> = order.iter().map(|&point| entered[point as usize]).collect();
        let places = torus.with_images(&start);
        let velocities = vec![Vec2::ZERO; start.len()];
        Self {
            waves: Waves::new(&torus, start.len()),
            neighbourhood: options.neighbourhood,
            vectors: Vectors::widest(),
            next: State { places: places.clone(), velocities: velocities.clone() },
            state: State { places, velocities },
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
        let places = &self.state.places;
        if self.neighbourhood == Neighbourhood::Nearest {
            return Ok(Neighbours::Cells(Cells::new(&self.torus, places, self.constraints().conflict_radius)));
        }
        match Mesh::new(&job.part(0.0, 0.5), &self.torus, places)? {
            Some(mesh) => Ok(Neighbours::Mesh(mesh)),
            None => Ok(Neighbours::Stars(self.triangulate(&job.part(0.5, 1.0))?)),
        }
    }

    fn triangulate(&self, job: &Job) -> Result<Delaunay> {
        Delaunay::new(job, &self.torus.frame, self.torus.nudged(&self.state.places).into_iter())
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

    /// Writes the next state of all points: where they get, and how fast.
    fn gather(&self, job: &Job, neighbours: &Neighbours, drift: &[Vec2], next: &mut State) -> Result<Seen> {
        let (count, constraints) = (self.order.len(), self.constraints());
        let seen = job.part(0.0, 0.9).map_each(parts(count, next), |part: Part| {
            let mut seen = Seen::default();
            let Part { points, places, velocities } = part;
            let first = points.start;
            let mut write = |point: usize, force: Force| {
                if point < count {
                    (places[point - first], velocities[point - first]) = self.advance(point, force, drift);
                }
            };
            match neighbours {
                Neighbours::Cells(cells) => {
                    for point in points.filter(|&point| point < count) {
                        let sum = cells.force(&constraints, self.state.places[point]);
                        write(point, Force { sum, room: WIDE });
                    }
                }
                Neighbours::Mesh(mesh) => {
                    mesh.feel(self.vectors, &self.state.places, &constraints, points, |point, felt, lane| {
                        seen.is_unsound |= !felt.is_sound[lane];
                        mesh.suspects(point, felt, lane, &mut seen.suspects);
                        let sum = Vec2::new(felt.x[lane], felt.y[lane]);
                        write(point, Force { sum, room: felt.room[lane] });
                    });
                }
                Neighbours::Stars(delaunay) => {
                    let mut ring = Vec::new();
                    for point in points.filter(|&point| point < count) {
                        ring.clear();
                        ring.extend(delaunay.ring(point).map(|offset| offset.as_vec2()));
                        write(point, Force { room: WIDE, ..constraints.force(&ring) });
                    }
                }
            }
            seen
        })?;
        self.torus.mirror(&job.part(0.9, 1.0), &mut next.places, count)?;
        let is_unsound = seen.iter().any(|seen| seen.is_unsound);
        Ok(Seen { suspects: seen.into_iter().flat_map(|seen| seen.suspects).collect(), is_unsound })
    }

    /// Where a point gets by a force, and how fast.
    #[inline(always)]
    fn advance(&self, point: usize, Force { sum, room }: Force, drift: &[Vec2]) -> (Place, Vec2) {
        let velocity = MOMENTUM * self.state.velocities[point] + sum;
        let limit = ROOM * room;
        let way = velocity + drift.get(point).copied().unwrap_or(Vec2::ZERO);
        let place = self.torus.moved(self.state.places[point], way.clamp_length_max(limit));
        (place, velocity.clamp_length_max(limit))
    }
}

/// All points and images, cut into parts.
fn parts(count: usize, next: &mut State) -> Vec<Part<'_>> {
    let all = next.places.len();
    let (own, images) = (chunks(count), chunks(all - count));
    let places = next.places[..count].chunks_mut(own.size()).chain(std::iter::repeat_with(|| &mut [][..]));
    let velocities = next.velocities.chunks_mut(own.size()).chain(std::iter::repeat_with(|| &mut [][..]));
    let own = (0..own.len()).map(|chunk| own.range(chunk));
    let images = (0..images.len()).map(|chunk| images.range(chunk)).map(|range| range.start + count..range.end + count);
    let parts = own.chain(images).zip(places.zip(velocities));
    parts.map(|(points, (places, velocities))| Part { points, places, velocities }).collect()
}

impl Relaxation for Spread {
    fn step(&mut self, job: &Job) -> Result<()> {
        let count = self.order.len();
        let drift = match self.iterations.is_multiple_of(WAVES_EVERY) {
            true => self.waves.drift(&job.part(0.0, 0.2), &self.state.places, count)?,
            false => Vec::new(),
        };
        let mut next = std::mem::take(&mut self.next);
        let mut neighbours = self.neighbours(&job.part(0.2, 0.4))?;
        let mut seen = self.gather(&job.part(0.4, 0.6), &neighbours, &drift, &mut next)?;
        if seen.is_unsound {
            neighbours = Neighbours::Stars(self.triangulate(&job.part(0.6, 0.65))?);
            seen = self.gather(&job.part(0.65, 0.7), &neighbours, &drift, &mut next)?;
        }
        self.next = std::mem::replace(&mut self.state, next);
        self.iterations += 1;
        let places = &self.state.places;
        self.motion.after_step(&self.torus.frame, || places[..count].iter().map(|&place| self.torus.position(place)));
        if let Neighbours::Mesh(mut mesh) = neighbours {
            self.mesh = mesh.mend(&job.part(0.7, 1.0), places, seen.suspects)?.then_some(mesh);
        }
        Ok(())
    }

    fn iterations(&self) -> u32 {
        self.iterations
    }

    fn motion(&self) -> f64 {
        let places = self.state.places[..self.order.len()].iter();
        self.motion.last(&self.torus.frame, places.map(|&place| self.torus.position(place)))
    }

    fn has_settled(&self, tolerance: f64) -> bool {
        self.motion.has_settled(tolerance)
    }

    /// Points that have not moved are returned as they came.
    fn points(&self, points: &[[f32; 2]]) -> Vec<[f32; 2]> {
        let mut relaxed = points.to_vec();
        for ((&point, &start), &place) in self.order.iter().zip(&self.start).zip(&self.state.places) {
            if place != start {
                relaxed[point as usize] = self.torus.leave(place);
            }
        }
        relaxed
    }

    fn coverage(&mut self, job: &Job) -> Result<f64> {
        let places = &self.state.places;
        let mesh = match self.mesh.take() {
            Some(mut mesh) => mesh.repair(&job.part(0.0, 0.5), places)?.then_some(mesh),
            None => Mesh::new(&job.part(0.0, 0.5), &self.torus, places)?,
        };
        let radius = match mesh {
            Some(mesh) => mesh.coverage(&job.part(0.5, 1.0), places)?,
            None => self.triangulate(&job.part(0.5, 1.0))?.coverage(),
        };
        Ok(radius * self.torus.frame.spacing())
    }
}
