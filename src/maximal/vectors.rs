//! The functions of `near.rs` in AVX2 and AVX-512, chosen at run time: the same results, to the bit.

#[cfg(target_arch = "x86_64")]
use std::arch::x86_64::*;

use crate::lattice::Rect;

use super::near::{FAR, LANES, MOST_NEAR, Near, Rows};

/// Which vectors the processor has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Vectors {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Vectors {
    /// The widest there are. Whoever holds a variant may run its code.
    pub fn widest() -> Self {
        *Self::available().last().expect("the portable code")
    }

    /// All there are, the widest last.
    pub fn available() -> Vec<Self> {
        #[allow(unused_mut)]
        let mut available = vec![Self::Portable];
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") {
                available.push(Self::Avx2);
                if is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("avx512dq")
                {
                    available.push(Self::Avx512);
                }
            }
        }
        available
    }

    /// [`Rows::nearest`].
    #[inline]
    pub fn nearest(self, rows: &Rows, point: [i32; 2]) -> f32 {
        match self {
            Self::Portable => rows.nearest(point),
            // SAFETY: the variant says that the processor has the vectors.
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 | Self::Avx512 => unsafe { nearest_avx2(rows, point) },
        }
    }

    /// [`Near::gather`].
    #[inline]
    pub fn gather(self, near: &mut Near, rows: &Rows, cell: &Rect, threshold: f32) {
        match self {
            Self::Portable => near.gather(rows, cell, threshold),
            // SAFETY: the variants say that the processor has the vectors.
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => unsafe { gather_avx2(near, rows, cell, threshold) },
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => unsafe { gather_avx512(near, rows, cell, threshold) },
        }
    }

    /// [`collect`].
    #[inline]
    pub fn collect(self, row: [&[i32]; 2], rect: &Rect, samples: &mut [[i32; 2]]) -> usize {
        match self {
            Self::Portable => collect(row, rect, samples),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => collect(row, rect, samples),
            // SAFETY: the variant says that the processor has the vectors.
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => unsafe { collect_avx512(row, rect, samples) },
        }
    }

    /// [`Near::uncovered`].
    #[inline]
    pub fn uncovered(self, near: &Near, voxel: &Rect, width: i32) -> u16 {
        match self {
            Self::Portable => near.uncovered(voxel, width),
            // SAFETY: the variants say that the processor has the vectors.
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => unsafe { uncovered_avx2(near, voxel, width) },
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => unsafe { uncovered_avx512(near, voxel, width) },
        }
    }
}

