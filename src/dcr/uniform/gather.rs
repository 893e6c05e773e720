//! One step of all points: each gathers forces from its neighbours and moves.

use std::array::from_fn;
use std::ops::Range;

use glam::Vec2;

use crate::dcr::ground::border::Border;
use crate::dcr::ground::constraints::{Constraints, Force};
use crate::dcr::ground::torus::{Place, Torus};
use crate::dcr::uniform::cells::Cells;
use crate::dcr::uniform::mesh::{Edge, Mesh};
use crate::dcr::uniform::rings::Rings;
use crate::dcr::uniform::stars::{Felt, LANES, Visit};
use crate::error::Result;
use crate::geometry::delaunay::Delaunay;
use crate::job::{Job, chunks};
use crate::rng::{Draw, Rng};
use crate::simd::Level;

/// How far points may move in the room that they have: less than half, so that no triangle turns over.
pub(in crate::dcr) const ROOM: f32 = 0.45;

/// The room, in spacings, of points that are in no mesh.
pub(in crate::dcr) const WIDE: f32 = 1.0;

/// What knows the neighbours of each point.
pub(super) enum Neighbours {
    Mesh(Mesh),
    /// Where there can be no mesh.
    Stars(Delaunay),
    Cells(Cells),
}

/// Where points are, and how fast.
#[derive(Default)]
pub(super) struct State {
    /// The places of the points, and after them those of their images on the torus.
    pub(super) places: Vec<Place>,
    pub(super) velocities: Vec<Vec2>,
}

impl State {
    /// Makes room for as many points as another state has.
    pub(super) fn fit(&mut self, other: &Self) {
        self.places.resize(other.places.len(), [0; 2]);
        self.velocities.resize(other.velocities.len(), Vec2::ZERO);
    }
}

/// What moves points.
pub(super) struct Step<'a> {
    pub(super) torus: &'a Torus,
    /// None for a periodic domain.
    pub(super) border: Option<&'a Border>,
    pub(super) vectors: Level,
    pub(super) constraints: Constraints,
    /// The share of its way that a point makes again.
    pub(super) momentum: f32,
    /// By how much each point is moved besides; empty if none is.
    pub(super) drift: &'a [Vec2],
    /// How hard points are kicked whose constraints are violated, and the number of the kick.
    pub(super) kick: Option<(f32, u32)>,
}

/// What was seen while points gathered.
#[derive(Default)]
pub(super) struct Seen {
    /// The edges that may have to be flipped, in the order of the points.
    pub(super) suspects: Vec<Edge>,
    /// Whether a triangle had turned over.
    pub(super) is_unsound: bool,
    /// The number of points whose constraints were violated before the step; of points in no mesh it is not known.
    pub(super) violated: usize,
    /// The square of the longest way that a point has gone that is in no mesh.
    pub(super) longest_way_squared: f32,
}

/// A part of the points, and where their next state goes; nowhere for images, which follow their points.
struct Part<'a> {
    points: Range<usize>,
    places: &'a mut [Place],
    velocities: &'a mut [Vec2],
}

impl Step<'_> {
    /// Writes the state after `now`.
    pub(super) fn advance(&self, job: &Job, neighbours: &Neighbours, now: &State, next: &mut State) -> Result<Seen> {
        let count = now.velocities.len();
        let seen = job.part(0.0, 0.9).map_each(parts(count, next), |part| {
            let constraints = &self.constraints;
            let mut gathering = Gathering { step: self, now, part, seen: Seen::default() };
            match neighbours {
                Neighbours::Cells(cells) => {
                    let points = gathering.part.points.clone();
                    let points = points.start..points.end.min(count).max(points.start);
                    let mut forces = Vec::with_capacity(points.len());
                    cells.forces(self.vectors, &now.places, constraints, points.clone(), &mut forces);
                    gathering.each(|point| Force { sum: forces[point - points.start], room: WIDE });
                }
                Neighbours::Mesh(mesh) => {
                    let points = gathering.part.points.clone();
                    mesh.feel(self.vectors, &now.places, constraints, points, &mut gathering);
                }
                Neighbours::Stars(delaunay) => {
                    let mut ring = Vec::new();
                    gathering.each(|point| {
                        ring.clear();
                        ring.extend(delaunay.ring(point).map(|offset| offset.as_vec2()));
                        Force { room: WIDE, ..constraints.force(&ring) }
                    });
                }
            }
            gathering.seen
        })?;
        self.torus.mirror(&job.part(0.9, 1.0), &mut next.places, count)?;
        let mut all = Seen::default();
        for part in seen {
            all.suspects.extend(part.suspects);
            all.is_unsound |= part.is_unsound;
            all.violated += part.violated;
            all.longest_way_squared = all.longest_way_squared.max(part.longest_way_squared);
        }
        Ok(all)
    }

    /// Where a point gets by a force, and how fast.
    #[inline(always)]
    fn moved(&self, velocity: Vec2, Force { sum, room }: Force, drift: Vec2) -> (Vec2, Vec2) {
        let limit = ROOM * room;
        let velocity = self.momentum * velocity + sum;
        (limited(velocity + drift, limit), limited(velocity, limit))
    }

    /// The kick of a point in some direction.
    #[cold]
    fn kick(&self, (strength, number): (f32, u32), point: usize) -> Vec2 {
        let mut rng = Rng::at(number.into(), Draw::Kick, &[point as u64]);
        strength * Vec2::from_angle((std::f64::consts::TAU * rng.unit()) as f32)
    }
}

