//! The ladder: the radii of the levels of a progressive order, from coarse to fine.
//!
//! The radii fall by the quotient, but not from the first sample on: as long as no level can have more than
//! [`Order::FIRST_COUNT`] samples, steps of the ladder are left out (see [`first_stride`]).

use crate::math::{exp2, log2, pow};
use crate::order::{Order, first_stride};

/// How near a quotient must be to a root of two to be meant as one.
const ROOT: f64 = 1e-9;

/// A radius that is longer than another by no more than this share is the same radius, rounded.
const ROUNDING: f64 = 1e-9;

/// The radii `coarsest / quotient^k`, without some of the first.
///
/// If the quotient is a root of two, every octave has the same radii to the bit, halved: so a radius that is a power of
/// two times another one stands in the ladder of the other as it is.
pub struct Ladder {
    coarsest: f64,
    quotient: f64,
    /// Levels per octave, if the quotient is a root of two.
    per_octave: Option<usize>,
    /// Before the step `dense` only every `stride`-th is taken: no set of their radii has more than
    /// [`Order::FIRST_COUNT`] samples.
    dense: usize,
    stride: usize,
}

impl Ladder {
    /// The ladder of a domain of this extent.
    pub fn new(coarsest: f64, quotient: f64, extent: [f64; 2]) -> Self {
        let roots = log2(quotient).recip().round();
        let is_root = (exp2(roots.recip()) - quotient).abs() < ROOT;
        let per_octave = is_root.then_some(roots as usize);
        let stride = first_stride(quotient) as usize;
        let all = Self { coarsest, quotient, per_octave, dense: 0, stride };
        // A multiple of the stride: a set of one of the first radii, too, stands in the ladder of a half of its radius.
        Self { dense: all.step_above(crowded_radius(extent)) / stride * stride, ..all }
    }

    /// A radius by the number of those before it, were none left out.
    pub fn radius(&self, step: usize) -> f64 {
        match self.per_octave {
            Some(steps) => {
                let part = exp2(-((step % steps) as f64) / steps as f64);
                self.coarsest * part * exp2(-((step / steps) as f64))
            }
            None => self.coarsest * pow(self.quotient, -(step as f64)),
        }
    }

    /// The last step whose radius is not below `length`; the first one if there is none.
    pub fn step_above(&self, length: f64) -> usize {
        (0..).find(|&step| self.radius(step + 1) < length).unwrap_or(0)
    }

    /// The radii from a step on, without end.
    pub fn radii(&self, first: usize) -> impl Iterator<Item = f64> {
        let is_taken =
            move |&step: &usize| step == first || step >= self.dense || (self.dense - step).is_multiple_of(self.stride);
        (first..).filter(is_taken).map(|step| self.radius(step))
    }

    /// The radii from a step on that are longer than `finest`, and `finest` itself.
    pub fn down_to(&self, first: usize, finest: f64) -> Vec<f64> {
        let longer = self.radii(first).take_while(|&radius| radius > finest * (1.0 + ROUNDING));
        longer.chain([finest]).collect()
    }
}

/// No more than [`Order::FIRST_COUNT`] samples of a rectangle, or of a torus of its size, are so far apart: by Oler's
/// inequality (1961) there are at most 2/sqrt(3) area / r^2 + perimeter / (2 r) + 1 at distances of at least r.
pub fn crowded_radius([width, height]: [f64; 2]) -> f64 {
    let (square, linear, others) =
        (2.0 / 3f64.sqrt() * width * height, width + height, Order::FIRST_COUNT as f64 - 1.0);
    (linear + (linear * linear + 4.0 * square * others).sqrt()) / (2.0 * others)
}

