//! Packets of rays that Embree traces.

use std::ffi::c_int;
use std::mem::offset_of;
use std::{mem, ptr, slice};

use embree4_sys::*;

use crate::trace::recorder::{Recorder, record};
use crate::trace::scene::Built;
use crate::trace::{Hit, LARGEST_COORDINATE, Ray};

/// Up to N rays of the caller, in Embree's layout. Hits that come from here count rays by lanes.
pub(super) struct Packet<P> {
    rays: P,
    valid: Valid,
    /// The direction of all rays, as the caller gave it, if it is one that can be traced.
    common: Option<[f32; 3]>,
    /// The lanes that have a direction that can be traced: -1 for those, 0 for the others.
    aimed: [c_int; MAX_WIDTH],
    /// The factor from Embree's `t` to the caller's, for each lane.
    scales: [f64; MAX_WIDTH],
}

impl<P: RayHits> Packet<P> {
    fn words(&self) -> &[u32] {
        // SAFETY: by the contract of `RayHits` there are this many words, and any bits are words.
        unsafe { slice::from_raw_parts(ptr::from_ref(&self.rays).cast(), field::COUNT * P::WIDTH) }
    }

    fn words_mut(&mut self) -> &mut [u32] {
        // SAFETY: as above, and any words are rays.
        unsafe { slice::from_raw_parts_mut(ptr::from_mut(&mut self.rays).cast(), field::COUNT * P::WIDTH) }
    }

    /// A packet of idle lanes. What is not set here or by [`load`](Self::load) is zero.
    pub(super) fn new() -> Self {
        let mut packet = Self {
            rays: P::default(),
            valid: Valid::default(),
            common: None,
            aimed: [0; MAX_WIDTH],
            scales: [1.0; MAX_WIDTH],
        };
        packet.field_mut(field::MASK).fill(!0);
        (0..).zip(packet.field_mut(field::ID)).for_each(|(lane, id)| *id = lane);
        packet
    }

    fn field_mut(&mut self, field: usize) -> &mut [u32] {
        &mut self.words_mut()[field * P::WIDTH..][..P::WIDTH]
    }

    /// Fills the lanes with at most N rays. Lanes stay idle if there is no ray for them, or one that cannot be traced.
    pub(super) fn load(&mut self, rays: &[Ray]) {
        self.turn(rays);
        let words = self.words_mut();
        for (lane, ray) in rays.iter().enumerate().take(P::WIDTH) {
            for axis in 0..3 {
                words[(field::ORIGIN + axis) * P::WIDTH + lane] = ray.origin[axis].to_bits();
            }
        }
        self.field_mut(field::TFAR).fill(f32::INFINITY.to_bits());
        for lane in 0..P::WIDTH {
            let place = |axis: usize| f32::from_bits(self.words()[(field::ORIGIN + axis) * P::WIDTH + lane]).abs();
            let near = (place(0) <= LARGEST_COORDINATE)
                & (place(1) <= LARGEST_COORDINATE)
                & (place(2) <= LARGEST_COORDINATE)
                & (lane < rays.len());
            self.valid.0[lane] = self.aimed[lane] & -c_int::from(near);
        }
        if self.valid.0[..P::WIDTH].contains(&0) {
            self.still();
        }
    }

    /// Sets the directions of the lanes.
    fn turn(&mut self, rays: &[Ray]) {
        // Parallel rays are the rule, and packet after packet has the same direction.
        if let Some(common) = self.common {
            let differs =
                |ray: &Ray| (0..3).fold(0, |bits, axis| bits | ray.direction[axis].to_bits() ^ common[axis].to_bits());
            if rays.iter().fold(0, |bits, ray| bits | differs(ray)) == 0 {
                return;
            }
        }
        self.common = rays.first().map(|ray| ray.direction);
        for lane in 0..P::WIDTH {
            // Beyond the last ray comes its direction again.
            let direction = rays.get(lane).or(rays.last()).map(|ray| ray.direction);
            let aimed = direction.and_then(aim);
            let bits = |direction: [f32; 3]| direction.map(f32::to_bits);
            if aimed.is_none() || direction.map(bits) != self.common.map(bits) {
                self.common = None;
            }
            let Aimed { direction, scale } = aimed.unwrap_or(Aimed { direction: [1.0; 3], scale: 1.0 });
            self.aimed[lane] = -c_int::from(aimed.is_some());
            self.scales[lane] = scale;
            for (axis, x) in direction.into_iter().enumerate() {
                self.field_mut(field::DIRECTION + axis)[lane] = x.to_bits();
            }
        }
    }

