//! DCR: relaxation of a point set by distance constraints.

use std::ffi::c_void;

use azulejo_core::dcr::{
    self, Convergence, CorrelationOptions, Distribution, Method, Neighbourhood, PairCorrelation, Report, Stopped,
    Thesis, Visits,
};

use crate::boundary::{self, Out, check_pointer, check_reserved, check_unused, rows};
use crate::classes::AZULEJO_MAX_CLASSES;
use crate::context::azulejo_context;
use crate::domain::{AZULEJO_BOUNDARY_PERIODIC, domain};
use crate::growing::{self, Growing, Output, growing};
use crate::handles;
use crate::points::azulejo_points;
use crate::progress::{Watch, azulejo_progress_fn};
use crate::status::{Failure, azulejo_status};

/// Neighbours by the Delaunay triangulation: they keep their distance and close holes.
pub const AZULEJO_NEIGHBOURHOOD_DELAUNAY: u32 = 0;
/// The nearest points: they only repel.
pub const AZULEJO_NEIGHBOURHOOD_NEAREST: u32 = 1;

/// The momentum method, the default: neighbours in conflict push each other away, holes pull the
/// points around them, points have momentum, and long waves of the density are removed.
pub const AZULEJO_METHOD_MOMENTUM: u32 = 0;
/// The algorithm of thesis chapter 4.
pub const AZULEJO_METHOD_THESIS: u32 = 1;

/// Tension is divided between the ends of an edge by their activeness.
pub const AZULEJO_DISTRIBUTION_ACTIVENESS: u32 = 0;
/// Half of the tension goes to each end.
pub const AZULEJO_DISTRIBUTION_AVERAGE: u32 = 1;
/// All of the tension goes to the neighbour.
pub const AZULEJO_DISTRIBUTION_DOMINANT: u32 = 2;
/// All of the tension goes to the point itself.
pub const AZULEJO_DISTRIBUTION_ZERO: u32 = 3;
/// 80 per cent of the tension goes to the point, 20 to the neighbour.
pub const AZULEJO_DISTRIBUTION_EIGHTY_TWENTY: u32 = 4;

/// An edge is visited from each end that has the other one as a neighbour.
pub const AZULEJO_VISITS_BOTH_ENDS: u32 = 0;
/// An edge is visited from one end, the same in every step, chosen by a hash of the seed and the
/// two points. Points move about half as far in a step.
pub const AZULEJO_VISITS_ONE_END: u32 = 1;

/// A set has converged when the motion falls to the tolerance.
pub const AZULEJO_CONVERGENCE_MOTION: u32 = 0;
/// A set has converged when ten times in succession the variance of the distances to the nearest
/// point changes by less than 0.1 % in a step and more than 99 % of the points move by less than
/// 0.01 d_max (thesis section 4.4.2). Sets of a few hundred points may never do so.
pub const AZULEJO_CONVERGENCE_VARIANCE: u32 = 1;

