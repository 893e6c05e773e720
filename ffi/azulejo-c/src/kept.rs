//! A plane that is kept: its pattern is made once, any of its windows at any time.

use azulejo_core::kdrt::Plane;

use crate::boundary::{self, Out, check_size, pair, write};
use crate::context::azulejo_context;
use crate::growing;
use crate::handles::{self, handle};
use crate::kdrt::azulejo_kdrt_options;
use crate::points::azulejo_points;
use crate::status::{Failure, azulejo_status};

/// A plane: a set of azulejo_kdrt_sample or _sample_classes whose windows can be made.
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
/// and 1 byte for each radius of the sides of the domain, up to about 10^11 samples. A domain that
/// is not tiled is kept as a whole, in 8 bytes per sample; in progressive order levels of up to
/// 65,536 samples are, unless the coarsest is tiled, in 16 bytes per sample, and each level takes
/// 16 KB. In progressive order and of several classes windows add up to 32 MB.
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

/// Makes a wide plane: up to a million radii wide and high and more, wherever it lies. As floats
/// cannot carry so many samples, only azulejo_kdrt_window_into gives them.
///
/// options: with a radius, in any order. The samples are others than those of azulejo_kdrt_create.
/// They lie on a lattice whose spacing, azulejo_kdrt_unit, is 1/512 to 1/256 of the radius, and
/// every place is within the radius + 3 of these of a sample. The domain is at most 2^29 of them,
/// at least 1,048,576 radii, wide and high, and large enough to be tiled.
///
/// O(samples of the pattern) time, and the memory of azulejo_kdrt_create.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_create_wide(
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
        let plane = context.run(options.watch(), |context, progress| Plane::wide(context, &request, progress))?;
        Ok(azulejo_kdrt { plane })
    })
}

/// Makes the samples of a plane that lie in a window of its domain, with their classes: those of
/// azulejo_kdrt_sample_window, in the same order. All work happens on the calling thread. Very
/// large windows are made faster by azulejo_kdrt_sample_window, on many threads.
///
/// window_min, window_max: as in azulejo_kdrt_sample_window.
///
/// O(samples in the window and within about 20 radii of it) time and memory; in progressive order
/// also those of each level that is not kept, in the margin that azulejo_kdrt_sample_window has.
/// The plane keeps these, up to 32 MB: the first window in a region takes longest.
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

/// Writes the samples of a window into the caller's arrays, relative to its lower corner. The
/// window of a periodic plane may lie anywhere and cross seams: so the plane goes on without end.
///
/// Positions are differences to window_min, rounded down to floats: at least 0, at most the extent.
/// They are exact if window_min is a multiple of azulejo_kdrt_unit and the window less than 2^24
/// units wide and high; otherwise two samples may be closer than the radius by the spacing of
/// floats at the extent. Windows that share an edge share no sample and lose none.
///
/// window_min, window_max: the corners, x y each. Periodic: at most 2^32 periods from the domain,
/// at most one period apart. Bounded: in the domain.
///
/// positions: receives x y of each sample. May be NULL if `capacity` is 0.
///
/// ranks, classes: receive those of each sample; NULL if they are not wanted, or not there.
///
/// capacity: the samples that each array has room for; see azulejo_kdrt_window_capacity.
///
/// count: receives the number of samples; above `capacity` nothing else is written.
///
/// Time, memory and threads are those of azulejo_kdrt_window, and so is the order of classes and
/// of ranks; else it is arbitrary, but the same in every call.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for a `capacity` below the number of samples, and
/// for `ranks` or `classes` of a plane that has none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_window_into(
    plane: *const azulejo_kdrt,
    window_min: *const f64,
    window_max: *const f64,
    positions: *mut f32,
    ranks: *mut f32,
    classes: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let count = unsafe { Out::new(count) };
    boundary::call(|| {
        count.check("count")?;
        // SAFETY: handed on from the caller.
        let plane = &unsafe { handles::get("plane", plane) }?.plane;
        // SAFETY: handed on from the caller.
        let (min, max) = unsafe { (pair("window_min", window_min)?, pair("window_max", window_max)?) };
        check_size("capacity", capacity, capacity.checked_mul(size_of::<[f32; 2]>()))?;
        if capacity > 0 {
            boundary::check_pointer("positions", positions)?;
        }
        wanted("ranks", ranks, plane.has_ranks())?;
        wanted("classes", classes, plane.has_classes())?;
        let samples = plane.relative_window(min, max)?;
        count.write(samples.len());
        if samples.len() > capacity {
            let reason = format!("{capacity} is below {}, the number of samples of the window", samples.len());
            return Err(Failure::invalid("capacity", reason));
        }
        // SAFETY: the caller's arrays have room for `capacity` samples, and those that are NULL are not written to.
        unsafe {
            write(positions, samples.positions.as_flattened());
            if !ranks.is_null() {
                write(ranks, &samples.ranks);
            }
            if !classes.is_null() {
                write(classes, &samples.classes);
            }
        }
        Ok(())
    })
}

/// Refuses an array for what samples do not have.
fn wanted<T>(argument: &str, array: *const T, are_there: bool) -> Result<(), Failure> {
    if array.is_null() {
        return Ok(());
    }
    boundary::check_pointer(argument, array)?;
    if are_there {
        Ok(())
    } else {
        Err(Failure::invalid(argument, format!("the plane has no {argument}; leave it NULL")))
    }
}

/// The most samples that any window of an extent w h can have: 2 / sqrt(3) * w * h / r^2 +
/// (w + h) / r + 1 (Oler 1961), 1.66 times as many as large windows have on average; of several
/// classes the sum of these.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_window_capacity(
    plane: *const azulejo_kdrt,
    extent: *const f64,
    out: *mut usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    boundary::answer(out, || {
        // SAFETY: handed on from the caller.
        let plane = &unsafe { handles::get("plane", plane) }?.plane;
        // SAFETY: handed on from the caller.
        Ok(plane.most_samples(unsafe { pair("extent", extent) }?)?)
    })
}

/// The spacing of the lattice on which all samples of a plane lie, a power of two: a float spacing,
/// of a wide plane 1/512 to 1/256 of the radius.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_unit(plane: *const azulejo_kdrt) -> f64 {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("plane", plane) }.map_or(0.0, |plane| plane.plane.unit())
}

/// Frees a plane. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_kdrt_free(plane: *mut azulejo_kdrt) {
    // SAFETY: handed on from the caller.
    unsafe { handles::free("plane", plane) };
}
