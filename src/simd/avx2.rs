//! [`Lanes`] in AVX2: two vectors of eight.

use std::arch::x86_64::*;

use crate::simd::Avx2;
use crate::simd::lanes::{LANES, Lanes, Position};

type Floats = [__m256; 2];

// SAFETY of all intrinsics here: an `Avx2` proves that the processor has AVX2. References to sixteen floats are valid
// for two loads or stores of 32 bytes, which ask for no alignment.
impl Lanes for Avx2 {
    type Floats = Floats;
    type Mask = Floats;

    #[inline(always)]
    fn splat(self, x: f32) -> Floats {
        // SAFETY: see above.
        unsafe { [_mm256_set1_ps(x); 2] }
    }
    #[inline(always)]
    fn load(self, from: &[f32; LANES]) -> Floats {
        // SAFETY: see above.
        unsafe { [_mm256_loadu_ps(from.as_ptr()), _mm256_loadu_ps(from.as_ptr().add(8))] }
    }
    #[inline(always)]
    fn store(self, x: Floats, to: &mut [f32; LANES]) {
        // SAFETY: see above.
        unsafe {
            _mm256_storeu_ps(to.as_mut_ptr(), x[0]);
            _mm256_storeu_ps(to.as_mut_ptr().add(8), x[1]);
        }
    }
    #[inline(always)]
    fn add(self, a: Floats, b: Floats) -> Floats {
        // SAFETY: see above.
        unsafe { [_mm256_add_ps(a[0], b[0]), _mm256_add_ps(a[1], b[1])] }
    }
    #[inline(always)]
    fn sub(self, a: Floats, b: Floats) -> Floats {
        // SAFETY: see above.
        unsafe { [_mm256_sub_ps(a[0], b[0]), _mm256_sub_ps(a[1], b[1])] }
    }
    #[inline(always)]
    fn mul(self, a: Floats, b: Floats) -> Floats {
        // SAFETY: see above.
        unsafe { [_mm256_mul_ps(a[0], b[0]), _mm256_mul_ps(a[1], b[1])] }
    }
    #[inline(always)]
    fn div(self, a: Floats, b: Floats) -> Floats {
        // SAFETY: see above.
        unsafe { [_mm256_div_ps(a[0], b[0]), _mm256_div_ps(a[1], b[1])] }
    }
    #[inline(always)]
    fn sqrt(self, x: Floats) -> Floats {
        // SAFETY: see above.
        unsafe { [_mm256_sqrt_ps(x[0]), _mm256_sqrt_ps(x[1])] }
    }
    #[inline(always)]
    fn min(self, a: Floats, b: Floats) -> Floats {
        // SAFETY: see above.
        unsafe { [_mm256_min_ps(a[0], b[0]), _mm256_min_ps(a[1], b[1])] }
    }
    #[inline(always)]
    fn max(self, a: Floats, b: Floats) -> Floats {
        // SAFETY: see above.
        unsafe { [_mm256_max_ps(a[0], b[0]), _mm256_max_ps(a[1], b[1])] }
    }
    #[inline(always)]
    fn less(self, a: Floats, b: Floats) -> Floats {
        // SAFETY: see above.
        unsafe { [_mm256_cmp_ps::<_CMP_LT_OQ>(a[0], b[0]), _mm256_cmp_ps::<_CMP_LT_OQ>(a[1], b[1])] }
    }
    #[inline(always)]
    fn only(self, mask: Floats, x: Floats) -> Floats {
        // SAFETY: see above.
        unsafe { [_mm256_and_ps(mask[0], x[0]), _mm256_and_ps(mask[1], x[1])] }
    }
    #[inline(always)]
    fn select(self, mask: Floats, a: Floats, b: Floats) -> Floats {
        // SAFETY: see above.
        unsafe { [_mm256_blendv_ps(b[0], a[0], mask[0]), _mm256_blendv_ps(b[1], a[1], mask[1])] }
    }
    #[inline(always)]
    fn bits(self, mask: Floats) -> u32 {
        // SAFETY: see above.
        unsafe { (_mm256_movemask_ps(mask[0]) | _mm256_movemask_ps(mask[1]) << 8) as u32 }
    }
    #[inline(always)]
    fn sum(self, x: Floats) -> f32 {
        // SAFETY: see above.
        unsafe {
            let eight = _mm256_add_ps(x[0], x[1]);
            let four = _mm_add_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps::<1>(eight));
            let two = _mm_add_ps(four, _mm_movehl_ps(four, four));
            _mm_cvtss_f32(_mm_add_ss(two, _mm_movehdup_ps(two)))
        }
    }
    #[inline(always)]
    fn least(self, x: Floats) -> f32 {
        // SAFETY: see above.
        unsafe {
            let eight = _mm256_min_ps(x[0], x[1]);
            let four = _mm_min_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps::<1>(eight));
            let two = _mm_min_ps(four, _mm_movehl_ps(four, four));
            _mm_cvtss_f32(_mm_min_ss(two, _mm_movehdup_ps(two)))
        }
    }
    #[inline(always)]
    fn gather(self, positions: &[Position], named: &[u32; LANES]) -> [Floats; 3] {
        let mut gathered = [self.splat(0.0); 3];
        let mut half = 0;
        while half < 2 {
            // SAFETY: see above; positions are read as checked slices of four floats.
            unsafe {
                let one = |k: usize| _mm_loadu_ps(positions[named[8 * half + k] as usize].as_ptr());
                // The positions k and k + 4.
                let two = |k: usize| _mm256_insertf128_ps::<1>(_mm256_castps128_ps256(one(k)), one(k + 4));
                let (a, b, c, d) = (two(0), two(1), two(2), two(3));
                let (ab, cd) = (_mm256_unpacklo_ps(a, b), _mm256_unpacklo_ps(c, d));
                let (ab_z, cd_z) = (_mm256_unpackhi_ps(a, b), _mm256_unpackhi_ps(c, d));
                gathered[0][half] = _mm256_shuffle_ps::<0b01_00_01_00>(ab, cd);
                gathered[1][half] = _mm256_shuffle_ps::<0b11_10_11_10>(ab, cd);
                gathered[2][half] = _mm256_shuffle_ps::<0b01_00_01_00>(ab_z, cd_z);
            }
            half += 1;
        }
        gathered
    }
}
