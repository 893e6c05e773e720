//! Spectra and radial distributions of sets in cuboids: against sums over all points and all pairs, random points, which
//! have none, and lattices, whose peaks are known.

use std::f64::consts::{PI, TAU};

use azulejo::analysis::distribution::{RadialDistribution, radial_distribution_3d};
use azulejo::analysis::spectrum::{Periodogram, axis_power, periodogram_3d};
use azulejo::{Boundary, Context, Domain, Error};

use crate::common::BOUNDARIES;
use crate::common::random::Random;
use crate::common::volume_oracle::distance;

fn context() -> Context {
    Context::new(2).unwrap()
}

fn random_points(domain: &Domain<3>, count: usize, seed: u64) -> Vec<[f32; 3]> {
    let mut random = Random::new(seed);
    let extent = domain.extent();
    let mut along = |axis: usize| (domain.min[axis] + 0.999_999 * f64::from(random.unit()) * extent[axis]) as f32;
    (0..count).map(|_| [along(0), along(1), along(2)]).collect()
}

fn spectrum(domain: &Domain<3>, points: &[[f32; 3]], reach: f64) -> Periodogram<3> {
    periodogram_3d(&context(), domain, points, reach, 1, None).unwrap()
}

fn on_axis(domain: &Domain<3>, points: &[[f32; 3]], axis: usize, count: usize) -> Vec<f64> {
    axis_power(&context(), domain, points, axis, count, None).unwrap()
}

fn taper(place: [f64; 3]) -> f64 {
    (1.0 - 4.0 * place.into_iter().map(|x| (x - 0.5).powi(2)).sum::<f64>()).max(0.0).powi(2)
}

/// The mean of the taper's waves over the domain, by a fine grid of it, over the mean of the taper.
fn taper_wave(waves: [f64; 3]) -> [f64; 2] {
    let n = 28;
    let (mut sum, mut all) = ([0.0; 2], 0.0);
    for i in 0..n * n * n {
        let place = [i % n, i / n % n, i / n / n].map(|k| (f64::from(k) + 0.5) / f64::from(n));
        let (weight, turns) = (taper(place), std::iter::zip(waves, place).map(|(k, x)| k * x).sum::<f64>());
        sum = [sum[0] + weight * (TAU * turns).cos(), sum[1] - weight * (TAU * turns).sin()];
        all += weight;
    }
    sum.map(|part| part / all)
}

/// The definition, taken literally: the sum of exp(-2 pi i f x) over the points, in a bounded domain weighted.
fn power_of_all(domain: &Domain<3>, points: &[[f32; 3]], waves: [f64; 3]) -> f64 {
    let (mut sum, mut energy, mut all) = ([0.0; 2], 0.0, 0.0);
    for point in points {
        let place: [f64; 3] =
            std::array::from_fn(|axis| (f64::from(point[axis]) - domain.min[axis]) / domain.extent()[axis]);
        let weight = if domain.boundary == Boundary::Periodic { 1.0 } else { taper(place) };
        let angle = -TAU * std::iter::zip(waves, place).map(|(k, x)| k * x).sum::<f64>();
        sum = [sum[0] + weight * angle.cos(), sum[1] + weight * angle.sin()];
        (energy, all) = (energy + weight * weight, all + weight);
    }
    let mean = if domain.boundary == Boundary::Periodic { [0.0; 2] } else { taper_wave(waves) };
    (0..2).map(|part| (sum[part] - all * mean[part]).powi(2)).sum::<f64>() / energy
}

