//! The functions of `near.rs` in AVX2 and AVX-512, the same to the bit.

use crate::maximal::Vectors;
use crate::psp::near::{self, Local, Near, Places};

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;

/// [`Near::append`].
#[inline]
pub(super) fn append(vectors: Vectors, near: &mut Near, places: &Places, centre: [f32; 3], reach2: f32) {
    match vectors {
        Vectors::Portable => near.append(places, centre, reach2),
        // SAFETY: the variant says that the processor has the vectors.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx2 => unsafe { avx2::append(near, places, centre, reach2) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx512 => unsafe { avx512::append(near, places, centre, reach2) },
    }
}

/// [`Near::append_reaching`].
#[inline]
pub(super) fn append_reaching(
    vectors: Vectors,
    near: &mut Near,
    from: usize,
    to: usize,
    centre: [f32; 3],
    reach2: f32,
) {
    match vectors {
        // SAFETY: the variant says that the processor has the vectors.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx512 => unsafe { avx512::append_reaching(near, from, to, centre, reach2) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx2 => unsafe { avx2::append_reaching(near, from, to, centre, reach2) },
        Vectors::Portable => near.append_reaching(from, to, centre, reach2),
    }
}

/// [`Near::covered`].
#[inline]
pub(super) fn covered(vectors: Vectors, near: &Near, from: usize, fragment: &Local) -> u16 {
    match vectors {
        Vectors::Portable => near.covered(from, fragment),
        // SAFETY: the variant says that the processor has the vectors.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx2 => unsafe { avx2::covered(near, from, fragment) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx512 => unsafe { avx512::covered(near, from, fragment) },
    }
}

/// [`Near::take_covered`].
#[inline]
pub(super) fn take_covered(vectors: Vectors, near: &Near, from: usize, fragment: &Local, open: &mut [u16; 16]) {
    match vectors {
        Vectors::Portable => near.take_covered(from, fragment, open),
        // SAFETY: the variant says that the processor has the vectors.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx2 => unsafe { avx2::take_covered(near, from, fragment, open) },
        // SAFETY: the same.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx512 => unsafe { avx512::take_covered(near, from, fragment, open) },
    }
}

/// [`near::close`].
#[inline]
pub(super) fn close(vectors: Vectors, places: &Places, point: [f32; 3]) -> u8 {
    match vectors {
        Vectors::Portable => near::close(places, point),
        // SAFETY: the variant says that the processor has the vectors.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx2 | Vectors::Avx512 => unsafe { avx2::close(places, point) },
    }
}
