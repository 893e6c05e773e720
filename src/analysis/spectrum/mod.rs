//! Power spectra of point sets: periodogram, radial mean, anisotropy, contrast and peaks (thesis §1.4.1).
//!
//! The periodogram of N points is P(f) = |Σ exp(-2πi f·x)|² / N: 1 on average for a Poisson process, at every frequency
//! but 0 (Ulichney 1988, "Dithering with blue noise"; Lagae and Dutré 2008, "A comparison of methods for generating
//! Poisson disk distributions"). The thesis's eq. 1.4 prints the amplitude; power is its square.
//!
//! A *periodic* domain has exact frequencies: whole numbers of waves per period. A *bounded* domain is taken for a
//! window onto a larger set. Cut out sharply, it would show the cross of its edges; so its points are weighted by the taper
//! (1 - ρ²)², ρ being 0 at the centre and 1 on the inscribed ellipse or ellipsoid, and the transform of the taper alone,
//! which a set without any structure would leave around frequency 0, is subtracted.
//!
//! *In space* the frequencies are those of a ball ([`periodogram_3d`]). Whatever a sampler does along planes across the axes,
//! such as the faces of blocks, stands out on the three axes of frequencies and hardly in the radial mean: [`axis_power`].

mod aliasing;
mod radial;
mod transform;

use std::f64::consts::PI;

use rustfft::num_complex::Complex;

use crate::check;
use crate::error::{Error, Result};
use crate::job::{Context, Job, Progress};
use crate::math::{cos, hypot, power, side, sin, square};
use crate::memory;
use crate::points::{Boundary, Domain};

use transform::{Weighted, bytes, transform};

pub use radial::{Annulus, Peak};

/// The largest side of a periodogram.
pub const MAX_SIZE: usize = 4096;

/// The largest stride between the frequencies of a periodogram.
pub const MAX_STRIDE: usize = 4096;

/// The largest number of frequencies along an axis.
pub const MAX_AXIS_COUNT: usize = 1 << 16;

/// Beyond this argument the taper's transform, about 38 / s^3.5 or 105 / s^4, is below 4e-7 of its peak.
const TAPER_REACH: f64 = 200.0;

/// The power of a point set on a grid of frequencies.
///
/// Frequencies are in units of one over the mean spacing: sqrt(density) in the plane, which is sqrt(N) waves per period on
/// a unit square, and cbrt(density) in space. Sets of different size can be compared, and the first ring of blue noise lies
/// near 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Periodogram<const D: usize = 2> {
    size: [usize; D],
    frequency_step: [f64; D],
    /// The length up to which the grid has all frequencies.
    reach: f64,
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
/// finite, or none in the domain (`positions`); [`Error::TooLarge`] for more points or frequencies than memory holds;
/// [`Error::Cancelled`].
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
    let set = Tapered::new(domain, points)?;
    let frequency_step = set.frequency_step(stride);
    // The power of a half of the frequencies, and then of all; and the points laid over each other.
    let needed = bytes([size / 2; 2], points.len(), context.num_threads())
        + 6.0 * square(size as f64)
        + (size_of::<Weighted<2>>() * points.len()) as f64;
    memory::require(needed, "size", &format!("{} points and {size} by {size} frequencies", points.len()))?;
    let power = context.run(progress, |job| set.power(job, [size; 2], stride))?;
    Ok(Periodogram { size: [size; 2], frequency_step, reach: largest_circle(size, frequency_step), power })
}

