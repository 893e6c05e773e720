//! DCR: what relaxation promises, for both neighbourhoods and both boundaries.

use std::cell::Cell;
use std::ops::ControlFlow;

use azulejo::analysis::coverage::covering_radius_2d;
use azulejo::dcr::{Distribution, Method, Neighbourhood, Options, Report, Stopped, Thesis, relax};
use azulejo::{Boundary, Context, Domain, Error};

use crate::common::relaxed;
use crate::common::sets::{darts, distance, nearest_distances, random_points, unit_square};

const NEIGHBOURHOODS: [Neighbourhood; 2] = [Neighbourhood::Delaunay, Neighbourhood::Nearest];
const BOUNDARIES: [Boundary; 2] = [Boundary::Periodic, Boundary::Bounded];

/// The thesis's options for each neighbourhood on the unit square with each boundary.
fn thesis_cases() -> impl Iterator<Item = Options> {
    let pairs = NEIGHBOURHOODS.into_iter().flat_map(|n| BOUNDARIES.map(|boundary| (n, boundary)));
    pairs.map(|(neighbourhood, boundary)| Options::thesis(unit_square(boundary), neighbourhood))
}

/// The momentum method's.
fn momentum_cases() -> impl Iterator<Item = Options> {
    thesis_cases().map(|Options { domain, neighbourhood, .. }| Options::new(domain, neighbourhood))
}

/// Both methods.
fn all_cases() -> impl Iterator<Item = Options> {
    thesis_cases().chain(momentum_cases())
}

/// The thesis's options with some changed.
fn varied(options: Options, thesis: Thesis) -> Options {
    options.method(Method::Thesis(thesis))
}

fn run(options: &Options, points: &[[f32; 2]]) -> (Vec<[f32; 2]>, Report) {
    let (relaxed, report) = relax(&Context::new(1).unwrap(), options, points, None).unwrap();
    assert_eq!(relaxed.len(), points.len());
    for point in &relaxed {
        for axis in 0..2 {
            let Domain { min, max, .. } = options.domain;
            assert!((min[axis]..max[axis]).contains(&f64::from(point[axis])), "{point:?} left the domain");
        }
    }
    (relaxed, report)
}

fn smallest(distances: &[f64]) -> f64 {
    distances.iter().copied().fold(f64::INFINITY, f64::min)
}

/// Variance over squared mean.
fn variation(distances: &[f64]) -> f64 {
    let mean = distances.iter().sum::<f64>() / distances.len() as f64;
    distances.iter().map(|d| (d / mean - 1.0).powi(2)).sum::<f64>() / distances.len() as f64
}

#[test]
fn the_thesis_spreads_random_sets_and_the_report_says_so() {
    let start = random_points(1000, 1);
    for options in thesis_cases() {
        let (relaxed, report) = run(&options, &start);
        let (before, after) =
            (nearest_distances(&options.domain, &start), nearest_distances(&options.domain, &relaxed));
        let d_max = (2.0 / (3f64.sqrt() * 1000.0)).sqrt();
        assert!((report.smallest_distance / smallest(&after) - 1.0).abs() < 1e-12);
        assert!((report.rho / (smallest(&after) / d_max) - 1.0).abs() < 1e-12);
        assert!(report.stopped == Stopped::Converged && report.iterations < options.max_iterations, "{report:?}");
        assert!(report.motion > 0.0 && report.motion <= options.tolerance, "{report:?}");
        assert!(smallest(&before) / d_max < 0.1);
        // Of twelve seeds 0.63 to 0.70, and 0.80 to 0.89.
        assert!(report.rho > if options.neighbourhood == Neighbourhood::Delaunay { 0.6 } else { 0.77 }, "{report:?}");
        assert!(variation(&after) < 0.03 * variation(&before), "{} {}", variation(&before), variation(&after));
    }
}

#[test]
fn a_hundred_steps_are_enough_for_any_set() {
    for boundary in BOUNDARIES {
        let (rho, coverage) = if boundary == Boundary::Periodic { (0.85, 0.67) } else { (0.845, 0.68) };
        for start in [random_points(1000, 20), darts(1000, 21), random_points(4000, 22), random_points(4000, 23)] {
            let options = Options::new(unit_square(boundary), Neighbourhood::Delaunay);
            let (relaxed, report) = run(&options, &start);
            assert_eq!(relaxed::fault(&options.domain, &relaxed, &report), None, "{options:?}");
            assert!(report.iterations <= 100 && report.motion < 0.01, "{report:?}");
            assert!(
                report.rho >= rho && report.relative_covering_radius <= coverage,
                "{boundary:?}, {}: {report:?}",
                start.len()
            );
        }
    }
}