    /// Makes the idle lanes harmless: Embree 3.13 ignores the mask where it emulates wider packets than the machine's
    /// own, so that an idle ray has to end before it begins.
    fn still(&mut self) {
        for lane in 0..P::WIDTH {
            if self.valid.0[lane] != 0 {
                continue;
            }
            (0..3).for_each(|axis| self.field_mut(field::ORIGIN + axis)[lane] = 0f32.to_bits());
            self.field_mut(field::TFAR)[lane] = f32::NEG_INFINITY.to_bits();
        }
    }

    /// Appends all hits of the rays that were loaded, of which the first has the number `first`, sorted by ray, `t` and
    /// triangle.
    pub(super) fn all_hits(&mut self, scene: &Built, recorder: &mut Recorder, first: u32, hits: &mut Vec<Hit>) {
        recorder.hits.clear();
        let mut arguments = coherent();
        arguments.flags |= RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
        arguments.filter = Some(record);
        // The pointer is to the whole recorder: that is what the filter makes of it.
        arguments.context = ptr::from_mut(recorder).cast();
        self.intersect(scene, arguments);
        let scales = &self.scales;
        let settled = |hit: &Hit| Hit { ray: first + hit.ray, t: rescaled(hit, scales), ..*hit };
        settle::<MAX_WIDTH>(&recorder.hits, settled, hits);
    }

    /// The first hit of each lane.
    pub(super) fn closest_hits(&mut self, scene: &Built) -> impl Iterator<Item = Option<Hit>> {
        self.field_mut(field::GEOMETRY).fill(RTC_INVALID_GEOMETRY_ID);
        self.intersect(scene, coherent());
        (0..P::WIDTH).map(|lane| {
            let word = |field: usize| self.words()[field * P::WIDTH + lane];
            let float = |field: usize| f32::from_bits(word(field));
            let hit = Hit {
                ray: lane as u32,
                triangle: word(field::TRIANGLE),
                uv: [float(field::U), float(field::V)],
                t: float(field::TFAR),
            };
            let hit = Hit { t: rescaled(&hit, &self.scales), ..hit };
            (word(field::GEOMETRY) != RTC_INVALID_GEOMETRY_ID).then_some(hit)
        })
    }

    fn intersect(&mut self, scene: &Built, mut arguments: RTCIntersectArguments) {
        // A packet of one ray has no mask for it.
        if self.valid.0.contains(&-1) {
            // SAFETY: `load` lets no ray pass that is not finite; the arguments come from `coherent`, and a context is that
            // of a `Recorder`, which is initialised.
            unsafe { self.rays.intersect(&self.valid, scene, &mut arguments) };
        }
    }
}

/// The `t` of a hit along the direction that the caller gave.
fn rescaled(hit: &Hit, scales: &[f64; MAX_WIDTH]) -> f32 {
    (hit.t as f64 * scales[hit.ray as usize]) as f32
}

/// A direction of a length that Embree's thresholds were made for.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Aimed {
    direction: [f32; 3],
    /// The factor from its `t` to that of the original: a power of two, so that nothing is rounded.
    scale: f64,
}

/// The direction at a length between 1 and 2; none if it cannot be traced.
fn aim(direction: [f32; 3]) -> Option<Aimed> {
    const EXPONENT: u64 = 0x7ff << 52;
    let length = direction.into_iter().fold(0.0, |longest: f32, x| longest.max(x.abs()));
    let traceable = length > 0.0 && direction.iter().all(|x| x.is_finite());
    let scale = 1.0 / f64::from_bits((length as f64).to_bits() & EXPONENT);
    traceable.then(|| Aimed { direction: direction.map(|x| (x as f64 * scale) as f32), scale })
}

