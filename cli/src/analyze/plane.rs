//! Sets of the plane, measured.

use azulejo::analysis::coverage::coverage_2d;
use azulejo::analysis::distribution::{RadialDistribution, radial_distribution};
use azulejo::analysis::figures::figures_2d;
use azulejo::analysis::spacing::{nearest_histogram_2d, spacing_2d};
use azulejo::analysis::spectrum::{Annulus, Periodogram};
use azulejo::{Context, Domain, Error, Progress, Result};

use super::Set;
use super::classes::ByClass;
use super::figures::{Figure, Row};
use crate::draw::spectra::spectrum_up_to;
use crate::formats::blame;
use crate::formats::set::PlaneSet;
use crate::progress::{part, watched};
use crate::quality::Quality;

/// The frequency up to which the spectrum is measured, in units of sqrt(density): the oscillation needs about 6.1 for
/// most sets. The largest number of frequencies per side, and the least width of an annulus.
const FREQUENCY_REACH: f64 = 7.0;
const GRID: usize = 1501;
const ANNULUS: f64 = 0.02;

/// The frequencies at which the contrast is measured, in units of sqrt(density), as in docs/kdrt.md.
const CONTRAST_RANGE: std::ops::Range<f64> = 0.5..2.0;

/// The distance up to which pairs are counted, and the number of bins; the same for nearest neighbours. In units of
/// `d_max`.
pub const PAIR_REACH: f64 = 5.0;
const PAIR_BINS: usize = 250;
pub const NEAREST_REACH: f64 = 1.5;
pub const NEAREST_BINS: usize = 75;

/// The largest relative difference between the sizes of sets of one kind.
const SAME: f64 = 0.1;

/// The figures of a single set, and of all sets together.
const FIGURES: [Figure; 12] = [
    Figure::new("points", "points", ""),
    Figure::new("smallest_distance", "smallest distance", ""),
    Figure::new("rho", "smallest distance, relative (ρ)", "d_max"),
    Figure::new("nearest_mean", "distance of nearest, mean", "d_max"),
    Figure::new("covering_radius", "covering radius", ""),
    Figure::new("covering_radius_relative", "covering radius, relative", "d_max"),
    Figure::new("bond_order", "bond order ψ6", ""),
    Figure::new("obtuse", "obtuse triangles, share", ""),
    Figure::new("below_30_degrees", "triangles with less than 30°, share", ""),
    Figure::new("edge_variation", "edge lengths, variance / mean²", ""),
    Figure::new("low_power", "power below 0.25 √density", ""),
    Figure::new("contrast", "contrast of the spectrum", ""),
];

/// The number of figures, the first ones, that are measured of each class alone.
const OF_CLASSES: usize = 6;

pub const RADIUS_FIGURES: [Figure; 3] = [
    Figure::new("smallest_over_radius", "smallest distance / radius", ""),
    Figure::new("covering_over_radius", "covering radius / radius", ""),
    Figure::new("gaps", "gaps", ""),
];

/// Gaps that are no deeper than this, in radii, are due to rounding: the library's maximal sets may have them.
pub const SHALLOW: f64 = 1e-6;
const SPECTRAL_FIGURES: [Figure; 2] = [
    Figure::new("effective_nyquist", "effective Nyquist frequency", "√density"),
    Figure::new("oscillation", "oscillation Ω", ""),
];

/// The figures and curves of all sets.
pub struct Measured {
    pub rows: Vec<Row>,
    /// The radial curves of the mean spectrum.
    pub annuli: Vec<Annulus>,
    /// The radial distribution function; none for sets that are too small for it.
    pub distribution: Option<RadialDistribution>,
    /// The share of the points in each bin of distances to the nearest neighbour.
    pub nearest: Vec<f64>,
    pub classes: ByClass,
}

/// The measurements of one set.
struct One {
    figures: Vec<f64>,
    spectrum: Periodogram,
    distribution: Option<RadialDistribution>,
    nearest: Vec<u64>,
}

