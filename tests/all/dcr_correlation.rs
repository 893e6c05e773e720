//! Relaxation to pair correlations: step and peak spectra by the library's power and by direct sums, correlations that no
//! set has, and a set's own.

use std::f64::consts::TAU;

use azulejo::analysis::distribution::radial_distribution;
use azulejo::analysis::spectrum::{Periodogram, periodogram};
use azulejo::dcr::{CorrelationOptions, CorrelationReport, PairCorrelation, Stopped, relax_to_correlation};
use azulejo::{Boundary, Context, Domain};

use crate::common::sets::{random_points, unit_square};

const COUNT: usize = 4096;

/// The width of annuli, in units of sqrt(density).
const ANNULUS: f64 = 0.02;

fn torus() -> Domain {
    unit_square(Boundary::Periodic)
}

fn run(points: &[[f32; 2]], target: &PairCorrelation) -> (Vec<[f32; 2]>, CorrelationReport) {
    let options = CorrelationOptions::new(torus());
    relax_to_correlation(&Context::new(1).unwrap(), &options, points, target, None).unwrap()
}

fn step(frequency: f64) -> f64 {
    if frequency < 0.5 { 0.0 } else { 1.0 }
}

/// The power of `PairCorrelation::peak(0.6, 0.06, 1.0)`.
fn peak(frequency: f64) -> f64 {
    let t = (frequency - 0.6) / 0.06;
    // The integral of the normal distribution, by small steps.
    let density = |x: f64| (-0.5 * x * x).exp() / TAU.sqrt();
    let rise = 0.5 + (0..1000).map(|i| density(t * (f64::from(i) + 0.5) / 1000.0) * t / 1000.0).sum::<f64>();
    rise + (-0.5 * t * t).exp()
}

/// A power as a function of the frequency.
type Power = fn(f64) -> f64;

/// The root mean square difference between a radial curve, frequencies with powers, and a power.
fn difference(curve: &[[f64; 2]], power: Power) -> f64 {
    let squares: f64 = curve.iter().map(|&[frequency, is]| (is - power(frequency)).powi(2)).sum();
    (squares / curve.len() as f64).sqrt()
}

/// The radial mean up to frequency 2, by the library.
fn radial(spectrum: &Periodogram) -> Vec<[f64; 2]> {
    let annuli = spectrum.radial(ANNULUS).unwrap();
    annuli.iter().map(|of| [of.frequency, of.power]).filter(|of| of[0] < 2.0).collect()
}

/// The same of several sets of [`COUNT`] points of the unit square, by the sum over the points for each frequency.
fn radial_by_sums(sets: &[Vec<[f32; 2]>]) -> Vec<[f64; 2]> {
    let density = (COUNT as f64).sqrt();
    let most = (2.0 * density) as i64;
    let mut sums = vec![[0.0; 3]; (2.0 / ANNULUS) as usize];
    for points in sets {
        // Waves of one column turn from each row to the next.
        let turn = |x: f32| (TAU * f64::from(x)).sin_cos();
        let turns: Vec<_> = points.iter().map(|point| turn(point[1])).collect();
        for column in -most..=most {
            let wave = |point: &[f32; 2]| (TAU * column as f64 * f64::from(point[0])).sin_cos();
            let mut waves: Vec<_> = points.iter().map(wave).collect();
            for row in 0..=most {
                let sum = waves.iter().fold((0.0, 0.0), |sum, wave| (sum.0 + wave.0, sum.1 + wave.1));
                let frequency = ((column * column + row * row) as f64).sqrt() / density;
                let annulus = (frequency / ANNULUS) as usize;
                // Of a frequency and its opposite one.
                if annulus < sums.len() && (row > 0 || column > 0) {
                    let power = (sum.0 * sum.0 + sum.1 * sum.1) / COUNT as f64;
                    (0..3).for_each(|i| sums[annulus][i] += [1.0, frequency, power][i]);
                }
                for ((sin, cos), &(by_sin, by_cos)) in waves.iter_mut().zip(&turns) {
                    (*sin, *cos) = (*sin * by_cos + *cos * by_sin, *cos * by_cos - *sin * by_sin);
                }
            }
        }
    }
    let many = sums.iter().filter(|of| of[0] >= 2.0 * sets.len() as f64);
    many.map(|&[count, frequency, power]| [frequency / count, power / count]).collect()
}