#[test]
fn nearest_neighbours_raise_rho_without_holes() {
    for boundary in BOUNDARIES {
        for start in [darts(1500, 30), darts(1500, 31), random_points(1500, 32), random_points(4000, 33)] {
            let options = Options::new(unit_square(boundary), Neighbourhood::Nearest);
            let (relaxed, report) = run(&options, &start);
            assert_eq!(relaxed::fault(&options.domain, &relaxed, &report), None, "{options:?}");
            assert!(report.iterations <= 100, "{report:?}");
            assert!(
                report.rho >= 0.905 && report.relative_covering_radius <= 0.9,
                "{boundary:?}, {}: {report:?}",
                start.len()
            );
        }
    }
}

/// The mean power at the frequencies below a quarter of the root of the density: 1 for random points.
fn low_power(points: &[[f32; 2]]) -> f64 {
    let wave = |[i, j]: [i32; 2]| {
        let turns =
            |p: &[f32; 2]| std::f64::consts::TAU * f64::from(i).mul_add(p[0].into(), f64::from(j) * f64::from(p[1]));
        let (cosine, sine) = points.iter().map(turns).fold((0.0, 0.0), |sum, x| (sum.0 + x.cos(), sum.1 + x.sin()));
        (cosine * cosine + sine * sine) / points.len() as f64
    };
    let limit = (points.len() as f64).sqrt() / 4.0;
    let range = -(limit as i32)..=limit as i32;
    let all = range.clone().flat_map(|i| range.clone().map(move |j| [i, j]));
    let low = all.filter(|&[i, j]| [i, j] != [0, 0] && f64::from(i).hypot(j.into()) < limit);
    let powers: Vec<f64> = low.map(wave).collect();
    powers.iter().sum::<f64>() / powers.len() as f64
}

/// Of a lattice nothing is left, of pairs of coincident points twice the power, and one point that is moved shows.
#[test]
fn the_low_power_is_that_of_known_sets() {
    let mut lattice: Vec<[f32; 2]> = (0..1024).map(|i| [(i % 32) as f32 / 32.0, (i / 32) as f32 / 32.0]).collect();
    assert!(low_power(&lattice) < 1e-20);
    lattice[100] = [0.015, 0.71];
    assert!(low_power(&lattice) > 1e-4);
    let points = random_points(1000, 43);
    let (once, twice) = (low_power(&points), low_power(&[&points[..], &points].concat()));
    assert!((0.7..1.3).contains(&once) && (twice / once - 2.0).abs() < 0.3, "{once} {twice}");
}

#[test]
fn low_frequencies_are_cleared() {
    let domain = unit_square(Boundary::Periodic);
    for (neighbourhood, limit) in [(Neighbourhood::Delaunay, 1e-4), (Neighbourhood::Nearest, 3e-3)] {
        for seed in 40..42 {
            let start = random_points(1000, seed);
            let (relaxed, _) = run(&Options::new(domain, neighbourhood), &start);
            let (before, after) = (low_power(&start), low_power(&relaxed));
            assert!(before > 0.7 && after < limit, "{neighbourhood:?}: {before} to {after}");
        }
    }
}

#[test]
fn the_thesis_s_nearest_neighbours_raise_rho_of_thrown_darts() {
    let start = darts(1000, 2);
    for boundary in BOUNDARIES {
        let options = Options::thesis(unit_square(boundary), Neighbourhood::Nearest).tolerance(0.003);
        let (_, report) = run(&options, &start);
        assert!(report.rho >= 0.85, "{report:?}");
    }
}

#[test]
fn the_result_does_not_depend_on_the_threads() {
    let start = random_points(6000, 3);
    for options in all_cases() {
        let options = options.max_iterations(6);
        let expected = run(&options, &start);
        let four = Context::new(4).unwrap();
        assert_eq!(relax(&four, &options, &start, None).unwrap(), expected);
        assert_eq!(relax(&four, &options, &start, Some(&|_| ControlFlow::Continue(()))).unwrap(), expected);
    }
}

#[test]
fn the_verdict_does_not_depend_on_the_step() {
    let start = random_points(1500, 4);
    for neighbourhood in NEIGHBOURHOODS {
        let path = |step| {
            let options = Options::thesis(unit_square(Boundary::Periodic), neighbourhood);
            let options = varied(options, Thesis::default().step(step));
            f64::from(run(&options, &start).1.iterations) * step
        };
        let ratio = path(0.05) / path(0.1);
        assert!((0.7..1.4).contains(&ratio), "{neighbourhood:?}: {ratio}");
    }
}

