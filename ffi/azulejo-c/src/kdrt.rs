//! KDRT: massive maximal Poisson-disk sets in the plane, by radius or by number.

use std::ffi::c_void;
use std::ops::ControlFlow;
use std::time::Instant;

use azulejo_core::analysis::coverage::covering_radius_2d;
use azulejo_core::kdrt::{self, CountOptions, Kind, Plane, Progressive};
use azulejo_core::{Classes, Domain, Given, Order, Points};

use crate::boundary::{self, Out, check_unused, flag, pair, required};
use crate::context::azulejo_context;
use crate::domain::{AZULEJO_BOUNDARY_PERIODIC, domain};
use crate::given::given_by_class;
use crate::growing::{self, Growing, Output, growing};
use crate::handles;
use crate::order::{AZULEJO_ORDER_ANY, order};
use crate::points::azulejo_points;
use crate::progress::{Watch, azulejo_progress_fn};
use crate::status::{Failure, azulejo_status};

/// Options of azulejo_kdrt_sample, _sample_window, _stream, _create and _create_wide, and with
/// classes of azulejo_kdrt_sample_classes and _create_classes.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_kdrt_options {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// An AZULEJO_BOUNDARY_ constant; default periodic.
    pub boundary: u32,
    /// The smallest distance between two samples: above 0, and at least 64 float spacings; it has
    /// no default. Must be 0 with a `count` and in calls with classes.
    pub radius: f64,
    /// The lower corner of the domain, x y; default 0 0.
    pub domain_min: [f64; 2],
    /// The upper corner, as in azulejo_plane_set; default 1 1.
    pub domain_max: [f64; 2],
    /// The shortest side of the leaves that tile the domain, in radii; at least 6, default 20.
    /// Larger leaves are faster, but need a larger pattern.
    pub leaf_size: f64,
    /// Any number; another seed gives another set. Default 0.
    pub seed: u64,
    /// Default NULL: the callback of the context, if it has one.
    pub progress: azulejo_progress_fn,
    /// Passed to the progress callback.
    pub progress_user: *mut c_void,
    /// The exact number of samples; default 0: as many as the radius gives. Only for whole sets.
    pub count: usize,
    /// 1: azulejo_kdrt_sample measures the `covering_radius` of its report, which takes much longer
    /// than the sampling. Default 0. Must be 0 with the report NULL, and in other calls.
    pub measure_covering_radius: u32,
    /// An AZULEJO_ORDER_ constant; default any. Must be any for streams.
    pub order: u32,
    /// 1.02 to 1.5; default 0: see "Order". Windows are faster with 2^(1/4).
    pub quotient: f64,
    /// Of a progressive order: the radius of the coarsest level, at least `radius`. Default 0: the
    /// first level has one sample. Scattered windows of large domains are faster with 16 radii.
    pub coarsest: f64,
    /// Default NULL: see "Given samples"; none with a `count`.
    pub given_positions: *const f32,
    /// The clearance of each; default NULL.
    pub given_clearances: *const f64,
    /// The number of given samples; default 0.
    pub given_count: usize,
}

growing!(azulejo_kdrt_options requires radius {
    boundary: AZULEJO_BOUNDARY_PERIODIC,
    radius: 0.0,
    domain_min: [0.0; 2],
    domain_max: [1.0; 2],
    leaf_size: kdrt::DEFAULT_LEAF_SIZE,
    seed: 0,
    progress: None,
    progress_user: std::ptr::null_mut(),
    count: 0,
    measure_covering_radius: 0,
    order: AZULEJO_ORDER_ANY,
    quotient: 0.0,
    coarsest: 0.0,
    given_positions: std::ptr::null(),
    given_clearances: std::ptr::null(),
    given_count: 0,
});

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_options_init(
    options: *mut azulejo_kdrt_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("options", options, struct_size) }
}

