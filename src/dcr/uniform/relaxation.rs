//! A set that is being relaxed by the momentum method at a constant density.

use std::ops::Range;

use glam::Vec2;

use crate::dcr::ground::boundary::MirrorBoundary;
use crate::dcr::ground::constraints::Constraints;
use crate::dcr::ground::curve::CurveOrder;
use crate::dcr::ground::level::{HEAPED, leveled};
use crate::dcr::ground::neighbours::Neighbours;
use crate::dcr::ground::torus::{Torus, TorusPoint};
use crate::dcr::ground::waves::{LONG_WAVES, WaveGrid};
use crate::dcr::options::Neighbourhood;
use crate::dcr::relax::PlaneRelaxation;
use crate::dcr::relaxation::Relaxation;
use crate::dcr::uniform::cells::VerletCells;
use crate::dcr::uniform::flip_mesh::FlipMesh;
use crate::dcr::uniform::gather::{Kick, NeighbourSearch, State, Step};
use crate::error::Result;
use crate::geometry::Delaunay;
use crate::job::Job;
use crate::points::Domain;
use crate::simd::Level;

/// The number of steps from one removal of waves to the next.
pub(super) const WAVES_EVERY: u32 = 5;

/// Waves are removed up to this frequency, in units of sqrt(density), until the points have spread. That includes finer
/// waves than low frequencies: it fills holes that the constraints do not see, with nearest neighbours in all steps.
const FINE_WAVES: f64 = 0.55;

/// The steps during which that falls to [`LONG_WAVES`]: in the end fine waves are due to the constraints, which
/// removing them would disturb.
const COARSENING: Range<u32> = 60..85;

/// The number of steps from one kick to the next, and the step of the last. Points whose constraints are violated are
/// kicked: where points block each other for good, this moves one of them out.
pub(super) const KICK_EVERY: u32 = 8;
pub(super) const LAST_KICK: u32 = 56;

/// The first kick that frees jammed points, after which the mesh is made anew. Until then most get free by themselves.
pub(super) const FIRST_FREE: u32 = 24;

/// The fraction of the points above which violations are not exceptions: only jammed points are kicked, and waves act at
/// the boundary too.
const FEW: f64 = 0.04;

/// The points, their velocities, and the search for their neighbours.
pub(in crate::dcr) struct UniformRelaxation {
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
    /// The mesh of the points, once there is one.
    mesh: Option<FlipMesh>,
    /// The cells of the points, while they are valid.
    cells: Option<VerletCells>,
}

impl UniformRelaxation {
    /// The points before the first step.
    pub(in crate::dcr) fn new(domain: Domain, neighbourhood: Neighbourhood, seed: u64, points: &[[f32; 2]]) -> Self {
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
            let mut cells = self.cells.take().unwrap_or_else(|| VerletCells::new(&self.torus, places, reach));
            cells.update(job, places)?;
            return Ok(NeighbourSearch::Nearest(cells));
        }
        let mesh = match self.mesh.take() {
            Some(mesh) => Some(mesh),
            None => FlipMesh::new(&job.part(0.0, 0.5), &self.torus, places)?,
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

    /// Takes the next state, and keeps the one before if no other had fewer violated constraints.
    fn keep(&mut self, next: State, violated: Option<usize>) {
        self.next = std::mem::replace(&mut self.state, next);
        self.violated = violated.unwrap_or(usize::MAX);
        if self.violated <= self.fewest {
            std::mem::swap(&mut self.least_violated, &mut self.next);
            self.fewest = self.violated;
        }
    }

    /// Whether the set has spread, with few exceptions.
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

/// The frequency up to which waves are removed after so many steps.
pub(super) fn highest_wave(iterations: u32) -> f64 {
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
        if let Some(leveled) = leveled(job, &self.torus, &self.waves, &self.state.places, &HEAPED, self.seed)? {
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
        let mut found =
            self.parameters(iteration, &drift).advance(&job.part(0.4, 0.6), &neighbours, &self.state, &mut next)?;
        if found.is_unsound {
            neighbours = NeighbourSearch::Delaunay(Neighbours::Built(self.triangulate(&job.part(0.6, 0.65))?));
            found = self.parameters(iteration, &drift).advance(
                &job.part(0.65, 0.7),
                &neighbours,
                &self.state,
                &mut next,
            )?;
        }
        self.keep(next, matches!(neighbours, NeighbourSearch::Delaunay(Neighbours::Kept(_))).then_some(found.violated));
        let places = &self.state.places;
        match neighbours {
            NeighbourSearch::Delaunay(Neighbours::Kept(mut mesh)) => {
                let is_mended = !found.is_torn && mesh.mend(&job.part(0.7, 1.0), places, found.suspects)?;
                self.mesh = is_mended.then_some(mesh);
            }
            NeighbourSearch::Nearest(mut cells) => {
                let reach = self.constraints(iteration + 1).conflict_radius;
                self.cells = cells.still_serve(found.longest_squared.sqrt(), reach).then_some(cells);
            }
            NeighbourSearch::Delaunay(Neighbours::Built(_)) => {}
        }
        Ok(())
    }

    fn has_converged(&self, is_at_rest: bool) -> bool {
        is_at_rest && (self.neighbourhood == Neighbourhood::Nearest || self.violated == 0)
    }

    fn finish(&mut self, job: &Job, iterations: u32) -> Result<()> {
        if iterations == 0 {
            self.state.places = self.torus.with_images(self.order.start());
            self.mesh = None;
        }
        if self.fewest == usize::MAX {
            return Ok(());
        }
        let places = &self.state.places;
        // A step that was cancelled has lost the mesh.
        let mesh = match self.mesh.take() {
            Some(mut mesh) => mesh.repair(&job.part(0.0, 0.5), places)?.then_some(mesh),
            None => FlipMesh::new(&job.part(0.0, 0.5), &self.torus, places)?,
        };
        let Some(mesh) = mesh else { return Ok(()) };
        if mesh.violated(&job.part(0.5, 1.0), places, self.order.len())? <= self.fewest {
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

    fn coverage(&mut self, job: &Job) -> Result<f64> {
        let places = &self.state.places;
        let mesh = match self.mesh.take() {
            Some(mesh) => Some(mesh),
            None => FlipMesh::new(&job.part(0.0, 0.5), &self.torus, places)?,
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
    use crate::points::Boundary;
    use crate::rng::{Draw, Rng};

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
                        (0..steps).try_for_each(|iteration| set.step(job, iteration))?;
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
