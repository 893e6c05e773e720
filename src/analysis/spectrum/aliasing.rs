//! Effective Nyquist frequency and oscillation of a spectrum: the part of an image that survives sampling, and the
//! structure of its aliasing (Heck, Schlömer and Deussen 2013, "Blue noise sampling with controlled aliasing").
//!
//! The thresholds and ranges are those of psa, the program of the paper's authors, from which the figures in the
//! literature come. It finds the radial power from the radial distribution function; here it is that of the
//! periodogram.

use crate::analysis::spectrum::Periodogram;
use crate::error::{Error, Result};
use crate::math::square;

/// The mean power that an image tolerates up to twice its highest frequency, and the mean power above which the
/// spectrum is surely past its empty centre.
const QUIET: f64 = 0.1;
const LOUD: f64 = 0.5;

/// The power at which a spectrum has first risen to that of a Poisson process, and the range behind it over which the
/// oscillation is measured: ten times the Nyquist frequency of the square lattice, which is 1/2.
const RISEN: f64 = 0.98;
const RANGE: f64 = 5.0;

impl Periodogram {
    /// The effective Nyquist frequency ν_eff, in units of sqrt(density): half of the largest frequency below which the
    /// mean power, over all frequencies but 0, is under 0.1. An image without frequencies above it is sampled almost
    /// without aliasing.
    ///
    /// 0.5 for the square lattice and 0.537 for the hexagonal one; about 0.28 for a spectrum that steps from 0 to 1, 0
    /// for a Poisson process. (The tables of the literature divide it by the 0.5.) Where the mean power falls below 0.1
    /// more than once, the last time before it first exceeds 0.5 at frequencies above 0.5 counts.
    ///
    /// Annuli of `width` sum up the power; it is interpolated in between. Found from several sets with
    /// [`Periodogram::mean`].
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] if `width` is not a positive finite number, and for a periodogram too small (`size`)
    /// to show where the mean power exceeds 0.5: one out to a frequency of 1.5 is large enough for most sets.
    pub fn effective_nyquist(&self, width: f64) -> Result<f64> {
        let annuli = self.annuli(width)?;
        let mut inside = [0.0; 2];
        // The mean power within the outer circle of each annulus, NaN where there is no frequency yet.
        let mean: Vec<f64> = annuli
            .sums
            .iter()
            .map(|&[count, _, power, _]| {
                inside = [inside[0] + count, inside[1] + power];
                inside[1] / inside[0]
            })
            .collect();
        let outer = |annulus: usize| (annulus + 1) as f64 * width;
        let Some(loud) = (0..mean.len()).find(|&annulus| outer(annulus) >= 0.5 && mean[annulus] > LOUD) else {
            let reason = format!("the periodogram ends at frequency {}, before its mean power is {LOUD}", annuli.last);
            return Err(Error::invalid("size", reason));
        };
        let quiet = (0..loud).rev().find(|&annulus| mean[annulus] < QUIET);
        let frequency = quiet.map_or(0.0, |annulus| {
            let share = (QUIET - mean[annulus]) / (mean[annulus + 1] - mean[annulus]);
            outer(annulus) + share * width
        });
        Ok(0.5 * frequency)
    }

    /// The oscillation Ω, without unit: ten times the root mean square of the power's deviation from 1, by area, from
    /// the frequency at which the radial mean first is 0.98 to 5 sqrt(density) above. Narrow peaks and rings behind the
    /// first are what makes aliasing visible; 0 for a Poisson process and for the step of the paper.
    ///
    /// The part of the mean square over the annuli of `width` that their means of a finite number of frequencies have
    /// by chance is subtracted, so that the speckle of one periodogram does not count as oscillation. Found from
    /// several sets with [`Periodogram::mean`].
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] if `width` is not a positive finite number, and for a periodogram (`size`) that does
    /// not reach so far: out to a frequency of 6.5 for most sets, by a
    /// [`sparse_periodogram`](super::sparse_periodogram) for large ones.
    pub fn oscillation(&self, width: f64) -> Result<f64> {
        let curve = self.radial(width)?;
        let risen = curve.iter().position(|annulus| annulus.power >= RISEN);
        let Some(first) = risen.or_else(|| (0..curve.len()).max_by(|&a, &b| curve[a].power.total_cmp(&curve[b].power)))
        else {
            return Err(Error::invalid("size", format!("{} frequencies have no annulus of {width}", self.size())));
        };
        let end = curve[first].frequency + RANGE;
        let last = curve[curve.len() - 1].frequency;
        if last + width < end {
            return Err(Error::invalid("size", format!("the periodogram ends at frequency {last}, below {end}")));
        }
        let range = curve[first..].iter().take_while(|annulus| annulus.frequency <= end);
        let (area, squares) = range.fold((0.0, 0.0), |(area, squares), annulus| {
            let by_chance = annulus.anisotropy * square(annulus.power) / annulus.count as f64;
            let squared = square(annulus.power - 1.0) - by_chance;
            (area + annulus.frequency, squares + annulus.frequency * squared)
        });
        Ok(10.0 * (squares / area).max(0.0).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::spectrum::{periodogram, sparse_periodogram};
    use crate::job::Context;
    use crate::points::{Boundary, Domain};
    use crate::rng::{Draw, Rng};

    /// Points of a lattice of `columns` by `rows`, every second row moved by half a spacing if `shifted`.
    fn lattice(columns: usize, rows: usize, height: f64, shifted: bool) -> (Domain, Vec<[f32; 2]>) {
        let domain =
            Domain { min: [0.0; 2], max: [columns as f64, rows as f64 * height], boundary: Boundary::Periodic };
        let shift = |row: usize| if shifted && row % 2 == 1 { 0.5 } else { 0.0 };
        let at = |i: usize| [(i % columns) as f64 + shift(i / columns), (i / columns) as f64 * height];
        (domain, (0..columns * rows).map(|i| at(i).map(|x| x as f32)).collect())
    }

    #[test]
    fn lattices_have_half_the_frequency_of_their_first_peak() {
        let context = Context::new(1).unwrap();
        for (shifted, height, expected) in [(false, 1.0, 0.5), (true, 0.75f64.sqrt(), 0.5 * (4.0f64 / 3.0).powf(0.25))]
        {
            let (domain, points) = lattice(32, 36, height, shifted);
            let spectrum = periodogram(&context, &domain, &points, 140, None).unwrap();
            let nyquist = spectrum.effective_nyquist(0.01).unwrap();
            assert!((nyquist - expected).abs() < 0.006, "{nyquist}, not {expected}");
        }
    }

    #[test]
    fn a_poisson_process_has_neither_nyquist_frequency_nor_oscillation() {
        let context = Context::new(2).unwrap();
        let mut rng = Rng::at(4, Draw::Probe, &[]);
        let points: Vec<_> = (0..2000).map(|_| [rng.unit() as f32, rng.unit() as f32]).collect();
        for (boundary, stride) in [(Boundary::Periodic, 1), (Boundary::Periodic, 3), (Boundary::Bounded, 1)] {
            let domain = Domain::unit(boundary);
            let spectrum = sparse_periodogram(&context, &domain, &points, 600 / stride, stride, None).unwrap();
            let [nyquist, oscillation] =
                [spectrum.effective_nyquist(0.05), spectrum.oscillation(0.05)].map(Result::unwrap);
            assert!(nyquist < 0.06 && oscillation < 0.6, "{boundary:?} {stride}: {nyquist} {oscillation}");
        }
    }

    #[test]
    fn spectra_that_end_too_early_are_refused() {
        let (domain, points) = lattice(32, 32, 1.0, false);
        let spectrum = periodogram(&Context::new(1).unwrap(), &domain, &points, 40, None).unwrap();
        for result in [spectrum.effective_nyquist(0.05), spectrum.oscillation(0.05)] {
            assert!(matches!(result, Err(Error::InvalidArgument { argument: "size", .. })));
        }
        assert!(spectrum.effective_nyquist(0.0).is_err() && spectrum.oscillation(f64::NAN).is_err());
    }
}