#[test]
fn average_forces_balance_and_constant_distributions_coincide_on_delaunay_edges() {
    let start = random_points(400, 5);
    let domain = unit_square(Boundary::Periodic);
    let constant = [Distribution::Average, Distribution::Dominant, Distribution::Zero, Distribution::EightyTwenty];
    for neighbourhood in NEIGHBOURHOODS {
        let relaxed_by = |distribution| {
            let options = Options::thesis(domain, neighbourhood).max_iterations(4);
            run(&varied(options, Thesis::default().distribution(distribution)), &start).0
        };
        let same = |a: &[[f32; 2]], b: &[[f32; 2]]| a.iter().zip(b).all(|(&a, &b)| distance(&domain, a, b) < 1e-6);
        let average = relaxed_by(Distribution::Average);
        assert!(!same(&average, &start) && !same(&average, &relaxed_by(Distribution::Activeness)));
        for axis in 0..2 {
            let moves = start.iter().zip(&average).map(|(from, to)| f64::from(to[axis] - from[axis]));
            let sum: f64 = moves.map(|d| d - d.round()).sum();
            assert!(sum.abs() < 1e-4, "{neighbourhood:?}: {sum}");
        }
        // Both ends of a Delaunay edge visit it.
        for distribution in constant {
            let coincides = neighbourhood == Neighbourhood::Delaunay || distribution == Distribution::Average;
            assert_eq!(same(&average, &relaxed_by(distribution)), coincides, "{neighbourhood:?} {distribution:?}");
        }
    }
}

#[test]
fn a_shift_of_the_torus_shifts_the_result() {
    let domain = unit_square(Boundary::Periodic);
    // Coordinates and shift are multiples of 2^-12: the shift is exact.
    let start: Vec<_> = random_points(500, 6).iter().map(|p| p.map(|x| (x * 4096.0).floor() / 4096.0)).collect();
    let shift = |p: &[f32; 2]| [(p[0] + 0.375).fract(), (p[1] + 0.8125).fract()];
    for neighbourhood in NEIGHBOURHOODS {
        let options = Options::thesis(domain, neighbourhood).max_iterations(10);
        let (stayed, _) = run(&options, &start);
        let (shifted, _) = run(&options, &start.iter().map(shift).collect::<Vec<_>>());
        for (stayed, &shifted) in stayed.iter().zip(&shifted) {
            assert!(distance(&domain, shift(stayed), shifted) < 1e-5, "{neighbourhood:?}");
        }
    }
}

#[test]
fn a_hexagonal_lattice_rests() {
    let row = 0.75f64.sqrt();
    let domain = Domain { min: [-3.0, 5.0], max: [7.0, 5.0 + 12.0 * row], boundary: Boundary::Periodic };
    let at = |i: usize, j: usize| [-3.0 + i as f64 + 0.5 * (j % 2) as f64, 5.0 + (j as f64 + 0.25) * row];
    let lattice: Vec<_> = (0..120).map(|k| at(k % 10, k / 10).map(|x| x as f32)).collect();
    for options in all_cases() {
        let (relaxed, report) = run(&options.domain(domain), &lattice);
        // The grid on which the momentum method draws the density takes the waves of a lattice for long ones.
        let slack = if options.method == Method::Momentum { 0.01 } else { 0.0 };
        assert!(relaxed.iter().zip(&lattice).all(|(&a, &b)| distance(&domain, a, b) <= slack));
        assert!(report.stopped == Stopped::Converged && report.motion <= slack, "{report:?}");
        assert!((report.relative_covering_radius - 1.0 / 3f64.sqrt()).abs() < 1e-5 + slack, "{report:?}");
        assert!((report.rho - 1.0).abs() < 1e-5 + slack, "{report:?}");
    }
}

#[test]
fn empty_sets_single_points_and_no_iterations_change_nothing() {
    for options in all_cases() {
        for points in [vec![], vec![[0.3, 0.9999]]] {
            let (relaxed, report) = run(&options, &points);
            assert_eq!(relaxed, points);
            assert!(report.stopped == Stopped::Converged && report.iterations == 0 && report.motion == 0.0);
            assert_eq!((report.smallest_distance, report.rho), (f64::INFINITY, f64::INFINITY));
        }
        let points = [[0.1, 0.1], [0.1, 0.1], [1e-30, 0.3]];
        let (relaxed, report) = run(&options.max_iterations(0), &points);
        assert_eq!(relaxed, points);
        assert!(report.stopped == Stopped::Steps && report.iterations == 0 && report.smallest_distance == 0.0);
    }
}

