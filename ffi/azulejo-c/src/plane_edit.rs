//! Sets of the plane that are edited.

use std::sync::{RwLock, RwLockWriteGuard};
use std::time::Instant;

use azulejo_core::Points;
use azulejo_core::kdrt::EditableSet;

use crate::boundary::{self, Out, rows};
use crate::context::azulejo_context;
use crate::given::given;
use crate::growing::{self, Output};
use crate::handles::{self, handle};
use crate::kdrt::{azulejo_kdrt_options, azulejo_kdrt_report, of_samples};
use crate::points::{Samples, azulejo_points};
use crate::progress::Watch;
use crate::region::azulejo_region;
use crate::status::{Failure, azulejo_status};

/// A set of the plane that is edited. It keeps its context, which may be freed before it.
pub struct azulejo_plane {
    context: azulejo_context,
    watch: Watch,
    set: RwLock<EditableSet>,
}

impl azulejo_plane {
    /// The set, for a call that changes it.
    fn lock(&self) -> Result<RwLockWriteGuard<'_, EditableSet>, Failure> {
        self.set.try_write().map_err(|error| handles::locked("plane", &error))
    }
}

handle!(azulejo_plane);

/// Makes a set of the plane that is edited. Its samples have ids (azulejo_points_ids), at first 0,
/// 1, 2 and so on in their order. A sample keeps id and bytes; no other gets that id.
///
/// options: `count`, `order` and `measure_covering_radius` must have their defaults, and with
/// positions `leaf_size` too. Given samples have ids of their own, also from 0 on. The handle keeps
/// the progress callback for all its calls.
///
/// positions: any floats of the domain, no two closer than the radius and none closer to a given
/// sample than its clearance. The first azulejo_plane_refill looks for gaps everywhere.
///
/// count: the number of positions. 0: it begins with the set of azulejo_kdrt_sample.
///
/// O(samples) time, and about 40 bytes of memory per sample.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_create(
    context: *const azulejo_context,
    options: *const azulejo_kdrt_options,
    positions: *const f32,
    count: usize,
    out: *mut *mut azulejo_plane,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?.clone();
        // SAFETY: handed on from the caller.
        let (options, positions) =
            unsafe { (growing::read("options", options)?, rows::<f32, 2>("positions", positions, "count", count)?) };
        let (request, watch) = (options.by_radius_only()?, options.watch());
        let set = match positions {
            [] => context.run(watch, |context, progress| EditableSet::sample(context, &request, progress))?,
            _ => EditableSet::of(&request, positions)?,
        };
        Ok(azulejo_plane { context, watch, set: RwLock::new(set) })
    })
}

/// Copies the samples in their present state, with their ids, by rising ids. O(samples).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_points(
    plane: *const azulejo_plane,
    out: *mut *mut azulejo_points,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let plane = unsafe { handles::get("plane", plane) }?;
        let set = plane.set.try_read().map_err(|error| handles::locked("plane", &error))?;
        Ok(azulejo_points::plane(set.samples()))
    })
}

/// Erases the samples in a region. On a torus a sample lies in it if one of its images lies in the
/// box, and one in the ball, so that a brush may reach over the seam. Undo is as of
/// azulejo_psp_erase.
///
/// erased: the erased samples with their ids, by rising ids; NULL if they are not wanted.
///
/// O(samples in the tiles of 12 to 24 radii that the region touches).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_erase(
    plane: *mut azulejo_plane,
    region: *const azulejo_region,
    erased: *mut *mut azulejo_points,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let (plane, erased) = unsafe { (handles::get("plane", plane.cast_const())?, Out::optional("erased", erased)?) };
        // SAFETY: handed on from the caller.
        let region = unsafe { growing::read("region", region) }?.region()?;
        put(erased, plane.lock()?.erase(&region)?);
        Ok(())
    })
}

