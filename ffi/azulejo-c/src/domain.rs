//! Rectangles of the plane, as they stand in options and arguments.

use azulejo_core::{Boundary, Domain};

use crate::boundary::{pair, rows};
use crate::status::Failure;

/// The domain is a torus: distances wrap with the period domain_max - domain_min.
pub const AZULEJO_BOUNDARY_PERIODIC: i32 = 0;
/// Nothing lies beyond the domain: only its own samples count, and they alone cover it.
pub const AZULEJO_BOUNDARY_BOUNDED: i32 = 1;

/// The domain of the caller; the core checks the corners.
pub(crate) fn domain(min: [f64; 2], max: [f64; 2], boundary: i32) -> Result<Domain, Failure> {
    let boundary = match boundary {
        AZULEJO_BOUNDARY_PERIODIC => Boundary::Periodic,
        AZULEJO_BOUNDARY_BOUNDED => Boundary::Bounded,
        other => return Err(Failure::invalid("boundary", format!("{other} is no AZULEJO_BOUNDARY_ constant"))),
    };
    Ok(Domain { min, max, boundary })
}

/// A set in the plane and its domain, from arguments of the caller: `count` points at `xy`, and the two corners.
///
/// # Safety
/// Unless the checks fail, `xy` leads to `count` pairs of numbers, and the corners to one each.
pub(crate) unsafe fn points_in_domain<'a>(
    xy: *const f32,
    count: usize,
    [domain_min, domain_max]: [*const f64; 2],
    boundary: i32,
) -> Result<(&'a [[f32; 2]], Domain), Failure> {
    // SAFETY: handed on from the caller.
    let (points, min, max) = unsafe {
        (rows::<f32, 2>("xy", xy, "count", count)?, pair("domain_min", domain_min)?, pair("domain_max", domain_max)?)
    };
    Ok((points, domain(min, max, boundary)?))
}
