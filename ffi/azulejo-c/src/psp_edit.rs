//! PSP: sets on meshes that are edited.

use azulejo_core::Points;
use azulejo_core::psp::sample_region;

use crate::boundary::{self, Out, rows};
use crate::context::azulejo_context;
use crate::given::given;
use crate::growing::{self, Output};
use crate::handles;
use crate::mesh::azulejo_mesh;
use crate::points::{Samples, azulejo_points};
use crate::psp::{azulejo_psp, azulejo_psp_options};
use crate::psp_report::azulejo_psp_report;
use crate::region::azulejo_region;
use crate::status::{Failure, azulejo_status};

/// Erases the samples of a set in a region. From the first edit on the set can be filled again
/// (azulejo_psp_refill, azulejo_psp_fill) but makes no more iterations, and every sample has an id
/// (azulejo_points_ids): 0, 1, 2 and so on in their order at that time. A sample keeps its id and
/// all its bytes until it is erased, and no other sample ever gets that id.
///
/// To undo a stroke of a brush, erase what azulejo_psp_refill added, by azulejo_psp_erase_ids, and
/// put back what this call erased, by azulejo_psp_restore: the set is then as before, bit for bit.
/// To redo it, erase the same region again and refill with the same seed.
///
/// erased: the erased samples with their ids, by rising ids; NULL if they are not wanted.
///
/// O(samples in the cubes of 24 radii that the region touches); the first edit O(samples).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_erase(
    psp: *mut azulejo_psp,
    region: *const azulejo_region,
    erased: *mut *mut azulejo_points,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let (psp, erased) = unsafe { (handles::get("psp", psp.cast_const())?, Out::optional("erased", erased)?) };
        // SAFETY: handed on from the caller.
        let region = unsafe { growing::read("region", region) }?.region()?;
        put(erased, psp.lock()?.editable().erase(&region)?);
        Ok(())
    })
}

/// Erases samples by their ids.
///
/// ids: `count` ids, each of a sample of the set, none twice.
///
/// erased: as in azulejo_psp_erase.
///
/// O(samples in the cubes of 24 radii that they are in).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_erase_ids(
    psp: *mut azulejo_psp,
    ids: *const u64,
    count: usize,
    erased: *mut *mut azulejo_points,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let (psp, erased) = unsafe { (handles::get("psp", psp.cast_const())?, Out::optional("erased", erased)?) };
        // SAFETY: handed on from the caller.
        let ids = unsafe { rows::<u64, 1>("ids", ids, "count", count) }?.as_flattened();
        put(erased, psp.lock()?.editable().erase_ids(ids)?);
        Ok(())
    })
}

/// Puts samples back that were erased from the set, with their ids and all their bytes.
///
/// points: from an edit of this handle.
///
/// O(points + samples in the cubes of 24 radii around them).
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT also for samples that are not this set's, that stand
/// already, or that are too close to a sample or a given sample by now.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_restore(psp: *mut azulejo_psp, points: *const azulejo_points) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let (psp, points) = unsafe { (handles::get("psp", psp.cast_const())?, handles::get("points", points)?) };
        let Samples::Space(samples) = &points.samples else {
            return Err(Failure::invalid("points", "are samples of the plane"));
        };
        // The fields that are kept apart from the others.
        let samples = Points { ids: points.ids.clone(), ..Points::clone(samples) };
        Ok(psp.lock()?.editable().restore(&samples)?)
    })
}

/// Adds given samples to those of the options, and erases samples within their clearances.
///
/// clearances: one for each, 0 or more; NULL: the radius of the set.
///
/// first_id: the id of the first of them, which the others follow; NULL if it is not wanted. Those
/// of the options have the ids from 0 on. Samples have ids of their own.
///
/// erased: as in azulejo_psp_erase.
///
/// O(samples in the cubes of 24 radii that the clearances touch), for each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_add_given(
    psp: *mut azulejo_psp,
    positions: *const f32,
    clearances: *const f64,
    count: usize,
    first_id: *mut u64,
    erased: *mut *mut azulejo_points,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let (psp, erased) = unsafe { (handles::get("psp", psp.cast_const())?, Out::optional("erased", erased)?) };
        // SAFETY: handed on from the caller.
        let (first_id, given) = unsafe { (Out::optional("first_id", first_id)?, given(positions, clearances, count)?) };
        let (first, points) = psp.lock()?.editable().add_given(given)?;
        if let Some(first_id) = first_id {
            first_id.write(first);
        }
        put(erased, points);
        Ok(())
    })
}