impl Measured {
    pub fn of(context: &Context, domain: &Domain, sets: &[Set<PlaneSet>], radius: Option<f64>) -> Result<Self> {
        let count = sets[0].loaded.points.len();
        let mut ones = Vec::new();
        watched("measure", |progress: &Progress| {
            for (i, set) in sets.iter().enumerate() {
                let share = 1.0 / sets.len() as f64;
                let progress = part(progress, i as f64 * share, (i + 1) as f64 * share);
                let one = One::of(context, domain, set, count, radius, &progress);
                ones.push(one.map_err(|error| blame(&set.path, error))?);
            }
            Ok(())
        })?;
        let spectra: Vec<_> = ones.iter().map(|one| one.spectrum.clone()).collect();
        let spectrum = Periodogram::mean(&spectra)?;
        let width = spectrum.frequency_step().into_iter().fold(ANNULUS, f64::max);
        let figures = FIGURES.iter().chain(RADIUS_FIGURES.iter().filter(|_| radius.is_some()));
        let row =
            |(i, &figure): (usize, &Figure)| Row { figure, values: ones.iter().map(|one| one.figures[i]).collect() };
        let mut rows: Vec<_> = figures.enumerate().map(row).collect();
        // Neither is defined for every set.
        let together = [spectrum.effective_nyquist(width), spectrum.oscillation(width)];
        rows.extend(
            std::iter::zip(SPECTRAL_FIGURES, together)
                .map(|(figure, value)| Row { figure, values: vec![value.unwrap_or(f64::NAN)] }),
        );
        let distributions: Option<Vec<_>> = ones.iter().map(|one| one.distribution.clone()).collect();
        let total: f64 = sets.iter().map(|set| set.loaded.points.len() as f64).sum();
        let share = |bin: usize| ones.iter().map(|one| one.nearest[bin]).sum::<u64>() as f64 / total;
        Ok(Self {
            rows,
            annuli: spectrum.radial(width)?,
            distribution: distributions.map(|all| RadialDistribution::mean(&all)).transpose()?,
            nearest: (0..NEAREST_BINS).map(share).collect(),
            classes: ByClass::of(sets, &FIGURES[..OF_CLASSES], |points, progress| {
                of_class(context, domain, points, progress)
            })?,
        })
    }
}

/// The figures of a class by itself.
fn of_class(context: &Context, domain: &Domain, points: &[[f32; 2]], progress: &Progress) -> Result<Vec<f64>> {
    let figured = figures_2d(context, domain, points, Some(progress))?;
    let (spacing, covering) = (spacing_2d(domain, &figured.nearest), figured.covering_radius);
    let [rho, mean, cover] = [spacing.smallest, spacing.mean, covering].map(|length| length / spacing.hexagonal);
    Ok(vec![points.len() as f64, spacing.smallest, rho, mean, covering, cover])
}

impl One {
    /// The figures of a set of about `count` points.
    fn of(
        context: &Context,
        domain: &Domain,
        set: &Set<PlaneSet>,
        count: usize,
        radius: Option<f64>,
        progress: &Progress,
    ) -> Result<Self> {
        let points = &set.loaded.points;
        if (points.len() as f64 / count as f64 - 1.0).abs() > SAME {
            let reason = format!("{} points, not about {count}: only sets of one kind have a mean", points.len());
            return Err(Error::Format { path: set.path.clone(), reason });
        }
        let unit = domain.hexagonal_distance(points.len());
        let figured = figures_2d(context, domain, points, Some(&part(progress, 0.0, 0.4)))?;
        let covering = figured.covering_radius;
        let reach = FREQUENCY_REACH;
        let progressing = part(progress, 0.4, 0.6);
        let spectrum = spectrum_up_to(context, domain, points, count, reach, GRID, Some(&progressing))?;
        let quality = Quality::with(context, domain, points, &figured, Some(&part(progress, 0.6, 0.65)))?;
        let smallest = quality.rho * unit;
        let mut figures = vec![
            points.len() as f64,
            smallest,
            quality.rho,
            quality.mean_distance,
            covering,
            quality.cover,
            quality.order,
            quality.obtuse,
            quality.sharp,
            quality.edge_variation,
            quality.low_power,
            spectrum.contrast(ANNULUS, CONTRAST_RANGE)?,
        ];
        if let Some(radius) = radius {
            let gaps =
                coverage_2d(context, domain, points, radius * (1.0 + SHALLOW), Some(&part(progress, 0.65, 0.8)))?.gaps;
            figures.extend([smallest / radius, covering / radius, gaps as f64]);
        }
        // Distances above half the domain are not all present.
        let reach = PAIR_REACH * unit <= 0.5 * domain.extent().into_iter().fold(f64::INFINITY, f64::min);
        let pairs =
            || radial_distribution(context, domain, points, PAIR_REACH, PAIR_BINS, Some(&part(progress, 0.8, 1.0)));
        let distribution = (reach && points.len() > 1).then(pairs).transpose()?;
        let nearest = nearest_histogram_2d(domain, &figured.nearest, NEAREST_REACH, NEAREST_BINS)?;
        Ok(Self { figures, spectrum, distribution, nearest })
    }
}
