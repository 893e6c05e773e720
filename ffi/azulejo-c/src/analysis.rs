//! The guarantees, for the user to check.

use std::mem::MaybeUninit;

use azulejo_core::analysis::{coverage, spacing};
use azulejo_core::{Context, Domain};

use crate::boundary::{self, pair, required, rows};
use crate::context::azulejo_context;
use crate::domain::domain;
use crate::mesh::azulejo_mesh;
use crate::status::{Failure, azulejo_status};

/// The smallest distance between two points of the plane, in double arithmetic; on a periodic domain around the torus.
///
/// xy: the points, x y each, in the domain; `count` of them.
///
/// domain_min, domain_max, boundary: two numbers, two numbers and a constant, as in the options.
///
/// out: the distance; infinite for less than two points.
///
/// O(count) time for points that are spread evenly.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_smallest_distance(
    context: Option<&azulejo_context>,
    xy: *const f32,
    count: usize,
    domain_min: *const f64,
    domain_max: *const f64,
    boundary: i32,
    out: Option<&mut MaybeUninit<f64>>,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { measure_plane(context, xy, count, [domain_min, domain_max], boundary, out, spacing::smallest_distance_2d) }
}

/// The covering radius of points of the plane: how far the place of the domain that is farthest from all of them is. A
/// set is maximal for a radius that is not smaller. On a periodic domain points cover around the torus.
///
/// xy: the points, x y each, in the domain; `count` of them.
///
/// domain_min, domain_max, boundary: two numbers, two numbers and a constant, as in the options.
///
/// out: the covering radius, by less than a billionth of it too small; infinite for no point.
///
/// Found exactly, by subdividing the domain: O(count) time for points that leave no large holes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_covering_radius(
    context: Option<&azulejo_context>,
    xy: *const f32,
    count: usize,
    domain_min: *const f64,
    domain_max: *const f64,
    boundary: i32,
    out: Option<&mut MaybeUninit<f64>>,
) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { measure_plane(context, xy, count, [domain_min, domain_max], boundary, out, coverage::covering_radius_2d) }
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
    boundary::call(|| {
        let out = required("out", out)?;
        let context = required("context", context)?.shared.clone();
        // SAFETY: handed on from the caller.
        let points = unsafe { rows::<f32, 3>("positions", positions, "count", count) }?;
        out.write(spacing::smallest_distance_3d(&context, points)?);
        Ok(())
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
/// O(probes + count) time. Probes do not prove coverage: they find a gap of a millionth of the area with two million of
/// them most of the time, and miss smaller ones.
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
    boundary::call(|| {
        let out = required("out", out)?;
        let context = required("context", context)?.shared.clone();
        let mesh = required("mesh", mesh)?.shared.clone();
        // SAFETY: handed on from the caller.
        let points = unsafe { rows::<f32, 3>("positions", positions, "count", count) }?;
        if probes == 0 {
            return Err(Failure::invalid("probes", "0 is not at least 1"));
        }
        out.write(coverage::surface_uncovered_fraction(&context, &mesh, points, radius, probes, seed)?);
        Ok(())
    })
}

/// A figure of points of the plane.
///
/// # Safety
/// Unless the checks fail, `xy` leads to `count` pairs of numbers, and the corners to one each.
unsafe fn measure_plane(
    context: Option<&azulejo_context>,
    xy: *const f32,
    count: usize,
    [domain_min, domain_max]: [*const f64; 2],
    boundary: i32,
    out: Option<&mut MaybeUninit<f64>>,
    measure: fn(&Context, &Domain, &[[f32; 2]]) -> azulejo_core::Result<f64>,
) -> azulejo_status {
    boundary::call(|| {
        let out = required("out", out)?;
        let context = required("context", context)?.shared.clone();
        // SAFETY: handed on from the caller.
        let (points, min, max) = unsafe {
            (
                rows::<f32, 2>("xy", xy, "count", count)?,
                pair("domain_min", domain_min)?,
                pair("domain_max", domain_max)?,
            )
        };
        out.write(measure(&context, &domain(min, max, boundary)?, points)?);
        Ok(())
    })
}
