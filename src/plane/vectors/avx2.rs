//! The functions of `near.rs` in AVX2.

use std::arch::x86_64::*;

use crate::plane::near::{ALWAYS, FAR, MOST_NEAR, Near};
use crate::plane::rect::Rect;
use crate::plane::rows::{LANES, Rows};

/// A row of cells: coordinates along one axis.
#[inline]
#[target_feature(enable = "avx2")]
fn load(row: &[i32; LANES]) -> __m256i {
    // SAFETY: eight integers are read, from an array of eight; no alignment is asked for.
    unsafe { _mm256_loadu_si256(row.as_ptr().cast()) }
}

/// [`Rows::nearest`].
#[inline]
#[target_feature(enable = "avx2")]
pub fn nearest(rows: &Rows, point: [i32; 2]) -> f32 {
    let (px, py) = (_mm256_set1_epi32(point[0]), _mm256_set1_epi32(point[1]));
    let mut nearest = _mm256_set1_ps(f32::MAX);
    for [xs, ys] in rows.iter() {
        let dx = _mm256_cvtepi32_ps(_mm256_sub_epi32(load(xs), px));
        let dy = _mm256_cvtepi32_ps(_mm256_sub_epi32(load(ys), py));
        nearest = _mm256_min_ps(nearest, _mm256_add_ps(_mm256_mul_ps(dx, dx), _mm256_mul_ps(dy, dy)));
    }
    let four = _mm_min_ps(_mm256_castps256_ps128(nearest), _mm256_extractf128_ps(nearest, 1));
    let two = _mm_min_ps(four, _mm_movehl_ps(four, four));
    _mm_cvtss_f32(_mm_min_ss(two, _mm_shuffle_ps(two, two, 1)))
}

/// A row as seen from a place, and in which lanes it is closer than the square root of `threshold` to a rectangle that
/// goes from there to `end`.
#[inline]
#[target_feature(enable = "avx2")]
fn covering(row: [&[i32; LANES]; 2], origin: [i32; 2], end: [f32; 2], threshold: f32) -> ([__m256; 2], __m256) {
    let mut positions = [_mm256_setzero_ps(); 2];
    let mut squares = [_mm256_setzero_ps(); 2];
    for axis in 0..2 {
        let x = _mm256_cvtepi32_ps(_mm256_sub_epi32(load(row[axis]), _mm256_set1_epi32(origin[axis])));
        let clamped = _mm256_min_ps(_mm256_max_ps(x, _mm256_setzero_ps()), _mm256_set1_ps(end[axis]));
        let along = _mm256_sub_ps(x, clamped);
        (positions[axis], squares[axis]) = (x, _mm256_mul_ps(along, along));
    }
    let d2 = _mm256_add_ps(squares[0], squares[1]);
    (positions, _mm256_cmp_ps::<_CMP_LT_OQ>(d2, _mm256_set1_ps(threshold)))
}

/// Adds the lanes of a row in front of those beyond, which the next ones overwrite.
#[inline]
#[target_feature(enable = "avx2")]
fn push(near: &mut Near, lanes: [__m256; 2], count: u32) {
    let places = near.count..near.count + LANES;
    let (x, y) = (&mut near.x[places.clone()], &mut near.y[places]);
    // SAFETY: eight floats are written, to slices of eight; no alignment is asked for.
    unsafe {
        _mm256_storeu_ps(x.as_mut_ptr(), lanes[0]);
        _mm256_storeu_ps(y.as_mut_ptr(), lanes[1]);
    }
    near.count = (near.count + count as usize).min(MOST_NEAR);
}

