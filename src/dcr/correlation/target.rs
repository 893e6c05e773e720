//! Pair correlations that sets are to have: given as g(r), or as the radial mean of the power.
//!
//! The two are a pair of Hankel transforms: with `r` in mean spacings and `ν` in units of sqrt(density),
//! `g(r) = 1 + ∫ (P(ν) - 1) J0(2π ν r) 2π ν dν` (Heck et al. 2013, "Blue noise sampling with controlled aliasing", §3).

use std::f64::consts::{SQRT_2, TAU};

use crate::check;
use crate::error::{Error, Result};
use crate::math::{erfc, exp, j1, square};

/// The most values of a pair correlation or power.
const MOST: usize = 1 << 16;

/// The bins of the correlations that are made here from a power, and where the last ends, in units of `d_max`: a little
/// farther than is matched.
const BINS: usize = 1024;
const REACH: f64 = 12.0;

/// The mean spacing, 1 / sqrt(density), in units of `d_max`: the root of half the square root of 3.
pub const MEAN_SPACING: f64 = 0.930_604_859_102_099_6;

/// The bins of a peak, each this part of its width, up to so many widths beyond its frequency.
const BINS_PER_WIDTH: f64 = 8.0;
const WIDTHS: f64 = 5.0;

/// A pair correlation g(r), also called radial distribution: the density of other points at the distance r from a point,
/// over the mean density. It is the mean over each of a number of bins of equal width from distance 0 to a reach in units
/// of `d_max`, as [`radial_distribution`](crate::analysis::distribution::radial_distribution) measures it.
#[derive(Clone, Debug, PartialEq)]
pub struct PairCorrelation {
    reach: f64,
    values: Vec<f64>,
}

impl PairCorrelation {
    /// The pair correlation with these values in bins from 0 to `reach`, in units of `d_max`. Bins of 0.05 or less show
    /// all that is matched of a smooth one. What is measured of a set of n points is over the density of the n - 1 others: to
    /// be matched to the last, it is multiplied by (n - 1) / n, in bins of about 0.005, as its noise is matched too.
    ///
    /// No point set has values below 0, and not all others exist either: they are allowed here, as the nearest that a
    /// relaxation comes to them may be wanted.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a `reach` that is not positive and finite, and for values (`correlation`) that are
    /// not finite, none, or more than 65,536.
    pub fn new(reach: f64, values: &[f64]) -> Result<Self> {
        check::positive("reach", reach)?;
        check_values("correlation", values, f64::MIN)?;
        Ok(Self { reach, values: values.to_vec() })
    }

    /// The pair correlation of sets with a radial power: `power` is constant in each of a number of bins of equal width
    /// from frequency 0 to `highest`, in units of sqrt(density), and 1 beyond them. Evaluated in the middle of `bins`
    /// bins from 0 to `reach`, in units of `d_max`. Takes O(bins · power) time.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a `highest` or `reach` that is not positive and finite, for a `power` that is not
    /// finite and at least 0, none, or more than 65,536, and for `bins` outside of 1 to 65,536.
    pub fn of_power(highest: f64, power: &[f64], reach: f64, bins: usize) -> Result<Self> {
        check::positive("highest", highest)?;
        check_values("power", power, 0.0)?;
        check::positive("reach", reach)?;
        check::range("bins", bins, 1..=MOST)?;
        // The transform of a disk of frequencies is ν J1(2π ν r) / r, and the power a sum of disks.
        let edge = |bin: usize| highest * (bin + 1) as f64 / power.len() as f64;
        let after = power[1..].iter().copied().chain([1.0]);
        let steps = power.iter().zip(after).enumerate().filter(|(_, (before, after))| *before != after);
        let disks: Vec<[f64; 2]> = steps.map(|(bin, (before, after))| [edge(bin), before - after]).collect();
        let at = |r: f64| 1.0 + disks.iter().map(|&[edge, height]| height * edge * j1(TAU * edge * r) / r).sum::<f64>();
        let width = reach / bins as f64;
        let values = (0..bins).map(|bin| at((bin as f64 + 0.5) * width / MEAN_SPACING)).collect();
        Ok(Self { reach, values })
    }

    /// Step noise (Heck et al. 2013): power 0 up to `frequency`, in units of sqrt(density), and 1 above. It exists up to
    /// a frequency of at most 0.564, beyond which g(0) is below 0.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a `frequency` that is not positive and finite.
    pub fn step(frequency: f64) -> Result<Self> {
        check::positive("frequency", frequency)?;
        Self::of_power(frequency, &[0.0], REACH, BINS)
    }

    /// Single-peak noise: the power rises from 0 to 1 about `frequency`, as an error function with the standard deviation
    /// `width`, and has a Gaussian peak of that width there, with a power of `height` more. All in units of sqrt(density).
    /// Heck et al. 2013 make the frequency as high as possible at little power in the peak; 0.6, a width of 0.06 and a
    /// height of 1 exist.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a `frequency` or `width` that is not positive and finite, a width below a
    /// thousandth of the frequency, and for a `height` below 0 or not finite.
    pub fn peak(frequency: f64, width: f64, height: f64) -> Result<Self> {
        check::positive("frequency", frequency)?;
        check::positive("width", width)?;
        check::from_zero("height", height)?;
        if width < 1e-3 * frequency {
            return Err(Error::invalid("width", format!("{width} is below a thousandth of the frequency {frequency}")));
        }
        let highest = frequency + WIDTHS * width;
        let bins = (BINS_PER_WIDTH * highest / width).ceil();
        let power = |bin: usize| {
            let t = ((bin as f64 + 0.5) * highest / bins - frequency) / width;
            0.5 * erfc(-t / SQRT_2) + height * exp(-0.5 * square(t))
        };
        Self::of_power(highest, &(0..bins as usize).map(power).collect::<Vec<_>>(), REACH, BINS)
    }

