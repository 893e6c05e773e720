//! The functions of `near.rs` in AVX-512.

use std::arch::x86_64::*;

use crate::lattice::Rect;
use crate::maximal::near::{ALWAYS, FAR, LANES, Near, Rows};

use super::avx2::{covering, push};

/// [`Near::gather`].
#[target_feature(enable = "avx2,avx512f,avx512vl,popcnt")]
pub fn gather(near: &mut Near, rows: &Rows, cell: Rect, threshold: f32) {
    (near.origin, near.count) = (cell.min, 0);
    let end = [(cell.length(0) - 1) as f32, (cell.length(1) - 1) as f32];
    for row in rows.iter() {
        let (positions, covers) = covering(row, cell.min, end, threshold);
        let covers = _mm256_movemask_ps(covers) as u8;
        let [x, y] = positions;
        let far = _mm256_set1_ps(FAR);
        let lanes = [_mm256_mask_compress_ps(far, covers, x), _mm256_mask_compress_ps(far, covers, y)];
        push(near, lanes, covers.count_ones());
    }
}

/// The centres and half extents along an axis of sixteen parts of a voxel, each `width` long.
#[inline]
#[target_feature(enable = "avx512f")]
fn parts(min: i32, max: i32, width: i32, parts: __m512i) -> (__m512, __m512) {
    let first = _mm512_add_epi32(_mm512_set1_epi32(min), _mm512_mullo_epi32(parts, _mm512_set1_epi32(width)));
    let end = _mm512_min_epi32(_mm512_add_epi32(first, _mm512_set1_epi32(width)), _mm512_set1_epi32(max));
    let (first, last) = (_mm512_cvtepi32_ps(first), _mm512_cvtepi32_ps(_mm512_sub_epi32(end, _mm512_set1_epi32(1))));
    let half = _mm512_set1_ps(0.5);
    (_mm512_mul_ps(half, _mm512_add_ps(first, last)), _mm512_mul_ps(half, _mm512_sub_ps(last, first)))
}

/// The squares of the distances along an axis from `x` to the farthest points of sixteen parts.
#[inline]
#[target_feature(enable = "avx512f")]
fn farthest(x: f32, (centres, extents): (__m512, __m512)) -> __m512 {
    let farthest = _mm512_add_ps(_mm512_abs_ps(_mm512_sub_ps(_mm512_set1_ps(x), centres)), extents);
    _mm512_mul_ps(farthest, farthest)
}

/// [`Near::uncovered`].
#[target_feature(enable = "avx512f")]
pub fn uncovered(near: &Near, voxel: &Rect, width: i32) -> u16 {
    let min = [voxel.min[0] - near.origin[0], voxel.min[1] - near.origin[1]];
    let max = [voxel.max[0] - near.origin[0], voxel.max[1] - near.origin[1]];
    let columns = _mm512_setr_epi32(0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3);
    let rows = _mm512_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
    let columns = parts(min[0], max[0], width, columns);
    let rows = parts(min[1], max[1], width, rows);
    let mut nearest = _mm512_set1_ps(f32::MAX);
    let count = near.count.max(ALWAYS);
    for (&x, &y) in near.x[..count].iter().zip(&near.y[..count]) {
        nearest = _mm512_min_ps(nearest, _mm512_add_ps(farthest(x, columns), farthest(y, rows)));
    }
    let zero = _mm512_setzero_ps();
    _mm512_cmp_ps_mask::<_CMP_GE_OQ>(nearest, _mm512_set1_ps(near.limit))
        & _mm512_cmp_ps_mask::<_CMP_GE_OQ>(columns.1, zero)
        & _mm512_cmp_ps_mask::<_CMP_GE_OQ>(rows.1, zero)
}

/// [`collect`](crate::maximal::near::collect).
#[target_feature(enable = "avx512f,avx512vl,avx512dq,popcnt")]
pub fn collect([xs, ys]: [&[i32]; 2], rect: &Rect, samples: &mut [[i32; 2]]) -> usize {
    let mut count = 0;
    let (xs, ys) = (xs.chunks(LANES), ys.chunks(LANES));
    for (xs, ys) in xs.zip(ys) {
        let lanes = u8::MAX >> (LANES - xs.len());
        // SAFETY: as many integers are read as there are in the slices.
        let (x, y) =
            unsafe { (_mm256_maskz_loadu_epi32(lanes, xs.as_ptr()), _mm256_maskz_loadu_epi32(lanes, ys.as_ptr())) };
        let inside = _mm256_mask_cmpge_epi32_mask(lanes, x, _mm256_set1_epi32(rect.min[0]))
            & _mm256_cmplt_epi32_mask(x, _mm256_set1_epi32(rect.max[0]))
            & _mm256_cmpge_epi32_mask(y, _mm256_set1_epi32(rect.min[1]))
            & _mm256_cmplt_epi32_mask(y, _mm256_set1_epi32(rect.max[1]));
        // Pairs of x and y, the first of them in the lower half of a 64-bit lane.
        let pairs = _mm512_or_si512(_mm512_cvtepu32_epi64(x), _mm512_slli_epi64::<32>(_mm512_cvtepi32_epi64(y)));
        let pairs = _mm512_maskz_compress_epi64(inside, pairs);
        let found = inside.count_ones() as usize;
        let target = &mut samples[count..count + found];
        // SAFETY: as many pairs are written as there are in the slice; a pair of integers has the layout of the lane.
        unsafe { _mm512_mask_storeu_epi64(target.as_mut_ptr().cast(), ((1u32 << found) - 1) as u8, pairs) };
        count += found;
    }
    count
}
