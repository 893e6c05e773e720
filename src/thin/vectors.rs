//! The loop that selects in each level of vector instructions: the portable code, compiled for AVX2, so that its loops over
//! lanes become vectors. The same to the bit, since compilers contract nothing. AVX-512 gained nothing.

use super::selecting::{End, Selecting};
use crate::simd::Level;

/// [`Selecting::advance`].
pub(super) fn advance<const D: usize>(level: Level, selecting: &mut Selecting<D>, end: &End, count: usize) -> bool {
    match level {
        // SAFETY: both levels hold the proof that the processor has AVX2, POPCNT, BMI1 and BMI2.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(_) | Level::Avx512(_) => unsafe { advance_avx2(selecting, end, count) },
        Level::Portable => selecting.advance(end, count),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,popcnt,bmi1,bmi2")]
fn advance_avx2<const D: usize>(selecting: &mut Selecting<D>, end: &End, count: usize) -> bool {
    selecting.advance(end, count)
}
