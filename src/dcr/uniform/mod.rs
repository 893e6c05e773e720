//! The momentum method at a constant density: push, pull, and long waves removed.
//!
//! It keeps from the thesis: neighbours in conflict repel each other, neighbourhoods are Delaunay stars or nearest
//! points, all points move at once by the forces that they gather. Newer, or measured here:
//!
//! * holes attract, not long edges (`law.rs`);
//! * points have momentum instead of activeness: alternating forces cancel out, steady ones add up;
//! * the density's long waves are removed directly, every few steps (`torus/waves.rs`), and in the first steps finer
//!   ones;
//! * the boundary of a bounded domain is a mirror in which points do not see themselves (`torus/boundary.rs`);
//! * constraints grow stiffer: soft ones let the set stay irregular while it spreads, stiff ones leave no violations;
//! * points that block each other for good are kicked, and those that flat triangles jam move as if in no mesh;
//! * the triangulation is kept and repaired by flips (`flip_mesh`), that of a few points on a torus of several periods
//!   (`cover`). Where it cannot be, with large holes, it is built anew in every step.

mod cells;
mod classes;
mod cover;
mod flip_mesh;
mod rings;
mod stars;

pub use classes::{ClassReport, relax_classes};
pub use flip_mesh::FlipMesh;

use std::array::from_fn;
use std::ops::Range;

use glam::Vec2;

use crate::dcr::law::{Constraints, FREE_CLEARANCE, Force, Neighbourhood, SAFE_FRACTION};
use crate::dcr::relaxation::{PlaneRelaxation, Relaxation};
use crate::dcr::torus::{
    CLUSTERED, CurveOrder, LONG_WAVES, MirrorBoundary, Neighbours, Torus, TorusPoint, WaveGrid, leveled,
};
use crate::dcr::uniform::cells::VerletCells;
use crate::dcr::uniform::rings::{Edge, Rings};
use crate::dcr::uniform::stars::{EIGHT, Gathered, Visitor};
use crate::error::Result;
use crate::geometry::Delaunay;
use crate::job::{Job, chunks};
use crate::math::direction;
use crate::points::Domain;
use crate::rng::{Draw, Rng};
use crate::simd::Level;

/// The number of steps from one removal of waves to the next.
pub const WAVES_EVERY: u32 = 5;

/// Waves are removed up to this frequency, in units of sqrt(density), until the points have spread. That includes finer
/// waves than low frequencies: it fills holes that the constraints do not see, with nearest neighbours in all steps.
const FINE_WAVES: f64 = 0.55;

/// The number of steps during which this frequency falls to [`LONG_WAVES`]: in the end fine waves are due to the
/// constraints, which removing them would disturb.
const COARSENING: Range<u32> = 60..85;

/// The number of steps from one kick to the next, and the step of the last. Points whose constraints are violated are
/// kicked: where points block each other for good, this moves one of them out.
pub const KICK_EVERY: u32 = 8;
pub const LAST_KICK: u32 = 56;

/// The first kick that frees jammed points, after which the mesh is rebuilt. Until then most become free by themselves.
pub const FIRST_FREE: u32 = 24;

/// The fraction of the points above which violations are not exceptions: only jammed points are kicked, and waves act
/// at the boundary too.
const FEW: f64 = 0.04;

/// The points, their velocities, and the search for their neighbours.
pub struct UniformRelaxation {
    torus: Torus,
    /// None for a periodic domain.
    boundary: Option<MirrorBoundary>,
    waves: WaveGrid,
    neighbourhood: Neighbourhood,
    level: Level,
    seed: u64,
    order: CurveOrder,
    state: State,
    /// Memory for the next state.
    next: State,
    /// The last of the states with the fewest points whose constraints are violated, and the number of these points.
    least_violated: State,
    fewest: usize,
    /// The number of points whose constraints were violated before the last step.
    violated: usize,
    /// The mesh of the points, once it exists. Steps pass it on: in a box, so that of a few points it does not take more
    /// time to move than to use.
    mesh: Option<Box<FlipMesh>>,
    /// The edges of the mesh that may have to be flipped after the last step; none if triangles may have turned over.
    suspects: Option<Vec<Edge>>,
    /// The cells of the points, while they are valid.
    cells: Option<Box<VerletCells>>,
}

