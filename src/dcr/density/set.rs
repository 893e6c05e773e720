//! A set with a density, in the making.

use glam::{DVec2, Vec2};

use crate::dcr::density::anchors::anchors;
use crate::dcr::density::forces::{Neighbour, force};
use crate::dcr::density::levels::Levels;
use crate::dcr::density::mesh::Mesh;
use crate::dcr::density::raster::Raster;
use crate::dcr::ground::border::Border;
use crate::dcr::ground::constraints::{Constraints, Force};
use crate::dcr::ground::motion::Motion;
use crate::dcr::ground::torus::{Place, Torus, along_curve};
use crate::dcr::uniform::gather::{ROOM, WIDE};
use crate::dcr::uniform::{MOMENTUM, STEP};
use crate::dcr::{Options, Relaxation};
use crate::error::Result;
use crate::geometry::delaunay::Delaunay;
use crate::geometry::grid2::Grid2;
use crate::geometry::links::Links;
use crate::job::{Job, chunks};
use crate::points::{Boundary, Domain};

/// What is too much or missing is levelled in every so manieth step: more often than in uniform sets, where nothing holds
/// against it.
const WAVES_EVERY: u32 = 2;

/// What knows the neighbours of each point.
enum Neighbours {
    Mesh(Mesh),
    /// Where there can be no mesh.
    Stars(Delaunay),
}

/// Points, and the density that they shall have.
pub(super) struct Graded {
    domain: Domain,
    torus: Torus,
    raster: Raster,
    levels: Levels,
    /// The user's index of each point: points are kept along a curve.
    order: Vec<u32>,
    /// Where the points began.
    start: Vec<Place>,
    /// Where they are, and after them their images on the torus.
    places: Vec<Place>,
    anchors: Vec<Place>,
    /// The local spacing of each point, in spacings of the torus.
    spacings: Vec<f32>,
    velocities: Vec<Vec2>,
    /// The mesh of the places, once there is one.
    mesh: Option<Mesh>,
    motion: Motion,
    iterations: u32,
}

impl Graded {
    /// The points before the first step.
    pub(super) fn new(job: &Job, options: &Options, raster: Raster, points: &[[f32; 2]]) -> Result<Self> {
        let torus = Torus::new(options.domain, points.len());
        let entered = torus.enter(points, options.seed);
        let order = along_curve(&entered);
        let start: Vec<Place> = order.iter().map(|&point| entered[point as usize]).collect();
        Ok(Self {
            domain: options.domain,
            levels: Levels::new(job, &torus, &raster, start.len())?,
            places: torus.with_images(&start),
            anchors: anchors(&torus, &raster),
            spacings: start.iter().map(|&place| raster.spacing(place)).collect(),
            velocities: vec![Vec2::ZERO; start.len()],
            mesh: None,
            motion: Motion::new(STEP, start.iter().map(|&place| torus.position(place)).collect()),
            iterations: 0,
            torus,
            raster,
            order,
            start,
        })
    }

    fn neighbours(&mut self, job: &Job) -> Result<Neighbours> {
        if let Some(mesh) = self.mesh.take() {
            return Ok(Neighbours::Mesh(mesh));
        }
        let corners = self.corners();
        let delaunay = self.triangulate(&job.part(0.0, 0.9), &corners)?;
        if let Some(mut mesh) = Mesh::new(&delaunay, &self.torus, &corners)
            && mesh.repair(&job.part(0.9, 1.0), &corners)?
        {
            return Ok(Neighbours::Mesh(mesh));
        }
        Ok(Neighbours::Stars(delaunay))
    }

    /// The corners of the mesh: all places, then the anchors.
    fn corners(&self) -> Vec<Place> {
        [&self.places[..], &self.anchors].concat()
    }

    fn triangulate(&self, job: &Job, corners: &[Place]) -> Result<Delaunay> {
        Delaunay::new(job, &self.torus.frame, self.torus.nudged(corners).into_iter())
    }

    /// The ring around a point.
    fn surround(&self, neighbours: &Neighbours, point: usize, ring: &mut Vec<Neighbour>) {
        ring.clear();
        let mut add = |other: u32, offset: Option<Vec2>| {
            // Nothing is in conflict with an anchor.
            let (place, spacing) = match (other as usize).checked_sub(self.places.len()) {
                Some(anchor) => (self.anchors[anchor], f32::INFINITY),
                None => (self.places[other as usize], self.spacings[other as usize % self.order.len()]),
            };
            let offset = offset.unwrap_or_else(|| self.torus.way(self.places[point], place));
            ring.push(Neighbour { offset, spacing });
        };
        match neighbours {
            Neighbours::Mesh(mesh) => mesh.for_each_neighbour(point, |other| add(other, None)),
            Neighbours::Stars(delaunay) => {
                delaunay.for_each(point, |link| add(link.other, Some(link.offset.as_vec2())));
            }
        }
    }