/// Options of azulejo_dcr_relax, azulejo_dcr_relax_classes, azulejo_dcr_relax_density and
/// azulejo_dcr_scatter; the last one uses only the domain, the boundary, the seed and the progress
/// callback. The fields from `conflict_radius` on are settings of AZULEJO_METHOD_THESIS, with
/// lengths in units of d_max; with AZULEJO_METHOD_MOMENTUM they must have their defaults.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_dcr_options {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// An AZULEJO_BOUNDARY_ constant; default periodic.
    pub boundary: u32,
    /// The lower corner of the domain, x y; default 0 0.
    pub domain_min: [f64; 2],
    /// The upper corner, as in azulejo_plane_set; default 1 1.
    pub domain_max: [f64; 2],
    /// An AZULEJO_NEIGHBOURHOOD_ constant; default Delaunay.
    pub neighbourhood: u32,
    /// An AZULEJO_METHOD_ constant; default momentum.
    pub method: u32,
    /// The largest number of steps; default 100, enough for AZULEJO_METHOD_MOMENTUM from any
    /// points; AZULEJO_METHOD_THESIS may need 1000. 0 returns the points as they are.
    pub max_iterations: u32,
    /// Must be 0.
    pub reserved: u32,
    /// It parts coincident points, and draws the points of azulejo_dcr_scatter and those to which
    /// azulejo_dcr_relax_density moves clustered ones; default 0.
    pub seed: u64,
    /// The motion (see the report) at which the set has converged; 0 makes all steps. Any negative
    /// number, such as the default -1, selects 0.001, or with AZULEJO_METHOD_THESIS 0.02 for
    /// Delaunay and 0.005 for nearest neighbours.
    pub tolerance: f64,
    /// Default NULL: the callback of the context, if it has one.
    pub progress: azulejo_progress_fn,
    /// Passed to the progress callback.
    pub progress_user: *mut c_void,
    /// Neighbours closer than this repel each other; above 0, at most 1; default 0.95.
    pub conflict_radius: f64,
    /// Farther Delaunay neighbours attract each other; at least conflict_radius; default 1.05.
    pub attraction_radius: f64,
    /// The displacement by a tension of 1; above 0, at most 1; default 0.05.
    pub step: f64,
    /// The factor of `step` from one step to the next; above 0, at most 1; default 1. All steps
    /// together are no longer than step / (1 - decay); a random start needs about 10.
    pub decay: f64,
    /// Of AZULEJO_NEIGHBOURHOOD_NEAREST: their number; at least 1; default 6.
    pub neighbours: u32,
    /// An AZULEJO_DISTRIBUTION_ constant (thesis fig. 4.19); default activeness.
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

/// Writes the defaults.
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
/// neighbours no points are closer than 0.85 d_max then, and no circumradius is above 0.67 d_max.
pub const AZULEJO_STOPPED_CONVERGED: u32 = 0;
/// All steps were made.
pub const AZULEJO_STOPPED_STEPS: u32 = 1;
/// The progress callback cancelled the call.
pub const AZULEJO_STOPPED_CANCELLED: u32 = 2;

/// The report of azulejo_dcr_relax, _relax_classes and _relax_density.
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
    /// 10 steps, or with AZULEJO_METHOD_THESIS over the last steps whose sizes add up to 2.
    pub motion: f64,
    /// The smallest distance between two points; infinite for fewer than two.
    pub smallest_distance: f64,
    /// The same in units of d_max: about 0.77 for a maximal Poisson-disk set, at most 1 on a torus.
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

/// Writes zeros and the size.
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
/// the set has converged or all steps are made (thesis chapter 4). AZULEJO_METHOD_MOMENTUM levels a
/// clustered set before the first step: any set ends as a random one, about as soon.
///
/// positions: the points, x y each.
///
/// out: the points, in the same order. With AZULEJO_METHOD_MOMENTUM and Delaunay neighbours, of the
/// states before and after whole steps the one in which the fewest points have a neighbour closer
/// than 0.85 d_max or a Delaunay triangle with a circumradius above 0.67 d_max; otherwise the last.
///
/// O(count) time for each step, O(count * log count) where the triangulation is built again: while
/// more than 64 points have holes as wide as the domain, with AZULEJO_METHOD_THESIS also after
/// steps that turn a triangle over. A bounded domain takes up to four times the time and memory of
/// a periodic one. O(count) memory.
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

/// Relaxes points of several classes, such as those of azulejo_kdrt_sample_classes: the union of
/// all points and each class by itself get more even, though less so than a set of one class. From
/// maximal sets of 2 to 7 classes of a torus, rho ends above 0.7 and the covering radius below 0.82
/// d_max, in the union and in each class. No distance of two classes is promised. A clustered class
/// is levelled before the first step. Only AZULEJO_METHOD_MOMENTUM with
/// AZULEJO_NEIGHBOURHOOD_DELAUNAY. Source: thesis chapter 4, with Wei 2010.
///
/// positions: the points, x y each.
///
/// classes: the class of each point, below class_count.
///
/// class_count: the number of classes, 1 to AZULEJO_MAX_CLASSES.
///
/// class_rho, class_relative_covering_radius: class_count numbers each, or NULL: `rho` and
/// `relative_covering_radius` of each class, in units of its own d_max.
///
/// out: the points after the last whole step, in the same order.
///
/// report: with the figures of the union.
///
/// O(count) memory, and about 2.5 times the time of azulejo_dcr_relax.
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

