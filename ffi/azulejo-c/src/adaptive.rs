//! Adaptive sampling: Poisson-disk samples on triangle meshes whose radius varies.

use std::ffi::c_void;

use azulejo_core::Order;
use azulejo_core::psp::DEFAULT_QUOTIENT;
use azulejo_core::psp::adaptive::{self, Radius};

use crate::boundary::{Out, check_unused, rows};
use crate::context::azulejo_context;
use crate::given::given;
use crate::growing::{self, Output, growing};
use crate::handles;
use crate::mesh::azulejo_mesh;
use crate::of_position::{OfPosition, azulejo_radius_fn};
use crate::order::{AZULEJO_ORDER_ANY, order};
use crate::points::azulejo_points;
use crate::progress::{Watch, azulejo_progress_fn};
use crate::psp_report::azulejo_psp_report;
use crate::status::{Failure, azulejo_status};

/// Options of azulejo_psp_adaptive_sample, which requires either `vertex_radii` or
/// `radius_function`, and of azulejo_psp_adaptive_with_density.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_psp_adaptive_options {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// As in azulejo_psp_options; default any.
    pub order: u32,
    /// A radius for each vertex of the mesh, above 0, interpolated by the barycentrics in double
    /// arithmetic. It may change arbitrarily steeply. Default NULL.
    pub vertex_radii: *const f32,
    /// The number of vertices, or 0, the default.
    pub vertex_count: usize,
    /// NULL, the default, if `vertex_radii` is set.
    pub radius_function: azulejo_radius_fn,
    /// Passed to `radius_function`.
    pub radius_function_user: *mut c_void,
    /// Its smallest value, above 0. Must be 0, the default, with vertex_radii.
    pub smallest: f64,
    /// Its largest value. Must be 0, the default, with vertex_radii.
    pub largest: f64,
    /// The most by which `radius_function` changes per unit of distance between two places of a
    /// triangle; 0, the default: it is constant on each. Coverage is proved with it: a violation
    /// that is detected makes the call fail, one that is not can leave gaps. From about 1 on the
    /// work grows with its square, and from about 30 on it may be refused: for images and other
    /// data with edges vertex_radii are better. At most `smallest` / 24 per float spacing. Must be
    /// 0 with vertex_radii.
    pub slope: f64,
    /// As in azulejo_psp_options, from -1, the default, to 1.
    pub cosine: f64,
    /// Any number; another seed gives another set. Default 0.
    pub seed: u64,
    /// Default NULL: the callback of the context, if it has one.
    pub progress: azulejo_progress_fn,
    /// Passed to the progress callback.
    pub progress_user: *mut c_void,
    /// Default NULL: see "Given samples" in azulejo.h.
    pub given_positions: *const f32,
    /// The clearance of each, required; default NULL.
    pub given_clearances: *const f64,
    /// The number of given samples; default 0.
    pub given_count: usize,
    /// 1.02 to 1.5; default 0: see "Order" in azulejo.h.
    pub quotient: f64,
}

growing!(azulejo_psp_adaptive_options requires slope {
    order: AZULEJO_ORDER_ANY,
    vertex_radii: std::ptr::null(),
    vertex_count: 0,
    radius_function: None,
    radius_function_user: std::ptr::null_mut(),
    smallest: 0.0,
    largest: 0.0,
    slope: 0.0,
    cosine: -1.0,
    seed: 0,
    progress: None,
    progress_user: std::ptr::null_mut(),
    given_positions: std::ptr::null(),
    given_clearances: std::ptr::null(),
    given_count: 0,
    quotient: 0.0,
});

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_adaptive_options_init(
    options: *mut azulejo_psp_adaptive_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("options", options, struct_size) }
}