/// All frequencies of the grid, and on the axes, of few points, of one, and of points at one place; cubes and bars.
#[test]
fn the_power_is_that_of_the_sum_over_all_points() {
    for (case, boundary) in BOUNDARIES.into_iter().cycle().take(8).enumerate() {
        let max = if case < 4 { [-1.0, 3.0, 2.5] } else { [0.5, 2.3, 10.0] };
        let domain = Domain { min: [-2.0, 2.0, 1.5], max, boundary };
        let count = [60, 60, 1, 1, 25, 25, 7, 7][case];
        let mut points = random_points(&domain, count - 1, case as u64);
        // Not in the corner of a bounded domain, where no point counts.
        let middle = [0, 1, 2].map(|axis| (0.4 * domain.min[axis] + 0.6 * domain.max[axis]) as f32);
        points.push(middle);
        points.resize(count + case, middle);
        for stride in [1, 3] {
            let step = periodogram_3d(&context(), &domain, &points, 1e-9, 1, None);
            let Err(Error::InvalidArgument { argument: "frequency_reach", reason }) = step else { panic!("{step:?}") };
            let lowest: f64 = reason.rsplit(' ').next().unwrap().parse().unwrap();
            // Of a bar more than the frequencies along it.
            let reach = if case < 4 { 2.5 } else { 24.0 } * stride as f64 * lowest;
            let found = periodogram_3d(&context(), &domain, &points, reach, stride, None).unwrap();
            let [columns, rows, layers] = found.sizes();
            assert_eq!(found.power().len(), columns * rows * layers);
            assert_eq!([columns, rows, layers].into_iter().max(), Some(if case < 4 { 5 } else { 49 }));
            let mut compared = 0;
            for (i, &power) in found.power().iter().enumerate() {
                let places = [(i % columns, columns), (i / columns % rows, rows), (i / columns / rows, layers)];
                let waves = places.map(|(place, size)| stride as f64 * (place as f64 - (size / 2) as f64));
                // The oracle's grid of the taper is too coarse for shorter waves.
                if waves == [0.0; 3] {
                    assert_eq!(power, 0.0);
                } else if waves.into_iter().all(|k| k.abs() < 7.0) {
                    let expected = power_of_all(&domain, &points, waves);
                    let difference = (f64::from(power) - expected).abs();
                    assert!(difference < 1e-3 * (1.0 + expected), "{case} {waves:?}: {power}, not {expected}");
                    compared += 1;
                }
            }
            assert!(compared > 8, "{case}: {compared}");
        }
        for axis in 0..3 {
            for (i, power) in on_axis(&domain, &points, axis, 9).into_iter().enumerate() {
                let mut waves = [0.0; 3];
                waves[axis] = (i + 1) as f64;
                let expected = power_of_all(&domain, &points, waves);
                assert!(
                    (power - expected).abs() < 1e-3 * (1.0 + expected),
                    "{case} {waves:?}: {power}, not {expected}"
                );
            }
        }
    }
}

/// Exactly, where no taper is summed up: sums of a periodic set differ by rounding alone.
#[test]
fn the_power_of_a_periodic_set_is_exact() {
    let domain = Domain { min: [0.0, -3.0, 100.0], max: [2.0, -1.0, 101.0], boundary: Boundary::Periodic };
    let points = random_points(&domain, 500, 3);
    let found = spectrum(&domain, &points, 1.2);
    let [columns, rows, layers] = found.sizes();
    for (i, &power) in found.power().iter().enumerate().step_by(7) {
        let places = [(i % columns, columns), (i / columns % rows, rows), (i / columns / rows, layers)];
        let waves = places.map(|(place, size)| place as f64 - (size / 2) as f64);
        let expected = if waves == [0.0; 3] { 0.0 } else { power_of_all(&domain, &points, waves) };
        assert!((f64::from(power) - expected).abs() < 1e-6 * (1.0 + expected), "{waves:?}: {power}, not {expected}");
    }
    for axis in 0..3 {
        for (i, power) in on_axis(&domain, &points, axis, 300).into_iter().enumerate() {
            let mut waves = [0.0; 3];
            waves[axis] = (i + 1) as f64;
            let expected = power_of_all(&domain, &points, waves);
            assert!((power - expected).abs() < 1e-8 * (1.0 + expected), "{waves:?}: {power}, not {expected}");
        }
    }
}

#[test]
fn the_sum_over_all_points_notices_a_moved_one() {
    let domain = Domain::unit(Boundary::Periodic);
    let mut points = random_points(&domain, 50, 1);
    let before = power_of_all(&domain, &points, [2.0, 1.0, -3.0]);
    points[7][2] = (points[7][2] + 0.1) % 1.0;
    assert!((power_of_all(&domain, &points, [2.0, 1.0, -3.0]) - before).abs() > 1e-3);
}