/// The thesis's method parts coincident and collinear points before the first step; without a step it takes that back.
#[test]
fn without_a_step_the_covering_radius_is_that_of_the_given_points() {
    let sets: [&[[f32; 2]]; 4] =
        [&[[0.3, 0.9999]], &[[0.25, 0.5]; 3], &[[0.1, 0.5], [0.4, 0.5], [0.8, 0.5]], &[[0.0, 0.0], [0.5, 0.5]]];
    for options in all_cases() {
        for set in sets {
            let (relaxed, report) = run(&options.max_iterations(0), set);
            let farthest = covering_radius_2d(&Context::new(1).unwrap(), &options.domain, set, None).unwrap();
            let covering_radius = farthest / options.domain.hexagonal_distance(set.len());
            assert_eq!(relaxed, set);
            assert!(
                (report.relative_covering_radius - covering_radius).abs() <= 1e-6,
                "{set:?}: {report:?}, {covering_radius}"
            );
        }
    }
}

#[test]
fn few_coincident_and_collinear_points_are_spread() {
    let line = |n: usize, dx: f32, dy: f32| (0..n).map(|i| [dx * i as f32, dy * i as f32]).collect::<Vec<_>>();
    let sets = [
        vec![[0.5, 0.5]; 2],
        vec![[0.0, 0.0]; 3],
        vec![[0.2, 0.2], [0.2, 0.2], [0.8, 0.2]],
        vec![[0.999_999_9, 0.5]; 60],
        line(40, 0.0, 0.01),
        line(40, 0.02, 0.0),
        line(40, 0.002, 0.002),
        [line(20, 0.01, 0.0), line(20, 0.01, 0.0)].concat(),
    ];
    for options in all_cases() {
        for (number, set) in sets.iter().enumerate() {
            let (_, report) = run(&options.max_iterations(3000), set);
            assert!(report.rho > 0.45, "set {number}, {:?}: {report:?}", options);
        }
    }
}

/// The distance of a set from lying on a line: the lesser of the two principal deviations over the greater.
fn roundness(points: &[[f32; 2]]) -> f64 {
    let mean = |of: &dyn Fn(&[f32; 2]) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
    let centre = [0, 1].map(|axis| mean(&|p| f64::from(p[axis])));
    let moment = |a: usize, b: usize| mean(&|p| (f64::from(p[a]) - centre[a]) * (f64::from(p[b]) - centre[b]));
    let (half_trace, half_difference) = (0.5 * (moment(0, 0) + moment(1, 1)), 0.5 * (moment(0, 0) - moment(1, 1)));
    let root = half_difference.hypot(moment(0, 1));
    ((half_trace - root) / (half_trace + root)).sqrt()
}

/// With the default options: in the steps that any set has.
#[test]
fn coincident_and_collinear_points_fill_the_domain() {
    let line = |at: &dyn Fn(f32) -> [f32; 2]| (0..200).map(|i| at(i as f32 / 200.0)).collect::<Vec<_>>();
    let sets = [
        vec![[0.5, 0.5]; 200],
        vec![[0.0, 0.0]; 200],
        line(&|t| [t, 0.5]),
        line(&|t| [0.0, t]),
        line(&|t| [t, t]),
        [random_points(100, 50), random_points(100, 50)].concat(),
    ];
    for options in momentum_cases() {
        for (number, set) in sets.iter().enumerate() {
            let (relaxed, report) = run(&options, set);
            assert!(report.rho > 0.8 && report.relative_covering_radius < 1.0, "set {number}, {options:?}: {report:?}");
            assert!(roundness(&relaxed) > 0.8, "set {number}, {options:?}");
        }
    }
}

#[test]
fn points_stay_inside_domains_that_floats_can_hardly_resolve() {
    let unit = random_points(300, 8);
    for [min, max] in [[1000.1, 1000.4], [-1e30, 1e30], [-2e-40, 3e-39], [16777215.0, 16777230.0]] {
        for options in all_cases() {
            let domain = Domain { min: [min; 2], max: [max; 2], ..options.domain };
            let place = |x: f32| ((min + f64::from(x) * (max - min)) as f32).max(min as f32);
            let inside = |p: &[f32; 2]| p.iter().all(|&x| (min..max).contains(&f64::from(x)));
            let points: Vec<_> = unit.iter().map(|p| p.map(place)).filter(inside).collect();
            run(&options.max_iterations(12).domain(domain), &points);
        }
    }
}

