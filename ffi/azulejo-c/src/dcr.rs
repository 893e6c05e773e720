//! DCR: relaxation of a point set by distance constraints.

use std::ffi::c_void;
use std::mem::MaybeUninit;

use azulejo_core::dcr::{self, Convergence, Distribution, Method, Neighbourhood, Report, Stopped, Thesis, Visits};

use crate::boundary::{self, required, rows};
use crate::context::azulejo_context;
use crate::domain::{AZULEJO_BOUNDARY_PERIODIC, domain};
use crate::options::{self, Watch, azulejo_progress_fn, options};
use crate::points::azulejo_points;
use crate::status::{Failure, azulejo_status};

/// A point's neighbours are those of the Delaunay triangulation: they keep their distance and close holes.
pub const AZULEJO_NEIGHBOURHOOD_DELAUNAY: i32 = 0;
/// A point's neighbours are its nearest points: they repel only.
pub const AZULEJO_NEIGHBOURHOOD_NEAREST: i32 = 1;

/// Neighbours in conflict push each other away, holes pull their borders in, points have momentum, and long waves of the
/// density are removed: the default.
pub const AZULEJO_METHOD_BEST: i32 = 0;
/// The algorithm of thesis chapter 4.
pub const AZULEJO_METHOD_THESIS: i32 = 1;

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

/// An edge is visited from each end that has the other in its neighbourhood: the default.
pub const AZULEJO_VISITS_BOTH_ENDS: i32 = 0;
/// An edge is visited from one end, the same in every step, by a coin keyed by the seed and the two points: points get about
/// half as far in a step, and the constant distributions differ with Delaunay neighbours too.
pub const AZULEJO_VISITS_ONE_END: i32 = 1;

/// A set has converged when the motion falls to the tolerance: the default.
pub const AZULEJO_CONVERGENCE_MOTION: i32 = 0;
/// A set has converged when ten times in a row the variance of the distances to the nearest point changes by less than 0.1
/// per cent in a step, and more than 99 per cent of the points move by less than 0.01 d_max (thesis section 4.4.2). The
/// smaller the step, the earlier that happens; in sets of a few hundred points it may never.
pub const AZULEJO_CONVERGENCE_VARIANCE: i32 = 1;

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
    /// The largest number of steps, 100 by default, which is what AZULEJO_METHOD_BEST takes; AZULEJO_METHOD_THESIS may
    /// take 1000. 0 returns the points as they are. Fewer are made where the motion ends before.
    pub max_iterations: u32,
    /// Parts points that coincide; used for nothing else.
    pub seed: u64,
    /// Neighbours closer than this repel each other; above 0, at most 1; 0.95 by default. Plays a part in
    /// AZULEJO_METHOD_THESIS only, as all fields from here to `distribution` but for `tolerance`, and `visits`,
    /// `convergence` and `decay`.
    pub conflict_radius: f64,
    /// Delaunay neighbours farther apart than this attract each other; at least conflict_radius; 1.05 by default.
    pub attraction_radius: f64,
    /// The displacement by a tension of 1; above 0, at most 1; 0.05 by default.
    pub step: f64,
    /// The motion (see the report) at which the set has converged. 0 makes all steps; a negative number, the default,
    /// takes 0.0005, or with AZULEJO_METHOD_THESIS 0.02 for Delaunay and 0.005 for nearest neighbours.
    pub tolerance: f64,
    /// How many neighbours AZULEJO_NEIGHBOURHOOD_NEAREST takes; at least 1; 6 by default.
    pub neighbours: u32,
    /// An AZULEJO_DISTRIBUTION_ constant (thesis figure 4.19); by activeness by default.
    pub distribution: i32,
    /// Called during the call, unless NULL, which is the default.
    pub progress: azulejo_progress_fn,
    /// Handed to the progress callback.
    pub progress_user: *mut c_void,
    /// An AZULEJO_METHOD_ constant; the best by default.
    pub method: i32,
    /// 0.
    pub reserved: u32,
    /// An AZULEJO_VISITS_ constant; from both ends by default.
    pub visits: i32,
    /// An AZULEJO_CONVERGENCE_ constant; by motion by default.
    pub convergence: i32,
    /// What `step` is multiplied with after every step; above 0, at most 1; 1 by default. All steps together are no longer
    /// than step / (1 - decay): about 10 are needed from a random start.
    pub decay: f64,
}

options!(azulejo_dcr_options requires domain_max {
    boundary: AZULEJO_BOUNDARY_PERIODIC,
    domain_min: [0.0; 2],
    domain_max: [1.0; 2],
    neighbourhood: AZULEJO_NEIGHBOURHOOD_DELAUNAY,
    max_iterations: 100,
    seed: 0,
    conflict_radius: 0.95,
    attraction_radius: 1.05,
    step: 0.05,
    tolerance: -1.0,
    neighbours: 6,
    distribution: AZULEJO_DISTRIBUTION_ACTIVENESS,
    progress: None,
    progress_user: std::ptr::null_mut(),
    method: AZULEJO_METHOD_BEST,
    reserved: 0,
    visits: AZULEJO_VISITS_BOTH_ENDS,
    convergence: AZULEJO_CONVERGENCE_MOTION,
    decay: 1.0,
});

