//! DCR: relaxation of a point set by distance constraints.

use std::ffi::c_void;

use azulejo_core::dcr::{self, Convergence, Distribution, Method, Neighbourhood, Report, Stopped, Thesis, Visits};

use crate::boundary::{Out, check_reserved, check_unused, rows};
use crate::classes::AZULEJO_MAX_CLASSES;
use crate::context::azulejo_context;
use crate::domain::{AZULEJO_BOUNDARY_PERIODIC, domain};
use crate::growing::{self, Growing, Output, growing};
use crate::handles;
use crate::points::azulejo_points;
use crate::progress::{Watch, azulejo_progress_fn};
use crate::status::{Failure, azulejo_status};

/// A point's neighbours are those of the Delaunay triangulation: they keep their distance and close
/// holes.
pub const AZULEJO_NEIGHBOURHOOD_DELAUNAY: u32 = 0;
/// A point's neighbours are its nearest points: they only repel.
pub const AZULEJO_NEIGHBOURHOOD_NEAREST: u32 = 1;

/// The momentum method, the default: neighbours in conflict push each other away, holes pull the
/// points around them, points have momentum, and long waves of the density are removed.
pub const AZULEJO_METHOD_MOMENTUM: u32 = 0;
/// The algorithm of thesis chapter 4.
pub const AZULEJO_METHOD_THESIS: u32 = 1;

/// The tension of an edge is divided between its ends according to their activeness: the default.
pub const AZULEJO_DISTRIBUTION_ACTIVENESS: u32 = 0;
/// Half of the tension goes to each end.
pub const AZULEJO_DISTRIBUTION_AVERAGE: u32 = 1;
/// All of the tension goes to the neighbour.
pub const AZULEJO_DISTRIBUTION_DOMINANT: u32 = 2;
/// All of the tension goes to the point itself.
pub const AZULEJO_DISTRIBUTION_ZERO: u32 = 3;
/// 80 per cent of the tension goes to the point itself, 20 to the neighbour.
pub const AZULEJO_DISTRIBUTION_EIGHTY_TWENTY: u32 = 4;

/// An edge is visited from each end that has the other one in its neighbourhood: the default.
pub const AZULEJO_VISITS_BOTH_ENDS: u32 = 0;
/// An edge is visited from one end, the same in every step, chosen by a hash of the seed and the
/// two points. Points move about half as far in a step, and the constant distributions differ with
/// Delaunay neighbours too.
pub const AZULEJO_VISITS_ONE_END: u32 = 1;

/// A set has converged when the motion falls to the tolerance: the default.
pub const AZULEJO_CONVERGENCE_MOTION: u32 = 0;
/// A set has converged when ten times in succession the variance of the distances to the nearest
/// point changes by less than 0.1 per cent in a step and more than 99 per cent of the points move
/// by less than 0.01 d_max (thesis section 4.4.2). The smaller the step, the earlier that happens;
/// in sets of a few hundred points it may never happen.
pub const AZULEJO_CONVERGENCE_VARIANCE: u32 = 1;

