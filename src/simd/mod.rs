//! Vector instructions: code is written once over [`Lanes`], as [`Work`], and [`run`] at a [`Level`] that the processor
//! has.
//!
//! A level other than the portable one holds a token that only detection makes: code that has the token may run the
//! instructions, and no safe code can use instructions that the processor lacks. All levels compute the same bits.
//! Plain loops that a compiler vectorizes by itself are work as well, which leaves the token unused: they are compiled
//! once for each level.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod lanes;
mod portable;

pub use lanes::{HALF, LANES, Lanes, Position};
pub use portable::Portable;

/// Proof that the processor has AVX2, POPCNT, BMI1 and BMI2.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Avx2(());

/// Proof that the processor has the features of [`Avx2`], and AVX-512 F, VL, DQ and BW.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Avx512(Avx2);

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
            return if is_wide { Self::Avx512(Avx512(Avx2(()))) } else { Self::Avx2(Avx2(())) };
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

    /// False if processors that have AVX-512 are faster with AVX2: Intel's take three times as long for sixteen roots at
    /// once as for eight.
    #[cfg_attr(not(target_arch = "x86_64"), allow(dead_code, reason = "there is one level"))]
    const IS_WIDE: bool = true;

    /// Does the work.
    fn run<L: Lanes>(self, lanes: L) -> Self::Out;
}

/// Does work at a level: the one place where code is chosen by the level.
#[inline(always)]
pub fn run<W: Work>(level: Level, work: W) -> W::Out {
    match level {
        Level::Portable => work.run(Portable),
        // SAFETY: the level holds the proof that the processor has the features.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(proof) if W::IS_WIDE => unsafe { run_avx512(proof, work) },
        // SAFETY: either level holds the proof that the processor has the features.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(proof) | Level::Avx512(Avx512(proof)) => unsafe { run_avx2(proof, work) },
    }
}

#[cfg(target_arch = "x86_64")]
#[inline]
#[target_feature(enable = "avx2,popcnt,bmi1,bmi2")]
fn run_avx2<W: Work>(proof: Avx2, work: W) -> W::Out {
    work.run(proof)
}