/// The report of azulejo_kdrt_sample, _sample_window, _stream and azulejo_maximal_sample.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_kdrt_report {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// 1 if the set, of which a window has a part, is maximal for `radius`, else 0.
    pub is_maximal: u32,
    /// The number of samples; the `count` of the options if there is one.
    pub samples: u64,
    /// The radius of the options, or the one found for the count. No two samples are closer.
    pub radius: f64,
    /// The covering radius, if the options have `measure_covering_radius`; else -1.
    pub covering_radius: f64,
    /// Wall time in seconds, without measuring `covering_radius`.
    pub seconds: f64,
}

growing!(azulejo_kdrt_report requires samples {
    is_maximal: 0,
    samples: 0,
    radius: 0.0,
    covering_radius: 0.0,
    seconds: 0.0,
});

/// The report of a number of samples of a maximal set, whose coverage is not measured.
pub(crate) fn of_samples(count: usize, radius: f64) -> azulejo_kdrt_report {
    azulejo_kdrt_report {
        is_maximal: 1,
        samples: count as u64,
        radius,
        covering_radius: -1.0,
        ..azulejo_kdrt_report::DEFAULT
    }
}

/// Writes zeros and the size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_report_init(
    report: *mut azulejo_kdrt_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}

/// Makes a maximal, conflict-free set of samples of a rectangle: about 0.6966 * area / radius^2, or
/// exactly `count`. Tiles clips of one small pattern over a random kd-tree and repairs the seams
/// (thesis chapter 2). A domain with less area than the pattern, or narrower than 13 radii, is not
/// tiled: it gets the set of azulejo_maximal_sample.
///
/// With a count, small regions of a set of about that many samples are made again until the number
/// is right. If that fails, which is rare, crowded samples of a larger set are dropped:
/// `is_maximal` is 0.
///
/// In progressive order the set consists of nested maximal sets, coarse to fine, sorted by falling
/// rank. Sets of one domain, quotient, coarsest radius and seed share their levels: by default a
/// set is a prefix of those of half its radius, a quarter and so on, bit for bit, and with a count
/// of those with a larger one. Then `radius` in the report is the last rank, `is_maximal` 0.
///
/// O(samples) time, and 24 bytes of memory per sample; with a count about twice as much, in
/// progressive order 64 bytes and about fifteen times the time, more with a smaller quotient;
/// O(samples * log samples) to measure the covering radius.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for a count whose radius is below 64 float spacings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_sample(
    context: *const azulejo_context,
    options: *const azulejo_kdrt_options,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_kdrt_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let (options, report) = unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        let measured = options.measures_covering_radius()?;
        if measured && report.is_none() {
            return Err(Failure::invalid("measure_covering_radius", "1, but report is NULL"));
        }
        let start = Instant::now();
        let sampling = if measured { SAMPLING_SHARE } else { 1.0 };
        let (set, radius, is_maximal) = options.sample(context, options.watch().part(0.0, sampling))?;
        let seconds = start.elapsed().as_secs_f64();
        let covering_radius = if measured { options.measured_radius(context, &set.positions)? } else { -1.0 };
        if let Some(report) = report {
            let is_maximal = is_maximal.into();
            report.write(azulejo_kdrt_report { is_maximal, covering_radius, seconds, ..of_samples(set.len(), radius) });
        }
        Ok(azulejo_points::plane(set))
    })
}

/// The fraction of a call that is sampling, if coverage is measured, which takes longer.
const SAMPLING_SHARE: f64 = 0.05;

/// The share of the progress of a stream that its plane takes.
const PATTERN_SHARE: f64 = 0.05;