/// Removes given samples by their ids: azulejo_psp_refill then fills what they covered.
///
/// O(given samples).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_remove_given(
    psp: *mut azulejo_psp,
    ids: *const u64,
    count: usize,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let psp = unsafe { handles::get("psp", psp.cast_const()) }?;
        // SAFETY: handed on from the caller.
        let ids = unsafe { rows::<u64, 1>("ids", ids, "count", count) }?.as_flattened();
        Ok(psp.lock()?.editable().remove_given(ids)?)
    })
}

/// Makes the set maximal again after edits: as azulejo_psp_fill, but only where samples were erased
/// or given samples removed since the last refill. All samples that stand stay as they are.
///
/// The new samples depend on `seed`, on the edits and on what stands within a radius of a region.
///
/// added: the new samples with their ids, by rising ids; NULL if they are not wanted.
///
/// O(surface in and around the edited regions + given samples); at first also O(triangles).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_refill(
    psp: *mut azulejo_psp,
    seed: u64,
    added: *mut *mut azulejo_points,
    report: *mut azulejo_psp_report,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let (psp, added) = unsafe { (handles::get("psp", psp.cast_const())?, Out::optional("added", added)?) };
        // SAFETY: handed on from the caller.
        let report = unsafe { Output::optional("report", report) }?;
        let mut state = psp.lock()?;
        let set = state.editable();
        let (points, done) = psp.run(|context, progress| set.refill(context, seed, progress))?;
        if let Some(report) = report {
            report.write(done);
        }
        put(added, points);
        Ok(())
    })
}

/// Samples the part of a mesh in a region, once, as azulejo_psp_fill: what lies outside counts as
/// covered. Samples stand in the region, or at most 6 radii outside it on a triangle that it
/// touches. For many edits of one set see azulejo_psp_erase.
///
/// options: `iterations`, `maximal`, `count`, `order`, `projectors`, `priority` and `engine` must
/// have their defaults.
///
/// out: the samples with normals, triangles and barycentrics.
///
/// report: `rho` is 0, `covering_radius` and `uncovered_after` are -1.
///
/// O(surface in the region + given samples + triangles / 16); the first call on a mesh
/// O(triangles).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_psp_sample_region(
    context: *const azulejo_context,
    mesh: *const azulejo_mesh,
    options: *const azulejo_psp_options,
    region: *const azulejo_region,
    out: *mut *mut azulejo_points,
    report: *mut azulejo_psp_report,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    handles::create(out, || {
        // SAFETY: handed on from the caller.
        let (context, mesh) = unsafe { (handles::get("context", context)?, handles::get("mesh", mesh)?) };
        // SAFETY: handed on from the caller.
        let (options, report) = unsafe { (growing::read("options", options)?, Output::optional("report", report)?) };
        // SAFETY: handed on from the caller.
        let (request, region) =
            unsafe { (options.request_of_region("in a region")?, growing::read("region", region)?.region()?) };
        let mesh = mesh.shared.clone();
        let (samples, done) = context
            .run(options.watch(), |context, progress| sample_region(context, &mesh, &region, &request, progress))?;
        if let Some(report) = report {
            report.write(done);
        }
        Ok(azulejo_points::space(samples))
    })
}

/// Hands samples to the caller, if they are wanted.
fn put(out: Option<Out<*mut azulejo_points>>, points: Points<3>) {
    if let Some(out) = out {
        out.write(handles::make(azulejo_points::space(points)));
    }
}
