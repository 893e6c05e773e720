//! A set in the making: places on the surface, how fast they move, and who is near whom.

use glam::{DVec2, DVec3};

use crate::dcr::ground::constraints::{Constraints, Force, STIFFENING};
use crate::dcr::ground::motion::{Motion, Space};
use crate::dcr::surface::apart::{Contacts, Floor, Limits};
use crate::dcr::surface::near::{Crowd, Neighbour, Neighbourhood};
use crate::dcr::surface::sheet::Sheet;
use crate::dcr::surface::view::View;
use crate::dcr::surface::walk::{Flat, Place, walk};
use crate::dcr::uniform::gather::ROOM;
use crate::dcr::uniform::{MOMENTUM, STEP};
use crate::error::Result;
use crate::job::{Chunks, Job, chunks_of};
use crate::mesh::Mesh;

/// How far samples may go in a step, in spacings, ...
const STRIDE: f32 = 0.4;
/// ... and by which factor that falls from step to step when constraints no longer grow stiffer. Where the surface is bent
/// more than the samples are dense, what two of them do to each other is not opposite, and they would never come to rest.
const CALMING: f32 = 0.9;

/// How far samples get in a step at most, in spacings: the stride, and what rounding adds.
const FARTHEST: f64 = 0.41;

/// Neighbours are looked for up to this distance, in spacings ...
const REACH: f64 = 1.7;
/// ... and as much farther, so that they need not be looked for until two samples have together moved by it.
const SLACK: f64 = 0.3;

/// The samples of one task: few, as each has much to do.
const CHUNK: usize = 512;

/// Samples on a surface, moving.
pub(super) struct Set<'a> {
    sheet: &'a Sheet<'a>,
    spacing: f64,
    floor: Floor,
    places: Vec<Place>,
    /// Where they are in space, in the floats in which they will be returned.
    positions: Vec<DVec3>,
    /// How fast they move, in the planes of their triangles and in spacings.
    velocities: Vec<DVec2>,
    neighbourhoods: Vec<Neighbourhood>,
    /// How far each has moved since its neighbours were looked for, in spacings.
    travelled: Vec<f64>,
    motion: Motion<DVec3>,
    iterations: u32,
}

/// Where a sample gets.
#[derive(Clone, Copy, Default)]
struct Moved {
    place: Place,
    position: DVec3,
    velocity: DVec2,
    length: f64,
}

impl<'a> Set<'a> {
    /// Samples no two of which are nearer to each other than the floor, and will be.
    pub(super) fn new(sheet: &'a Sheet<'a>, spacing: f64, floor: f64, places: Vec<Place>) -> Self {
        let positions: Vec<DVec3> = places.iter().map(|place| place.position(sheet.mesh)).collect();
        Self {
            sheet,
            spacing,
            floor: Floor::new(floor),
            velocities: vec![DVec2::ZERO; places.len()],
            motion: Motion::new(STEP, positions.clone()),
            positions,
            neighbourhoods: vec![Neighbourhood::default(); places.len()],
            travelled: vec![f64::INFINITY; places.len()],
            places,
            iterations: 0,
        }
    }

    pub(super) fn iterations(&self) -> u32 {
        self.iterations
    }

    /// Half of how far samples got in the last span of steps, in spacings.
    pub(super) fn motion(&self) -> f64 {
        self.motion.last(&Unit(self.spacing), self.positions.iter().copied())
    }

    /// Whether there was a whole span, and no more motion in the last than this.
    pub(super) fn has_settled(&self, tolerance: f64) -> bool {
        self.motion.has_settled(tolerance)
    }

