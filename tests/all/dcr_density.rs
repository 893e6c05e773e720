//! DCR with a density: what it promises, on images and functions.

use std::collections::HashSet;
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use azulejo::dcr::{
    DelaunayOptions, Density, Neighbourhood, Options, Report, Stopped, relax, relax_with_density, scatter,
};
use azulejo::{Boundary, Context, Domain, Error};

use crate::common::sets::{darts, distance, nearest_distances, random_points, unit_square};

const BOUNDARIES: [Boundary; 2] = [Boundary::Periodic, Boundary::Bounded];

fn options(domain: Domain) -> DelaunayOptions {
    DelaunayOptions::new(domain)
}

fn run(options: &DelaunayOptions, density: &Density, points: &[[f32; 2]]) -> (Vec<[f32; 2]>, Report) {
    let (relaxed, report) = relax_with_density(&Context::new(1).unwrap(), options, density, points, None).unwrap();
    assert_eq!(relaxed.len(), points.len());
    let Domain { min, max, .. } = options.domain;
    let is_inside = |p: &[f32; 2]| (0..2).all(|axis| (min[axis]..max[axis]).contains(&f64::from(p[axis])));
    assert!(relaxed.iter().all(is_inside));
    (relaxed, report)
}

fn scattered(domain: &Domain, density: &Density, count: usize, seed: u64) -> Vec<[f32; 2]> {
    scatter(&Context::new(1).unwrap(), domain, density, count, seed, None).unwrap()
}

/// A third at the left and 1 at the right.
fn ramp([x, _]: [f64; 2]) -> f64 {
    (1.0 + 2.0 * x) / 3.0
}

/// The fraction of the ramp's points to the left of a position.
fn ramp_left_of(x: f64) -> f64 {
    (x + x * x) / 2.0
}

#[test]
fn a_constant_density_is_as_good_as_none() {
    let image = [0.3; 12];
    for boundary in BOUNDARIES {
        let domain = unit_square(boundary);
        for density in [Density::Function(&|_| 7.0), Density::Image { values: &image, width: 4, height: 3 }] {
            for start in [random_points(800, 50), darts(800, 51)] {
                let (_, plain) = relax(&Context::new(1).unwrap(), &options(domain).into(), &start, None).unwrap();
                let (relaxed, report) = run(&options(domain), &density, &start);
                let smallest = nearest_distances(&domain, &relaxed).into_iter().fold(f64::INFINITY, f64::min);
                assert!((report.smallest_distance / smallest - 1.0).abs() < 1e-12);
                assert!((report.rho * domain.hexagonal_distance(start.len()) / smallest - 1.0).abs() < 1e-6);
                assert!(
                    report.rho > plain.rho - 0.04
                        && report.relative_covering_radius < plain.relative_covering_radius + 0.05,
                    "{report:?} {plain:?}"
                );
            }
        }
    }
}

#[test]
fn bands_of_a_ramp_have_their_shares() {
    for boundary in BOUNDARIES {
        let domain = unit_square(boundary);
        let density = Density::Function(&ramp);
        // Where the start is uniform, a sixth of the points has to cross the middle.
        for start in [scattered(&domain, &density, 6000, 1), random_points(6000, 2)] {
            let (relaxed, report) = run(&options(domain), &density, &start);
            for band in 0..10 {
                let [from, to] = [band, band + 1].map(|edge| f64::from(edge) / 10.0);
                let found = relaxed.iter().filter(|p| (from..to).contains(&f64::from(p[0]))).count() as f64;
                let expected = 6000.0 * (ramp_left_of(to) - ramp_left_of(from));
                assert!((found / expected - 1.0).abs() < 0.04, "{boundary:?} {band}: {found} for {expected}");
            }
            assert!(report.rho > 0.7 && report.relative_covering_radius < 0.8, "{boundary:?}: {report:?}");
        }
    }
}

#[test]
fn an_image_and_its_function_give_nearly_the_same() {
    let domain = Domain { min: [-1.0, 2.0], max: [1.0, 3.0], boundary: Boundary::Bounded };
    // Rows grow with y.
    let image: Vec<f32> = (0..32).flat_map(|row| [1.0 + row as f32; 64]).collect();
    let image = Density::Image { values: &image, width: 64, height: 32 };
    let function = |[_, y]: [f64; 2]| 1.0 + ((y - 2.0) * 32.0 - 0.5).clamp(0.0, 31.0);
    let start = scattered(&domain, &image, 3000, 3);
    let [a, b] = [image, Density::Function(&function)].map(|density| run(&options(domain), &density, &start).0);
    let count = |points: &[[f32; 2]], top: f32| points.iter().filter(|p| p[1] < top).count() as f64;
    for top in [2.25, 2.5, 2.75] {
        let lower = f64::from(top - 2.0);
        let expected = 3000.0 * (0.5 * lower + 16.0 * lower * lower) / 16.5;
        assert!((count(&a, top) / expected - 1.0).abs() < 0.05, "{} for {expected}", count(&a, top));
        assert!((count(&b, top) / expected - 1.0).abs() < 0.05, "{} for {expected}", count(&b, top));
    }
}