/// Makes a maximal set of samples on a mesh, each with a radius of its own (thesis section 3.4.4).
///
/// Conflict-free: two samples are no closer than the mean of their radii. Maximal: no place of the
/// surface is farther from every sample than the mean of the two radii, up to 6 float spacings and
/// the change of the radius over that length; with vertex_radii, also up to 2^-22 of the largest
/// difference of two radii on a triangle. Where the radius changes little there are about 0.6966 /
/// radius^2 samples per unit of area. Radii are at most four times the diagonal of the box.
///
/// In progressive order ranks are what all radii are multiplied by: with its radii times the i-th
/// rank the prefix of i samples is conflict-free, and with all radii times `quotient` times that
/// rank it is maximal (for i below 100 see azulejo_points_ranks). The last rank is 1 or a little
/// more. Each of the log(diagonal / smallest radius) / log(quotient) levels visits all triangles
/// and calls `radius_function`. Where the radius jumps, samples of the larger radius, which come
/// first, leave fewer on the other side.
///
/// out: the samples with normals, triangles, barycentrics and radii.
///
/// report: no iterations, rays and hits; in progressive order both radii are 1.
///
/// O(samples + triangles) time for radii that change slowly; see `slope`.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for radii below 64 float spacings, and if
/// `radius_function` leaves `smallest` to `largest` or changes faster than `slope`;
/// AZULEJO_ERROR_TOO_LARGE also if coverage would take thousands of evaluations per sample.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_adaptive_sample(
    context: *const azulejo_context,
    mesh: *const azulejo_mesh,
    options: *const azulejo_psp_adaptive_options,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_psp_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let mesh = unsafe { handles::get("mesh", mesh) }?.shared.clone();
        // SAFETY: handed on from the caller.
        let (options, report) = unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        let user = options.radius_function_user;
        // SAFETY: handed on from the caller.
        let function = options.radius_function.map(|function| unsafe { OfPosition::new(function, user) });
        let at = function.as_ref().map(|function| |position| function.call(position));
        // SAFETY: handed on from the caller.
        let radii = unsafe { options.vertex_radii() }?;
        let azulejo_psp_adaptive_options { smallest, largest, slope, .. } = options;
        let radius = match &at {
            Some(at) => Radius::Function { at, smallest, largest, slope },
            None => Radius::PerVertex(radii),
        };
        // SAFETY: handed on from the caller.
        let request = unsafe { options.request(radius) }?;
        let (set, done) =
            context.run(options.watch(), |context, progress| adaptive::sample(context, &mesh, &request, progress))?;
        if let Some(report) = report {
            report.write(done);
        }
        Ok(azulejo_points::space(set))
    })
}

impl azulejo_psp_adaptive_options {
    /// The request with a radius.
    ///
    /// # Safety
    /// Unless the checks fail, the arrays of given samples are as long as is said, and not changed during `'a`.
    pub(crate) unsafe fn request<'a>(&self, radius: Radius<'a>) -> Result<adaptive::Options<'a>, Failure> {
        // SAFETY: handed on from the caller.
        let given = unsafe { given(self.given_positions, self.given_clearances, self.given_count) }?;
        let order = order(self.order)?;
        if order == Order::Any {
            check_unused("quotient", self.quotient, 0.0, "in any order")?;
        }
        Ok(adaptive::Options::new(radius)
            .order(order)
            .quotient(if self.quotient == 0.0 { DEFAULT_QUOTIENT } else { self.quotient })
            .cosine(self.cosine)
            .seed(self.seed)
            .given(given))
    }

    pub(crate) fn watch(&self) -> Watch {
        Watch::new(self.progress, self.progress_user)
    }

    /// Refuses radii, in a call that gets a density.
    pub(crate) fn check_without_radii(&self) -> Result<(), Failure> {
        for (field, is_set) in
            [("vertex_radii", !self.vertex_radii.is_null()), ("radius_function", self.radius_function.is_some())]
        {
            if is_set {
                return Err(Failure::invalid(field, "is set; it must be NULL with a density"));
            }
        }
        check_unused("vertex_count", self.vertex_count, 0, "with a density")?;
        for (field, value) in [("smallest", self.smallest), ("largest", self.largest), ("slope", self.slope)] {
            check_unused(field, value, 0.0, "with a density")?;
        }
        Ok(())
    }

    /// The radii of the vertices; none where `radius_function` is set.
    ///
    /// # Safety
    /// Unless the checks fail, `vertex_radii` leads to `vertex_count` numbers that are not
    /// changed during `'a`.
    unsafe fn vertex_radii<'a>(&self) -> Result<&'a [f32], Failure> {
        match (self.radius_function.is_some(), self.vertex_radii.is_null()) {
            (true, true) => {
                check_unused("vertex_count", self.vertex_count, 0, "with radius_function").map(|()| [].as_slice())
            }
            (true, false) => {
                Err(Failure::invalid("radius_function", "is set, and vertex_radii too; one of them must be NULL"))
            }
            (false, true) => {
                Err(Failure::invalid("radius_function", "is NULL, and vertex_radii too; one of them is needed"))
            }
            // SAFETY: the caller's word.
            (false, false) => unsafe {
                for (field, value) in [("smallest", self.smallest), ("largest", self.largest), ("slope", self.slope)] {
                    check_unused(field, value, 0.0, "with vertex_radii")?;
                }
                Ok(rows::<f32, 1>("vertex_radii", self.vertex_radii, "vertex_count", self.vertex_count)?.as_flattened())
            },
        }
    }
}
