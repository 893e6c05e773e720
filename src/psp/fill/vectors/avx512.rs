//! The tests of `grid.rs` and `page.rs` in AVX-512.

use std::arch::x86_64::*;

use crate::mesh::Mesh;
use crate::psp::fill::grid::{Cell, Grid};
use crate::psp::fill::measures::{Sizes, Triangles};
use crate::psp::fill::page::{Group, LANES, Page, REACH_SLACK, THIRD};
use crate::psp::fill::space::{MASK, Place, ROUNDER};
use crate::psp::sixteenths::{CORNERS, CORNERS_OF_SIXTEENTHS, PIERCING, PIERCING_BY_EDGE};

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

/// [`Triangles::measure`].
#[target_feature(enable = "avx512f")]
pub fn measure(triangles: Triangles, mesh: &Mesh, group: usize) -> Sizes {
    triangles.measure_portable(mesh, group)
}

/// The distances along the axes of one place, in every lane, from another.
type Broad = [__m512d; 3];

#[inline]
#[target_feature(enable = "avx512f")]
fn broad(x: f64, y: f64, z: f64) -> Broad {
    [_mm512_set1_pd(x), _mm512_set1_pd(y), _mm512_set1_pd(z)]
}

#[inline]
#[target_feature(enable = "avx512f")]
fn minus(a: Broad, b: Broad) -> Broad {
    [_mm512_sub_pd(a[0], b[0]), _mm512_sub_pd(a[1], b[1]), _mm512_sub_pd(a[2], b[2])]
}

/// Doubles, the same in all lanes, as floats.
#[inline]
#[target_feature(enable = "avx512f")]
fn narrow(a: Broad) -> [__m512; 3] {
    let along = |axis: usize| _mm512_broadcastss_ps(_mm256_castps256_ps128(_mm512_cvtpd_ps(a[axis])));
    [along(0), along(1), along(2)]
}

#[inline]
#[target_feature(enable = "avx512f")]
fn minus_floats(a: [__m512; 3], b: [__m512; 3]) -> [__m512; 3] {
    [_mm512_sub_ps(a[0], b[0]), _mm512_sub_ps(a[1], b[1]), _mm512_sub_ps(a[2], b[2])]
}

/// The numbers of the cells of a fragment's piercing corners, given one of its corners and the edges from there.
#[inline]
#[target_feature(enable = "avx512f,avx512vl")]
fn cells(grid: &Grid, a: Broad, e: Broad, f: Broad) -> __m512i {
    let (space, (first, shifts)) = (&grid.space, grid.cells.numbering());
    // SAFETY: eight doubles are read, from arrays of eight; no alignment is asked for.
    let [s, t] = [0, 1].map(|edge| unsafe { _mm512_loadu_pd(PIERCING_BY_EDGE[edge].as_ptr()) });
    let along = |axis: usize| {
        let offset = _mm512_add_pd(_mm512_mul_pd(s, e[axis]), _mm512_mul_pd(t, f[axis]));
        let place = _mm512_cvtpd_ps(_mm512_add_pd(a[axis], offset));
        let place = _mm256_sub_ps(place, _mm256_set1_ps(space.origin[axis]));
        let rounded = _mm256_add_ps(_mm256_mul_ps(place, _mm256_set1_ps(space.per_cell)), _mm256_set1_ps(ROUNDER));
        let cell = _mm256_and_si256(_mm256_castps_si256(rounded), _mm256_set1_epi32(MASK as i32));
        _mm512_cvtepu32_epi64(_mm256_sub_epi32(cell, _mm256_set1_epi32(first[axis] as i32)))
    };
    let [row, layer] = [0, 1].map(|axis| _mm_cvtsi32_si128(shifts[axis] as i32));
    let (y, z) = (_mm512_sll_epi64(along(1), row), _mm512_sll_epi64(along(2), layer));
    _mm512_or_epi64(along(0), _mm512_or_epi64(y, z))
}

/// [`Grid::open_sixteenths_portable`].
#[target_feature(enable = "avx512f,avx512vl,bmi1")]
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
    let mut numbers = [0_u64; 8];
    // SAFETY: eight integers are written, to an array of eight; no alignment is asked for.
    unsafe { _mm512_storeu_si512(numbers.as_mut_ptr().cast(), cells) };
    let origin = narrow(a);
    let exact_origin = [0, 1, 2].map(|axis| _mm512_cvtps_pd(_mm512_castps512_ps256(origin[axis])));
    let corner = minus(a, exact_origin);
    let third = |axis: usize| _mm512_mul_pd(_mm512_add_pd(e[axis], f[axis]), _mm512_set1_pd(THIRD));
    let centre = narrow([0, 1, 2].map(|axis| _mm512_add_pd(corner[axis], third(axis))));
    let (corner, e, f) = (narrow(corner), narrow(e), narrow(f));
    let (s, t) = (load(&CORNERS[0]), load(&CORNERS[1]));
    let along = |axis: usize| {
        let offset = _mm512_add_ps(_mm512_mul_ps(s, e[axis]), _mm512_mul_ps(t, f[axis]));
        _mm512_add_ps(corner[axis], offset)
    };
    let corners = [along(0), along(1), along(2)];
    let reach2 = _mm512_set1_ps(reach * reach * REACH_SLACK);
    let limit = _mm512_set1_ps(grid.space.surely_within);
    let [first, second, third] = [0, 1, 2].map(|corner| numbers_of(corner));
    // For each sixteenth, the squared distance of its farthest corner from a sample, least of all.
    let mut least = _mm512_set1_ps(f32::INFINITY);
    let mut unseen: u8 = (1 << PIERCING.len()) - 1;
    while unseen != 0 {
        let number = numbers[unseen.trailing_zeros() as usize];
        unseen &= !_mm512_cmpeq_epi64_mask(cells, _mm512_set1_epi64(number as i64));
        let Cell { mut page, count } = grid.cells.get(number);
        for _ in 0..count.div_ceil(LANES as u32) {
            let samples = minus_floats(samples(&grid.pages[page as usize]), origin);
            let distances = squares(minus_floats(samples, centre));
            let mut reaching = _mm512_cmp_ps_mask::<_CMP_LE_OQ>(distances, reach2) & grid.seen(page as usize, normal);
            page = grid.earlier[page as usize];
            if reaching == 0 {
                continue;
            }
            let mut places = [[0.0; LANES]; 3];
            for (places, samples) in places.iter_mut().zip(samples) {
                // SAFETY: sixteen floats are written, to an array of sixteen; no alignment is asked for.
                unsafe { _mm512_storeu_ps(places.as_mut_ptr(), samples) };
            }
            while reaching != 0 {
                let lane = reaching.trailing_zeros() as usize;
                let squares = squares(offsets(corners, [places[0][lane], places[1][lane], places[2][lane]]));
                let two = _mm512_max_ps(_mm512_permutexvar_ps(first, squares), _mm512_permutexvar_ps(second, squares));
                least = _mm512_min_ps(least, _mm512_max_ps(two, _mm512_permutexvar_ps(third, squares)));
                reaching &= reaching - 1;
            }
            if open & !_mm512_cmp_ps_mask::<_CMP_LT_OQ>(least, limit) == 0 {
                return 0;
            }
        }
    }
    open & !_mm512_cmp_ps_mask::<_CMP_LT_OQ>(least, limit)
}

/// Which corners of a fragment are the first, second or third ones of its sixteenths.
#[inline]
#[target_feature(enable = "avx512f")]
fn numbers_of(corner: usize) -> __m512i {
    numbers(&CORNERS_OF_SIXTEENTHS[corner])
}