/// Options of azulejo_dcr_relax, azulejo_dcr_relax_density and azulejo_dcr_scatter. The latter uses
/// only the domain, the boundary, the seed and the progress callback; the struct is shared so that
/// a scattered set is relaxed on the same domain.
///
/// The fields from `conflict_radius` on are settings of AZULEJO_METHOD_THESIS; with
/// AZULEJO_METHOD_MOMENTUM they must have their defaults.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_dcr_options {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// An AZULEJO_BOUNDARY_ constant; default periodic.
    pub boundary: u32,
    /// The lower corner of the domain, x y; finite; default 0 0.
    pub domain_min: [f64; 2],
    /// The upper corner of the domain, x y; finite and above the lower corner on both axes; default
    /// 1 1. Neither side may be longer than 2^100 times the other.
    pub domain_max: [f64; 2],
    /// An AZULEJO_NEIGHBOURHOOD_ constant; default Delaunay.
    pub neighbourhood: u32,
    /// An AZULEJO_METHOD_ constant; default momentum.
    pub method: u32,
    /// The largest number of steps; default 100, which is enough for AZULEJO_METHOD_MOMENTUM from
    /// any points; AZULEJO_METHOD_THESIS may need 1000. 0 returns the points as they are. The call
    /// ends earlier when the set has converged.
    pub max_iterations: u32,
    /// Must be 0.
    pub reserved: u32,
    /// Directions in which coincident points are separated, for azulejo_dcr_scatter the points, for
    /// azulejo_dcr_relax_density those of a clustered set's redistribution; any number, default 0.
    pub seed: u64,
    /// The motion (see the report) at which the set has converged, at least 0; 0 makes all steps.
    /// Any negative number, such as the default -1, selects the tolerance of the method: 0.001, or
    /// with AZULEJO_METHOD_THESIS 0.02 for Delaunay and 0.005 for nearest neighbours.
    pub tolerance: f64,
    /// Called during the call; default NULL: the callback of the context, if it has one.
    pub progress: azulejo_progress_fn,
    /// Passed to the progress callback.
    pub progress_user: *mut c_void,
    /// Neighbours closer than this, in units of d_max, repel each other; above 0, at most 1;
    /// default 0.95.
    pub conflict_radius: f64,
    /// Delaunay neighbours farther apart than this, in units of d_max, attract each other; at least
    /// conflict_radius; default 1.05.
    pub attraction_radius: f64,
    /// The displacement by a tension of 1, in units of d_max; above 0, at most 1; default 0.05.
    pub step: f64,
    /// The factor of `step` from one step to the next; above 0, at most 1; default 1. All steps
    /// together are no longer than step / (1 - decay); from a random start about 10 are needed.
    pub decay: f64,
    /// The number of neighbours of AZULEJO_NEIGHBOURHOOD_NEAREST; at least 1; default 6.
    pub neighbours: u32,
    /// An AZULEJO_DISTRIBUTION_ constant (thesis figure 4.19); default activeness.
    pub distribution: u32,
    /// An AZULEJO_VISITS_ constant; default both ends.
    pub visits: u32,
    /// An AZULEJO_CONVERGENCE_ constant; default motion.
    pub convergence: u32,
}

growing!(azulejo_dcr_options requires domain_max {
    boundary: AZULEJO_BOUNDARY_PERIODIC,
    domain_min: [0.0; 2],
    domain_max: [1.0; 2],
    neighbourhood: AZULEJO_NEIGHBOURHOOD_DELAUNAY,
    method: AZULEJO_METHOD_MOMENTUM,
    max_iterations: 100,
    reserved: 0,
    seed: 0,
    tolerance: -1.0,
    progress: None,
    progress_user: std::ptr::null_mut(),
    conflict_radius: 0.95,
    attraction_radius: 1.05,
    step: 0.05,
    decay: 1.0,
    neighbours: 6,
    distribution: AZULEJO_DISTRIBUTION_ACTIVENESS,
    visits: AZULEJO_VISITS_BOTH_ENDS,
    convergence: AZULEJO_CONVERGENCE_MOTION,
});

/// Writes the defaults. `struct_size` is sizeof *options.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_options_init(
    options: *mut azulejo_dcr_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("options", options, struct_size) }
}

impl azulejo_dcr_options {
    pub(crate) fn watch(&self) -> Watch {
        Watch::new(self.progress, self.progress_user)
    }

