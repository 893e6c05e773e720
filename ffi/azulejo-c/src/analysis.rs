//! The guarantees, for the user to check: spacing and coverage.

use azulejo_core::analysis::{coverage, spacing};

use crate::boundary::{self, Out, rows};
use crate::context::azulejo_context;
use crate::domain::{PlaneSet, SpaceSet, azulejo_plane_set, azulejo_space_set};
use crate::growing::{self, Growing, Output, growing};
use crate::handles;
use crate::mesh::{SurfaceSet, azulejo_mesh};
use crate::progress::Watch;
use crate::status::{Failure, azulejo_status};

/// The smallest distance between two points of the plane, in double arithmetic, on a periodic
/// domain around the torus; infinite for fewer than two points. O(count) time.
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

/// The covering radius of points of the plane, on a periodic domain around the torus, too small by
/// less than a billionth of it; infinite for no point. Exact, by subdivision: O(count * log count).
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

/// The smallest straight distance between two points in space, x y z each, in double arithmetic;
/// infinite for fewer than two points. O(count) time.
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
/// probes; 0 if the mask of the mesh leaves out everything. Probes do not prove coverage,
/// azulejo_mesh_coverage does. O(probes + count) time.
///
/// positions: the samples, x y z each. They need not lie on the mesh.
///
/// radius: above 0.
///
/// probes: the number of random places, at least 1, uniform over the area of the surface.
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

/// The coverage of a domain or a surface by disks or balls of a radius.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_coverage_report {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// Always 0.
    pub reserved: u32,
    /// The covering radius; infinite for no sample.
    pub covering_radius: f64,
    /// The number of gaps: 0 if the set is maximal for the radius.
    pub gaps: u64,
}

growing!(azulejo_coverage_report requires covering_radius { reserved: 0, covering_radius: 0.0, gaps: 0 });

impl From<coverage::Coverage> for azulejo_coverage_report {
    fn from(coverage::Coverage { farthest, gaps, .. }: coverage::Coverage) -> Self {
        Self { covering_radius: farthest, gaps: gaps as u64, ..Self::DEFAULT }
    }
}

/// Writes zeros and the size.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_coverage_report_init(
    report: *mut azulejo_coverage_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}

/// Counts the gaps that points of the plane leave: the connected parts of the domain, or of the
/// torus, that are farther than a radius from all points, by more than 6 float spacings. With no
/// gap the set is maximal for the radius, as all maximal sets of this library.
///
/// radius: above 0.
///
/// out: the covering radius, as azulejo_plane_covering_radius finds it, and the number of gaps.
/// Every gap deeper than a millionth of the mean spacing is found, however small, and the deepest
/// in any case. An empty set has one gap.
///
/// O(count * log count) time: they are found exactly, by the Voronoi diagram.
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

/// Counts the gaps that points of a cuboid leave: groups of places that are farther than a radius
/// from all points, by more than 6 float spacings, each within half of the radius of another place
/// of its group. With no gap the set is maximal for the radius.
///
/// radius: above 0.
///
/// out: the covering radius, too small by less than a billionth of it, and the number of gaps.
/// Every gap deeper than a millionth of the radius is found, however small, and the deepest in any
/// case. An empty set has an infinite radius and one gap.
///
/// O(count * log count) time, by subdivision, and some 1,000 cells per uncovered radius^3.
///
/// Errors: AZULEJO_ERROR_TOO_LARGE also if more than about 25,000 * radius^3 is uncovered.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_space_coverage(
    context: *const azulejo_context,
    set: *const azulejo_space_set,
    radius: f64,
    out: *mut azulejo_coverage_report,
) -> azulejo_status {
    boundary::call(|| {
        // SAFETY: handed on from the caller.
        let (out, set) = unsafe { (Output::required("out", out)?, SpaceSet::read(context, set)?) };
        out.write(set.run(|context, domain, points, progress| {
            coverage::coverage_3d(context, domain, points, radius, progress)
        })?);
        Ok(())
    })
}

/// Counts the gaps that samples leave on a mesh, by straight distance, as azulejo_space_coverage.
///
/// positions: the samples, x y z each. They need not lie on the mesh.
///
/// radius: above 0.
///
/// out: the covering radius, too small by less than a billionth of it, and the number of gaps.
/// Every gap deeper than a millionth of the radius is found, however small, and the deepest in any
/// case. An empty set has an infinite radius and at least one gap; no area has 0 and 0.
///
/// O((count + triangles) * log count) time, and about 100 pieces per radius^2 of gaps.
///
/// Errors: AZULEJO_ERROR_TOO_LARGE also if more than about 600,000 * radius^2 is uncovered.
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
