//! The best mode: push, pull, and long waves removed.
//!
//! What it has from the thesis: neighbours in conflict repel each other, neighbourhoods are Delaunay stars or nearest
//! points, all points move at once by what they gather. What is better known today, or measured here:
//!
//! * holes attract, not long edges (`constraints.rs`);
//! * points have momentum instead of activeness: what pulls to and fro cancels out, what keeps pulling adds up;
//! * the density's long waves are removed directly, every few steps (`waves.rs`), and at first not only the long ones;
//! * the border of a bounded domain is a mirror in which points do not see themselves (`border.rs`);
//! * constraints grow stiffer: soft ones let the set stay irregular while it finds its places, stiff ones make sure of
//!   the last point;
//! * points that are in each other's way for good are kicked;
//! * the triangulation is kept and repaired by flips (`mesh.rs`). Where it cannot be, with a few points or large holes, it
//!   is built anew in every step.

mod cells;
pub(super) mod gather;
mod mesh;
mod rings;
mod stars;
mod tiles;
#[allow(unsafe_code)] // Vector instructions.
mod vectors;

use std::ops::Range;

use glam::Vec2;

use self::cells::Cells;
use self::gather::{Neighbours, State, Step};
use self::mesh::Mesh;
use crate::dcr::ground::border::Border;
use crate::dcr::ground::constraints::Constraints;
use crate::dcr::ground::motion::Motion;
use crate::dcr::ground::torus::{Place, Torus, along_curve};
use crate::dcr::ground::waves::Waves;
use crate::dcr::{Neighbourhood, Options, Relaxation};
use crate::error::Result;
use crate::geometry::delaunay::Delaunay;
use crate::job::Job;
use crate::simd::Level;

/// The share of its way that a point makes again in the next step.
pub(super) const MOMENTUM: f32 = 0.78;

/// Long waves are removed in one of so many steps.
const WAVES_EVERY: u32 = 5;

/// Waves are removed up to this frequency, in units of sqrt(density), while points find their places. That is finer than
/// low frequencies are: it fills holes for which constraints are blind, those of nearest neighbours all the time.
const FINE_WAVES: f64 = 0.55;

/// The same at the end: fine waves are then due to the constraints, which this would disturb.
pub(super) const LONG_WAVES: f64 = 0.25;

/// The steps during which one becomes the other.
const COARSENING: Range<u32> = 60..85;

/// In every so manieth step, up to the last, points whose constraints are still violated are kicked by so many spacings. Where
/// points are in each other's way for good, that is what leads one of them out.
const KICK_EVERY: u32 = 8;
const LAST_KICK: u32 = 56;
const KICK: f32 = 0.03;

/// The share of the points above which violations are no exceptions: none is kicked, and waves help at the border as well.
const FEW: f64 = 0.04;

/// The step size by which motion is measured: a span is 10 steps, in which long waves are removed twice.
pub(super) const STEP: f64 = 0.2;

/// A set in the making.
pub(super) struct Spread {
    torus: Torus,
    /// None for a periodic domain.
    border: Option<Border>,
    waves: Waves,
    neighbourhood: Neighbourhood,
    vectors: Level,
    /// The user's index of each point: points are kept along a curve.
    order: Vec<u32>,
    /// Where the points began.
    start: Vec<Place>,
    state: State,
    /// What the next state is written to.
    next: State,
    /// The state in which the fewest points had their constraints violated, and how many; the last of these states.
    best: State,
    fewest: usize,
    /// How many it were before the last step.
    violated: usize,
    /// The mesh of the places, once there is one.
    mesh: Option<Mesh>,
    /// The cells of the points, as long as they serve.
    cells: Option<Cells>,
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
        let places = torus.with_images(&start);
        let velocities = vec![Vec2::ZERO; start.len()];
        let border = Border::new(&torus, options.neighbourhood);
        Self {
            border,
            waves: Waves::new(&torus, border, start.len()),
            neighbourhood: options.neighbourhood,
            vectors: Level::widest(),
            next: State::default(),
            best: State::default(),
            fewest: usize::MAX,
            violated: usize::MAX,
            state: State { places, velocities },
            mesh: None,
            cells: None,
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
            let reach = self.constraints().conflict_radius;
            let mut cells = self.cells.take().unwrap_or_else(|| Cells::new(&self.torus, places, reach));
            cells.update(job, places)?;
            return Ok(Neighbours::Cells(cells));
        }
        match Mesh::new(&job.part(0.0, 0.5), &self.torus, places)? {
            Some(mesh) => Ok(Neighbours::Mesh(mesh)),
            None => Ok(Neighbours::Stars(self.triangulate(&job.part(0.5, 1.0))?)),
        }
    }

    fn triangulate(&self, job: &Job) -> Result<Delaunay> {
        Delaunay::new(job, &self.torus.frame, self.torus.nudged(&self.state.places).into_iter())
    }

    fn constraints(&self) -> Constraints {
        match self.neighbourhood {
            Neighbourhood::Delaunay => Constraints::of_step(self.iterations),
            Neighbourhood::Nearest => Constraints {
                conflict_radius: 0.92,
                coverage_radius: f32::INFINITY,
                ..Constraints::of_step(self.iterations)
            },
        }
    }
}

impl Spread {
    /// The frequency up to which waves are removed in this step.
    fn highest_wave(&self) -> f64 {
        let done = self.iterations.clamp(COARSENING.start, COARSENING.end) - COARSENING.start;
        let share = f64::from(done) / f64::from(COARSENING.end - COARSENING.start);
        FINE_WAVES + (LONG_WAVES - FINE_WAVES) * share
    }