impl UniformRelaxation {
    /// The points before the first step.
    pub fn new(domain: Domain, neighbourhood: Neighbourhood, seed: u64, points: &[[f32; 2]]) -> Self {
        let torus = Torus::new(domain, points.len());
        let order = CurveOrder::new(&torus, points, seed);
        let boundary = MirrorBoundary::new(&torus, neighbourhood);
        Self {
            boundary,
            waves: WaveGrid::new(&torus, boundary, order.len()),
            neighbourhood,
            level: Level::widest(),
            next: State::default(),
            least_violated: State::default(),
            fewest: usize::MAX,
            violated: usize::MAX,
            state: State { places: torus.with_images(order.start()), velocities: vec![Vec2::ZERO; order.len()] },
            mesh: None,
            suspects: None,
            cells: None,
            torus,
            seed,
            order,
        }
    }

    fn neighbours(&mut self, job: &Job, iteration: u32) -> Result<NeighbourSearch> {
        let places = &self.state.places;
        if self.neighbourhood == Neighbourhood::Nearest {
            let reach = self.constraints(iteration).conflict_radius;
            let cells = self.cells.take();
            let mut cells = cells.unwrap_or_else(|| Box::new(VerletCells::new(&self.torus, places, reach)));
            cells.update(job, places)?;
            return Ok(NeighbourSearch::Nearest(cells));
        }
        let mesh = match self.mesh.take() {
            Some(mesh) => Some(mesh),
            None => FlipMesh::new(&job.part(0.0, 0.5), &self.torus, places)?.map(Box::new),
        };
        Ok(NeighbourSearch::Delaunay(match mesh {
            Some(mesh) => Neighbours::Kept(mesh),
            None => Neighbours::Built(self.triangulate(&job.part(0.5, 1.0))?),
        }))
    }

    fn triangulate(&self, job: &Job) -> Result<Delaunay> {
        Delaunay::new(job, &self.torus.frame, self.torus.nudged(&self.state.places).into_iter())
    }

    fn constraints(&self, iteration: u32) -> Constraints {
        match self.neighbourhood {
            Neighbourhood::Delaunay => Constraints::of_step(iteration),
            Neighbourhood::Nearest => {
                Constraints { conflict_radius: 0.92, coverage_radius: f32::INFINITY, ..Constraints::of_step(iteration) }
            }
        }
    }

    /// Proceeds to the next state, and keeps the one before if no other had fewer violated constraints.
    fn keep(&mut self, next: State, violated: Option<usize>) {
        self.next = std::mem::replace(&mut self.state, next);
        self.violated = violated.unwrap_or(usize::MAX);
        if self.violated <= self.fewest {
            std::mem::swap(&mut self.least_violated, &mut self.next);
            self.fewest = self.violated;
        }
    }

    /// True if the set has spread, with few exceptions.
    fn are_few_violated(&self) -> bool {
        self.violated as f64 <= FEW * self.order.len() as f64
    }

    /// The parameters of the next step.
    fn parameters<'a>(&'a self, iteration: u32, drift: &'a [Vec2]) -> Step<'a> {
        let kicks = iteration.is_multiple_of(KICK_EVERY) && iteration <= LAST_KICK;
        let kick = Kick { number: iteration, is_for_all: self.are_few_violated(), frees: iteration >= FIRST_FREE };
        Step {
            torus: &self.torus,
            boundary: self.boundary.as_ref(),
            level: self.level,
            constraints: self.constraints(iteration),
            drift,
            kick: kicks.then_some(kick),
        }
    }
}

