//! A set of samples under relaxation on a surface.

use glam::{DVec2, DVec3, Vec2};

use crate::dcr::law::{Constraints, STIFFENING};
use crate::dcr::relaxation::{Relaxation, Space};
use crate::dcr::surface::apart::{Floor, Limits};
use crate::dcr::surface::connected::ConnectedMesh;
use crate::dcr::surface::grading::{Grading, grade};
use crate::dcr::surface::lists::Neighbourhoods;
use crate::dcr::surface::moves::{Mover, Moves, StepState, UncheckedMove};
use crate::dcr::surface::spread::along_curve;
use crate::dcr::surface::walk::SurfacePoint;
use crate::error::Result;
use crate::job::Job;
use crate::math::power;
use crate::mesh::exact;
use crate::rng::{Draw, Rng};
use crate::simd::{self, Level, Position};

/// The distance, in spacings, by which samples that coincide with others or lie on an edge of their triangle are moved.
const PARTING: f64 = 1e-3;

/// The number of attempts for samples that would get too close to others.
const ATTEMPTS: u64 = 16;

/// The largest displacement of samples in a step, in spacings.
const STRIDE: f32 = 0.4;

/// The factor of the largest displacement from step to step when constraints no longer grow stiffer. Where the
/// curvature is high for the density of the samples, the forces of two of them on each other are not opposite, and they
/// would never come to rest.
const STRIDE_DECAY: f64 = 0.9;

/// The largest distance by which positions change in a step, in spacings: the stride, and rounding.
pub const FARTHEST: f32 = 0.41;

/// The number of steps after which samples come to rest where no force acts on them.
const FIRST_REST: u32 = 16;

/// The number of steps made divided by this is that for which samples rest, as motion dies down, but it is at most
/// `LONGEST_REST`.
const REST_SHARE: u32 = 4;
const LONGEST_REST: u32 = 12;

/// The number of samples of one task: few, as each takes long.
const CHUNK: usize = 512;

/// Moving samples on a surface. They are in the order of a curve; the user's order is that of `order`.
pub struct SurfaceRelaxation<'a, G> {
    connected: &'a ConnectedMesh<'a>,
    grading: &'a G,
    level: Level,
    /// The mean spacing.
    spacing: f64,
    floor: Floor,
    /// The user's number of each sample.
    order: Vec<u32>,
    movers: Vec<Mover>,
    /// The positions in space, in the floats in which they will be returned, and grades.
    positions: Vec<Position>,
    /// The positions after the step, while it is made.
    wanted: Vec<Position>,
    near: Neighbourhoods<'a, G>,
    seed: u64,
}

impl<'a, G: Grading> SurfaceRelaxation<'a, G> {
    /// A set of samples no two of which are closer than the floor, now and after each step.
    pub fn new(
        job: &Job,
        connected: &'a ConnectedMesh<'a>,
        grading: &'a G,
        spacing: f64,
        floor: Floor,
        places: &[SurfacePoint],
        seed: u64,
    ) -> Result<Self> {
        let order: Vec<u32> = along_curve(connected.mesh, places).into_iter().map(|(_, i)| i).collect();
        let movers: Vec<Mover> =
            order.iter().map(|&i| Mover { place: places[i as usize], ..Mover::default() }).collect();
        let positions: Vec<Position> =
            movers.iter().map(|mover| grading.position(connected.mesh, mover.place)).collect();
        Ok(Self {
            connected,
            grading,
            level: Level::widest(),
            spacing,
            floor,
            near: Neighbourhoods::new(
                job,
                connected,
                grading,
                spacing,
                floor.distance() / spacing,
                &movers,
                &positions,
            )?,
            wanted: positions.clone(),
            positions,
            movers,
            order,
            seed,
        })
    }

    /// The samples, in the user's order.
    pub fn places(&self) -> Vec<SurfacePoint> {
        let mut places = vec![SurfacePoint::default(); self.order.len()];
        self.order.iter().zip(&self.movers).for_each(|(&i, mover)| places[i as usize] = mover.place);
        places
    }

