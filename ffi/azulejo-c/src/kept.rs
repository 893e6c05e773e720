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
/// made at any time.
pub struct azulejo_kdrt {
    pub(crate) plane: Plane,
}

handle!(azulejo_kdrt);

/// Makes what all windows of a plane need: its pattern and tables. The plane keeps neither the
/// context nor any thread, and copies given samples.
///
/// options: those of the whole set, with a radius. Only this call calls the progress callback.
///
/// O(samples of the pattern) time, about 28,000 with the default leaves. A plane takes about 0.9 MB
/// and 1 byte for each radius of the sides of the domain, however many samples the domain has, up
/// to about 10^11. A domain that is not tiled (see azulejo_kdrt_sample) is made as a whole and
/// kept, in 8 bytes per sample; in progressive order levels of up to 65,536 samples are, unless the
/// coarsest is tiled, in 16 bytes per sample, and each level takes 16 KB.
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
/// order as azulejo_kdrt_sample_window and the whole set, with classes where it has some. All work
/// happens on the calling thread, and other threads may make windows of the same plane meanwhile.
/// Very large windows are made faster by azulejo_kdrt_sample_window, on many threads.
///
/// window_min, window_max: as in azulejo_kdrt_sample_window.
///
/// O(samples in the window and within about 20 radii of it) time and memory; in progressive order
/// also those of each level that is not kept, in the margin that azulejo_kdrt_sample_window has.
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