#[test]
fn where_no_points_are_wanted_there_are_none() {
    let disk = |[x, y]: [f64; 2]| if (x - 0.5).hypot(y - 0.5) < 0.3 { 1.0 } else { 0.0 };
    let density = Density::Function(&disk);
    for boundary in BOUNDARIES {
        let domain = unit_square(boundary);
        let (relaxed, report) = run(&options(domain), &density, &scattered(&domain, &density, 1500, 4));
        let spacing = (2.0 * 0.09 * std::f64::consts::PI / (3f64.sqrt() * 1500.0)).sqrt();
        let radius = |p: &[f32; 2]| f64::from(p[0] - 0.5).hypot(f64::from(p[1] - 0.5));
        let strays = relaxed.iter().filter(|p| radius(p) > 0.3 + 0.5 * spacing).count();
        assert!(strays < 3, "{strays}");
        let inner = relaxed.iter().filter(|p| radius(p) < 0.15).count() as f64;
        assert!((inner / 375.0 - 1.0).abs() < 0.04, "{inner}");
        assert!(report.rho > 0.7, "{report:?}");
        // From a uniform start they come from everywhere, which takes its time.
        let (relaxed, _) = run(&options(domain).max_iterations(800), &density, &random_points(1500, 5));
        let strays = relaxed.iter().filter(|p| radius(p) > 0.3 + spacing).count();
        assert!(strays < 15, "{boundary:?}: {strays}");
    }
}

/// Blank squares in the middle and across the seam, of an image that is stretched.
#[test]
fn no_point_is_left_more_than_two_pixels_inside_blank_paper() {
    let (width, height) = (200, 150);
    for corner in [[75, 50], [150, 120]] {
        let depth = |point: [f64; 2]| {
            let side = |axis: usize, pixels: f64| {
                let at = (point[axis] * pixels - f64::from(corner[axis])).rem_euclid(pixels);
                at.min(50.0 - at)
            };
            side(0, f64::from(width)).min(side(1, f64::from(height)))
        };
        let center = |index: i32, count: i32| (f64::from(index) + 0.5) / f64::from(count);
        let value = |index: i32| depth([center(index % width, width), center(index / width, height)]);
        let values: Vec<f32> = (0..width * height).map(|index| if value(index) > 0.0 { 0.0 } else { 1.0 }).collect();
        let density = Density::Image { values: &values, width: width as usize, height: height as usize };
        for (boundary, seed) in BOUNDARIES.into_iter().flat_map(|boundary| (0..4).map(move |seed| (boundary, seed))) {
            let domain = Domain { min: [-1.0, 2.0], max: [0.0, 2.5], boundary };
            for (start, steps) in [(scattered(&domain, &density, 500, seed), 100), (uniform(&domain, seed), 1)] {
                let options = options(domain).max_iterations(steps);
                let (relaxed, _) = run(&options, &density, &start);
                let share = |p: &[f32; 2]| [f64::from(p[0]) + 1.0, (f64::from(p[1]) - 2.0) / 0.5];
                let deepest = relaxed.iter().map(|p| depth(share(p))).fold(f64::NEG_INFINITY, f64::max);
                assert!(deepest <= 2.0, "{boundary:?} {corner:?} {seed} {steps}: {deepest}");
            }
        }
    }
}

/// Random points of a domain, wherever they are wanted.
fn uniform(domain: &Domain, seed: u64) -> Vec<[f32; 2]> {
    scattered(domain, &Density::Function(&|_| 1.0), 500, seed)
}