/// A vector that is cut to a length.
#[inline(always)]
fn limited(vector: Vec2, limit: f32) -> Vec2 {
    let squared = vector.x * vector.x + vector.y * vector.y;
    let scale = if squared > limit * limit { limit / squared.sqrt() } else { 1.0 };
    Vec2::new(vector.x * scale, vector.y * scale)
}

/// A part of the points on their way.
struct Gathering<'a> {
    step: &'a Step<'a>,
    now: &'a State,
    part: Part<'a>,
    seen: Seen,
}

impl Gathering<'_> {
    /// Moves points one by one; images are not looked at.
    fn each(&mut self, mut force: impl FnMut(usize) -> Force) {
        let Part { points, places, velocities } = &mut self.part;
        for ((point, place), velocity) in points.clone().zip(places.iter_mut()).zip(velocities.iter_mut()) {
            let drift = self.step.drift.get(point).copied().unwrap_or(Vec2::ZERO);
            let Force { sum, room } = force(point);
            let at_border = |border: &Border| border.force(&self.step.constraints, self.now.places[point], sum);
            let force = Force { sum: self.step.border.map_or(sum, at_border), room };
            let way;
            (way, *velocity) = self.step.moved(self.now.velocities[point], force, drift);
            self.seen.longest_way_squared = self.seen.longest_way_squared.max(way.length_squared());
            *place = self.step.torus.moved(self.now.places[point], way);
        }
    }
}

impl Visit for Gathering<'_> {
    #[inline(always)]
    fn visit(&mut self, rings: &Rings, points: Range<usize>, felt: &Felt) {
        self.seen.is_unsound |= !felt.are_sound(points.len());
        felt.suspects(rings, points.clone(), &mut self.seen.suspects);
        if points.start >= self.now.velocities.len() {
            return;
        }
        self.seen.violated += felt.violated(points.len()).count();
        let mut force = felt.force;
        if let Some(border) = self.step.border {
            for (lane, point) in points.clone().enumerate() {
                let sum = Vec2::new(force[0][lane], force[1][lane]);
                [force[0][lane], force[1][lane]] =
                    border.force(&self.step.constraints, self.now.places[point], sum).to_array();
            }
        }
        if let Some(kick) = self.step.kick {
            for lane in felt.violated(points.len()) {
                let kick = self.step.kick(kick, points.start + lane);
                force[0][lane] += kick.x;
                force[1][lane] += kick.y;
            }
        }
        let lane_of = |lane: usize| points.start + lane.min(points.len() - 1);
        let (now, step) = (self.now, self.step);
        let velocities: [Vec2; LANES] = from_fn(|lane| now.velocities[lane_of(lane)]);
        let drifts: [Vec2; LANES] =
            if step.drift.is_empty() { [Vec2::ZERO; LANES] } else { from_fn(|lane| step.drift[lane_of(lane)]) };
        let moved: [(Vec2, Vec2); LANES] = from_fn(|lane| {
            let force = Force { sum: Vec2::new(force[0][lane], force[1][lane]), room: felt.room[lane] };
            step.moved(velocities[lane], force, drifts[lane])
        });
        let first = points.start - self.part.points.start;
        for (lane, (way, velocity)) in moved.into_iter().enumerate().take(points.len()) {
            self.part.velocities[first + lane] = velocity;
            self.part.places[first + lane] = step.torus.moved(now.places[points.start + lane], way);
        }
    }
}

/// All points and images, cut into parts.
fn parts(count: usize, next: &mut State) -> Vec<Part<'_>> {
    let (own, images) = (chunks(count), chunks(next.places.len() - count));
    let places = next.places[..count].chunks_mut(own.size());
    let parts = places.zip(next.velocities.chunks_mut(own.size())).enumerate();
    let parts = parts.map(|(chunk, (places, velocities))| Part { points: own.range(chunk), places, velocities });
    let images = (0..images.len()).map(|chunk| images.range(chunk));
    let images = images.map(|range| Part {
        points: range.start + count..range.end + count,
        places: &mut [],
        velocities: &mut [],
    });
    parts.chain(images).collect()
}