/// The periodogram of `points` of a cuboid, with all frequencies up to the length `reach`, in units of cbrt(density), and
/// others in the corners of the box around them. Frequency 0 is in the middle of each axis. `stride` is that of
/// [`sparse_periodogram`].
///
/// On a periodic domain all points count, on a bounded one those inside it (see the [module](self)). The power at
/// frequency 0, which is only the number of points, is 0.
///
/// O(points + frequencies · log frequencies) in time; in memory about 90 bytes per point and 25 per frequency, of which there
/// are 8 · (reach / stride)³ for each point.
///
/// # Errors
/// [`Error::InvalidArgument`] for a malformed domain, a `stride` outside of 1 to [`MAX_STRIDE`] (`frequency_stride`), a `reach`
/// that is not positive and finite, below the lowest frequency, or above 2,047 frequencies along an axis (`frequency_reach`),
/// points that are not finite, or none in the domain (`positions`); [`Error::TooLarge`] if the memory does not hold the
/// frequencies (`frequency_reach`); [`Error::Cancelled`].
pub fn periodogram_3d(
    context: &Context,
    domain: &Domain<3>,
    points: &[[f32; 3]],
    reach: f64,
    stride: usize,
    progress: Option<&Progress>,
) -> Result<Periodogram<3>> {
    const ARGUMENT: &str = "frequency_reach";
    domain.check()?;
    check::positive(ARGUMENT, reach)?;
    check::range("frequency_stride", stride, 1..=MAX_STRIDE)?;
    check::finite("positions", "point", points)?;
    let set = Tapered::new(domain, points)?;
    let frequency_step = set.frequency_step(stride);
    // A reach that is meant to be a multiple of the step has its last frequency, whatever the rounding.
    let along = frequency_step.map(|step| (reach / step * (1.0 + 1e-12)).floor());
    let most = along.into_iter().fold(0.0, f64::max);
    if most == 0.0 {
        let lowest = frequency_step.into_iter().fold(f64::INFINITY, f64::min);
        return Err(Error::invalid(ARGUMENT, format!("{reach} is below the lowest frequency, {lowest}")));
    }
    if 2.0 * most >= MAX_SIZE as f64 {
        let limit = (MAX_SIZE - 1) / 2;
        return Err(Error::invalid(
            ARGUMENT,
            format!("{reach} is {most} frequencies along an axis; the limit is {limit}"),
        ));
    }
    let half = along.map(|along| along as usize);
    let size = half.map(|half| 2 * half + 1);
    // The power of a half of the frequencies, and then of all; and the points laid over each other.
    let values = 6.0 * size.into_iter().map(|size| size as f64).product::<f64>();
    let laid_over = (size_of::<Weighted<3>>() * points.len()) as f64;
    let needed = bytes(half, points.len(), context.num_threads()) + values + laid_over;
    memory::require(needed, ARGUMENT, &format!("{} by {} by {} frequencies", size[0], size[1], size[2]))?;
    let power = context.run(progress, |job| set.power(job, size, stride))?;
    Ok(Periodogram { size, frequency_step, reach, power })
}

/// The radial curves of [`periodogram_3d`] in shells of `width`, as [`Periodogram::radial`] gives them. The width is refused
/// before any work.
///
/// # Errors
/// Those of both.
pub fn radial_power_3d(
    context: &Context,
    domain: &Domain<3>,
    points: &[[f32; 3]],
    reach: f64,
    stride: usize,
    width: f64,
    progress: Option<&Progress>,
) -> Result<Vec<Annulus>> {
    check::positive("width", width)?;
    periodogram_3d(context, domain, points, reach, stride, progress)?.radial(width)
}

/// The power of `points` of the plane or of a cuboid at 1, 2, ... `count` waves along one side of the domain: at frequencies
/// on an axis, which are those of the points' coordinates along it. Exact and without a grid in the other directions, so that
/// any number of points and of frequencies will do.
///
/// O(points + count · log count) in time; in memory some 70 bytes per point and 80 per frequency.
///
/// # Errors
/// [`Error::InvalidArgument`] for a malformed domain, an `axis` that the domain does not have, a `count` outside of 1 to
/// [`MAX_AXIS_COUNT`], points that are not finite, or none in the domain (`positions`); [`Error::TooLarge`] if the memory does
/// not hold the points (`positions`); [`Error::Cancelled`].
pub fn axis_power<const D: usize>(
    context: &Context,
    domain: &Domain<D>,
    points: &[[f32; D]],
    axis: usize,
    count: usize,
    progress: Option<&Progress>,
) -> Result<Vec<f64>> {
    domain.check()?;
    check::range("axis", axis, 0..=D - 1)?;
    check::range("count", count, 1..=MAX_AXIS_COUNT)?;
    check::finite("positions", "point", points)?;
    let needed = bytes([count], points.len(), context.num_threads())
        + ((size_of::<Weighted<D>>() + size_of::<Weighted<1>>()) * points.len()) as f64;
    memory::require(needed, "positions", &format!("{} points", points.len()))?;
    let set = Tapered::new(domain, points)?;
    let along = set.points.iter().map(|point| Weighted { turns: [point.turns[axis]], weight: point.weight });
    let along: Vec<_> = along.collect();
    context.run(progress, |job| {
        let power = |[k]: [i64; 1], sum| {
            let mut frequency = [0.0; D];
            frequency[axis] = k as f64;
            set.power_of(frequency, sum)
        };
        let power = transform(job, &along, [count], power)?;
        Ok((1..=count as i64).map(|k| power.at([k])).collect())
    })
}