/// Ten sets for each target: the mean power differs from it by less than 0.05, root mean square over annuli of 0.02. What
/// is left of the difference is the step, smoothed over the reach of the forces.
#[test]
fn steps_and_peaks_of_power_are_reached() {
    let context = Context::new(1).unwrap();
    let targets: [(_, Power, _); 2] = [
        (PairCorrelation::step(0.5).unwrap(), step, 0.05),
        (PairCorrelation::peak(0.6, 0.06, 1.0).unwrap(), peak, 0.03),
    ];
    for (target, power, least) in targets {
        let sets: Vec<_> = (0..10).map(|seed| run(&random_points(COUNT, seed), &target)).collect();
        for (_, report) in &sets {
            assert!(report.set.stopped == Stopped::Converged && report.set.iterations < 60, "{report:?}");
            assert!(report.residual <= 0.005 && report.reach > 11.1, "{report:?}");
        }
        let spectra: Vec<_> =
            sets.iter().map(|set| periodogram(&context, &torus(), &set.0, 257, None).unwrap()).collect();
        let mean = difference(&radial(&Periodogram::mean(&spectra).unwrap()), power);
        assert!(mean < least, "{mean}");
        // Of a single set, which has few frequencies in an annulus, and by direct sums.
        let (single, by_sums) = (radial(&spectra[0]), radial_by_sums(&[sets[0].0.clone()]));
        assert_eq!(single.len(), by_sums.len());
        for (a, b) in single.iter().zip(&by_sums) {
            assert!((a[0] - b[0]).abs() < 1e-4 && (a[1] - b[1]).abs() < 0.01 * b[1].max(0.5), "{a:?}, {b:?}");
        }
        let before = difference(&radial_by_sums(&[random_points(COUNT, 0)]), power);
        let after = difference(&by_sums, power);
        assert!(after < 0.08 && before > 5.0 * after, "{before}, {after}");
    }
}

/// g would be -0.5 at distance 0.
#[test]
fn a_correlation_that_no_set_has_ends_with_a_report() {
    let (_, report) = run(&random_points(COUNT, 3), &PairCorrelation::step(0.69).unwrap());
    assert!(report.set.stopped == Stopped::Steps && report.set.iterations == 100, "{report:?}");
    assert!((0.006..0.2).contains(&report.residual), "{report:?}");
    let nowhere = PairCorrelation::new(3.0, &[-2.0; 60]).unwrap();
    let (_, report) = run(&random_points(500, 3), &nowhere);
    assert!(report.set.stopped == Stopped::Steps && report.residual > 0.5 && report.reach == 3.0, "{report:?}");
}

#[test]
fn the_own_correlation_of_a_set_is_reached_at_once_and_by_others() {
    let (points, _) = run(&random_points(COUNT, 4), &PairCorrelation::peak(0.6, 0.06, 1.0).unwrap());
    let context = Context::new(1).unwrap();
    let measured = radial_distribution(&context, &torus(), &points, 12.0, 2400, None).unwrap();
    let share = (COUNT - 1) as f64 / COUNT as f64;
    let values: Vec<f64> = measured.density().iter().map(|value| value * share).collect();
    let own = PairCorrelation::new(12.0, &values).unwrap();
    let (same, report) = run(&points, &own);
    assert!(report.set.stopped == Stopped::Converged && report.set.iterations == 1, "{report:?}");
    assert_eq!(same, points);
    let (_, report) = run(&random_points(COUNT, 5), &own);
    assert!(report.set.stopped == Stopped::Converged && report.set.iterations > 5, "{report:?}");
}

#[test]
fn awkward_sets_and_domains_are_relaxed() {
    let context = Context::new(2).unwrap();
    let target = PairCorrelation::step(0.45).unwrap();
    for count in [0, 1, 2, 3, 17, 200] {
        for [width, height] in [[1.0, 1.0], [100.0, 0.01], [0.3, 7.0]] {
            let domain = Domain { min: [-2.0, 5.0], max: [width - 2.0, height + 5.0], boundary: Boundary::Periodic };
            let place = |point: [f32; 2]| {
                let [x, y] = [point[0] * width as f32 - 2.0, point[1] * height as f32 + 5.0];
                [x.max(-2.0).min((width - 2.0) as f32 - 1e-5), y.clamp(5.0, (height + 5.0) as f32 - 1e-5)]
            };
            // All coincident, and at random.
            for points in [vec![place([0.3, 0.6]); count], random_points(count, 6).into_iter().map(place).collect()] {
                let options = CorrelationOptions::new(domain).max_iterations(20);
                let (relaxed, report) = relax_to_correlation(&context, &options, &points, &target, None).unwrap();
                assert_eq!(relaxed.len(), count);
                assert!(report.residual.is_finite() && report.reach > 0.0, "{report:?}");
                let inside = |point: &[f32; 2]| {
                    (0..2).all(|axis| (domain.min[axis]..domain.max[axis]).contains(&point[axis].into()))
                };
                assert!(relaxed.iter().all(inside), "{count}, {width} by {height}");
                if count < 2 {
                    assert_eq!((relaxed, report.residual), (points, 0.0));
                }
            }
        }
    }
}

#[test]
fn no_steps_leave_the_points_and_tell_the_residual() {
    let points = random_points(1000, 7);
    let target = PairCorrelation::step(0.5).unwrap();
    let options = CorrelationOptions::new(torus()).max_iterations(0);
    let context = Context::new(1).unwrap();
    let (same, report) = relax_to_correlation(&context, &options, &points, &target, None).unwrap();
    assert!(same == points && report.set.stopped == Stopped::Steps && report.residual > 0.3, "{report:?}");
    // Nothing to do is told as such.
    let any = options.tolerance(2.0).max_iterations(5);
    let (same, report) = relax_to_correlation(&context, &any, &points, &target, None).unwrap();
    assert!(same == points && report.set.stopped == Stopped::Converged && report.set.iterations == 1, "{report:?}");
}
