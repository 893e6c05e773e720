//! KDRT: massive maximal Poisson-disk sets in the plane, by radius or by number.

use std::ffi::c_void;
use std::mem::MaybeUninit;
use std::ops::ControlFlow;
use std::time::Instant;

use azulejo_core::Domain;
use azulejo_core::analysis::coverage::covering_radius_2d;
use azulejo_core::kdrt::{self, CountOptions, Counted};

use crate::boundary::{self, check_reserved, flag, pair, required};
use crate::context::azulejo_context;
use crate::domain::{AZULEJO_BOUNDARY_PERIODIC, domain};
use crate::growing::{self, Growing, Output, growing};
use crate::points::azulejo_points;
use crate::progress::{Watch, azulejo_progress_fn};
use crate::status::{Failure, azulejo_status};

/// Options of azulejo_kdrt_sample, azulejo_kdrt_sample_window, azulejo_kdrt_stream and
/// azulejo_kdrt_create.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_kdrt_options {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// An AZULEJO_BOUNDARY_ constant; default periodic.
    pub boundary: i32,
    /// The smallest distance between two samples, in the units of the domain: above 0, and at least
    /// 64 times the spacing of floats at the largest coordinate. It has no default. Must be 0 if
    /// there is a `count`, from which the radius follows.
    pub radius: f64,
    /// The lower corner of the domain, x y; finite; default 0 0.
    pub domain_min: [f64; 2],
    /// The upper corner of the domain, x y; finite and above the lower corner on both axes; default
    /// 1 1. Neither side may be longer than 2^100 times the other.
    pub domain_max: [f64; 2],
    /// The shortest side of the leaves that tile the domain, in radii; at least 6, default 20.
    /// Sides are random, up to twice as long. Larger leaves are faster and have fewer seams, but
    /// need a larger pattern.
    pub leaf_size: f64,
    /// Any number; another seed gives another set. Default 0.
    pub seed: u64,
    /// Called during the call; default NULL: the callback of the context, if it has one.
    pub progress: azulejo_progress_fn,
    /// Passed to the progress callback.
    pub progress_user: *mut c_void,
    /// The exact number of samples; default 0: as many as the radius gives. Must be 0 for windows,
    /// streams and planes that are kept, which are made by radius.
    pub count: usize,
    /// 1: azulejo_kdrt_sample measures the `coverage` in its report, which takes much longer than
    /// the sampling. Default 0. Must be 0 where there is no report: with the report NULL, and in
    /// other calls.
    pub measure_coverage: u32,
    /// Must be 0.
    pub reserved: u32,
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
    measure_coverage: 0,
    reserved: 0,
});

/// Writes the defaults. `struct_size` is sizeof *options.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_options_init(
    options: *mut azulejo_kdrt_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("options", options, struct_size) }
}

/// What azulejo_kdrt_sample achieved.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_kdrt_report {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// 1 if the set is maximal for `radius`, else 0.
    pub is_maximal: u32,
    /// The number of samples; the `count` of the options if there is one.
    pub samples: u64,
    /// The radius, that of the options or the one found for the count, in the units of the domain.
    /// No two samples are closer.
    pub radius: f64,
    /// The covering radius as azulejo_plane_covering_radius measures it, in the units of the
    /// domain, if the options have `measure_coverage`; else -1.
    pub coverage: f64,
    /// Wall time in seconds, without the measuring of `coverage`.
    pub seconds: f64,
}

growing!(azulejo_kdrt_report requires samples {
    is_maximal: 0,
    samples: 0,
    radius: 0.0,
    coverage: 0.0,
    seconds: 0.0,
});

/// Writes zeros and the size. `struct_size` is sizeof *report.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_report_init(
    report: *mut azulejo_kdrt_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}