/// A set as it is transformed: weighted, places counted in sides of the domain from its centre.
struct Tapered<const D: usize> {
    domain: Domain<D>,
    points: Vec<Weighted<D>>,
    /// The sums of the weights and of their squares.
    weight: f64,
    energy: f64,
    /// One over the mean spacing.
    density_root: f64,
}

impl<const D: usize> Tapered<D> {
    /// Refuses a set without a point in the domain, or with more than memory holds.
    fn new(domain: &Domain<D>, points: &[[f32; D]]) -> Result<Self> {
        memory::require_points("positions", points.len(), size_of::<Weighted<D>>() as f64)?;
        let extent = domain.extent();
        let weighted = points.iter().map(|point| {
            let turns: [f64; D] = std::array::from_fn(|axis| {
                let centre = 0.5 * (domain.min[axis] + domain.max[axis]);
                (point[axis] as f64 - centre) / extent[axis]
            });
            let weight = match domain.boundary {
                Boundary::Periodic => 1.0,
                Boundary::Bounded => square((1.0 - 4.0 * turns.into_iter().map(square).sum::<f64>()).max(0.0)),
            };
            Weighted { turns, weight }
        });
        let weighted: Vec<_> = weighted.filter(|point| point.weight > 0.0).collect();
        let energy: f64 = weighted.iter().map(|point| point.weight * point.weight).sum();
        if energy == 0.0 {
            return Err(Error::invalid("positions", "no point in the domain".to_owned()));
        }
        let weight = weighted.iter().map(|point| point.weight).sum::<f64>();
        let density = match domain.boundary {
            Boundary::Periodic => points.len() as f64 / domain.content(),
            Boundary::Bounded => weight / (domain.content() * taper_mean::<D>()),
        };
        Ok(Self { domain: *domain, points: weighted, weight, energy, density_root: side::<D>(density) })
    }

    /// The distances of neighbouring frequencies.
    fn frequency_step(&self, stride: usize) -> [f64; D] {
        self.domain.extent().map(|length| stride as f64 / (length * self.density_root))
    }

    /// The power at a frequency, in waves along the sides, of which this is the Fourier sum.
    fn power_of(&self, frequency: [f64; D], sum: Complex<f64>) -> f64 {
        (square(sum.re - self.mean(frequency)) + square(sum.im)) / self.energy
    }

    /// The sum that is expected of points without any structure: the transform of the taper, or of the whole torus. Real,
    /// because places are counted from the centre.
    fn mean(&self, frequency: [f64; D]) -> f64 {
        let waves = frequency.into_iter().fold(0.0, hypot);
        match self.domain.boundary {
            Boundary::Periodic if waves == 0.0 => self.weight,
            Boundary::Periodic => 0.0,
            Boundary::Bounded => self.weight * taper_transform::<D>(PI * waves),
        }
    }

