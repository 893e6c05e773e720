//! The guarantees, for the user to check: spacing and coverage.

use std::mem::MaybeUninit;

use azulejo_core::analysis::{coverage, spacing};

use crate::boundary::{self, required, rows};
use crate::context::azulejo_context;
use crate::domain::{PlaneSet, azulejo_plane_set};
use crate::growing::{self, Growing, Output, growing};
use crate::mesh::{SurfaceSet, azulejo_mesh};
use crate::progress::Watch;
use crate::status::{Failure, azulejo_status};

/// The smallest distance between two points of the plane, in double arithmetic; on a periodic domain around the torus.
///
/// set: the points.
///
/// out: the distance; infinite for less than two points.
///
/// O(count) time for points that are spread evenly.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_smallest_distance(
    context: Option<&azulejo_context>,
    set: *const azulejo_plane_set,
    out: Option<&mut MaybeUninit<f64>>,
) -> azulejo_status {
    boundary::answer(out, || {
        // SAFETY: handed on from the caller.
        let set = unsafe { PlaneSet::read(context, set) }?;
        set.run(spacing::smallest_distance_2d)
    })
}

/// The covering radius of points of the plane: how far the place of the domain that is farthest from all of them is. A
/// set is maximal for a radius that is not smaller. On a periodic domain points cover around the torus.
///
/// set: the points.
///
/// out: the covering radius, by less than a billionth of it too small; infinite for no point.
///
/// Found exactly, by subdividing the domain: O(count log count) time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_covering_radius(
    context: Option<&azulejo_context>,
    set: *const azulejo_plane_set,
    out: Option<&mut MaybeUninit<f64>>,
) -> azulejo_status {
    boundary::answer(out, || {
        // SAFETY: handed on from the caller.
        let set = unsafe { PlaneSet::read(context, set) }?;
        set.run(coverage::covering_radius_2d)
    })
}

/// The smallest straight distance between two points in space, in double arithmetic.
///
/// positions: the points, x y z each; `count` of them.
///
/// out: the distance; infinite for less than two points.
///
/// O(count) time for points that are spread evenly.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_space_smallest_distance(
    context: Option<&azulejo_context>,
    positions: *const f32,
    count: usize,
    out: Option<&mut MaybeUninit<f64>>,
) -> azulejo_status {
    boundary::answer(out, || {
        let context = required("context", context)?;
        // SAFETY: handed on from the caller.
        let points = unsafe { rows::<f32, 3>("positions", positions, "count", count) }?;
        context.run(Watch::NONE, |context, progress| spacing::smallest_distance_3d(context, points, progress))
    })
}

/// The part of a surface that is farther than a radius from every one of some points, seen by random probes.
///
/// positions: the points, x y z each; `count` of them.
///
/// radius: above 0, in the units of the mesh.
///
/// probes, seed: how many random places of the surface are looked at, spread evenly over its area, and which.
///
/// out: the share of probes that are not covered, 0 to 1; 0 if the mask of the mesh leaves nothing to be looked at.
///
/// O(probes + count) time. Probes do not prove coverage, as azulejo_mesh_coverage does: they find a gap of a millionth of the
/// area with two million of them most of the time, and miss smaller ones.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_uncovered_fraction(
    context: Option<&azulejo_context>,
    mesh: Option<&azulejo_mesh>,
    positions: *const f32,
    count: usize,
    radius: f64,
    probes: u64,
    seed: u64,
    out: Option<&mut MaybeUninit<f64>>,
) -> azulejo_status {
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

/// How a set covers a domain or a surface with disks of a radius. See azulejo_plane_coverage, azulejo_mesh_coverage.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_coverage_report {
    /// The size of the caller's struct in bytes; set by the init function.
    pub struct_size: u32,
    /// 0.
    pub reserved: u32,
    /// The covering radius: the distance from the samples of the place that is farthest from all of them. Infinite for no
    /// sample.
    pub covering_radius: f64,
    /// The number of gaps; 0 for a set that is maximal for the radius.
    pub gaps: u64,
}

growing!(azulejo_coverage_report requires covering_radius { reserved: 0, covering_radius: 0.0, gaps: 0 });

impl From<coverage::Coverage> for azulejo_coverage_report {
    fn from(coverage::Coverage { farthest, gaps }: coverage::Coverage) -> Self {
        Self { covering_radius: farthest, gaps: gaps as u64, ..Self::DEFAULT }
    }
}

/// Writes zeros. `struct_size` is sizeof *report.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_coverage_report_init(
    report: *mut azulejo_coverage_report,
    struct_size: usize,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("report", report, struct_size) }
}

/// The gaps that points of the plane leave: the connected parts of the domain, or of the torus, that are farther than a
/// radius from all of them. With no gap the set is maximal for the radius.
///
/// set: the points.
///
/// radius: above 0, in the units of the domain.
///
/// out: the covering radius, as azulejo_plane_covering_radius finds it, and the number of gaps. Every gap deeper than a
/// millionth of the mean spacing is found, however small, and the deepest in any case. An empty set has one.
///
/// Found exactly, by the Voronoi diagram: O(count log count) time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_coverage(
    context: Option<&azulejo_context>,
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

/// The gaps that samples leave on a mesh, by straight distance: groups of places that are farther than a radius from all of
/// them, in which each place is within half of the radius of another one. With no gap the set is maximal for the radius.
///
/// positions: the samples, x y z each; `count` of them. They need not lie on the mesh.
///
/// radius: above 0, in the units of the mesh.
///
/// out: the covering radius, by less than a billionth of it too small, and the number of gaps. Every gap deeper than a
/// millionth of the radius is found, however small, and the deepest in any case. An empty set has infinity and 1 at least;
/// a mesh without area, or whose mask leaves none, has 0 and 0.
///
/// Found exactly, by subdividing the triangles: O((count + triangles) log count) time for samples that are spread evenly,
/// and about 100 pieces for each square of the radius that is uncovered.
///
/// Errors: AZULEJO_ERROR_INVALID_ARGUMENT, AZULEJO_ERROR_CANCELLED, and AZULEJO_ERROR_TOO_LARGE where more than about 600,000
/// times the square of the radius is uncovered.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_mesh_coverage(
    context: Option<&azulejo_context>,
    mesh: Option<&azulejo_mesh>,
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
