//! Density: relaxation of sets whose density varies, as in stippling (thesis §4.2.3).
//!
//! The thesis says that its radii are to be multiplied by a map of the user's, without further detail. Here:
//!
//! * The *local spacing* follows from the density, as 1 / sqrt(density) (`raster.rs`). The distance of two points is
//!   measured in the mean of their spacings, as `psp::adaptive` does, a hole by the density itself (`law.rs`).
//! * Constraints between neighbours only relax the points locally. The number of points that the density asks for in a
//!   region is achieved by removing long waves of the excess, whose lengths scale with the local spacing (`raster.rs`).
//!
//! All else is as in the momentum method: momentum, constraints that grow stiffer, a boundary in which points do not
//! see themselves, a mesh that is kept (`half_edge_mesh.rs`), even where wide areas have no points (see [`anchors`]).
//! The boundary has no excess of points, which would show as a frame.

mod half_edge_mesh;
mod raster;

use glam::{DVec2, Vec2};

use crate::dcr::clustering::{EXCESS, is_clustered};
use crate::dcr::density::half_edge_mesh::HalfEdgeMesh;
use crate::dcr::density::raster::{OctaveGrids, Raster};
use crate::dcr::law::{Constraints, FREE_CLEARANCE, Force, MOMENTUM, RingPoint, SAFE_FRACTION, graded_force};
use crate::dcr::relaxation::{DelaunayOptions, PlaneRelaxation, Relaxation, Report, relax_set};
use crate::dcr::torus::{CurveOrder, MirrorBoundary, Neighbours, Torus, TorusPoint, along_curve};
use crate::error::{Error, Result};
use crate::geometry::Delaunay;
use crate::index::Grid2;
use crate::job::{Context, Job, Progress, chunks};
use crate::points::{Boundary, Domain};

/// A density for every position of the domain; called from several threads at once, unless the context has only one.
pub type DensityFunction<'a> = dyn Fn([f64; 2]) -> f64 + Sync + 'a;

/// The density that points shall have at each position, in any unit: twice the density gives the same set.
///
/// Densities are finite, at least 0, and not 0 everywhere. Where they are 0 no points are wanted: points that start or
/// stray there return within the steps, and the last ones after them.
#[derive(Clone, Copy)]
pub enum Density<'a> {
    /// An image that is stretched over the domain, linear between the centres of its pixels.
    Image {
        /// The pixels, row by row; the first row lies along the lower side (`min[1]`) of the domain.
        values: &'a [f32],
        /// Pixels in a row; at least 1.
        width: usize,
        /// Rows; at least 1.
        height: usize,
    },
    /// A density for each position. It is called once for each position of a lattice of 100 to 200 positions per point,
    /// all before the first step.
    Function(&'a DensityFunction<'a>),
}

impl Density<'_> {
    /// Refuses images whose size is not that of their values, and pixels that are not a density.
    pub fn check(&self) -> Result<()> {
        let Self::Image { values, width, height } = *self else { return Ok(()) };
        for (argument, length) in [("width", width), ("height", height)] {
            if length == 0 {
                return Err(Error::invalid(argument, "0 is not at least 1"));
            }
        }
        if width.checked_mul(height) != Some(values.len()) {
            let reason = format!("{} values are not those of an image of {width} by {height}", values.len());
            return Err(Error::invalid("density", reason));
        }
        match values.iter().position(|&value| !is_density(value.into())) {
            None => Ok(()),
            Some(i) => {
                let reason =
                    format!("pixel ({}, {}) is {:?}, not 0 or above and finite", i % width, i / width, values[i]);
                Err(Error::invalid("density", reason))
            }
        }
    }
}

/// True if a number is a density that floats can hold.
pub fn is_density(value: f64) -> bool {
    (0.0..=f32::MAX.into()).contains(&value)
}

