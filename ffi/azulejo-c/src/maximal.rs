//! The unbiased reference: maximal Poisson-disk sampling by dart throwing.

use std::ffi::c_void;
use std::time::Instant;

use azulejo_core::maximal;

use crate::boundary::Out;
use crate::context::azulejo_context;
use crate::domain::{AZULEJO_BOUNDARY_PERIODIC, domain};
use crate::growing::{self, Output, growing};
use crate::handles;
use crate::kdrt::{azulejo_kdrt_report, of_samples};
use crate::points::azulejo_points;
use crate::progress::{Watch, azulejo_progress_fn};
use crate::status::azulejo_status;

/// Options of azulejo_maximal_sample.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_maximal_options {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// An AZULEJO_BOUNDARY_ constant; default periodic.
    pub boundary: u32,
    /// As in azulejo_kdrt_options: above 0, and at least 64 float spacings. It has no default.
    pub radius: f64,
    /// The lower corner of the domain, x y; default 0 0.
    pub domain_min: [f64; 2],
    /// The upper corner, as in azulejo_plane_set; default 1 1.
    pub domain_max: [f64; 2],
    /// Any number; another seed gives another set. Default 0.
    pub seed: u64,
    /// Default NULL: the callback of the context, if it has one.
    pub progress: azulejo_progress_fn,
    /// Passed to the progress callback.
    pub progress_user: *mut c_void,
}

growing!(azulejo_maximal_options requires radius {
    boundary: AZULEJO_BOUNDARY_PERIODIC,
    radius: 0.0,
    domain_min: [0.0; 2],
    domain_max: [1.0; 2],
    seed: 0,
    progress: None,
    progress_user: std::ptr::null_mut(),
});

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_maximal_options_init(
    options: *mut azulejo_maximal_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("options", options, struct_size) }
}

/// Makes a maximal, conflict-free set of samples of a rectangle by throwing darts into what is
/// uncovered, one after the other: about 0.6966 * area / radius^2 samples without any bias. The
/// reference for other sets, and much slower than azulejo_kdrt_sample. O(samples) time and memory
/// (Ebeida et al., A Simple Algorithm for Maximal Poisson-Disk Sampling, 2012).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_maximal_sample(
    context: *const azulejo_context,
    options: *const azulejo_maximal_options,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_kdrt_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let (options, report): (azulejo_maximal_options, _) =
            unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        let start = Instant::now();
        let domain = domain(options.domain_min, options.domain_max, options.boundary)?;
        let request = maximal::Options::new(options.radius).domain(domain).seed(options.seed);
        let watch = Watch::new(options.progress, options.progress_user);
        let samples = context.run(watch, |context, progress| maximal::sample(context, &request, progress))?;
        if let Some(report) = report {
            let seconds = start.elapsed().as_secs_f64();
            report.write(azulejo_kdrt_report { seconds, ..of_samples(samples.len(), options.radius) });
        }
        Ok(azulejo_points::plane(samples))
    })
}