    /// The end of the last bin, in units of `d_max`.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// g(r) of each bin.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// g at a distance in units of `d_max` within the reach, linear between the middles of bins.
    pub(super) fn at(&self, distance: f64) -> f64 {
        let last = (self.values.len() - 1) as f64;
        let place = (distance / self.reach * self.values.len() as f64 - 0.5).clamp(0.0, last);
        let (bin, share) = (place as usize, place.fract());
        let next = (bin + 1).min(self.values.len() - 1);
        self.values[bin] * (1.0 - share) + self.values[next] * share
    }
}

/// Refuses values that are not finite or below `least`, none, and too many.
fn check_values(argument: &'static str, values: &[f64], least: f64) -> Result<()> {
    if values.is_empty() || values.len() > MOST {
        return Err(Error::invalid(argument, format!("{} values, not 1 to {MOST}", values.len())));
    }
    match values.iter().position(|value| !(least..=f64::MAX).contains(value)) {
        None => Ok(()),
        Some(index) if values[index] < least => {
            Err(Error::invalid(argument, format!("[{index}] is {}, below 0", values[index])))
        }
        Some(index) => Err(Error::invalid(argument, format!("[{index}] is {}, not finite", values[index]))),
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::math::j0;

    #[test]
    fn the_mean_spacing_is_that_of_one_point_in_each_hexagon() {
        assert_eq!(MEAN_SPACING, (0.5 * 3f64.sqrt()).sqrt());
    }

    /// Against the integral, by small steps.
    #[test]
    fn a_power_and_its_correlation_are_transforms_of_each_other() {
        let power = [0.2, 0.0, 0.0, 1.4, 2.5, 1.1, 1.1, 0.8];
        let correlation = PairCorrelation::of_power(1.3, &power, 6.0, 40).unwrap();
        for (bin, value) in correlation.values().iter().enumerate() {
            let r = (bin as f64 + 0.5) * 0.15 / MEAN_SPACING;
            let steps = 8000;
            let expected: f64 = (0..steps)
                .map(|step| {
                    let nu = 1.3 * (step as f64 + 0.5) / steps as f64;
                    (power[step * 8 / steps] - 1.0) * j0(TAU * nu * r) * TAU * nu * 1.3 / steps as f64
                })
                .sum();
            assert!((value - 1.0 - expected).abs() < 1e-5, "{bin}: {value}");
        }
    }

    #[test]
    fn a_step_is_zero_at_no_distance_where_it_just_exists() {
        let step = PairCorrelation::step(1.0 / PI.sqrt()).unwrap();
        assert!(step.values()[0].abs() < 1e-3 && step.values().iter().all(|&value| value > -1e-3));
        assert!(PairCorrelation::step(0.6).unwrap().values()[0] < -0.1);
        // A wide peak that starts where it is narrow.
        let peak = PairCorrelation::peak(0.6, 0.06, 1.0).unwrap();
        assert!(peak.values().iter().all(|&value| value > 0.3), "{:?}", peak.values()[0]);
        let step = PairCorrelation::peak(0.5, 0.0006, 0.0).unwrap();
        let sharp = PairCorrelation::step(0.5).unwrap();
        assert!(step.values().iter().zip(sharp.values()).all(|(a, b)| (a - b).abs() < 1e-3));
    }

    #[test]
    fn values_between_bins_are_interpolated() {
        let correlation = PairCorrelation::new(2.0, &[1.0, 3.0]).unwrap();
        let at = [0.0, 0.5, 1.0, 1.25, 1.5, 2.0].map(|distance| correlation.at(distance));
        assert_eq!(at, [1.0, 1.0, 2.0, 2.5, 3.0, 3.0]);
        assert_eq!((correlation.reach(), correlation.values()), (2.0, &[1.0, 3.0][..]));
    }

    #[test]
    fn arguments_are_refused_by_name() {
        let said = |result: Result<PairCorrelation>| result.unwrap_err().to_string();
        assert_eq!(said(PairCorrelation::new(0.0, &[1.0])), "reach: 0 is not a positive finite number");
        assert_eq!(said(PairCorrelation::new(1.0, &[])), "correlation: 0 values, not 1 to 65536");
        assert_eq!(said(PairCorrelation::new(1.0, &[1.0, f64::NAN])), "correlation: [1] is NaN, not finite");
        assert!(said(PairCorrelation::new(1.0, &vec![1.0; MOST + 1])).starts_with("correlation: 65537"));
        assert!(PairCorrelation::new(1.0, &[-1.0]).is_ok());
        assert!(said(PairCorrelation::of_power(f64::NAN, &[0.0], 1.0, 1)).starts_with("highest: NaN"));
        assert_eq!(said(PairCorrelation::of_power(1.0, &[-0.5], 1.0, 1)), "power: [0] is -0.5, below 0");
        assert!(said(PairCorrelation::of_power(1.0, &[0.5], 1.0, 0)).starts_with("bins: 0"));
        assert!(said(PairCorrelation::of_power(1.0, &[0.5], -1.0, 1)).starts_with("reach: -1"));
        assert!(said(PairCorrelation::step(-0.5)).starts_with("frequency: -0.5"));
        assert!(said(PairCorrelation::peak(0.5, 0.0, 1.0)).starts_with("width: 0"));
        assert!(said(PairCorrelation::peak(0.5, 1e-9, 1.0)).starts_with("width: 0.000000001 is below"));
        assert!(said(PairCorrelation::peak(0.5, 0.1, -1.0)).starts_with("height: -1"));
    }
}
