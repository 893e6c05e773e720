//! A set that is being relaxed to a density.

use glam::{DVec2, Vec2};

use crate::dcr::density::anchors::anchors;
use crate::dcr::density::forces::{RingPoint, force};
use crate::dcr::density::half_edge_mesh::HalfEdgeMesh;
use crate::dcr::density::octaves::OctaveGrids;
use crate::dcr::density::raster::Raster;
use crate::dcr::ground::boundary::MirrorBoundary;
use crate::dcr::ground::constraints::{Constraints, FREE_CLEARANCE, Force, MOMENTUM, SAFE_FRACTION};
use crate::dcr::ground::curve::{CurveOrder, along_curve};
use crate::dcr::ground::heaps::are_heaped;
use crate::dcr::ground::neighbours::Neighbours;
use crate::dcr::ground::torus::{Torus, TorusPoint};
use crate::dcr::relax::PlaneRelaxation;
use crate::dcr::relaxation::Relaxation;
use crate::error::Result;
use crate::geometry::Delaunay;
use crate::index::Grid2;
use crate::job::{Job, chunks};
use crate::points::{Boundary, Domain};

/// The number of steps from one removal of waves to the next: fewer than in uniform sets, where nothing builds them up
/// again.
const WAVES_EVERY: u32 = 2;

/// The points, their velocities and mesh, and the density that they shall have.
pub(super) struct DensityRelaxation {
    domain: Domain,
    torus: Torus,
    raster: Raster,
    octaves: OctaveGrids,
    seed: u64,
    order: CurveOrder,
    /// The points, and after them their images on the torus.
    places: Vec<TorusPoint>,
    anchors: Vec<TorusPoint>,
    /// The local spacing of each point, in spacings of the torus.
    spacings: Vec<f32>,
    velocities: Vec<Vec2>,
    /// The mesh of the points, once there is one.
    mesh: Option<HalfEdgeMesh>,
}

impl DensityRelaxation {
    /// The points before the first step.
    pub(super) fn new(job: &Job, domain: Domain, seed: u64, raster: Raster, points: &[[f32; 2]]) -> Result<Self> {
        let torus = Torus::new(domain, points.len());
        let order = CurveOrder::new(&torus, points, seed);
        let start = order.start();
        Ok(Self {
            domain,
            octaves: OctaveGrids::new(job, &torus, &raster, start.len())?,
            places: torus.with_images(start),
            anchors: anchors(&torus, &raster),
            spacings: start.iter().map(|&place| raster.spacing(place)).collect(),
            velocities: vec![Vec2::ZERO; start.len()],
            mesh: None,
            torus,
            raster,
            seed,
            order,
        })
    }

    /// Puts the points on these places before the first step.
    fn restart(&mut self, places: &[TorusPoint]) {
        self.places = self.torus.with_images(places);
        self.spacings = places.iter().map(|&place| self.raster.spacing(place)).collect();
    }

    fn neighbours(&mut self, job: &Job) -> Result<Neighbours<HalfEdgeMesh>> {
        if let Some(mesh) = self.mesh.take() {
            return Ok(Neighbours::Kept(mesh));
        }
        let corners = self.corners();
        let delaunay = self.triangulate(&job.part(0.0, 0.9), &corners)?;
        if let Some(mut mesh) = HalfEdgeMesh::new(&delaunay, &self.torus, &corners)
            && mesh.repair(&job.part(0.9, 1.0), &corners)?
        {
            return Ok(Neighbours::Kept(mesh));
        }
        Ok(Neighbours::Built(delaunay))
    }

    /// The corners of the mesh: all points and images, then the anchors.
    fn corners(&self) -> Vec<TorusPoint> {
        [&self.places[..], &self.anchors].concat()
    }

    fn triangulate(&self, job: &Job, corners: &[TorusPoint]) -> Result<Delaunay> {
        Delaunay::new(job, &self.torus.frame, self.torus.nudged(corners).into_iter())
    }

    /// The ring around a point.
    fn surround(&self, neighbours: &Neighbours<HalfEdgeMesh>, point: usize, ring: &mut Vec<RingPoint>) {
        ring.clear();
        let mut add = |other: u32, offset: Option<Vec2>| {
            // No point is in conflict with an anchor.
            let (place, spacing) = match (other as usize).checked_sub(self.places.len()) {
                Some(anchor) => (self.anchors[anchor], f32::INFINITY),
                None => (self.places[other as usize], self.spacings[other as usize % self.order.len()]),
            };
            let offset = offset.unwrap_or_else(|| self.torus.offset_f32(self.places[point], place));
            ring.push(RingPoint { offset, spacing });
        };
        match neighbours {
            Neighbours::Kept(mesh) => mesh.for_each_neighbour(point, |other| add(other, None)),
            Neighbours::Built(delaunay) => {
                delaunay.star(point).for_each(|(site, offset)| add(site.source, Some(offset.as_vec2())));
            }
        }
    }

