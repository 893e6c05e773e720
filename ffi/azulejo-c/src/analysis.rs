//! The guarantees, for the user to check: spacing and coverage.

use azulejo_core::analysis::{coverage, spacing};

use crate::boundary::{self, Out, rows};
use crate::context::azulejo_context;
use crate::domain::{PlaneSet, azulejo_plane_set};
use crate::growing::{self, Growing, Output, growing};
use crate::handles;
use crate::mesh::{SurfaceSet, azulejo_mesh};
use crate::progress::Watch;
use crate::status::{Failure, azulejo_status};

/// The smallest distance between two points of the plane, in double arithmetic; on a periodic
/// domain around the torus.
///
/// set: the points.
///
/// out: the distance in the units of the domain; infinite for fewer than two points.
///
/// O(count) time for evenly spread points.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_smallest_distance(
    context: *const azulejo_context,
    set: *const azulejo_plane_set,
    out: *mut f64,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    boundary::answer(out, || {
        // SAFETY: handed on from the caller.
        let set = unsafe { PlaneSet::read(context, set) }?;
        set.run(spacing::smallest_distance_2d)
    })
}

/// The covering radius of points of the plane; on a periodic domain around the torus. The set is
/// maximal for every radius that is not smaller.
///
/// set: the points.
///
/// out: the covering radius in the units of the domain, too small by less than a billionth of it;
/// infinite for no point.
///
/// Found exactly, by subdivision of the domain: O(count * log count) time for evenly spread points.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_covering_radius(
    context: *const azulejo_context,
    set: *const azulejo_plane_set,
    out: *mut f64,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    boundary::answer(out, || {
        // SAFETY: handed on from the caller.
        let set = unsafe { PlaneSet::read(context, set) }?;
        set.run(coverage::covering_radius_2d)
    })
}

/// The smallest straight distance between two points in space, in double arithmetic.
///
/// positions: the points, x y z each, finite; `count` of them.
///
/// out: the distance in the units of the positions; infinite for fewer than two points.
///
/// O(count) time for evenly spread points.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_space_smallest_distance(
    context: *const azulejo_context,
    positions: *const f32,
    count: usize,
    out: *mut f64,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    boundary::answer(out, || {
        // SAFETY: handed on from the caller.
        let context = unsafe { handles::get("context", context) }?;
        // SAFETY: handed on from the caller.
        let points = unsafe { rows::<f32, 3>("positions", positions, "count", count) }?;
        context.run(Watch::NONE, |context, progress| spacing::smallest_distance_3d(context, points, progress))
    })
}

/// The fraction of a surface that is farther than a radius from every sample, estimated by random
/// probes.
///
/// positions: the samples, x y z each, finite; `count` of them. They need not lie on the mesh.
///
/// radius: above 0, in the units of the mesh.
///
/// probes: the number of random places of the surface that are examined, at least 1, uniform over
/// its area.
///
/// seed: selects the places.
///
/// out: the fraction of the probes that are uncovered, 0 to 1; 0 if the mask of the mesh leaves out
/// everything.
///
/// O(probes + count) time for evenly spread samples. Probes do not prove coverage,
/// azulejo_mesh_coverage does.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_uncovered_fraction(
    context: *const azulejo_context,
    mesh: *const azulejo_mesh,
    positions: *const f32,
    count: usize,
    radius: f64,
    probes: u64,
    seed: u64,
    out: *mut f64,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    let out = unsafe { Out::new(out) };
    boundary::answer(out, || {
        // SAFETY: handed on from the caller.
        let set = unsafe { SurfaceSet::read(context, mesh, positions, count) }?;
        if probes == 0 {
            return Err(Failure::invalid("probes", "0 is not at least 1"));
        }
        set.run(|context, mesh, points, progress| {
            coverage::surface_uncovered_fraction(context, mesh, points, radius, probes, seed, progress)
        })
    })
}

/// The coverage of a domain or a surface by disks of a radius: the result of
/// azulejo_plane_coverage and azulejo_mesh_coverage.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_coverage_report {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// Always 0.
    pub reserved: u32,
    /// The covering radius, in the units of the domain or mesh; infinite for no sample.
    pub covering_radius: f64,
    /// The number of gaps: 0 if the set is maximal for the radius, up to the rounding of floats.
    pub gaps: u64,
}

growing!(azulejo_coverage_report requires covering_radius { reserved: 0, covering_radius: 0.0, gaps: 0 });

impl From<coverage::Coverage> for azulejo_coverage_report {
    fn from(coverage::Coverage { farthest, gaps, .. }: coverage::Coverage) -> Self {
        Self { covering_radius: farthest, gaps: gaps as u64, ..Self::DEFAULT }
    }
}

/// Writes zeros and the size. `struct_size` is sizeof *report.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_coverage_report_init(
    report: *mut azulejo_coverage_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}

/// Counts the gaps that points of the plane leave: the connected parts of the domain, or of the
/// torus, that are farther than a radius from all points, by more than 6 times the spacing of
/// floats at the largest coordinate of the domain. With no gap the set is maximal for the radius,
/// as "Terms" has it, and all maximal sets of this library have none.
///
/// set: the points.
///
/// radius: above 0, in the units of the domain.
///
/// out: the covering radius, as azulejo_plane_covering_radius finds it, and the number of gaps.
/// Every gap deeper than a millionth of the mean spacing is found, however small, and the deepest
/// in any case. An empty set has one gap.
///
/// Found exactly, by the Voronoi diagram: O(count * log count) time for evenly spread points.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_TOO_LARGE, AZULEJO_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_coverage(
    context: *const azulejo_context,
    set: *const azulejo_plane_set,
    radius: f64,
    out: *mut azulejo_coverage_report,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let (out, set) = unsafe { (Output::required("out", out)?, PlaneSet::read(context, set)?) };
        out.write(set.run(|context, domain, points, progress| {
            coverage::coverage_2d(context, domain, points, radius, progress)
        })?);
        Ok(())
    })
}

/// Counts the gaps that samples leave on a mesh, by straight distance: groups of places that are
/// farther than a radius from all samples, by more than 6 times the spacing of floats at the
/// largest coordinate of the mesh, each within half of the radius of another place of its group.
/// With no gap the set is maximal for the radius, as "Terms" has it, and all maximal sets of this
/// library have none.
///
/// positions: the samples, x y z each, finite; `count` of them. They need not lie on the mesh.
///
/// radius: above 0, in the units of the mesh.
///
/// out: the covering radius, too small by less than a billionth of it, and the number of gaps.
/// Every gap deeper than a millionth of the radius is found, however small, and the deepest in any
/// case. An empty set has an infinite radius and at least one gap; a mesh without area, or whose
/// mask leaves out everything, has 0 and 0.
///
/// Found exactly, by subdivision of the triangles: O((count + triangles) * log count) time for
/// evenly spread samples, and about 100 pieces per radius^2 of uncovered area.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT; AZULEJO_ERROR_TOO_LARGE, also if more than about 600,000
/// * radius^2 of the area is uncovered; AZULEJO_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_coverage(
    context: *const azulejo_context,
    mesh: *const azulejo_mesh,
    positions: *const f32,
    count: usize,
    radius: f64,
    out: *mut azulejo_coverage_report,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let (out, set) = unsafe { (Output::required("out", out)?, SurfaceSet::read(context, mesh, positions, count)?) };
        out.write(set.run(|context, mesh, points, progress| {
            coverage::surface_coverage(context, mesh, points, radius, progress)
        })?);
        Ok(())
    })
}