/// The frequency up to which waves are removed after a number of steps.
pub fn highest_wave(iterations: u32) -> f64 {
    let done = iterations.clamp(COARSENING.start, COARSENING.end) - COARSENING.start;
    let share = f64::from(done) / f64::from(COARSENING.end - COARSENING.start);
    FINE_WAVES + (LONG_WAVES - FINE_WAVES) * share
}

impl Relaxation for UniformRelaxation {
    type Position = TorusPoint;
    type Space = Torus;

    fn space(&self) -> Torus {
        self.torus
    }

    fn positions(&self) -> impl ExactSizeIterator<Item = TorusPoint> {
        self.state.places[..self.order.len()].iter().copied()
    }

    fn begin(&mut self, job: &Job) -> Result<()> {
        if let Some(leveled) = leveled(job, &self.torus, &self.waves, &self.state.places, &CLUSTERED, self.seed)? {
            let places;
            (self.order, places) = self.order.reordered(&leveled);
            self.state.places = self.torus.with_images(&places);
        }
        Ok(())
    }

    fn step(&mut self, job: &Job, iteration: u32) -> Result<()> {
        let count = self.order.len();
        let mut drift = match iteration.is_multiple_of(WAVES_EVERY) {
            true => self.waves.drift(&job.part(0.0, 0.2), &self.state.places, count, highest_wave(iteration))?,
            false => Vec::new(),
        };
        if let Some(boundary) = &self.boundary
            && self.are_few_violated()
        {
            boundary.calm(iteration, &self.state.places, &mut drift);
        }
        let mut next = std::mem::take(&mut self.next);
        next.fit(&self.state);
        let mut neighbours = self.neighbours(&job.part(0.2, 0.4), iteration)?;
        let parameters = self.parameters(iteration, &drift);
        let mut found = parameters.advance(&job.part(0.4, 0.6), &neighbours, &self.state, &mut next)?;
        if found.is_unsound
            && let Some(mesh) = FlipMesh::of_few(&job.part(0.6, 0.61), &self.torus, &self.state.places)?
        {
            neighbours = NeighbourSearch::Delaunay(Neighbours::Kept(Box::new(mesh)));
            found = parameters.advance(&job.part(0.61, 0.63), &neighbours, &self.state, &mut next)?;
        }
        if found.is_unsound {
            neighbours = NeighbourSearch::Delaunay(Neighbours::Built(self.triangulate(&job.part(0.63, 0.65))?));
            found = parameters.advance(&job.part(0.65, 0.7), &neighbours, &self.state, &mut next)?;
        }
        let is_known = matches!(&neighbours, NeighbourSearch::Delaunay(Neighbours::Kept(mesh)) if mesh.holds_back());
        self.keep(next, is_known.then_some(found.violated));
        match neighbours {
            NeighbourSearch::Delaunay(Neighbours::Kept(mesh)) => {
                // Triangles of a few points rarely have turned over.
                self.mesh = (!found.is_torn || !mesh.holds_back()).then_some(mesh);
                self.suspects = (!found.is_torn).then_some(found.suspects);
            }
            NeighbourSearch::Nearest(mut cells) => {
                let reach = self.constraints(iteration + 1).conflict_radius;
                self.cells = cells.still_serve(found.longest_squared.sqrt(), reach).then_some(cells);
            }
            NeighbourSearch::Delaunay(Neighbours::Built(_)) => {}
        }
        Ok(())
    }

    fn follow(&mut self, job: &Job) -> Result<()> {
        if let Some(mut mesh) = self.mesh.take() {
            let (job, places) = (job.part(0.7, 1.0), &self.state.places);
            let is_sound = match self.suspects.take() {
                Some(suspects) => mesh.mend(&job, places, suspects)?,
                None => mesh.repair(&job, places)?,
            };
            self.mesh = is_sound.then_some(mesh);
        }
        Ok(())
    }

    fn has_converged(&self, is_at_rest: bool) -> bool {
        is_at_rest && (self.neighbourhood == Neighbourhood::Nearest || self.violated == 0)
    }

