//! Which vectors there are: the functions of `near.rs` in AVX2 and AVX-512, chosen at run time, the same to the bit.

use crate::plane::list::{self, List};
use crate::plane::near::Near;
use crate::plane::rect::Rect;
use crate::plane::rows::Rows;
use crate::simd::Level;

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;

impl Level {
    /// [`Rows::nearest`].
    #[inline]
    pub(super) fn nearest(self, rows: &Rows, point: [i32; 2]) -> f32 {
        match self {
            Self::Portable => rows.nearest(point),
            // SAFETY: the variant says that the processor has the vectors.
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(_) => unsafe { avx2::nearest(rows, point) },
            // SAFETY: the same.
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(_) => unsafe { avx512::nearest(rows, point) },
        }
    }

    /// [`Near::gather`].
    #[inline]
    pub(super) fn gather(self, near: &mut Near, rows: &Rows, cell: Rect, threshold: f32) {
        match self {
            Self::Portable => near.gather(rows, cell, threshold),
            // SAFETY: the variant says that the processor has the vectors.
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(_) => unsafe { avx2::gather(near, rows, cell, threshold) },
            // SAFETY: the same.
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(_) => unsafe { avx512::gather(near, rows, cell, threshold) },
        }
    }

    /// [`Near::uncovered`].
    #[inline]
    pub(super) fn uncovered(self, near: &Near, voxel: &Rect, width: i32) -> u16 {
        match self {
            Self::Portable => near.uncovered(voxel, width),
            // SAFETY: the variant says that the processor has the vectors.
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(_) => unsafe { avx2::uncovered(near, voxel, width) },
            // SAFETY: the same.
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(_) => unsafe { avx512::uncovered(near, voxel, width) },
        }
    }

    /// [`list::collect`].
    #[inline]
    pub(super) fn collect(self, rows: &Rows, width: usize, rect: &Rect, list: &mut List) {
        match self {
            // SAFETY: the variant says that the processor has the vectors.
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(_) => unsafe { avx512::collect(rows, width, rect, list) },
            _ => list::collect(rows, width, rect, list),
        }
    }
}
