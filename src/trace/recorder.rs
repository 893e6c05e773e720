//! The filter that records the hits of a packet.

use std::ffi::c_int;
use std::slice;

use embree4_sys::*;

use crate::simd::Level;
use crate::trace::Hit;
use crate::trace::packet::{MAX_WIDTH, field};
#[cfg(target_arch = "x86_64")]
use crate::trace::wide;

/// The target of a query's filter: Embree hands it the context.
#[repr(C)]
pub(super) struct Recorder {
    context: RTCRayQueryContext,
    level: Level,
    /// The hits of the last query.
    pub(super) hits: Vec<Hit>,
}

impl Recorder {
    pub(super) fn new() -> Self {
        let mut context = RTCRayQueryContext::default();
        // SAFETY: the struct is of the size that the library expects: `check` compared it when the scene was built.
        unsafe { rtcInitRayQueryContext(&mut context) };
        Self { context, level: Level::widest(), hits: Vec::new() }
    }
}

/// The filter: notes each hit, and rejects it so that the traversal goes on.
///
/// # Safety
/// Called by Embree, for rays that a `Packet` loaded and whose context is that of a [`Recorder`].
pub(super) unsafe extern "C" fn record(arguments: *const RTCFilterFunctionNArguments) {
    // SAFETY: the pointers are valid for N rays, which may be fewer than the packet's, in the layout of `field`; no one
    // else uses the recorder during the query.
    unsafe {
        let arguments = &*arguments;
        let recorder = &mut *arguments.context.cast::<Recorder>();
        let (width, hits) = (arguments.N as usize, &mut recorder.hits);
        let (valid, ray, hit) = (arguments.valid, arguments.ray.cast(), arguments.hit.cast());
        match recorder.level {
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(token) if width == wide::WIDTH => wide::note(token, valid, ray, hit, hits),
            _ => note(valid, ray, hit, width, hits),
        }
    }
}

/// Appends the hits of the valid lanes, and makes no lane valid.
///
/// # Safety
/// The pointers are valid for `width` lanes, 16 at most, of masks, of the fields of rays and of those of hits.
unsafe fn note(valid: *mut c_int, ray: *const u32, hit: *const u32, width: usize, hits: &mut Vec<Hit>) {
    // SAFETY: by the contract.
    unsafe {
        let valid = slice::from_raw_parts_mut(valid, width);
        let mut lanes = valid.iter().zip(&BITS).fold(0, |lanes, (&valid, bit)| lanes | (valid as u32 & bit));
        valid.fill(0);
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize;
            lanes &= lanes - 1;
            let ray = |field: usize| *ray.add(field * width + lane);
            let hit = |field: usize| *hit.add((field - field::HIT) * width + lane);
            hits.push(Hit {
                ray: ray(field::ID),
                triangle: hit(field::TRIANGLE),
                uv: [hit(field::U), hit(field::V)].map(f32::from_bits),
                t: f32::from_bits(ray(field::TFAR)),
            });
        }
    }
}

/// A bit for each lane.
const BITS: [u32; MAX_WIDTH] = {
    let (mut bits, mut lane) = ([0; MAX_WIDTH], 0);
    while lane < MAX_WIDTH {
        bits[lane] = 1 << lane;
        lane += 1;
    }
    bits
};

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    #[test]
    fn any_lanes_are_noted_as_one_by_one() {
        let Level::Avx512(token) = Level::widest() else { return };
        let mut rng = Rng::at(1, Draw::Probe, &[]);
        let (mut expected, mut found) = (Vec::new(), Vec::new());
        for lanes in 0..=u16::MAX {
            // Bits of floats that are numbers, so that they can be compared.
            let words: [u32; field::COUNT * MAX_WIDTH] = std::array::from_fn(|_| rng.below(1 << 30) as u32);
            let hit = words[field::HIT * MAX_WIDTH..].as_ptr();
            let mut one: [c_int; MAX_WIDTH] = std::array::from_fn(|lane| -c_int::from(lanes >> lane & 1 == 1));
            let mut other = one;
            expected.clear();
            found.clear();
            // SAFETY: 16 lanes of each field, and a processor that was asked.
            unsafe {
                note(one.as_mut_ptr(), words.as_ptr(), hit, MAX_WIDTH, &mut expected);
                wide::note(token, other.as_mut_ptr(), words.as_ptr(), hit, &mut found);
            }
            assert_eq!((&found, one, other), (&expected, [0; MAX_WIDTH], [0; MAX_WIDTH]));
            assert_eq!(found.len(), lanes.count_ones() as usize);
        }
    }
}
