//! Packets of rays on their way through Embree, and the filter that records their hits.

use std::ffi::c_int;
use std::mem::offset_of;
use std::{ptr, slice};

use embree4_sys::*;

use super::build::Built;
use super::{Hit, LARGEST_COORDINATE, Ray};

/// The widest packet.
const MAX_WIDTH: usize = 16;

/// Which array of a struct of N rays and their hits is which: word `field * N + lane`.
mod field {
    pub const ORIGIN: usize = 0;
    pub const TNEAR: usize = 3;
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
pub(super) struct Valid([c_int; MAX_WIDTH]);

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

/// Up to N rays of the caller, in Embree's layout. Hits that come from here count rays by lanes.
#[derive(Default)]
pub(super) struct Packet<P> {
    rays: P,
    valid: Valid,
    /// What Embree's `t` is multiplied by to be the caller's, for each lane.
    scales: [f64; MAX_WIDTH],
}

impl<P: RayHits> Packet<P> {
    fn words(&self) -> &[u32] {
        // SAFETY: by the contract of `RayHits` there are as many words, and any bits are words.
        unsafe { slice::from_raw_parts(ptr::from_ref(&self.rays).cast(), field::COUNT * P::WIDTH) }
    }

    fn words_mut(&mut self) -> &mut [u32] {
        // SAFETY: as above, and any words are rays.
        unsafe { slice::from_raw_parts_mut(ptr::from_mut(&mut self.rays).cast(), field::COUNT * P::WIDTH) }
    }

    /// Fills the lanes with at most N rays. Lanes stay idle if there is no ray for them, or one that cannot be traced.
    pub(super) fn load(&mut self, rays: &[Ray]) {
        for lane in 0..P::WIDTH {
            let aimed = rays.get(lane).and_then(aim);
            self.valid.0[lane] = if aimed.is_some() { -1 } else { 0 };
            let (ray, scale) = aimed.unwrap_or((Ray { origin: [0.0; 3], direction: [1.0; 3] }, 1.0));
            self.scales[lane] = scale;
            let words = self.words_mut();
            let mut set = |field: usize, word: u32| words[field * P::WIDTH + lane] = word;
            for axis in 0..3 {
                set(field::ORIGIN + axis, ray.origin[axis].to_bits());
                set(field::DIRECTION + axis, ray.direction[axis].to_bits());
            }
            set(field::TNEAR, 0f32.to_bits());
            // Embree 3.13 overlooks the mask where it emulates wider packets than the machine's own: an idle ray ends
            // before it begins.
            let tfar = if aimed.is_some() { f32::INFINITY } else { f32::NEG_INFINITY };
            set(field::TFAR, tfar.to_bits());
            set(field::MASK, !0);
            set(field::ID, lane as u32);
            set(field::GEOMETRY, RTC_INVALID_GEOMETRY_ID);
        }
    }

    /// Leaves all hits of the rays that were loaded in the recorder, in no order.
    pub(super) fn all_hits(&mut self, scene: &Built, recorder: &mut Recorder) {
        recorder.hits.clear();
        let mut arguments = coherent();
        arguments.flags |= RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
        arguments.filter = Some(record);
        // The pointer is to the whole recorder: that is what the filter makes of it.
        arguments.context = ptr::from_mut(recorder).cast();
        self.intersect(scene, arguments);
        for hit in &mut recorder.hits {
            self.rescale(hit);
        }
    }

    /// The first hit of each lane.
    pub(super) fn closest_hits(&mut self, scene: &Built) -> impl Iterator<Item = Option<Hit>> {
        self.intersect(scene, coherent());
        (0..P::WIDTH).map(|lane| {
            let word = |field: usize| self.words()[field * P::WIDTH + lane];
            let float = |field: usize| f32::from_bits(word(field));
            let mut hit = Hit {
                ray: lane as u32,
                triangle: word(field::TRIANGLE),
                uv: [float(field::U), float(field::V)],
                t: float(field::TFAR),
            };
            self.rescale(&mut hit);
            (word(field::GEOMETRY) != RTC_INVALID_GEOMETRY_ID).then_some(hit)
        })
    }

    fn intersect(&mut self, scene: &Built, mut arguments: RTCIntersectArguments) {
        // A packet of one ray has no mask for it.
        if self.valid.0.contains(&-1) {
            // SAFETY: what is `Built` is committed; `load` lets no ray pass that is not finite; the arguments come
            // from `coherent`, and a context is that of a `Recorder`, which is initialised.
            unsafe { self.rays.intersect(&self.valid, scene.scene(), &mut arguments) };
        }
    }

