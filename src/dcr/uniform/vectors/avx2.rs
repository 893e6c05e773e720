//! [`VerletCells::force`] in AVX2.

use std::arch::x86_64::*;
use std::ops::Range;

use glam::Vec2;

use crate::dcr::law::Constraints;
use crate::dcr::torus::TorusPoint;
use crate::dcr::uniform::cells::{LANES, LEAST, VerletCells};

/// Eight coordinates.
#[inline]
#[target_feature(enable = "avx2")]
fn load(coordinates: &[u32; LANES]) -> __m256i {
    // SAFETY: eight integers are read, from an array of eight; no alignment is required.
    unsafe { _mm256_loadu_si256(coordinates.as_ptr().cast()) }
}

/// [`VerletCells::force`].
#[inline]
#[target_feature(enable = "avx2")]
pub fn force(cells: &VerletCells, here: TorusPoint, constraints: &Constraints, around: [Range<usize>; 2]) -> Vec2 {
    let unit = cells.unit().to_array().map(|unit| _mm256_set1_ps(unit));
    let here = here.map(|coordinate| _mm256_set1_epi32(coordinate.cast_signed()));
    let still = _mm256_set1_ps(constraints.conflict_radius.recip());
    let lanes = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    let mut sum = [_mm256_setzero_ps(); 2];
    for run in around {
        for first in run.clone().step_by(LANES) {
            let places = cells.lanes(first);
            let x = _mm256_mul_ps(_mm256_cvtepi32_ps(_mm256_sub_epi32(load(places[0]), here[0])), unit[0]);
            let y = _mm256_mul_ps(_mm256_cvtepi32_ps(_mm256_sub_epi32(load(places[1]), here[1])), unit[1]);
            let squared = _mm256_add_ps(_mm256_mul_ps(x, x), _mm256_mul_ps(y, y));
            let distance = _mm256_sqrt_ps(_mm256_max_ps(squared, _mm256_set1_ps(LEAST)));
            let tension = _mm256_sub_ps(still, _mm256_div_ps(_mm256_set1_ps(1.0), distance));
            let pushed = _mm256_mul_ps(_mm256_set1_ps(constraints.push), _mm256_min_ps(tension, _mm256_setzero_ps()));
            let is_meant = _mm256_cmpgt_epi32(_mm256_set1_epi32((run.end - first) as i32), lanes);
            let pushed = _mm256_and_ps(pushed, _mm256_castsi256_ps(is_meant));
            sum[0] = _mm256_add_ps(sum[0], _mm256_mul_ps(pushed, x));
            sum[1] = _mm256_add_ps(sum[1], _mm256_mul_ps(pushed, y));
        }
    }
    let [x, y] = sum.map(|lanes| _mm_add_ps(_mm256_castps256_ps128(lanes), _mm256_extractf128_ps(lanes, 1)));
    let pairs = _mm_add_ps(_mm_unpacklo_ps(x, y), _mm_unpackhi_ps(x, y));
    let both = _mm_add_ps(pairs, _mm_movehl_ps(pairs, pairs));
    Vec2::new(_mm_cvtss_f32(both), _mm_cvtss_f32(_mm_shuffle_ps(both, both, 1)))
}
