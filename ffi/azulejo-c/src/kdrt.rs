//! KDRT: massive maximal Poisson-disk sets in the plane.

use std::ffi::c_void;
use std::mem::MaybeUninit;

use azulejo_core::kdrt;

use crate::boundary::{self, required};
use crate::context::azulejo_context;
use crate::domain::{AZULEJO_BOUNDARY_PERIODIC, domain};
use crate::options::{self, Watch, azulejo_progress_fn, options};
use crate::points::azulejo_points;
use crate::status::azulejo_status;

/// Options of azulejo_kdrt_sample.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_kdrt_options {
    /// The size of the caller's struct in bytes; set by the init function.
    pub struct_size: u32,
    /// An AZULEJO_BOUNDARY_ constant; periodic by default.
    pub boundary: i32,
    /// The smallest distance between two samples, in the units of the domain. Above 0; there is no default.
    pub radius: f64,
    /// The lower corner of the domain, x y; 0 0 by default.
    pub domain_min: [f64; 2],
    /// The upper corner of the domain, above the lower one on both axes; 1 1 by default.
    pub domain_max: [f64; 2],
    /// The shortest side of the leaves that tile the domain, in radii: at least 6, by default 20; sides are random, up
    /// to twice this. Larger leaves are faster and have fewer seams, but need a larger pattern.
    pub leaf_size: f64,
    /// Any number; another seed gives another set.
    pub seed: u64,
    /// Called during the call, unless NULL, which is the default.
    pub progress: azulejo_progress_fn,
    /// Handed to the progress callback.
    pub progress_user: *mut c_void,
}

options!(azulejo_kdrt_options requires radius {
    boundary: AZULEJO_BOUNDARY_PERIODIC,
    radius: 0.0,
    domain_min: [0.0; 2],
    domain_max: [1.0; 2],
    leaf_size: kdrt::DEFAULT_LEAF_SIZE,
    seed: 0,
    progress: None,
    progress_user: std::ptr::null_mut(),
});

/// Writes the defaults. `struct_size` is sizeof *options.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_options_init(
    options: *mut azulejo_kdrt_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { options::init(options, struct_size) }
}

/// Makes a maximal, conflict-free set of samples of a rectangle, about 0.7 * area / radius^2 of them.
///
/// Tiles clips of one small pattern over a random kd-tree and repairs the seams (thesis chapter 2) with all threads of
/// the context: O(samples) time and 24 bytes per sample. Its only bias is at the seams. A domain of less area than the
/// pattern, or narrower than 13 radii, is not tiled: it gets what azulejo_maximal_sample makes. A radius longer than
/// the diagonal of the domain gives one sample.
///
/// out: the samples, x y each, to be freed with azulejo_points_free.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, also where floats are too coarse to carry the radius (their spacing at the
/// largest coordinate is above radius / 64); AZULEJO_ERROR_TOO_LARGE, with the estimate, above 2^32 samples or the
/// memory that is available; AZULEJO_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_sample(
    context: Option<&azulejo_context>,
    options: *const azulejo_kdrt_options,
    out: Option<&mut MaybeUninit<Box<azulejo_points>>>,
) -> azulejo_status {
    boundary::create(out, || {
        let context = required("context", context)?.shared.clone();
        // SAFETY: handed on from the caller.
        let options = unsafe { options::read(options) }?;
        let domain = domain(options.domain_min, options.domain_max, options.boundary)?;
        let request =
            kdrt::Options { radius: options.radius, domain, leaf_size: options.leaf_size, seed: options.seed };
        let watch = Watch { function: options.progress, user: options.progress_user };
        Ok(azulejo_points::plane(watch.run(|progress| kdrt::sample(&context, &request, progress))?))
    })
}