/// Writes the samples of a row that lie in a rectangle to the front of `samples`, which has room for the whole row, and
/// says how many there are.
fn collect([xs, ys]: [&[i32]; 2], rect: &Rect, samples: &mut [[i32; 2]]) -> usize {
    let mut count = 0;
    for (&x, &y) in xs.iter().zip(ys) {
        // Written in any case and counted only if it is one: which cells have one is not predictable.
        samples[count] = [x, y];
        count += usize::from(rect.contains([x, y]));
    }
    count
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,popcnt")]
fn collect_avx512([xs, ys]: [&[i32]; 2], rect: &Rect, samples: &mut [[i32; 2]]) -> usize {
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

/// As many samples near a cell are tested in any case; seldom are there more.
#[cfg(target_arch = "x86_64")]
const ALWAYS: usize = 6;

/// A row of cells: coordinates along one axis.
#[cfg(target_arch = "x86_64")]
#[inline]
#[target_feature(enable = "avx2")]
fn load(row: &[i32; LANES]) -> __m256i {
    // SAFETY: eight integers are read, from an array of eight; no alignment is asked for.
    unsafe { _mm256_loadu_si256(row.as_ptr().cast()) }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn nearest_avx2(rows: &Rows, point: [i32; 2]) -> f32 {
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
#[cfg(target_arch = "x86_64")]
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
#[cfg(target_arch = "x86_64")]
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

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,popcnt")]
fn gather_avx2(near: &mut Near, rows: &Rows, cell: &Rect, threshold: f32) {
    let end = [(cell.length(0) - 1) as f32, (cell.length(1) - 1) as f32];
    for row in rows.iter() {
        let (positions, covers) = covering(row, near.origin, end, threshold);
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

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,avx512f,avx512vl,popcnt")]
fn gather_avx512(near: &mut Near, rows: &Rows, cell: &Rect, threshold: f32) {
    let end = [(cell.length(0) - 1) as f32, (cell.length(1) - 1) as f32];
    for row in rows.iter() {
        let (positions, covers) = covering(row, near.origin, end, threshold);
        let covers = _mm256_movemask_ps(covers) as u8;
        let [x, y] = positions;
        let far = _mm256_set1_ps(FAR);
        let lanes = [_mm256_mask_compress_ps(far, covers, x), _mm256_mask_compress_ps(far, covers, y)];
        push(near, lanes, covers.count_ones());
    }
}

/// For each choice of lanes, one per bit: the numbers of these lanes, in order, in the bytes from the lowest on; -1 in
/// the others.
#[cfg(target_arch = "x86_64")]
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
#[cfg(target_arch = "x86_64")]
#[inline]
#[target_feature(enable = "avx2")]
fn parts_avx2(min: i32, max: i32, width: i32, parts: __m256i) -> (__m256, __m256) {
    let first = _mm256_add_epi32(_mm256_set1_epi32(min), _mm256_mullo_epi32(parts, _mm256_set1_epi32(width)));
    let end = _mm256_min_epi32(_mm256_add_epi32(first, _mm256_set1_epi32(width)), _mm256_set1_epi32(max));
    let (first, last) = (_mm256_cvtepi32_ps(first), _mm256_cvtepi32_ps(_mm256_sub_epi32(end, _mm256_set1_epi32(1))));
    let half = _mm256_set1_ps(0.5);
    (_mm256_mul_ps(half, _mm256_add_ps(first, last)), _mm256_mul_ps(half, _mm256_sub_ps(last, first)))
}

/// The squares of the distances along an axis from `x` to the farthest points of eight parts.
#[cfg(target_arch = "x86_64")]
#[inline]
#[target_feature(enable = "avx2")]
fn farthest_avx2(x: f32, (centres, extents): (__m256, __m256)) -> __m256 {
    let centre = _mm256_andnot_ps(_mm256_set1_ps(-0.0), _mm256_sub_ps(_mm256_set1_ps(x), centres));
    let farthest = _mm256_add_ps(centre, extents);
    _mm256_mul_ps(farthest, farthest)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn uncovered_avx2(near: &Near, voxel: &Rect, width: i32) -> u16 {
    let min = [voxel.min[0] - near.origin[0], voxel.min[1] - near.origin[1]];
    let max = [voxel.max[0] - near.origin[0], voxel.max[1] - near.origin[1]];
    let columns = parts_avx2(min[0], max[0], width, _mm256_setr_epi32(0, 1, 2, 3, 0, 1, 2, 3));
    let upper = parts_avx2(min[1], max[1], width, _mm256_setr_epi32(2, 2, 2, 2, 3, 3, 3, 3));
    let lower = parts_avx2(min[1], max[1], width, _mm256_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1));
    let mut nearest = [_mm256_set1_ps(f32::MAX); 2];
    let count = near.count.max(ALWAYS);
    for (&x, &y) in near.x[..count].iter().zip(&near.y[..count]) {
        let along = farthest_avx2(x, columns);
        nearest[0] = _mm256_min_ps(nearest[0], _mm256_add_ps(along, farthest_avx2(y, lower)));
        nearest[1] = _mm256_min_ps(nearest[1], _mm256_add_ps(along, farthest_avx2(y, upper)));
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

/// [`parts_avx2`] of sixteen parts.
#[cfg(target_arch = "x86_64")]
#[inline]
#[target_feature(enable = "avx512f")]
fn parts_avx512(min: i32, max: i32, width: i32, parts: __m512i) -> (__m512, __m512) {
    let first = _mm512_add_epi32(_mm512_set1_epi32(min), _mm512_mullo_epi32(parts, _mm512_set1_epi32(width)));
    let end = _mm512_min_epi32(_mm512_add_epi32(first, _mm512_set1_epi32(width)), _mm512_set1_epi32(max));
    let (first, last) = (_mm512_cvtepi32_ps(first), _mm512_cvtepi32_ps(_mm512_sub_epi32(end, _mm512_set1_epi32(1))));
    let half = _mm512_set1_ps(0.5);
    (_mm512_mul_ps(half, _mm512_add_ps(first, last)), _mm512_mul_ps(half, _mm512_sub_ps(last, first)))
}

/// [`farthest_avx2`] of sixteen parts.
#[cfg(target_arch = "x86_64")]
#[inline]
#[target_feature(enable = "avx512f")]
fn farthest_avx512(x: f32, (centres, extents): (__m512, __m512)) -> __m512 {
    let farthest = _mm512_add_ps(_mm512_abs_ps(_mm512_sub_ps(_mm512_set1_ps(x), centres)), extents);
    _mm512_mul_ps(farthest, farthest)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f")]
fn uncovered_avx512(near: &Near, voxel: &Rect, width: i32) -> u16 {
    let min = [voxel.min[0] - near.origin[0], voxel.min[1] - near.origin[1]];
    let max = [voxel.max[0] - near.origin[0], voxel.max[1] - near.origin[1]];
    let columns = _mm512_setr_epi32(0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3);
    let rows = _mm512_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
    let columns = parts_avx512(min[0], max[0], width, columns);
    let rows = parts_avx512(min[1], max[1], width, rows);
    let mut nearest = _mm512_set1_ps(f32::MAX);
    let count = near.count.max(ALWAYS);
    for (&x, &y) in near.x[..count].iter().zip(&near.y[..count]) {
        nearest = _mm512_min_ps(nearest, _mm512_add_ps(farthest_avx512(x, columns), farthest_avx512(y, rows)));
    }
    let zero = _mm512_setzero_ps();
    _mm512_cmp_ps_mask::<_CMP_GE_OQ>(nearest, _mm512_set1_ps(near.limit))
        & _mm512_cmp_ps_mask::<_CMP_GE_OQ>(columns.1, zero)
        & _mm512_cmp_ps_mask::<_CMP_GE_OQ>(rows.1, zero)
}
