//! The functions of `stack.rs` in AVX-512.

use std::arch::x86_64::*;

use glam::Vec3A;

use crate::psp::sixteenths::{CORNERS, CORNERS_OF_SIXTEENTHS, STANDING, STARTS};
use crate::psp::stack::{FAR, LANES, LocalFragment, PointLanes, PointStack, SLACK};

use crate::psp::vectors::avx2;

/// Lanes of a whole vector.
const WIDE: usize = 16;

#[inline]
#[target_feature(enable = "avx512f")]
fn load(places: &[f32]) -> __m512 {
    let places = &places[..WIDE];
    // SAFETY: sixteen floats are read, from a slice of sixteen; no alignment is asked for.
    unsafe { _mm512_loadu_ps(places.as_ptr()) }
}

#[inline]
#[target_feature(enable = "avx512f")]
fn numbers(numbers: &[i32; WIDE]) -> __m512i {
    // SAFETY: as above.
    unsafe { _mm512_loadu_si512(numbers.as_ptr().cast()) }
}

#[inline]
#[target_feature(enable = "avx512f")]
fn stored(lanes: __m512) -> [f32; WIDE] {
    let mut stored = [0.0; WIDE];
    // SAFETY: sixteen floats are written, to an array of sixteen; no alignment is asked for.
    unsafe { _mm512_storeu_ps(stored.as_mut_ptr(), lanes) };
    stored
}

/// The squared distances of sixteen places from a point.
#[inline]
#[target_feature(enable = "avx512f")]
fn squares([x, y, z]: [__m512; 3], from: [f32; 3]) -> __m512 {
    let x = _mm512_sub_ps(x, _mm512_set1_ps(from[0]));
    let y = _mm512_sub_ps(y, _mm512_set1_ps(from[1]));
    let z = _mm512_sub_ps(z, _mm512_set1_ps(from[2]));
    _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(x, x), _mm512_mul_ps(y, y)), _mm512_mul_ps(z, z))
}

/// [`PointStack::append`].
#[target_feature(enable = "avx2,avx512f,avx512vl,popcnt")]
pub fn append(stack: &mut PointStack, [x, y, z]: &PointLanes, centre: [f32; 3], reach2: f32) {
    let offsets = avx2::offsets([x, y, z], centre);
    let reaching = _mm256_cmp_ps_mask::<_CMP_LE_OQ>(avx2::square(offsets), _mm256_set1_ps(reach2));
    for (axis, lanes) in stack.axes.iter_mut().zip(offsets) {
        let target = &mut axis[stack.len..stack.len + LANES];
        // SAFETY: eight floats are written, to a slice of eight; no alignment is asked for.
        unsafe { _mm256_storeu_ps(target.as_mut_ptr(), _mm256_maskz_compress_ps(reaching, lanes)) };
    }
    stack.len += reaching.count_ones() as usize;
}

/// [`PointStack::append_reaching`].
#[target_feature(enable = "avx512f,popcnt")]
pub fn append_reaching(stack: &mut PointStack, from: usize, to: usize, centre: [f32; 3], reach2: f32) {
    for start in (from..to).step_by(WIDE) {
        let [x, y, z] = &stack.axes;
        let points = [load(&x[start..]), load(&y[start..]), load(&z[start..])];
        let there = ((1u32 << (to - start).min(WIDE)) - 1) as u16;
        let squares = squares(points, centre);
        let reaching = _mm512_mask_cmp_ps_mask::<_CMP_LE_OQ>(there, squares, _mm512_set1_ps(reach2));
        for (axis, points) in stack.axes.iter_mut().zip(points) {
            let target = &mut axis[stack.len..stack.len + WIDE];
            // SAFETY: sixteen floats are written, to a slice of sixteen; no alignment is asked for.
            unsafe { _mm512_storeu_ps(target.as_mut_ptr(), _mm512_maskz_compress_ps(reaching, points)) };
        }
        stack.len += reaching.count_ones() as usize;
    }
}

