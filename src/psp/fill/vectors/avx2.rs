//! The tests of `grid.rs` and `page.rs` in AVX2: sixteen lanes in two halves.

use std::arch::x86_64::*;

use crate::mesh::Mesh;
use crate::psp::fill::grid::{Cell, Grid};
use crate::psp::fill::measures::{Sizes, Triangles};
use crate::psp::fill::page::{Group, LANES, Page, REACH_SLACK, THIRD};
use crate::psp::fill::space::{MASK, Place, ROUNDER};
use crate::psp::sixteenths::{CORNERS, Cover, PIERCING, PIERCING_BY_EDGE};

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

/// [`Triangles::measure`].
#[target_feature(enable = "avx2")]
pub fn measure(triangles: Triangles, mesh: &Mesh, group: usize) -> Sizes {
    triangles.measure_portable(mesh, group)
}

/// One place in every lane.
type Broad = [__m256d; 3];

#[inline]
#[target_feature(enable = "avx2")]
fn broad(x: f64, y: f64, z: f64) -> Broad {
    [_mm256_set1_pd(x), _mm256_set1_pd(y), _mm256_set1_pd(z)]
}

#[inline]
#[target_feature(enable = "avx2")]
fn minus(a: Broad, b: Broad) -> Broad {
    [_mm256_sub_pd(a[0], b[0]), _mm256_sub_pd(a[1], b[1]), _mm256_sub_pd(a[2], b[2])]
}

/// Doubles, the same in all lanes, as floats.
#[inline]
#[target_feature(enable = "avx2")]
fn narrow(a: Broad) -> [__m256; 3] {
    [0, 1, 2].map(|axis| _mm256_broadcastss_ps(_mm256_cvtpd_ps(a[axis])))
}

#[inline]
#[target_feature(enable = "avx2")]
fn minus_floats(a: [__m256; 3], b: [__m256; 3]) -> [__m256; 3] {
    [_mm256_sub_ps(a[0], b[0]), _mm256_sub_ps(a[1], b[1]), _mm256_sub_ps(a[2], b[2])]
}

/// The numbers of the cells of a fragment's piercing corners, given one of its corners and the edges from there.
#[inline]
#[target_feature(enable = "avx2")]
fn cells(grid: &Grid, a: Broad, e: Broad, f: Broad) -> [__m256i; 2] {
    let (space, (first, shifts)) = (&grid.space, grid.cells.numbering());
    let place = |axis: usize, half: usize| {
        let half = half * HALF / 2;
        // SAFETY: four doubles are read, from slices of four; no alignment is asked for.
        let [s, t] = [0, 1].map(|edge| unsafe { _mm256_loadu_pd(PIERCING_BY_EDGE[edge][half..][..4].as_ptr()) });
        let offset = _mm256_add_pd(_mm256_mul_pd(s, e[axis]), _mm256_mul_pd(t, f[axis]));
        _mm256_cvtpd_ps(_mm256_add_pd(a[axis], offset))
    };
    let along = |axis: usize| {
        let place = _mm256_set_m128(place(axis, 1), place(axis, 0));
        let place = _mm256_sub_ps(place, _mm256_set1_ps(space.origin[axis]));
        let rounded = _mm256_add_ps(_mm256_mul_ps(place, _mm256_set1_ps(space.per_cell)), _mm256_set1_ps(ROUNDER));
        let cell = _mm256_and_si256(_mm256_castps_si256(rounded), _mm256_set1_epi32(MASK as i32));
        _mm256_sub_epi32(cell, _mm256_set1_epi32(first[axis] as i32))
    };
    let [x, y, z] = [along(0), along(1), along(2)];
    let [row, layer] = [0, 1].map(|axis| _mm_cvtsi32_si128(shifts[axis] as i32));
    let number = |x: __m128i, y: __m128i, z: __m128i| {
        let y = _mm256_sll_epi64(_mm256_cvtepu32_epi64(y), row);
        let z = _mm256_sll_epi64(_mm256_cvtepu32_epi64(z), layer);
        _mm256_or_si256(_mm256_cvtepu32_epi64(x), _mm256_or_si256(y, z))
    };
    let low = number(_mm256_castsi256_si128(x), _mm256_castsi256_si128(y), _mm256_castsi256_si128(z));
    let high = |a: __m256i| _mm256_extracti128_si256::<1>(a);
    [low, number(high(x), high(y), high(z))]
}