#[test]
fn a_poisson_process_has_power_one_in_every_shell_and_on_the_axes() {
    for boundary in BOUNDARIES {
        let domain = Domain { min: [3.0, -1.0, 0.0], max: [5.0, 1.0, 2.0], boundary };
        let points = random_points(&domain, 8000, 5);
        for shell in spectrum(&domain, &points, 1.0).radial(0.1).unwrap() {
            // The taper correlates neighbouring frequencies, and removes the mean near 0.
            if shell.frequency > 0.15 {
                let alike = if boundary == Boundary::Periodic { 1.0 } else { 10.0 };
                let error = 5.0 * (alike / shell.count as f64).sqrt();
                assert!((shell.power - 1.0).abs() < error, "{boundary:?} {shell:?}");
                assert!((shell.anisotropy - 1.0).abs() < 3.0 * error, "{boundary:?} {shell:?}");
            }
        }
        for axis in 0..3 {
            let power = on_axis(&domain, &points, axis, 4000);
            let mean = power[8..].iter().sum::<f64>() / (power.len() - 8) as f64;
            assert!((mean - 1.0).abs() < 0.15, "{boundary:?} {axis}: {mean}");
            // Exponentially distributed: the largest of n is about ln n.
            let largest = power[8..].iter().copied().fold(0.0, f64::max);
            assert!((5.0..20.0).contains(&largest), "{boundary:?} {axis}: {largest}");
        }
    }
}

#[test]
fn a_lattice_has_peaks_of_power_n_on_the_dual_lattice_and_nothing_else() {
    let domain = Domain::unit(Boundary::Periodic);
    let at = |i: usize| [i % 4, i / 4 % 4, i / 16].map(|k| k as f32 / 4.0);
    let simple: Vec<_> = (0..64).map(|i| at(i).map(|x| x + 0.01)).collect();
    // Body-centred: the corners of cubes and their middles; the dual lattice has no frequency with an odd sum.
    let centred: Vec<_> = (0..128).map(|i| at(i % 64).map(|x| x + if i < 64 { 0.0 } else { 0.125 })).collect();
    for (points, is_centred) in [(&simple, false), (&centred, true)] {
        let count = points.len() as f64;
        let found = spectrum(&domain, points, 9.0 / count.cbrt());
        assert_eq!(found.sizes(), [19; 3]);
        assert!(found.frequency_step().iter().all(|step| (step * count.cbrt() - 1.0).abs() < 1e-12));
        for (i, &power) in found.power().iter().enumerate() {
            let waves = [i % 19, i / 19 % 19, i / 361].map(|k| k as i64 - 9);
            let dual = waves.iter().all(|k| k % 4 == 0) && (!is_centred || waves.iter().sum::<i64>() % 8 == 0);
            let expected = if dual && waves != [0; 3] { count } else { 0.0 };
            assert!((f64::from(power) - expected).abs() < 1e-3, "{waves:?}: {power}");
        }
        let first = found.highest_peak(10.0, 0.1..1.2).unwrap().unwrap();
        let expected = if is_centred { 2f64.sqrt() * 4.0 } else { 4.0 } / count.cbrt();
        let length = first.frequency.into_iter().map(|f| f * f).sum::<f64>().sqrt();
        assert!((length - expected).abs() < 1e-9, "{length}, not {expected}");
        for (i, power) in on_axis(&domain, points, 1, 64).into_iter().enumerate() {
            let period = if is_centred { 8 } else { 4 };
            let expected = if (i + 1) % period == 0 { count } else { 0.0 };
            assert!((power - expected).abs() < 1e-3, "{i}: {power}");
        }
    }
}