/// Relaxes a set of points to a density: returns as many points, in the same order, with the requested local density,
/// and evenly spread. A start with about that density, such as [`scatter`] or [`psp::adaptive`](crate::psp::adaptive)
/// make, needs no more than the usual 100 steps.
///
/// A start that is far from it is redistributed before the first step over the points that [`scatter`] makes from
/// `seed`, in the order of a curve, so that points that were near each other mostly stay so. A start is far if its
/// number of points in some cell of a quadtree differs by more than 64, by more than a quarter and by more than 16
/// times the square root from that of the points of [`scatter`]. Starts in between may take more steps.
///
/// Like [`relax`](fn@crate::dcr::relax), with these differences. In the report, lengths are in units of the *local
/// spacing*: `d_max` for the mean density, as 1 / sqrt(density) elsewhere, but it grows by no more than half of the
/// distance between positions, so that it is finite where the density is 0. [`Report::rho`] is the least of all
/// distances over the mean of the spacings of the two points, [`Report::relative_covering_radius`] the largest
/// circumradius of a triangle over the spacing at its centre, without the limit to its growth. [`Report::motion`] is in
/// units of `d_max`.
/// Details of the density that are finer than an eighth of `d_max` are lost. A call that is cancelled before the first
/// step returns the points unchanged.
///
/// The density is sampled at 13 to 55 positions per point, and then each step is O(n), with a factor for densities that
/// vary by octaves.
///
/// # Errors
/// [`Error::InvalidArgument`] for a density that is not 0 or above and finite, or is 0 everywhere (`density`; of
/// several such positions the reported one does not depend on chance), for an image without pixels (`width`, `height`)
/// or of another size than its values; those of [`relax`](fn@crate::dcr::relax).
pub fn relax_with_density(
    context: &Context,
    options: &DelaunayOptions,
    density: &Density,
    points: &[[f32; 2]],
    progress: Option<&Progress>,
) -> Result<(Vec<[f32; 2]>, Report)> {
    options.check()?;
    density.check()?;
    options.domain.check_points(points)?;
    let bytes = match options.domain.boundary {
        Boundary::Periodic => BYTES_PER_POINT,
        Boundary::Bounded => BYTES_PER_MIRRORED_POINT,
    };
    let mut set = context.run(None, |job| {
        let raster = Raster::new(&job.part(0.0, 0.5), &options.domain, density, points.len(), ("positions", bytes))?;
        DensityRelaxation::new(&job.part(0.5, 1.0), options.domain, options.seed, raster, points)
    })?;
    relax_set(context, &options.domain, options.limits(), points, &mut set, progress, None)
}

/// Random points of a domain with the requested density: a start for [`relax_with_density`]. Point `i` depends on the
/// arguments and on nothing else.
///
/// # Errors
/// [`Error::InvalidArgument`] for a domain or a density that is invalid, [`Error::TooLarge`] for more than 2^32 - 1
/// points, or than fit in memory, [`Error::Cancelled`].
pub fn scatter(
    context: &Context,
    domain: &Domain,
    density: &Density,
    count: usize,
    seed: u64,
    progress: Option<&Progress>,
) -> Result<Vec<[f32; 2]>> {
    domain.check()?;
    density.check()?;
    if count > u32::MAX as usize {
        return Err(Error::too_large("count", format!("{count} points; the limit is {}", u32::MAX)));
    }
    context.run(progress, |job| {
        let raster = Raster::new(&job.part(0.0, 0.9), domain, density, count, ("count", BYTES_PER_SCATTERED_POINT))?;
        Ok(raster.scatter(&Torus::new(*domain, count), count, seed))
    })
}

/// The peak memory for a point and all of its data beside the raster; where it has images; and where it is only thrown.
const BYTES_PER_POINT: f64 = 450.0;
const BYTES_PER_MIRRORED_POINT: f64 = 1500.0;
const BYTES_PER_SCATTERED_POINT: f64 = 10.0;

/// The number of steps from one removal of waves to the next: fewer than in uniform sets, where nothing builds them up
/// again.
const WAVES_EVERY: u32 = 2;

/// The points, their velocities and mesh, and the density that they shall have.
pub struct DensityRelaxation {
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
    /// The mesh of the points, once it exists.
    mesh: Option<HalfEdgeMesh>,
}

