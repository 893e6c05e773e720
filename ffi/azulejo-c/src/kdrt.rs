//! KDRT: massive maximal Poisson-disk sets in the plane, by radius or by number.

use std::ffi::c_void;
use std::mem::MaybeUninit;
use std::ops::ControlFlow;
use std::time::Instant;

use azulejo_core::Domain;
use azulejo_core::analysis::coverage::covering_radius_2d;
use azulejo_core::kdrt::{self, CountOptions, Counted};

use crate::boundary::{self, pair, required};
use crate::context::azulejo_context;
use crate::domain::{AZULEJO_BOUNDARY_PERIODIC, domain};
use crate::options::{self, Watch, azulejo_progress_fn, options};
use crate::points::azulejo_points;
use crate::status::{Failure, azulejo_status};

/// Options of azulejo_kdrt_sample, azulejo_kdrt_sample_with_report, azulejo_kdrt_sample_window and azulejo_kdrt_stream.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_kdrt_options {
    /// The size of the caller's struct in bytes; set by the init function.
    pub struct_size: u32,
    /// An AZULEJO_BOUNDARY_ constant; periodic by default.
    pub boundary: i32,
    /// The smallest distance between two samples, in the units of the domain. Above 0; there is no default. With a
    /// count it must be 0: the radius follows.
    pub radius: f64,
    /// The lower corner of the domain, x y; 0 0 by default.
    pub domain_min: [f64; 2],
    /// The upper corner of the domain, above the lower one on both axes; 1 1 by default.
    pub domain_max: [f64; 2],
    /// The shortest side of the leaves that tile the domain, in radii: at least 6, by default 20; sides are random, up
    /// to twice this. Larger leaves are faster and have fewer seams, but need a larger pattern.
    pub leaf_size: f64,
    /// Any number; another seed gives another set.
    pub seed: u64,
    /// Called during the call, unless NULL, which is the default.
    pub progress: azulejo_progress_fn,
    /// Handed to the progress callback.
    pub progress_user: *mut c_void,
    /// How many samples there shall be, exactly; 0, the default, takes as many as the radius gives. Windows and streams
    /// need a radius.
    pub count: u64,
}

options!(azulejo_kdrt_options requires radius {
    boundary: AZULEJO_BOUNDARY_PERIODIC,
    radius: 0.0,
    domain_min: [0.0; 2],
    domain_max: [1.0; 2],
    leaf_size: kdrt::DEFAULT_LEAF_SIZE,
    seed: 0,
    progress: None,
    progress_user: std::ptr::null_mut(),
    count: 0,
});

/// What a call achieved.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_kdrt_report {
    /// The number of samples: the count, if there was one.
    pub samples: u64,
    /// The radius: that of the options, or the one that was found for the count. No two samples are closer.
    pub radius: f64,
    /// The covering radius: the farthest that any place of the domain is from all samples, as
    /// azulejo_plane_covering_radius measures it.
    pub coverage: f64,
    /// Wall time, without the measuring of `coverage`.
    pub seconds: f64,
    /// 1 if the set is maximal for `radius`, else 0.
    pub is_maximal: i32,
    /// Zeros, for later versions.
    pub reserved: [u32; 7],
}

/// Writes the defaults. `struct_size` is sizeof *options.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_options_init(
    options: *mut azulejo_kdrt_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { options::init(options, struct_size) }
}

/// Makes a maximal, conflict-free set of samples of a rectangle: about 0.7 * area / radius^2 of them, or exactly as
/// many as the count in the options says (then see azulejo_kdrt_sample_with_report, which tells the radius).
///
/// Tiles clips of one small pattern over a random kd-tree and repairs the seams (thesis chapter 2) with all threads of
/// the context: O(samples) time and 24 bytes per sample. Its only bias is at the seams. A domain of less area than the
/// pattern, or narrower than 13 radii, is not tiled: it gets what azulejo_maximal_sample makes. A radius longer than
/// the diagonal of the domain gives one sample.
///
/// out: the samples, x y each, to be freed with azulejo_points_free.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also where floats are too coarse to carry the radius (their spacing at the
/// largest coordinate is above radius / 64); AZULEJO_ERROR_TOO_LARGE, with the estimate, above 2^32 samples or the
/// memory that is available; AZULEJO_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_sample(
    context: Option<&azulejo_context>,
    options: *const azulejo_kdrt_options,
    out: Option<&mut MaybeUninit<Box<azulejo_points>>>,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { azulejo_kdrt_sample_with_report(context, options, out, None) }
}

