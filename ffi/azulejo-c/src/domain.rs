//! Rectangles of the plane and cuboids of space, as they stand in options and arguments.

use azulejo_core::{Boundary, Context, Domain, Progress};

use crate::boundary::rows;
use crate::context::azulejo_context;
use crate::growing::{self, growing};
use crate::handles;
use crate::progress::Watch;
use crate::status::{Failure, azulejo_status};

/// The domain is a torus: distances wrap with the period domain_max - domain_min.
pub const AZULEJO_BOUNDARY_PERIODIC: u32 = 0;
/// Samples beyond the edges of the domain neither exist nor cover anything.
pub const AZULEJO_BOUNDARY_BOUNDED: u32 = 1;

/// The domain of the caller; the core checks the corners.
pub(crate) fn domain<const D: usize>(min: [f64; D], max: [f64; D], boundary: u32) -> Result<Domain<D>, Failure> {
    let boundary = match boundary {
        AZULEJO_BOUNDARY_PERIODIC => Boundary::Periodic,
        AZULEJO_BOUNDARY_BOUNDED => Boundary::Bounded,
        other => return Err(Failure::invalid("boundary", format!("{other} is no AZULEJO_BOUNDARY_ constant"))),
    };
    Ok(Domain { min, max, boundary })
}

/// Points of the plane and their domain: the input of the calls that measure them.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_plane_set {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// An AZULEJO_BOUNDARY_ constant; default periodic.
    pub boundary: u32,
    /// The points, x y each. Default NULL: none.
    pub positions: *const f32,
    /// The number of points; default 0.
    pub count: usize,
    /// The lower corner of the domain, x y; default 0 0.
    pub domain_min: [f64; 2],
    /// The upper one, above it; default 1 1. Sides are within 2^100 of each other.
    pub domain_max: [f64; 2],
}

growing!(azulejo_plane_set requires domain_max {
    boundary: AZULEJO_BOUNDARY_PERIODIC,
    positions: std::ptr::null(),
    count: 0,
    domain_min: [0.0; 2],
    domain_max: [1.0; 2],
});

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_plane_set_init(set: *mut azulejo_plane_set, struct_size: usize) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("set", set, struct_size) }
}

/// Points of a cuboid and their domain: the input of the calls that measure them.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_space_set {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// An AZULEJO_BOUNDARY_ constant; default periodic.
    pub boundary: u32,
    /// The points, x y z each. Default NULL: none.
    pub positions: *const f32,
    /// The number of points; default 0.
    pub count: usize,
    /// The lower corner of the domain, x y z; default 0 0 0.
    pub domain_min: [f64; 3],
    /// The upper one, above it; default 1 1 1. As in azulejo_plane_set.
    pub domain_max: [f64; 3],
}

growing!(azulejo_space_set requires domain_max {
    boundary: AZULEJO_BOUNDARY_PERIODIC,
    positions: std::ptr::null(),
    count: 0,
    domain_min: [0.0; 3],
    domain_max: [1.0; 3],
});

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_space_set_init(set: *mut azulejo_space_set, struct_size: usize) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("set", set, struct_size) }
}

/// A set that is to be measured, and the context that does it.
pub(crate) struct MeasuredSet<'a, const D: usize> {
    context: &'a azulejo_context,
    pub(crate) points: &'a [[f32; D]],
    domain: Domain<D>,
}

/// A set of the plane.
pub(crate) type PlaneSet<'a> = MeasuredSet<'a, 2>;

/// A set of a cuboid.
pub(crate) type SpaceSet<'a> = MeasuredSet<'a, 3>;

/// The `read` of a set in the caller's struct.
macro_rules! read {
    ($set:ident, $dimension:literal) => {
        impl<'a> MeasuredSet<'a, $dimension> {
            /// The set of the caller.
            ///
            /// # Safety
            /// Unless the checks fail, `set` leads to as many bytes as its `struct_size` says, and its `positions` to `count`
            /// points that are not changed during `'a`; `context` is as in [`handles::get`].
            pub(crate) unsafe fn read(context: *const azulejo_context, set: *const $set) -> Result<Self, Failure> {
                // SAFETY: handed on from the caller.
                let context = unsafe { handles::get("context", context) }?;
                // SAFETY: handed on from the caller.
                let set = unsafe { growing::read("set", set) }?;
                // SAFETY: likewise.
                let points = unsafe { rows::<f32, $dimension>("positions", set.positions, "count", set.count) }?;
                Ok(Self { context, points, domain: domain(set.domain_min, set.domain_max, set.boundary)? })
            }
        }
    };
}

read!(azulejo_plane_set, 2);
read!(azulejo_space_set, 3);

impl<const D: usize> MeasuredSet<'_, D> {
    /// Runs a call of the core.
    pub(crate) fn run<T>(
        &self,
        call: impl FnOnce(&Context, &Domain<D>, &[[f32; D]], Option<&Progress>) -> azulejo_core::Result<T>,
    ) -> Result<T, Failure> {
        self.context.run(Watch::NONE, |context, progress| call(context, &self.domain, self.points, progress))
    }
}
