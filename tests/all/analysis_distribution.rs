//! Radial distribution and nearest neighbours against brute force and known sets.

use azulejo::analysis::distribution::{RadialDistribution, radial_distribution};
use azulejo::analysis::spacing::{nearest_distances_2d, nearest_histogram_2d, rho, spacing_2d};
use azulejo::analysis::spectrum::{Periodogram, periodogram, sparse_periodogram};
use azulejo::{Boundary, Context, Domain, Error, maximal};
use proptest::prelude::*;

use crate::common::sets::{distance, random_points, unit_square};

const BOUNDARIES: [Boundary; 2] = [Boundary::Periodic, Boundary::Bounded];

fn context() -> Context {
    Context::new(2).unwrap()
}

fn distribution(domain: &Domain, points: &[[f32; 2]], reach: f64, bins: usize) -> RadialDistribution {
    radial_distribution(&context(), domain, points, reach, bins, None).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// Each pair on its own, by the definition; bins are wide, so that rounding moves hardly any pair to another.
    #[test]
    fn the_distribution_counts_all_pairs(count in 2usize..60, seed: u64, width in 1.0f64..4.0, periodic: bool) {
        let domain = Domain { max: [width, 1.0], ..unit_square(BOUNDARIES[usize::from(!periodic)]) };
        let points: Vec<_> = random_points(count, seed).iter().map(|&[x, y]| [x * width as f32 * 0.999, y]).collect();
        let unit = domain.hexagonal_distance(count);
        let (reach, bins) = (0.5 / unit, 7);
        let mut expected = vec![0.0; bins];
        for i in 0..count {
            for j in (0..count).filter(|&j| j != i) {
                let bin = (distance(&domain, points[i], points[j]) / unit / reach * bins as f64) as usize;
                if bin < bins {
                    let share = |axis: usize| {
                        1.0 - f64::from((points[i][axis] - points[j][axis]).abs()) / domain.extent()[axis]
                    };
                    expected[bin] += if periodic { 1.0 } else { 1.0 / (share(0) * share(1)) };
                }
            }
        }
        let found = distribution(&domain, &points, reach * (1.0 - 1e-9), bins);
        let (density, middles) = (found.density(), found.distances());
        for bin in 0..bins {
            let ring = std::f64::consts::TAU * middles[bin] * (reach / bins as f64) * unit * unit;
            let poisson = (count * (count - 1)) as f64 * ring / (width * 1.0);
            prop_assert!((found.expected()[bin] / poisson - 1.0).abs() < 1e-6);
            prop_assert!((density[bin] * poisson - expected[bin]).abs() < 1e-4 * (1.0 + expected[bin]));
        }
    }
}

#[test]
fn a_poisson_process_has_distribution_one_and_the_mean_of_several_is_nearer() {
    for boundary in BOUNDARIES {
        let domain = unit_square(boundary);
        let of_seed = |seed| distribution(&domain, &random_points(4000, seed), 12.0, 60);
        let all: Vec<_> = (0..8).map(of_seed).collect();
        let mean = RadialDistribution::mean(&all).unwrap();
        // Four and a half standard errors; the pairs of a bounded domain have unequal weights.
        for (density, expected) in std::iter::zip(mean.density(), mean.expected()) {
            assert!((density - 1.0).abs() < 4.5 * 1.1 * (2.0 / expected).sqrt(), "{boundary:?} {density}");
        }
        assert!((mean.expected()[9] / all[0].expected()[9] - 8.0).abs() < 1e-9);
        let one = all[0].density().iter().map(|density| (density - 1.0).abs()).fold(0.0, f64::max);
        assert!(one > (2.0 / all[0].expected()[59]).sqrt(), "too good: {one}");
    }
}

/// Neighbours of a hexagonal lattice are 1, sqrt(3), 2, sqrt(7) and 3 apart: 6, 6, 6, 12 and 6 of them.
#[test]
fn a_hexagonal_lattice_has_peaks_at_its_distances_and_nothing_between() {
    let row = 0.75f64.sqrt();
    let domain = Domain { min: [0.0; 2], max: [20.0, 24.0 * row], boundary: Boundary::Periodic };
    let at = |i: usize, j: usize| [i as f64 + 0.5 * (j % 2) as f64, j as f64 * row].map(|x| x as f32);
    let points: Vec<_> = (0..20 * 24).map(|k| at(k % 20, k / 20)).collect();
    let found = distribution(&domain, &points, 3.05, 305);
    let mut neighbours = vec![0.0; 305];
    for (bin, (density, expected)) in std::iter::zip(found.density(), found.expected()).enumerate() {
        neighbours[bin] = density * expected / points.len() as f64;
    }
    for (distance, count) in [(1.0f64, 6.0), (3f64.sqrt(), 6.0), (2.0, 6.0), (7f64.sqrt(), 12.0), (3.0, 6.0)] {
        // Rounding may take a distance to the bin before.
        let bin = (100.0 * distance + 0.1) as usize;
        let about: f64 = neighbours[bin - 1..=bin].iter().sum();
        assert!((about - count).abs() < 1e-9, "{distance}: {about}");
        neighbours[bin - 1..=bin].fill(0.0);
    }
    assert!(neighbours.iter().all(|&count| count == 0.0));

    let nearest = nearest_distances_2d(&context(), &domain, &points, None).unwrap();
    let spacing = spacing_2d(&domain, &nearest);
    assert!((spacing.smallest - 1.0).abs() < 1e-5 && (spacing.mean - 1.0).abs() < 1e-5);
    assert!((spacing.hexagonal - 1.0).abs() < 1e-12);
    assert_eq!(nearest_histogram_2d(&domain, &nearest, 2.0, 4).unwrap().iter().sum::<u64>(), 480);
}