/// Makes the pair correlation g(r) of sets with a radial mean of the power, for
/// azulejo_dcr_relax_to_correlation: g(r) = 1 + the integral of (P - 1) J0(2 pi frequency r)
/// 2 pi frequency over the frequencies, r in units of 1 / sqrt(density) (Heck et al. 2013).
///
/// power: `count` numbers, 1 to 65536, at least 0: the power in bins of equal width from frequency
/// 0 to `highest`, in units of sqrt(density); beyond it is 1. One 0 is step noise.
///
/// reach: where the last bin of `out` ends, above 0, in units of d_max: 12 is enough.
///
/// out: an array of `bins` numbers, 1 to 65536: g in the middles of bins of equal width from 0 to
/// `reach`. Bins of 0.05 or less show all that is matched.
///
/// O(count * bins) time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_correlation_of_power(
    highest: f64,
    power: *const f64,
    count: usize,
    reach: f64,
    bins: usize,
    out: *mut f64,
) -> azulejo_status {
    boundary::call(|| {
        check_pointer("out", out)?;
        // SAFETY: handed on from the caller.
        let power = unsafe { rows::<f64, 1>("power", power, "count", count) }?.as_flattened();
        let correlation = PairCorrelation::of_power(highest, power, reach, bins)?;
        // SAFETY: the caller has room for `bins` numbers there, as many as were asked for.
        unsafe { out.copy_from_nonoverlapping(correlation.values().as_ptr(), bins) };
        Ok(())
    })
}

/// Moves points of a periodic domain until their pair correlation g(r), and with it the radial mean
/// of their power, is the one wanted: general spectra (thesis eq. 4.3, 4.4 and 5.2; Heck et al.
/// 2013). Random points are a good start; a clustered set is levelled first. Method and
/// neighbourhood must have their defaults; `tolerance` is that of the residual, by default 0.005.
///
/// positions: the points, x y each.
///
/// reach: where the last bin ends, above 0, in units of d_max. Correlations are matched up to this,
/// 11.2 d_max and 0.42 of the shorter period, whichever is least.
///
/// correlation: `bins` finite numbers, 1 to 65536: g in bins of equal width from 0 to `reach`, as
/// azulejo_plane_radial_distribution measures it (times (n - 1) / n for n points, to the last) or
/// azulejo_dcr_correlation_of_power makes it.
///
/// residual: a number, or NULL: the root mean square, over frequencies up to 2 sqrt(density), of the
/// difference of the power and the one wanted, both smoothed over about 1 / reach; 0 for fewer than
/// two points.
///
/// out: of the states, the one with the least residual, in the order of the positions. A
/// correlation that no set has is no error: `stopped` is not AZULEJO_STOPPED_CONVERGED then.
///
/// O(count * reach^2) time for each step, O(count) memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_relax_to_correlation(
    context: *const azulejo_context,
    options: *const azulejo_dcr_options,
    positions: *const f32,
    count: usize,
    reach: f64,
    correlation: *const f64,
    bins: usize,
    residual: *mut f64,
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
        let correlation = unsafe { rows::<f64, 1>("correlation", correlation, "bins", bins) }?.as_flattened();
        let target = PairCorrelation::new(reach, correlation)?;
        let steps = options.request()?.to_delaunay("pair correlations")?;
        let request = CorrelationOptions::new(steps.domain).max_iterations(steps.max_iterations).seed(steps.seed);
        let tolerance = if options.tolerance < 0.0 { request.tolerance } else { options.tolerance };
        let request = request.tolerance(tolerance);
        let (relaxed, done) = context.run(options.watch(), |context, progress| {
            dcr::relax_to_correlation(context, &request, points, &target, progress)
        })?;
        if !residual.is_null() {
            // SAFETY: the caller has room for a number there.
            unsafe { residual.write(done.residual) };
        }
        if let Some(report) = report {
            report.write(done.set);
        }
        Ok(azulejo_points::plane(relaxed))
    })
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