    pub(super) fn mesh(&self) -> &'a Mesh {
        self.sheet.mesh
    }

    pub(super) fn places(&self) -> &[Place] {
        &self.places
    }

    pub(super) fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Moves all samples. If it is cancelled, all have moved or none.
    pub(super) fn step(&mut self, job: &Job) -> Result<()> {
        let chunks = chunks_of(self.places.len(), CHUNK);
        self.look_around(&job.part(0.0, 0.5), chunks)?;
        let wanted = self.gather(&job.part(0.5, 0.9), chunks)?;
        self.go(&job.part(0.9, 1.0), chunks, &wanted)?;
        self.iterations += 1;
        self.motion.after_step(&Unit(self.spacing), || self.positions.iter().copied());
        Ok(())
    }

    /// Moves samples to these places beside theirs, where that is admitted. This is no step.
    pub(super) fn shift(&mut self, job: &Job, places: &[Place]) -> Result<()> {
        let chunks = chunks_of(places.len(), CHUNK);
        self.look_around(&job.part(0.0, 0.9), chunks)?;
        let all = places.iter().zip(&self.positions);
        let wanted: Vec<Moved> = all.map(|(&place, &from)| self.arrived(place, from, DVec2::ZERO)).collect();
        self.go(&job.part(0.9, 1.0), chunks, &wanted)
    }

    /// Makes those moves that are admitted.
    fn go(&mut self, job: &Job, chunks: Chunks, wanted: &[Moved]) -> Result<()> {
        let moved = job.concat(chunks.len(), |chunk| {
            let made = chunks.range(chunk).map(|sample| match self.admits(sample, wanted) {
                true => wanted[sample],
                false => Moved { place: self.places[sample], position: self.positions[sample], ..Moved::default() },
            });
            made.collect()
        })?;
        self.travelled.iter_mut().zip(&moved).for_each(|(travelled, moved)| *travelled += moved.length);
        self.places = moved.iter().map(|moved| moved.place).collect();
        self.positions = moved.iter().map(|moved| moved.position).collect();
        self.velocities = moved.iter().map(|moved| moved.velocity).collect();
        Ok(())
    }

    /// Whether a sample gets nowhere too near to where another is, nor to where another wants to get.
    fn admits(&self, sample: usize, wanted: &[Moved]) -> bool {
        let to = wanted[sample].position;
        let admits = |&other: &u32| {
            let other = other as usize;
            self.floor.admits(to, self.positions[other]) && self.floor.admits(to, wanted[other].position)
        };
        wanted[sample].length <= FARTHEST && self.neighbourhoods[sample].in_sight.iter().all(admits)
    }

    /// Looks for the neighbours of those that have moved by half of the slack, and of those near them then that do not know
    /// of them. So two samples that do not know of each other have moved towards each other by no more than the slack, and
    /// after the next step those out of sight are no nearer than the floor.
    fn look_around(&mut self, job: &Job, chunks: Chunks) -> Result<()> {
        let has_moved: Vec<bool> = self.travelled.iter().map(|&way| way >= SLACK / 2.0).collect();
        if !has_moved.contains(&true) {
            return Ok(());
        }
        let radius = (REACH + SLACK) * self.spacing;
        let sight = self.floor.distance() + (SLACK + 2.0 * FARTHEST) * self.spacing;
        let crowd = Crowd::new(self.sheet, &self.places, &self.positions, radius, sight);
        let found = crowd.neighbourhoods(&job.part(0.0, 0.7), chunks, |sample| has_moved[sample])?;
        let mut is_met = vec![false; self.places.len()];
        for (mover, around) in &found {
            let mover = *mover as u32;
            for neighbour in around.neighbours.iter().filter(|neighbour| !has_moved[neighbour.sample as usize]) {
                // Images are mutual too.
                let mover = Neighbour { sample: mover, mirror: neighbour.mirror };
                is_met[neighbour.sample as usize] |= !self.neighbourhoods[neighbour.sample as usize].knows(mover);
            }
            for &other in around.in_sight.iter().filter(|&&other| !has_moved[other as usize]) {
                is_met[other as usize] |= !self.neighbourhoods[other as usize].sees(mover);
            }
        }
        let met = crowd.neighbourhoods(&job.part(0.7, 1.0), chunks, |sample| is_met[sample])?;
        found.iter().for_each(|&(sample, _)| self.travelled[sample] = 0.0);
        for (sample, around) in found.into_iter().chain(met) {
            self.neighbourhoods[sample] = around;
        }
        Ok(())
    }

    /// Where every sample wants to get, and how fast.
    fn gather(&self, job: &Job, chunks: Chunks) -> Result<Vec<Moved>> {
        let constraints = Constraints::of_step(self.iterations);
        let limits = Limits::of_step(self.iterations, self.floor, self.spacing);
        job.concat(chunks.len(), |chunk| {
            let (mut view, mut contacts) = (View::default(), Contacts::default());
            let moved = |sample| self.moved(&constraints, limits, sample, &mut view, &mut contacts);
            chunks.range(chunk).map(moved).collect()
        })
    }

    fn moved(
        &self,
        constraints: &Constraints,
        limits: Limits,
        sample: usize,
        view: &mut View,
        contacts: &mut Contacts,
    ) -> Moved {
        let (place, from) = (self.places[sample], self.positions[sample]);
        let flat = Flat::new(self.sheet, place.triangle, self.spacing);
        view.look(self.sheet, &flat, from, &self.neighbourhoods[sample], &self.positions);
        let Force { sum, room } = view.force(constraints);
        let velocity = MOMENTUM * self.velocities[sample].as_vec2() + sum;
        let way = velocity.clamp_length_max((ROOM * room).min(self.stride())).as_dvec2();
        self.touch(limits, sample, &flat, way, contacts);
        let way = contacts.hold_off(way).clamp_length_max(self.stride().into());
        let end = walk(self.sheet, self.spacing, place, way);
        self.arrived(end.place, from, end.way)
    }

    /// Finds those that a sample must keep off if it goes this way.
    fn touch(&self, limits: Limits, sample: usize, flat: &Flat, way: DVec2, contacts: &mut Contacts) {
        contacts.clear();
        let around = &self.neighbourhoods[sample];
        let reach = limits.near + 2.0 * way.length() * self.spacing;
        for &other in &around.in_sight {
            let offset = self.positions[other as usize] - self.positions[sample];
            if offset.length_squared() < reach * reach {
                let is_near = around.knows(Neighbour { sample: other, mirror: None });
                contacts.add(flat, offset, if is_near { limits.near } else { limits.far });
            }
        }
    }

    /// Who has come from somewhere to a place.
    fn arrived(&self, place: Place, from: DVec3, velocity: DVec2) -> Moved {
        let position = place.position(self.sheet.mesh);
        Moved { place, position, velocity, length: from.distance(position) / self.spacing }
    }

    /// How far samples may go in this step, in spacings.
    fn stride(&self) -> f32 {
        STRIDE * CALMING.powi(self.iterations.saturating_sub(STIFFENING) as i32)
    }
}