/// [`Near::gather`].
#[inline]
#[target_feature(enable = "avx2,popcnt")]
pub fn gather(near: &mut Near, rows: &Rows, cell: Rect, threshold: f32) {
    (near.origin, near.count) = (cell.min, 0);
    let end = [(cell.length(0) - 1) as f32, (cell.length(1) - 1) as f32];
    for row in rows.iter() {
        let (positions, covers) = covering(row, cell.min, end, threshold);
        let covers = _mm256_movemask_ps(covers) as u32;
        let order = _mm256_cvtepi8_epi32(_mm_cvtsi64_si128(LANES_TO_FRONT[covers as usize]));
        let [x, y] = positions;
        let (x, y) = (_mm256_permutevar8x32_ps(x, order), _mm256_permutevar8x32_ps(y, order));
        // The sign of an unused lane's number is set.
        let (far, unused) = (_mm256_set1_ps(FAR), _mm256_castsi256_ps(order));
        let lanes = [_mm256_blendv_ps(x, far, unused), _mm256_blendv_ps(y, far, unused)];
        push(near, lanes, covers.count_ones());
    }
}

/// For each choice of lanes, one per bit: the numbers of these lanes, in order, in the bytes from the lowest on; -1 in
/// the others.
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

/// The centres and half extents along an axis of eight parts of a voxel, each `width` long, and in which they are empty.
#[inline]
#[target_feature(enable = "avx2")]
fn parts(min: i32, max: i32, width: i32, parts: __m256i) -> (__m256, __m256) {
    let first = _mm256_add_epi32(_mm256_set1_epi32(min), _mm256_mullo_epi32(parts, _mm256_set1_epi32(width)));
    let end = _mm256_min_epi32(_mm256_add_epi32(first, _mm256_set1_epi32(width)), _mm256_set1_epi32(max));
    let (first, last) = (_mm256_cvtepi32_ps(first), _mm256_cvtepi32_ps(_mm256_sub_epi32(end, _mm256_set1_epi32(1))));
    let half = _mm256_set1_ps(0.5);
    (_mm256_mul_ps(half, _mm256_add_ps(first, last)), _mm256_mul_ps(half, _mm256_sub_ps(last, first)))
}

/// The squares of the distances along an axis from `x` to the farthest points of eight parts.
#[inline]
#[target_feature(enable = "avx2")]
fn farthest(x: f32, (centres, extents): (__m256, __m256)) -> __m256 {
    let centre = _mm256_andnot_ps(_mm256_set1_ps(-0.0), _mm256_sub_ps(_mm256_set1_ps(x), centres));
    let farthest = _mm256_add_ps(centre, extents);
    _mm256_mul_ps(farthest, farthest)
}

/// [`Near::uncovered`].
#[inline]
#[target_feature(enable = "avx2")]
pub fn uncovered(near: &Near, voxel: &Rect, width: i32) -> u16 {
    let min = [voxel.min[0] - near.origin[0], voxel.min[1] - near.origin[1]];
    let max = [voxel.max[0] - near.origin[0], voxel.max[1] - near.origin[1]];
    let columns = parts(min[0], max[0], width, _mm256_setr_epi32(0, 1, 2, 3, 0, 1, 2, 3));
    let upper = parts(min[1], max[1], width, _mm256_setr_epi32(2, 2, 2, 2, 3, 3, 3, 3));
    let lower = parts(min[1], max[1], width, _mm256_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1));
    let mut nearest = [_mm256_set1_ps(f32::MAX); 2];
    let count = near.count.max(ALWAYS);
    for (&x, &y) in near.x[..count].iter().zip(&near.y[..count]) {
        let along = farthest(x, columns);
        nearest[0] = _mm256_min_ps(nearest[0], _mm256_add_ps(along, farthest(y, lower)));
        nearest[1] = _mm256_min_ps(nearest[1], _mm256_add_ps(along, farthest(y, upper)));
    }
    let mut open = 0;
    for (half, (_, extents)) in [lower, upper].into_iter().enumerate() {
        let uncovered = _mm256_cmp_ps::<_CMP_GE_OQ>(nearest[half], _mm256_set1_ps(near.limit));
        // The sign of an extent is set in parts beyond the end.
        let beyond = _mm256_or_ps(columns.1, extents);
        open |= (_mm256_movemask_ps(_mm256_andnot_ps(beyond, uncovered)) as u16) << (8 * half);
    }
    open
}
