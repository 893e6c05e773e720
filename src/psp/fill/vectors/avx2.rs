//! The tests of `page.rs` in AVX2: sixteen lanes in two halves.

use std::arch::x86_64::*;

use crate::psp::fill::page::{Group, LANES, Page, Part};
use crate::psp::fill::space::Place;
use crate::psp::sixteenths::{CORNERS, Cover};

/// The lanes of a vector.
const HALF: usize = 8;

/// Eight lanes, the lower or the upper ones.
#[inline]
#[target_feature(enable = "avx2")]
fn load(lanes: &[f32; LANES], half: usize) -> __m256 {
    let lanes = &lanes[half * HALF..][..HALF];
    // SAFETY: eight floats are read, from a slice of eight; no alignment is asked for.
    unsafe { _mm256_loadu_ps(lanes.as_ptr()) }
}

/// Eight places as seen from one.
#[inline]
#[target_feature(enable = "avx2")]
fn offsets([x, y, z]: [__m256; 3], from: Place) -> [__m256; 3] {
    [
        _mm256_sub_ps(x, _mm256_set1_ps(from[0])),
        _mm256_sub_ps(y, _mm256_set1_ps(from[1])),
        _mm256_sub_ps(z, _mm256_set1_ps(from[2])),
    ]
}

/// The squared lengths of eight vectors.
#[inline]
#[target_feature(enable = "avx2")]
fn squares([x, y, z]: [__m256; 3]) -> __m256 {
    _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(x, x), _mm256_mul_ps(y, y)), _mm256_mul_ps(z, z))
}

#[inline]
#[target_feature(enable = "avx2")]
fn samples(page: &Page, half: usize) -> [__m256; 3] {
    [load(&page.0[0], half), load(&page.0[1], half), load(&page.0[2], half)]
}

/// Which of sixteen squares are no larger than the limit.
#[inline]
#[target_feature(enable = "avx2")]
fn up_to(halves: [__m256; 2], limit: f32) -> u16 {
    let limit = _mm256_set1_ps(limit);
    let [low, high] = halves.map(|squares| _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(squares, limit)) as u16);
    low | high << HALF
}

/// [`Page::near`].
#[target_feature(enable = "avx2")]
pub fn near(page: &Page, place: Place, limit: f32) -> u16 {
    up_to([0, 1].map(|half| squares(offsets(samples(page, half), place))), limit)
}

/// [`Page::covering`].
#[target_feature(enable = "avx2")]
pub fn covering(page: &Page, corners: &[Place; 3], limit: f32) -> u16 {
    nearer(page, corners, _mm256_set1_ps(limit))
}

/// Which samples are nearer to all three corners.
#[inline]
#[target_feature(enable = "avx2")]
fn nearer(page: &Page, [a, b, c]: &[Place; 3], limit: __m256) -> u16 {
    let [low, high] = [0, 1].map(|half| {
        let samples = samples(page, half);
        // The farthest corner decides.
        let farthest = _mm256_max_ps(squares(offsets(samples, *a)), squares(offsets(samples, *b)));
        let farthest = _mm256_max_ps(farthest, squares(offsets(samples, *c)));
        _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(farthest, limit)) as u16
    });
    low | high << HALF
}

/// [`Group::covered`].
#[target_feature(enable = "avx2")]
pub fn covered_triangles(group: &Group, pages: &[Page], limit: f32) -> u64 {
    let (limit, mut covered) = (_mm256_set1_ps(limit), 0);
    for (lane, &page) in group.pages.iter().enumerate() {
        let nearer = nearer(&pages[page as usize], &group.triangles[lane], limit);
        covered |= u64::from(nearer != 0) << lane;
    }
    covered
}

/// [`Page::covered`].
#[target_feature(enable = "avx2,bmi1")]
pub fn covered_sixteenths(page: &Page, part: &Part, limit: f32) -> u16 {
    let samples = [0, 1].map(|half| offsets(samples(page, half), part.origin));
    let mut reaching = up_to(samples.map(|samples| squares(offsets(samples, part.centre))), part.reach2);
    if reaching == 0 {
        return 0;
    }
    let mut places = [[0.0; LANES]; 3];
    for (half, samples) in samples.into_iter().enumerate() {
        for (places, samples) in places.iter_mut().zip(samples) {
            let places = &mut places[half * HALF..][..HALF];
            // SAFETY: eight floats are written, to a slice of eight; no alignment is asked for.
            unsafe { _mm256_storeu_ps(places.as_mut_ptr(), samples) };
        }
    }
    let corners = [0, 1].map(|half| {
        let (s, t) = (load(&CORNERS[0], half), load(&CORNERS[1], half));
        [0, 1, 2].map(|axis| {
            let e = _mm256_mul_ps(s, _mm256_set1_ps(part.edges[0][axis]));
            let f = _mm256_mul_ps(t, _mm256_set1_ps(part.edges[1][axis]));
            _mm256_add_ps(_mm256_set1_ps(part.corner[axis]), _mm256_add_ps(e, f))
        })
    });
    let (limit, mut cover) = (_mm256_set1_ps(limit), Cover::default());
    while reaching != 0 {
        let lane = reaching.trailing_zeros() as usize;
        let sample = [places[0][lane], places[1][lane], places[2][lane]];
        let [low, high] = corners.map(|corners| {
            _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(squares(offsets(corners, sample)), limit)) as u16
        });
        cover.add(low | high << HALF);
        reaching &= reaching - 1;
    }
    cover.sixteenths()
}