#[cfg(target_arch = "x86_64")]
#[inline]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw,avx2,popcnt,bmi1,bmi2")]
fn run_avx512<W: Work>(proof: Avx512, work: W) -> W::Out {
    work.run(proof)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    /// All operations on floats, as bits.
    struct OfFloats<'a>([[f32; LANES]; 2], &'a [Position], [u32; LANES]);

    impl Work for OfFloats<'_> {
        type Out = Vec<u32>;

        fn run<L: Lanes>(self, lanes: L) -> Vec<u32> {
            let [a, b] = [lanes.load(&self.0[0]), lanes.load(&self.0[1])];
            let mask = lanes.less(a, b);
            let [x, y, z] = lanes.gather(self.1, &self.2);
            let of_two = [lanes.add(a, b), lanes.sub(a, b), lanes.mul(a, b), lanes.div(a, b)];
            let chosen = [lanes.min(a, b), lanes.max(a, b), lanes.select(mask, a, b), lanes.only(mask, a)];
            let numbers = self.2.map(|number| (number % LANES as u32).cast_signed());
            let permuted = lanes.permute(a, &numbers);
            let others = [permuted, lanes.abs(b), lanes.sqrt(a), lanes.splat(self.0[0][3]), x, y, z];
            let mut bits = vec![lanes.bits(mask), lanes.sum(a).to_bits(), lanes.least(b).to_bits()];
            bits.push(lanes.bits(lanes.at_most(a, b)));
            bits.push(lanes.bits(lanes.both(lanes.at_most(a, b), lanes.at_most(b, a))));
            for floats in of_two.into_iter().chain(chosen).chain(others) {
                let mut stored = [0.0; LANES];
                lanes.store(floats, &mut stored);
                // All NaNs count as equal, whatever their bits.
                bits.extend(stored.map(|x| if x.is_nan() { u32::MAX } else { x.to_bits() }));
            }
            let mut compressed = [0.0; LANES];
            lanes.compress(mask, lanes.abs(b), 5.0, &mut compressed);
            bits.extend(compressed.map(f32::to_bits));
            bits
        }
    }

    /// All operations on integers.
    struct OfInts([[i32; LANES]; 2]);

    impl Work for OfInts {
        type Out = (Vec<u32>, Vec<u32>);

        fn run<L: Lanes>(self, lanes: L) -> (Vec<u32>, Vec<u32>) {
            let [a, b] = [lanes.load_ints(&self.0[0]), lanes.load_ints(&self.0[1])];
            let (low, high) = (self.0[1][8..].try_into().unwrap(), self.0[0][..8].try_into().unwrap());
            let of_two = [lanes.add_ints(a, b), lanes.sub_ints(a, b), lanes.mul_ints(a, b), lanes.min_ints(a, b)];
            let others = [lanes.and_ints(a, b), lanes.splat_int(self.0[0][3]), lanes.load_halves([low, high])];
            let mut bits = Vec::new();
            for ints in of_two.into_iter().chain(others) {
                // Parts of the bits, which floats hold exactly.
                for mask in [0xffff, -0x10000] {
                    let mut stored = [0.0; LANES];
                    lanes.store(lanes.floats(lanes.and_ints(ints, lanes.splat_int(mask))), &mut stored);
                    bits.extend(stored.map(f32::to_bits));
                }
            }
            let mut rounded = [0.0; LANES];
            lanes.store(lanes.floats(a), &mut rounded);
            bits.extend(rounded.map(f32::to_bits));
            let (mask, mut compressed) = (lanes.less_ints(a, b), [0; LANES]);
            bits.push(lanes.bits(mask));
            lanes.compress_ints(mask, a, &mut compressed);
            let count = lanes.bits(mask).count_ones() as usize;
            (bits, compressed[..count].iter().map(|&x| x.cast_unsigned()).collect())
        }
    }

    /// All operations on lanes of twice the size.
    struct OfDoubles([[f64; HALF]; 2], [f32; LANES]);

    impl Work for OfDoubles {
        type Out = Vec<u64>;

        fn run<L: Lanes>(self, lanes: L) -> Vec<u64> {
            let [a, b] = [lanes.load_doubles(&self.0[0]), lanes.load_doubles(&self.0[1])];
            let mut bits = Vec::new();
            for doubles in [lanes.add_doubles(a, b), lanes.mul_doubles(a, b), lanes.splat_double(self.0[0][3])] {
                let mut stored = [0.0; LANES];
                lanes.store(lanes.narrow(doubles), &mut stored);
                bits.extend(stored[..HALF].iter().map(|x| u64::from(x.to_bits())));
            }
            let longs = lanes.widen(lanes.float_bits(lanes.load(&self.1)));
            let shifted = lanes.or_longs(longs, lanes.shift_longs(longs, 21));
            let mut stored = [0; HALF];
            lanes.store_longs(shifted, &mut stored);
            bits.extend(stored);
            bits.extend(stored.map(|number| u64::from(lanes.equal_longs(shifted, number))));
            bits
        }
    }

    /// Calls `test` with random floats of some size, half of the time with every other one special.
    fn with_floats(mut test: impl FnMut(&mut dyn FnMut() -> f32, &mut Rng)) {
        let (mut rng, mut others) = (Rng::at(9, Draw::Probe, &[]), Rng::at(10, Draw::Probe, &[]));
        let special = [0.0, -0.0, 1.0, f32::INFINITY, f32::MIN_POSITIVE, 1e-42, 3e38, -1.0];
        for case in 0..200 {
            let mut float = || match rng.below(if case % 2 == 0 { 2 } else { 1 << 40 }) {
                0 => special[rng.below(8) as usize],
                _ => (rng.unit() as f32 - 0.5) * 4.0,
            };
            test(&mut float, &mut others);
        }
    }

    #[test]
    fn all_levels_make_the_same_floats() {
        with_floats(|float, rng| {
            let vectors = std::array::from_fn(|_| std::array::from_fn(|_| float()));
            let positions: Vec<Position> = (0..40).map(|_| std::array::from_fn(|_| float())).collect();
            let named = std::array::from_fn(|_| rng.below(40) as u32);
            let portable = run(Level::Portable, OfFloats(vectors, &positions, named));
            let least = vectors[1].iter().fold(f32::INFINITY, |least, &x| least.min(x));
            assert_eq!(f32::from_bits(portable[2]), least);
            let [a, b] = vectors;
            let compressed = (0..LANES).filter(|&k| a[k] < b[k]).map(|k| b[k].abs());
            let compressed = compressed.chain([5.0; LANES]).take(LANES).map(f32::to_bits).collect::<Vec<_>>();
            let rest = portable.len() - LANES;
            assert_eq!(portable[rest..], compressed);
            assert_eq!(portable[rest - LANES], positions[named[0] as usize][2].to_bits());
            for level in Level::available() {
                assert_eq!(run(level, OfFloats(vectors, &positions, named)), portable, "{level:?}");
            }
        });
    }

    #[test]
    fn all_levels_make_the_same_integers_and_doubles() {
        with_floats(|float, rng| {
            let ints: [[i32; LANES]; 2] =
                [30, 3].map(|bits| std::array::from_fn(|_| rng.below(1 << bits) as i32 - (1 << (bits - 1))));
            let portable = run(Level::Portable, OfInts(ints));
            let [a, b] = ints;
            let less: Vec<_> = (0..LANES).filter(|&k| a[k] < b[k]).map(|k| a[k].cast_unsigned()).collect();
            assert_eq!(portable.1, less);
            let doubles = std::array::from_fn(|_| std::array::from_fn(|_| f64::from(float()) * (1.0 + rng.unit())));
            let floats: [f32; LANES] = std::array::from_fn(|_| float());
            let of_doubles = run(Level::Portable, OfDoubles(doubles, floats));
            let number = u64::from(floats[5].to_bits());
            assert_eq!(of_doubles[3 * HALF + 5], number | number << 21);
            assert!((0..HALF).all(|k| of_doubles[4 * HALF + k] >> k & 1 == 1));
            for level in Level::available() {
                assert_eq!(run(level, OfInts(ints)), portable, "{level:?}");
                // Infinity times 0 is the only NaN, whatever its sign.
                let bits = run(level, OfDoubles(doubles, floats));
                let is_nan = |bits: u64| bits <= u64::from(u32::MAX) && f32::from_bits(bits as u32).is_nan();
                let mut pairs = bits.iter().zip(&of_doubles);
                assert!(pairs.all(|(&a, &b)| a == b || is_nan(a) && is_nan(b)), "{level:?}");
            }
        });
    }

    #[test]
    fn positions_that_there_are_not_are_never_read() {
        for level in Level::available() {
            let mut named = [0; LANES];
            named[11] = 3;
            let gather = || run(level, OfFloats([[0.0; LANES]; 2], &[[0.0; 4]; 3], named));
            assert!(std::panic::catch_unwind(gather).is_err(), "{level:?}");
        }
    }
}
