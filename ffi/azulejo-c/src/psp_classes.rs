//! Several classes on a mesh.

use std::sync::Arc;
use std::time::Instant;

use azulejo_core::mesh::Mesh;
use azulejo_core::psp::adaptive::Radius;
use azulejo_core::psp::{ClassOptions, sample_classes};
use azulejo_core::{Classes, Context, Progress};

use crate::boundary::Out;
use crate::classes::{azulejo_classes, azulejo_classes_report};
use crate::context::azulejo_context;
use crate::given::given_by_class;
use crate::growing::{self, Output};
use crate::handles;
use crate::mesh::azulejo_mesh;
use crate::points::azulejo_points;
use crate::psp::azulejo_psp_options;
use crate::status::{Failure, azulejo_status};

/// Samples a mesh with several classes at once, as azulejo_classes says, each where it may stand.
/// Shares, and in progressive order prefixes, are as azulejo_kdrt_sample_classes says; infinite
/// ranks count as the diagonal of the mesh's box.
///
/// options: `radius` must be 0, as the classes have radii. `count`, `iterations`, `maximal`,
/// `projectors`, `priority` and `engine` must have their defaults.
///
/// classes: the radii, and where each class may stand.
///
/// out: the samples with normals, triangles, barycentrics and classes, by which they are sorted.
///
/// O(samples + classes * triangles) time. With two classes a sample takes about twice the time of
/// one of azulejo_psp_sample, with eight four times, in progressive order seven times that.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for `radii` above 0 below 64 float spacings.
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
        let call = unsafe { ClassCall::read(context, mesh, options, classes, report) }?;
        call.sample(None)
    })
}

/// The arguments of a call that samples a mesh with several classes.
pub(crate) struct ClassCall<'a> {
    start: Instant,
    context: &'a azulejo_context,
    mesh: Arc<Mesh>,
    options: azulejo_psp_options,
    request: ClassOptions<'a>,
    classes: Classes,
    masks: Option<&'a [u32]>,
    report: Option<Output<azulejo_classes_report>>,
}

impl<'a> ClassCall<'a> {
    /// Checks the arguments.
    ///
    /// # Safety
    /// Unless the checks fail, all pointers lead to what they say, which is not changed during `'a`.
    pub(crate) unsafe fn read(
        context: *const azulejo_context,
        mesh: *const azulejo_mesh,
        options: *const azulejo_psp_options,
        classes: *const azulejo_classes,
        report: *mut azulejo_classes_report,
    ) -> Result<Self, Failure> {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let mesh = unsafe { handles::get("mesh", mesh) }?.shared.clone();
        // SAFETY: handed on from the caller.
        let (options, classes): (azulejo_psp_options, azulejo_classes) =
            unsafe { (growing::read("options", options)?, growing::read("classes", classes)?) };
        // SAFETY: handed on from the caller.
        let report = unsafe { Output::optional("report", report) }?;
        let start = Instant::now();
        // SAFETY: handed on from the caller.
        let (radii, masks) = unsafe { (classes.request()?, classes.masks()?) };
        let azulejo_psp_options { given_positions, given_clearances, given_count, .. } = options;
        // SAFETY: handed on from the caller.
        let request = unsafe {
            let given = given_by_class(given_positions, given_clearances, given_count, radii.count())?;
            options.request_of_classes(given)?
        };
        Ok(Self { start, context, mesh, options, request, classes: radii, masks, report })
    }

    /// The samples, where the radii of the classes are multiples of a unit.
    pub(crate) fn sample(self, unit: Option<Radius>) -> Result<azulejo_points, Failure> {
        let Self { start, context, mesh, options, request, classes, masks, report } = self;
        let sample = |context: &Context, progress: Option<&Progress>| {
            sample_classes(context, &mesh, &request.unit(unit), &classes, masks, progress)
        };
        let (samples, _) = context.run(options.watch(), sample)?;
        if let Some(report) = report {
            report.write(azulejo_classes_report::of(classes.count(), &samples.classes, start));
        }
        Ok(azulejo_points::space(samples))
    }
}