    /// Where every point gets, and how fast.
    fn gather(&self, job: &Job, neighbours: &Neighbours, drift: &[Vec2]) -> Result<Vec<(Place, Vec2)>> {
        let constraints = Constraints::of_step(self.iterations);
        let chunks = chunks(self.order.len());
        job.concat(chunks.len(), |chunk| {
            let mut ring = Vec::new();
            let advance = |point: usize| {
                self.surround(neighbours, point, &mut ring);
                let spacing = self.spacings[point];
                let density_at = |offset| self.raster.density(self.torus.moved(self.places[point], offset));
                let Force { sum, room } = force(&constraints, spacing, &ring, density_at);
                let limit = ROOM * if matches!(neighbours, Neighbours::Mesh(_)) { room } else { WIDE * spacing };
                let sum = match self.domain.boundary {
                    Boundary::Periodic => sum,
                    Boundary::Bounded => {
                        let images = self.torus.own_images(self.places[point]).map(|image| image / spacing);
                        Border::force_by_images(&constraints, images, sum)
                    }
                };
                let velocity = MOMENTUM * self.velocities[point] + spacing * sum;
                let place = self.torus.moved(self.places[point], (velocity + drift[point]).clamp_length_max(limit));
                (place, velocity.clamp_length_max(limit))
            };
            chunks.range(chunk).map(advance).collect()
        })
    }
}

impl Relaxation for Graded {
    fn step(&mut self, job: &Job) -> Result<()> {
        let count = self.order.len();
        let drift = match self.iterations.is_multiple_of(WAVES_EVERY) {
            true => self.levels.drift(&job.part(0.0, 0.2), &self.places, &self.spacings)?,
            false => vec![Vec2::ZERO; count],
        };
        let neighbours = self.neighbours(&job.part(0.2, 0.4))?;
        let moved = self.gather(&job.part(0.4, 0.7), &neighbours, &drift)?;
        let (places, velocities): (Vec<Place>, Vec<Vec2>) = moved.into_iter().unzip();
        self.spacings = places.iter().map(|&place| self.raster.spacing(place)).collect();
        (self.places, self.velocities) = (self.torus.with_images(&places), velocities);
        self.iterations += 1;
        self.motion.after_step(&self.torus.frame, || places.iter().map(|&place| self.torus.position(place)));
        if let Neighbours::Mesh(mut mesh) = neighbours {
            self.mesh = mesh.repair(&job.part(0.7, 1.0), &self.corners())?.then_some(mesh);
        }
        Ok(())
    }

    fn iterations(&self) -> u32 {
        self.iterations
    }

    fn motion(&self) -> f64 {
        let places = self.places[..self.order.len()].iter();
        self.motion.last(&self.torus.frame, places.map(|&place| self.torus.position(place)))
    }

    fn has_settled(&self, tolerance: f64) -> bool {
        self.motion.has_settled(tolerance)
    }

    /// Points that have not moved are returned as they came.
    fn points(&self, points: &[[f32; 2]]) -> Vec<[f32; 2]> {
        let mut relaxed = points.to_vec();
        for ((&point, &start), &place) in self.order.iter().zip(&self.start).zip(&self.places) {
            if place != start {
                relaxed[point as usize] = self.torus.leave(place);
            }
        }
        relaxed
    }

    /// The smallest distance over the mean spacing of the two points. The spacing grows by no more than the distance, so of
    /// two points the one with the smaller spacing sees the other within twice that.
    fn relative_spacing(&self, job: &Job, points: &[[f32; 2]]) -> Result<Option<f64>> {
        let unit = self.torus.frame.spacing();
        let position = |point: &[f32; 2]| point.map(f64::from);
        let entered = self.torus.enter(points, 0);
        let spacings: Vec<f64> = entered.iter().map(|&place| unit * f64::from(self.raster.spacing(place))).collect();
        let grid = Grid2::new(self.domain, points.iter().map(position), unit);
        let chunks = chunks(points.len());
        let least = job.map(chunks.len(), |chunk| {
            let mut least = f64::INFINITY;
            for i in chunks.range(chunk) {
                grid.for_each_within(position(&points[i]), 2.0 * spacings[i], |j, _, squared| {
                    if j as usize != i {
                        least = least.min(squared.sqrt() / (0.5 * (spacings[i] + spacings[j as usize])));
                    }
                });
            }
            least
        })?;
        Ok(Some(least.into_iter().fold(f64::INFINITY, f64::min)))
    }

    /// The largest circumradius in units of what the density at its centre asks for.
    fn coverage(&mut self, job: &Job) -> Result<f64> {
        let delaunay = self.triangulate(job, &self.places)?;
        let relative =
            |(centre, radius): (DVec2, f64)| radius * f64::from(self.raster.density(self.torus.place(centre))).sqrt();
        let largest = delaunay.circumcircles().map(relative).fold(0.0, f64::max);
        Ok(largest * self.domain.hexagonal_distance(self.order.len()))
    }
}