/// The corners of the sixteenths.
#[inline]
#[target_feature(enable = "avx512f")]
fn corners(fragment: &LocalFragment) -> [__m512; 3] {
    places(fragment, &CORNERS)
}

/// Places of a fragment, by shares of its edges.
#[inline]
#[target_feature(enable = "avx512f")]
fn places(fragment: &LocalFragment, shares: &[[f32; WIDE]; 2]) -> [__m512; 3] {
    let (s, t) = (load(&shares[0]), load(&shares[1]));
    let (corner, [e, f]) = (fragment.corner.to_array(), fragment.edges.map(|edge| edge.to_array()));
    let along = |axis: usize| {
        let (e, f) = (_mm512_mul_ps(s, _mm512_set1_ps(e[axis])), _mm512_mul_ps(t, _mm512_set1_ps(f[axis])));
        _mm512_add_ps(_mm512_set1_ps(corner[axis]), _mm512_add_ps(e, f))
    };
    [along(0), along(1), along(2)]
}

/// For each sixteenth, the squared distance from a point to its farthest corner.
#[inline]
#[target_feature(enable = "avx512f")]
fn farthest(corners: [__m512; 3], point: [f32; 3]) -> __m512 {
    let squares = squares(corners, point);
    let [a, b, c] = [0, 1, 2].map(|corner| _mm512_permutexvar_ps(numbers(&CORNERS_OF_SIXTEENTHS[corner]), squares));
    _mm512_max_ps(_mm512_max_ps(a, b), c)
}

/// The sixteenths that are covered, given the least of these.
#[inline]
#[target_feature(enable = "avx512f")]
fn inside(farthest: __m512) -> u16 {
    _mm512_cmp_ps_mask::<_CMP_LT_OQ>(farthest, _mm512_set1_ps(1.0 - SLACK))
}

/// [`PointStack::covered`].
#[target_feature(enable = "avx512f")]
pub fn covered(stack: &PointStack, from: usize, fragment: &LocalFragment) -> u16 {
    let corners = corners(fragment);
    let mut least = _mm512_set1_ps(FAR);
    for index in from..stack.len {
        least = _mm512_min_ps(least, farthest(corners, stack.point(index)));
    }
    inside(least)
}

/// [`PointStack::take_covered`].
#[target_feature(enable = "avx512f,bmi1")]
pub fn take_covered(stack: &PointStack, from: usize, fragment: &LocalFragment, open: &mut [u16; 16]) {
    let [x, y, z] = &stack.axes;
    // All parts are the first one, moved to where they start, and some of them turned over.
    let first = LocalFragment { corner: Vec3A::ZERO, ..fragment.sixteenth(0) };
    let (around, (to_centre, reach2)) = (corners(&first), first.reach());
    let starts = places(fragment, &STARTS).map(|lanes| stored(lanes));
    for (index, open) in open.iter_mut().enumerate().filter(|(_, open)| **open != 0) {
        let sign = if index < STANDING { 1.0 } else { -1.0 };
        let start = [0, 1, 2].map(|axis| starts[axis][index]);
        let centre = [0, 1, 2].map(|axis| start[axis] + sign * to_centre[axis]);
        let corners = [0, 1, 2]
            .map(|axis| _mm512_add_ps(_mm512_set1_ps(start[axis]), _mm512_mul_ps(_mm512_set1_ps(sign), around[axis])));
        let mut least = _mm512_set1_ps(FAR);
        for first in (from..stack.len).step_by(WIDE) {
            let squares = squares([load(&x[first..]), load(&y[first..]), load(&z[first..])], centre);
            let there = ((1u32 << (stack.len - first).min(WIDE)) - 1) as u16;
            let mut reaching = _mm512_mask_cmp_ps_mask::<_CMP_LE_OQ>(there, squares, _mm512_set1_ps(reach2));
            while reaching != 0 {
                let point = stack.point(first + reaching.trailing_zeros() as usize);
                least = _mm512_min_ps(least, farthest(corners, point));
                reaching &= reaching - 1;
            }
        }
        *open &= !inside(least);
    }
}
