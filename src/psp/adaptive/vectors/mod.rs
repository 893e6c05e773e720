//! The tests of `page.rs` in AVX2 and AVX-512, the same to the bit.

use crate::psp::adaptive::page::{Ball, Group, Page, Part};
use crate::simd::Level;

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;

/// [`Page::near`].
#[inline]
pub(super) fn near(level: Level, page: &Page, ball: Ball) -> u16 {
    match level {
        Level::Portable => page.near(ball),
        // SAFETY: the token is proof that the processor has the instructions.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => unsafe { avx2::near(page, ball) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => unsafe { avx512::near(page, ball) },
    }
}

/// [`Page::covering`].
#[inline]
pub(super) fn covering(level: Level, page: &Page, corners: &[Ball; 3]) -> u16 {
    match level {
        Level::Portable => page.covering(corners),
        // SAFETY: the token is proof that the processor has the instructions.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => unsafe { avx2::covering(page, corners) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => unsafe { avx512::covering(page, corners) },
    }
}

/// [`Page::covered`].
#[inline]
pub(super) fn covered_sixteenths(level: Level, page: &Page, part: &Part, among: u16) -> u16 {
    match level {
        Level::Portable => page.covered(part, among),
        // SAFETY: the token is proof that the processor has the instructions.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => unsafe { avx2::covered_sixteenths(page, part, among) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => unsafe { avx512::covered_sixteenths(page, part, among) },
    }
}

/// [`Group::covered`].
#[inline]
pub(super) fn covered_triangles(level: Level, group: &Group, pages: &[Page]) -> u64 {
    match level {
        Level::Portable => group.covered(pages),
        // SAFETY: the token is proof that the processor has the instructions.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => unsafe { avx2::covered_triangles(group, pages) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => unsafe { avx512::covered_triangles(group, pages) },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    #[test]
    fn all_vectors_give_the_same_bits() {
        let mut rng = Rng::at(3, Draw::Probe, &[]);
        let mut counts = [0; 3];
        for round in 0..1000 {
            let mut coordinate = |size: f64| (size * (2.0 * rng.unit() - 1.0)) as f32;
            let mut pages = [Page::EMPTY; 4];
            for page in &mut pages[1..] {
                for lane in 0..13 {
                    let [x, y, z] = [(); 3].map(|()| coordinate(1.5));
                    page.put(lane, [x, y, z, 0.5 + coordinate(0.4)]);
                }
            }
            let mut group = Group::EMPTY;
            for lane in 0..60 {
                let (at, size) = ([(); 3].map(|()| coordinate(1.0)), [0.5, 0.1, 1e-4][lane % 3]);
                group.triangles[lane] = [(); 3].map(|()| {
                    let [x, y, z] = at.map(|x| x + coordinate(size));
                    [x, y, z, 0.5 + coordinate(0.1)]
                });
                group.pages[lane] = lane as u32 % 4;
            }
            let mut ball = |size: f64, half: f32, change: f64| -> Ball {
                let [x, y, z] = [(); 3].map(|()| coordinate(size));
                [x, y, z, half + coordinate(change)]
            };
            let (place, size) = (ball(1.0, 0.5, 0.1), [1.0, 0.3, 1e-3][round % 3]);
            let [x, y, z, _] = ball(0.5, 0.0, 0.0);
            let part = Part {
                origin: [x, y, z],
                corner: ball(0.1, 0.5, 0.1),
                edges: [ball(size, 0.0, 0.2 * size), ball(size, 0.0, 0.2 * size)],
                whole: ball(0.3, 1.0, 0.1),
            };
            let among = if round % 4 == 0 { 0x5a5a } else { u16::MAX };
            let all = |level: Level| {
                let parts = [1, 2, 3].map(|page| covered_sixteenths(level, &pages[page], &part, among));
                let corners = [0, 1, 2].map(|page| covering(level, &pages[page], &group.triangles[page]));
                (near(level, &pages[1], place), corners, covered_triangles(level, &group, &pages), parts)
            };
            let expected = all(Level::Portable);
            assert!(Level::available().into_iter().all(|level| all(level) == expected));
            counts[0] += expected.0.count_ones();
            counts[1] += expected.2.count_ones();
            counts[2] += expected.3.map(u16::count_ones).iter().sum::<u32>();
        }
        assert!(counts.into_iter().all(|count| count > 1000), "{counts:?}");
    }
}