/// [`Grid::open_sixteenths_portable`].
#[target_feature(enable = "avx2,bmi1")]
#[expect(clippy::too_many_arguments, reason = "the coordinates come in registers")]
pub fn open_sixteenths(
    grid: &Grid,
    ax: f64,
    ay: f64,
    az: f64,
    bx: f64,
    by: f64,
    bz: f64,
    cx: f64,
    cy: f64,
    cz: f64,
    reach: f32,
    normal: &[f32; 3],
    open: u16,
) -> u16 {
    let [a, b, c] = [broad(ax, ay, az), broad(bx, by, bz), broad(cx, cy, cz)];
    let (e, f) = (minus(b, a), minus(c, a));
    let cells = cells(grid, a, e, f);
    let mut numbers = [0_u64; HALF];
    for (half, cells) in cells.into_iter().enumerate() {
        let numbers = &mut numbers[half * HALF / 2..][..HALF / 2];
        // SAFETY: four integers are written, to a slice of four; no alignment is asked for.
        unsafe { _mm256_storeu_si256(numbers.as_mut_ptr().cast(), cells) };
    }
    let origin = narrow(a);
    let corner = minus(a, [0, 1, 2].map(|axis| _mm256_cvtps_pd(_mm256_castps256_ps128(origin[axis]))));
    let third = |axis: usize| _mm256_mul_pd(_mm256_add_pd(e[axis], f[axis]), _mm256_set1_pd(THIRD));
    let centre = narrow([0, 1, 2].map(|axis| _mm256_add_pd(corner[axis], third(axis))));
    let (corner, e, f) = (narrow(corner), narrow(e), narrow(f));
    let corners = [0, 1].map(|half| {
        let (s, t) = (load(&CORNERS[0], half), load(&CORNERS[1], half));
        [0, 1, 2].map(|axis| {
            let offset = _mm256_add_ps(_mm256_mul_ps(s, e[axis]), _mm256_mul_ps(t, f[axis]));
            _mm256_add_ps(corner[axis], offset)
        })
    });
    let (limit, reach2) = (_mm256_set1_ps(grid.space.surely_within), reach * reach * REACH_SLACK);
    let mut cover = Cover::default();
    let mut unseen = (1 << PIERCING.len()) - 1;
    while unseen != 0 {
        let number = numbers[i32::trailing_zeros(unseen) as usize];
        let same = |half: usize| {
            let same = _mm256_cmpeq_epi64(cells[half], _mm256_set1_epi64x(number as i64));
            _mm256_movemask_pd(_mm256_castsi256_pd(same)) << (half * HALF / 2)
        };
        unseen &= !(same(0) | same(1));
        let Cell { mut page, count } = grid.cells.get(number);
        for _ in 0..count.div_ceil(LANES as u32) {
            let samples = [0, 1].map(|half| minus_floats(samples(&grid.pages[page as usize], half), origin));
            let distances = samples.map(|samples| squares(minus_floats(samples, centre)));
            let mut reaching = up_to(distances, reach2) & grid.seen(page as usize, normal);
            page = grid.earlier[page as usize];
            if reaching == 0 {
                continue;
            }
            let mut places = [[0.0; LANES]; 3];
            for (half, samples) in samples.into_iter().enumerate() {
                for (places, samples) in places.iter_mut().zip(samples) {
                    let places = &mut places[half * HALF..][..HALF];
                    // SAFETY: eight floats are written, to a slice of eight; no alignment is asked for.
                    unsafe { _mm256_storeu_ps(places.as_mut_ptr(), samples) };
                }
            }
            while reaching != 0 {
                let lane = reaching.trailing_zeros() as usize;
                let sample = [places[0][lane], places[1][lane], places[2][lane]];
                let [low, high] = corners.map(|corners| {
                    _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(squares(offsets(corners, sample)), limit)) as u16
                });
                cover.add(low | high << HALF);
                reaching &= reaching - 1;
            }
            if open & !cover.sixteenths() == 0 {
                return 0;
            }
        }
    }
    open & !cover.sixteenths()
}
