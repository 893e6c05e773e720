//! Vector instructions: code is written once over [`Lanes`], as [`Work`], and [`run`] at a [`Level`] that the processor has.
//!
//! A level other than the portable one holds a token that only detection makes: code that has the token may run the
//! instructions, and no safe code can ask for instructions that the processor lacks. All levels compute the same bits.
//! Plain loops that a compiler vectorizes by itself are work as well, which leaves the token unused: they are compiled
//! once for each level.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod lanes;
mod portable;

pub use lanes::{LANES, Lanes, Position};
pub use portable::Portable;

/// Proof that the processor has AVX2, POPCNT, BMI1 and BMI2.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Avx2(());

/// Proof that the processor has what [`Avx2`] says, and AVX-512 F, VL, DQ and BW.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Avx512(());

/// A level of vector instructions that the processor has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2(Avx2),
    #[cfg(target_arch = "x86_64")]
    Avx512(Avx512),
}

impl Level {
    /// The widest level.
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
            return if is_wide { Self::Avx512(Avx512(())) } else { Self::Avx2(Avx2(())) };
        }
        Self::Portable
    }

    /// All levels, from the portable one to the widest.
    #[cfg(test)]
    pub fn available() -> Vec<Self> {
        match Self::widest() {
            Self::Portable => vec![Self::Portable],
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(_) => vec![Self::Portable, Self::widest()],
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(_) => vec![Self::Portable, Self::Avx2(Avx2(())), Self::widest()],
        }
    }
}

/// Work that is written over [`Lanes`]. All of its hot code is inlined into [`Work::run`].
pub trait Work {
    /// The result.
    type Out;

    /// Does the work.
    fn run<L: Lanes>(self, lanes: L) -> Self::Out;
}

/// Does work at a level: the one place where code is chosen by the level.
pub fn run<W: Work>(level: Level, work: W) -> W::Out {
    match level {
        Level::Portable => work.run(Portable),
        // SAFETY: the level holds the proof that the processor has the features.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(proof) => unsafe { run_avx2(proof, work) },
        // SAFETY: the level holds the proof that the processor has the features.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(proof) => unsafe { run_avx512(proof, work) },
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,popcnt,bmi1,bmi2")]
fn run_avx2<W: Work>(proof: Avx2, work: W) -> W::Out {
    work.run(proof)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw,avx2,popcnt,bmi1,bmi2")]
fn run_avx512<W: Work>(proof: Avx512, work: W) -> W::Out {
    work.run(proof)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    /// All operations on two vectors, as bits.
    struct All<'a>([[f32; LANES]; 2], &'a [Position], [u32; LANES]);

    impl Work for All<'_> {
        type Out = Vec<u32>;

        fn run<L: Lanes>(self, lanes: L) -> Vec<u32> {
            let [a, b] = [lanes.load(&self.0[0]), lanes.load(&self.0[1])];
            let mask = lanes.less(a, b);
            let [x, y, z] = lanes.gather(self.1, &self.2);
            let of_two = [lanes.add(a, b), lanes.sub(a, b), lanes.mul(a, b), lanes.div(a, b)];
            let chosen = [lanes.min(a, b), lanes.max(a, b), lanes.select(mask, a, b), lanes.only(mask, a)];
            let others = [lanes.sqrt(a), lanes.splat(self.0[0][3]), x, y, z];
            let mut bits = vec![lanes.bits(mask), lanes.sum(a).to_bits(), lanes.least(b).to_bits()];
            for floats in of_two.into_iter().chain(chosen).chain(others) {
                let mut stored = [0.0; LANES];
                lanes.store(floats, &mut stored);
                // A NaN is one, whatever its bits.
                bits.extend(stored.map(|x| if x.is_nan() { u32::MAX } else { x.to_bits() }));
            }
            bits
        }
    }

    #[test]
    fn all_levels_make_the_same_bits() {
        let mut rng = Rng::at(9, Draw::Probe, &[]);
        let special = [0.0, -0.0, 1.0, f32::INFINITY, f32::MIN_POSITIVE, 1e-42, 3e38, -1.0];
        for case in 0..200 {
            let mut float = || match rng.below(if case % 2 == 0 { 2 } else { 1 << 40 }) {
                0 => special[rng.below(8) as usize],
                _ => (rng.unit() as f32 - 0.5) * 4.0,
            };
            let vectors = std::array::from_fn(|_| std::array::from_fn(|_| float()));
            let positions: Vec<Position> = (0..40).map(|_| std::array::from_fn(|_| float())).collect();
            let named = std::array::from_fn(|_| rng.below(40) as u32);
            let portable = run(Level::Portable, All(vectors, &positions, named));
            let least = vectors[1].iter().fold(f32::INFINITY, |least, &x| least.min(x));
            assert_eq!(f32::from_bits(portable[2]), least);
            assert_eq!(portable[portable.len() - LANES], positions[named[0] as usize][2].to_bits());
            for level in Level::available() {
                assert_eq!(run(level, All(vectors, &positions, named)), portable, "{level:?}");
            }
        }
    }

    #[test]
    fn positions_that_there_are_not_are_never_read() {
        for level in Level::available() {
            let mut named = [0; LANES];
            named[11] = 3;
            let gather = || run(level, All([[0.0; LANES]; 2], &[[0.0; 4]; 3], named));
            assert!(std::panic::catch_unwind(gather).is_err(), "{level:?}");
        }
    }
}
