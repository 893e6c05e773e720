//! A set of samples that is being relaxed on a surface.

use glam::{DVec2, DVec3};

use crate::dcr::ground::constraints::{Constraints, Force, MOMENTUM, SAFE_FRACTION, STIFFENING};
use crate::dcr::ground::motion::{Motion, STEP, Space};
use crate::dcr::surface::apart::{Contacts, Floor, Limits};
use crate::dcr::surface::connected::ConnectedMesh;
use crate::dcr::surface::near::{NearSample, SampleSearch, Surroundings};
use crate::dcr::surface::view::View;
use crate::dcr::surface::walk::{FlatTriangle, SurfacePoint, walk};
use crate::error::Result;
use crate::job::{Chunks, Job, chunks_of};
use crate::mesh::Mesh;

/// The largest displacement of samples in a step, in spacings.
const STRIDE: f32 = 0.4;

/// The factor of that from step to step when constraints no longer grow stiffer. Where the curvature is high for the
/// density of the samples, the forces of two of them on each other are not opposite, and they would never come to rest.
const CALMING: f32 = 0.9;

/// The largest distance by which positions change in a step, in spacings: the stride, and rounding.
const FARTHEST: f64 = 0.41;

/// The distance up to which neighbours are needed, in spacings.
const REACH: f64 = 1.7;

/// The distance beyond that up to which neighbours are searched, so that they need not be searched again until two
/// samples together have moved by it.
const SLACK: f64 = 0.3;

/// The samples of one task: few, as each takes long.
const CHUNK: usize = 512;

/// Samples on a surface, moving.
pub(super) struct SurfaceRelaxation<'a> {
    connected: &'a ConnectedMesh<'a>,
    spacing: f64,
    floor: Floor,
    places: Vec<SurfacePoint>,
    /// Their positions in space, in the floats in which they will be returned.
    positions: Vec<DVec3>,
    /// In the planes of their triangles and in spacings.
    velocities: Vec<DVec2>,
    surroundings: Vec<Surroundings>,
    /// The distance that each has moved since its neighbours were searched, in spacings.
    travelled: Vec<f64>,
    motion: Motion<DVec3>,
    iterations: u32,
}

/// The state of a sample after a step.
#[derive(Clone, Copy, Default)]
struct Moved {
    place: SurfacePoint,
    position: DVec3,
    velocity: DVec2,
    length: f64,
}

impl<'a> SurfaceRelaxation<'a> {
    /// Samples no two of which are closer to each other than the floor, now and after each step.
    pub(super) fn new(connected: &'a ConnectedMesh<'a>, spacing: f64, floor: f64, places: Vec<SurfacePoint>) -> Self {
        let positions: Vec<DVec3> = places.iter().map(|place| place.position(connected.mesh)).collect();
        Self {
            connected,
            spacing,
            floor: Floor::new(floor),
            velocities: vec![DVec2::ZERO; places.len()],
            motion: Motion::new(STEP, positions.clone()),
            positions,
            surroundings: vec![Surroundings::default(); places.len()],
            travelled: vec![f64::INFINITY; places.len()],
            places,
            iterations: 0,
        }
    }

    pub(super) fn iterations(&self) -> u32 {
        self.iterations
    }

    /// Half of the distance that samples covered in the last span of steps, in spacings.
    pub(super) fn motion(&self) -> f64 {
        self.motion.last(&Unit(self.spacing), self.positions.iter().copied())
    }

    /// Whether a whole span of steps was made, and the motion in the last is at most the tolerance.
    pub(super) fn has_settled(&self, tolerance: f64) -> bool {
        self.motion.has_settled(tolerance)
    }

