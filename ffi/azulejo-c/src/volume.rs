//! Maximal sets of cuboids.

use std::ffi::c_void;
use std::time::Instant;

use azulejo_core::{Order, volume};

use crate::boundary::{Out, check_reserved, check_unused};
use crate::classes::{azulejo_classes, azulejo_classes_report};
use crate::context::azulejo_context;
use crate::domain::{AZULEJO_BOUNDARY_PERIODIC, domain};
use crate::given::{given, given_by_class};
use crate::growing::{self, Growing, Output, growing};
use crate::handles;
use crate::order::{AZULEJO_ORDER_ANY, order};
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
    /// Above 0, and at least 64 float spacings; it has no default. With a `count` it must be 0.
    pub radius: f64,
    /// The lower corner of the domain, x y z; default 0 0 0.
    pub domain_min: [f64; 3],
    /// The upper one, as in azulejo_space_set; default 1 1 1.
    pub domain_max: [f64; 3],
    /// Any number; another seed gives another set. Default 0.
    pub seed: u64,
    /// Default NULL: the callback of the context, if it has one.
    pub progress: azulejo_progress_fn,
    /// Passed to the progress callback.
    pub progress_user: *mut c_void,
    /// The exact number of samples; default 0: as many as the radius gives.
    pub count: usize,
    /// An AZULEJO_ORDER_ constant; default any.
    pub order: u32,
    /// Always 0.
    pub reserved: u32,
    /// 1.02 to 1.5; default 0: see "Order" in azulejo.h.
    pub quotient: f64,
    /// Default NULL: see "Given samples" in azulejo.h.
    pub given_positions: *const f32,
    /// The clearance of each; default NULL.
    pub given_clearances: *const f64,
    /// The number of given samples; default 0.
    pub given_count: usize,
    /// The shortest side of tiles in radii, 6 or more; default 0: not tiled.
    pub leaf_size: f64,
}

growing!(azulejo_volume_options requires radius {
    boundary: AZULEJO_BOUNDARY_PERIODIC,
    radius: 0.0,
    domain_min: [0.0; 3],
    domain_max: [1.0; 3],
    seed: 0,
    progress: None,
    progress_user: std::ptr::null_mut(),
    count: 0,
    order: AZULEJO_ORDER_ANY,
    reserved: 0,
    quotient: 0.0,
    given_positions: std::ptr::null(),
    given_clearances: std::ptr::null(),
    given_count: 0,
    leaf_size: 0.0,
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
    /// No two samples are nearer: the radius, also that of the set of a count.
    pub radius: f64,
    /// Wall time in seconds.
    pub seconds: f64,
    /// No place of the domain is farther from all samples and outside of all given ones, up to
    /// the tolerance: the radius, with a count mostly up to 1.1 times it.
    pub covering_radius: f64,
}

growing!(azulejo_volume_report requires samples { reserved: 0, samples: 0, radius: 0.0, seconds: 0.0, covering_radius: 0.0 });

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
    /// # Safety
    /// As [`given`] for the given samples.
    unsafe fn request<'a>(&self) -> Result<volume::Options<'a>, Failure> {
        let domain = domain(self.domain_min, self.domain_max, self.boundary)?;
        let order = order(self.order)?;
        if order == Order::Any {
            check_unused("quotient", self.quotient, 0.0, "in any order")?;
        }
        check_reserved(self.reserved)?;
        let options = match self.count {
            0 => volume::Options::new(self.radius),
            count => {
                check_unused("radius", self.radius, 0.0, "beside a count")?;
                volume::Options::by_count(count)
            }
        };
        // SAFETY: handed on from the caller.
        let given = unsafe { given(self.given_positions, self.given_clearances, self.given_count) }?;
        let quotient = if self.quotient == 0.0 { options.quotient } else { self.quotient };
        let options = options.domain(domain).seed(self.seed).order(order).quotient(quotient);
        Ok(options.given(given).leaf_size(self.leaf_size))
    }

    /// The options of a set of so many classes.
    ///
    /// # Safety
    /// As [`given_by_class`] for the given samples.
    unsafe fn of_classes<'a>(&self, classes: usize) -> Result<volume::ClassesOptions<'a>, Failure> {
        let domain = domain(self.domain_min, self.domain_max, self.boundary)?;
        check_unused("radius", self.radius, 0.0, "with classes")?;
        check_unused("count", self.count, 0, "with classes")?;
        check_unused("order", self.order, AZULEJO_ORDER_ANY, "with classes")?;
        check_unused("quotient", self.quotient, 0.0, "with classes")?;
        check_unused("leaf_size", self.leaf_size, 0.0, "with classes")?;
        check_reserved(self.reserved)?;
        // SAFETY: handed on from the caller.
        let given = unsafe { given_by_class(self.given_positions, self.given_clearances, self.given_count, classes) }?;
        Ok(volume::ClassesOptions::default().domain(domain).seed(self.seed).given(given))
    }
}

/// Makes a maximal, conflict-free set of samples of a cuboid, x y z each: no place of it is farther
/// from every sample than the radius and 3.5 float spacings. On a torus about 0.7336 * volume /
/// radius^3 samples, up to 0.3 % more than by darts that are thrown one after the other; a bounded
/// cuboid has more, since samples stand on its faces. If a period of a torus is below the radius, a
/// sample does not conflict with its own image. Samples are sorted by blocks of 9 to 18 radii.
///
/// Around given samples the tolerance is 7 float spacings, in progressive order 9.
///
/// O(samples) time and memory. Source: Ebeida et al. 2012.
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
        // SAFETY: handed on from the caller.
        let request = unsafe { options.request() }?;
        let watch = Watch::new(options.progress, options.progress_user);
        let (samples, made) = context.run(watch, |context, progress| volume::sample(context, &request, progress))?;
        if let Some(report) = report {
            report.write(azulejo_volume_report {
                samples: samples.len() as u64,
                radius: made.radius,
                seconds: made.seconds,
                covering_radius: made.covering_radius,
                ..azulejo_volume_report::DEFAULT
            });
        }
        Ok(azulejo_points::space(samples))
    })
}

/// Makes samples of several classes in a cuboid, as azulejo_classes says, up to 7 float spacings.
/// They are sorted by class. O(samples). Options: domain, boundary, seed, given samples, progress.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_volume_sample_classes(
    context: *const azulejo_context,
    options: *const azulejo_volume_options,
    classes: *const azulejo_classes,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_classes_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let (options, report): (azulejo_volume_options, _) =
            unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        // SAFETY: the same.
        let classes = unsafe { growing::read("classes", classes)?.without_masks("in space") }?;
        // SAFETY: the same.
        let request = unsafe { options.of_classes(classes.count()) }?;
        let start = Instant::now();
        let watch = Watch::new(options.progress, options.progress_user);
        let set =
            context.run(watch, |context, progress| volume::sample_classes(context, &request, &classes, progress))?;
        if let Some(report) = report {
            report.write(azulejo_classes_report::of(classes.count(), &set.classes, start));
        }
        Ok(azulejo_points::space(set))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_are_those_of_the_core() {
        let options = azulejo_volume_options { radius: 0.3, ..azulejo_volume_options::DEFAULT };
        // SAFETY: there are no given samples.
        assert_eq!(unsafe { options.request() }.unwrap(), volume::Options::new(0.3));
        // SAFETY: the same.
        let of_classes = unsafe { azulejo_volume_options::DEFAULT.of_classes(2) }.unwrap();
        assert_eq!(of_classes, volume::ClassesOptions::default());
    }
}
