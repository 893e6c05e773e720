//! Power spectra of point sets: periodogram, radial mean, anisotropy, contrast and peaks (thesis §1.4.1).
//!
//! The periodogram of N points is P(f) = |Σ exp(-2πi f·x)|² / N: 1 on average for a Poisson process, at every frequency
//! but 0 (Ulichney 1988, "Dithering with blue noise"; Lagae and Dutré 2008, "A comparison of methods for generating
//! Poisson disk distributions"). The thesis's eq. 1.4 prints the amplitude; power is its square.
//!
//! A *periodic* domain has exact frequencies: whole numbers of waves per period. A *bounded* domain is taken for a
//! window onto a larger set. Cut out sharply, it would show the cross of its four edges; so its points are weighted by
//! the taper (1 - ρ²)², ρ being 0 at the centre and 1 on the inscribed ellipse, and the transform of the taper alone,
//! which a set without any structure would leave around frequency 0, is subtracted.

mod aliasing;
mod radial;
mod transform;

use std::f64::consts::PI;

use crate::check;
use crate::error::{Error, Result};
use crate::job::{Context, Progress};
use crate::math::{cos, hypot, power, sin, square};
use crate::points::{Boundary, Domain};

use transform::{Coefficients, Weighted, transform};

pub use radial::{Annulus, Peak};

/// The largest side of a periodogram.
pub const MAX_SIZE: usize = 4096;

/// The largest stride between the frequencies of a periodogram.
pub const MAX_STRIDE: usize = 4096;

/// Beyond this argument the taper's transform, about 38 / s^3.5, is below 4e-7 of its peak.
const TAPER_REACH: f64 = 200.0;

/// The power of a point set on a square grid of frequencies.
///
/// Frequencies are in units of sqrt(density), which is sqrt(N) waves per period on a unit square: sets of different
/// size can be compared, and the first ring of blue noise lies near 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Periodogram {
    size: usize,
    frequency_step: [f64; 2],
    power: Vec<f32>,
}

/// The periodogram of `points`, `size` by `size` frequencies with frequency 0 in row and column `size / 2`.
///
/// On a periodic domain all points count, on a bounded one those inside it (see the [module](self)). The power at
/// frequency 0, which is only the number of points, is 0.
///
/// O(points + size² log size) in time, 100,000 points at size 1,600 take about 0.2 s on one core; in memory about 40
/// bytes per point and as many per frequency.
///
/// # Errors
/// [`Error::InvalidArgument`] for a malformed domain, a `size` outside of 2 to [`MAX_SIZE`], points that are not
/// finite, or none in the domain (`positions`); [`Error::Cancelled`].
pub fn periodogram(
    context: &Context,
    domain: &Domain,
    points: &[[f32; 2]],
    size: usize,
    progress: Option<&Progress>,
) -> Result<Periodogram> {
    sparse_periodogram(context, domain, points, size, 1, progress)
}

/// A periodogram that takes only every `stride`-th frequency along both axes, exactly: the Fourier sums at multiples of
/// a frequency are those of the points laid over each other in a period of it. With it the radial curves of large sets
/// reach as far as those of small ones, in the same time.
///
/// # Errors
/// As [`periodogram`]; and [`Error::InvalidArgument`] for a `stride` outside of 1 to [`MAX_STRIDE`].
pub fn sparse_periodogram(
    context: &Context,
    domain: &Domain,
    points: &[[f32; 2]],
    size: usize,
    stride: usize,
    progress: Option<&Progress>,
) -> Result<Periodogram> {
    domain.check()?;
    check::range("frequency_stride", stride, 1..=MAX_STRIDE)?;
    check::range("size", size, 2..=MAX_SIZE)?;
    check::finite("positions", "point", points)?;
    let weighted = weigh(domain, points, stride as f64);
    let energy: f64 = weighted.iter().map(|point| point.weight * point.weight).sum();
    if energy == 0.0 {
        return Err(Error::invalid("positions", "no point in the domain".to_owned()));
    }
    let density = match domain.boundary {
        Boundary::Periodic => points.len() as f64 / domain.area(),
        // The mean of the taper over its ellipse is 1/3, and the ellipse has π/4 of the domain.
        Boundary::Bounded => weighted.iter().map(|p| p.weight).sum::<f64>() / (domain.area() * PI / 12.0),
    };
    let mean = Mean { weight: weighted.iter().map(|point| point.weight).sum(), boundary: domain.boundary };
    let half = size / 2;
    let power = |waves: &Coefficients, row: usize| {
        let power = (0..size).map(|column| match [column, row].map(|k| k as i64 - half as i64) {
            [0, 0] => 0.0,
            [column, row] => {
                let [x, y] = [column, row].map(|k| (stride as i64 * k) as f64);
                let wave = waves.at(column, row);
                ((square(wave.re - mean.transform(y, x)) + square(wave.im)) / energy) as f32
            }
        });
        power.collect()
    };
    let power = context.run(progress, |job| {
        let waves = transform(&job.part(0.0, 0.9), &weighted, half)?;
        job.part(0.9, 1.0).flat_map(size, |row| power(&waves, row))
    })?;
    let frequency_step = domain.extent().map(|length| stride as f64 / (length * density.sqrt()));
    Ok(Periodogram { size, frequency_step, power })
}

