//! The functions of `stack.rs` in AVX2 and AVX-512, the same to the bit.

use crate::psp::stack::{self, LocalFragment, PointLanes, PointStack};
use crate::simd::Level;

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;

/// [`PointStack::append`].
#[inline]
pub(super) fn append(vectors: Level, stack: &mut PointStack, places: &PointLanes, centre: [f32; 3], reach2: f32) {
    match vectors {
        Level::Portable => stack.append(places, centre, reach2),
        // SAFETY: the token is proof that the processor has the instructions.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => unsafe { avx2::append(stack, places, centre, reach2) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => unsafe { avx512::append(stack, places, centre, reach2) },
    }
}

/// [`PointStack::append_reaching`].
#[inline]
pub(super) fn append_reaching(
    vectors: Level,
    stack: &mut PointStack,
    from: usize,
    to: usize,
    centre: [f32; 3],
    reach2: f32,
) {
    match vectors {
        // SAFETY: the token is proof that the processor has the instructions.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => unsafe { avx512::append_reaching(stack, from, to, centre, reach2) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => unsafe { avx2::append_reaching(stack, from, to, centre, reach2) },
        Level::Portable => stack.append_reaching(from, to, centre, reach2),
    }
}

/// [`PointStack::covered`].
#[inline]
pub(super) fn covered(vectors: Level, stack: &PointStack, from: usize, fragment: &LocalFragment) -> u16 {
    match vectors {
        Level::Portable => stack.covered(from, fragment),
        // SAFETY: the token is proof that the processor has the instructions.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => unsafe { avx2::covered(stack, from, fragment) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => unsafe { avx512::covered(stack, from, fragment) },
    }
}

/// [`PointStack::take_covered`].
#[inline]
pub(super) fn take_covered(
    vectors: Level,
    stack: &PointStack,
    from: usize,
    fragment: &LocalFragment,
    open: &mut [u16; 16],
) {
    match vectors {
        Level::Portable => stack.take_covered(from, fragment, open),
        // SAFETY: the token is proof that the processor has the instructions.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => unsafe { avx2::take_covered(stack, from, fragment, open) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => unsafe { avx512::take_covered(stack, from, fragment, open) },
    }
}

/// [`stack::close`].
#[inline]
pub(super) fn close(vectors: Level, places: &PointLanes, point: [f32; 3]) -> u8 {
    match vectors {
        Level::Portable => stack::close(places, point),
        // SAFETY: the token is proof that the processor has the instructions.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) | Level::Avx512(_) => unsafe { avx2::close(places, point) },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use glam::Vec3A;

    use crate::psp::stack::FAR;
    use crate::rng::{Draw, Rng};

    fn points(stack: &PointStack) -> Vec<[f32; 3]> {
        (0..stack.len).map(|index| stack.point(index)).collect()
    }

    #[test]
    fn all_vectors_give_the_same_bits() {
        let mut rng = Rng::at(3, Draw::Probe, &[]);
        let mut counts = [0; 4];
        for round in 0..3000 {
            let mut coordinate = |size: f64| (size * (2.0 * rng.unit() - 1.0)) as f32;
            let pages: Vec<PointLanes> = (0..5)
                .map(|_| std::array::from_fn(|_| std::array::from_fn(|_| coordinate(1.5))))
                .map(|mut places: PointLanes| {
                    places.iter_mut().for_each(|axis| axis[6..].fill(FAR));
                    places
                })
                .collect();
            let centre: [f32; 3] = std::array::from_fn(|_| coordinate(0.5));
            let mut vector = || Vec3A::from_array(std::array::from_fn(|_| coordinate([1.0, 0.3, 1e-3][round % 3])));
            let fragment = LocalFragment { corner: vector(), edges: [vector(), vector()], extent: 0.5 };
            let all = |vectors: Level| {
                let mut stack = PointStack::new();
                stack.reserve(80);
                pages.iter().for_each(|page| append(vectors, &mut stack, page, centre, 3.0));
                let end = stack.len;
                append_reaching(vectors, &mut stack, end / 3, end, centre, 1.5);
                let covered = covered(vectors, &stack, end, &fragment);
                let mut open = std::array::from_fn(|index| [u16::MAX, 0, 0x1234][(index + round) % 3]);
                take_covered(vectors, &stack, end / 2, &fragment, &mut open);
                (points(&stack), end, covered, open, close(vectors, &pages[0], centre))
            };
            let expected = all(Level::Portable);
            assert!(Level::available().into_iter().all(|vectors| all(vectors) == expected));
            counts[0] += expected.0.len() - expected.1;
            counts[1] += expected.2.count_ones() as usize;
            counts[2] += expected.3.iter().map(|open| open.count_ones() as usize).sum::<usize>();
            counts[3] += expected.4.count_ones() as usize;
        }
        let [reaching, covered, open, closer] = counts;
        assert!(reaching > 10_000 && covered > 3000 && open > 10_000 && closer > 1000, "{counts:?}");
    }
}