/// Makes a maximal, conflict-free set of samples of a rectangle: about 0.6966 * area / radius^2 of
/// them, or exactly `count`.
///
/// Tiles clips of one small pattern over a random kd-tree and repairs the seams (thesis chapter 2).
/// Its only bias is at the seams. A domain with less area than the pattern, or narrower than 13
/// radii, is not tiled: it gets the set of azulejo_maximal_sample. A radius longer than the
/// diagonal of the domain gives one sample.
///
/// With a count, the radius follows from the density of maximal sets. The samples by which that set
/// differs from the count, mostly a few per thousand, are corrected by making small regions again,
/// so the set is still conflict-free and maximal. If no maximal set of exactly that many samples is
/// found, which is rare, the most crowded samples of a larger set are dropped and `is_maximal` is
/// 0.
///
/// options: with a radius or a count, not both.
///
/// out: the samples, x y each, to be freed with azulejo_points_free. With a count, samples that
/// were made again take the places of others in the order.
///
/// report: what the call achieved, or NULL. It costs nothing unless `measure_coverage` is 1; then
/// progress includes the measuring.
///
/// O(samples) time, and 24 bytes of memory per sample; with a count about twice as much. Measuring
/// the coverage takes O(samples * log samples).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for a radius (or a count whose radius is) below 64
/// times the spacing of floats at the largest coordinate; AZULEJO_ERROR_TOO_LARGE, with the
/// estimate, for 2^32 samples or more, or more than memory holds; AZULEJO_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_sample(
    context: Option<&azulejo_context>,
    options: *const azulejo_kdrt_options,
    out: Option<&mut MaybeUninit<Box<azulejo_points>>>,
    report: *mut azulejo_kdrt_report,
) -> azulejo_status {
    boundary::create(out, || {
        let context = required("context", context)?;
        // SAFETY: handed on from the caller.
        let (options, report) = unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        let measured = options.measures_coverage()?;
        if measured && report.is_none() {
            return Err(Failure::invalid("measure_coverage", "1, but report is NULL"));
        }
        let start = Instant::now();
        let sampling = if measured { SAMPLING_SHARE } else { 1.0 };
        let (samples, radius, is_maximal) = options.sample(context, options.watch().part(0.0, sampling))?;
        let seconds = start.elapsed().as_secs_f64();
        let coverage = if measured { options.coverage(context, &samples)? } else { -1.0 };
        if let Some(report) = report {
            report.write(azulejo_kdrt_report {
                is_maximal: is_maximal.into(),
                samples: samples.len() as u64,
                radius,
                coverage,
                seconds,
                ..azulejo_kdrt_report::DEFAULT
            });
        }
        Ok(azulejo_points::plane(samples))
    })
}

/// What fraction of a call is the sampling where coverage is measured, which takes longer.
const SAMPLING_SHARE: f64 = 0.05;

/// Makes the part of a set of azulejo_kdrt_sample that lies in a window of the domain, without
/// making the rest: the same floats in the same order.
///
/// Windows that partition the domain have every sample once, and can be made in any order, by
/// threads, processes and machines that do not communicate. The samples in a window depend on
/// nothing farther from it than 22 radii along x and 18 along y.
///
/// options: those of the whole set, with a radius.
///
/// window_min, window_max: the corners, x y each, with domain_min <= window_min < window_max <=
/// domain_max. The window has the samples with window_min <= x < window_max. It may be smaller than
/// the radius and may contain no sample.
///
/// out: the samples, x y each, to be freed with azulejo_points_free.
///
/// O(samples in and around the window) time and memory, and in every call the making of the
/// pattern, of about 28,000 samples with the default leaves: for many windows of one plane,
/// azulejo_kdrt_create makes it once. A domain that is not tiled is made as a whole.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT as azulejo_kdrt_sample; AZULEJO_ERROR_TOO_LARGE for the
/// samples of the window, while the domain may have as many as floats can carry, up to about 10^11;
/// AZULEJO_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_sample_window(
    context: Option<&azulejo_context>,
    options: *const azulejo_kdrt_options,
    window_min: *const f64,
    window_max: *const f64,
    out: Option<&mut MaybeUninit<Box<azulejo_points>>>,
) -> azulejo_status {
    boundary::create(out, || {
        let context = required("context", context)?;
        // SAFETY: handed on from the caller.
        let (options, min, max) = unsafe {
            (growing::read("options", options)?, pair("window_min", window_min)?, pair("window_max", window_max)?)
        };
        let request = options.by_radius_only()?;
        let samples = context
            .run(options.watch(), |context, progress| kdrt::sample_window(context, &request, min, max, progress))?;
        Ok(azulejo_points::plane(samples))
    })
}