#[test]
fn a_function_is_called_once_for_each_place_before_the_first_report() {
    for boundary in BOUNDARIES {
        let (domain, start, places) = (unit_square(boundary), random_points(500, 60), Mutex::new(HashSet::new()));
        let is_reported = AtomicBool::new(false);
        let function = |place: [f64; 2]| {
            assert!(!is_reported.load(Ordering::Relaxed), "{place:?} is asked for late");
            assert!(places.lock().unwrap().insert(place.map(f64::to_bits)), "{place:?} is asked for twice");
            ramp(place)
        };
        let progress = |_| {
            is_reported.store(true, Ordering::Relaxed);
            ControlFlow::Continue(())
        };
        let (context, density) = (Context::new(2).unwrap(), Density::Function(&function));
        relax_with_density(&context, &options(domain).max_iterations(5), &density, &start, Some(&progress)).unwrap();
        let count = std::mem::take(&mut *places.lock().unwrap()).len();
        assert!((start.len()..1000 * start.len()).contains(&count), "{count} places");
        is_reported.store(false, Ordering::Relaxed);
        scatter(&context, &domain, &density, 500, 61, None).unwrap();
    }
}

#[test]
fn a_single_pixel_attracts_all() {
    let mut image = vec![0.0; 100];
    image[37] = 1.0;
    let density = Density::Image { values: &image, width: 10, height: 10 };
    let domain = unit_square(Boundary::Bounded);
    let start = scattered(&domain, &density, 100, 6);
    for points in [start, random_points(100, 7)] {
        let (relaxed, _) = run(&options(domain).max_iterations(300), &density, &points);
        let near = |p: &&[f32; 2]| (p[0] - 0.75).abs() < 0.16 && (p[1] - 0.35).abs() < 0.16;
        assert!(relaxed.iter().filter(near).count() >= 95);
    }
}

#[test]
fn the_result_does_not_depend_on_the_threads() {
    for boundary in BOUNDARIES {
        let domain = unit_square(boundary);
        let density = Density::Function(&ramp);
        let start = scattered(&domain, &density, 5000, 8);
        let options = options(domain).max_iterations(6);
        let expected = run(&options, &density, &start);
        let four = Context::new(4).unwrap();
        assert_eq!(scatter(&four, &domain, &density, 5000, 8, None).unwrap(), start);
        assert_eq!(relax_with_density(&four, &options, &density, &start, None).unwrap(), expected);
        let progress = |_| ControlFlow::Continue(());
        assert_eq!(relax_with_density(&four, &options, &density, &start, Some(&progress)).unwrap(), expected);
    }
}

#[test]
fn the_unit_of_the_density_does_not_matter() {
    let image: Vec<f32> = (0..400).map(|i| ((i * 37) % 101) as f32).collect();
    let scaled: Vec<f32> = image.iter().map(|x| x * 1024.0).collect();
    let domain = unit_square(Boundary::Periodic);
    let [a, b] = [image, scaled].map(|values| {
        let density = Density::Image { values: &values, width: 20, height: 20 };
        run(&options(domain).max_iterations(10), &density, &scattered(&domain, &density, 500, 9)).0
    });
    assert_eq!(a, b);
}

#[test]
fn few_points_are_spread_and_none_and_one_stay() {
    let density = Density::Function(&ramp);
    for boundary in BOUNDARIES {
        let domain = unit_square(boundary);
        for points in [vec![], vec![[0.25, 0.5]]] {
            let (relaxed, report) = run(&options(domain), &density, &points);
            assert_eq!(relaxed, points);
            assert!(report.stopped == Stopped::Converged && report.rho == f64::INFINITY, "{report:?}");
        }
        for count in [2, 3, 5, 8] {
            for points in [random_points(count, 10), vec![[0.5, 0.5]; count]] {
                let (relaxed, report) = run(&options(domain).max_iterations(1000), &density, &points);
                assert!(report.rho > 0.3, "{boundary:?}: {relaxed:?} {report:?}");
            }
        }
    }
}

#[test]
fn what_is_scattered_follows_the_density() {
    let domain = Domain { min: [0.0, -1.0], max: [1.0, 1.0], boundary: Boundary::Bounded };
    let points = scattered(&domain, &Density::Function(&ramp), 40_000, 11);
    for x in [0.25, 0.5, 0.75] {
        let left = points.iter().filter(|p| f64::from(p[0]) < x).count() as f64 / 40_000.0;
        assert!((left - ramp_left_of(x)).abs() < 0.01, "{left}");
    }
    let lower = points.iter().filter(|p| p[1] < 0.0).count() as f64 / 40_000.0;
    assert!((lower - 0.5).abs() < 0.01, "{lower}");
    assert!(points.iter().all(|p| (0.0..1.0).contains(&p[0]) && (-1.0..1.0).contains(&p[1])));
}