/// Slabs of different density across one axis show on that axis, and nowhere else.
#[test]
fn slabs_show_on_their_axis_alone() {
    let domain = Domain::unit(Boundary::Periodic);
    let mut points = random_points(&domain, 20_000, 8);
    points.retain(|point| ((point[2] * 20.0) as usize).is_multiple_of(2));
    let [x, y, z] = [0, 1, 2].map(|axis| on_axis(&domain, &points, axis, 40)[9]);
    let slabs = points.len() as f64 * (2.0 / PI).powi(2);
    assert!((z / slabs - 1.0).abs() < 0.1 && x < 15.0 && y < 15.0, "{x} {y} {z}, {slabs}");
}

fn distribution(domain: &Domain<3>, points: &[[f32; 3]], reach: f64, bins: usize) -> RadialDistribution {
    radial_distribution_3d(&context(), domain, points, reach, bins, None).unwrap()
}

#[test]
fn the_distribution_counts_all_pairs() {
    for (case, boundary) in BOUNDARIES.into_iter().cycle().take(12).enumerate() {
        let depth = [1.0, 0.3, 5.0][case / 4];
        let domain = Domain { min: [-1.0, 2.0, 0.1], max: [0.0, 3.0, 0.1 + depth], boundary };
        let count = [2, 40, 150][case % 3];
        let mut points = random_points(&domain, count - 1, case as u64);
        points.push(points[0]);
        let unit = domain.packed_distance(count);
        let (reach, bins) = (0.5 * depth.min(1.0) / unit * (1.0 - 1e-9), 7);
        let found = distribution(&domain, &points, reach, bins);
        let mut expected = vec![0.0; bins];
        for (i, &a) in points.iter().enumerate() {
            for &b in points[..i].iter().chain(&points[i + 1..]) {
                let bin = (distance(&domain, a.map(f64::from), b.map(f64::from)) / unit / reach * bins as f64) as usize;
                let shares = (0..3).map(|axis| 1.0 - f64::from((a[axis] - b[axis]).abs()) / domain.extent()[axis]);
                let share = if boundary == Boundary::Periodic { 1.0 } else { shares.product() };
                expected.iter_mut().skip(bin).take(1).for_each(|sum| *sum += 1.0 / share);
            }
        }
        let width = reach / bins as f64 * unit;
        for bin in 0..bins {
            let shell = 4.0 / 3.0 * PI * width.powi(3) * ((bin as f64 + 1.0).powi(3) - (bin as f64).powi(3));
            let poisson = (count * (count - 1)) as f64 * shell / depth;
            assert!((found.expected()[bin] / poisson - 1.0).abs() < 1e-6, "{case} {bin}");
            let pairs = found.density()[bin] * poisson;
            assert!((pairs - expected[bin]).abs() < 1e-4 * (1.0 + expected[bin]), "{case} {bin}: {pairs} {expected:?}");
        }
    }
}

#[test]
fn random_points_have_distribution_one() {
    for boundary in BOUNDARIES {
        let domain = Domain { min: [0.0; 3], max: [2.0, 1.0, 1.5], boundary };
        let found = distribution(&domain, &random_points(&domain, 5000, 7), 4.0, 40);
        for (density, expected) in std::iter::zip(found.density(), found.expected()) {
            let error = 5.0 * 1.2 * (2.0 / expected).sqrt();
            assert!((density - 1.0).abs() < error, "{boundary:?} {density} {error}");
        }
    }
}