/// Makes the part of a set of azulejo_kdrt_sample that lies in a window of the domain, and no more:
/// the same floats in the same order, with the same ranks. Windows that partition the domain have
/// every sample once, by threads, processes and machines that do not communicate. For many windows
/// of one plane, azulejo_kdrt_create makes the pattern once.
///
/// options: those of the whole set, with a radius.
///
/// window_min, window_max: the corners, x y each, with domain_min <= window_min < window_max <=
/// domain_max, of the samples with window_min <= x < window_max. May contain no sample.
///
/// O(samples in the window and within 22 radii along x and 18 along y) time and memory, and the
/// making of the pattern, of about 28,000 samples with the default leaves. In progressive order
/// each level, of radius R, adds about 12 R to the margin: in all about 56,000 samples at a
/// quotient of 2^(1/8) or 15,000 at 2^(1/4) for each level. A domain without tiles is made whole.
///
/// Errors: AZULEJO_ERROR_TOO_LARGE counts the samples of the window only; the domain may have as
/// many as floats can carry, up to about 10^11.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_sample_window(
    context: *const azulejo_context,
    options: *const azulejo_kdrt_options,
    window_min: *const f64,
    window_max: *const f64,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_kdrt_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let (options, report) = unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        // SAFETY: handed on from the caller.
        let (min, max) = unsafe { (pair("window_min", window_min)?, pair("window_max", window_max)?) };
        let start = Instant::now();
        let request = options.by_radius_only()?;
        let samples = context
            .run(options.watch(), |context, progress| kdrt::sample_window(context, &request, min, max, progress))?;
        if let Some(report) = report {
            let seconds = start.elapsed().as_secs_f64();
            report.write(azulejo_kdrt_report { seconds, ..of_samples(samples.len(), options.radius) });
        }
        Ok(azulejo_points::plane(samples))
    })
}

/// Called with a part of a set. Returns 0 to continue, any other value to cancel the call.
///
/// user: the `user` of the call.
///
/// positions: at least one sample, x y each, valid until the callback returns.
pub type azulejo_kdrt_visit_fn =
    Option<unsafe extern "C-unwind" fn(user: *mut c_void, positions: *const f32, count: usize) -> u32>;

/// Makes the set of azulejo_kdrt_sample and passes it to a callback part by part, in its order,
/// instead of keeping it: up to about 10^11 samples, as many as floats can carry.
///
/// options: those of the whole set, with a radius and in any order.
///
/// visit: gets parts of at most about 50,000 samples, the same ones for every number of threads.
/// While it runs on the calling thread, the others make the next parts. It can cancel the call.
///
/// O(samples) time; memory for the pattern and at most 8 parts per thread. A domain that is not
/// tiled is made as a whole and is one part.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_stream(
    context: *const azulejo_context,
    options: *const azulejo_kdrt_options,
    visit: azulejo_kdrt_visit_fn,
    user: *mut c_void,
    report: *mut azulejo_kdrt_report,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let (options, report) = unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        let request = options.by_radius_only()?;
        let visit = required("visit", visit)?;
        if !matches!(request.kind, Kind::Plain(_)) {
            return Err(Failure::invalid("order", "a stream comes place by place, in no progressive order"));
        }
        let (start, mut count) = (Instant::now(), 0);
        let visit = |samples: &[[f32; 2]]| {
            count += samples.len();
            // SAFETY: the caller gave the two for each other, to be called on this thread during this call.
            match unsafe { visit(user, samples.as_ptr().cast(), samples.len()) } {
                0 => ControlFlow::Continue(()),
                _ => ControlFlow::Break(()),
            }
        };
        let (made, streamed) = (options.watch().part(0.0, PATTERN_SHARE), options.watch().part(PATTERN_SHARE, 1.0));
        let plane = context.run(made, |context, progress| Plane::new(context, &request, progress))?;
        context.run(streamed, |context, progress| plane.stream(context, visit, progress))?;
        if let Some(report) = report {
            let seconds = start.elapsed().as_secs_f64();
            report.write(azulejo_kdrt_report { seconds, ..of_samples(count, options.radius) });
        }
        Ok(())
    })
}

impl azulejo_kdrt_options {
    /// The flags, of which one is to be set.
    fn measures_covering_radius(&self) -> Result<bool, Failure> {
        flag("measure_covering_radius", self.measure_covering_radius)
    }

    /// The covering radius of the samples, as the last part of the call.
    fn measured_radius(&self, context: &azulejo_context, samples: &[[f32; 2]]) -> Result<f64, Failure> {
        let domain = self.domain()?;
        let watch = self.watch().part(SAMPLING_SHARE, 1.0);
        context.run(watch, |context, progress| covering_radius_2d(context, &domain, samples, progress))
    }

