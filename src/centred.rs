//! Coordinates in doubles, far from the origin or not, as floats.
//!
//! Floats have 24 bits. Of georeferenced data, in metres from an equator, they keep half a metre: a house of 10 m would be
//! moved by a twentieth of its size. So such data are moved to an origin of their own before they are rounded.

/// Positions in floats, relative to an origin in doubles: position `i` in the caller's frame is `origin + positions[i]`.
///
/// The origin is 0 where rounding moves no coordinate by more than a millionth (2^-20) of the longest side of the box around
/// all positions, so that data near the origin stay as they are. Otherwise it is, on each axis whose coordinates exceed
/// that side 15 times, near the middle of the box, a multiple of a power of two that is about 2^-10 of the longest side:
/// subtracting it is exact.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Centred<const D: usize> {
    /// The positions relative to the origin.
    pub positions: Vec<[f32; D]>,
    /// The origin, all zeros for data near it.
    pub origin: [f64; D],
    /// The farthest that rounding moved a position; 0 for doubles that are floats.
    pub rounding: f64,
}

/// The share of the extent by which rounding may move a coordinate.
const SHARE: f64 = 1.0 / (1u32 << 20) as f64;

/// The times that coordinates exceed the extent where floats round them by its share, less their own rounding.
const FAR: f64 = 15.0;

/// The least number of steps of the origin in the extent.
const STEPS: f64 = (1u32 << 10) as f64;

impl<const D: usize> Centred<D> {
    /// Rounds positions. O(n). A coordinate that is no finite float becomes one that is not finite.
    pub fn of(positions: &[[f64; D]]) -> Self {
        let (mut low, mut high, mut errors) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D], [0f64; D]);
        for position in positions {
            for axis in 0..D {
                let x = position[axis];
                low[axis] = low[axis].min(x);
                high[axis] = high[axis].max(x);
                errors[axis] = errors[axis].max((f64::from(x as f32) - x).abs());
            }
        }
        let extent = (0..D).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
        // What is not finite stays where it is, so that it can be named.
        let is_rounded = extent.is_finite() && errors.iter().any(|&error| error > SHARE * extent);
        // Samples of an axis whose coordinates happen to be floats are no better off there.
        let is_far = |axis: usize| is_rounded && low[axis].abs().max(high[axis].abs()) > FAR * extent;
        let origin = std::array::from_fn(|axis| if is_far(axis) { origin(low[axis], high[axis], extent) } else { 0.0 });
        Self::around(positions, origin)
    }

    /// The radius that rounded positions have to keep, so that those that were rounded keep `radius`: both ends of a pair
    /// may have moved by the rounding, and sums round.
    pub fn lengthened(radius: f64, rounding: f64) -> f64 {
        if rounding > 0.0 && radius > 0.0 { (radius + 2.0 * rounding) * (1.0 + 4.0 * f64::EPSILON) } else { radius }
    }

    /// Rounds positions relative to an origin that is known. O(n).
    pub fn around(positions: &[[f64; D]], origin: [f64; D]) -> Self {
        let mut rounding = 0f64;
        let local = positions.iter().map(|position| {
            let exact: [f64; D] = std::array::from_fn(|axis| position[axis] - origin[axis]);
            let floats = exact.map(|x| x as f32);
            let error = |(&x, float): (&f64, f32)| f64::from(float) - x;
            let squared = exact.iter().zip(floats).map(error).map(|error| error * error).sum::<f64>();
            rounding = rounding.max(squared);
            floats
        });
        let positions = local.collect();
        Self { positions, origin, rounding: rounding.sqrt() }
    }
}

/// The origin along an axis of these ends, for data of this extent.
pub(crate) fn origin(low: f64, high: f64, extent: f64) -> f64 {
    let middle = low / 2.0 + high / 2.0;
    // The largest power of two up to the extent over the steps.
    let step = f64::from_bits((extent / STEPS).to_bits() & (0x7ff << 52));
    if step.is_normal() { (middle / step).round() * step } else { middle }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    /// Random positions of a box.
    fn cloud(seed: u64, corner: [f64; 3], size: f64) -> Vec<[f64; 3]> {
        let mut rng = Rng::at(seed, Draw::Probe, &[]);
        (0..500).map(|_| corner.map(|x| x + size * rng.unit())).collect()
    }

    #[test]
    fn positions_near_the_origin_are_only_rounded() {
        for (seed, corner) in (0..).zip([[0.0; 3], [-0.5; 3], [3.0, -7.0, 5.0]]) {
            let cloud = cloud(seed, corner, 1.0);
            let centred = Centred::of(&cloud);
            assert_eq!(centred.origin, [0.0; 3]);
            assert!(std::iter::zip(&cloud, &centred.positions).all(|(a, b)| a.map(|x| x as f32) == *b));
            assert!(centred.rounding > 0.0 && centred.rounding < 1e-6);
        }
    }

    #[test]
    fn floats_stay_as_they_are_however_far_they_are() {
        let cloud: Vec<_> = cloud(1, [5e5, 4.6e6, 1e7], 100.0).iter().map(|p| p.map(|x| f64::from(x as f32))).collect();
        let Centred { origin, rounding, .. } = Centred::of(&cloud);
        assert_eq!((origin, rounding), ([0.0; 3], 0.0));
    }

    #[test]
    fn positions_far_away_keep_a_millionth_of_their_extent() {
        for seed in 0..50 {
            let mut rng = Rng::at(seed, Draw::Probe, &[1]);
            let size = 10f64.powf(6.0 * rng.unit() - 3.0);
            let corner =
                [0.0; 3].map(|_| size * 10f64.powf(2.0 + 7.0 * rng.unit()) * if rng.unit() < 0.5 { -1.0 } else { 1.0 });
            let cloud = cloud(seed, corner, size);
            let centred = Centred::of(&cloud);
            for (exact, local) in std::iter::zip(&cloud, &centred.positions) {
                for axis in 0..3 {
                    let back = centred.origin[axis] + f64::from(local[axis]);
                    assert!((back - exact[axis]).abs() <= SHARE * size, "{seed}");
                    // The difference that was rounded is exact.
                    let difference = exact[axis] - centred.origin[axis];
                    assert_eq!(difference + centred.origin[axis], exact[axis], "{seed}");
                }
            }
            assert!(centred.rounding <= 2.0 * SHARE * size);
        }
    }

    #[test]
    fn axes_are_centred_one_by_one_and_odd_input_is_left_for_the_checks() {
        let cloud = cloud(3, [500_000.0, 4_649_776.0, 0.0], 100.0);
        assert!(
            matches!(Centred::of(&cloud).origin, [x, y, 0.0] if (x - 500_050.0).abs() < 1.0 && (y - 4_649_826.0).abs() < 1.0)
        );
        assert_eq!(Centred::of(&[[0.1 + 1e6, 7.0]]).positions, [[0.0, 0.0]]);
        assert_eq!(Centred::<2>::of(&[]).origin, [0.0; 2]);
        let odd = Centred::of(&[[f64::NAN, 1e300], [1e6 + 0.3, f64::NEG_INFINITY]]).positions;
        assert!(odd[0][0].is_nan() && odd[0][1].is_infinite() && odd[1][1].is_infinite());
    }
}
