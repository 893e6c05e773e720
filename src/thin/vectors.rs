//! The loop that selects in each level of vector instructions: the portable code, compiled for AVX2, so that its loops
//! over lanes become vectors. The same to the bit, since compilers contract nothing. AVX-512 gained nothing.

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Context;
    use crate::rng::{Draw, Rng};
    use crate::thin::selecting::select;
    use crate::thin::{Options, Selection};

    fn check<const D: usize>(count: usize) {
        let mut rng = Rng::at(D as u64, Draw::Probe, &[]);
        // A quarter of them on a lattice, with many ties.
        let cloud: Vec<[f32; D]> = (0..count)
            .map(|i| [(); D].map(|()| if i % 4 == 0 { rng.below(9) as f32 / 8.0 } else { rng.unit() as f32 }))
            .collect();
        let context = Context::new(1).unwrap();
        for options in [Options::by_radius(0.05), Options::progressive().seed(3)] {
            let select = |level| context.run(None, |job| select(job, level, &options, &cloud)).unwrap();
            let expected: Selection = select(Level::Portable);
            assert!(expected.indices.len() > 200);
            assert!(Level::available().into_iter().all(|level| select(level) == expected), "{options:?}");
        }
    }

    #[test]
    fn all_levels_select_the_same() {
        check::<2>(5000);
        check::<3>(3000);
    }
}