/// azulejo_kdrt_sample, and what it achieved.
///
/// With a count the radius follows from the density of maximal sets. The samples by which the set then differs from the
/// count, mostly a few of a thousand, are set right by making small places anew, so that it is still conflict-free and
/// maximal. Many radii would do for a few samples, nearly one for many. If no maximal set of so many samples is found,
/// which has not been seen in 100000 sets of few samples, the most crowded samples of a larger set are dropped; then
/// `is_maximal` is 0.
///
/// out: the samples, x y each, to be freed with azulejo_points_free. With a count the order is that of the set that was
/// begun with, with the samples made anew in the places of others.
///
/// report: what the call achieved, or NULL. Measuring `coverage` for it takes some microseconds per sample, more than
/// the sampling; the progress callback has seen the 1 by then.
///
/// O(samples) time and memory, with a count about twice as much.
///
/// Errors: as azulejo_kdrt_sample, in terms of the count if there is one; AZULEJO_ERROR_INVALID_ARGUMENT for a count
/// and a radius at once.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_sample_with_report(
    context: Option<&azulejo_context>,
    options: *const azulejo_kdrt_options,
    out: Option<&mut MaybeUninit<Box<azulejo_points>>>,
    report: Option<&mut MaybeUninit<azulejo_kdrt_report>>,
) -> azulejo_status {
    boundary::create(out, || {
        let context = required("context", context)?;
        // SAFETY: handed on from the caller.
        let options = unsafe { options::read(options) }?;
        let start = Instant::now();
        let sampling = if report.is_some() { 0.5 } else { 1.0 };
        let (samples, radius, is_maximal) = options.sample(context, options.watch().part(0.0, sampling))?;
        if let Some(report) = report {
            let seconds = start.elapsed().as_secs_f64();
            let domain = options.domain()?;
            let coverage = context.run(options.watch().part(sampling, 1.0), |context, progress| {
                covering_radius_2d(context, &domain, &samples, progress)
            })?;
            report.write(azulejo_kdrt_report {
                samples: samples.len() as u64,
                radius,
                coverage,
                seconds,
                is_maximal: is_maximal.into(),
                reserved: [0; 7],
            });
        }
        Ok(azulejo_points::plane(samples))
    })
}

/// Makes the part of azulejo_kdrt_sample's set that lies in a window of the domain, without making the rest: the same
/// floats in the same order.
///
/// So windows that cut the domain in any way have every sample once, and can be made in any order, by threads,
/// processes and machines that know nothing of each other. What lies in a window depends on nothing farther from it
/// than 22 radii along x and 18 along y.
///
/// window_min, window_max: two numbers each, domain_min <= window_min < window_max <= domain_max; the window has the
/// samples with window_min <= x < window_max. It may be smaller than the radius, and may turn out to have no sample.
///
/// out: the samples, x y each, to be freed with azulejo_points_free.
///
/// O(samples of the window and around it) time and memory, after the making of the pattern (about 28000 samples with the
/// default leaves), which every call repeats. A domain that is not tiled is made as a whole.
///
/// Errors: as azulejo_kdrt_sample, but AZULEJO_ERROR_TOO_LARGE for the samples of the window: the domain may have as
/// many as floats can carry, up to about 10^11.
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
        let (options, min, max) =
            unsafe { (options::read(options)?, pair("window_min", window_min)?, pair("window_max", window_max)?) };
        let request = options.by_radius_only()?;
        let samples = context
            .run(options.watch(), |context, progress| kdrt::sample_window(context, &request, min, max, progress))?;
        Ok(azulejo_points::plane(samples))
    })
}

/// Called with a part of a set of samples, on the thread that made the call. What holds for progress callbacks holds
/// for it too: it may call the library, and must return.
///
/// user: what was given to the call.
///
/// xy: the samples, x y each, until the callback returns; `count` of them, at least one.
///
/// Returns 0 to go on, anything else to cancel.
pub type azulejo_kdrt_window_fn =
    Option<unsafe extern "C-unwind" fn(user: *mut c_void, xy: *const f32, count: usize) -> i32>;

/// Makes the set of azulejo_kdrt_sample and hands it out part by part, in its order, instead of keeping it: for sets that
/// are written or used up, of any size.
///
/// visit: gets the parts, windows of at most about 270 radii (50000 samples), the same ones for every number of threads.
/// While it works on the calling thread, the threads of the context make the next parts.
///
/// user: handed to it.
///
/// O(samples) time; memory for the pattern and at most 8 parts per thread. A domain that is not tiled is made as a whole
/// and is one part.
///
/// Errors: as azulejo_kdrt_sample, but a domain that is tiled may have as many samples as floats can carry, up to about
/// 10^11; AZULEJO_ERROR_CANCELLED also when `visit` cancels.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_stream(
    context: Option<&azulejo_context>,
    options: *const azulejo_kdrt_options,
    visit: azulejo_kdrt_window_fn,
    user: *mut c_void,
) -> azulejo_status {
    boundary::call(|| {
        let context = required("context", context)?;
        // SAFETY: handed on from the caller.
        let options = unsafe { options::read(options) }?;
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
        let request = CountOptions::new(count).domain(self.domain()?).leaf_size(leaf_size).seed(seed);
        let Counted { samples, report, .. } =
            context.run(watch, |context, progress| kdrt::sample_count(context, &request, progress))?;
        Ok((samples, report.radius, report.is_maximal))
    }

    /// The options of calls that cannot have a count.
    fn by_radius_only(&self) -> Result<kdrt::Options, Failure> {
        if self.count != 0 {
            let reason = format!("{} is not 0; windows and streams are made by radius, not by number", self.count);
            return Err(Failure::invalid("count", reason));
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

    fn watch(&self) -> Watch {
        Watch::new(self.progress, self.progress_user)
    }
}