    /// The power at `size` frequencies along each axis, the first axis changing fastest; 0 at frequency 0.
    fn power(&self, job: &Job, size: [usize; D], stride: usize) -> Result<Vec<f32>> {
        let stride = stride as f64;
        let laid_over: Vec<_> = self
            .points
            .iter()
            .map(|point| Weighted { turns: point.turns.map(|turns| stride * turns), weight: point.weight })
            .collect();
        let power = |frequency: [i64; D], sum| {
            if frequency == [0; D] { 0.0 } else { self.power_of(frequency.map(|k| stride * k as f64), sum) as f32 }
        };
        let half = size.map(|size| size / 2);
        let power = transform(&job.part(0.0, 0.9), &laid_over, half, power)?;
        let row = |row: usize| {
            let mut frequency = [0; D];
            let mut rest = row;
            for axis in 1..D {
                frequency[axis] = (rest % size[axis]) as i64 - half[axis] as i64;
                rest /= size[axis];
            }
            let along = (0..size[0]).map(|column| {
                frequency[0] = column as i64 - half[0] as i64;
                power.at(frequency)
            });
            along.collect()
        };
        job.part(0.9, 1.0).flat_map(size[1..].iter().product(), row)
    }
}

/// The mean of the taper over the domain: 1/3 of the ellipse, which has π/4 of it, 8/35 of the ellipsoid, which has π/6.
fn taper_mean<const D: usize>() -> f64 {
    if D == 2 { PI / 12.0 } else { 4.0 * PI / 105.0 }
}

/// The radius of the largest circle of frequencies in a square grid.
fn largest_circle(size: usize, frequency_step: [f64; 2]) -> f64 {
    (size - size / 2 - 1) as f64 * frequency_step[0].min(frequency_step[1])
}

/// The Fourier transform of (1 - ρ²)² on the unit disk or ball at the angular frequency `s`, 1 at 0: 48 J₃(s) / s³, or 105
/// j₃(s) / s³ with the spherical Bessel function. By Poisson's integral for these, which the rectangle rule solves to machine
/// precision for even powers of the sine, and to 1e-10 for the odd ones with more nodes.
fn taper_transform<const D: usize>(s: f64) -> f64 {
    if s > TAPER_REACH {
        return 0.0;
    }
    let nodes = if D == 2 { 16 } else { 64 } + s as usize;
    let angles = (0..nodes).map(|i| (i as f64 + 0.5) * PI / nodes as f64);
    let (wave, all) = angles.fold((0.0, 0.0), |(wave, all), angle| {
        let weight = power(sin(angle), D as u32 + 4);
        (wave + weight * cos(s * cos(angle)), all + weight)
    });
    wave / all
}

impl<const D: usize> Periodogram<D> {
    /// Frequencies along each axis.
    pub fn sizes(&self) -> [usize; D] {
        self.size
    }

    /// The power, row by row, the lowest frequency first; 1 for a Poisson process.
    pub fn power(&self) -> &[f32] {
        &self.power
    }

    /// The distance of neighbouring columns, rows and, in space, layers, in units of one over the mean spacing.
    pub fn frequency_step(&self) -> [f64; D] {
        self.frequency_step
    }
}

impl Periodogram {
    /// Frequencies per side.
    pub fn size(&self) -> usize {
        self.size[0]
    }

    /// The mean of periodograms of sets of one kind; their speckle fades with the square root of their number.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for no periodogram, or different sizes.
    pub fn mean(of: &[Self]) -> Result<Self> {
        let Some(first) = of.first() else { return Err(Error::invalid("periodograms", "there is none")) };
        if let Some(other) = of.iter().find(|other| other.size != first.size) {
            return Err(Error::invalid("periodograms", format!("sizes {} and {} differ", first.size(), other.size())));
        }
        let share = 1.0 / of.len() as f64;
        let power = (0..first.power.len()).map(|i| (of.iter().map(|p| p.power[i] as f64).sum::<f64>() * share) as f32);
        let step = |axis: usize| of.iter().map(|p| p.frequency_step[axis]).sum::<f64>() * share;
        let frequency_step = [step(0), step(1)];
        let reach = largest_circle(first.size(), frequency_step);
        Ok(Self { size: first.size, frequency_step, reach, power: power.collect() })
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
