//! One step of all points: each gathers forces from its neighbours and moves.

use std::array::from_fn;
use std::ops::Range;

use glam::Vec2;

use crate::dcr::ground::boundary::MirrorBoundary;
use crate::dcr::ground::constraints::{Constraints, FREE_CLEARANCE, Force, MOMENTUM, SAFE_FRACTION};
use crate::dcr::ground::neighbours::Neighbours;
use crate::dcr::ground::torus::{Torus, TorusPoint};
use crate::dcr::uniform::cells::VerletCells;
use crate::dcr::uniform::flip_mesh::{Edge, FlipMesh};
use crate::dcr::uniform::rings::Rings;
use crate::dcr::uniform::stars::{Gathered, LANES, Visitor};
use crate::dcr::uniform::vectors::gather_in_cells;
use crate::error::Result;
use crate::job::{Job, chunks};
use crate::math::direction;
use crate::rng::{Draw, Rng};
use crate::simd::Level;

/// The clearance, in spacings, below which a point in conflict is jammed: several such points all but on a line keep each
/// other in flat triangles, in which none of them gets anywhere.
pub(super) const JAMMED: f32 = 0.02;

/// Finds the neighbours of each point.
pub(super) enum NeighbourSearch {
    Delaunay(Neighbours<FlipMesh>),
    Nearest(VerletCells),
}

/// The positions and velocities of the points.
#[derive(Default)]
pub(super) struct State {
    /// The points, and after them their images on the torus.
    pub(super) places: Vec<TorusPoint>,
    pub(super) velocities: Vec<Vec2>,
}

impl State {
    /// Resizes to the number of points of another state.
    pub(super) fn fit(&mut self, other: &Self) {
        self.places.resize(other.places.len(), [0; 2]);
        self.velocities.resize(other.velocities.len(), Vec2::ZERO);
    }
}

/// The parameters of a step.
pub(super) struct Step<'a> {
    pub(super) torus: &'a Torus,
    /// None for a periodic domain.
    pub(super) boundary: Option<&'a MirrorBoundary>,
    pub(super) level: Level,
    pub(super) constraints: Constraints,
    /// The displacement of each point by the waves; empty if there is none.
    pub(super) drift: &'a [Vec2],
    /// None if this step has none.
    pub(super) kick: Option<Kick>,
}

/// Moves points whose constraints are violated in random directions.
#[derive(Clone, Copy)]
pub(super) struct Kick {
    /// The key of the directions.
    pub(super) number: u32,
    /// Whether all of these points are kicked, or only those that are jammed.
    pub(super) is_for_all: bool,
    /// Whether jammed points are kicked, and move as if they were in no mesh.
    pub(super) frees: bool,
}

/// The length of a kick, in spacings.
const KICK: f32 = 0.03;

/// The displacement of a point by a kick, keyed by its number.
#[cold]
pub(super) fn kick(number: u32, point: usize) -> Vec2 {
    let mut rng = Rng::at(number.into(), Draw::Kick, &[point as u64]);
    KICK * direction(std::f64::consts::TAU * rng.unit()).as_vec2()
}

/// The findings while points gathered.
#[derive(Default)]
pub(super) struct Findings {
    /// The edges that may have to be flipped, in the order of the points.
    pub(super) suspects: Vec<Edge>,
    /// Whether a triangle had turned over.
    pub(super) is_unsound: bool,
    /// The number of points whose constraints were violated before the step; of points in no mesh it is not known.
    pub(super) violated: usize,
    /// Whether jammed points were moved, over which triangles may have turned over.
    pub(super) is_torn: bool,
    /// The square of the longest displacement of points that are in no mesh.
    pub(super) longest_squared: f32,
}

/// A part of the points, and their next state; empty for images, which follow their points.
struct Part<'a> {
    points: Range<usize>,
    places: &'a mut [TorusPoint],
    velocities: &'a mut [Vec2],
}

