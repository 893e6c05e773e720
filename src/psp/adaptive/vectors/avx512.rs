//! The tests of `page.rs` in AVX-512.

use std::arch::x86_64::*;

use crate::psp::adaptive::page::{BEYOND, Ball, Group, LANES, Page, Part, WITHIN};
use crate::psp::sixteenths::{CORNERS, Cover};

/// Sixteen balls, one axis after the other.
type Balls = [__m512; 4];

#[inline]
#[target_feature(enable = "avx512f")]
fn load(lanes: &[f32; LANES]) -> __m512 {
    // SAFETY: sixteen floats are read, from an array of sixteen; no alignment is asked for.
    unsafe { _mm512_loadu_ps(lanes.as_ptr()) }
}

#[inline]
#[target_feature(enable = "avx512f")]
fn samples(page: &Page) -> Balls {
    [load(&page.0[0]), load(&page.0[1]), load(&page.0[2]), load(&page.0[3])]
}

/// The squared distances of sixteen balls from one, and a share of the squares of the sums of their radii.
#[inline]
#[target_feature(enable = "avx512f")]
fn squares(balls: Balls, ball: Ball, share: f32) -> [__m512; 2] {
    let x = _mm512_sub_ps(balls[0], _mm512_set1_ps(ball[0]));
    let y = _mm512_sub_ps(balls[1], _mm512_set1_ps(ball[1]));
    let z = _mm512_sub_ps(balls[2], _mm512_set1_ps(ball[2]));
    let squares = _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(x, x), _mm512_mul_ps(y, y)), _mm512_mul_ps(z, z));
    let sums = _mm512_add_ps(balls[3], _mm512_set1_ps(ball[3]));
    [squares, _mm512_mul_ps(_mm512_mul_ps(sums, sums), _mm512_set1_ps(share))]
}

/// Which of sixteen balls may overlap one.
#[inline]
#[target_feature(enable = "avx512f")]
fn near_balls(balls: Balls, ball: Ball) -> u16 {
    let [squares, limits] = squares(balls, ball, BEYOND);
    _mm512_cmp_ps_mask::<_CMP_LE_OQ>(squares, limits)
}

/// Which of sixteen balls, `among` these, certainly overlap one.
#[inline]
#[target_feature(enable = "avx512f")]
fn overlapping(balls: Balls, ball: Ball, among: u16) -> u16 {
    let [squares, limits] = squares(balls, ball, WITHIN);
    _mm512_mask_cmp_ps_mask::<_CMP_LT_OQ>(among, squares, limits)
}

/// [`Page::near`].
#[target_feature(enable = "avx512f")]
pub fn near(page: &Page, ball: Ball) -> u16 {
    near_balls(samples(page), ball)
}

/// [`Page::covering`].
#[target_feature(enable = "avx512f")]
pub fn covering(page: &Page, [a, b, c]: &[Ball; 3]) -> u16 {
    let samples = samples(page);
    let covering = overlapping(samples, *a, u16::MAX);
    let covering = overlapping(samples, *b, covering);
    overlapping(samples, *c, covering)
}

/// [`Group::covered`].
#[target_feature(enable = "avx512f")]
pub fn covered_triangles(group: &Group, pages: &[Page]) -> u64 {
    let mut covered = 0;
    for (lane, &page) in group.pages.iter().enumerate() {
        covered |= u64::from(covering(&pages[page as usize], &group.triangles[lane]) != 0) << lane;
    }
    covered
}

/// [`Page::covered`].
#[target_feature(enable = "avx512f,bmi1")]
pub fn covered_sixteenths(page: &Page, part: &Part, among: u16) -> u16 {
    let [x, y, z, radii] = samples(page);
    let from = part.origin.map(|x| _mm512_set1_ps(x));
    let seen = [_mm512_sub_ps(x, from[0]), _mm512_sub_ps(y, from[1]), _mm512_sub_ps(z, from[2]), radii];
    let mut reaching = near_balls(seen, part.whole) & among;
    if reaching == 0 {
        return 0;
    }
    let mut balls = [[0.0; LANES]; 4];
    for (balls, seen) in balls.iter_mut().zip(seen) {
        // SAFETY: sixteen floats are written, to an array of sixteen; no alignment is asked for.
        unsafe { _mm512_storeu_ps(balls.as_mut_ptr(), seen) };
    }
    let (s, t) = (load(&CORNERS[0]), load(&CORNERS[1]));
    let along = |axis: usize| {
        let e = _mm512_mul_ps(s, _mm512_set1_ps(part.edges[0][axis]));
        let f = _mm512_mul_ps(t, _mm512_set1_ps(part.edges[1][axis]));
        _mm512_add_ps(_mm512_set1_ps(part.corner[axis]), _mm512_add_ps(e, f))
    };
    let corners = [along(0), along(1), along(2), along(3)];
    let mut cover = Cover::default();
    while reaching != 0 {
        let lane = reaching.trailing_zeros() as usize;
        let sample = [balls[0][lane], balls[1][lane], balls[2][lane], balls[3][lane]];
        cover.add(overlapping(corners, sample, u16::MAX));
        reaching &= reaching - 1;
    }
    cover.sixteenths()
}
