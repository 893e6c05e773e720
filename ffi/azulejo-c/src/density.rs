//! DCR with a density: sets that are denser here than there.

use std::ffi::c_void;

use azulejo_core::dcr::{self, Density};

use crate::boundary::{Out, check_reserved, check_unused, rows};
use crate::context::azulejo_context;
use crate::dcr::{azulejo_dcr_options, azulejo_dcr_report};
use crate::growing::{self, Output, growing};
use crate::handles;
use crate::of_position::OfPosition;
use crate::points::azulejo_points;
use crate::status::{Failure, azulejo_status};

/// Gives the density at a position, at least 0. See "Callbacks" in azulejo.h. It is called once for
/// each place of a lattice of up to some hundred places per point.
///
/// user: the `function_user` of the azulejo_density.
///
/// position: x y of a place in the domain.
pub type azulejo_density_fn = Option<unsafe extern "C-unwind" fn(user: *mut c_void, position: *const f64) -> f64>;

/// A density of points from place to place, in any unit: at least 0, and not 0 everywhere. Either
/// `values` or `function` must be set; what is not set has its default, NULL or 0.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_density {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved: u32,
    /// An image that is stretched over the domain, linear between the centres of its pixels:
    /// `height` rows of `width` densities, the first row along the lower edge (domain_min[1]).
    pub values: *const f32,
    /// The number of pixels in a row.
    pub width: usize,
    /// The number of rows.
    pub height: usize,
    /// Gives the density at a position.
    pub function: azulejo_density_fn,
    /// Passed to `function`.
    pub function_user: *mut c_void,
}

growing!(azulejo_density requires function_user {
    reserved: 0,
    values: std::ptr::null(),
    width: 0,
    height: 0,
    function: None,
    function_user: std::ptr::null_mut(),
});

impl azulejo_density {
    /// Hands the density to `body`.
    ///
    /// # Safety
    /// Unless the checks fail, `values` leads to `width * height` numbers that are not
    /// changed during the call.
    unsafe fn with<T>(&self, body: impl FnOnce(&Density) -> Result<T, Failure>) -> Result<T, Failure> {
        check_reserved(self.reserved)?;
        match (self.function, self.values.is_null()) {
            (Some(_), false) => Err(Failure::invalid("function", "is set, and values too; one of them must be NULL")),
            (None, true) => Err(Failure::invalid("function", "is NULL, and values too; one of them is needed")),
            (Some(function), true) => {
                check_unused("width", self.width, 0, "with function")?;
                check_unused("height", self.height, 0, "with function")?;
                // SAFETY: the caller's word.
                let function = unsafe { OfPosition::new(function, self.function_user) };
                body(&Density::Function(&|position| function.call(position)))
            }
            (None, false) => {
                let (width, height) = (self.width, self.height);
                let too_large =
                    || Failure::too_large("width", format!("{width} by {height} pixels exceed the address space"));
                let count = width.checked_mul(height).ok_or_else(too_large)?;
                // SAFETY: the caller's word.
                let values = unsafe { rows::<f32, 1>("values", self.values, "width", count)? }.as_flattened();
                body(&Density::Image { values, width, height })
            }
        }
    }
}

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_density_init(density: *mut azulejo_density, struct_size: usize) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("density", density, struct_size) }
}

/// Makes `count` random points with a density: a start for azulejo_dcr_relax_density. O(count * log
/// count) time, O(count) calls of a density function and memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_scatter(
    context: *const azulejo_context,
    options: *const azulejo_dcr_options,
    density: *const azulejo_density,
    count: usize,
    out: *mut *mut azulejo_points,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let (options, density): (azulejo_dcr_options, azulejo_density) =
            unsafe { (growing::read("options", options)?, growing::read("density", density)?) };
        let dcr::Options { domain, seed, .. } = options.request()?;
        let scatter = |density: &Density| {
            context.run(options.watch(), |context, progress| {
                dcr::scatter(context, &domain, density, count, seed, progress)
            })
        };
        // SAFETY: handed on from the caller.
        Ok(azulejo_points::plane(unsafe { density.with(scatter) }?))
    })
}

/// Relaxes a set of points to a density: as azulejo_dcr_relax, but the points become as dense from
/// place to place as the density says, and evenly spaced relative to it (thesis section 4.2.3).
/// Points of about the density, as of azulejo_dcr_scatter and azulejo_psp_adaptive_sample, need the
/// default 100 steps, others may need more. A set of more than 64 points that is far from it is
/// redistributed before the first step, onto points of azulejo_dcr_scatter. Only
/// AZULEJO_METHOD_MOMENTUM with AZULEJO_NEIGHBOURHOOD_DELAUNAY.
///
/// The unit of length is the local spacing: d_max for the mean density and proportional to 1 /
/// sqrt(density) elsewhere, increasing by at most half of the distance from place to place. Details
/// smaller than an eighth of d_max are lost.
///
/// positions: the points, x y each.
///
/// out: the points after the last whole step, in the same order.
///
/// report: rho is the least of all distances over the mean of the two spacings, the relative
/// covering radius the largest circumradius of a Delaunay triangle over the spacing at its centre,
/// without the limit to its increase; the motion is in units of d_max.
///
/// O(count) calls of a density function, then O(count) time for each step, with a factor for
/// densities that vary by orders of magnitude; O(count) memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_dcr_relax_density(
    context: *const azulejo_context,
    options: *const azulejo_dcr_options,
    density: *const azulejo_density,
    positions: *const f32,
    count: usize,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_dcr_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let (options, density): (azulejo_dcr_options, azulejo_density) =
            unsafe { (growing::read("options", options)?, growing::read("density", density)?) };
        // SAFETY: likewise.
        let (points, report) =
            unsafe { (rows::<f32, 2>("positions", positions, "count", count)?, Output::optional("report", report)?) };
        let request = options.request()?.to_delaunay("densities")?;
        let relax = |density: &Density| {
            context.run(options.watch(), |context, progress| {
                dcr::relax_with_density(context, &request, density, points, progress)
            })
        };
        // SAFETY: handed on from the caller.
        let (relaxed, done) = unsafe { density.with(relax) }?;
        if let Some(report) = report {
            report.write(done);
        }
        Ok(azulejo_points::plane(relaxed))
    })
}