/// Space, with this as the unit of length.
struct Unit(f64);

impl Space<DVec3> for Unit {
    fn distance_squared(&self, from: DVec3, to: DVec3) -> f64 {
        from.distance_squared(to) / (self.0 * self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::rng::{Draw, Rng};

    /// What nobody sees cannot get too near in the step to come.
    #[test]
    fn all_are_in_sight_that_could_get_too_near_in_a_step() {
        // A fold: two sides of little more than a spacing between them at the back.
        let positions =
            vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.1], [1.0, 1.0, 0.1], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
        let mesh = Mesh::new(positions, vec![[0, 1, 3], [0, 3, 2], [1, 0, 4], [1, 4, 5]]).unwrap();
        let sheet = Sheet::new(&mesh).unwrap();
        let spacing = 0.08;
        let mut rng = Rng::at(6, Draw::Probe, &[]);
        let mut place = || {
            let [u, v] = [rng.unit(), rng.unit()];
            let uv = if u + v <= 1.0 { DVec2::new(u, v) } else { DVec2::new(1.0 - u, 1.0 - v) };
            Place { triangle: rng.below(4) as u32, uv }
        };
        let places: Vec<Place> = (0..350).map(|_| place()).collect();
        let positions: Vec<DVec3> = places.iter().map(|place| place.position(&mesh)).collect();
        let pairs = || (0..places.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let floor = pairs().map(|(i, j)| positions[i].distance(positions[j])).fold(f64::INFINITY, f64::min);
        let mut set = Set::new(&sheet, spacing, floor, places.clone());
        let context = Context::new(1).unwrap();
        let (mut sights, mut unknown) = (0, 0);
        for _ in 0..30 {
            let chunks = chunks_of(places.len(), CHUNK);
            context.run(None, |job| set.look_around(job, chunks)).unwrap();
            for (i, j) in pairs() {
                if set.positions[i].distance(set.positions[j]) < floor + 2.0 * FARTHEST * spacing {
                    assert!(set.neighbourhoods[i].sees(j as u32) && set.neighbourhoods[j].sees(i as u32));
                    sights += 1;
                    unknown += usize::from(!set.neighbourhoods[i].knows(Neighbour { sample: j as u32, mirror: None }));
                }
            }
            context.run(None, |job| set.step(job)).unwrap();
            assert!(pairs().all(|(i, j)| set.positions[i].distance(set.positions[j]) >= floor));
        }
        assert!(sights > 10_000 && unknown > 1000, "{sights} in sight, {unknown} of them on another sheet");
    }
}
