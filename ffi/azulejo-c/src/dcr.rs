//! DCR: relaxation of a point set by distance constraints.

use std::ffi::c_void;
use std::mem::MaybeUninit;

use azulejo_core::dcr::{self, Distribution, Neighbourhood, Report};

use crate::boundary::{self, required, rows};
use crate::context::azulejo_context;
use crate::domain::{AZULEJO_BOUNDARY_PERIODIC, domain};
use crate::options::{self, Watch, azulejo_progress_fn, options};
use crate::points::azulejo_points;
use crate::status::{Failure, azulejo_status};

/// A point's neighbours are those of the Delaunay triangulation: they repel and attract.
pub const AZULEJO_NEIGHBOURHOOD_DELAUNAY: i32 = 0;
/// A point's neighbours are its nearest points: they repel only.
pub const AZULEJO_NEIGHBOURHOOD_NEAREST: i32 = 1;

/// The tension of an edge is divided between its ends by their activeness: the default.
pub const AZULEJO_DISTRIBUTION_ACTIVENESS: i32 = 0;
/// Half of the tension to each end.
pub const AZULEJO_DISTRIBUTION_AVERAGE: i32 = 1;
/// All of the tension to the neighbour.
pub const AZULEJO_DISTRIBUTION_DOMINANT: i32 = 2;
/// All of the tension to the point itself.
pub const AZULEJO_DISTRIBUTION_ZERO: i32 = 3;
/// 80 per cent of the tension to the point itself, 20 to the neighbour.
pub const AZULEJO_DISTRIBUTION_EIGHTY_TWENTY: i32 = 4;

/// Options of azulejo_dcr_relax. Radii are in units of d_max = sqrt(2 * area / (sqrt(3) * count)), the distance of
/// neighbours if the same number of points stood in hexagonal arrangement.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_dcr_options {
    /// The size of the caller's struct in bytes; set by the init function.
    pub struct_size: u32,
    /// An AZULEJO_BOUNDARY_ constant; periodic by default.
    pub boundary: i32,
    /// The lower corner of the domain, x y; 0 0 by default.
    pub domain_min: [f64; 2],
    /// The upper corner of the domain, above the lower one on both axes; 1 1 by default.
    pub domain_max: [f64; 2],
    /// An AZULEJO_NEIGHBOURHOOD_ constant; Delaunay by default.
    pub neighbourhood: i32,
    /// The largest number of steps, 1000 by default; 0 returns the points as they are. Fewer are made where the motion
    /// ends before.
    pub max_iterations: u32,
    /// Parts points that coincide; used for nothing else.
    pub seed: u64,
    /// Neighbours closer than this repel each other; above 0, at most 1; 0.95 by default.
    pub conflict_radius: f64,
    /// Delaunay neighbours farther apart than this attract each other; at least conflict_radius; 1.05 by default.
    pub attraction_radius: f64,
    /// The displacement by a tension of 1; above 0, at most 1; 0.05 by default.
    pub step: f64,
    /// The motion (see the report) at which the set has converged. 0 makes all steps; a negative number, the default,
    /// takes 0.02 for Delaunay and 0.005 for nearest neighbours.
    pub tolerance: f64,
    /// How many neighbours AZULEJO_NEIGHBOURHOOD_NEAREST takes; at least 1; 6 by default.
    pub neighbours: u32,
    /// An AZULEJO_DISTRIBUTION_ constant (thesis figure 4.19); by activeness by default.
    pub distribution: i32,
    /// Called during the call, unless NULL, which is the default.
    pub progress: azulejo_progress_fn,
    /// Handed to the progress callback.
    pub progress_user: *mut c_void,
}

options!(azulejo_dcr_options requires domain_max {
    boundary: AZULEJO_BOUNDARY_PERIODIC,
    domain_min: [0.0; 2],
    domain_max: [1.0; 2],
    neighbourhood: AZULEJO_NEIGHBOURHOOD_DELAUNAY,
    max_iterations: 1000,
    seed: 0,
    conflict_radius: 0.95,
    attraction_radius: 1.05,
    step: 0.05,
    tolerance: -1.0,
    neighbours: 6,
    distribution: AZULEJO_DISTRIBUTION_ACTIVENESS,
    progress: None,
    progress_user: std::ptr::null_mut(),
});