    /// The points of the set, with those moved that coincide with another or lie on an edge: a sample on the boundary
    /// would coincide with its mirror image. They move a little towards a random point of their triangle. None if no
    /// sample must be moved.
    fn parted(&self, attempt: u64) -> Option<Vec<SurfacePoint>> {
        let (mesh, mut places) = (self.connected.mesh, self.places());
        let positions: Vec<_> = places.iter().map(|place| place.position(mesh)).collect();
        let mut order: Vec<u32> = (0..places.len() as u32).collect();
        let bits = |i: u32| positions[i as usize].to_array().map(f64::to_bits);
        order.sort_unstable_by_key(|&i| (bits(i), i));
        let repeated = order.windows(2).filter(|pair| bits(pair[0]) == bits(pair[1])).map(|pair| pair[1]);
        let on_edges = (0..places.len() as u32).filter(|&i| {
            let uv = places[i as usize].uv;
            uv.min_element() == 0.0 || uv.element_sum() == 1.0
        });
        let mut parted: Vec<u32> = repeated.chain(on_edges).collect();
        parted.sort_unstable();
        parted.dedup();
        for &i in &parted {
            let place = &mut places[i as usize];
            let mut rng = Rng::at(self.seed, Draw::Part, &[i.into(), attempt]);
            let (along, across) = (rng.unit().sqrt(), rng.unit());
            let aim = DVec2::new(along * (1.0 - across), along * across);
            let at = |uv: DVec2| mesh.point_exact(place.triangle, uv.into());
            let distance = at(place.uv).distance(at(aim));
            let spacing = self.spacing * f64::from(grade::<G>(self.grading.position(mesh, *place)));
            place.uv = place.uv.lerp(aim, (PARTING * spacing / distance).min(1.0));
        }
        (!parted.is_empty()).then_some(places)
    }

    /// Moves samples to these points close to theirs, where that is admissible. This does not count as a step.
    fn shift(&mut self, job: &Job, places: &[SurfacePoint]) -> Result<()> {
        self.near.search(job, &mut self.movers, &self.positions)?;
        job.context().run(None, |whole| {
            let mut unchecked = Vec::new();
            for (sample, (&i, mover)) in (0..).zip(self.order.iter().zip(&mut self.movers)) {
                unchecked.push(UncheckedMove { sample, place: mover.place, left: None });
                *mover = Mover { place: places[i as usize], ..Mover::default() };
                self.wanted[sample as usize] = self.grading.position(self.connected.mesh, mover.place);
            }
            self.settle(whole, unchecked)
        })
    }

    /// Moves samples as forces ask for. Returns those that may end too close to others.
    fn gather(&mut self, job: &Job, iteration: u32) -> Result<Vec<UncheckedMove>> {
        let floor = (self.floor.distance() / self.spacing) as f32;
        let (lists, locals) = self.near.lists_and_locals();
        let state = StepState {
            connected: self.connected,
            grading: self.grading,
            positions: &self.positions,
            lists,
            spacing: self.spacing,
            unit: (1.0 / self.spacing) as f32,
            floor,
            constraints: Constraints::of_step(iteration),
            limits: Limits::of_step(iteration, floor),
            stride: STRIDE * power(STRIDE_DECAY, iteration.saturating_sub(STIFFENING)) as f32,
            rest: rest(iteration),
        };
        let movers = self.movers.chunks_mut(CHUNK).zip(locals.chunks_mut(CHUNK));
        let moves = (0..).zip(movers.zip(self.wanted.chunks_mut(CHUNK)));
        let moves = moves.map(|(chunk, ((movers, locals), wanted))| Moves {
            state: &state,
            first: chunk * CHUNK,
            movers,
            locals,
            wanted,
        });
        let (level, rests) = (self.level, state.rest > 0);
        let after = job.map_each(moves.collect(), |moves| simd::run(level, moves))?;
        let mut unchecked = Vec::new();
        for part in after {
            unchecked.extend(part.unchecked);
            for sample in part.stirring.into_iter().filter(|_| rests) {
                self.near.in_sight(sample).for_each(|other| self.movers[other as usize].rest = 0);
            }
        }
        Ok(unchecked)
    }

    /// Undoes those of the unchecked moves that are not admissible; all others are made.
    fn settle(&mut self, job: &Job, unchecked: Vec<UncheckedMove>) -> Result<()> {
        let parts = unchecked.chunks(CHUNK).collect();
        let refused = job.map_each(parts, |part: &[UncheckedMove]| -> Vec<bool> {
            part.iter().map(|doubt| !self.admits(doubt.sample)).collect()
        })?;
        for (doubt, is_refused) in unchecked.into_iter().zip(refused.into_iter().flatten()) {
            if is_refused {
                let sample = doubt.sample as usize;
                self.movers[sample].place = doubt.place;
                self.movers[sample].velocity = Vec2::ZERO;
                if let Some(left) = doubt.left {
                    self.near.put_back(doubt.sample, *left);
                }
                self.wanted[sample] = self.positions[sample];
            }
        }
        std::mem::swap(&mut self.positions, &mut self.wanted);
        self.near.follow(job, &self.positions)
    }