    pub(crate) fn request(&self) -> Result<dcr::Options, Failure> {
        let domain = domain(self.domain_min, self.domain_max, self.boundary)?;
        let neighbourhood = neighbourhood(self.neighbourhood)?;
        check_reserved(self.reserved)?;
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
            AZULEJO_METHOD_MOMENTUM => {
                self.check_momentum()?;
                (dcr::Options::new(domain, neighbourhood), Method::Momentum)
            }
            AZULEJO_METHOD_THESIS => (dcr::Options::thesis(domain, neighbourhood), Method::Thesis(thesis)),
            other => return Err(Failure::invalid("method", format!("{other} is no AZULEJO_METHOD_ constant"))),
        };
        let tolerance = if self.tolerance < 0.0 { default.tolerance } else { self.tolerance };
        Ok(default.method(method).max_iterations(self.max_iterations).seed(self.seed).tolerance(tolerance))
    }

    /// Refuses the thesis's settings with the momentum method, unless they are the defaults.
    fn check_momentum(&self) -> Result<(), Failure> {
        let (default, call) = (Self::DEFAULT, "with AZULEJO_METHOD_MOMENTUM");
        check_unused("conflict_radius", self.conflict_radius, default.conflict_radius, call)?;
        check_unused("attraction_radius", self.attraction_radius, default.attraction_radius, call)?;
        check_unused("step", self.step, default.step, call)?;
        check_unused("decay", self.decay, default.decay, call)?;
        check_unused("neighbours", self.neighbours, default.neighbours, call)?;
        check_unused("distribution", self.distribution, default.distribution, call)?;
        check_unused("visits", self.visits, default.visits, call)?;
        check_unused("convergence", self.convergence, default.convergence, call)
    }
}

fn neighbourhood(value: u32) -> Result<Neighbourhood, Failure> {
    match value {
        AZULEJO_NEIGHBOURHOOD_DELAUNAY => Ok(Neighbourhood::Delaunay),
        AZULEJO_NEIGHBOURHOOD_NEAREST => Ok(Neighbourhood::Nearest),
        other => Err(Failure::invalid("neighbourhood", format!("{other} is no AZULEJO_NEIGHBOURHOOD_ constant"))),
    }
}

fn distribution(value: u32) -> Result<Distribution, Failure> {
    match value {
        AZULEJO_DISTRIBUTION_ACTIVENESS => Ok(Distribution::Activeness),
        AZULEJO_DISTRIBUTION_AVERAGE => Ok(Distribution::Average),
        AZULEJO_DISTRIBUTION_DOMINANT => Ok(Distribution::Dominant),
        AZULEJO_DISTRIBUTION_ZERO => Ok(Distribution::Zero),
        AZULEJO_DISTRIBUTION_EIGHTY_TWENTY => Ok(Distribution::EightyTwenty),
        other => Err(Failure::invalid("distribution", format!("{other} is no AZULEJO_DISTRIBUTION_ constant"))),
    }
}

fn visits(value: u32) -> Result<Visits, Failure> {
    match value {
        AZULEJO_VISITS_BOTH_ENDS => Ok(Visits::BothEnds),
        AZULEJO_VISITS_ONE_END => Ok(Visits::OneEnd),
        other => Err(Failure::invalid("visits", format!("{other} is no AZULEJO_VISITS_ constant"))),
    }
}

fn convergence(value: u32) -> Result<Convergence, Failure> {
    match value {
        AZULEJO_CONVERGENCE_MOTION => Ok(Convergence::Motion),
        AZULEJO_CONVERGENCE_VARIANCE => Ok(Convergence::Variance),
        other => Err(Failure::invalid("convergence", format!("{other} is no AZULEJO_CONVERGENCE_ constant"))),
    }
}

/// The set converged, or there was nothing to move. With AZULEJO_METHOD_MOMENTUM and Delaunay
/// neighbours no points are then closer than 0.85 d_max and no circumradius is above 0.67 d_max, up
/// to the last step.
pub const AZULEJO_STOPPED_CONVERGED: u32 = 0;
/// All steps were made.
pub const AZULEJO_STOPPED_STEPS: u32 = 1;
/// The progress callback cancelled the call.
pub const AZULEJO_STOPPED_CANCELLED: u32 = 2;