    pub(super) fn mesh(&self) -> &'a Mesh {
        self.connected.mesh
    }

    pub(super) fn places(&self) -> &[SurfacePoint] {
        &self.places
    }

    pub(super) fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Moves all samples. If it is cancelled, all have moved or none.
    pub(super) fn step(&mut self, job: &Job) -> Result<()> {
        let chunks = chunks_of(self.places.len(), CHUNK);
        self.search(&job.part(0.0, 0.5), chunks)?;
        let wanted = self.gather(&job.part(0.5, 0.9), chunks)?;
        self.move_to(&job.part(0.9, 1.0), chunks, &wanted)?;
        self.iterations += 1;
        self.motion.after_step(&Unit(self.spacing), || self.positions.iter().copied());
        Ok(())
    }

    /// Moves samples to these points close to theirs, where that is admitted. This does not count as a step.
    pub(super) fn shift(&mut self, job: &Job, places: &[SurfacePoint]) -> Result<()> {
        let chunks = chunks_of(places.len(), CHUNK);
        self.search(&job.part(0.0, 0.9), chunks)?;
        let all = places.iter().zip(&self.positions);
        let wanted: Vec<Moved> = all.map(|(&place, &from)| self.arrived(place, from, DVec2::ZERO)).collect();
        self.move_to(&job.part(0.9, 1.0), chunks, &wanted)
    }

    /// Makes the moves that are admitted.
    fn move_to(&mut self, job: &Job, chunks: Chunks, wanted: &[Moved]) -> Result<()> {
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

    /// Whether the move of a sample ends too close neither to another sample nor to the end of another's move.
    fn admits(&self, sample: usize, wanted: &[Moved]) -> bool {
        let to = wanted[sample].position;
        let admits = |&other: &u32| {
            let other = other as usize;
            self.floor.admits(to, self.positions[other]) && self.floor.admits(to, wanted[other].position)
        };
        wanted[sample].length <= FARTHEST && self.surroundings[sample].in_sight.iter().all(admits)
    }

    /// Searches the neighbours of samples that have moved by half of the slack, and of the samples near these that do
    /// not have them as neighbours yet. So two samples that do not have each other have moved towards each other by no
    /// more than the slack, and after the next step samples out of sight are no closer than the floor.
    fn search(&mut self, job: &Job, chunks: Chunks) -> Result<()> {
        let has_moved: Vec<bool> = self.travelled.iter().map(|&distance| distance >= SLACK / 2.0).collect();
        if !has_moved.contains(&true) {
            return Ok(());
        }
        let radius = (REACH + SLACK) * self.spacing;
        let sight = self.floor.distance() + (SLACK + 2.0 * FARTHEST) * self.spacing;
        let search = SampleSearch::new(self.connected, &self.places, &self.positions, radius, sight);
        let found = search.surroundings(&job.part(0.0, 0.7), chunks, |sample| has_moved[sample])?;
        let mut is_met = vec![false; self.places.len()];
        for (mover, around) in &found {
            let mover = *mover as u32;
            for neighbour in around.neighbours.iter().filter(|neighbour| !has_moved[neighbour.sample as usize]) {
                // Images are mutual too.
                let mover = NearSample { sample: mover, mirror: neighbour.mirror };
                is_met[neighbour.sample as usize] |= !self.surroundings[neighbour.sample as usize].knows(mover);
            }
            for &other in around.in_sight.iter().filter(|&&other| !has_moved[other as usize]) {
                is_met[other as usize] |= !self.surroundings[other as usize].sees(mover);
            }
        }
        let met = search.surroundings(&job.part(0.7, 1.0), chunks, |sample| is_met[sample])?;
        found.iter().for_each(|&(sample, _)| self.travelled[sample] = 0.0);
        for (sample, around) in found.into_iter().chain(met) {
            self.surroundings[sample] = around;
        }
        Ok(())
    }

    /// The moves that forces ask for.
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
        let flat = FlatTriangle::new(self.connected, place.triangle, self.spacing);
        view.project(self.connected, &flat, from, &self.surroundings[sample], &self.positions);
        let Force { sum, clearance } = view.force(constraints);
        let velocity = MOMENTUM * self.velocities[sample].as_vec2() + sum;
        let wanted = velocity.clamp_length_max((SAFE_FRACTION * clearance).min(self.stride())).as_dvec2();
        self.touch(limits, sample, &flat, wanted, contacts);
        let held_off = contacts.hold_off(wanted).clamp_length_max(self.stride().into());
        let end = walk(self.connected, self.spacing, place, held_off);
        self.arrived(end.place, from, end.displacement)
    }

    /// Finds the samples from which one must be held off in this displacement.
    fn touch(&self, limits: Limits, sample: usize, flat: &FlatTriangle, displacement: DVec2, contacts: &mut Contacts) {
        contacts.clear();
        let around = &self.surroundings[sample];
        let reach = limits.near + 2.0 * displacement.length() * self.spacing;
        for &other in &around.in_sight {
            let offset = self.positions[other as usize] - self.positions[sample];
            if offset.length_squared() < reach * reach {
                let is_near = around.knows(NearSample { sample: other, mirror: None });
                contacts.add(flat, offset, if is_near { limits.near } else { limits.far });
            }
        }
    }

    /// The state of a sample that has moved to a point.
    fn arrived(&self, place: SurfacePoint, from: DVec3, velocity: DVec2) -> Moved {
        let position = place.position(self.connected.mesh);
        Moved { place, position, velocity, length: from.distance(position) / self.spacing }
    }

    /// The largest displacement of samples in this step, in spacings.
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
        let mut place = || {
            let [u, v] = [rng.unit(), rng.unit()];
            let uv = if u + v <= 1.0 { DVec2::new(u, v) } else { DVec2::new(1.0 - u, 1.0 - v) };
            SurfacePoint { triangle: rng.below(4) as u32, uv }
        };
        let places: Vec<SurfacePoint> = (0..350).map(|_| place()).collect();
        let positions: Vec<DVec3> = places.iter().map(|place| place.position(&mesh)).collect();
        let pairs = || (0..places.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let floor = pairs().map(|(i, j)| positions[i].distance(positions[j])).fold(f64::INFINITY, f64::min);
        let mut set = SurfaceRelaxation::new(&connected, spacing, floor, places.clone());
        let context = Context::new(1).unwrap();
        let (mut sights, mut unknown) = (0, 0);
        for _ in 0..30 {
            let chunks = chunks_of(places.len(), CHUNK);
            context.run(None, |job| set.search(job, chunks)).unwrap();
            for (i, j) in pairs() {
                if set.positions[i].distance(set.positions[j]) < floor + 2.0 * FARTHEST * spacing {
                    assert!(set.surroundings[i].sees(j as u32) && set.surroundings[j].sees(i as u32));
                    sights += 1;
                    unknown += usize::from(!set.surroundings[i].knows(NearSample { sample: j as u32, mirror: None }));
                }
            }
            context.run(None, |job| set.step(job)).unwrap();
            assert!(pairs().all(|(i, j)| set.positions[i].distance(set.positions[j]) >= floor));
        }
        assert!(sights > 10_000 && unknown > 1000, "{sights} in sight, {unknown} of them on another side");
    }
}