    fn rescale(&self, hit: &mut Hit) {
        hit.t = (hit.t as f64 * self.scales[hit.ray as usize]) as f32;
    }
}

/// The ray with a direction of a length that Embree's thresholds were made for, and the factor from its `t` to that of
/// the original; none if it cannot be traced. The factor is a power of two, so that nothing is rounded.
fn aim(ray: &Ray) -> Option<(Ray, f64)> {
    const EXPONENT: u64 = 0x7ff << 52;
    let length = ray.direction.into_iter().fold(0.0, |longest: f32, x| longest.max(x.abs()));
    let traceable = length > 0.0
        && ray.direction.iter().all(|x| x.is_finite())
        && ray.origin.iter().all(|x| x.abs() <= LARGEST_COORDINATE);
    let scale = 1.0 / f64::from_bits((length as f64).to_bits() & EXPONENT);
    traceable.then(|| (Ray { direction: ray.direction.map(|x| (x as f64 * scale) as f32), ..*ray }, scale))
}

/// The arguments of a query without filter.
fn coherent() -> RTCIntersectArguments {
    let mut arguments = RTCIntersectArguments::default();
    // SAFETY: the struct is of the size that the library expects: `check` compared it when the scene was built.
    unsafe { rtcInitIntersectArguments(&mut arguments) };
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    arguments
}

/// What the filter of a query writes to: Embree hands it the context.
#[repr(C)]
pub(super) struct Recorder {
    context: RTCRayQueryContext,
    /// The hits of the last query.
    pub(super) hits: Vec<Hit>,
}

impl Recorder {
    pub(super) fn new() -> Self {
        let mut context = RTCRayQueryContext::default();
        // SAFETY: as in `coherent`.
        unsafe { rtcInitRayQueryContext(&mut context) };
        Self { context, hits: Vec::new() }
    }
}

/// The filter: notes each hit, and rejects it so that the traversal goes on.
///
/// # Safety
/// Called by Embree, for rays that `Packet::load` made and whose context is that of a [`Recorder`].
unsafe extern "C" fn record(arguments: *const RTCFilterFunctionNArguments) {
    // SAFETY: the pointers are valid for N rays, which may be fewer than the packet's, in the layout of `field`; no one
    // else uses the recorder during the query.
    unsafe {
        let arguments = &*arguments;
        let recorder = &mut *arguments.context.cast::<Recorder>();
        let width = arguments.N as usize;
        for lane in 0..width {
            let valid = arguments.valid.add(lane);
            if *valid != -1 {
                continue;
            }
            *valid = 0;
            let ray = |field: usize| *arguments.ray.cast::<u32>().add(field * width + lane);
            let hit = |field: usize| *arguments.hit.cast::<u32>().add((field - field::HIT) * width + lane);
            recorder.hits.push(Hit {
                ray: ray(field::ID),
                triangle: hit(field::TRIANGLE),
                uv: [hit(field::U), hit(field::V)].map(f32::from_bits),
                t: f32::from_bits(ray(field::TFAR)),
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_direction_is_scaled_without_rounding() {
        for length in [f32::from_bits(1), 1e-30, 0.3, 1.0, 1.5, 7.0, 3e38] {
            let ray = Ray { origin: [1.0, 2.0, 3.0], direction: [0.0, -length, length] };
            let (aimed, scale) = aim(&ray).unwrap();
            assert!((1.0..2.0).contains(&aimed.direction[2]), "{length}: {:?}", aimed.direction);
            assert_eq!(aimed.origin, ray.origin);
            assert_eq!(aimed.direction.map(|x| (x as f64 / scale) as f32), ray.direction);
        }
    }

    #[test]
    fn rays_that_embree_would_not_survive_are_not_aimed() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 2e18] {
            for axis in 0..3 {
                let mut ray = Ray { origin: [0.0; 3], direction: [1.0; 3] };
                ray.origin[axis] = bad;
                assert_eq!(aim(&ray), None);
                let mut ray = Ray { origin: [0.0; 3], direction: [1.0; 3] };
                ray.direction[axis] = bad;
                assert_eq!(aim(&ray).is_some(), bad.is_finite());
            }
        }
        assert_eq!(aim(&Ray { origin: [0.0; 3], direction: [0.0; 3] }), None);
    }
}