/// The report of azulejo_dcr_relax and azulejo_dcr_relax_density.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_dcr_report {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// The steps made.
    pub iterations: u32,
    /// Why no more steps were made: an AZULEJO_STOPPED_ constant.
    pub stopped: u32,
    /// Always 0.
    pub reserved: u32,
    /// Half of the distance that points moved, root mean square, in units of d_max: over the last
    /// 10 steps, or with AZULEJO_METHOD_THESIS over the last steps whose sizes add up to 2, so that
    /// it does not depend on the step size.
    pub motion: f64,
    /// The smallest distance between two of the points, in the units of the domain; infinite for
    /// fewer than two points.
    pub smallest_distance: f64,
    /// The smallest distance in units of d_max: about 0.77 for a maximal Poisson-disk set, at most
    /// 1 on a periodic domain; infinite for fewer than two points.
    pub rho: f64,
    /// The covering radius in units of d_max; infinite for no point.
    pub relative_covering_radius: f64,
}

growing!(azulejo_dcr_report requires iterations {
    iterations: 0,
    stopped: 0,
    reserved: 0,
    motion: 0.0,
    smallest_distance: 0.0,
    rho: 0.0,
    relative_covering_radius: 0.0,
});

impl From<Report> for azulejo_dcr_report {
    fn from(report: Report) -> Self {
        let Report { iterations, stopped, motion, smallest_distance, rho, relative_covering_radius, .. } = report;
        let stopped = reason(stopped);
        Self { iterations, stopped, motion, smallest_distance, rho, relative_covering_radius, ..Self::DEFAULT }
    }
}

/// Writes zeros and the size. `struct_size` is sizeof *report.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_report_init(
    report: *mut azulejo_dcr_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}

/// The constant for why no more steps were made.
pub(crate) fn reason(stopped: Stopped) -> u32 {
    match stopped {
        Stopped::Converged => AZULEJO_STOPPED_CONVERGED,
        Stopped::Steps => AZULEJO_STOPPED_STEPS,
        Stopped::Cancelled => AZULEJO_STOPPED_CANCELLED,
    }
}

/// Relaxes a set of points: neighbours that are too close repel each other and holes close, until
/// the set has converged or all steps are made (thesis chapter 4).
///
/// AZULEJO_METHOD_MOMENTUM levels a clustered set before the first step, one in which points are
/// crowded in some places and missing in others: any set ends as a random one does, and after about
/// the same time. A call that makes all steps succeeds whether or not it has converged; the report
/// has the figures.
///
/// With AZULEJO_METHOD_MOMENTUM and Delaunay neighbours the result is, of the set before the first
/// step and the states after whole steps, the one in which the fewest points have a neighbour
/// closer than 0.85 d_max or a Delaunay triangle with a circumradius above 0.67 d_max. Otherwise it
/// is the set after the last whole step. A call that its progress callback cancels succeeds with
/// what there is then, and AZULEJO_STOPPED_CANCELLED in the report.
///
/// positions: the points, x y each, with domain_min <= x < domain_max; `count` of them.
///
/// out: the points, in the same order, to be freed with azulejo_points_free.
///
/// report: what the call did, or NULL.
///
/// O(count) time for each step from evenly spread points. O(count * log count) where the
/// triangulation is built again: in each step of AZULEJO_METHOD_THESIS, and with
/// AZULEJO_METHOD_MOMENTUM while more than 64 points have holes as wide as the domain. A bounded
/// domain takes up to four times the time and memory of a periodic one. O(count) memory.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_relax(
    context: *const azulejo_context,
    options: *const azulejo_dcr_options,
    positions: *const f32,
    count: usize,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_dcr_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let (options, report): (azulejo_dcr_options, _) =
            unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        // SAFETY: handed on from the caller.
        let points = unsafe { rows::<f32, 2>("positions", positions, "count", count) }?;
        let request = options.request()?;
        let (relaxed, done) =
            context.run(options.watch(), |context, progress| dcr::relax(context, &request, points, progress))?;
        if let Some(report) = report {
            report.write(done);
        }
        Ok(azulejo_points::plane(relaxed))
    })
}

