//! The tests of `page.rs` in AVX-512.

use std::arch::x86_64::*;

use crate::psp::fill::page::{Group, LANES, Page, Part};
use crate::psp::fill::space::Place;
use crate::psp::sixteenths::{CORNERS, CORNERS_OF_SIXTEENTHS};

#[inline]
#[target_feature(enable = "avx512f")]
fn load(lanes: &[f32; LANES]) -> __m512 {
    // SAFETY: sixteen floats are read, from an array of sixteen; no alignment is asked for.
    unsafe { _mm512_loadu_ps(lanes.as_ptr()) }
}

#[inline]
#[target_feature(enable = "avx512f")]
fn numbers(numbers: &[i32; LANES]) -> __m512i {
    // SAFETY: sixteen integers are read, from an array of sixteen; no alignment is asked for.
    unsafe { _mm512_loadu_si512(numbers.as_ptr().cast()) }
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

/// [`Page::covering`].
#[target_feature(enable = "avx512f")]
pub fn covering(page: &Page, corners: &[Place; 3], limit: f32) -> u16 {
    nearer(samples(page), corners, _mm512_set1_ps(limit))
}

/// Which samples are nearer to all three corners.
#[inline]
#[target_feature(enable = "avx512f")]
fn nearer(samples: [__m512; 3], [a, b, c]: &[Place; 3], limit: __m512) -> u16 {
    let covering = _mm512_cmp_ps_mask::<_CMP_LT_OQ>(squares(offsets(samples, *a)), limit);
    let covering = _mm512_mask_cmp_ps_mask::<_CMP_LT_OQ>(covering, squares(offsets(samples, *b)), limit);
    _mm512_mask_cmp_ps_mask::<_CMP_LT_OQ>(covering, squares(offsets(samples, *c)), limit)
}

/// [`Group::covered`].
#[target_feature(enable = "avx512f")]
pub fn covered_triangles(group: &Group, pages: &[Page], limit: f32) -> u64 {
    let (limit, mut covered) = (_mm512_set1_ps(limit), 0);
    for (lane, &page) in group.pages.iter().enumerate() {
        let nearer = nearer(samples(&pages[page as usize]), &group.triangles[lane], limit);
        covered |= u64::from(nearer != 0) << lane;
    }
    covered
}

/// [`Page::covered`].
#[target_feature(enable = "avx512f,bmi1")]
pub fn covered_sixteenths(page: &Page, part: &Part, limit: f32) -> u16 {
    let samples = offsets(samples(page), part.origin);
    let distances = squares(offsets(samples, part.centre));
    let mut reaching = _mm512_cmp_ps_mask::<_CMP_LE_OQ>(distances, _mm512_set1_ps(part.reach2));
    if reaching == 0 {
        return 0;
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
    let corners = [along(0), along(1), along(2)];
    let [first, second, third] = [0, 1, 2].map(|corner| numbers(&CORNERS_OF_SIXTEENTHS[corner]));
    // For each sixteenth, the squared distance of its farthest corner from a sample, least of all.
    let mut least = _mm512_set1_ps(f32::INFINITY);
    while reaching != 0 {
        let lane = reaching.trailing_zeros() as usize;
        let sample = [places[0][lane], places[1][lane], places[2][lane]];
        let squares = squares(offsets(corners, sample));
        let two = _mm512_max_ps(_mm512_permutexvar_ps(first, squares), _mm512_permutexvar_ps(second, squares));
        least = _mm512_min_ps(least, _mm512_max_ps(two, _mm512_permutexvar_ps(third, squares)));
        reaching &= reaching - 1;
    }
    _mm512_cmp_ps_mask::<_CMP_LT_OQ>(least, _mm512_set1_ps(limit))
}
