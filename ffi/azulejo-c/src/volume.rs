//! Maximal sets of cuboids.

use std::ffi::c_void;
use std::time::Instant;

use azulejo_core::volume;

use crate::boundary::Out;
use crate::context::azulejo_context;
use crate::domain::{AZULEJO_BOUNDARY_PERIODIC, domain};
use crate::growing::{self, Growing, Output, growing};
use crate::handles;
use crate::points::azulejo_points;
use crate::progress::{Watch, azulejo_progress_fn};
use crate::status::{Failure, azulejo_status};

/// Options of azulejo_volume_sample.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_volume_options {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// An AZULEJO_BOUNDARY_ constant; default periodic.
    pub boundary: u32,
    /// Above 0, and at least 64 float spacings; it may exceed the domain. It has no default.
    pub radius: f64,
    /// The lower corner of the domain, x y z; default 0 0 0.
    pub domain_min: [f64; 3],
    /// The upper corner, above the lower one on all axes; default 1 1 1. No side may be longer than
    /// 2^100 times another.
    pub domain_max: [f64; 3],
    /// Any number; another seed gives another set. Default 0.
    pub seed: u64,
    /// Default NULL: the callback of the context, if it has one.
    pub progress: azulejo_progress_fn,
    /// Passed to the progress callback.
    pub progress_user: *mut c_void,
}

growing!(azulejo_volume_options requires radius {
    boundary: AZULEJO_BOUNDARY_PERIODIC,
    radius: 0.0,
    domain_min: [0.0; 3],
    domain_max: [1.0; 3],
    seed: 0,
    progress: None,
    progress_user: std::ptr::null_mut(),
});

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_options_init(
    options: *mut azulejo_volume_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("options", options, struct_size) }
}

/// The report of azulejo_volume_sample.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_volume_report {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// Always 0.
    pub reserved: u32,
    /// The number of samples.
    pub samples: u64,
    /// The radius of the set.
    pub radius: f64,
    /// Wall time in seconds.
    pub seconds: f64,
}

growing!(azulejo_volume_report requires samples { reserved: 0, samples: 0, radius: 0.0, seconds: 0.0 });

/// Writes zeros and the size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_report_init(
    report: *mut azulejo_volume_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}

impl azulejo_volume_options {
    fn request(&self) -> Result<volume::Options, Failure> {
        let domain = domain(self.domain_min, self.domain_max, self.boundary)?;
        Ok(volume::Options::new(self.radius).domain(domain).seed(self.seed))
    }
}

/// Makes a maximal, conflict-free set of samples of a cuboid, x y z each: no place of it is farther
/// from every sample than the radius and 3.5 float spacings. On a torus about 0.7336 * volume /
/// radius^3 samples, up to 0.3 % more than by darts that are thrown one after the other; a bounded
/// cuboid has more, since samples stand on its faces. If a period of a torus is below the radius, a
/// sample does not conflict with its own image. Samples are sorted by blocks of 9 to 18 radii.
///
/// O(samples) time and memory. Source: M. S. Ebeida et al., A Simple Algorithm for Maximal
/// Poisson-Disk Sampling in High Dimensions, 2012.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_sample(
    context: *const azulejo_context,
    options: *const azulejo_volume_options,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_volume_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let (options, report): (azulejo_volume_options, _) =
            unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        let start = Instant::now();
        let request = options.request()?;
        let watch = Watch::new(options.progress, options.progress_user);
        let samples = context.run(watch, |context, progress| volume::sample(context, &request, progress))?;
        if let Some(report) = report {
            report.write(azulejo_volume_report {
                samples: samples.len() as u64,
                radius: options.radius,
                seconds: start.elapsed().as_secs_f64(),
                ..azulejo_volume_report::DEFAULT
            });
        }
        Ok(azulejo_points::space(samples))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_are_those_of_the_core() {
        let options = azulejo_volume_options { radius: 0.3, ..azulejo_volume_options::DEFAULT };
        assert_eq!(options.request().unwrap(), volume::Options::new(0.3));
    }
}