/// Neighbours of the face-centred lattice are 1, sqrt(2), sqrt(3), 2 and sqrt(5) apart: 12, 6, 24, 12 and 24 of them.
#[test]
fn the_densest_packing_has_peaks_at_its_distances_and_nothing_between() {
    let side = 8.0 * 2f64.sqrt();
    let domain = Domain { min: [0.0; 3], max: [side; 3], boundary: Boundary::Periodic };
    let places = (0..16 * 16 * 16).map(|i| [i % 16, i / 16 % 16, i / 256]);
    let even = places.filter(|place| place.iter().sum::<usize>() % 2 == 0);
    let points: Vec<_> = even.map(|place| place.map(|k| (k as f64 * side / 16.0) as f32)).collect();
    let found = distribution(&domain, &points, 2.3, 230);
    let mut neighbours: Vec<_> = std::iter::zip(found.density(), found.expected())
        .map(|(density, expected)| density * expected / points.len() as f64)
        .collect();
    for (distance, count) in [(1.0f64, 12.0), (2f64.sqrt(), 6.0), (3f64.sqrt(), 24.0), (2.0, 12.0), (5f64.sqrt(), 24.0)]
    {
        // Rounding may take a distance to the bin before.
        let bin = (100.0 * distance + 0.1) as usize;
        let about: f64 = neighbours[bin - 1..=bin].iter().sum();
        assert!((about - count).abs() < 1e-9, "{distance}: {about}");
        neighbours[bin - 1..=bin].fill(0.0);
    }
    assert!(neighbours.iter().all(|&count| count == 0.0));
}

#[test]
fn threads_do_not_change_a_bit() {
    for boundary in BOUNDARIES {
        let domain = Domain { min: [0.0; 3], max: [1.0, 1.5, 0.7], boundary };
        let points = random_points(&domain, 3000, 9);
        let on = |threads| {
            let context = Context::new(threads).unwrap();
            let spectrum = periodogram_3d(&context, &domain, &points, 1.5, 1, None).unwrap();
            let axis = axis_power(&context, &domain, &points, 2, 500, None).unwrap();
            (spectrum, axis, radial_distribution_3d(&context, &domain, &points, 3.0, 100, None).unwrap())
        };
        assert!(on(1) == on(2) && on(1) == on(5));
    }
}

#[test]
fn bad_arguments_are_refused_by_name() {
    let unit = Domain::unit(Boundary::Periodic);
    let points = random_points(&unit, 1000, 1);
    let named = |error: Error| match error {
        Error::InvalidArgument { argument, .. } => argument,
        Error::TooLarge { argument, .. } => argument,
        other => panic!("{other}"),
    };
    let spectrum = |domain: &Domain<3>, points: &[[f32; 3]], reach, stride| {
        named(periodogram_3d(&context(), domain, points, reach, stride, None).unwrap_err())
    };
    for reach in [0.0, -1.0, f64::NAN, f64::INFINITY, 0.09, 205.0, 1e300] {
        assert_eq!(spectrum(&unit, &points, reach, 1), "frequency_reach", "{reach}");
    }
    for stride in [0, 4097] {
        assert_eq!(spectrum(&unit, &points, 1.0, stride), "frequency_stride");
    }
    let swapped = Domain { min: [0.0, 2.0, 0.0], max: [1.0; 3], boundary: Boundary::Bounded };
    assert_eq!(spectrum(&swapped, &points, 1.0, 1), "domain_max");
    assert_eq!(spectrum(&unit, &[], 1.0, 1), "positions");
    assert_eq!(spectrum(&unit, &[[f32::NAN; 3]], 1.0, 1), "positions");
    let axis =
        |points: &[[f32; 3]], axis, count| named(axis_power(&context(), &unit, points, axis, count, None).unwrap_err());
    assert_eq!((axis(&points, 3, 10), axis(&points, usize::MAX, 10)), ("axis", "axis"));
    assert_eq!((axis(&points, 0, 0), axis(&points, 2, 1 << 17)), ("count", "count"));
    assert_eq!((axis(&[], 0, 5), axis(&[[0.0, 0.0, f32::INFINITY]], 0, 5)), ("positions", "positions"));
    let pairs = |points: &[[f32; 3]], reach, bins| {
        named(radial_distribution_3d(&context(), &unit, points, reach, bins, None).unwrap_err())
    };
    assert_eq!((pairs(&points[..1], 1.0, 5), pairs(&[[0.5, 0.5, 1.0]; 2], 1.0, 5)), ("positions", "positions"));
    for reach in [0.0, f64::NAN, 1e-200, 4.5] {
        assert_eq!(pairs(&points, reach, 5), "reach", "{reach}");
    }
    assert_eq!((pairs(&points, 1.0, 0), pairs(&points, 1.0, usize::MAX)), ("bins", "bins"));
}