/// The distance to the nearest point of a Poisson process is d with the density 2πd exp(-πd²), in mean spacings.
#[test]
fn nearest_neighbours_of_random_points_follow_rayleigh() {
    let domain = unit_square(Boundary::Periodic);
    let points = random_points(50_000, 8);
    let nearest = nearest_distances_2d(&context(), &domain, &points, None).unwrap();
    let (reach, bins) = (1.5, 15);
    let histogram = nearest_histogram_2d(&domain, &nearest, reach, bins).unwrap();
    let beyond = |d: f64| (-std::f64::consts::PI * (d * (2.0 / 3f64.sqrt()).sqrt()).powi(2)).exp();
    for (bin, &count) in histogram.iter().enumerate() {
        let [low, high] = [bin, bin + 1].map(|edge| beyond(edge as f64 * reach / bins as f64));
        let expected = 50_000.0 * (low - high);
        // Neighbours are often each other's.
        assert!((count as f64 - expected).abs() < 6.0 * (expected + 1.0).sqrt(), "{bin}: {count}, not {expected}");
    }
    let spacing = spacing_2d(&domain, &nearest);
    assert!((spacing.mean / spacing.hexagonal - 0.4653).abs() < 0.004);
    assert_eq!(spacing.smallest / spacing.hexagonal, rho(&context(), &domain, &points, None).unwrap());
    let none = spacing_2d(&domain, &[]);
    assert!(none.smallest == f64::INFINITY && none.mean == f64::INFINITY);
    assert_eq!(nearest_histogram_2d(&domain, &[f64::INFINITY], 1.0, 3).unwrap(), [0, 0, 0]);
}

#[test]
fn a_sparse_periodogram_has_frequencies_of_the_whole() {
    for boundary in BOUNDARIES {
        let domain = Domain { min: [-1.0, 2.0], max: [1.5, 3.0], boundary };
        let points: Vec<_> = random_points(300, 2).iter().map(|&[x, y]| [2.5 * x - 1.0, 2.0 + y]).collect();
        let whole = periodogram(&context(), &domain, &points, 121, None).unwrap();
        let sparse = sparse_periodogram(&context(), &domain, &points, 41, 3, None).unwrap();
        for (i, power) in sparse.power().iter().enumerate() {
            let expected = whole.power()[3 * (i / 41) * 121 + 3 * (i % 41)];
            assert!((power - expected).abs() < 1e-5 * (1.0 + expected), "{boundary:?} {i}: {power} {expected}");
        }
        assert!((sparse.frequency_step()[0] / whole.frequency_step()[0] - 3.0).abs() < 1e-12);
    }
}

/// Unbiased maximal sets lie between a spectrum that steps from 0 to 1 and a lattice. How often the annuli are cut, and how
/// many sets are taken together, hardly matters.
#[test]
fn maximal_sets_have_a_nyquist_frequency_and_an_oscillation() {
    let spectra: Vec<_> = (0..10)
        .map(|seed| {
            let domain = unit_square(Boundary::Periodic);
            let radius = (0.69656f64 / 2000.0).sqrt();
            let points = maximal::sample(&context(), &maximal::Options::new(radius).domain(domain).seed(seed), None)
                .unwrap()
                .positions;
            periodogram(&context(), &domain, &points, 640, None).unwrap()
        })
        .collect();
    let mean = Periodogram::mean(&spectra).unwrap();
    for (spectrum, width) in [(&mean, 0.05), (&mean, 0.02), (&spectra[0], 0.05)] {
        let [nyquist, oscillation] =
            [spectrum.effective_nyquist(width), spectrum.oscillation(width)].map(Result::unwrap);
        assert!((nyquist - 0.341).abs() < 0.008, "{nyquist}");
        assert!((oscillation - 1.57).abs() < 0.05, "{oscillation}");
    }
}

#[test]
fn bad_arguments_are_refused_by_name() {
    let domain = unit_square(Boundary::Periodic);
    let points = random_points(100, 1);
    let refused =
        |points: &[[f32; 2]], reach, bins| match radial_distribution(&context(), &domain, points, reach, bins, None)
            .unwrap_err()
        {
            Error::InvalidArgument { argument, .. } => argument,
            other => panic!("{other}"),
        };
    assert_eq!(refused(&[], 1.0, 5), "positions");
    assert_eq!(refused(&points[..1], 1.0, 5), "positions");
    assert_eq!(refused(&[[0.5, 1.5]; 2], 1.0, 5), "positions");
    for reach in [0.0, -1.0, 1e-200, f64::NAN, f64::INFINITY, 5.0] {
        assert_eq!(refused(&points, reach, 5), "reach");
    }
    for bins in [0, 1 << 17, usize::MAX] {
        assert_eq!(refused(&points, 1.0, bins), "bins");
        assert!(nearest_histogram_2d(&domain, &[0.1], 1.0, bins).is_err());
    }
    assert!(nearest_histogram_2d(&domain, &[0.1], f64::NAN, 4).is_err());
    assert!(RadialDistribution::mean(&[]).is_err());
    assert!(RadialDistribution::mean(&[1, 2].map(|bins| distribution(&domain, &points, 1.0, bins))).is_err());
    for stride in [0, 5000] {
        let sparse = sparse_periodogram(&context(), &domain, &points, 8, stride, None);
        assert!(matches!(sparse, Err(Error::InvalidArgument { argument: "frequency_stride", .. })));
    }
    let stop = |_| std::ops::ControlFlow::Break(());
    let stopped = radial_distribution(&context(), &domain, &points, 1.0, 5, Some(&stop));
    assert!(matches!(stopped, Err(Error::Cancelled)));
}
