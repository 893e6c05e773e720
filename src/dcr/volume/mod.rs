//! Relaxation in cuboids and inside of meshes: the momentum method in space.
//!
//! Points push each other away by the law of the plane, and keep their momentum. The differences:
//!
//! * neighbours are all points within a radius (`lists.rs`), not Delaunay stars: to close holes, the conflict radius begins
//!   large and falls, and in most steps farther points push a little too (`relaxation.rs`);
//! * the boundary is a wall, without mirror images (`torus.rs`), or the surface of a mesh (`inside.rs`);
//! * points of a cuboid that are clustered are redistributed before the first step, as on meshes (`dcr/clustering.rs`): there is
//!   no Fourier transform.
//!
//! The plane crystallises, space does not: random packings jam at .9526 of the densest distance, and sets end below that.

mod inside;
mod lists;
mod relaxation;
mod smallest;
mod solid;
mod torus;

pub use solid::{InsideOptions, relax_inside};

use crate::dcr::relaxation::{Limits, Steps, Stopped, require_points, run};
use crate::dcr::volume::relaxation::VolumeRelaxation;
use crate::dcr::volume::smallest::smallest_distance;
use crate::dcr::volume::torus::VolumeTorus;
use crate::error::Result;
use crate::job::{Context, Progress};
use crate::points::Domain;
use crate::setters::setters;

/// The options of [`relax`](fn@relax).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The cuboid in which the points lie and stay.
    pub domain: Domain<3>,
    /// The largest number of steps. 0 returns the points unchanged. Forces change from step to step as this number asks for, so
    /// that a call with more steps does not begin as one with fewer does.
    pub max_iterations: u32,
    /// The key of the moves of coincident points, and of the redistribution of clustered ones. Used for nothing else.
    pub seed: u64,
    /// The motion ([`Report::motion`]) at which the set has converged, once forces change no more, after 70 to 85 % of the steps;
    /// with 0 all steps are made unless nothing moves at all.
    pub tolerance: f64,
}

impl Options {
    /// At most 100 steps, tolerance 0.001.
    pub fn new(domain: Domain<3>) -> Self {
        Self { domain, max_iterations: 100, seed: 0, tolerance: 0.001 }
    }

    /// Refuses values out of their range.
    pub fn check(&self) -> Result<()> {
        self.domain.check()?;
        self.limits().check()
    }

    /// The conditions that end the steps.
    fn limits(&self) -> Limits {
        Limits { max_iterations: self.max_iterations, tolerance: self.tolerance }
    }
}

setters!(Options { domain: Domain<3>, max_iterations: u32, seed: u64, tolerance: f64 });

/// The report of [`relax`](fn@relax) and [`relax_inside`]. `d_fcc = (sqrt(2) V / N)^(1/3)` is the distance of neighbours in the
/// densest packing, the face-centred cubic one, of as many points in the volume V.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// The number of steps made.
    pub iterations: u32,
    /// The reason why the steps ended.
    pub stopped: Stopped,
    /// Half of the distance that points covered in the last 10 steps, or since the start if there were fewer: root mean square,
    /// in units of the `d_fcc` of the volume as it is for points: a bounded cuboid is longer by .2 spacings on each axis, since
    /// they stand on its faces, and none is thinner than .82 spacings.
    pub motion: f64,
    /// The smallest distance between two of the returned points, in the units of the domain, around the torus on a periodic
    /// domain; infinite for less than two points. Own images do not count.
    pub smallest_distance: f64,
    /// The smallest distance in units of `d_fcc`; infinite for less than two points. At most 1 on a torus of many points; more in
    /// small or thin cuboids, where points stand on the faces or beside their own images.
    pub rho: f64,
}

/// The peak memory for a point and all of its data, and for each of its images, on axes that are shorter than 3.2 spacings.
/// Found by `tests/c/memory_limits.c`.
const BYTES_PER_POINT: f64 = 300.0;
const BYTES_PER_IMAGE: f64 = 130.0;

/// Relaxes points of a cuboid: returns as many points, in the same order, spread more evenly.
///
/// The result is the same for every number of threads; the points stay in `min <= x < max`, wrapped around the torus or held back
/// by the boundary. An empty set and a single point are returned unchanged. Coincident points are first moved by 0.001 to 0.002
/// spacings in directions keyed by `seed` and index.
///
/// Points that are clustered, as in a corner, on a plane or at a single place, are redistributed before the first step: random
/// points of the cuboid are thrown, keyed by `seed`, both are sorted along a curve through space, and the point of each rank is put
/// on the random one of that rank. Points are clustered if there are more than 64 whose number in a part of the cuboid differs by
/// more than a quarter and by more than 16 times the square root from what its volume asks for.
///
/// On a torus on which an axis is shorter than the distance of neighbours a point is pushed by the nearest image of each other, and
/// never by its own.
///
/// From random points 100 steps end at a `rho` of about .94, 500 steps at .95. Lattices do not stay: a set ends as a random one
/// does, also if it was denser.
///
/// The set after the last whole step is returned; a call that is cancelled succeeds, and says so in its report.
///
/// O(n) time for each step, and O(n) memory.
///
/// # Errors
/// [`Error::InvalidArgument`](crate::Error::InvalidArgument) for options out of their range and for points outside the domain or
/// not finite (`positions`, with index and value), [`Error::TooLarge`](crate::Error::TooLarge) for more than 2^32 - 1 points or the
/// available memory.
pub fn relax(
    context: &Context,
    options: &Options,
    points: &[[f32; 3]],
    progress: Option<&Progress>,
) -> Result<(Vec<[f32; 3]>, Report)> {
    options.check()?;
    let &Options { domain, max_iterations, seed, .. } = options;
    domain.check_points(points)?;
    let torus = VolumeTorus::new(domain, points.len().max(1));
    let bytes = BYTES_PER_POINT + BYTES_PER_IMAGE * torus.images().count() as f64;
    require_points("positions", points.len(), bytes)?;
    let mut set = VolumeRelaxation::new(torus, points, max_iterations, seed);
    relax_set(
        context,
        options.limits(),
        &mut set,
        &domain,
        domain.packed_distance(points.len().max(1)),
        points,
        progress,
    )
}

/// Makes the steps of a set and measures the result.
fn relax_set(
    context: &Context,
    limits: Limits,
    set: &mut VolumeRelaxation,
    domain: &Domain<3>,
    packed_distance: f64,
    points: &[[f32; 3]],
    progress: Option<&Progress>,
) -> Result<(Vec<[f32; 3]>, Report)> {
    run(
        context,
        limits,
        set,
        progress,
        |_| {},
        |job, set, Steps { iterations, stopped, motion }| {
            let relaxed = if iterations > 0 { set.points() } else { points.to_vec() };
            let smallest_distance = smallest_distance(job, domain, &relaxed)?;
            let rho = smallest_distance / packed_distance;
            Ok((relaxed, Report { iterations, stopped, motion, smallest_distance, rho }))
        },
    )
}
