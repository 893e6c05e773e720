//! Several classes on a mesh.

use std::time::Instant;

use azulejo_core::psp::sample_classes;
use azulejo_core::{Context, Progress};

use crate::boundary::Out;
use crate::classes::{azulejo_classes, azulejo_classes_report};
use crate::context::azulejo_context;
use crate::given::given_by_class;
use crate::growing::{self, Output};
use crate::handles;
use crate::mesh::azulejo_mesh;
use crate::points::azulejo_points;
use crate::psp::azulejo_psp_options;
use crate::status::azulejo_status;

/// Samples a mesh with several classes at once.
///
/// No two samples of classes i and j are closer than r_ij. No class can take another sample: for
/// each class i every place of the surface is within r_ij of a sample of some class j, up to the
/// tolerance of azulejo_psp_fill.
///
/// Shares: of own radii 1, 1/2, 1/4 with the cross radii of azulejo_classes_radii and factor 1 the
/// classes have about 100, 82 and 82 per cent of the samples that each would have alone. Equal
/// radii have equal shares: two about 77 per cent each, eight 83, and two with factor 0.7 have 95.
/// Of 1.1 and 1 the first has 100 and the second 68: shares jump where radii become equal.
///
/// In progressive order the samples of each class are sorted coarse to fine, and
/// azulejo_points_ranks has their ranks. The first samples of a class, any number of them, are at
/// least as far apart as the last of their ranks. Of the classes of equal own radii R, the samples
/// up to a rank t are at least r_ij t / R apart (of infinite ranks, r_ij d / R for the diagonal d
/// of the mesh's box), and where these classes may stand every place is within `quotient` times
/// r_ij t / R of one of them, or within r_ij of a sample of a class of larger radius; of less than
/// 100 of them, within 2 or the square of `quotient` times that instead. So a host can show the
/// first part of each class, near parts of a scene more than far ones. The order takes about seven
/// times the time.
///
/// options: `radius` must be 0, as the classes have radii. `count`, `iterations`, `maximal`,
/// `priority` and `engine` must have their defaults. `given_clearances` has a row for each given
/// sample with a clearance for each class; NULL stands for each class's own radius.
///
/// classes: the radii, and where each class may stand.
///
/// out: the samples with normals, triangles, barycentrics and azulejo_points_classes, by which they
/// are sorted; to be freed with azulejo_points_free.
///
/// report: how many samples each class has, or NULL.
///
/// With two classes each sample takes about twice the time of one of azulejo_psp_sample, with eight
/// about four times; all triangles are visited once for each class.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also for `radii` above 0 below 64 times the spacing of
/// floats at the largest coordinate; AZULEJO_ERROR_TOO_LARGE, with the estimated number of samples;
/// AZULEJO_ERROR_CANCELLED by the progress callback.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_sample_classes(
    context: *const azulejo_context,
    mesh: *const azulejo_mesh,
    options: *const azulejo_psp_options,
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
        let mesh = unsafe { handles::get("mesh", mesh) }?.shared.clone();
        // SAFETY: handed on from the caller.
        let (options, classes) = unsafe { (growing::read("options", options)?, growing::read("classes", classes)?) };
        // SAFETY: handed on from the caller.
        let report = unsafe { Output::optional("report", report) }?;
        let start = Instant::now();
        // SAFETY: handed on from the caller.
        let (radii, masks) = unsafe { (classes.request()?, classes.masks()?) };
        let &azulejo_psp_options { given_positions, given_clearances, given_count, .. } = &options;
        // SAFETY: handed on from the caller.
        let request = unsafe {
            let given = given_by_class(given_positions, given_clearances, given_count, radii.count())?;
            options.request_of_classes(given)?
        };
        let sample = |context: &Context, progress: Option<&Progress>| {
            sample_classes(context, &mesh, &request, &radii, masks, progress)
        };
        let (samples, _) = context.run(options.watch(), sample)?;
        if let Some(report) = report {
            report.write(azulejo_classes_report::of(radii.count(), &samples.classes, start));
        }
        Ok(azulejo_points::surface(samples))
    })
}