    fn finish(&mut self, job: &Job, iterations: u32) -> Result<()> {
        if iterations == 0 {
            self.state.places = self.torus.with_images(self.order.given());
            self.mesh = None;
        }
        let places = &self.state.places;
        let mesh = match self.mesh.take() {
            Some(mut mesh) => mesh.repair(&job.part(0.0, 0.5), places)?.then_some(mesh),
            None if self.fewest == usize::MAX => None,
            // A call that was cancelled may have lost the mesh.
            None => FlipMesh::new(&job.part(0.0, 0.5), &self.torus, places)?.map(Box::new),
        };
        let Some(mesh) = mesh else { return Ok(()) };
        if self.fewest == usize::MAX || mesh.violated(&job.part(0.5, 1.0), places, self.order.len())? <= self.fewest {
            self.mesh = Some(mesh);
        } else {
            self.state = std::mem::take(&mut self.least_violated);
            self.fewest = usize::MAX;
        }
        Ok(())
    }
}

impl PlaneRelaxation for UniformRelaxation {
    fn points(&self, points: &[[f32; 2]]) -> Vec<[f32; 2]> {
        self.order.leave(&self.torus, &self.state.places, points)
    }

    fn covering_radius(&mut self, job: &Job) -> Result<f64> {
        let places = &self.state.places;
        let mesh = match self.mesh.take() {
            Some(mesh) => Some(mesh),
            None => FlipMesh::new(&job.part(0.0, 0.5), &self.torus, places)?.map(Box::new),
        };
        let radius = match mesh {
            Some(mesh) => mesh.covering_radius(&job.part(0.5, 1.0), places)?,
            None => self.triangulate(&job.part(0.5, 1.0))?.covering_radius(),
        };
        Ok(radius * self.torus.frame.spacing())
    }
}

/// The clearance, in spacings, below which a point in conflict is jammed: several such points almost on a line keep
/// each other in flat triangles, in which none of them can move far.
pub const JAMMED: f32 = 0.02;

/// Finds the neighbours of each point.
pub enum NeighbourSearch {
    Delaunay(Neighbours<Box<FlipMesh>>),
    Nearest(Box<VerletCells>),
}

/// The positions and velocities of the points.
#[derive(Default)]
pub struct State {
    /// The points, and after them their images on the torus.
    pub places: Vec<TorusPoint>,
    pub velocities: Vec<Vec2>,
}

impl State {
    /// Resizes to the number of points of another state.
    pub fn fit(&mut self, other: &Self) {
        self.places.resize(other.places.len(), [0; 2]);
        self.velocities.resize(other.velocities.len(), Vec2::ZERO);
    }
}

/// The parameters of a step.
pub struct Step<'a> {
    pub torus: &'a Torus,
    /// None for a periodic domain.
    pub boundary: Option<&'a MirrorBoundary>,
    pub level: Level,
    pub constraints: Constraints,
    /// The displacement of each point by the waves; empty if there is none.
    pub drift: &'a [Vec2],
    /// None if this step has no kick.
    pub kick: Option<Kick>,
}

/// Moves points whose constraints are violated in random directions.
#[derive(Clone, Copy)]
pub struct Kick {
    /// The key of the directions.
    pub number: u32,
    /// True if all of these points are kicked, or only those that are jammed.
    pub is_for_all: bool,
    /// True if jammed points are kicked, and move as if they were in no mesh.
    pub frees: bool,
}

/// The length of a kick, in spacings.
const KICK: f32 = 0.03;

/// The displacement of a point by a kick, keyed by its number.
#[cold]
pub fn kick(number: u32, point: usize) -> Vec2 {
    let mut rng = Rng::at(number.into(), Draw::Kick, &[point as u64]);
    KICK * direction(std::f64::consts::TAU * rng.unit()).as_vec2()
}

