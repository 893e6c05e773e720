//! The test of `outline.rs` compiled once more for wider vectors, the same to the bit.

use crate::psp::adaptive::outline::{Nearby, Outline};
use crate::simd::Level;

/// [`Outline::open_sixteenths`].
#[inline]
pub(super) fn open_sixteenths(level: Level, outline: &Outline, samples: &[Nearby]) -> u16 {
    match level {
        Level::Portable => outline.open_sixteenths(samples),
        // SAFETY: the token is proof that the processor has the instructions.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) | Level::Avx512(_) => unsafe { open_sixteenths_avx2(outline, samples) },
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn open_sixteenths_avx2(outline: &Outline, samples: &[Nearby]) -> u16 {
    outline.open_sixteenths(samples)
}
