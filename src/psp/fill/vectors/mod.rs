//! The tests of `grid.rs` and `page.rs` in AVX2 and AVX-512, the same to the bit.
//!
//! The look at a fragment is one function for its cells and their pages: the corners stay in registers. What it takes from
//! memory it loads number by number, as its callers have stored it: a load that spans two fresh stores waits for both.

use glam::DVec3;

use crate::mesh::Mesh;
use crate::psp::fill::grid::Grid;
use crate::psp::fill::measures::{Sizes, Triangles};
use crate::psp::fill::page::{Group, Page};
use crate::psp::fill::space::Place;
use crate::simd::Level;

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;

/// [`Page::near`].
#[inline]
pub(super) fn near(level: Level, page: &Page, place: Place, limit: f32) -> u16 {
    match level {
        Level::Portable => page.near(place, limit),
        // SAFETY: the token is proof that the processor has the instructions.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => unsafe { avx2::near(page, place, limit) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => unsafe { avx512::near(page, place, limit) },
    }
}

/// [`Page::covering`].
#[inline]
pub(super) fn covering(level: Level, page: &Page, corners: &[Place; 3], limit: f32) -> u16 {
    match level {
        Level::Portable => page.covering(corners, limit),
        // SAFETY: the token is proof that the processor has the instructions.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => unsafe { avx2::covering(page, corners, limit) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => unsafe { avx512::covering(page, corners, limit) },
    }
}

/// [`Triangles::measure`]: the same code, for wider registers.
#[inline]
pub(super) fn measure(level: Level, triangles: Triangles, mesh: &Mesh, group: usize) -> Sizes {
    match level {
        Level::Portable => triangles.measure_portable(mesh, group),
        // SAFETY: the token is proof that the processor has the instructions.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => unsafe { avx2::measure(triangles, mesh, group) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => unsafe { avx512::measure(triangles, mesh, group) },
    }
}

/// [`Grid::open_sixteenths`], where samples beyond `reach` cover nothing.
#[inline(always)]
pub(super) fn open_sixteenths(
    level: Level,
    grid: &Grid,
    corners: &[DVec3; 3],
    reach: f32,
    normal: &[f32; 3],
    open: u16,
) -> u16 {
    #[cfg(target_arch = "x86_64")]
    let [a, b, c] = corners;
    match level {
        Level::Portable => grid.open_sixteenths_portable(corners, reach, normal, open),
        // SAFETY: the token is proof that the processor has the instructions.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => unsafe {
            avx2::open_sixteenths(grid, a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, reach, normal, open)
        },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => unsafe {
            avx512::open_sixteenths(grid, a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, reach, normal, open)
        },
    }
}

/// [`Group::covered`].
#[inline]
pub(super) fn covered_triangles(level: Level, group: &Group, pages: &[Page], limit: f32) -> u64 {
    match level {
        Level::Portable => group.covered(pages, limit),
        // SAFETY: the token is proof that the processor has the instructions.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => unsafe { avx2::covered_triangles(group, pages, limit) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => unsafe { avx512::covered_triangles(group, pages, limit) },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    #[test]
    fn all_vectors_give_the_same_bits() {
        let mut rng = Rng::at(3, Draw::Probe, &[]);
        let mut counts = [0; 2];
        for _ in 0..1000 {
            let mut coordinate = |size: f64| (size * (2.0 * rng.unit() - 1.0)) as f32;
            let mut pages = [Page::EMPTY; 4];
            for page in &mut pages[1..] {
                (0..13).for_each(|lane| page.put(lane, std::array::from_fn(|_| coordinate(1.5))));
            }
            let mut group = Group::EMPTY;
            for lane in 0..60 {
                let (at, size) = ([(); 3].map(|()| coordinate(1.0)), [0.5, 0.1, 1e-4][lane % 3]);
                let corners = [(); 3].map(|()| std::array::from_fn(|axis| at[axis] + coordinate(size)));
                group.triangles[lane] = corners;
                group.pages[lane] = lane as u32 % 4;
            }
            let place = [(); 3].map(|()| coordinate(1.0));
            let all = |level: Level| {
                let corners = [0, 1, 2].map(|page| covering(level, &pages[page], &group.triangles[page], 1.0));
                let triangles = covered_triangles(level, &group, &pages, 1.0);
                (near(level, &pages[1], place, 1.0), corners, triangles)
            };
            let expected = all(Level::Portable);
            assert!(Level::available().into_iter().all(|level| all(level) == expected));
            counts[0] += expected.0.count_ones();
            counts[1] += expected.2.count_ones();
        }
        assert!(counts.into_iter().all(|count| count > 1000), "{counts:?}");
    }
}
