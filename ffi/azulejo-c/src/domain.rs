//! Rectangles of the plane, as they stand in options and arguments.

use azulejo_core::{Boundary, Context, Domain, Progress};

use crate::boundary::{pair, required, rows};
use crate::context::azulejo_context;
use crate::options::Watch;
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

/// A set of the plane that is to be measured: its points, its domain, and whose threads do it.
pub(crate) struct PlaneSet<'a> {
    context: &'a azulejo_context,
    points: &'a [[f32; 2]],
    domain: Domain,
}

impl<'a> PlaneSet<'a> {
    /// The set of the caller's arguments: `count` points at `xy`, and the two corners.
    ///
    /// # Safety
    /// Unless the checks fail, `xy` leads to `count` pairs of numbers, and the corners to one each.
    pub(crate) unsafe fn read(
        context: Option<&'a azulejo_context>,
        xy: *const f32,
        count: usize,
        [domain_min, domain_max]: [*const f64; 2],
        boundary: i32,
    ) -> Result<Self, Failure> {
        let context = required("context", context)?;
        // SAFETY: handed on from the caller.
        let (points, min, max) = unsafe {
            (
                rows::<f32, 2>("xy", xy, "count", count)?,
                pair("domain_min", domain_min)?,
                pair("domain_max", domain_max)?,
            )
        };
        Ok(Self { context, points, domain: domain(min, max, boundary)? })
    }

    /// Runs a call of the core.
    pub(crate) fn run<T>(
        &self,
        call: impl FnOnce(&Context, &Domain, &[[f32; 2]], Option<&Progress>) -> azulejo_core::Result<T>,
    ) -> Result<T, Failure> {
        self.context.run(Watch::NOBODY, |context, progress| call(context, &self.domain, self.points, progress))
    }
}
