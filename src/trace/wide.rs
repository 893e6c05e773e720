//! The filter of `recorder.rs` for sixteen rays, in AVX-512, the same to the bit.

use std::arch::x86_64::*;
use std::ffi::c_int;

use crate::simd::Avx512;
use crate::trace::Hit;
use crate::trace::packet::field;

/// Rays of a packet.
pub(super) const WIDTH: usize = 16;

/// [`record`](super::recorder::record) for 16 rays.
///
/// The lanes with hits are compressed first. The end of a loop over set bits would be mispredicted for nearly every
/// ray.
///
/// # Safety
/// The pointers are valid for 16 lanes of masks, of the fields of rays and of those of hits.
pub(super) unsafe fn note(_: Avx512, valid: *mut c_int, ray: *const u32, hit: *const u32, hits: &mut Vec<Hit>) {
    // SAFETY: by the contract; the token is proof that the processor has the instructions.
    unsafe { note_lanes(valid, ray, hit, hits) }
}

/// # Safety
/// As above, and the processor has AVX-512.
#[target_feature(enable = "avx512f,popcnt")]
unsafe fn note_lanes(valid: *mut c_int, ray: *const u32, hit: *const u32, hits: &mut Vec<Hit>) {
    // SAFETY: by the contract 16 lanes of each field can be read, and those of `valid` written.
    let (lanes, fields) = unsafe {
        let lanes = _mm512_cmpeq_epi32_mask(_mm512_loadu_si512(valid.cast()), _mm512_set1_epi32(-1));
        _mm512_storeu_si512(valid.cast(), _mm512_setzero_si512());
        let of_ray = |field: usize| ray.add(field * WIDTH);
        let of_hit = |field: usize| hit.add((field - field::HIT) * WIDTH);
        let (u, v) = (of_hit(field::U), of_hit(field::V));
        let fields = [of_ray(field::ID), of_hit(field::TRIANGLE), u, v, of_ray(field::TFAR)];
        (lanes, fields.map(|lanes| _mm512_loadu_si512(lanes.cast())))
    };
    let count = lanes.count_ones() as usize;
    let mut packed = [[0; WIDTH]; 5];
    for (packed, field) in packed.iter_mut().zip(fields) {
        // SAFETY: the array has 16 words.
        unsafe { _mm512_storeu_si512(packed.as_mut_ptr().cast(), _mm512_maskz_compress_epi32(lanes, field)) };
    }
    let [rays, triangles, u, v, t] = packed;
    hits.reserve(WIDTH);
    let end = hits.spare_capacity_mut();
    // Four at a time, over-reading up to three: the number of iterations is nearly always the same.
    for start in (0..count).step_by(4) {
        for lane in start..start + 4 {
            let [u, v, t] = [u, v, t].map(|field: [u32; WIDTH]| f32::from_bits(field[lane]));
            end[lane].write(Hit { ray: rays[lane], triangle: triangles[lane], uv: [u, v], t });
        }
    }
    // SAFETY: there is space for 16 more, of which the first `count` were written.
    unsafe { hits.set_len(hits.len() + count) };
}