/// The points with their weights, their places in periods of the lowest frequency.
fn weigh(domain: &Domain, points: &[[f32; 2]], stride: f64) -> Vec<Weighted> {
    let extent = domain.extent();
    let weighted = points.iter().map(|point| {
        let turns: [f64; 2] = std::array::from_fn(|axis| {
            let centre = 0.5 * (domain.min[axis] + domain.max[axis]);
            (point[axis] as f64 - centre) / extent[axis]
        });
        let weight = match domain.boundary {
            Boundary::Periodic => 1.0,
            Boundary::Bounded => square((1.0 - 4.0 * (turns[0] * turns[0] + turns[1] * turns[1])).max(0.0)),
        };
        Weighted { turns: turns.map(|turns| stride * turns), weight }
    });
    weighted.filter(|point| point.weight > 0.0).collect()
}

/// The expectation for points without any structure: the transform of the taper, or of the whole torus.
struct Mean {
    weight: f64,
    boundary: Boundary,
}

impl Mean {
    /// Real, because places are counted from the centre.
    fn transform(&self, row: f64, column: f64) -> f64 {
        let waves = hypot(row, column);
        match self.boundary {
            Boundary::Periodic if waves == 0.0 => self.weight,
            Boundary::Periodic => 0.0,
            Boundary::Bounded => self.weight * taper_transform(PI * waves),
        }
    }
}

/// The Fourier transform of (1 - ρ²)² on the unit disk at the angular frequency `s`, 1 at 0: 48 J₃(s) / s³, by
/// Poisson's integral for the Bessel function, which the rectangle rule solves to machine precision.
fn taper_transform(s: f64) -> f64 {
    if s > TAPER_REACH {
        return 0.0;
    }
    let nodes = 16 + s as usize;
    let angles = (0..nodes).map(|i| (i as f64 + 0.5) * PI / nodes as f64);
    let (wave, all) = angles.fold((0.0, 0.0), |(wave, all), angle| {
        let weight = power(sin(angle), 6);
        (wave + weight * cos(s * cos(angle)), all + weight)
    });
    wave / all
}

impl Periodogram {
    /// Frequencies per side.
    pub fn size(&self) -> usize {
        self.size
    }

    /// The power, row by row, the lowest frequency first; 1 for a Poisson process.
    pub fn power(&self) -> &[f32] {
        &self.power
    }

    /// The distance of neighbouring columns and rows, in units of sqrt(density).
    pub fn frequency_step(&self) -> [f64; 2] {
        self.frequency_step
    }

