//! Several classes in the plane.

use std::time::Instant;

use azulejo_core::kdrt::{Plane, sample};

use crate::boundary::Out;
use crate::classes::{azulejo_classes, azulejo_classes_report};
use crate::context::azulejo_context;
use crate::growing::{self, Output};
use crate::handles;
use crate::kdrt::azulejo_kdrt_options;
use crate::kept::azulejo_kdrt;
use crate::points::azulejo_points;
use crate::status::azulejo_status;

/// Makes samples of several classes in a rectangle, as azulejo_classes says. Classes of equal radii
/// get equal shares. A single class of the largest own radius has all the samples that it would
/// have alone, those of azulejo_kdrt_sample; smaller ones have what is left, about 0.8 of that with
/// the matrix of azulejo_classes_radii and factor 1, 0.95 with factor 0.7 (docs/classes.md).
///
/// In progressive order the samples of each class are sorted coarse to fine, so that a host can
/// show the first part of each. Of the classes of equal own radii R, the samples up to a rank t are
/// at least r_ij t / R apart, and every place is within `quotient` times r_ij t / R of one of them,
/// or within r_ij of a sample of a class of larger own radius; where a class has less than 100 of
/// them, within 2 or the square of `quotient` times that. It takes about 8 times the time.
///
/// options: `radius`, `count` and `measure_covering_radius` must be 0. `coarsest` is the radius of
/// the first level of each class, at least the largest own radius.
///
/// out: the samples with their classes, sorted by these, then by y and x or in order by rank.
///
/// O(samples) time, for a given number of classes, and 64 bytes of memory per sample. Where the
/// domain is a torus narrower than about 10 times the largest r_ij between classes of equal own
/// radii, these classes are filled by one thread, with 512 bytes per sample.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for an own radius below 64 float spacings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_sample_classes(
    context: *const azulejo_context,
    options: *const azulejo_kdrt_options,
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
        let (options, report) = unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        // SAFETY: the same.
        let classes = unsafe { growing::read("classes", classes)?.without_masks("in the plane") }?;
        let request = options.with_classes(&classes)?;
        let start = Instant::now();
        let set = context.run(options.watch(), |context, progress| sample(context, &request, progress))?;
        if let Some(report) = report {
            report.write(azulejo_classes_report::of(classes.count(), &set.classes, start));
        }
        Ok(azulejo_points::plane(set))
    })
}

/// Makes what all windows of a plane of several classes need: azulejo_kdrt_window then makes the
/// samples of azulejo_kdrt_sample_classes that lie in any of them, in the same order. The plane is
/// kept as by azulejo_kdrt_create.
///
/// options, classes: those of the whole set. Only this call calls the progress callback.
///
/// O(samples of the pattern) time, and the memory of azulejo_kdrt_create. A window takes O(samples
/// in and around it): classes of one own radius depend on what lies within about 30 times the
/// largest r_ij between them, and all classes of larger radii on what lies around that again. In
/// progressive order each level adds 30 times its r_ij: windows of large domains need a `coarsest`
/// of a few times the largest own radius. On a torus narrower than about 10 times the largest r_ij
/// between classes of equal own radii, these and the classes before are kept, in 12 bytes per
/// sample.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_create_classes(
    context: *const azulejo_context,
    options: *const azulejo_kdrt_options,
    classes: *const azulejo_classes,
    out: *mut *mut azulejo_kdrt,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let options = unsafe { growing::read("options", options) }?;
        // SAFETY: the same.
        let classes = unsafe { growing::read("classes", classes)?.without_masks("in the plane") }?;
        let request = options.with_classes(&classes)?;
        let plane = context.run(options.watch(), |context, progress| Plane::new(context, &request, progress))?;
        Ok(azulejo_kdrt { plane })
    })
}
