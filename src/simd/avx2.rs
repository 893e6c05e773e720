//! [`Lanes`] in AVX2: two vectors of eight.

use std::arch::x86_64::*;

use crate::simd::Avx2;
use crate::simd::lanes::{HALF, LANES, Lanes, Position};

type Floats = [__m256; 2];
type Ints = [__m256i; 2];
type Doubles = [__m256d; 2];

// SAFETY of all intrinsics here: an `Avx2` proves that the processor has AVX2. References to sixteen floats are valid
// for two loads or stores of 32 bytes, which require no alignment.
impl Lanes for Avx2 {
    type Floats = Floats;
    type Ints = Ints;
    type Doubles = Doubles;
    type Longs = Ints;
    type Mask = Floats;

    const PERMUTES: bool = false;

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
    fn abs(self, x: Floats) -> Floats {
        // SAFETY: see above.
        unsafe {
            let sign = _mm256_set1_ps(-0.0);
            [_mm256_andnot_ps(sign, x[0]), _mm256_andnot_ps(sign, x[1])]
        }
    }
    #[inline(always)]
    fn less(self, a: Floats, b: Floats) -> Floats {
        // SAFETY: see above.
        unsafe { [_mm256_cmp_ps::<_CMP_LT_OQ>(a[0], b[0]), _mm256_cmp_ps::<_CMP_LT_OQ>(a[1], b[1])] }
    }
    #[inline(always)]
    fn at_most(self, a: Floats, b: Floats) -> Floats {
        // SAFETY: see above.
        unsafe { [_mm256_cmp_ps::<_CMP_LE_OQ>(a[0], b[0]), _mm256_cmp_ps::<_CMP_LE_OQ>(a[1], b[1])] }
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
    fn both(self, a: Floats, b: Floats) -> Floats {
        // SAFETY: see above.
        unsafe { [_mm256_and_ps(a[0], b[0]), _mm256_and_ps(a[1], b[1])] }
    }
    #[inline(always)]
    fn permute(self, x: Floats, numbers: &[i32; LANES]) -> Floats {
        let mut lanes = [0.0; LANES];
        self.store(x, &mut lanes);
        self.load(&numbers.map(|number| lanes[number as usize % LANES]))
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
            // SAFETY: see above; each position is read as an array of four floats, with its index checked.
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

    #[inline(always)]
    fn splat_int(self, x: i32) -> Ints {
        // SAFETY: see above.
        unsafe { [_mm256_set1_epi32(x); 2] }
    }
    #[inline(always)]
    fn load_ints(self, from: &[i32; LANES]) -> Ints {
        // SAFETY: see above.
        unsafe {
            let from = from.as_ptr();
            [_mm256_loadu_si256(from.cast()), _mm256_loadu_si256(from.add(8).cast())]
        }
    }
    #[inline(always)]
    fn load_halves(self, from: [&[i32; HALF]; 2]) -> Ints {
        // SAFETY: see above.
        unsafe { [_mm256_loadu_si256(from[0].as_ptr().cast()), _mm256_loadu_si256(from[1].as_ptr().cast())] }
    }
    #[inline(always)]
    fn add_ints(self, a: Ints, b: Ints) -> Ints {
        // SAFETY: see above.
        unsafe { [_mm256_add_epi32(a[0], b[0]), _mm256_add_epi32(a[1], b[1])] }
    }
    #[inline(always)]
    fn sub_ints(self, a: Ints, b: Ints) -> Ints {
        // SAFETY: see above.
        unsafe { [_mm256_sub_epi32(a[0], b[0]), _mm256_sub_epi32(a[1], b[1])] }
    }
    #[inline(always)]
    fn mul_ints(self, a: Ints, b: Ints) -> Ints {
        // SAFETY: see above.
        unsafe { [_mm256_mullo_epi32(a[0], b[0]), _mm256_mullo_epi32(a[1], b[1])] }
    }
    #[inline(always)]
    fn min_ints(self, a: Ints, b: Ints) -> Ints {
        // SAFETY: see above.
        unsafe { [_mm256_min_epi32(a[0], b[0]), _mm256_min_epi32(a[1], b[1])] }
    }
    #[inline(always)]
    fn and_ints(self, a: Ints, b: Ints) -> Ints {
        // SAFETY: see above.
        unsafe { [_mm256_and_si256(a[0], b[0]), _mm256_and_si256(a[1], b[1])] }
    }
    #[inline(always)]
    fn less_ints(self, a: Ints, b: Ints) -> Floats {
        // SAFETY: see above.
        unsafe {
            let greater = [_mm256_cmpgt_epi32(b[0], a[0]), _mm256_cmpgt_epi32(b[1], a[1])];
            [_mm256_castsi256_ps(greater[0]), _mm256_castsi256_ps(greater[1])]
        }
    }
    #[inline(always)]
    fn floats(self, x: Ints) -> Floats {
        // SAFETY: see above.
        unsafe { [_mm256_cvtepi32_ps(x[0]), _mm256_cvtepi32_ps(x[1])] }
    }
    #[inline(always)]
    fn float_bits(self, x: Floats) -> Ints {
        // SAFETY: see above.
        unsafe { [_mm256_castps_si256(x[0]), _mm256_castps_si256(x[1])] }
    }
    #[inline(always)]
    fn compress_ints(self, mask: Floats, x: Ints, to: &mut [i32; LANES]) {
        // SAFETY: see above; up to eight lanes are before the last eight that are written.
        unsafe {
            let (order, count) = to_front(mask[0]);
            _mm256_storeu_si256(to.as_mut_ptr().cast(), _mm256_permutevar8x32_epi32(x[0], order));
            let upper = _mm256_permutevar8x32_epi32(x[1], to_front(mask[1]).0);
            _mm256_storeu_si256(to.as_mut_ptr().add(count).cast(), upper);
        }
    }
    #[inline(always)]
    fn compress(self, mask: Floats, x: Floats, rest: f32, to: &mut [f32; LANES]) {
        // SAFETY: see above; up to eight lanes are before the last eight that are written.
        unsafe {
            let rest = _mm256_set1_ps(rest);
            let (order, count) = to_front(mask[0]);
            // The sign of an unused lane's number is set.
            let front =
                |x, order| _mm256_blendv_ps(_mm256_permutevar8x32_ps(x, order), rest, _mm256_castsi256_ps(order));
            _mm256_storeu_ps(to.as_mut_ptr(), front(x[0], order));
            _mm256_storeu_ps(to.as_mut_ptr().add(8), rest);
            _mm256_storeu_ps(to.as_mut_ptr().add(count), front(x[1], to_front(mask[1]).0));
        }
    }

    #[inline(always)]
    fn splat_double(self, x: f64) -> Doubles {
        // SAFETY: see above.
        unsafe { [_mm256_set1_pd(x); 2] }
    }
    #[inline(always)]
    fn load_doubles(self, from: &[f64; HALF]) -> Doubles {
        // SAFETY: see above.
        unsafe { [_mm256_loadu_pd(from.as_ptr()), _mm256_loadu_pd(from.as_ptr().add(4))] }
    }
    #[inline(always)]
    fn add_doubles(self, a: Doubles, b: Doubles) -> Doubles {
        // SAFETY: see above.
        unsafe { [_mm256_add_pd(a[0], b[0]), _mm256_add_pd(a[1], b[1])] }
    }
    #[inline(always)]
    fn mul_doubles(self, a: Doubles, b: Doubles) -> Doubles {
        // SAFETY: see above.
        unsafe { [_mm256_mul_pd(a[0], b[0]), _mm256_mul_pd(a[1], b[1])] }
    }
    #[inline(always)]
    fn narrow(self, x: Doubles) -> Floats {
        // SAFETY: see above.
        unsafe { [_mm256_set_m128(_mm256_cvtpd_ps(x[1]), _mm256_cvtpd_ps(x[0])); 2] }
    }

    #[inline(always)]
    fn widen(self, x: Ints) -> Ints {
        // SAFETY: see above.
        unsafe {
            let (low, high) = (_mm256_castsi256_si128(x[0]), _mm256_extracti128_si256::<1>(x[0]));
            [_mm256_cvtepu32_epi64(low), _mm256_cvtepu32_epi64(high)]
        }
    }
    #[inline(always)]
    fn store_longs(self, x: Ints, to: &mut [u64; HALF]) {
        // SAFETY: see above.
        unsafe {
            _mm256_storeu_si256(to.as_mut_ptr().cast(), x[0]);
            _mm256_storeu_si256(to.as_mut_ptr().add(4).cast(), x[1]);
        }
    }
    #[inline(always)]
    fn or_longs(self, a: Ints, b: Ints) -> Ints {
        // SAFETY: see above.
        unsafe { [_mm256_or_si256(a[0], b[0]), _mm256_or_si256(a[1], b[1])] }
    }
    #[inline(always)]
    fn shift_longs(self, x: Ints, by: u32) -> Ints {
        // SAFETY: see above.
        unsafe {
            let by = _mm_cvtsi32_si128(by.cast_signed());
            [_mm256_sll_epi64(x[0], by), _mm256_sll_epi64(x[1], by)]
        }
    }
    #[inline(always)]
    fn equal_longs(self, x: Ints, to: u64) -> u8 {
        // SAFETY: see above.
        unsafe {
            let to = _mm256_set1_epi64x(to.cast_signed());
            let equal = |x| _mm256_movemask_pd(_mm256_castsi256_pd(_mm256_cmpeq_epi64(x, to))) as u8;
            equal(x[0]) | equal(x[1]) << 4
        }
    }
}

/// The numbers of the lanes that are set in a mask of eight, in order, and -1 after them; and how many there are.
#[inline(always)]
fn to_front(mask: __m256) -> (__m256i, usize) {
    // SAFETY: called by the operations of [`Lanes`] only, as above.
    unsafe {
        let mask = _mm256_movemask_ps(mask) as usize;
        let numbers = _mm_cvtsi64_si128(LANES_TO_FRONT[mask]);
        (_mm256_cvtepi8_epi32(numbers), mask.count_ones() as usize)
    }
}

/// For each subset of the lanes, one per bit: the numbers of these lanes, in order, in the bytes from the lowest on; -1
/// in the others.
const LANES_TO_FRONT: [i64; 256] = {
    let mut table = [-1; 256];
    let mut choice = 0;
    while choice < 256 {
        let (mut lane, mut byte) = (0, 0);
        while lane < 8 {
            if choice >> lane & 1 == 1 {
                table[choice] &= !(0xff << (8 * byte)) | lane << (8 * byte);
                byte += 1;
            }
            lane += 1;
        }
        choice += 1;
    }
    table
};
