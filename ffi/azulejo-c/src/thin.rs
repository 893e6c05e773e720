//! Thinning: some points of a cloud, far from each other and near to all the others.

use std::ffi::c_void;
use std::time::Instant;

use azulejo_core::thin::{Options, Selection, thin};

use crate::boundary::{Out, array, rows};
use crate::context::azulejo_context;
use crate::growing::{self, Growing, Output, growing};
use crate::handles::{self, handle};
use crate::order::{AZULEJO_ORDER_ANY, order};
use crate::progress::{Watch, azulejo_progress_fn};
use crate::status::{Failure, azulejo_status};

/// Options of azulejo_thin. What is selected follows from `order`, `radius` and `count`:
/// - any order, a radius: in the order of the cloud, each point that no selected one before it is
///   nearer to than the radius;
/// - any order, a count (and a radius): the points that the progressive order would select, in the
///   order of the cloud;
/// - progressive order: each next point is the farthest from those before, the lowest index on
///   ties, until there are `count` points, or no point is left that is at least `radius` from all
///   of them; all points if both are 0.
///
/// Any order with neither is refused.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_thin_options {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// An AZULEJO_ORDER_ constant; default any.
    pub order: u32,
    /// The smallest distance between two selected points, above 0; default 0: none.
    pub radius: f64,
    /// The number of points; default 0: none. A smaller cloud is selected whole.
    pub count: usize,
    /// It chooses the first point of the progressive order; default 0.
    pub seed: u64,
    /// Default NULL: the callback of the context, if it has one.
    pub progress: azulejo_progress_fn,
    /// Passed to the progress callback.
    pub progress_user: *mut c_void,
}

growing!(azulejo_thin_options requires count {
    order: AZULEJO_ORDER_ANY,
    radius: 0.0,
    count: 0,
    seed: 0,
    progress: None,
    progress_user: std::ptr::null_mut(),
});

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_thin_options_init(
    options: *mut azulejo_thin_options,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("options", options, struct_size) }
}

/// The report of azulejo_thin.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_thin_report {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// Always 0.
    pub reserved: u32,
    /// The number of selected points.
    pub samples: u64,
    /// No two selected points are closer: the radius by which they were selected, otherwise the
    /// smallest distance of two; infinite for fewer.
    pub radius: f64,
    /// Wall time in seconds.
    pub seconds: f64,
}

growing!(azulejo_thin_report requires samples { reserved: 0, samples: 0, radius: 0.0, seconds: 0.0 });

/// Writes zeros and the size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_thin_report_init(
    report: *mut azulejo_thin_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}

impl azulejo_thin_options {
    fn request(&self) -> Result<Options, Failure> {
        let order = order(self.order)?;
        Ok(Options::default().order(order).radius(self.radius).count(self.count).seed(self.seed))
    }
}

/// Points of a cloud that azulejo_thin selected.
pub struct azulejo_selection {
    selection: Selection,
}

handle!(azulejo_selection);

/// Selects points of a cloud that are far from each other and near to all the others. With a
/// radius, the selected points are at least the radius apart; without a count, every other point is
/// nearer than the radius to one of them. Without a radius, no other point is farther from the
/// selected ones than any two of them are from each other, in progressive order for each prefix.
/// Distances are computed in double arithmetic from the floats, without tolerance.
///
/// positions: the points, at most 2^32 - 1. They may coincide: by radius one of them is selected,
/// in the progressive order they come last.
///
/// dimension: the number of coordinates of a point, 2 or 3.
///
/// O(count * log(count)) time; at worst, in clouds made for it, O(count * selected). Up to 150
/// bytes of memory per point. Threads share the sorting of the points, not the selection.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_thin(
    context: *const azulejo_context,
    options: *const azulejo_thin_options,
    positions: *const f32,
    count: usize,
    dimension: u32,
    out: *mut *mut azulejo_selection,
    report: *mut azulejo_thin_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let (options, report) = unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        let start = Instant::now();
        let selection = match dimension {
            // SAFETY: handed on from the caller.
            2 => select(context, &options, unsafe { rows::<f32, 2>("positions", positions, "count", count) }?),
            // SAFETY: handed on from the caller.
            3 => select(context, &options, unsafe { rows::<f32, 3>("positions", positions, "count", count) }?),
            other => Err(Failure::invalid("dimension", format!("{other} is neither 2 nor 3"))),
        }?;
        if let Some(report) = report {
            report.write(azulejo_thin_report {
                samples: selection.indices.len() as u64,
                radius: selection.radius,
                seconds: start.elapsed().as_secs_f64(),
                ..azulejo_thin_report::DEFAULT
            });
        }
        Ok(azulejo_selection { selection })
    })
}

fn select<const D: usize>(
    context: &azulejo_context,
    options: &azulejo_thin_options,
    positions: &[[f32; D]],
) -> Result<Selection, Failure> {
    let request = options.request()?;
    let watch = Watch::new(options.progress, options.progress_user);
    context.run(watch, |context, progress| thin(context, &request, positions, progress))
}

/// The number of selected points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_selection_count(selection: *const azulejo_selection) -> usize {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("selection", selection) }.map_or(0, |selection| selection.selection.indices.len())
}

/// The indices of the selected points in the cloud: ascending in any order, in the order of
/// selection in the progressive one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_selection_indices(selection: *const azulejo_selection) -> *const u32 {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("selection", selection) }
        .map_or(std::ptr::null(), |selection| array(&selection.selection.indices))
}

/// The ranks of the points of a progressive selection: the distance of each from the nearest of
/// those before it, rounded down to a float, so that all points with a rank of at least r are at
/// least r apart. They never rise; the first is infinite. NULL for AZULEJO_ORDER_ANY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_selection_ranks(selection: *const azulejo_selection) -> *const f32 {
    // SAFETY: handed on from the caller.
    unsafe { handles::peek("selection", selection) }
        .map_or(std::ptr::null(), |selection| array(&selection.selection.ranks))
}

/// Frees the selection with its arrays.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_selection_free(selection: *mut azulejo_selection) {
    // SAFETY: handed on from the caller.
    unsafe { handles::free("selection", selection) };
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::order::AZULEJO_ORDER_PROGRESSIVE;

    #[test]
    fn the_defaults_are_those_of_the_core() {
        assert_eq!(azulejo_thin_options::DEFAULT.request().unwrap(), Options::default());
        let options = azulejo_thin_options { order: AZULEJO_ORDER_PROGRESSIVE, ..azulejo_thin_options::DEFAULT };
        assert_eq!(options.request().unwrap(), Options::progressive());
    }
}