/// Relaxes points of several classes, such as those of azulejo_kdrt_sample_classes: the union
/// of all points and each class by itself get more even. They cannot be as even as a set of one
/// class, as a good lattice does not divide into good lattices: from maximal sets of 2 to 7
/// classes of a periodic domain, rho ends above 0.7 and the covering radius below 0.82 d_max,
/// in the union and in each class, where before some covering radii were 1 d_max and more. No
/// distance between points of two classes is promised.
///
/// Only AZULEJO_METHOD_MOMENTUM with AZULEJO_NEIGHBOURHOOD_DELAUNAY. The result is the set
/// after the last whole step; it mostly makes all of them. A class whose points are crowded in
/// some places and missing in others is levelled before the first step. A call that its
/// progress callback cancels succeeds with what there is then, and AZULEJO_STOPPED_CANCELLED in
/// the report.
///
/// positions: the points, x y each, with domain_min <= x < domain_max; `count` of them.
///
/// classes: the class of each point, below class_count; `count` of them.
///
/// class_count: the number of classes, at least 1 and at most AZULEJO_MAX_CLASSES.
///
/// class_rho, class_relative_covering_radius: class_count numbers each, or NULL: `rho` and
/// `relative_covering_radius` of each class, as in the report, in units of the d_max of its own
/// number of points; infinite where a class has fewer than two points, or none.
///
/// out: the points, in the same order, to be freed with azulejo_points_free.
///
/// report: what the call did, with the figures of the union, or NULL.
///
/// About 2.5 times the time of azulejo_dcr_relax, and O(count) memory. Source: the constraints
/// of thesis chapter 4 for each of the sets; several classes after Wei 2010.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_relax_classes(
    context: *const azulejo_context,
    options: *const azulejo_dcr_options,
    positions: *const f32,
    classes: *const u32,
    count: usize,
    class_count: u32,
    class_rho: *mut f64,
    class_relative_covering_radius: *mut f64,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_dcr_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let (options, report): (azulejo_dcr_options, _) =
            unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        // SAFETY: handed on from the caller.
        let points = unsafe { rows::<f32, 2>("positions", positions, "count", count) }?;
        // SAFETY: handed on from the caller.
        let classes = unsafe { rows::<u32, 1>("classes", classes, "count", count) }?.as_flattened();
        check_classes(classes, class_count)?;
        let request = options.request()?.to_delaunay("classes")?;
        let (relaxed, done, each) = context.run(options.watch(), |context, progress| {
            dcr::relax_classes(context, &request, points, classes, progress)
        })?;
        for class in 0..class_count as usize {
            let figures = each.get(class).map_or([f64::INFINITY; 2], |of| [of.rho, of.relative_covering_radius]);
            for (start, figure) in [class_rho, class_relative_covering_radius].into_iter().zip(figures) {
                if !start.is_null() {
                    // SAFETY: the caller has room for `class_count` numbers there.
                    unsafe { start.add(class).write(figure) };
                }
            }
        }
        if let Some(report) = report {
            report.write(done);
        }
        Ok(azulejo_points::plane(relaxed))
    })
}

/// Refuses numbers of classes that are none.
fn check_classes(classes: &[u32], count: u32) -> Result<(), Failure> {
    if !(1..=AZULEJO_MAX_CLASSES).contains(&count) {
        let reason = format!("{count} is not between 1 and {AZULEJO_MAX_CLASSES}");
        return Err(Failure::invalid("class_count", reason));
    }
    match classes.iter().position(|&class| class >= count) {
        Some(index) => Err(Failure::invalid("classes", format!("[{index}] is {}, not below {count}", classes[index]))),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
