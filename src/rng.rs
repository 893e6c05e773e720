//! Counter-based random numbers, keyed by place.
//!
//! A stream belongs to a *place* (seed, kind of draw, cell, round, ...), never to a thread: any task that needs the
//! numbers of a place makes the same ones, in any order of calls and for any number of threads (Salmon et al. 2011,
//! "Parallel random numbers: as easy as 1, 2, 3"). The mixer is SplitMix64 (Steele, Lea and Flood 2014).

const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// The use of a stream. It is part of the key, so that two uses of one place never share numbers.
#[derive(Clone, Copy, Debug)]
#[repr(u64)]
pub(crate) enum Draw {
    /// Darts of the flat quadtree (`maximal`).
    Darts = 1,
    /// The random kd-tree of KDRT: split positions.
    Split,
    /// KDRT: the offset of a leaf's clip in the pattern.
    Clip,
    /// KDRT: the priority of a leaf.
    Priority,
    /// KDRT: the jitter of the fill blocks.
    Block,
    /// PSP: the rotation of the projectors.
    Rotation,
    /// PSP: the shift of a projector's pattern.
    Shift,
    /// PSP: darts in uncovered surface.
    Fill,
    /// DCR: directions that separate coincident points.
    Part,
    /// Random points on a surface (analysis).
    Probe,
    /// KDRT: another attempt at an exact count.
    Attempt,
    /// KDRT: the places and kinds of the changes that give a set an exact count.
    Tune,
    /// KDRT: the ranks and the filling of merged pieces.
    Merge,
    /// PSP: darts where the radius varies.
    Adaptive,
    /// PSP: the pieces of the surface that are filled together with those of larger radii.
    Octave,
    /// DCR: the end of an edge that visits it.
    Visit,
    /// DCR: random points of a given density.
    Scatter,
    /// DCR: directions in which points are kicked.
    Kick,
    /// DCR: random points of a surface, to which crowded samples are moved.
    Spread,
    /// Thinning: the first point of the progressive order.
    Thin,
    /// The levels of a progressive order: KDRT and PSP.
    Level,
    /// The groups of several classes: KDRT and PSP.
    Group,
    /// KDRT: the filling of gaps in a set that is edited.
    Edit,
    /// Darts in the blocks of a volume.
    Volume,
    /// PSP: the shift of the blocks of local projectors, and the turns and shifts of their patterns.
    Charts,
    /// Masks: the initial pattern of a channel, and what decides between pixels of equal energy.
    Mask,
    /// PSP: the seed of an instance.
    Instance,
}

/// The stream of random numbers of one place.
#[derive(Clone, Debug)]
pub(crate) struct Rng {
    key: u64,
    counter: u64,
}

/// A bijective mixer: every input bit reaches every output bit.
fn mix(mut x: u64) -> u64 {
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// The hash of a place: the key of its stream, and a random number of its own where one is enough.
pub(crate) fn hash(seed: u64, draw: Draw, place: &[u64]) -> u64 {
    let start = mix(seed.wrapping_add(GOLDEN.wrapping_mul(draw as u64)));
    place.iter().fold(start, |key, &word| mix(key.wrapping_add(GOLDEN) ^ mix(word.wrapping_add(GOLDEN))))
}

impl Rng {
    /// The stream of a place.
    pub(crate) fn at(seed: u64, draw: Draw, place: &[u64]) -> Self {
        Self { key: hash(seed, draw, place), counter: 0 }
    }

    /// The same stream after this many more draws.
    pub(crate) fn after(&self, draws: u64) -> Self {
        Self { key: self.key, counter: self.counter.wrapping_add(draws) }
    }

    /// 64 random bits.
    pub(crate) fn bits(&mut self) -> u64 {
        self.counter = self.counter.wrapping_add(1);
        mix(self.key.wrapping_add(self.counter.wrapping_mul(GOLDEN)))
    }

    /// Uniform in `[0, 1)`, a multiple of 2^-53.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }

    /// Uniform in `0..bound`; `bound` is at least 1. The bias of the multiply-shift is below `bound` / 2^64.
    pub(crate) fn below(&mut self, bound: u64) -> u64 {
        ((self.bits() as u128 * bound as u128) >> 64) as u64
    }

    /// The barycentrics of a uniformly random point of a triangle.
    pub(crate) fn in_triangle(&mut self) -> [f64; 2] {
        // The square root makes the triangle's tip as dense as its base (Turk 1990).
        let (along, across) = (self.unit().sqrt(), self.unit());
        [along * (1.0 - across), along * across]
    }

    /// Two numbers uniform in `0..bound`, from the bits of one; the bias is below `bound` / 2^32.
    pub(crate) fn pair_below(&mut self, bound: u32) -> [u32; 2] {
        let bits = self.bits();
        [bits >> 32, bits & 0xffff_ffff].map(|half| ((half * u64::from(bound)) >> 32) as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_has_one_stream_and_other_places_have_others() {
        let draw = |seed, place: &[u64]| {
            let mut rng = Rng::at(seed, Draw::Darts, place);
            [rng.bits(), rng.bits(), rng.bits()]
        };
        assert_eq!(draw(1, &[2, 3]), draw(1, &[2, 3]));
        let others = [draw(1, &[3, 2]), draw(2, &[2, 3]), draw(1, &[2]), draw(1, &[2, 3, 0])];
        assert!(others.iter().all(|other| other[0] != draw(1, &[2, 3])[0]));
        assert_ne!(hash(1, Draw::Darts, &[2]), hash(1, Draw::Split, &[2]));
    }

    #[test]
    fn a_stream_can_be_entered_anywhere() {
        let mut rng = Rng::at(4, Draw::Darts, &[1]);
        rng.bits();
        let start = rng.clone();
        for draws in 0..5 {
            assert_eq!(start.after(draws).bits(), rng.bits());
        }
    }

    #[test]
    fn numbers_are_uniform_within_and_across_places() {
        let streams: [&dyn Fn(u64) -> f64; 2] = [
            &|i| {
                let mut rng = Rng::at(7, Draw::Darts, &[]);
                rng.counter = i;
                rng.unit()
            },
            &|i| Rng::at(7, Draw::Darts, &[i]).unit(),
        ];
        for stream in streams {
            let mut histogram = [0u32; 16];
            (0..160_000).for_each(|i| histogram[(stream(i) * 16.0) as usize] += 1);
            let chi2: f64 = histogram.iter().map(|&n| (n as f64 - 1e4).powi(2) / 1e4).sum();
            assert!(chi2 < 45.0, "chi2 of 15 degrees of freedom: {chi2}");
        }
    }

    #[test]
    fn below_reaches_its_whole_range_and_no_more() {
        let mut rng = Rng::at(3, Draw::Clip, &[]);
        let mut seen = [false; 7];
        (0..1000).for_each(|_| seen[rng.below(7) as usize] = true);
        assert_eq!(seen, [true; 7]);
        assert_eq!(rng.below(1), 0);
    }
}
