//! Which vectors there are: the functions of `near.rs` in AVX2 and AVX-512, chosen at run time, the same to the bit.

use crate::lattice::Rect;

use super::list::List;
use super::near::{self, Near, Rows};

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;

/// Vectors that the processor has: whoever holds a variant, which only [`Vectors::widest`] hands out, may run its code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Vectors {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Vectors {
    /// The widest there are.
    pub fn widest() -> Self {
        #[cfg(target_arch = "x86_64")]
        if is_x86_feature_detected!("avx2")
            && is_x86_feature_detected!("popcnt")
            && is_x86_feature_detected!("bmi1")
            && is_x86_feature_detected!("bmi2")
        {
            let is_wide = is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512vl")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512bw");
            return if is_wide { Self::Avx512 } else { Self::Avx2 };
        }
        Self::Portable
    }

    /// All there are.
    #[cfg(test)]
    pub fn available() -> Vec<Self> {
        let all = [
            Self::Portable,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2,
            #[cfg(target_arch = "x86_64")]
            Self::Avx512,
        ];
        let widest = all.iter().position(|&vectors| vectors == Self::widest()).expect("one of them");
        all[..=widest].to_vec()
    }

    /// [`Rows::nearest`].
    #[inline]
    pub(super) fn nearest(self, rows: &Rows, point: [i32; 2]) -> f32 {
        match self {
            Self::Portable => rows.nearest(point),
            // SAFETY: the variant says that the processor has the vectors.
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => unsafe { avx2::nearest(rows, point) },
            // SAFETY: the same.
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => unsafe { avx512::nearest(rows, point) },
        }
    }

    /// [`Near::gather`].
    #[inline]
    pub(super) fn gather(self, near: &mut Near, rows: &Rows, cell: Rect, threshold: f32) {
        match self {
            Self::Portable => near.gather(rows, cell, threshold),
            // SAFETY: the variant says that the processor has the vectors.
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => unsafe { avx2::gather(near, rows, cell, threshold) },
            // SAFETY: the same.
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => unsafe { avx512::gather(near, rows, cell, threshold) },
        }
    }

    /// [`Near::uncovered`].
    #[inline]
    pub(super) fn uncovered(self, near: &Near, voxel: &Rect, width: i32) -> u16 {
        match self {
            Self::Portable => near.uncovered(voxel, width),
            // SAFETY: the variant says that the processor has the vectors.
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => unsafe { avx2::uncovered(near, voxel, width) },
            // SAFETY: the same.
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => unsafe { avx512::uncovered(near, voxel, width) },
        }
    }

    /// [`near::collect`].
    #[inline]
    pub(super) fn collect(self, rows: &Rows, width: usize, rect: &Rect, list: &mut List) {
        match self {
            // SAFETY: the variant says that the processor has the vectors.
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => unsafe { avx512::collect(rows, width, rect, list) },
            _ => near::collect(rows, width, rect, list),
        }
    }
}
