//! A set in the making: places on the surface, how fast they move, and who is near whom.

use glam::{DVec2, DVec3};

use super::near::{Crowd, Neighbour, Neighbourhood};
use super::sheet::Sheet;
use super::view::View;
use super::walk::{Flat, Place, walk};
use crate::dcr::motion::{Motion, Space};
use crate::dcr::spread::constraints::{Constraints, Force, STIFFENING};
use crate::dcr::spread::gather::ROOM;
use crate::dcr::spread::{MOMENTUM, STEP};
use crate::error::Result;
use crate::job::{Chunks, Job, chunks_of};

/// How far samples may go in a step, in spacings, ...
const STRIDE: f32 = 0.4;
/// ... and by which factor that falls from step to step when constraints no longer grow stiffer. Where the surface is bent
/// more than the samples are dense, what two of them do to each other is not opposite, and they would never come to rest.
const CALMING: f32 = 0.9;

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
    places: Vec<Place>,
    /// Where they are in space.
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
    pub(super) fn new(sheet: &'a Sheet<'a>, spacing: f64, places: Vec<Place>) -> Self {
        let position = |place: &Place| sheet.mesh.point_exact(place.triangle, place.uv.into());
        let positions: Vec<DVec3> = places.iter().map(position).collect();
        Self {
            sheet,
            spacing,
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

    pub(super) fn places(&self) -> &[Place] {
        &self.places
    }

    /// Moves all samples. If it is cancelled, all have moved or none.
    pub(super) fn step(&mut self, job: &Job) -> Result<()> {
        let chunks = chunks_of(self.places.len(), CHUNK);
        self.look_around(&job.part(0.0, 0.5), chunks)?;
        let moved = self.gather(&job.part(0.5, 1.0), chunks)?;
        self.travelled.iter_mut().zip(&moved).for_each(|(travelled, moved)| *travelled += moved.length);
        self.places = moved.iter().map(|moved| moved.place).collect();
        self.positions = moved.iter().map(|moved| moved.position).collect();
        self.velocities = moved.iter().map(|moved| moved.velocity).collect();
        self.iterations += 1;
        self.motion.after_step(&Unit(self.spacing), || self.positions.iter().copied());
        Ok(())
    }

    /// Looks for the neighbours of those that have moved by half of the slack, and of those near them then that do not know
    /// of them. So two samples that do not know of each other have moved towards each other by no more than the slack.
    fn look_around(&mut self, job: &Job, chunks: Chunks) -> Result<()> {
        let has_moved: Vec<bool> = self.travelled.iter().map(|&way| way >= SLACK / 2.0).collect();
        if !has_moved.contains(&true) {
            return Ok(());
        }
        let crowd = Crowd::new(self.sheet, &self.places, &self.positions, (REACH + SLACK) * self.spacing);
        let found = crowd.neighbourhoods(&job.part(0.0, 0.7), chunks, |sample| has_moved[sample])?;
        let mut is_met = vec![false; self.places.len()];
        for (mover, around) in &found {
            for neighbour in around.neighbours.iter().filter(|neighbour| !has_moved[neighbour.sample as usize]) {
                // Images are mutual too.
                let mover = Neighbour { sample: *mover as u32, mirror: neighbour.mirror };
                is_met[neighbour.sample as usize] |= !self.neighbourhoods[neighbour.sample as usize].knows(mover);
            }
        }
        let met = crowd.neighbourhoods(&job.part(0.7, 1.0), chunks, |sample| is_met[sample])?;
        found.iter().for_each(|&(sample, _)| self.travelled[sample] = 0.0);
        for (sample, around) in found.into_iter().chain(met) {
            self.neighbourhoods[sample] = around;
        }
        Ok(())
    }

    /// Where every sample gets, and how fast.
    fn gather(&self, job: &Job, chunks: Chunks) -> Result<Vec<Moved>> {
        let constraints = Constraints::of_step(self.iterations);
        job.concat(chunks.len(), |chunk| {
            let mut view = View::default();
            chunks.range(chunk).map(|sample| self.moved(&constraints, sample, &mut view)).collect()
        })
    }

    fn moved(&self, constraints: &Constraints, sample: usize, view: &mut View) -> Moved {
        let (place, from) = (self.places[sample], self.positions[sample]);
        let flat = Flat::new(self.sheet, place.triangle, self.spacing);
        view.look(self.sheet, &flat, from, &self.neighbourhoods[sample], &self.positions);
        let Force { sum, room } = view.force(constraints);
        let velocity = MOMENTUM * self.velocities[sample].as_vec2() + sum;
        let way = velocity.clamp_length_max((ROOM * room).min(self.stride())).as_dvec2();
        let end = walk(self.sheet, self.spacing, place, way);
        let position = self.sheet.mesh.point_exact(end.place.triangle, end.place.uv.into());
        Moved { place: end.place, position, velocity: end.way, length: from.distance(position) / self.spacing }
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