    /// The mean of periodograms of sets of one kind; their speckle fades with the square root of their number.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for no periodogram, or different sizes.
    pub fn mean(of: &[Self]) -> Result<Self> {
        let Some(first) = of.first() else { return Err(Error::invalid("periodograms", "there is none")) };
        if let Some(other) = of.iter().find(|other| other.size != first.size) {
            return Err(Error::invalid("periodograms", format!("sizes {} and {} differ", first.size, other.size)));
        }
        let share = 1.0 / of.len() as f64;
        let power = (0..first.power.len()).map(|i| (of.iter().map(|p| p.power[i] as f64).sum::<f64>() * share) as f32);
        let step = |axis: usize| of.iter().map(|p| p.frequency_step[axis]).sum::<f64>() * share;
        Ok(Self { size: first.size, frequency_step: [step(0), step(1)], power: power.collect() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};
    use proptest::prelude::*;
    use std::ops::ControlFlow;

    fn random_points(seed: u64, count: usize, domain: &Domain) -> Vec<[f32; 2]> {
        let mut rng = Rng::at(seed, Draw::Probe, &[]);
        let [width, height] = domain.extent();
        let x = |u: f64, min: f64, length: f64| (min + u * length) as f32;
        (0..count).map(|_| [x(rng.unit(), domain.min[0], width), x(rng.unit(), domain.min[1], height)]).collect()
    }

    /// The definition, taken literally. The weighted mean's transform is summed over a fine grid of the domain.
    fn double_loop(domain: &Domain, points: &[[f32; 2]], column: f64, row: f64) -> f64 {
        let extent = domain.extent();
        let taper = |x: f64, y: f64| match domain.boundary {
            Boundary::Periodic => 1.0,
            Boundary::Bounded => (1.0 - 4.0 * ((x - 0.5).powi(2) + (y - 0.5).powi(2))).max(0.0).powi(2),
        };
        let (mut sum, mut energy, mut weight) = ([0.0; 2], 0.0, 0.0);
        for point in points {
            let [x, y] = std::array::from_fn(|axis| (point[axis] as f64 - domain.min[axis]) / extent[axis]);
            let (w, angle) = (taper(x, y), -2.0 * PI * (column * x + row * y));
            sum = [sum[0] + w * angle.cos(), sum[1] + w * angle.sin()];
            (energy, weight) = (energy + w * w, weight + w);
        }
        let (mut mean, mut all, n) = ([0.0; 2], 0.0, 200);
        for i in 0..n * n {
            let [x, y] = [i % n, i / n].map(|k| (k as f64 + 0.5) / n as f64);
            let (w, angle) = (taper(x, y), -2.0 * PI * (column * x + row * y));
            mean = [mean[0] + w * angle.cos(), mean[1] + w * angle.sin()];
            all += w;
        }
        (0..2).map(|part| (sum[part] - weight / all * mean[part]).powi(2)).sum::<f64>() / energy
    }

    /// A lattice gives its peaks, a set repeated twice gives twice the power, and one point that is moved shows.
    #[test]
    fn the_double_loop_is_that_of_known_sets() {
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            let domain = Domain { min: [3.0, -1.0], max: [5.0, 7.0], boundary };
            let at = |i: usize| [3.0 + (i % 16) as f32 / 8.0 + 0.0625, -1.0 + (i / 16) as f32 / 2.0 + 0.25];
            let mut lattice: Vec<_> = (0..256).map(at).collect();
            let low = |points: &[[f32; 2]]| double_loop(&domain, points, 3.0, 5.0);
            // Of a periodic set all is in the peak; tapered, the square of the mean weight over its mean square.
            let share = if boundary == Boundary::Periodic { 1.0 } else { (PI / 12.0).powi(2) / (PI / 20.0) };
            let peak = double_loop(&domain, &lattice, 16.0, 0.0) / 256.0;
            assert!((peak / share - 1.0).abs() < 0.01, "{boundary:?}: {peak}, not {share}");
            assert!(low(&lattice) < 1e-4, "{boundary:?}: {}", low(&lattice));
            let points = random_points(5, 80, &domain);
            let twice = [&points[..], &points].concat();
            for (column, row) in [(1.0, 0.0), (3.0, 5.0), (-7.0, 2.0)] {
                let [once, twice] = [&points, &twice].map(|points| double_loop(&domain, points, column, row));
                assert!((twice / once - 2.0).abs() < 1e-9, "{boundary:?}: {once}, {twice}");
            }
            lattice[120] = [4.1, 2.8];
            assert!(low(&lattice) > 1e-3, "{boundary:?}: {}", low(&lattice));
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn agrees_with_the_double_loop(
            seed: u64, count in 1usize..60, size in 2usize..40, min in -100.0..100.0f64, width in 0.1..50.0f64,
            height in 0.1..50.0f64, periodic: bool,
        ) {
            let boundary = if periodic { Boundary::Periodic } else { Boundary::Bounded };
            let domain = Domain { min: [min, 2.0], max: [min + width, 2.0 + height], boundary };
            let mut points = random_points(seed, count, &domain);
            points.push([(min + 0.5 * width) as f32, (2.0 + 0.4 * height) as f32]);
            let spectrum = periodogram(&Context::new(1).unwrap(), &domain, &points, size, None).unwrap();
            for (row, column) in [(0, 0), (size / 2, size / 2), (size - 1, 0), (size / 2, size - 1), (0, size - 1)] {
                let [f, g] = [column, row].map(|k| k as f64 - (size / 2) as f64);
                let expected = double_loop(&domain, &points, f, g);
                let power = spectrum.power()[row * size + column] as f64;
                prop_assert!((power - expected).abs() < 1e-5 * (1.0 + expected), "({f}, {g}): {power}, not {expected}");
            }
        }
    }

    #[test]
    fn a_poisson_process_has_power_one_in_every_annulus_and_direction() {
        let context = Context::new(2).unwrap();
        for boundary in [Boundary::Periodic, Boundary::Bounded] {
            let domain = Domain { min: [3.0, -1.0], max: [5.0, 1.0], boundary };
            let one = |seed| periodogram(&context, &domain, &random_points(seed, 2000, &domain), 64, None).unwrap();
            let spectra: Vec<_> = (0..16).map(one).collect();
            let density = 1.0 / (spectra[0].frequency_step()[0] * 2.0).powi(2);
            assert!((density - 500.0).abs() < 30.0, "{density}");
            for annulus in Periodogram::mean(&spectra).unwrap().radial(0.1).unwrap() {
                // The taper correlates about four neighbouring frequencies, and removes the mean near 0.
                if annulus.frequency > 0.1 {
                    assert!((annulus.power - 1.0).abs() < 0.09, "{boundary:?} {annulus:?}");
                    assert!((annulus.anisotropy * 16.0 - 1.0).abs() < 0.35, "{boundary:?} {annulus:?}");
                }
            }
        }
    }

    #[test]
    fn a_lattice_has_peaks_of_power_n_on_the_dual_lattice_and_nothing_else() {
        let domain = Domain::unit(Boundary::Periodic);
        let points: Vec<_> = (0..64).map(|i| [(i % 8) as f32 / 8.0 + 0.01, (i / 8) as f32 / 8.0]).collect();
        let spectrum = periodogram(&Context::new(1).unwrap(), &domain, &points, 33, None).unwrap();
        assert_eq!(spectrum.frequency_step(), [0.125, 0.125]);
        for (i, &power) in spectrum.power().iter().enumerate() {
            let [row, column] = [i / 33, i % 33].map(|k| k as i64 - 16);
            let peak = (row, column) != (0, 0) && row % 8 == 0 && column % 8 == 0;
            let expected = if peak { 64.0 } else { 0.0 };
            assert!((power - expected).abs() < 1e-4, "({column}, {row}): {power}");
        }
        let ring = |frequency: f64| {
            let annuli = spectrum.radial(1e-3).unwrap();
            *annuli.iter().find(|annulus| (annulus.frequency - frequency).abs() < 1e-9).unwrap()
        };
        // Two of the four frequencies of length 1 are independent, and both are peaks.
        assert!((ring(1.0).power - 64.0).abs() < 1e-3 && ring(1.0).anisotropy < 1e-9);
        assert!(ring(0.125).power < 1e-4);
    }

    #[test]
    fn a_window_onto_a_lattice_shows_neither_a_cross_nor_its_mean() {
        let domain = Domain { min: [10.3, 10.7], max: [34.3, 34.7], boundary: Boundary::Bounded };
        let points: Vec<_> = (0..2500).map(|i| [(i % 50) as f32, (i / 50) as f32]).collect();
        let spectrum = periodogram(&Context::new(1).unwrap(), &domain, &points, 64, None).unwrap();
        assert!((spectrum.frequency_step()[0] - 1.0 / 24.0).abs() < 1e-4);
        let peak = spectrum.power().iter().copied().fold(0.0, f32::max);
        assert!(peak > 100.0, "{peak}");
        for (i, &power) in spectrum.power().iter().enumerate() {
            let near = |k: usize| ((k as f64 - 32.0) / 24.0 - ((k as f64 - 32.0) / 24.0).round()).abs() * 24.0;
            let [from_row, from_column] = [near(i / 64), near(i % 64)];
            if from_row.hypot(from_column) > 6.0 || (i / 64).abs_diff(32) + (i % 64).abs_diff(32) < 8 {
                assert!(power < 1e-2, "({}, {}): {power}", i % 64, i / 64);
            }
        }
    }

    #[test]
    fn threads_do_not_change_a_bit_and_progress_cancels() {
        let domain = Domain::unit(Boundary::Bounded);
        let points = random_points(1, 500, &domain);
        let on = |threads| periodogram(&Context::new(threads).unwrap(), &domain, &points, 100, None).unwrap();
        assert!(on(1) == on(3) && on(1) == on(4));
        let stop = |_| ControlFlow::Break(());
        let result = periodogram(&Context::new(2).unwrap(), &domain, &points, 100, Some(&stop));
        assert!(matches!(result, Err(Error::Cancelled)));
    }

    #[test]
    fn arguments_are_refused_by_name() {
        let context = Context::new(1).unwrap();
        let unit = Domain::unit(Boundary::Bounded);
        let refused = |domain: &Domain, points: &[[f32; 2]], size| {
            periodogram(&context, domain, points, size, None).unwrap_err().to_string()
        };
        let point = [[0.5, 0.5]];
        assert!(refused(&Domain { max: [0.0, 1.0], ..unit }, &point, 8).starts_with("domain_max: [0] is 0"));
        assert!(refused(&unit, &point, 1).starts_with("size: 1 is not in 2..=4096"));
        assert!(refused(&unit, &point, 5000).starts_with("size: 5000"));
        assert!(refused(&unit, &[[0.5, f32::NAN]], 8).starts_with("positions: point 0 is [0.5, NaN]"));
        assert!(refused(&unit, &[[1.5, 0.5]], 8).starts_with("positions: no point"));
        let small = periodogram(&context, &unit, &point, 8, None).unwrap();
        let large = periodogram(&context, &unit, &point, 9, None).unwrap();
        assert!(small.radial(0.0).is_err() && small.radial(f64::NAN).is_err());
        assert!(Periodogram::mean(&[]).is_err() && Periodogram::mean(&[small, large]).is_err());
    }
}
