//! Embree's structs of N rays and their hits: how they are laid out, and how they are traced.

use std::ffi::c_int;
use std::mem::offset_of;

use embree4_sys::*;

/// The widest packet.
pub(super) const MAX_WIDTH: usize = 16;

/// Which array of a struct of N rays and their hits is which: word `field * N + lane`.
pub(super) mod field {
    pub const ORIGIN: usize = 0;
    pub const DIRECTION: usize = 4;
    pub const TFAR: usize = 8;
    pub const MASK: usize = 9;
    pub const ID: usize = 10;
    /// The first field of the hit.
    pub const HIT: usize = 12;
    pub const U: usize = 15;
    pub const V: usize = 16;
    pub const TRIANGLE: usize = 17;
    pub const GEOMETRY: usize = 18;
    pub const COUNT: usize = 19;
}

/// One of Embree's structs of N rays and their hits.
///
/// # Safety
/// The struct begins with the arrays of N words (`f32` or `u32`) that [`field`] names, and nothing between them.
pub(super) unsafe trait RayHits: Default {
    /// N.
    const WIDTH: usize;

    /// Traces the rays of the lanes where `valid` is -1. A struct of one ray does not look at `valid`.
    ///
    /// # Safety
    /// The scene is committed, the valid rays are finite, the arguments and what they point to are initialised.
    unsafe fn intersect(&mut self, valid: &Valid, scene: RTCScene, arguments: &mut RTCIntersectArguments);
}

/// Which lanes of a packet are traced: -1 those, 0 the others. Embree faults on a mask that is not aligned.
#[derive(Default)]
#[repr(C, align(64))]
pub(super) struct Valid(pub [c_int; MAX_WIDTH]);

macro_rules! ray_hits {
    ($struct:ty, $width:literal, |$valid:pat_param, $scene:ident, $rays:ident, $arguments:ident| $intersect:expr) => {
        const _: () = assert!(offset_of!($struct, hit) == 4 * field::HIT * $width);

        // SAFETY: by the layout of Embree's own accessors (RTCRayN_org_x and so on), and the assertion above.
        unsafe impl RayHits for $struct {
            const WIDTH: usize = $width;

            unsafe fn intersect(&mut self, $valid: &Valid, $scene: RTCScene, $arguments: &mut RTCIntersectArguments) {
                let $rays = self;
                // SAFETY: by the contract; mask and struct are aligned by their types.
                unsafe { $intersect }
            }
        }
    };
}

ray_hits!(RTCRayHit, 1, |_, scene, ray, arguments| rtcIntersect1(scene, ray, arguments));
ray_hits!(RTCRayHit4, 4, |valid, scene, rays, arguments| rtcIntersect4(valid.0.as_ptr(), scene, rays, arguments));
ray_hits!(RTCRayHit8, 8, |valid, scene, rays, arguments| rtcIntersect8(valid.0.as_ptr(), scene, rays, arguments));
ray_hits!(RTCRayHit16, 16, |valid, scene, rays, arguments| rtcIntersect16(valid.0.as_ptr(), scene, rays, arguments));
