//! Regions in which sets are edited.

use azulejo_core::Region;

use crate::boundary::check_reserved;
use crate::growing::{self, growing};
use crate::status::{Failure, azulejo_status};

/// A part of space: the points, boundary included, that lie in a box and within a distance of a
/// centre. Both are without end by default: set `centre` and `radius` for a ball, `min` and `max`
/// for a box, or all four for what they have in common. The plane lies at the height 0.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct azulejo_region {
    /// The size of the struct in bytes; set by the _init function.
    pub struct_size: u32,
    /// Must be 0.
    pub reserved: u32,
    /// The lowest coordinates of the box; default minus infinity.
    pub min: [f64; 3],
    /// The highest coordinates, not below `min`; default infinity.
    pub max: [f64; 3],
    /// The centre of the ball, finite; default 0.
    pub centre: [f64; 3],
    /// The radius of the ball, 0 or more; default infinity.
    pub radius: f64,
}

growing!(azulejo_region requires radius {
    reserved: 0,
    min: Region::EVERYWHERE.min,
    max: Region::EVERYWHERE.max,
    centre: Region::EVERYWHERE.centre,
    radius: Region::EVERYWHERE.radius,
});

impl azulejo_region {
    /// The region; the core checks the bounds.
    pub(crate) fn region(&self) -> Result<Region, Failure> {
        check_reserved(self.reserved)?;
        let &Self { min, max, centre, radius, .. } = self;
        Ok(Region { min, max, centre, radius })
    }
}

/// Writes the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn azulejo_region_init(region: *mut azulejo_region, struct_size: usize) -> azulejo_status {
    // SAFETY: handed on from the caller.
    unsafe { growing::init("region", region, struct_size) }
}
