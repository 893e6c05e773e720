//! The tests of `page.rs` in AVX2: sixteen lanes in two halves.

use std::arch::x86_64::*;

use crate::psp::adaptive::page::{BEYOND, Ball, Group, LANES, Page, Part, WITHIN};
use crate::psp::sixteenths::{CORNERS, Cover};

/// The lanes of a vector.
const HALF: usize = 8;

/// Eight balls, one axis after the other.
type Balls = [__m256; 4];

/// Eight lanes, the lower or the upper ones.
#[inline]
#[target_feature(enable = "avx2")]
fn load(lanes: &[f32; LANES], half: usize) -> __m256 {
    let lanes = &lanes[half * HALF..][..HALF];
    // SAFETY: eight floats are read, from a slice of eight; no alignment is asked for.
    unsafe { _mm256_loadu_ps(lanes.as_ptr()) }
}

#[inline]
#[target_feature(enable = "avx2")]
fn samples(page: &Page, half: usize) -> Balls {
    [load(&page.0[0], half), load(&page.0[1], half), load(&page.0[2], half), load(&page.0[3], half)]
}

/// The squared distances of eight balls from one, and a share of the squares of the sums of their radii.
#[inline]
#[target_feature(enable = "avx2")]
fn squares(balls: Balls, ball: Ball, share: f32) -> [__m256; 2] {
    let x = _mm256_sub_ps(balls[0], _mm256_set1_ps(ball[0]));
    let y = _mm256_sub_ps(balls[1], _mm256_set1_ps(ball[1]));
    let z = _mm256_sub_ps(balls[2], _mm256_set1_ps(ball[2]));
    let squares = _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(x, x), _mm256_mul_ps(y, y)), _mm256_mul_ps(z, z));
    let sums = _mm256_add_ps(balls[3], _mm256_set1_ps(ball[3]));
    [squares, _mm256_mul_ps(_mm256_mul_ps(sums, sums), _mm256_set1_ps(share))]
}

/// Which of sixteen balls may overlap one.
#[inline]
#[target_feature(enable = "avx2")]
fn near_balls(halves: [Balls; 2], ball: Ball) -> u16 {
    let [low, high] = halves.map(|balls| {
        let [squares, limits] = squares(balls, ball, BEYOND);
        _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(squares, limits)) as u16
    });
    low | high << HALF
}

/// Which of sixteen balls certainly overlap one.
#[inline]
#[target_feature(enable = "avx2")]
fn overlapping(halves: [Balls; 2], ball: Ball) -> u16 {
    let [low, high] = halves.map(|balls| {
        let [squares, limits] = squares(balls, ball, WITHIN);
        _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(squares, limits)) as u16
    });
    low | high << HALF
}

/// [`Page::near`].
#[target_feature(enable = "avx2")]
pub fn near(page: &Page, ball: Ball) -> u16 {
    near_balls([samples(page, 0), samples(page, 1)], ball)
}

/// [`Page::covering`].
#[target_feature(enable = "avx2")]
pub fn covering(page: &Page, [a, b, c]: &[Ball; 3]) -> u16 {
    let samples = [samples(page, 0), samples(page, 1)];
    overlapping(samples, *a) & overlapping(samples, *b) & overlapping(samples, *c)
}

/// [`Group::covered`].
#[target_feature(enable = "avx2")]
pub fn covered_triangles(group: &Group, pages: &[Page]) -> u64 {
    let mut covered = 0;
    for (lane, &page) in group.pages.iter().enumerate() {
        covered |= u64::from(covering(&pages[page as usize], &group.triangles[lane]) != 0) << lane;
    }
    covered
}

/// [`Page::covered`].
#[target_feature(enable = "avx2,bmi1")]
pub fn covered_sixteenths(page: &Page, part: &Part, among: u16) -> u16 {
    let seen = [0, 1].map(|half| {
        let [x, y, z, radii] = samples(page, half);
        let from = part.origin.map(|x| _mm256_set1_ps(x));
        [_mm256_sub_ps(x, from[0]), _mm256_sub_ps(y, from[1]), _mm256_sub_ps(z, from[2]), radii]
    });
    let mut reaching = near_balls(seen, part.whole) & among;
    if reaching == 0 {
        return 0;
    }
    let mut balls = [[0.0; LANES]; 4];
    for (half, seen) in seen.into_iter().enumerate() {
        for (balls, seen) in balls.iter_mut().zip(seen) {
            let balls = &mut balls[half * HALF..][..HALF];
            // SAFETY: eight floats are written, to a slice of eight; no alignment is asked for.
            unsafe { _mm256_storeu_ps(balls.as_mut_ptr(), seen) };
        }
    }
    let corners = [0, 1].map(|half| {
        let (s, t) = (load(&CORNERS[0], half), load(&CORNERS[1], half));
        [0, 1, 2, 3].map(|axis| {
            let e = _mm256_mul_ps(s, _mm256_set1_ps(part.edges[0][axis]));
            let f = _mm256_mul_ps(t, _mm256_set1_ps(part.edges[1][axis]));
            _mm256_add_ps(_mm256_set1_ps(part.corner[axis]), _mm256_add_ps(e, f))
        })
    });
    let mut cover = Cover::default();
    while reaching != 0 {
        let lane = reaching.trailing_zeros() as usize;
        cover.add(overlapping(corners, [balls[0][lane], balls[1][lane], balls[2][lane], balls[3][lane]]));
        reaching &= reaching - 1;
    }
    cover.sixteenths()
}