    /// The points and their velocities after a step.
    fn gather(
        &self,
        job: &Job,
        neighbours: &Neighbours<HalfEdgeMesh>,
        constraints: &Constraints,
        drift: &[Vec2],
    ) -> Result<Vec<(TorusPoint, Vec2)>> {
        let chunks = chunks(self.order.len());
        job.concat(chunks.len(), |chunk| {
            let mut ring = Vec::new();
            let advance = |point: usize| {
                self.surround(neighbours, point, &mut ring);
                let spacing = self.spacings[point];
                let density_at = |offset| self.raster.density(self.torus.moved(self.places[point], offset));
                let Force { sum, clearance } = force(constraints, spacing, &ring, density_at);
                let limit = SAFE_FRACTION
                    * if matches!(neighbours, Neighbours::Kept(_)) { clearance } else { FREE_CLEARANCE * spacing };
                let sum = match self.domain.boundary {
                    Boundary::Periodic => sum,
                    Boundary::Bounded => {
                        let images = self.torus.own_images(self.places[point]).map(|image| image / spacing);
                        MirrorBoundary::force_by_images(constraints, images, sum)
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

impl Relaxation for DensityRelaxation {
    type Position = TorusPoint;
    type Space = Torus;

    fn space(&self) -> Torus {
        self.torus
    }

    fn positions(&self) -> impl ExactSizeIterator<Item = TorusPoint> {
        self.places[..self.order.len()].iter().copied()
    }

    /// Deals heaped points out on random points of the density, which are in the order of the curve too.
    fn begin(&mut self, _: &Job) -> Result<()> {
        let scattered = self.raster.scatter(&self.torus, self.order.len(), self.seed);
        let random = CurveOrder::new(&self.torus, &scattered, self.seed);
        if are_heaped::<2>(&along_curve(self.order.start()), &along_curve(random.start()), u64::BITS) {
            self.restart(random.start());
        }
        Ok(())
    }

    /// Without any step, the points are those with which the set began.
    fn finish(&mut self, _: &Job, iterations: u32) -> Result<()> {
        if iterations == 0 {
            let start = self.order.start().to_vec();
            self.restart(&start);
        }
        Ok(())
    }

    fn step(&mut self, job: &Job, iteration: u32) -> Result<()> {
        let count = self.order.len();
        let drift = match iteration.is_multiple_of(WAVES_EVERY) {
            true => self.octaves.drift(&job.part(0.0, 0.2), &self.places, &self.spacings)?,
            false => vec![Vec2::ZERO; count],
        };
        let neighbours = self.neighbours(&job.part(0.2, 0.4))?;
        let moved = self.gather(&job.part(0.4, 0.7), &neighbours, &Constraints::of_step(iteration), &drift)?;
        let (places, velocities): (Vec<TorusPoint>, Vec<Vec2>) = moved.into_iter().unzip();
        self.spacings = places.iter().map(|&place| self.raster.spacing(place)).collect();
        (self.places, self.velocities) = (self.torus.with_images(&places), velocities);
        if let Neighbours::Kept(mut mesh) = neighbours {
            self.mesh = mesh.repair(&job.part(0.7, 1.0), &self.corners())?.then_some(mesh);
        }
        Ok(())
    }
}

impl PlaneRelaxation for DensityRelaxation {
    fn points(&self, points: &[[f32; 2]]) -> Vec<[f32; 2]> {
        self.order.leave(&self.torus, &self.places, points)
    }

    /// The smallest distance over the mean spacing of the two points. The spacing grows by no more than half of the distance,
    /// so of two points whose ratio is at most 4/3 the one with the smaller spacing finds the other within twice that. Where
    /// all are farther apart, as a few points in a strip, the largest of all spacings tells how far to search.
    fn relative_spacing(&self, job: &Job, points: &[[f32; 2]]) -> Result<Option<f64>> {
        if points.len() < 2 {
            return Ok(Some(f64::INFINITY));
        }
        let unit = self.torus.frame.spacing();
        let position = |point: &[f32; 2]| point.map(f64::from);
        let entered = self.torus.enter(points, 0);
        let spacings: Vec<f64> = entered.iter().map(|&place| unit * f64::from(self.raster.spacing(place))).collect();
        let widest = spacings.iter().copied().fold(0.0, f64::max);
        let grid = Grid2::new(self.domain, points.iter().map(position), unit);
        let chunks = chunks(points.len());
        let least_within = |reach: &(dyn Fn(f64) -> f64 + Sync)| {
            let least = job.map(chunks.len(), |chunk| {
                let mut least = f64::INFINITY;
                for i in chunks.range(chunk) {
                    grid.for_each_within(position(&points[i]), reach(spacings[i]), |j, _, squared| {
                        if j as usize != i {
                            least = least.min(squared.sqrt() / (0.5 * (spacings[i] + spacings[j as usize])));
                        }
                    });
                }
                least
            })?;
            Ok(least.into_iter().fold(f64::INFINITY, f64::min))
        };
        let (mut bound, mut least) = (4.0 / 3.0, least_within(&|spacing| 2.0 * spacing)?);
        while least > bound {
            bound *= 2.0;
            least = least_within(&|spacing| 0.5 * bound * (spacing + widest))?;
        }
        Ok(Some(least * self.torus.frame.in_d_max()))
    }

    /// The largest circumradius in units of what the density at its centre asks for.
    fn coverage(&mut self, job: &Job) -> Result<f64> {
        let delaunay = self.triangulate(job, &self.places)?;
        let relative =
            |(centre, radius): (DVec2, f64)| radius * f64::from(self.raster.density(self.torus.place(centre))).sqrt();
        let largest = delaunay.circumcircles().map(relative).fold(0.0, f64::max);
        Ok(largest * self.torus.frame.in_d_max() * self.domain.hexagonal_distance(self.order.len()))
    }
}
