//! Spectra of sets of one kind, all on the unit torus.

use azulejo::analysis::spacing;
use azulejo::analysis::spectrum::{Annulus, Periodogram};
use azulejo::{Boundary, Context, Domain, Result};

use azulejo_cli::draw::spectra::{FREQUENCY_LIMIT, spectrum_up_to};
use azulejo_cli::quality::LOW;
use azulejo_cli::summary::Summary;

/// Frequencies per side of a spectrum, at most.
const GRID: usize = 1201;

/// The annuli of curves, at least as wide as the steps of the grid, and those of the anisotropy with their range, in
/// units of sqrt(density).
const ANNULUS: f64 = 0.02;
const ANISOTROPY_RANGE: std::ops::Range<f64> = 0.5..2.0;

/// Spectral figures of sets.
pub struct Blue {
    /// The number of samples of each set.
    pub counts: Vec<usize>,
    /// The smallest distance in units of the hexagonal one, in the mean of the sets.
    pub rho: f64,
    /// The mean power below [`LOW`].
    pub low_power: f64,
    /// The effective Nyquist frequency of the mean spectrum in units of sqrt(density), if it is defined.
    pub nyquist: Option<f64>,
    /// The anisotropy in decibels over that of isotropic sets.
    pub anisotropy: f64,
    /// The radial curve of the mean spectrum.
    pub curve: Vec<Annulus>,
}

impl Blue {
    /// Measures sets of about as many samples each, one set or more.
    pub fn of(context: &Context, sets: &[Vec<[f32; 2]>]) -> Result<Self> {
        let domain = Domain::unit(Boundary::Periodic);
        let counts: Vec<usize> = sets.iter().map(Vec::len).collect();
        let (mut spectra, mut rho) = (Vec::new(), Vec::new());
        for set in sets {
            spectra.push(spectrum_up_to(context, &domain, set, counts[0], FREQUENCY_LIMIT + ANNULUS, GRID, None)?);
            rho.push(spacing::rho(context, &domain, set, None)?);
        }
        let spectrum = Periodogram::mean(&spectra)?;
        let width = spectrum.frequency_step()[0].max(ANNULUS);
        let low = spectrum.radial(LOW)?.into_iter().find(|annulus| annulus.frequency < LOW);
        let isotropic = 1.0 / sets.len() as f64;
        Ok(Self {
            counts,
            rho: Summary::of(&rho).mean,
            low_power: low.map_or(f64::NAN, |annulus| annulus.power),
            nyquist: spectrum.effective_nyquist(width).ok(),
            anisotropy: 10.0 * (spectrum.contrast(width, ANISOTROPY_RANGE)? / isotropic).log10(),
            curve: spectrum.radial(width)?,
        })
    }

    /// The number of samples of a set, in the mean.
    pub fn count(&self) -> f64 {
        self.counts.iter().sum::<usize>() as f64 / self.counts.len() as f64
    }

    /// The largest distance between the power of two curves, up to the limit of the shorter one.
    pub fn difference(&self, other: &Self) -> f64 {
        let pairs = self.curve.iter().zip(&other.curve);
        pairs.map(|(own, other)| (own.power - other.power).abs()).fold(0.0, f64::max)
    }
}