/// The results of a gather.
#[derive(Default)]
pub struct StepOutcome {
    /// The edges that may have to be flipped, in the order of the points.
    pub suspects: Vec<Edge>,
    /// True if a triangle had turned over.
    pub is_unsound: bool,
    /// The number of points whose constraints were violated before the step; not known for points in no mesh.
    pub violated: usize,
    /// True if jammed or free points were moved so far that triangles may have turned over.
    pub is_torn: bool,
    /// The square of the longest displacement of points that are in no mesh.
    pub longest_squared: f32,
}

/// A part of the points, and their next state; empty for images, which follow their points.
struct Part<'a> {
    points: Range<usize>,
    places: &'a mut [TorusPoint],
    velocities: &'a mut [Vec2],
}

impl Step<'_> {
    /// Writes the state after `now`.
    pub fn advance(
        &self,
        job: &Job,
        neighbours: &NeighbourSearch,
        now: &State,
        next: &mut State,
    ) -> Result<StepOutcome> {
        let count = now.velocities.len();
        let found = job.part(0.0, 0.9).map_each(parts(count, next), |part| {
            let constraints = &self.constraints;
            let mut gathering = Gathering { step: self, now, part, is_free: false, found: StepOutcome::default() };
            let points = gathering.part.points.clone();
            match neighbours {
                NeighbourSearch::Nearest(cells) => {
                    let points = points.start..points.end.min(count).max(points.start);
                    let mut forces = Vec::with_capacity(points.len());
                    cells.gather(self.level, &now.places, constraints, points.clone(), &mut forces);
                    gathering.each(|point| Force { sum: forces[point - points.start], clearance: FREE_CLEARANCE });
                }
                NeighbourSearch::Delaunay(Neighbours::Kept(mesh)) => {
                    gathering.is_free = !mesh.holds_back();
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
        let mut all = StepOutcome::default();
        for part in found {
            all.suspects.extend(part.suspects);
            all.is_unsound |= part.is_unsound;
            all.is_torn |= part.is_torn;
            all.violated += part.violated;
            all.longest_squared = all.longest_squared.max(part.longest_squared);
        }
        Ok(all)
    }
}

/// A step of a part of the points.
struct Gathering<'a> {
    step: &'a Step<'a>,
    now: &'a State,
    part: Part<'a>,
    /// True if the mesh does not hold points back: they move as if they were in no mesh.
    is_free: bool,
    found: StepOutcome,
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
            (displacement, *velocity) = force.moves(self.now.velocities[point], drift);
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
        let mut clearance = if self.is_free { [FREE_CLEARANCE; EIGHT] } else { gathered.clearance };
        if let Some(kick) = self.step.kick.filter(|_| !self.is_free) {
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
        let velocities: [Vec2; EIGHT] = from_fn(|lane| now.velocities[lane_of(lane)]);
        let drifts: [Vec2; EIGHT] =
            if step.drift.is_empty() { [Vec2::ZERO; EIGHT] } else { from_fn(|lane| step.drift[lane_of(lane)]) };
        let moved: [(Vec2, Vec2); EIGHT] = from_fn(|lane| {
            let force = Force { sum: Vec2::new(force[0][lane], force[1][lane]), clearance: clearance[lane] };
            force.moves(velocities[lane], drifts[lane])
        });
        let first = points.start - self.part.points.start;
        for (lane, (displacement, velocity)) in moved.into_iter().enumerate().take(points.len()) {
            let safe = SAFE_FRACTION * gathered.clearance[lane];
            self.found.is_torn |= self.is_free && displacement.length_squared() > safe * safe;
            self.part.velocities[first + lane] = velocity;
            self.part.places[first + lane] = step.torus.moved(now.places[points.start + lane], displacement);
        }
    }
}

/// All points and images, in parts.
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

#[cfg(test)]
mod tests {
    use super::*;

    use crate::dcr::torus::random_sets::random_places;
    use crate::job::Context;
    use crate::points::Boundary;

    /// A step of a few points with the triangulation that is kept is the one with a triangulation built for it, also
    /// after many steps; and all points move freely.
    #[test]
    fn a_few_points_move_as_with_a_triangulation_built_for_each_step() {
        let context = Context::new(1).unwrap();
        for (width, count) in [(1.0, 2), (1.0, 3), (1.0, 5), (9.0, 6), (1.0, 16), (0.02, 11), (7.0, 64)] {
            let (torus, places) = random_places(Boundary::Periodic, width, count);
            let points: Vec<_> = places.iter().map(|&place| torus.leave(place)).collect();
            let domain = Domain { min: [0.0; 2], max: [width, 1.0], boundary: Boundary::Periodic };
            let mut set = UniformRelaxation::new(domain, Neighbourhood::Delaunay, 0, &points);
            let mut compared = 0;
            context
                .run(None, |job| {
                    (0..60).try_for_each(|iteration| {
                        if let Some(mut mesh) = set.mesh.take() {
                            set.mesh = mesh.repair(job, &set.state.places)?.then_some(mesh);
                        }
                        let Some(mesh) = set.mesh.take_if(|mesh| !mesh.holds_back()) else {
                            set.step(job, iteration)?;
                            return set.follow(job);
                        };
                        compared += 1;
                        let step = Step { kick: None, ..set.parameters(iteration, &[]) };
                        let built = Neighbours::Built(set.triangulate(job)?);
                        let [kept, built] = [Neighbours::Kept(mesh), built].map(|neighbours| {
                            let mut next = State::default();
                            next.fit(&set.state);
                            let neighbours = NeighbourSearch::Delaunay(neighbours);
                            let found = step.advance(job, &neighbours, &set.state, &mut next).unwrap();
                            assert!(!found.is_unsound);
                            let NeighbourSearch::Delaunay(Neighbours::Kept(mesh)) = neighbours else {
                                return (next, None);
                            };
                            (next, Some(mesh))
                        });
                        for (&kept, &built) in kept.0.places.iter().zip(&built.0.places) {
                            let error = torus.offset(kept, built).length();
                            assert!(error < 1e-4, "{count} points in {width}, {iteration}: {error}");
                        }
                        set.mesh = kept.1;
                        set.step(job, iteration)?;
                        set.follow(job)
                    })
                })
                .unwrap();
            assert!(compared > 20, "{count} points in {width}: {compared}");
        }
    }

    /// With more steps a set gets no worse, even though kicks may make the last state worse than one before.
    #[test]
    fn the_state_with_the_fewest_violations_is_returned() {
        let context = Context::new(1).unwrap();
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            let domain = Domain { min: [0.0; 2], max: [1.0; 2], boundary };
            let mut rng = Rng::at(7, Draw::Probe, &[]);
            let points: Vec<_> = (0..1500).map(|_| [rng.unit(), rng.unit()].map(|x| x as f32)).collect();
            let (mut before, mut kicked_back) = (usize::MAX, 0);
            for steps in [0, 1, 2, 5, 30, 38, 39, 40, 41, 42, 43, 44, 45, 48, 100] {
                context
                    .run(None, |job| {
                        let mut set = UniformRelaxation::new(domain, Neighbourhood::Delaunay, 0, &points);
                        (0..steps).try_for_each(|iteration| {
                            set.step(job, iteration)?;
                            set.follow(job)
                        })?;
                        let violated = |set: &UniformRelaxation| {
                            let places = &set.state.places;
                            FlipMesh::new(job, &set.torus, places)?.unwrap().violated(job, places, points.len())
                        };
                        let last = violated(&set)?;
                        set.finish(job, steps)?;
                        let least = violated(&set)?;
                        assert!(least <= last && least <= before, "{boundary:?}, {steps}: {least}, {last}, {before}");
                        kicked_back += usize::from(least < last);
                        before = least;
                        Ok(())
                    })
                    .unwrap();
            }
            assert!(kicked_back > 0 && before == 0, "{boundary:?}: {before}");
        }
    }
}
