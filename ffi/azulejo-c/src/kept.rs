//! A plane that is kept: its pattern is made once, any of its windows at any time.

use azulejo_core::kdrt::Plane;

use crate::boundary::{Out, pair};
use crate::context::azulejo_context;
use crate::growing;
use crate::handles::{self, handle};
use crate::kdrt::azulejo_kdrt_options;
use crate::points::azulejo_points;
use crate::status::azulejo_status;

/// A plane: a set of azulejo_kdrt_sample or azulejo_kdrt_sample_classes of which any window can be
/// made at any time. Immutable: several threads may make windows of it at once.
pub struct azulejo_kdrt {
    pub(crate) plane: Plane,
}

handle!(azulejo_kdrt);

/// Makes what all windows of a plane need: its pattern and tables.
///
/// options: those of the whole set, with a radius. The progress callback is called during this call
/// only.
///
/// out: the plane, to be freed with azulejo_kdrt_free. It keeps neither the context nor any thread.
///
/// O(samples of the pattern) time: about 28,000 samples with the default leaves. The plane takes 32
/// bytes of memory for each of them, 0.9 MB in all, and 1 byte for each radius of the sides of the
/// domain, however many samples the domain has. A domain that is not tiled (see
/// azulejo_kdrt_sample) is made as a whole and kept, in 8 bytes per sample. In progressive order
/// the plane also takes 16 KB per level and, unless its coarsest level is tiled, makes and keeps
/// the levels that have up to 65,536 samples in the whole domain, in 16 bytes per sample.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT as azulejo_kdrt_sample, so for more samples than floats
/// can carry, about 10^11; AZULEJO_ERROR_TOO_LARGE for a domain that is not tiled;
/// AZULEJO_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_create(
    context: *const azulejo_context,
    options: *const azulejo_kdrt_options,
    out: *mut *mut azulejo_kdrt,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let options = unsafe { growing::read("options", options) }?;
        let request = options.by_radius_only()?;
        let plane = context.run(options.watch(), |context, progress| Plane::new(context, &request, progress))?;
        Ok(azulejo_kdrt { plane })
    })
}

/// Makes the samples of a plane that lie in a window of its domain: the same floats in the same
/// order as azulejo_kdrt_sample_window and the whole set. Those of several classes have
/// azulejo_points_classes.
///
/// All work happens on the calling thread, and other threads may make windows of the same plane
/// meanwhile. Very large windows are made faster by azulejo_kdrt_sample_window, on the threads of a
/// context.
///
/// window_min, window_max: as in azulejo_kdrt_sample_window.
///
/// out: the samples, x y each, to be freed with azulejo_points_free.
///
/// O(samples in the window and within about 20 radii of it) time and memory; in progressive order
/// also those of each level that is not kept, in the margin that azulejo_kdrt_sample_window has for
/// it.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_TOO_LARGE for 2^32 samples or more in the
/// window, or more than memory holds.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_window(
    plane: *const azulejo_kdrt,
    window_min: *const f64,
    window_max: *const f64,
    out: *mut *mut azulejo_points,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let plane = &unsafe { handles::get("plane", plane) }?.plane;
        // SAFETY: handed on from the caller.
        let (min, max) = unsafe { (pair("window_min", window_min)?, pair("window_max", window_max)?) };
        Ok(azulejo_points::plane(plane.window(min, max)?))
    })
}

/// Frees a plane. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_free(plane: *mut azulejo_kdrt) {
    // SAFETY: handed on from the caller.
    unsafe { handles::free("plane", plane) };
}