/// The smallest power of two times `radius` that is not below `length`.
pub fn octaves_above(radius: f64, length: f64) -> f64 {
    let mut coarsest = radius;
    while coarsest < length {
        coarsest *= 2.0;
    }
    coarsest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// So large that the coarsest levels of the tests have many samples.
    const LARGE: [f64; 2] = [1e4; 2];

    #[test]
    fn radii_fall_by_the_quotient_to_the_finest() {
        for quotient in [1.02, 1.05, 2f64.powf(0.125), 2f64.powf(0.25), 1.3, 2f64.sqrt(), 1.5] {
            for (coarsest, finest) in [(1.5, 0.01), (0.064, 0.001), (3.0, 3.0), (0.02, 0.0199)] {
                let radii = Ladder::new(coarsest, quotient, LARGE).down_to(0, finest);
                assert_eq!((radii[0], *radii.last().unwrap()), (coarsest, finest));
                assert!(radii.windows(2).all(|pair| pair[1] < pair[0] && pair[0] / pair[1] < quotient * (1.0 + 1e-12)));
                let fewest = (coarsest / finest).ln() / quotient.ln();
                assert!((radii.len() as f64 - 1.0 - fewest.ceil()).abs() < 1.5, "{quotient} {coarsest} {finest}");
            }
        }
    }

    /// Down to the radius at which there may be so many samples, and to no smaller one.
    #[test]
    fn the_first_radii_fall_by_about_two() {
        for extent in [[1.0, 1.0], [1.0, 0.01], [1e-9, 3.0], [70.0, 40.0]] {
            let crowded = crowded_radius(extent);
            let samples =
                2.0 / 3f64.sqrt() * extent[0] * extent[1] / crowded.powi(2) + (extent[0] + extent[1]) / crowded;
            assert!((samples - 99.0).abs() < 1e-9);
            for quotient in [1.02, 1.05, 2f64.powf(0.125), 1.1, 1.19, 2f64.powf(0.25), 1.3, 2f64.sqrt(), 1.5] {
                let coarsest = extent[0].hypot(extent[1]);
                let radii = Ladder::new(coarsest, quotient, extent).down_to(0, 1e-3 * crowded);
                let quotients: Vec<_> = radii.windows(2).map(|pair| pair[0] / pair[1]).collect();
                let dense = quotients.iter().rposition(|&found| found > quotient * (1.0 + 1e-9)).unwrap() + 1;
                let largest = quotient.powi(2).max(2.0) * (1.0 + 1e-9);
                assert!(radii[dense] >= crowded && radii[dense] < crowded * largest && radii[0] == coarsest);
                assert!(
                    quotients[..dense].iter().all(|&found| found <= largest && found * quotient > largest.min(2.0))
                );
            }
        }
    }

    #[test]
    fn an_octave_repeats_to_the_bit() {
        for (steps, quotient) in [(2, 2f64.sqrt()), (4, 2f64.powf(0.25)), (8, 1.0905077326652577)] {
            let ladder = Ladder::new(0.3, quotient, [0.2, 0.1]);
            assert_eq!(ladder.per_octave, Some(steps));
            assert!((0..200).all(|step| ladder.radius(step) == 2.0 * ladder.radius(step + steps)));
            for finest in [0.15, 0.0375, 0.0375 / 4.0] {
                let (short, long) = (ladder.down_to(0, finest), ladder.down_to(0, finest / 4.0));
                assert_eq!(short[..], long[..short.len()]);
            }
        }
        assert_eq!(Ladder::new(0.3, 1.1, LARGE).per_octave, None);
    }

    #[test]
    fn what_is_longer_than_the_domain_is_left_out() {
        let ladder = Ladder::new(octaves_above(0.01, 1.3), 2f64.powf(0.25), [1.0; 2]);
        let first = ladder.step_above(1.3);
        assert!(ladder.radius(first) >= 1.3 && ladder.radius(first + 1) < 1.3);
        assert_eq!(Ladder::new(1.0, 1.2, LARGE).step_above(1.3), 0);
        assert_eq!(octaves_above(0.4, 0.3), 0.4);
    }
}