/// The arguments of a query without filter.
fn coherent() -> RTCIntersectArguments {
    let mut arguments = RTCIntersectArguments::default();
    // SAFETY: the struct is of the size that the library expects: `check` compared it when the scene was built.
    unsafe { rtcInitIntersectArguments(&mut arguments) };
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    arguments
}

/// The widest packet.
pub(super) const MAX_WIDTH: usize = 16;

/// The arrays of a struct of N rays and their hits, by number: word `field * N + lane`.
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

    /// Traces the rays of the lanes where `valid` is -1. A struct of one ray ignores `valid`.
    ///
    /// # Safety
    /// The valid rays are finite, the arguments and what they point to are initialised.
    unsafe fn intersect(&mut self, valid: &Valid, built: &Built, arguments: &mut RTCIntersectArguments);
}

/// The lanes of a packet that are traced: -1 for those, 0 for the others. Embree faults on a mask that is not aligned.
#[derive(Default)]
#[repr(C, align(64))]
pub(super) struct Valid(pub [c_int; MAX_WIDTH]);

macro_rules! ray_hits {
    ($struct:ty, $width:literal, |$valid:pat_param, $built:ident, $rays:ident, $arguments:ident| $intersect:expr) => {
        const _: () = assert!(offset_of!($struct, hit) == 4 * field::HIT * $width);

        // SAFETY: by the layout of Embree's own accessors (RTCRayN_org_x and so on), and the assertion above.
        unsafe impl RayHits for $struct {
            const WIDTH: usize = $width;

            unsafe fn intersect(&mut self, $valid: &Valid, $built: &Built, $arguments: &mut RTCIntersectArguments) {
                let $rays = self;
                // SAFETY: by the contract; what is `Built` is committed; mask and struct are aligned by their types.
                unsafe { $intersect }
            }
        }
    };
}

ray_hits!(RTCRayHit, 1, |_, built, ray, arguments| built.embree().intersect1(built.scene(), ray, arguments));
ray_hits!(RTCRayHit4, 4, |valid, built, rays, arguments| built.embree().intersect4(
    valid.0.as_ptr(),
    built.scene(),
    rays,
    arguments
));
ray_hits!(RTCRayHit8, 8, |valid, built, rays, arguments| built.embree().intersect8(
    valid.0.as_ptr(),
    built.scene(),
    rays,
    arguments
));
ray_hits!(RTCRayHit16, 16, |valid, built, rays, arguments| built.embree().intersect16(
    valid.0.as_ptr(),
    built.scene(),
    rays,
    arguments
));

/// An unused slot for a hit.
const NO_HIT: Hit = Hit { ray: 0, triangle: 0, uv: [0.0; 2], t: 0.0 };

