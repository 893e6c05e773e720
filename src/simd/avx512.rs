//! [`Lanes`] in AVX-512.

use std::arch::x86_64::*;

use crate::simd::Avx512;
use crate::simd::lanes::{HALF, LANES, Lanes, Position};

// SAFETY of all intrinsics here: an `Avx512` proves that the processor has AVX-512 F, VL, DQ and BW. References to
// sixteen floats are valid for loads and stores of 64 bytes, which require no alignment.
impl Lanes for Avx512 {
    type Floats = __m512;
    type Ints = __m512i;
    type Doubles = __m512d;
    type Longs = __m512i;
    type Mask = __mmask16;

    const PERMUTES: bool = true;

    #[inline(always)]
    fn splat(self, x: f32) -> __m512 {
        // SAFETY: see above.
        unsafe { _mm512_set1_ps(x) }
    }
    #[inline(always)]
    fn load(self, from: &[f32; LANES]) -> __m512 {
        // SAFETY: see above.
        unsafe { _mm512_loadu_ps(from.as_ptr()) }
    }
    #[inline(always)]
    fn store(self, x: __m512, to: &mut [f32; LANES]) {
        // SAFETY: see above.
        unsafe { _mm512_storeu_ps(to.as_mut_ptr(), x) }
    }
    #[inline(always)]
    fn add(self, a: __m512, b: __m512) -> __m512 {
        // SAFETY: see above.
        unsafe { _mm512_add_ps(a, b) }
    }
    #[inline(always)]
    fn sub(self, a: __m512, b: __m512) -> __m512 {
        // SAFETY: see above.
        unsafe { _mm512_sub_ps(a, b) }
    }
    #[inline(always)]
    fn mul(self, a: __m512, b: __m512) -> __m512 {
        // SAFETY: see above.
        unsafe { _mm512_mul_ps(a, b) }
    }
    #[inline(always)]
    fn div(self, a: __m512, b: __m512) -> __m512 {
        // SAFETY: see above.
        unsafe { _mm512_div_ps(a, b) }
    }
    #[inline(always)]
    fn sqrt(self, x: __m512) -> __m512 {
        // SAFETY: see above.
        unsafe { _mm512_sqrt_ps(x) }
    }
    #[inline(always)]
    fn min(self, a: __m512, b: __m512) -> __m512 {
        // SAFETY: see above.
        unsafe { _mm512_min_ps(a, b) }
    }
    #[inline(always)]
    fn max(self, a: __m512, b: __m512) -> __m512 {
        // SAFETY: see above.
        unsafe { _mm512_max_ps(a, b) }
    }
    #[inline(always)]
    fn abs(self, x: __m512) -> __m512 {
        // SAFETY: see above.
        unsafe { _mm512_abs_ps(x) }
    }
    #[inline(always)]
    fn less(self, a: __m512, b: __m512) -> __mmask16 {
        // SAFETY: see above.
        unsafe { _mm512_cmp_ps_mask::<_CMP_LT_OQ>(a, b) }
    }
    #[inline(always)]
    fn at_most(self, a: __m512, b: __m512) -> __mmask16 {
        // SAFETY: see above.
        unsafe { _mm512_cmp_ps_mask::<_CMP_LE_OQ>(a, b) }
    }
    #[inline(always)]
    fn only(self, mask: __mmask16, x: __m512) -> __m512 {
        // SAFETY: see above.
        unsafe { _mm512_maskz_mov_ps(mask, x) }
    }
    #[inline(always)]
    fn select(self, mask: __mmask16, a: __m512, b: __m512) -> __m512 {
        // SAFETY: see above.
        unsafe { _mm512_mask_blend_ps(mask, b, a) }
    }
    #[inline(always)]
    fn both(self, a: __mmask16, b: __mmask16) -> __mmask16 {
        a & b
    }
    #[inline(always)]
    fn permute(self, x: __m512, numbers: &[i32; LANES]) -> __m512 {
        // SAFETY: see above.
        unsafe { _mm512_permutexvar_ps(_mm512_loadu_si512(numbers.as_ptr().cast()), x) }
    }
    #[inline(always)]
    fn bits(self, mask: __mmask16) -> u32 {
        mask.into()
    }
    #[inline(always)]
    fn sum(self, x: __m512) -> f32 {
        // SAFETY: see above.
        unsafe {
            let eight = _mm256_add_ps(_mm512_castps512_ps256(x), _mm512_extractf32x8_ps::<1>(x));
            let four = _mm_add_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps::<1>(eight));
            let two = _mm_add_ps(four, _mm_movehl_ps(four, four));
            _mm_cvtss_f32(_mm_add_ss(two, _mm_movehdup_ps(two)))
        }
    }
    #[inline(always)]
    fn least(self, x: __m512) -> f32 {
        // SAFETY: see above.
        unsafe {
            let eight = _mm256_min_ps(_mm512_castps512_ps256(x), _mm512_extractf32x8_ps::<1>(x));
            let four = _mm_min_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps::<1>(eight));
            let two = _mm_min_ps(four, _mm_movehl_ps(four, four));
            _mm_cvtss_f32(_mm_min_ss(two, _mm_movehdup_ps(two)))
        }
    }
    #[inline(always)]
    fn gather(self, positions: &[Position], named: &[u32; LANES]) -> [__m512; 3] {
        // SAFETY: see above; all positions are asserted to exist before they are read.
        unsafe {
            let count = _mm512_set1_epi32(positions.len().min(u32::MAX as usize) as i32);
            let there = _mm512_cmplt_epu32_mask(_mm512_loadu_si512(named.as_ptr().cast()), count);
            assert!(there == u16::MAX, "a position is named that there is not");
            let one = |k: usize| _mm_loadu_ps(positions.as_ptr().add(named[k] as usize).cast());
            // The positions k, k + 4, k + 8 and k + 12.
            let four = |k: usize| {
                let low = _mm256_insertf128_ps::<1>(_mm256_castps128_ps256(one(k)), one(k + 4));
                let high = _mm256_insertf128_ps::<1>(_mm256_castps128_ps256(one(k + 8)), one(k + 12));
                _mm512_insertf32x8::<1>(_mm512_castps256_ps512(low), high)
            };
            let (a, b, c, d) = (four(0), four(1), four(2), four(3));
            let (ab, cd) = (_mm512_unpacklo_ps(a, b), _mm512_unpacklo_ps(c, d));
            let (ab_z, cd_z) = (_mm512_unpackhi_ps(a, b), _mm512_unpackhi_ps(c, d));
            [
                _mm512_shuffle_ps::<0b01_00_01_00>(ab, cd),
                _mm512_shuffle_ps::<0b11_10_11_10>(ab, cd),
                _mm512_shuffle_ps::<0b01_00_01_00>(ab_z, cd_z),
            ]
        }
    }

    #[inline(always)]
    fn splat_int(self, x: i32) -> __m512i {
        // SAFETY: see above.
        unsafe { _mm512_set1_epi32(x) }
    }
    #[inline(always)]
    fn load_ints(self, from: &[i32; LANES]) -> __m512i {
        // SAFETY: see above.
        unsafe { _mm512_loadu_si512(from.as_ptr().cast()) }
    }
    #[inline(always)]
    fn load_halves(self, from: [&[i32; HALF]; 2]) -> __m512i {
        // SAFETY: see above.
        unsafe {
            let [lower, upper] = from.map(|half| _mm256_loadu_si256(half.as_ptr().cast()));
            _mm512_inserti64x4::<1>(_mm512_castsi256_si512(lower), upper)
        }
    }
    #[inline(always)]
    fn add_ints(self, a: __m512i, b: __m512i) -> __m512i {
        // SAFETY: see above.
        unsafe { _mm512_add_epi32(a, b) }
    }
    #[inline(always)]
    fn sub_ints(self, a: __m512i, b: __m512i) -> __m512i {
        // SAFETY: see above.
        unsafe { _mm512_sub_epi32(a, b) }
    }
    #[inline(always)]
    fn mul_ints(self, a: __m512i, b: __m512i) -> __m512i {
        // SAFETY: see above.
        unsafe { _mm512_mullo_epi32(a, b) }
    }
    #[inline(always)]
    fn min_ints(self, a: __m512i, b: __m512i) -> __m512i {
        // SAFETY: see above.
        unsafe { _mm512_min_epi32(a, b) }
    }
    #[inline(always)]
    fn and_ints(self, a: __m512i, b: __m512i) -> __m512i {
        // SAFETY: see above.
        unsafe { _mm512_and_si512(a, b) }
    }
    #[inline(always)]
    fn less_ints(self, a: __m512i, b: __m512i) -> __mmask16 {
        // SAFETY: see above.
        unsafe { _mm512_cmplt_epi32_mask(a, b) }
    }
    #[inline(always)]
    fn floats(self, x: __m512i) -> __m512 {
        // SAFETY: see above.
        unsafe { _mm512_cvtepi32_ps(x) }
    }
    #[inline(always)]
    fn float_bits(self, x: __m512) -> __m512i {
        // SAFETY: see above.
        unsafe { _mm512_castps_si512(x) }
    }
    #[inline(always)]
    fn compress_ints(self, mask: __mmask16, x: __m512i, to: &mut [i32; LANES]) {
        // SAFETY: see above.
        unsafe {
            _mm512_storeu_si512(to.as_mut_ptr().cast(), _mm512_maskz_compress_epi32(mask, x));
        }
    }
    #[inline(always)]
    fn compress(self, mask: __mmask16, x: __m512, rest: f32, to: &mut [f32; LANES]) {
        // SAFETY: see above.
        unsafe {
            _mm512_storeu_ps(to.as_mut_ptr(), _mm512_mask_compress_ps(_mm512_set1_ps(rest), mask, x));
        }
    }

    #[inline(always)]
    fn splat_double(self, x: f64) -> __m512d {
        // SAFETY: see above.
        unsafe { _mm512_set1_pd(x) }
    }
    #[inline(always)]
    fn load_doubles(self, from: &[f64; HALF]) -> __m512d {
        // SAFETY: see above.
        unsafe { _mm512_loadu_pd(from.as_ptr()) }
    }
    #[inline(always)]
    fn add_doubles(self, a: __m512d, b: __m512d) -> __m512d {
        // SAFETY: see above.
        unsafe { _mm512_add_pd(a, b) }
    }
    #[inline(always)]
    fn mul_doubles(self, a: __m512d, b: __m512d) -> __m512d {
        // SAFETY: see above.
        unsafe { _mm512_mul_pd(a, b) }
    }
    #[inline(always)]
    fn narrow(self, x: __m512d) -> __m512 {
        // SAFETY: see above.
        unsafe { _mm512_castps256_ps512(_mm512_cvtpd_ps(x)) }
    }

    #[inline(always)]
    fn widen(self, x: __m512i) -> __m512i {
        // SAFETY: see above.
        unsafe { _mm512_cvtepu32_epi64(_mm512_castsi512_si256(x)) }
    }
    #[inline(always)]
    fn store_longs(self, x: __m512i, to: &mut [u64; HALF]) {
        // SAFETY: see above.
        unsafe {
            _mm512_storeu_si512(to.as_mut_ptr().cast(), x);
        }
    }
    #[inline(always)]
    fn or_longs(self, a: __m512i, b: __m512i) -> __m512i {
        // SAFETY: see above.
        unsafe { _mm512_or_si512(a, b) }
    }
    #[inline(always)]
    fn shift_longs(self, x: __m512i, by: u32) -> __m512i {
        // SAFETY: see above.
        unsafe { _mm512_sll_epi64(x, _mm_cvtsi32_si128(by.cast_signed())) }
    }
    #[inline(always)]
    fn equal_longs(self, x: __m512i, to: u64) -> u8 {
        // SAFETY: see above.
        unsafe { _mm512_cmpeq_epi64_mask(x, _mm512_set1_epi64(to.cast_signed())) }
    }
}