impl Step<'_> {
    /// Writes the state after `now`.
    pub(super) fn advance(
        &self,
        job: &Job,
        neighbours: &NeighbourSearch,
        now: &State,
        next: &mut State,
    ) -> Result<Findings> {
        let count = now.velocities.len();
        let found = job.part(0.0, 0.9).map_each(parts(count, next), |part| {
            let constraints = &self.constraints;
            let mut gathering = Gathering { step: self, now, part, found: Findings::default() };
            let points = gathering.part.points.clone();
            match neighbours {
                NeighbourSearch::Nearest(cells) => {
                    let points = points.start..points.end.min(count).max(points.start);
                    let mut forces = Vec::with_capacity(points.len());
                    gather_in_cells(self.level, cells, &now.places, constraints, points.clone(), &mut forces);
                    gathering.each(|point| Force { sum: forces[point - points.start], clearance: FREE_CLEARANCE });
                }
                NeighbourSearch::Delaunay(Neighbours::Kept(mesh)) => {
                    mesh.gather(self.level, &now.places, constraints, points, &mut gathering);
                }
                NeighbourSearch::Delaunay(Neighbours::Built(delaunay)) => {
                    let mut ring = Vec::new();
                    gathering.each(|point| {
                        ring.clear();
                        ring.extend(delaunay.ring(point).map(|offset| offset.as_vec2()));
                        Force { clearance: FREE_CLEARANCE, ..constraints.force(&ring) }
                    });
                }
            }
            gathering.found
        })?;
        self.torus.mirror(&job.part(0.9, 1.0), &mut next.places, count)?;
        let mut all = Findings::default();
        for part in found {
            all.suspects.extend(part.suspects);
            all.is_unsound |= part.is_unsound;
            all.is_torn |= part.is_torn;
            all.violated += part.violated;
            all.longest_squared = all.longest_squared.max(part.longest_squared);
        }
        Ok(all)
    }

    /// The displacement and the velocity of a point after a force.
    #[inline(always)]
    fn moved(&self, velocity: Vec2, Force { sum, clearance }: Force, drift: Vec2) -> (Vec2, Vec2) {
        let limit = SAFE_FRACTION * clearance;
        let velocity = MOMENTUM * velocity + sum;
        (limited(velocity + drift, limit), limited(velocity, limit))
    }
}

/// A vector, cut to a length.
#[inline(always)]
pub(super) fn limited(vector: Vec2, limit: f32) -> Vec2 {
    let squared = vector.x * vector.x + vector.y * vector.y;
    let scale = if squared > limit * limit { limit / squared.sqrt() } else { 1.0 };
    Vec2::new(vector.x * scale, vector.y * scale)
}

/// A step of a part of the points.
struct Gathering<'a> {
    step: &'a Step<'a>,
    now: &'a State,
    part: Part<'a>,
    found: Findings,
}

impl Gathering<'_> {
    /// Moves points one by one; images are ignored.
    fn each(&mut self, mut force: impl FnMut(usize) -> Force) {
        let Part { points, places, velocities } = &mut self.part;
        for ((point, place), velocity) in points.clone().zip(places.iter_mut()).zip(velocities.iter_mut()) {
            let drift = self.step.drift.get(point).copied().unwrap_or(Vec2::ZERO);
            let Force { sum, clearance } = force(point);
            let at_boundary =
                |boundary: &MirrorBoundary| boundary.force(&self.step.constraints, self.now.places[point], sum);
            let force = Force { sum: self.step.boundary.map_or(sum, at_boundary), clearance };
            let displacement;
            (displacement, *velocity) = self.step.moved(self.now.velocities[point], force, drift);
            self.found.longest_squared = self.found.longest_squared.max(displacement.length_squared());
            *place = self.step.torus.moved(self.now.places[point], displacement);
        }
    }
}

impl Visitor for Gathering<'_> {
    #[inline(always)]
    fn visit(&mut self, rings: &Rings, points: Range<usize>, gathered: &Gathered) {
        self.found.is_unsound |= !gathered.are_sound(points.len());
        gathered.suspects(rings, points.clone(), &mut self.found.suspects);
        if points.start >= self.now.velocities.len() {
            return;
        }
        self.found.violated += gathered.violated(points.len()).count();
        let mut force = gathered.force;
        if let Some(boundary) = self.step.boundary {
            for (lane, point) in points.clone().enumerate() {
                let sum = Vec2::new(force[0][lane], force[1][lane]);
                [force[0][lane], force[1][lane]] =
                    boundary.force(&self.step.constraints, self.now.places[point], sum).to_array();
            }
        }
        let mut clearance = gathered.clearance;
        if let Some(kick) = self.step.kick {
            for lane in gathered.violated(points.len()) {
                let is_jammed = kick.frees && clearance[lane] < JAMMED;
                if !(is_jammed || kick.is_for_all) {
                    continue;
                }
                let kicked = self::kick(kick.number, points.start + lane);
                force[0][lane] += kicked.x;
                force[1][lane] += kicked.y;
                if is_jammed {
                    clearance[lane] = FREE_CLEARANCE;
                    self.found.is_torn = true;
                }
            }
        }
        let lane_of = |lane: usize| points.start + lane.min(points.len() - 1);
        let (now, step) = (self.now, self.step);
        let velocities: [Vec2; LANES] = from_fn(|lane| now.velocities[lane_of(lane)]);
        let drifts: [Vec2; LANES] =
            if step.drift.is_empty() { [Vec2::ZERO; LANES] } else { from_fn(|lane| step.drift[lane_of(lane)]) };
        let moved: [(Vec2, Vec2); LANES] = from_fn(|lane| {
            let force = Force { sum: Vec2::new(force[0][lane], force[1][lane]), clearance: clearance[lane] };
            step.moved(velocities[lane], force, drifts[lane])
        });
        let first = points.start - self.part.points.start;
        for (lane, (displacement, velocity)) in moved.into_iter().enumerate().take(points.len()) {
            self.part.velocities[first + lane] = velocity;
            self.part.places[first + lane] = step.torus.moved(now.places[points.start + lane], displacement);
        }
    }
}

/// All points and images in parts.
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