    /// The samples, their radius and whether they are maximal for it.
    fn sample(&self, context: &azulejo_context, watch: Watch) -> Result<(Points<2>, f64, bool), Failure> {
        let &Self { radius, leaf_size, seed, count, .. } = self;
        if count == 0 {
            let request = self.by_radius()?;
            let samples = context.run(watch, |context, progress| kdrt::sample(context, &request, progress))?;
            return Ok((samples, radius, true));
        }
        if radius != 0.0 {
            let reason = format!("{count} samples and radius {radius:?} are asked for at once; one of them must be 0");
            return Err(Failure::invalid("count", reason));
        }
        check_unused("given_count", self.given_count, 0, "with a count")?;
        let request = CountOptions::new(count as u64).domain(self.domain()?).leaf_size(leaf_size).seed(seed);
        let request = request.levels(self.levels()?);
        let (points, report) =
            context.run(watch, |context, progress| kdrt::sample_count(context, &request, progress))?;
        Ok((points, report.radius, report.is_maximal))
    }

    /// The options of calls that cannot have a count.
    pub(crate) fn by_radius_only(&self) -> Result<kdrt::Options<'_>, Failure> {
        if self.count != 0 {
            let reason = format!("{} is not 0; windows and streams are made by radius, not by number", self.count);
            return Err(Failure::invalid("count", reason));
        }
        if self.measures_covering_radius()? {
            return Err(Failure::invalid(
                "measure_covering_radius",
                "1 is not 0; windows and streams are not measured",
            ));
        }
        self.by_radius()
    }

    /// The options of calls with classes, which have their own radii.
    pub(crate) fn with_classes<'a>(&'a self, classes: &'a Classes) -> Result<kdrt::Options<'a>, Failure> {
        check_unused("radius", self.radius, 0.0, "with classes")?;
        check_unused("count", self.count, 0, "with classes")?;
        check_unused("measure_covering_radius", self.measures_covering_radius()?, false, "with classes")?;
        let kind = match self.levels()? {
            None => Kind::Classes(classes),
            Some(levels) => Kind::ProgressiveClasses(classes, levels),
        };
        self.request(kind, self.given(classes.count())?)
    }

    fn by_radius(&self) -> Result<kdrt::Options<'_>, Failure> {
        let kind = match self.levels()? {
            None => Kind::Plain(self.radius),
            Some(levels) => Kind::Progressive(self.radius, levels),
        };
        self.request(kind, self.given(1)?)
    }

    /// The options of a set around given samples.
    fn request<'a>(&'a self, kind: Kind<'a>, given: Given<'a, 2>) -> Result<kdrt::Options<'a>, Failure> {
        let request = kdrt::Options::of(kind).domain(self.domain()?).leaf_size(self.leaf_size).seed(self.seed);
        Ok(request.given(given))
    }

    /// The given samples, with a clearance for each of a number of classes.
    fn given(&self, classes: usize) -> Result<Given<'_, 2>, Failure> {
        // SAFETY: the caller's word, for as long as the call.
        unsafe { given_by_class(self.given_positions, self.given_clearances, self.given_count, classes) }
    }

    /// The levels of a progressive order; none in any order, which must not have settings of one.
    fn levels(&self) -> Result<Option<Progressive>, Failure> {
        let &Self { quotient, coarsest, .. } = self;
        if order(self.order)? == Order::Any {
            check_unused("quotient", quotient, 0.0, "in any order")?;
            check_unused("coarsest", coarsest, 0.0, "in any order")?;
            return Ok(None);
        }
        let levels = Progressive::new();
        let levels = if quotient == 0.0 { levels } else { levels.quotient(quotient) };
        Ok(Some(if coarsest == 0.0 { levels } else { levels.coarsest(coarsest) }))
    }

    fn domain(&self) -> Result<Domain, Failure> {
        domain(self.domain_min, self.domain_max, self.boundary)
    }

    pub(crate) fn watch(&self) -> Watch {
        Watch::new(self.progress, self.progress_user)
    }
}