#[test]
fn a_cancelled_call_returns_what_it_has() {
    let domain = unit_square(Boundary::Bounded);
    let density = Density::Function(&ramp);
    let start = scattered(&domain, &density, 800, 12);
    for limit in [0.0, 0.5] {
        let progress = |share| if share >= limit { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        let context = Context::new(1).unwrap();
        let (points, report) =
            relax_with_density(&context, &options(domain), &density, &start, Some(&progress)).unwrap();
        assert_eq!(report.stopped, Stopped::Cancelled);
        let same = points.iter().zip(&start).all(|(&a, &b)| distance(&domain, a, b) == 0.0);
        assert_eq!(same, limit == 0.0);
    }
}

#[test]
fn what_is_no_density_is_refused_by_name() {
    let domain = unit_square(Boundary::Bounded);
    let points = random_points(20, 13);
    let refused = |options: DelaunayOptions, density: Density| {
        let context = Context::new(2).unwrap();
        match relax_with_density(&context, &options, &density, &points, None).unwrap_err() {
            Error::InvalidArgument { argument, .. } => argument,
            other => panic!("{other}"),
        }
    };
    for bad in [-1.0, f32::NAN, f32::INFINITY] {
        let image = [1.0, 1.0, bad, 1.0];
        assert_eq!(refused(options(domain), Density::Image { values: &image, width: 2, height: 2 }), "density");
        let function = |[x, _]: [f64; 2]| if x > 0.9 { f64::from(bad) } else { 1.0 };
        assert_eq!(refused(options(domain), Density::Function(&function)), "density");
    }
    assert_eq!(refused(options(domain), Density::Function(&|_| 1e300)), "density");
    assert_eq!(refused(options(domain), Density::Function(&|_| 0.0)), "density");
    let zeros = [0.0; 4];
    assert_eq!(refused(options(domain), Density::Image { values: &zeros, width: 2, height: 2 }), "density");
    assert_eq!(refused(options(domain), Density::Image { values: &zeros, width: 3, height: 2 }), "density");
    assert_eq!(refused(options(domain), Density::Image { values: &zeros, width: usize::MAX, height: 4 }), "density");
    assert_eq!(refused(options(domain), Density::Image { values: &[], width: 0, height: 4 }), "width");
    assert_eq!(refused(options(domain), Density::Image { values: &[], width: 4, height: 0 }), "height");
}

#[test]
fn a_call_without_a_choice_of_method_takes_the_options_that_it_has_and_refuses_others() {
    let refused = |options: Options| match options.to_delaunay("densities").unwrap_err() {
        Error::InvalidArgument { argument, .. } => argument,
        other => panic!("{other}"),
    };
    let all = options(unit_square(Boundary::Bounded)).max_iterations(7).seed(8).tolerance(0.5);
    assert_eq!(Options::from(all).to_delaunay("densities").unwrap(), all);
    assert_eq!(refused(Options::new(all.domain, Neighbourhood::Nearest)), "neighbourhood");
    assert_eq!(refused(Options::thesis(all.domain, Neighbourhood::Delaunay)), "method");
}

#[test]
fn strips_and_domains_that_floats_can_hardly_resolve_stay_inside() {
    let unit = random_points(200, 14);
    for [min, max] in [[1000.1, 1000.4], [-1e30, 1e30], [-2e-40, 3e-39], [16777215.0, 16777230.0]] {
        for boundary in BOUNDARIES {
            let domain = Domain { min: [min; 2], max: [max; 2], boundary };
            let place = |x: f32| ((min + f64::from(x) * (max - min)) as f32).max(min as f32);
            let inside = |p: &[f32; 2]| p.iter().all(|&x| (min..max).contains(&f64::from(x)));
            let points: Vec<_> = unit.iter().map(|p| p.map(place)).filter(inside).collect();
            let density = Density::Function(&|[x, _]| if x > min + 0.3 * (max - min) { 1.0 } else { 0.2 });
            run(&options(domain).max_iterations(12), &density, &points);
        }
    }
    for boundary in BOUNDARIES {
        let domain = Domain { min: [0.0; 2], max: [200.0, 1.0], boundary };
        let density = Density::Function(&|[x, _]| 1.0 + x);
        let points = scattered(&domain, &density, 120, 15);
        let (relaxed, _) = run(&options(domain).max_iterations(400), &density, &points);
        let left = relaxed.iter().filter(|p| p[0] < 100.0).count();
        // The integral of the density over the left half is 30.3 of 120.
        assert!((28..33).contains(&left), "{left}");
    }
}