impl azulejo_dcr_options {
    pub(crate) fn request(&self) -> Result<dcr::Options, Failure> {
        let domain = domain(self.domain_min, self.domain_max, self.boundary)?;
        let neighbourhood = neighbourhood(self.neighbourhood)?;
        if self.reserved != 0 {
            return Err(Failure::invalid("reserved", format!("{} is not 0", self.reserved)));
        }
        let thesis = Thesis::default()
            .conflict_radius(self.conflict_radius)
            .attraction_radius(self.attraction_radius)
            .step(self.step)
            .decay(self.decay)
            .neighbours(self.neighbours)
            .distribution(distribution(self.distribution)?)
            .visits(visits(self.visits)?)
            .convergence(convergence(self.convergence)?);
        thesis.check()?;
        let (default, method) = match self.method {
            AZULEJO_METHOD_BEST => (dcr::Options::new(domain, neighbourhood), Method::Momentum),
            AZULEJO_METHOD_THESIS => (dcr::Options::thesis(domain, neighbourhood), Method::Thesis(thesis)),
            other => return Err(Failure::invalid("method", format!("{other} is no AZULEJO_METHOD_ constant"))),
        };
        let tolerance = if self.tolerance < 0.0 { default.tolerance } else { self.tolerance };
        Ok(default.method(method).max_iterations(self.max_iterations).seed(self.seed).tolerance(tolerance))
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

fn visits(value: i32) -> Result<Visits, Failure> {
    match value {
        AZULEJO_VISITS_BOTH_ENDS => Ok(Visits::BothEnds),
        AZULEJO_VISITS_ONE_END => Ok(Visits::OneEnd),
        other => Err(Failure::invalid("visits", format!("{other} is no AZULEJO_VISITS_ constant"))),
    }
}

fn convergence(value: i32) -> Result<Convergence, Failure> {
    match value {
        AZULEJO_CONVERGENCE_MOTION => Ok(Convergence::Motion),
        AZULEJO_CONVERGENCE_VARIANCE => Ok(Convergence::Variance),
        other => Err(Failure::invalid("convergence", format!("{other} is no AZULEJO_CONVERGENCE_ constant"))),
    }
}

/// The motion came to its end, or there was nothing to move. With AZULEJO_METHOD_BEST and Delaunay neighbours no points are
/// closer than 0.85 d_max then, nor a circumradius above 0.67 d_max, up to the last step.
pub const AZULEJO_STOPPED_CONVERGED: i32 = 0;
/// All steps were made.
pub const AZULEJO_STOPPED_STEPS: i32 = 1;
/// The progress callback cancelled the call.
pub const AZULEJO_STOPPED_CANCELLED: i32 = 2;

/// What a relaxation did.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_dcr_report {
    /// The steps made.
    pub iterations: u32,
    /// 1 if the set converged, or there was nothing to move, before the steps came to their end; else 0.
    pub converged: i32,
    /// Half of how far points got, root mean square, in units of d_max: over the last 10 steps, or with
    /// AZULEJO_METHOD_THESIS over the last steps whose sizes add up to 2, which is the same for small and large steps.
    pub motion: f64,
    /// The smallest distance between two of the points, in the units of the domain; infinite for less than two points.
    pub smallest_distance: f64,
    /// The smallest distance in units of d_max: 0.77 for a maximal set, at most 1 on a periodic domain.
    pub rho: f64,
    /// The largest distance of a place in the domain from the points, in units of d_max; infinite for no point.
    pub coverage: f64,
    /// Why no more steps were made: an AZULEJO_STOPPED_ constant.
    pub stopped: i32,
    /// Zeros, for later versions.
    pub reserved: [u32; 5],
}

impl From<Report> for azulejo_dcr_report {
    fn from(report: Report) -> Self {
        let Report { iterations, stopped, motion, smallest_distance, rho, coverage, .. } = report;
        Self {
            iterations,
            converged: (stopped == Stopped::Converged).into(),
            motion,
            smallest_distance,
            rho,
            coverage,
            stopped: reason(stopped),
            reserved: [0; 5],
        }
    }
}

/// The constant for why no more steps were made.
pub(crate) fn reason(stopped: Stopped) -> i32 {
    match stopped {
        Stopped::Converged => AZULEJO_STOPPED_CONVERGED,
        Stopped::Steps => AZULEJO_STOPPED_STEPS,
        Stopped::Cancelled => AZULEJO_STOPPED_CANCELLED,
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

/// Relaxes a set of points: neighbours that are too close repel, holes close, until the motion ends or the steps do (thesis
/// chapter 4). O(count) time for each step, O(count log count) with AZULEJO_METHOD_THESIS.
///
/// AZULEJO_METHOD_BEST with Delaunay neighbours returns, of the states after whole steps and the points as they came, the one in
/// which the fewest points have a neighbour closer than 0.85 d_max or a Delaunay triangle with a circumradius above 0.67
/// d_max. All else returns the points after the last whole step. A call that its progress callback cancels succeeds and
/// does the same, with AZULEJO_STOPPED_CANCELLED in the report.
///
/// xy: the points, x y each, in domain_min <= x < domain_max; `count` of them.
///
/// out: the points, in the same order, to be freed with azulejo_points_free.
///
/// report: what the call did, or NULL.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE.
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
        let context = required("context", context)?;
        // SAFETY: handed on from the caller.
        let (options, points) = unsafe { (options::read(options)?, rows::<f32, 2>("xy", xy, "count", count)?) };
        let request = options.request()?;
        let watch = Watch::new(options.progress, options.progress_user);
        let (relaxed, done) =
            context.run(watch, |context, progress| dcr::relax(context, &request, points, progress))?;
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
            let method = AZULEJO_METHOD_THESIS;
            let options = azulejo_dcr_options { neighbourhood, method, ..azulejo_dcr_options::DEFAULT };
            let request = options.request().unwrap();
            let thesis = dcr::Options::thesis(request.domain, request.neighbourhood);
            assert_eq!(request, thesis.max_iterations(100));
        }
    }
}
