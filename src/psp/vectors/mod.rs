//! The functions of `near.rs` in AVX2 and AVX-512, the same to the bit.

use crate::psp::near::{self, Local, Near, Places};
use crate::simd::Level;

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;

/// [`Near::append`].
#[inline]
pub(super) fn append(vectors: Level, near: &mut Near, places: &Places, centre: [f32; 3], reach2: f32) {
    match vectors {
        Level::Portable => near.append(places, centre, reach2),
        // SAFETY: the variant says that the processor has the vectors.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => unsafe { avx2::append(near, places, centre, reach2) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => unsafe { avx512::append(near, places, centre, reach2) },
    }
}

/// [`Near::append_reaching`].
#[inline]
pub(super) fn append_reaching(vectors: Level, near: &mut Near, from: usize, to: usize, centre: [f32; 3], reach2: f32) {
    match vectors {
        // SAFETY: the variant says that the processor has the vectors.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => unsafe { avx512::append_reaching(near, from, to, centre, reach2) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => unsafe { avx2::append_reaching(near, from, to, centre, reach2) },
        Level::Portable => near.append_reaching(from, to, centre, reach2),
    }
}

/// [`Near::covered`].
#[inline]
pub(super) fn covered(vectors: Level, near: &Near, from: usize, fragment: &Local) -> u16 {
    match vectors {
        Level::Portable => near.covered(from, fragment),
        // SAFETY: the variant says that the processor has the vectors.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => unsafe { avx2::covered(near, from, fragment) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => unsafe { avx512::covered(near, from, fragment) },
    }
}

/// [`Near::take_covered`].
#[inline]
pub(super) fn take_covered(vectors: Level, near: &Near, from: usize, fragment: &Local, open: &mut [u16; 16]) {
    match vectors {
        Level::Portable => near.take_covered(from, fragment, open),
        // SAFETY: the variant says that the processor has the vectors.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) => unsafe { avx2::take_covered(near, from, fragment, open) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(_) => unsafe { avx512::take_covered(near, from, fragment, open) },
    }
}

/// [`near::close`].
#[inline]
pub(super) fn close(vectors: Level, places: &Places, point: [f32; 3]) -> u8 {
    match vectors {
        Level::Portable => near::close(places, point),
        // SAFETY: the variant says that the processor has the vectors.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) | Level::Avx512(_) => unsafe { avx2::close(places, point) },
    }
}
