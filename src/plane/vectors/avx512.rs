//! The functions of `near.rs` in AVX-512.

use std::arch::x86_64::*;

use crate::plane::list::List;
use crate::plane::near::{ALWAYS, FAR, MOST_NEAR, Near};
use crate::plane::rect::Rect;
use crate::plane::rows::{LANES, NOWHERE, Rows};

/// Visits the rows by twos, as the x and the y of sixteen cells; a last one alone has a row of nothing beside it.
#[inline(always)]
fn by_twos(rows: &Rows, mut visit: impl FnMut(__m512i, __m512i)) {
    let end = rows.first + (rows.count - 1) * rows.stride + LANES;
    assert!(rows.samples.iter().all(|samples| end <= samples.len()), "rows are cells of the grid");
    let [xs, ys] = rows.samples.map(|samples| samples[rows.first..].as_ptr());
    for row in (0..rows.count).step_by(2) {
        let [lower, upper] = [row, row + 1].map(|row| row * rows.stride);
        let is_alone = row + 1 == rows.count;
        // SAFETY: whoever calls has the vectors. Eight integers are read from where a row begins, and all rows lie in the
        // slices; no alignment is asked for.
        let pair = |xs: *const i32| unsafe {
            let nothing = _mm256_set1_epi32(NOWHERE);
            let lower = _mm256_loadu_si256(xs.add(lower).cast());
            let upper = if is_alone { nothing } else { _mm256_loadu_si256(xs.add(upper).cast()) };
            _mm512_inserti64x4::<1>(_mm512_castsi256_si512(lower), upper)
        };
        visit(pair(xs), pair(ys));
    }
}

/// [`Rows::nearest`].
#[inline]
#[target_feature(enable = "avx2,avx512f")]
pub fn nearest(rows: &Rows, point: [i32; 2]) -> f32 {
    let (px, py) = (_mm512_set1_epi32(point[0]), _mm512_set1_epi32(point[1]));
    let mut nearest = _mm512_set1_ps(f32::MAX);
    by_twos(rows, |xs, ys| {
        let dx = _mm512_cvtepi32_ps(_mm512_sub_epi32(xs, px));
        let dy = _mm512_cvtepi32_ps(_mm512_sub_epi32(ys, py));
        nearest = _mm512_min_ps(nearest, _mm512_add_ps(_mm512_mul_ps(dx, dx), _mm512_mul_ps(dy, dy)));
    });
    _mm512_reduce_min_ps(nearest)
}

/// [`Near::gather`].
#[inline]
#[target_feature(enable = "avx2,avx512f,popcnt")]
pub fn gather(near: &mut Near, rows: &Rows, cell: Rect, threshold: f32) {
    (near.origin, near.count) = (cell.min, 0);
    let (zero, far) = (_mm512_setzero_ps(), _mm512_set1_ps(FAR));
    let origin = cell.min.map(|x| _mm512_set1_epi32(x));
    let end = [0, 1].map(|axis: usize| _mm512_set1_ps((cell.length(axis) - 1) as f32));
    by_twos(rows, |xs, ys| {
        let x = _mm512_cvtepi32_ps(_mm512_sub_epi32(xs, origin[0]));
        let y = _mm512_cvtepi32_ps(_mm512_sub_epi32(ys, origin[1]));
        let dx = _mm512_sub_ps(x, _mm512_min_ps(_mm512_max_ps(x, zero), end[0]));
        let dy = _mm512_sub_ps(y, _mm512_min_ps(_mm512_max_ps(y, zero), end[1]));
        let d2 = _mm512_add_ps(_mm512_mul_ps(dx, dx), _mm512_mul_ps(dy, dy));
        let covers = _mm512_cmp_ps_mask::<_CMP_LT_OQ>(d2, _mm512_set1_ps(threshold));
        let places = near.count..near.count + 2 * LANES;
        let (to_x, to_y) = (&mut near.x[places.clone()], &mut near.y[places]);
        // SAFETY: sixteen floats are written, to slices of sixteen; no alignment is asked for.
        unsafe {
            _mm512_storeu_ps(to_x.as_mut_ptr(), _mm512_mask_compress_ps(far, covers, x));
            _mm512_storeu_ps(to_y.as_mut_ptr(), _mm512_mask_compress_ps(far, covers, y));
        }
        near.count = (near.count + covers.count_ones() as usize).min(MOST_NEAR);
    });
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
#[inline]
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

/// [`collect`](crate::plane::list::collect).
#[inline]
#[target_feature(enable = "avx512f,popcnt")]
pub fn collect(rows: &Rows, width: usize, rect: &Rect, list: &mut List) {
    const WIDE: usize = 2 * LANES;
    let [min_x, min_y] = rect.min.map(|x| _mm512_set1_epi32(x));
    let [max_x, max_y] = rect.max.map(|x| _mm512_set1_epi32(x));
    for row in 0..rows.count {
        let cells = rows.first + row * rows.stride..rows.first + row * rows.stride + width;
        let (xs, ys) = (&rows.samples[0][cells.clone()], &rows.samples[1][cells]);
        for column in (0..width).step_by(WIDE) {
            let lanes = u16::MAX >> WIDE.saturating_sub(width - column);
            let places = list.count..list.count + WIDE;
            let (to_x, to_y) = (&mut list.x[places.clone()], &mut list.y[places]);
            // SAFETY: of the row only those of sixteen integers are read that are in it; sixteen are written, to slices of
            // sixteen. No alignment is asked for.
            unsafe {
                let x = _mm512_maskz_loadu_epi32(lanes, xs.as_ptr().add(column));
                let y = _mm512_maskz_loadu_epi32(lanes, ys.as_ptr().add(column));
                let inside = _mm512_mask_cmpge_epi32_mask(lanes, x, min_x)
                    & _mm512_cmplt_epi32_mask(x, max_x)
                    & _mm512_cmpge_epi32_mask(y, min_y)
                    & _mm512_cmplt_epi32_mask(y, max_y);
                _mm512_storeu_epi32(to_x.as_mut_ptr(), _mm512_maskz_compress_epi32(inside, x));
                _mm512_storeu_epi32(to_y.as_mut_ptr(), _mm512_maskz_compress_epi32(inside, y));
                list.count += inside.count_ones() as usize;
            }
        }
    }
}