/// Called with a part of a set, on the thread that made the call. See "Callbacks" at the top.
///
/// user: the `user` of the call.
///
/// xy: the samples, x y each, valid until the callback returns; `count` of them, at least one.
///
/// Returns 0 to continue, any other value to cancel the call.
pub type azulejo_kdrt_visit_fn =
    Option<unsafe extern "C-unwind" fn(user: *mut c_void, xy: *const f32, count: usize) -> i32>;

/// Makes the set of azulejo_kdrt_sample and passes it to a callback part by part, in its order,
/// instead of keeping it: for sets of any size that are written or consumed at once.
///
/// options: those of the whole set, with a radius.
///
/// visit: gets the parts: windows at most about 270 radii wide, of at most about 50,000 samples,
/// the same ones for every number of threads. While it runs on the calling thread, the threads of
/// the context make the next parts.
///
/// user: passed to `visit`.
///
/// O(samples) time; memory for the pattern and at most 8 parts per thread. A domain that is not
/// tiled is made as a whole and is one part.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT as azulejo_kdrt_sample, so for more samples than floats
/// can carry, about 10^11; AZULEJO_ERROR_TOO_LARGE for a domain that is not tiled;
/// AZULEJO_ERROR_CANCELLED, also if `visit` cancels.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_stream(
    context: Option<&azulejo_context>,
    options: *const azulejo_kdrt_options,
    visit: azulejo_kdrt_visit_fn,
    user: *mut c_void,
) -> azulejo_status {
    boundary::call(|| {
        let context = required("context", context)?;
        // SAFETY: handed on from the caller.
        let options = unsafe { growing::read("options", options) }?;
        let request = options.by_radius_only()?;
        let visit = required("visit", visit)?;
        let visit = |samples: &[[f32; 2]]| {
            // SAFETY: the caller gave the two for each other, to be called on this thread during this call.
            match unsafe { visit(user, samples.as_ptr().cast(), samples.len()) } {
                0 => ControlFlow::Continue(()),
                _ => ControlFlow::Break(()),
            }
        };
        context.run(options.watch(), |context, progress| kdrt::sample_stream(context, &request, visit, progress))
    })
}

impl azulejo_kdrt_options {
    /// The flags, of which one is to be set.
    fn measures_coverage(&self) -> Result<bool, Failure> {
        check_reserved(self.reserved)?;
        flag("measure_coverage", self.measure_coverage)
    }

    /// The covering radius of the samples, as the last part of the call.
    fn coverage(&self, context: &azulejo_context, samples: &[[f32; 2]]) -> Result<f64, Failure> {
        let domain = self.domain()?;
        let watch = self.watch().part(SAMPLING_SHARE, 1.0);
        context.run(watch, |context, progress| covering_radius_2d(context, &domain, samples, progress))
    }

    /// The samples, their radius and whether they are maximal for it.
    fn sample(&self, context: &azulejo_context, watch: Watch) -> Result<(Vec<[f32; 2]>, f64, bool), Failure> {
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
        let request = CountOptions::new(count as u64).domain(self.domain()?).leaf_size(leaf_size).seed(seed);
        let Counted { samples, report, .. } =
            context.run(watch, |context, progress| kdrt::sample_count(context, &request, progress))?;
        Ok((samples, report.radius, report.is_maximal))
    }

    /// The options of calls that cannot have a count.
    pub(crate) fn by_radius_only(&self) -> Result<kdrt::Options, Failure> {
        if self.count != 0 {
            let reason = format!("{} is not 0; windows and streams are made by radius, not by number", self.count);
            return Err(Failure::invalid("count", reason));
        }
        if self.measures_coverage()? {
            return Err(Failure::invalid("measure_coverage", "1 is not 0; windows and streams have no report"));
        }
        self.by_radius()
    }

    fn by_radius(&self) -> Result<kdrt::Options, Failure> {
        let &Self { radius, leaf_size, seed, .. } = self;
        Ok(kdrt::Options::new(radius).domain(self.domain()?).leaf_size(leaf_size).seed(seed))
    }

    fn domain(&self) -> Result<Domain, Failure> {
        domain(self.domain_min, self.domain_max, self.boundary)
    }

    pub(crate) fn watch(&self) -> Watch {
        Watch::new(self.progress, self.progress_user)
    }
}