impl azulejo_dcr_options {
    fn request(&self) -> Result<dcr::Options, Failure> {
        let domain = domain(self.domain_min, self.domain_max, self.boundary)?;
        let neighbourhood = neighbourhood(self.neighbourhood)?;
        let default = dcr::Options::new(domain, neighbourhood);
        Ok(dcr::Options {
            domain,
            neighbourhood,
            max_iterations: self.max_iterations,
            seed: self.seed,
            conflict_radius: self.conflict_radius,
            attraction_radius: self.attraction_radius,
            step: self.step,
            neighbours: self.neighbours,
            distribution: distribution(self.distribution)?,
            tolerance: if self.tolerance < 0.0 { default.tolerance } else { self.tolerance },
        })
    }
}

fn neighbourhood(value: i32) -> Result<Neighbourhood, Failure> {
    match value {
        AZULEJO_NEIGHBOURHOOD_DELAUNAY => Ok(Neighbourhood::Delaunay),
        AZULEJO_NEIGHBOURHOOD_NEAREST => Ok(Neighbourhood::Nearest),
        other => Err(Failure::invalid("neighbourhood", format!("{other} is no AZULEJO_NEIGHBOURHOOD_ constant"))),
    }
}

fn distribution(value: i32) -> Result<Distribution, Failure> {
    match value {
        AZULEJO_DISTRIBUTION_ACTIVENESS => Ok(Distribution::Activeness),
        AZULEJO_DISTRIBUTION_AVERAGE => Ok(Distribution::Average),
        AZULEJO_DISTRIBUTION_DOMINANT => Ok(Distribution::Dominant),
        AZULEJO_DISTRIBUTION_ZERO => Ok(Distribution::Zero),
        AZULEJO_DISTRIBUTION_EIGHTY_TWENTY => Ok(Distribution::EightyTwenty),
        other => Err(Failure::invalid("distribution", format!("{other} is no AZULEJO_DISTRIBUTION_ constant"))),
    }
}

/// What a relaxation did.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_dcr_report {
    /// The steps made.
    pub iterations: u32,
    /// 1 if the motion came to its end before the steps did, else 0.
    pub converged: i32,
    /// How far points got, root mean square: in units of d_max and per unit of step size, over the last steps whose sizes
    /// add up to 2. It is the same for small and large steps.
    pub motion: f64,
    /// The smallest distance between two of the points, in the units of the domain; infinite for less than two points.
    pub smallest_distance: f64,
    /// The smallest distance in units of d_max: 0.77 for a maximal set, at most 1 on a periodic domain.
    pub rho: f64,
    /// Zeros, for later versions.
    pub reserved: [u32; 8],
}

impl From<Report> for azulejo_dcr_report {
    fn from(report: Report) -> Self {
        let Report { iterations, converged, motion, smallest_distance, rho, .. } = report;
        Self { iterations, converged: converged.into(), motion, smallest_distance, rho, reserved: [0; 8] }
    }
}

/// Writes the defaults. `struct_size` is sizeof *options.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_options_init(
    options: *mut azulejo_dcr_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { options::init(options, struct_size) }
}

/// Relaxes a set of points: neighbours that are too close repel, those too far apart attract each other, until the
/// motion ends or the steps do (thesis chapter 4). O(count log count) time for each step.
///
/// xy: the points, x y each, in domain_min <= x < domain_max; `count` of them.
///
/// out: the points after the last step, in the same order, to be freed with azulejo_points_free.
///
/// report: what the call did, or NULL.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_relax(
    context: Option<&azulejo_context>,
    options: *const azulejo_dcr_options,
    xy: *const f32,
    count: usize,
    out: Option<&mut MaybeUninit<Box<azulejo_points>>>,
    report: Option<&mut MaybeUninit<azulejo_dcr_report>>,
) -> azulejo_status {
    boundary::create(out, || {
        let context = required("context", context)?.shared.clone();
        // SAFETY: handed on from the caller.
        let (options, points) = unsafe { (options::read(options)?, rows::<f32, 2>("xy", xy, "count", count)?) };
        let request = options.request()?;
        let watch = Watch { function: options.progress, user: options.progress_user };
        let (relaxed, done) = watch.run(|progress| dcr::relax(&context, &request, points, progress))?;
        report.map(|report| report.write(done.into()));
        Ok(azulejo_points::plane(relaxed))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::Options;

    #[test]
    fn the_defaults_are_those_of_the_core() {
        for neighbourhood in [AZULEJO_NEIGHBOURHOOD_DELAUNAY, AZULEJO_NEIGHBOURHOOD_NEAREST] {
            let request = azulejo_dcr_options { neighbourhood, ..azulejo_dcr_options::DEFAULT }.request().unwrap();
            assert_eq!(request, dcr::Options::new(request.domain, request.neighbourhood));
        }
    }
}
