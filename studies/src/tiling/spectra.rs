//! The spectra of sets of the unit torus, beside those of the unbiased reference.

use azulejo::analysis::spectrum::{Annulus, Periodogram, periodogram};
use azulejo::{Boundary, Context, Domain, Result};

use crate::kdrt::Sampler;

/// The highest frequency that figures need, and the annuli of contrast and of radial means, in units of sqrt(density).
pub const LIMIT: f64 = 2.05;
pub const ANNULUS: f64 = 0.01;
pub const CURVE_ANNULUS: f64 = 0.02;

/// The frequency at which contrast is measured.
pub const RANGE: std::ops::Range<f64> = 0.5..2.0;

/// The spectrum of a set of about `count` samples up to `limit`, in units of sqrt(density).
pub fn spectrum(context: &Context, samples: &[[f32; 2]], count: f64, limit: f64) -> Result<Periodogram> {
    let half = (limit * count.sqrt()).ceil() as usize;
    periodogram(context, &Domain::unit(Boundary::Periodic), samples, 2 * half + 1, None)
}

/// The variance of a periodogram over its squared mean, in annuli; 1 where no part repeats.
pub fn contrast(spectrum: &Periodogram) -> Result<f64> {
    spectrum.contrast(ANNULUS, RANGE)
}

/// The radial mean of unbiased maximal sets.
pub struct Reference {
    curve: Vec<Annulus>,
}

impl Reference {
    /// The mean of some sets of about `count` samples, from a seed on.
    pub fn measure(context: &Context, count: f64, seeds: std::ops::Range<u64>) -> Result<Self> {
        let spectra =
            seeds.map(|seed| spectrum(context, &Sampler::Maximal.sample(context, count, seed)?, count, LIMIT));
        let spectra = spectra.collect::<Result<Vec<_>>>()?;
        Ok(Self { curve: Periodogram::mean(&spectra)?.radial(CURVE_ANNULUS)? })
    }

    /// The difference of the radial mean of a spectrum from this one, root mean square over the annuli, in units of
    /// power.
    pub fn deviation(&self, spectrum: &Periodogram) -> Result<f64> {
        let own = spectrum.radial(CURVE_ANNULUS)?;
        let pairs = own.iter().zip(&self.curve).filter(|(own, _)| own.frequency < RANGE.end);
        let squares: Vec<_> = pairs.map(|(own, other)| (own.power - other.power).powi(2)).collect();
        Ok((squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::random;

    #[test]
    fn white_noise_is_farther_from_the_reference_than_other_maximal_sets() {
        let (context, count) = (Context::new(2).unwrap(), 5000.0);
        let reference = Reference::measure(&context, count, 0..4).unwrap();
        let of =
            |samples: &[[f32; 2]]| reference.deviation(&spectrum(&context, samples, count, LIMIT).unwrap()).unwrap();
        let maximal = of(&Sampler::Maximal.sample(&context, count, 9).unwrap());
        assert!(maximal < 0.1 && of(&random(5000, 1)) > 0.3, "{maximal}");
    }
}
