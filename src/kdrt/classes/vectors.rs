//! The filling of a block with classes (`mod.rs`) for each level of vector instructions, the same to the bit: the
//! portable code, compiled for them.

use crate::kdrt::classes::Pass;
use crate::kdrt::classes::filling::ClassFilling;
use crate::kdrt::classes::{Group, Known, Sample};
use crate::simd::Level;

impl Group {
    /// Returns the samples that a pass adds to a block.
    pub fn fill_block(&self, filling: &mut ClassFilling, known: &Known, place: [i32; 2], pass: Pass) -> Vec<Sample> {
        match self.level {
            // SAFETY: the variants say that the processor has the vectors.
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(_) => unsafe { self.fill_block_avx512(filling, known, place, pass) },
            // SAFETY: the same.
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(_) => unsafe { self.fill_block_avx2(filling, known, place, pass) },
            Level::Portable => self.fill_block_portable(filling, known, place, pass),
        }
    }

    /// The portable code, compiled for AVX-512.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,popcnt,bmi1,bmi2,avx512f,avx512vl,avx512dq,avx512bw")]
    fn fill_block_avx512(&self, filling: &mut ClassFilling, known: &Known, place: [i32; 2], pass: Pass) -> Vec<Sample> {
        self.fill_block_portable(filling, known, place, pass)
    }

    /// The portable code, compiled for AVX2.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,popcnt,bmi1,bmi2")]
    fn fill_block_avx2(&self, filling: &mut ClassFilling, known: &Known, place: [i32; 2], pass: Pass) -> Vec<Sample> {
        self.fill_block_portable(filling, known, place, pass)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::classes::Classes;
    use crate::job::Context;
    use crate::kdrt::classes::stack;
    use crate::kdrt::options::Options;
    use crate::plane::lattice::Lattice;
    use crate::points::{Boundary, Domain};

    #[test]
    fn all_levels_make_the_same_samples() {
        let classes = Classes::new(
            4,
            &[0.04, 0.0, 0.03, 0.01, 0.0, 0.02, 0.015, 0.03, 0.03, 0.015, 0.02, 0.0, 0.01, 0.03, 0.0, 0.008],
        );
        let classes = classes.unwrap();
        let options = Options::classes(&classes).seed(5);
        let lattice = Lattice::of_any_size(&Domain::unit(Boundary::Periodic), f64::MAX).unwrap();
        let set = |level: Level| {
            Context::new(1).unwrap().run(None, |job| {
                let mut groups = stack(job, &lattice, &options, &classes)?;
                groups.layers_mut().iter_mut().for_each(|group| group.level = level);
                groups.whole(job)
            })
        };
        let portable = set(Level::Portable).unwrap();
        assert!(portable.len() > 1000);
        assert!(Level::available().into_iter().all(|level| set(level).unwrap() == portable));
    }
}
