//! The tests of `page.rs` in AVX-512.

use std::arch::x86_64::*;

use crate::psp::fill::page::{Group, LANES, Page, Part};
use crate::psp::fill::space::Place;
use crate::psp::sixteenths::{CORNERS, Cover};

#[inline]
#[target_feature(enable = "avx512f")]
fn load(lanes: &[f32; LANES]) -> __m512 {
    // SAFETY: sixteen floats are read, from an array of sixteen; no alignment is asked for.
    unsafe { _mm512_loadu_ps(lanes.as_ptr()) }
}

/// Sixteen places as seen from one.
#[inline]
#[target_feature(enable = "avx512f")]
fn offsets([x, y, z]: [__m512; 3], from: Place) -> [__m512; 3] {
    [
        _mm512_sub_ps(x, _mm512_set1_ps(from[0])),
        _mm512_sub_ps(y, _mm512_set1_ps(from[1])),
        _mm512_sub_ps(z, _mm512_set1_ps(from[2])),
    ]
}

/// The squared lengths of sixteen vectors.
#[inline]
#[target_feature(enable = "avx512f")]
fn squares([x, y, z]: [__m512; 3]) -> __m512 {
    _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(x, x), _mm512_mul_ps(y, y)), _mm512_mul_ps(z, z))
}

#[inline]
#[target_feature(enable = "avx512f")]
fn samples(page: &Page) -> [__m512; 3] {
    [load(&page.0[0]), load(&page.0[1]), load(&page.0[2])]
}

/// [`Page::near`].
#[target_feature(enable = "avx512f")]
pub fn near(page: &Page, place: Place, limit: f32) -> u16 {
    _mm512_cmp_ps_mask::<_CMP_LE_OQ>(squares(offsets(samples(page), place)), _mm512_set1_ps(limit))
}

/// [`Group::covered`].
#[target_feature(enable = "avx512f")]
pub fn covered(group: &Group, pages: &[Page], limit: f32) -> u64 {
    let limit = _mm512_set1_ps(limit);
    let mut covered = 0;
    for (lane, &page) in group.pages.iter().enumerate() {
        let (samples, [a, b, c]) = (samples(&pages[page as usize]), group.triangle(lane));
        let mut covering = _mm512_cmp_ps_mask::<_CMP_LT_OQ>(squares(offsets(samples, a)), limit);
        covering = _mm512_mask_cmp_ps_mask::<_CMP_LT_OQ>(covering, squares(offsets(samples, b)), limit);
        covering = _mm512_mask_cmp_ps_mask::<_CMP_LT_OQ>(covering, squares(offsets(samples, c)), limit);
        covered |= u64::from(covering != 0) << lane;
    }
    covered
}

/// [`Page::cover`].
#[target_feature(enable = "avx512f,bmi1")]
pub fn cover(page: &Page, part: &Part, limit: f32, cover: &mut Cover) {
    let samples = offsets(samples(page), part.origin);
    let distances = squares(offsets(samples, part.centre));
    let mut reaching = _mm512_cmp_ps_mask::<_CMP_LE_OQ>(distances, _mm512_set1_ps(part.reach2));
    if reaching == 0 {
        return;
    }
    let mut places = [[0.0; LANES]; 3];
    for (places, samples) in places.iter_mut().zip(samples) {
        // SAFETY: sixteen floats are written, to an array of sixteen; no alignment is asked for.
        unsafe { _mm512_storeu_ps(places.as_mut_ptr(), samples) };
    }
    let (s, t) = (load(&CORNERS[0]), load(&CORNERS[1]));
    let along = |axis: usize| {
        let e = _mm512_mul_ps(s, _mm512_set1_ps(part.edges[0][axis]));
        let f = _mm512_mul_ps(t, _mm512_set1_ps(part.edges[1][axis]));
        _mm512_add_ps(_mm512_set1_ps(part.corner[axis]), _mm512_add_ps(e, f))
    };
    let (corners, limit) = ([along(0), along(1), along(2)], _mm512_set1_ps(limit));
    while reaching != 0 {
        let lane = reaching.trailing_zeros() as usize;
        let sample = [places[0][lane], places[1][lane], places[2][lane]];
        cover.add(_mm512_cmp_ps_mask::<_CMP_LT_OQ>(squares(offsets(corners, sample)), limit));
        reaching &= reaching - 1;
    }
}
