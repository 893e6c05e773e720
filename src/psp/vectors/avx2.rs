//! The functions of `stack.rs` in AVX2.

use std::arch::x86_64::*;

use crate::psp::sixteenths::{CORNERS, Cover};
use crate::psp::stack::{LANES, LocalFragment, PointLanes, PointStack, SLACK};

#[inline]
#[target_feature(enable = "avx2")]
pub(super) fn load(places: &[f32]) -> __m256 {
    let places = &places[..LANES];
    // SAFETY: eight floats are read, from a slice of eight; no alignment is asked for.
    unsafe { _mm256_loadu_ps(places.as_ptr()) }
}

/// The squared lengths of eight vectors.
#[inline]
#[target_feature(enable = "avx2")]
pub(super) fn square([x, y, z]: [__m256; 3]) -> __m256 {
    _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(x, x), _mm256_mul_ps(y, y)), _mm256_mul_ps(z, z))
}

/// Eight places as seen from a point.
#[inline]
#[target_feature(enable = "avx2")]
pub(super) fn offsets([x, y, z]: [&[f32]; 3], from: [f32; 3]) -> [__m256; 3] {
    [
        _mm256_sub_ps(load(x), _mm256_set1_ps(from[0])),
        _mm256_sub_ps(load(y), _mm256_set1_ps(from[1])),
        _mm256_sub_ps(load(z), _mm256_set1_ps(from[2])),
    ]
}

/// Pushes the chosen lanes; what is written behind them does not count.
#[inline]
#[target_feature(enable = "avx2,popcnt")]
fn push(stack: &mut PointStack, lanes: [__m256; 3], chosen: u32) {
    let order = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(LANES_TO_FRONT[chosen as usize]));
    for (axis, lanes) in stack.axes.iter_mut().zip(lanes) {
        let target = &mut axis[stack.len..stack.len + LANES];
        // SAFETY: eight floats are written, to a slice of eight; no alignment is asked for.
        unsafe { _mm256_storeu_ps(target.as_mut_ptr(), _mm256_permutevar8x32_ps(lanes, order)) };
    }
    stack.len += chosen.count_ones() as usize;
}

/// For each choice of lanes, one per bit: the numbers of these lanes, in order, in the bytes from the lowest on.
const LANES_TO_FRONT: [i64; 256] = {
    let mut table = [0; 256];
    let mut choice = 0;
    while choice < 256 {
        let (mut lane, mut byte) = (0, 0);
        while lane < 8 {
            if choice >> lane & 1 == 1 {
                table[choice] |= lane << (8 * byte);
                byte += 1;
            }
            lane += 1;
        }
        choice += 1;
    }
    table
};

/// [`PointStack::append`].
#[target_feature(enable = "avx2,popcnt")]
pub fn append(stack: &mut PointStack, [x, y, z]: &PointLanes, centre: [f32; 3], reach2: f32) {
    let offsets = offsets([x, y, z], centre);
    let reaching = _mm256_cmp_ps::<_CMP_LE_OQ>(square(offsets), _mm256_set1_ps(reach2));
    push(stack, offsets, _mm256_movemask_ps(reaching) as u32);
}

/// [`PointStack::append_reaching`].
#[target_feature(enable = "avx2,popcnt")]
pub fn append_reaching(stack: &mut PointStack, from: usize, to: usize, centre: [f32; 3], reach2: f32) {
    for start in (from..to).step_by(LANES) {
        let [x, y, z] = &stack.axes;
        let places = [&x[start..], &y[start..], &z[start..]];
        let points = [load(places[0]), load(places[1]), load(places[2])];
        let reaching = _mm256_cmp_ps::<_CMP_LE_OQ>(square(offsets(places, centre)), _mm256_set1_ps(reach2));
        let there = (1u32 << (to - start).min(LANES)) - 1;
        push(stack, points, _mm256_movemask_ps(reaching) as u32 & there);
    }
}

/// Eight corners of sixteenths, from the given one on.
#[inline]
#[target_feature(enable = "avx2")]
fn corners(fragment: &LocalFragment, first: usize) -> [__m256; 3] {
    let (s, t) = (load(&CORNERS[0][first..]), load(&CORNERS[1][first..]));
    let (corner, [e, f]) = (fragment.corner.to_array(), fragment.edges.map(|edge| edge.to_array()));
    let along = |axis: usize| {
        let (e, f) = (_mm256_mul_ps(s, _mm256_set1_ps(e[axis])), _mm256_mul_ps(t, _mm256_set1_ps(f[axis])));
        _mm256_add_ps(_mm256_set1_ps(corner[axis]), _mm256_add_ps(e, f))
    };
    [along(0), along(1), along(2)]
}

/// Adds the sixteenths whose corners are in the ball around a point.
#[inline]
#[target_feature(enable = "avx2")]
fn add(cover: &mut Cover, corners: &[[__m256; 3]; 2], point: [f32; 3]) {
    let limit = _mm256_set1_ps(1.0 - SLACK);
    let [low, high] = corners.map(|[x, y, z]| {
        let x = _mm256_sub_ps(x, _mm256_set1_ps(point[0]));
        let y = _mm256_sub_ps(y, _mm256_set1_ps(point[1]));
        let z = _mm256_sub_ps(z, _mm256_set1_ps(point[2]));
        _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(square([x, y, z]), limit)) as u16
    });
    cover.add(low | high << LANES);
}

/// [`PointStack::covered`].
#[target_feature(enable = "avx2")]
pub fn covered(stack: &PointStack, from: usize, fragment: &LocalFragment) -> u16 {
    let corners = [corners(fragment, 0), corners(fragment, LANES)];
    let mut cover = Cover::default();
    (from..stack.len).for_each(|index| add(&mut cover, &corners, stack.point(index)));
    cover.sixteenths()
}

/// [`PointStack::take_covered`].
#[target_feature(enable = "avx2,bmi1")]
pub fn take_covered(stack: &PointStack, from: usize, fragment: &LocalFragment, open: &mut [u16; 16]) {
    let [x, y, z] = &stack.axes;
    for (index, open) in open.iter_mut().enumerate().filter(|(_, open)| **open != 0) {
        let part = fragment.sixteenth(index);
        let (centre, reach2) = part.reach();
        let corners = [corners(&part, 0), corners(&part, LANES)];
        let mut cover = Cover::default();
        for start in (from..stack.len).step_by(LANES) {
            let squares = square(offsets([&x[start..], &y[start..], &z[start..]], centre));
            let reaching = _mm256_cmp_ps::<_CMP_LE_OQ>(squares, _mm256_set1_ps(reach2));
            let there = (1u32 << (stack.len - start).min(LANES)) - 1;
            let mut reaching = _mm256_movemask_ps(reaching) as u32 & there;
            while reaching != 0 {
                add(&mut cover, &corners, stack.point(start + reaching.trailing_zeros() as usize));
                reaching &= reaching - 1;
            }
        }
        *open &= !cover.sixteenths();
    }
}

/// [`stack::close`](crate::psp::stack::close).
#[target_feature(enable = "avx2")]
pub fn close([x, y, z]: &PointLanes, point: [f32; 3]) -> u8 {
    let limit = _mm256_set1_ps(1.0 + SLACK);
    _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(square(offsets([x, y, z], point)), limit)) as u8
}
