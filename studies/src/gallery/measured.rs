//! The sets of a sampler and what they are like.

use azulejo::analysis::spectrum::Periodogram;
use azulejo::{Boundary, Context, Domain, Progress, Result};

use super::Effort;
use super::samplers::Sampler;
use super::zone_plate;
use crate::verdict::Mean;
use azulejo_cli::draw::spectra::{FREQUENCY_LIMIT, spectrum_up_to};
use azulejo_cli::quality::Quality;

/// The extent of the spectrum from which the effective Nyquist frequency and the oscillation are computed, in units of
/// sqrt(density), and the width of its annuli.
const FREQUENCY_REACH: f64 = 7.0;
const ANNULUS: f64 = 0.02;

/// Frequencies per side of a spectrum, at most: all of those up to the limit.
const GRID: usize = 1501;

/// A sampler with its sets.
pub struct Measured {
    pub sampler: Sampler,
    pub sets: u64,
    /// The first set.
    pub first: Vec<[f32; 2]>,
    /// The mean spectrum up to the limit of pictures.
    pub spectrum: Periodogram,
    /// The figures of each set.
    pub quality: Vec<Quality>,
    /// Effective Nyquist frequency and oscillation of the mean spectrum; NaN where they are not defined.
    pub nyquist: f64,
    pub oscillation: f64,
    /// The zone plate of the first set, and the errors of all sets' plates.
    pub plate: Vec<f64>,
    pub errors: Vec<zone_plate::Errors>,
}

impl Measured {
    pub fn of(context: &Context, sampler: Sampler, effort: &Effort, progress: &Progress) -> Result<Self> {
        let domain = Domain::unit(Boundary::Periodic);
        let (sets, count) = (sampler.sets(effort), effort.side * effort.side);
        let (mut near, mut far) = (Vec::new(), Vec::new());
        let (mut quality, mut errors) = (Vec::new(), Vec::new());
        let (mut first, mut first_plate) = (Vec::new(), Vec::new());
        for seed in 0..sets {
            let points = sampler.sample(context, effort.side, seed)?;
            quality.push(Quality::of(context, &domain, &points)?);
            near.push(spectrum_up_to(context, &domain, &points, count, FREQUENCY_LIMIT + ANNULUS, GRID, None)?);
            far.push(spectrum_up_to(context, &domain, &points, count, FREQUENCY_REACH, GRID, None)?);
            let plate = zone_plate::sampled(&points, effort.side);
            errors.push(zone_plate::Errors::of(&plate, effort.side));
            if seed == 0 {
                (first, first_plate) = (points, plate);
            }
            _ = progress((seed + 1) as f64 / sets as f64);
        }
        let far = Periodogram::mean(&far)?;
        let width = far.frequency_step()[0].max(ANNULUS);
        Ok(Self {
            sampler,
            sets,
            first,
            spectrum: Periodogram::mean(&near)?,
            quality,
            nyquist: far.effective_nyquist(width).unwrap_or(f64::NAN),
            oscillation: far.oscillation(width).unwrap_or(f64::NAN),
            plate: first_plate,
            errors,
        })
    }

    /// A figure in the mean of the sets.
    pub fn mean(&self, figure: impl Fn(&Quality) -> f64) -> Mean {
        Mean::of(&self.quality.iter().map(figure).collect::<Vec<_>>())
    }

    /// An error in the mean of the sets.
    pub fn error(&self, error: impl Fn(&zone_plate::Errors) -> f64) -> Mean {
        Mean::of(&self.errors.iter().map(error).collect::<Vec<_>>())
    }
}