    /// Takes the next state, and notes the one before as the best so far if it is.
    fn keep(&mut self, next: State, violated: Option<usize>) {
        self.next = std::mem::replace(&mut self.state, next);
        self.violated = violated.unwrap_or(usize::MAX);
        if self.violated <= self.fewest {
            std::mem::swap(&mut self.best, &mut self.next);
            self.fewest = self.violated;
        }
    }

    /// Whether the set has found its places but for exceptions.
    fn are_few_violated(&self) -> bool {
        self.violated as f64 <= FEW * self.order.len() as f64
    }

    /// The step to come.
    fn go<'a>(&'a self, drift: &'a [Vec2]) -> Step<'a> {
        let kicks =
            self.are_few_violated() && self.iterations.is_multiple_of(KICK_EVERY) && self.iterations <= LAST_KICK;
        Step {
            torus: &self.torus,
            border: self.border.as_ref(),
            vectors: self.vectors,
            constraints: self.constraints(),
            momentum: MOMENTUM,
            drift,
            kick: kicks.then_some((KICK, self.iterations)),
        }
    }
}

impl Relaxation for Spread {
    fn step(&mut self, job: &Job) -> Result<()> {
        let count = self.order.len();
        let mut drift = match self.iterations.is_multiple_of(WAVES_EVERY) {
            true => self.waves.drift(&job.part(0.0, 0.2), &self.state.places, count, self.highest_wave())?,
            false => Vec::new(),
        };
        if let Some(border) = &self.border
            && self.are_few_violated()
        {
            border.calm(self.iterations, &self.state.places, &mut drift);
        }
        let mut next = std::mem::take(&mut self.next);
        next.fit(&self.state);
        let mut neighbours = self.neighbours(&job.part(0.2, 0.4))?;
        let mut seen = self.go(&drift).advance(&job.part(0.4, 0.6), &neighbours, &self.state, &mut next)?;
        if seen.is_unsound {
            neighbours = Neighbours::Stars(self.triangulate(&job.part(0.6, 0.65))?);
            seen = self.go(&drift).advance(&job.part(0.65, 0.7), &neighbours, &self.state, &mut next)?;
        }
        self.keep(next, matches!(neighbours, Neighbours::Mesh(_)).then_some(seen.violated));
        self.iterations += 1;
        let places = &self.state.places;
        self.motion.after_step(&self.torus.frame, || places[..count].iter().map(|&place| self.torus.position(place)));
        match neighbours {
            Neighbours::Mesh(mut mesh) => {
                self.mesh = mesh.mend(&job.part(0.7, 1.0), places, seen.suspects)?.then_some(mesh);
            }
            Neighbours::Cells(mut cells) => {
                let reach = self.constraints().conflict_radius;
                self.cells = cells.still_serve(seen.longest_way_squared.sqrt(), reach).then_some(cells);
            }
            Neighbours::Stars(_) => {}
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
        let is_met = self.neighbourhood == Neighbourhood::Nearest || self.violated == 0;
        is_met && self.motion.has_settled(tolerance)
    }

    fn finish(&mut self, job: &Job) -> Result<()> {
        if self.fewest == usize::MAX {
            return Ok(());
        }
        let places = &self.state.places;
        // A step that was cancelled has lost the mesh.
        let mesh = match self.mesh.take() {
            Some(mut mesh) => mesh.repair(&job.part(0.0, 0.5), places)?.then_some(mesh),
            None => Mesh::new(&job.part(0.0, 0.5), &self.torus, places)?,
        };
        let Some(mesh) = mesh else { return Ok(()) };
        if mesh.violated(&job.part(0.5, 1.0), places, self.order.len())? <= self.fewest {
            self.mesh = Some(mesh);
        } else {
            self.state = std::mem::take(&mut self.best);
            self.fewest = usize::MAX;
        }
        Ok(())
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
            Some(mesh) => Some(mesh),
            None => Mesh::new(&job.part(0.0, 0.5), &self.torus, places)?,
        };
        let radius = match mesh {
            Some(mesh) => mesh.coverage(&job.part(0.5, 1.0), places)?,
            None => self.triangulate(&job.part(0.5, 1.0))?.coverage(),
        };
        Ok(radius * self.torus.frame.spacing())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::points::{Boundary, Domain};
    use crate::rng::{Draw, Rng};

    /// With more steps a set gets no worse, though kicks make the last state worse than one before.
    #[test]
    fn the_best_state_is_returned() {
        let context = Context::new(1).unwrap();
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            let domain = Domain { min: [0.0; 2], max: [1.0; 2], boundary };
            let mut rng = Rng::at(7, Draw::Probe, &[]);
            let points: Vec<_> = (0..1500).map(|_| [rng.unit(), rng.unit()].map(|x| x as f32)).collect();
            let (mut before, mut kicked_back) = (usize::MAX, 0);
            for steps in [0, 1, 2, 5, 30, 38, 39, 40, 41, 42, 43, 44, 45, 48, 100] {
                context
                    .run(None, |job| {
                        let mut set = Spread::new(&Options::new(domain, Neighbourhood::Delaunay), &points);
                        (0..steps).try_for_each(|_| set.step(job))?;
                        let violated = |set: &Spread| {
                            let places = &set.state.places;
                            Mesh::new(job, &set.torus, places)?.unwrap().violated(job, places, points.len())
                        };
                        let last = violated(&set)?;
                        set.finish(job)?;
                        let best = violated(&set)?;
                        assert!(best <= last && best <= before, "{boundary:?}, {steps}: {best}, {last}, {before}");
                        kicked_back += usize::from(best < last);
                        before = best;
                        Ok(())
                    })
                    .unwrap();
            }
            assert!(kicked_back > 0 && before == 0, "{boundary:?}: {before}");
        }
    }
}