#[test]
fn strips_narrower_than_the_hexagonal_distance_are_relaxed() {
    for options in all_cases() {
        let domain = Domain { min: [0.0; 2], max: [200.0, 1.0], ..options.domain };
        let points: Vec<_> = random_points(120, 9).iter().map(|p| [p[0] * 200.0, p[1]]).collect();
        let (relaxed, _) = run(&options.max_iterations(400).domain(domain), &points);
        let smallest = smallest(&nearest_distances(&domain, &relaxed));
        // In a row they would be 200 / 120 = 1.67 apart, and in zigzag farther. The thesis's steps end before, of other seeds at
        // 0.73 to 1.4; momentum within 0.04 of what it ends
        // at here.
        let least = match (options.method, options.neighbourhood, domain.boundary) {
            (Method::Thesis(_), ..) => 0.9,
            (_, Neighbourhood::Delaunay, Boundary::Periodic) => 1.69,
            (_, Neighbourhood::Delaunay, Boundary::Bounded) => 1.45,
            (_, Neighbourhood::Nearest, Boundary::Periodic) => 1.65,
            (_, Neighbourhood::Nearest, Boundary::Bounded) => 1.25,
        };
        assert!(smallest > least, "{options:?}: {smallest}");
    }
}

#[test]
fn progress_grows_and_a_call_can_be_cancelled() {
    let start = random_points(300, 10);
    for threads in [1, 2] {
        let context = Context::new(threads).unwrap();
        for options in all_cases() {
            let options = options.max_iterations(20);
            let last = Cell::new(0.0);
            let watch = |share: f64| {
                assert!(share >= last.replace(share));
                ControlFlow::Continue(())
            };
            relax(&context, &options, &start, Some(&watch)).unwrap();
            assert_eq!(last.get(), 1.0);
            let (mut iterations, mut coverage) = (None, f64::INFINITY);
            for limit in [0.0, 0.3, 0.7, 1.0] {
                let stop = |share| if share >= limit { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
                let (relaxed, report) = relax(&context, &options, &start, Some(&stop)).unwrap();
                assert_eq!(report.stopped, Stopped::Cancelled);
                // The state after the last whole step is what as many steps give, and better than none.
                let (same, _) = run(&options.max_iterations(report.iterations), &start);
                assert_eq!(relaxed, same);
                assert!(Some(report.iterations) > iterations, "{report:?}");
                assert!(report.relative_covering_radius < coverage, "{report:?}");
                iterations = Some(report.iterations);
                coverage = if limit == 0.0 { report.relative_covering_radius } else { coverage };
            }
            assert_eq!(iterations, Some(20));
        }
    }
}

#[test]
fn bad_arguments_are_refused_by_name() {
    let good = Options::new(unit_square(Boundary::Periodic), Neighbourhood::Delaunay);
    let start = random_points(10, 11);
    let refusal = |options: Options, points: &[[f32; 2]]| match relax(&Context::new(1).unwrap(), &options, points, None)
    {
        Err(Error::InvalidArgument { argument, reason }) => (argument, reason),
        other => panic!("not refused: {other:?}"),
    };
    for options in all_cases() {
        for bad in [[1.0, 0.5], [0.5, -1e-30], [f32::NAN, 0.5], [0.5, f32::INFINITY]] {
            let (argument, reason) = refusal(options, &[start[0], start[1], bad]);
            assert_eq!(argument, "positions");
            assert!(reason.contains("point 2") && reason.contains(&format!("({}, {})", bad[0], bad[1])), "{reason}");
        }
    }
    let nan = f64::NAN;
    let max = |max| Domain { max: [1.0, max], ..good.domain };
    let thesis = Thesis::default();
    for (argument, options) in [
        ("domain_max", good.domain(max(0.0))),
        ("domain_max", good.domain(max(nan))),
        ("conflict_radius", varied(good, thesis.conflict_radius(0.0))),
        ("conflict_radius", varied(good, thesis.conflict_radius(1.01))),
        ("conflict_radius", varied(good, thesis.conflict_radius(nan))),
        ("attraction_radius", varied(good, thesis.attraction_radius(0.9))),
        ("attraction_radius", varied(good, thesis.attraction_radius(nan))),
        ("step", varied(good, thesis.step(0.0))),
        ("step", varied(good, thesis.step(1.5))),
        ("decay", varied(good, thesis.decay(0.0))),
        ("decay", varied(good, thesis.decay(1.01))),
        ("decay", varied(good, thesis.decay(nan))),
        ("neighbours", varied(good, thesis.neighbours(0))),
        ("tolerance", good.tolerance(-0.1)),
        ("tolerance", good.tolerance(nan)),
    ] {
        assert_eq!(refusal(options, &start).0, argument);
    }
}