/// Erases samples by their ids, as azulejo_psp_erase_ids. O(samples in the tiles that they are in).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_erase_ids(
    plane: *mut azulejo_plane,
    ids: *const u64,
    count: usize,
    erased: *mut *mut azulejo_points,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let (plane, erased) = unsafe { (handles::get("plane", plane.cast_const())?, Out::optional("erased", erased)?) };
        // SAFETY: handed on from the caller.
        let ids = unsafe { rows::<u64, 1>("ids", ids, "count", count) }?.as_flattened();
        put(erased, plane.lock()?.erase_ids(ids)?);
        Ok(())
    })
}

/// Puts erased samples back, as azulejo_psp_restore. O(points + samples in the tiles around them).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_restore(
    plane: *mut azulejo_plane,
    points: *const azulejo_points,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let (plane, points) = unsafe { (handles::get("plane", plane.cast_const())?, handles::get("points", points)?) };
        let Samples::Plane(positions) = &points.samples else {
            return Err(Failure::invalid("points", "are samples of a mesh"));
        };
        let samples = Points { ids: points.ids.clone(), ..positions.clone().into() };
        Ok(plane.lock()?.restore(&samples)?)
    })
}

/// Adds given samples, x y each, to those of the options, as azulejo_psp_add_given. O(samples in
/// the tiles that the clearances touch), for each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_add_given(
    plane: *mut azulejo_plane,
    positions: *const f32,
    clearances: *const f64,
    count: usize,
    first_id: *mut u64,
    erased: *mut *mut azulejo_points,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let (plane, erased) = unsafe { (handles::get("plane", plane.cast_const())?, Out::optional("erased", erased)?) };
        // SAFETY: handed on from the caller.
        let (first_id, given) = unsafe { (Out::optional("first_id", first_id)?, given(positions, clearances, count)?) };
        let (first, points) = plane.lock()?.add_given(given)?;
        if let Some(first_id) = first_id {
            first_id.write(first);
        }
        put(erased, points);
        Ok(())
    })
}

/// Removes given samples by their ids: azulejo_plane_refill fills the gaps. O(given samples).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_remove_given(
    plane: *mut azulejo_plane,
    ids: *const u64,
    count: usize,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let plane = unsafe { handles::get("plane", plane.cast_const()) }?;
        // SAFETY: handed on from the caller.
        let ids = unsafe { rows::<u64, 1>("ids", ids, "count", count) }?.as_flattened();
        Ok(plane.lock()?.remove_given(ids)?)
    })
}

/// Makes the set maximal again after edits, but looks only where samples were erased or given
/// samples removed since the last refill. All samples that stand stay as they are. The new ones
/// depend on `seed`, on the edits and on what stands around them, and can lie up to a radius
/// outside a region that was erased.
///
/// added: the new samples with their ids, by rising ids; NULL if they are not wanted.
///
/// report: of the set after the call; `covering_radius` is -1.
///
/// O(area in and around the edited regions + given samples). If cancelled, repeat it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_refill(
    plane: *mut azulejo_plane,
    seed: u64,
    added: *mut *mut azulejo_points,
    report: *mut azulejo_kdrt_report,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let (plane, added) = unsafe { (handles::get("plane", plane.cast_const())?, Out::optional("added", added)?) };
        // SAFETY: handed on from the caller.
        let report = unsafe { Output::optional("report", report) }?;
        let (mut set, start) = (plane.lock()?, Instant::now());
        let points = plane.context.run(plane.watch, |context, progress| set.refill(context, seed, progress))?;
        if let Some(report) = report {
            let seconds = start.elapsed().as_secs_f64();
            report.write(azulejo_kdrt_report { seconds, ..of_samples(set.len(), set.radius()) });
        }
        put(added, points);
        Ok(())
    })
}

/// Frees a set. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_free(plane: *mut azulejo_plane) {
    // SAFETY: handed on from the caller.
    unsafe { handles::free("plane", plane) };
}

/// Hands samples to the caller, if they are wanted.
fn put(out: Option<Out<*mut azulejo_points>>, points: Points<2>) {
    if let Some(out) = out {
        out.write(handles::make(azulejo_points::plane(points)));
    }
}