impl DensityRelaxation {
    /// The points before the first step.
    pub fn new(job: &Job, domain: Domain, seed: u64, raster: Raster, points: &[[f32; 2]]) -> Result<Self> {
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

    /// Moves the points to these places before the first step.
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
                let Force { sum, clearance } = graded_force(constraints, spacing, &ring, density_at);
                let limit = SAFE_FRACTION
                    * if matches!(neighbours, Neighbours::Kept(_)) { clearance } else { FREE_CLEARANCE * spacing };
                let sum = match self.domain.boundary {
                    Boundary::Periodic => sum,
                    Boundary::Bounded => {
                        let images = self.torus.own_images(self.places[point]).map(|image| image / spacing);
                        MirrorBoundary::force_by_images(constraints, images, sum)
                    }
                };
                let (velocity, drift) = match self.raster.wanted_near(self.places[point]) {
                    None => (MOMENTUM * self.velocities[point] + spacing * sum, drift[point]),
                    Some(wanted) => (self.torus.offset_f32(self.places[point], wanted), Vec2::ZERO),
                };
                let place = self.torus.moved(self.places[point], (velocity + drift).clamp_length_max(limit));
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

    /// Redistributes clustered points over random points with the density, which are in the order of the curve too.
    fn begin(&mut self, _: &Job) -> Result<()> {
        let scattered = self.raster.scatter(&self.torus, self.order.len(), self.seed);
        let random = CurveOrder::new(&self.torus, &scattered, self.seed);
        if is_clustered::<2>(&along_curve(self.order.start()), &along_curve(random.start()), u64::BITS, EXCESS) {
            self.restart(random.start());
        }
        Ok(())
    }

    /// Without any step, the points are those with which the set began. After the last one, points that are where none
    /// are wanted leave at once.
    fn finish(&mut self, _: &Job, iterations: u32) -> Result<()> {
        if iterations == 0 {
            let given = self.order.given().to_vec();
            self.restart(&given);
            return Ok(());
        }
        let wanted = |&place: &TorusPoint| self.raster.wanted_near(place).map_or(place, |near| self.torus.inside(near));
        let places: Vec<TorusPoint> = self.places[..self.order.len()].iter().map(wanted).collect();
        self.restart(&places);
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
        if let Neighbours::Kept(mesh) = neighbours {
            self.mesh = Some(mesh);
        }
        Ok(())
    }

    fn follow(&mut self, job: &Job) -> Result<()> {
        if let Some(mut mesh) = self.mesh.take() {
            self.mesh = mesh.repair(&job.part(0.7, 1.0), &self.corners())?.then_some(mesh);
        }
        Ok(())
    }
}

impl PlaneRelaxation for DensityRelaxation {
    fn points(&self, points: &[[f32; 2]]) -> Vec<[f32; 2]> {
        self.order.leave(&self.torus, &self.places, points)
    }

    /// The smallest distance over the mean spacing of the two points. The spacing grows by no more than half of the
    /// distance, so of two points whose ratio is at most 4/3 the one with the smaller spacing finds the other within
    /// twice that. Where all are farther apart, as a few points in a strip, the largest of all spacings bounds the
    /// search.
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

    /// The largest circumradius in units of the spacing that the density at its centre asks for.
    fn covering_radius(&mut self, job: &Job) -> Result<f64> {
        let delaunay = self.triangulate(job, &self.places)?;
        let relative =
            |(centre, radius): (DVec2, f64)| radius * f64::from(self.raster.density(self.torus.place(centre))).sqrt();
        let largest = delaunay.circumcircles().map(relative).fold(0.0, f64::max);
        Ok(largest * self.torus.frame.in_d_max() * self.domain.hexagonal_distance(self.order.len()))
    }
}

// Fixed points that hold the mesh where no points are wanted.
//
// The kept mesh has no edge longer than a quarter of the torus (`half_edge_mesh.rs`), but stippled images often have
// wide white areas. So a coarse lattice of anchors is placed there. They are corners of triangles and nothing else:
// they do not move, push or count, and no hole is filled where the density is 0.

/// The number of points of the lattice along each axis of the domain.
const LATTICE: u32 = 8;

/// The least local spacing at an anchor: as the spacing grows by half of the distance at most, anchors are at twice
/// this distance from where points are wanted.
const WIDE: f32 = 3.0;

/// The anchors of a domain and, where it is mirrored, their images.
pub fn anchors(torus: &Torus, raster: &Raster) -> Vec<TorusPoint> {
    let lattice = (0..LATTICE).flat_map(|row| (0..LATTICE).map(move |column| [column, row]));
    let places = lattice.map(|cell| raster.place(cell.map(|index| (f64::from(index) + 0.5) / f64::from(LATTICE))));
    let wide: Vec<TorusPoint> = places.filter(|&place| raster.spacing(place) >= WIDE).collect();
    torus.with_images(&wide)
}