    /// True if the move of a sample ends too close neither to another sample nor to the end of another's move.
    fn admits(&self, sample: u32) -> bool {
        let (from, to) = (self.positions[sample as usize], self.wanted[sample as usize]);
        let own = grade::<G>(to);
        let admits = |other: Position| {
            let mean = 0.5 * (f64::from(own) + f64::from(grade::<G>(other)));
            self.floor.admits(place(to), place(other), mean)
        };
        let admits = |other: u32| admits(self.positions[other as usize]) && admits(self.wanted[other as usize]);
        own > 0.0
            && place(from).distance(place(to)) <= self.near.farthest(sample) * self.spacing
            && self.near.in_sight(sample).all(admits)
    }
}

impl<G: Grading> Relaxation for SurfaceRelaxation<'_, G> {
    type Position = Position;
    type Space = Unit;

    fn space(&self) -> Unit {
        Unit(self.spacing)
    }

    fn positions(&self) -> impl ExactSizeIterator<Item = Position> {
        self.positions.iter().copied()
    }

    fn step(&mut self, job: &Job, iteration: u32) -> Result<()> {
        if iteration == 0 {
            for attempt in 0..ATTEMPTS {
                let Some(places) = self.parted(attempt) else { break };
                self.shift(&job.part(0.0, 0.0), &places)?;
            }
        }
        self.near.search(&job.part(0.0, 0.5), &mut self.movers, &self.positions)?;
        job.context().run(None, |whole| {
            let unchecked = self.gather(whole, iteration)?;
            self.grading.check()?;
            self.settle(whole, unchecked)
        })
    }
}

/// The number of steps for which samples that come to rest in this step stay at rest.
fn rest(iterations: u32) -> u8 {
    if iterations < FIRST_REST { 0 } else { (iterations / REST_SHARE).min(LONGEST_REST) as u8 }
}

/// A position in `f64`.
fn place([x, y, z, _]: Position) -> DVec3 {
    exact([x, y, z])
}

/// Space, with this as the unit of length.
pub struct Unit(f64);