/// Appends what `finish` makes of the hits of one packet, ordered by lane, `t` and triangle and without repetitions: a
/// triangle that is met twice is met at the same `t`.
pub(super) fn settle<const LANES: usize>(found: &[Hit], finish: impl Fn(&Hit) -> Hit, hits: &mut Vec<Hit>) {
    // By lanes first. Then most packets are in order, since Embree goes from near to far.
    let mut places = [0; LANES];
    found.iter().for_each(|hit| places[hit.ray as usize % LANES] += 1);
    let start = hits.len();
    let mut end = start;
    for place in &mut places {
        end += mem::replace(place, end);
    }
    hits.resize(end, NO_HIT);
    for hit in found {
        let place = &mut places[hit.ray as usize % LANES];
        hits[*place] = finish(hit);
        *place += 1;
    }
    // The bits of floats above zero are in the order of the floats.
    let key = |hit: &Hit| ((hit.ray as u64) << 32 | hit.t.to_bits() as u64, hit.triangle);
    if !hits[start..].is_sorted_by(|a, b| key(a) < key(b)) {
        let mut unsettled = hits.split_off(start);
        unsettled.sort_unstable_by_key(key);
        unsettled.dedup_by_key(|hit| (hit.ray, hit.triangle));
        hits.append(&mut unsettled);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_packet_forgets_the_rays_before() {
        let ray = |x: f32, direction| Ray { origin: [x, 2.0, 3.0], direction };
        let (one, other) = ([0.0, 0.0, 1.0], [0.0, -4.0, 0.0]);
        let mut rays = Packet::<RTCRayHit4>::new();
        let lanes = |packet: &Packet<RTCRayHit4>| {
            let word = |field: usize, lane: usize| f32::from_bits(packet.words()[field * 4 + lane]);
            [0, 1, 2, 3].map(|lane| {
                let vector = |field| [0, 1, 2].map(|axis| word(field + axis, lane));
                (packet.valid.0[lane], vector(field::ORIGIN), vector(field::DIRECTION), word(field::TFAR, lane))
            })
        };
        let loads = [
            vec![ray(1.0, one); 4],
            vec![ray(5.0, one), ray(f32::NAN, one), ray(6.0, one)],
            vec![ray(7.0, one), ray(8.0, other), ray(9.0, [0.0; 3])],
            vec![ray(1.0, [0.0; 3]); 4],
            vec![ray(2.0, other); 2],
            vec![],
            vec![ray(3.0, other); 4],
        ];
        for load in loads {
            rays.load(&load);
            let mut fresh = Packet::<RTCRayHit4>::new();
            fresh.load(&load);
            for (lane, (loaded, expected)) in lanes(&rays).into_iter().zip(lanes(&fresh)).enumerate() {
                let traceable = load.get(lane).is_some_and(|ray| ray.direction != [0.0; 3] && !ray.origin[0].is_nan());
                assert_eq!(loaded.0, if traceable { -1 } else { 0 });
                if traceable {
                    assert_eq!(loaded, expected);
                    assert_eq!(loaded.1, load[lane].origin);
                    assert_eq!(loaded.2, aim(load[lane].direction).unwrap().direction);
                } else {
                    assert_eq!((loaded.1, loaded.3), ([0.0; 3], f32::NEG_INFINITY));
                }
            }
        }
    }

    #[test]
    fn a_direction_is_scaled_without_rounding() {
        for length in [f32::from_bits(1), 1e-30, 0.3, 1.0, 1.5, 7.0, 3e38] {
            let direction = [0.0, -length, length];
            let aimed = aim(direction).unwrap();
            assert!((1.0..2.0).contains(&aimed.direction[2]), "{length}: {:?}", aimed.direction);
            assert_eq!(aimed.direction.map(|x| (x as f64 / aimed.scale) as f32), direction);
        }
    }

    #[test]
    fn rays_that_embree_would_not_survive_are_not_traced() {
        let mut packet = Packet::<RTCRayHit>::new();
        let mut traced = |ray: Ray| {
            packet.load(&[ray]);
            packet.valid.0[0] == -1
        };
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 2e18] {
            for axis in 0..3 {
                let mut ray = Ray { origin: [0.0; 3], direction: [1.0; 3] };
                ray.origin[axis] = bad;
                assert!(!traced(ray));
                let mut ray = Ray { origin: [0.0; 3], direction: [1.0; 3] };
                ray.direction[axis] = bad;
                assert_eq!(traced(ray), bad.is_finite());
            }
        }
        assert!(!traced(Ray { origin: [0.0; 3], direction: [0.0; 3] }));
    }

    #[test]
    fn hits_are_ordered_and_repetitions_dropped() {
        let hit = |ray, t, triangle| Hit { ray, triangle, uv: [0.0; 2], t };
        let expected =
            [hit(0, 0.5, 9), hit(0, 0.5, 10), hit(0, 2.0, 1), hit(1, f32::MIN_POSITIVE, 1), hit(1, 30.0, 10)];
        for order in [&[3, 1, 4, 0, 1, 2, 0, 3], &[0, 1, 2, 3, 3, 3, 4, 4], &[3, 0, 4, 0, 1, 1, 1, 2]] {
            let found = order.map(|i: usize| expected[i]);
            let before = hit(7, 1.0, 1);
            let mut hits = vec![before];
            settle::<2>(&found, |hit| Hit { t: 2.0 * hit.t, ..*hit }, &mut hits);
            assert_eq!(hits[0], before);
            assert_eq!(hits[1..], expected.map(|hit| Hit { t: 2.0 * hit.t, ..hit }));
        }
    }
}