impl Space<Position> for Unit {
    fn distance_squared(&self, from: Position, to: Position) -> f64 {
        place(from).distance_squared(place(to)) / (self.0 * self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::dcr::surface::grading::Even;
    use crate::job::Context;
    use crate::mesh::Mesh;

    /// The smallest distance of two points.
    fn smallest(mesh: &Mesh, places: &[SurfacePoint]) -> f64 {
        let positions: Vec<DVec3> = places.iter().map(|place| place.position(mesh)).collect();
        let pairs = (0..places.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        pairs.map(|(i, j)| positions[i].distance(positions[j])).fold(f64::INFINITY, f64::min)
    }

    /// Samples out of sight cannot get too close in the next step.
    #[test]
    fn all_are_in_sight_that_could_get_too_close_in_a_step() {
        // A fold: two sides of little more than a spacing between them at the back.
        let positions =
            vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.1], [1.0, 1.0, 0.1], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
        let mesh = Mesh::new(positions, vec![[0, 1, 3], [0, 3, 2], [1, 0, 4], [1, 4, 5]]).unwrap();
        let connected = ConnectedMesh::new(&mesh).unwrap();
        let spacing = 0.08;
        let mut rng = Rng::at(6, Draw::Probe, &[]);
        let mut random_place = || {
            let [u, v] = [rng.unit(), rng.unit()];
            let uv = if u + v <= 1.0 { DVec2::new(u, v) } else { DVec2::new(1.0 - u, 1.0 - v) };
            SurfacePoint { triangle: rng.below(4) as u32, uv }
        };
        let places: Vec<SurfacePoint> = (0..350).map(|_| random_place()).collect();
        let pairs = || (0..places.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let floor = smallest(&mesh, &places);
        let context = Context::new(1).unwrap();
        let new = |job: &Job| SurfaceRelaxation::new(job, &connected, &Even, spacing, Floor::new(floor), &places, 0);
        let mut set = context.run(None, new).unwrap();
        let (mut sights, mut unknown) = (0, 0);
        for iteration in 0..30 {
            context.run(None, |job| set.near.search(job, &mut set.movers, &set.positions)).unwrap();
            for (i, j) in pairs() {
                let distance = place(set.positions[i]).distance(place(set.positions[j]));
                if distance < floor + 2.0 * set.near.farthest(0) * spacing {
                    let sees = |i: usize, j: usize| set.near.in_sight(i as u32).any(|other| other == j as u32);
                    assert!(sees(i, j) && sees(j, i));
                    sights += 1;
                    unknown += usize::from(set.near.others(i as u32).contains(&(j as u32)));
                }
            }
            context.run(None, |job| set.step(job, iteration)).unwrap();
            assert!(pairs().all(|(i, j)| place(set.positions[i]).distance(place(set.positions[j])) >= floor));
            assert_eq!(set.places().iter().map(|at| at.position(&mesh)).collect::<Vec<_>>(), {
                let mut positions = vec![DVec3::ZERO; places.len()];
                set.order.iter().zip(&set.positions).for_each(|(&i, &at)| positions[i as usize] = place(at));
                positions
            });
        }
        assert!(sights > 10_000 && unknown > 1000, "{sights} in sight, {unknown} of them on another side");
    }

    /// Most samples come to rest; no other one is closer to them than the conflict radius, except for its possible
    /// motion since they were last processed.
    #[test]
    fn samples_that_rest_are_in_no_conflict() {
        let mesh = Mesh::new(vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]).unwrap();
        let connected = ConnectedMesh::new(&mesh).unwrap();
        let mut rng = Rng::at(14, Draw::Probe, &[]);
        let places: Vec<SurfacePoint> =
            (0..600).map(|_| SurfacePoint { triangle: 0, uv: rng.in_triangle().into() }).collect();
        let (floor, spacing) = (Floor::new(smallest(&mesh, &places)), (mesh.area() / 519.6).sqrt());
        let context = Context::new(1).unwrap();
        let new = |job: &Job| SurfaceRelaxation::new(job, &connected, &Even, spacing, floor, &places, 0);
        let mut set = context.run(None, new).unwrap();
        let mut resting = 0;
        for step in 0..80 {
            let before = set.positions.clone();
            let rests: Vec<bool> = set.movers.iter().map(|mover| mover.rest > 0).collect();
            assert!(step >= FIRST_REST || !rests.contains(&true));
            context.run(None, |job| set.step(job, step)).unwrap();
            for (i, _) in rests.iter().enumerate().filter(|(i, rests)| **rests && set.movers[*i].rest > 0) {
                resting += 1;
                assert_eq!(set.positions[i], before[i]);
                let others = (0..places.len()).filter(|&other| other != i);
                let distance = |other: usize| place(set.positions[i]).distance(place(set.positions[other])) / spacing;
                let nearest = others.map(distance).fold(f64::INFINITY, f64::min);
                assert!(nearest > 0.83, "{nearest} in step {step}");
            }
        }
        assert!(resting > 5000, "{resting}");
    }

    #[test]
    fn all_levels_make_the_same_steps() {
        let positions = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.2], [0.0, 1.0, 0.1], [1.0, 1.0, 0.0]];
        let mesh = Mesh::new(positions, vec![[0, 1, 3], [0, 3, 2]]).unwrap();
        let connected = ConnectedMesh::new(&mesh).unwrap();
        let mut rng = Rng::at(13, Draw::Probe, &[]);
        let mut place = || {
            let uv = DVec2::new(rng.unit(), rng.unit()) / 2.0;
            SurfacePoint { triangle: rng.below(2) as u32, uv }
        };
        let places: Vec<SurfacePoint> = (0..500).map(|_| place()).collect();
        let floor = Floor::new(smallest(&mesh, &places));
        let relaxed = Level::available().into_iter().map(|level| {
            let context = Context::new(1).unwrap();
            let steps = context.run(None, |job| {
                let mut set = SurfaceRelaxation::new(job, &connected, &Even, 0.05, floor, &places, 0)?;
                set.level = level;
                (0..60).try_for_each(|iteration| set.step(job, iteration))?;
                Ok(set.places())
            });
            steps.unwrap()
        });
        let relaxed: Vec<_> = relaxed.collect();
        assert!(relaxed.iter().all(|other| *other == relaxed[0] && *other != places));
    }
}
