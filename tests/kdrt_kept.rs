//! Windows of kept planes against the whole set and against windows made without them: the same floats in the same
//! order.

mod common;
#[path = "common/sets.rs"]
#[allow(dead_code)]
mod sets;
#[path = "common/tiled.rs"]
mod tiled;
#[path = "common/windows.rs"]
mod windows;

use azulejo::kdrt::{DEFAULT_LEAF_SIZE, Options, Plane, sample, sample_window};
use azulejo::{Boundary, Context, Domain, Error};
use common::{BOUNDARIES, check, domain, find_conflict, find_gap, float_spacing, hard_domains};
use proptest::prelude::*;
use sets::Random;
use std::cell::Cell;
use std::ops::ControlFlow;
use tiled::tiled_radius;
use windows::{Rect, between, part_of, random_window};

/// A plane whose context is gone.
fn kept(threads: usize, options: &Options) -> Plane {
    Plane::new(&Context::new(threads).unwrap(), options, None).unwrap()
}

fn whole(options: &Options) -> Vec<[f32; 2]> {
    sample(&Context::new(2).unwrap(), options, None).unwrap()
}

fn check_window(plane: &Plane, whole: &[[f32; 2]], (min, max): Rect) {
    assert!(plane.window(min, max).unwrap() == part_of(whole, (min, max)), "{min:?} {max:?}");
}

/// A window of a domain with sides of up to so many radii.
fn small_window(random: &mut Random, options: &Options, radii: f64) -> Rect {
    let Domain { min, max, .. } = options.domain;
    let mut rect = (min, max);
    for axis in 0..2 {
        rect.0[axis] = between(random, min[axis], max[axis]).min(max[axis].next_down());
        let side = options.radius * between(random, 0.0, radii);
        rect.1[axis] = (rect.0[axis] + side).max(rect.0[axis].next_up()).min(max[axis]);
    }
    rect
}

#[test]
fn windows_of_hard_domains_are_parts_of_the_whole() {
    let (mut random, context) = (Random::new(1), Context::new(1).unwrap());
    for boundary in BOUNDARIES {
        for domain in hard_domains(boundary) {
            for (seed, leaf_size) in [(0, 6.0), (1, 9.5), (2, DEFAULT_LEAF_SIZE)] {
                let radius = tiled_radius(&domain, leaf_size).max(64.0 * float_spacing(&domain));
                let options = Options::new(radius).domain(domain).leaf_size(leaf_size).seed(seed);
                let (plane, whole) = (kept(1, &options), whole(&options));
                check_window(&plane, &whole, (domain.min, domain.max));
                for _ in 0..20 {
                    check_window(&plane, &whole, random_window(&mut random, &domain));
                    check_window(&plane, &whole, small_window(&mut random, &options, 20.0));
                }
                let (min, max) = random_window(&mut random, &domain);
                let alone = sample_window(&context, &options, min, max, None).unwrap();
                assert!(plane.window(min, max).unwrap() == alone);
            }
        }
    }
}

/// Planes of many of the windows that the whole is made of, whose samples one small window has from up to four.
#[test]
fn windows_where_others_meet_have_the_order_of_the_whole() {
    let mut random = Random::new(2);
    for boundary in BOUNDARIES {
        for (seed, leaf_size) in [(0, 6.0), (1, DEFAULT_LEAF_SIZE), (2, 45.0)] {
            let domain = domain([-0.4, 0.2], [0.8, 1.0], boundary);
            let options = Options::new(1.0 / 900.0).domain(domain).leaf_size(leaf_size).seed(seed);
            let (plane, whole) = (kept(2, &options), whole(&options));
            for _ in 0..60 {
                check_window(&plane, &whole, small_window(&mut random, &options, 260.0));
                check_window(&plane, &whole, small_window(&mut random, &options, 60.0));
            }
        }
    }
}

/// Corners, boundaries, and windows that hold one float or none.
#[test]
fn windows_at_the_edge_of_what_there_is() {
    for boundary in BOUNDARIES {
        // Tiled, and as a whole.
        for factor in [1.0, 1.5] {
            let domain = domain([-3.3, 1.7], [-1.1, 3.3], boundary);
            let options = Options::new(factor * tiled_radius(&domain, 6.0)).domain(domain).leaf_size(6.0).seed(4);
            let (plane, whole) = (kept(1, &options), whole(&options));
            let (r, spacing, Domain { min, max, .. }) = (options.radius, float_spacing(&domain), domain);
            check(&domain, r, &plane.window(min, max).unwrap());
            let mut rects = vec![
                (min, min.map(|x| x + 0.4 * r)),
                (max.map(|x| x - 0.4 * r), max),
                (max.map(|x| x - 30.0 * r), max),
                (max.map(|x| x.next_down()), max),
                (min, min.map(|x| x.next_up())),
                ([min[0], 2.5], [max[0], 2.5 + 0.3 * r]),
                ([-2.0, min[1]], [-2.0 + 0.3 * r, max[1]]),
                ([-2.0 + 0.2 * spacing, 2.0 + 0.2 * spacing], [-2.0 + 0.4 * spacing, 2.0 + 0.4 * spacing]),
            ];
            for &sample in whole.iter().step_by(29) {
                let sample = sample.map(f64::from);
                rects.push((sample, sample.map(|x| x + 0.5 * spacing)));
                rects.push((sample, sample.map(|x| x.next_up())));
                rects.push((sample.map(|x| x - r), sample));
            }
            for (mut min, mut max) in rects {
                min = [0, 1].map(|axis| min[axis].max(domain.min[axis]));
                max = [0, 1].map(|axis| max[axis].min(domain.max[axis]));
                check_window(&plane, &whole, (min, max));
            }
        }
    }
}

#[test]
fn domains_that_are_not_tiled_have_windows_too() {
    let mut random = Random::new(5);
    for boundary in BOUNDARIES {
        for (extent, radius) in [
            ([1.0, 1.0], 0.02),
            ([1.0, 1.0], 0.0052),
            ([1.0, 1.0], 5.0),
            ([1.0, 0.01], 0.02),
            ([0.05, 4.0], 0.006),
            ([4.0, 0.05], 0.006),
            ([1e-7, 40.0], 0.3),
            ([40.0, 1e-7], 0.3),
        ] {
            for corner in [[0.5; 2], [-0.03, 0.0]] {
                let domain = domain(corner, [0, 1].map(|axis| corner[axis] + extent[axis]), boundary);
                let options = Options::new(radius).domain(domain).seed(3);
                let (plane, whole) = (kept(2, &options), whole(&options));
                check_window(&plane, &whole, (domain.min, domain.max));
                for _ in 0..40 {
                    check_window(&plane, &whole, random_window(&mut random, &domain));
                    check_window(&plane, &whole, small_window(&mut random, &options, 5.0));
                }
            }
        }
    }
}

#[test]
fn threads_make_windows_of_one_plane_at_once() {
    for boundary in BOUNDARIES {
        for radius in [0.002, 0.02] {
            let options = Options::new(radius).domain(Domain::unit(boundary)).seed(6);
            let (plane, whole) = (kept(2, &options), whole(&options));
            std::thread::scope(|scope| {
                for seed in 0..4 {
                    let (plane, whole, options) = (&plane, &whole, &options);
                    scope.spawn(move || {
                        let mut random = Random::new(seed);
                        for _ in 0..40 {
                            check_window(plane, whole, small_window(&mut random, options, 70.0));
                        }
                    });
                }
            });
        }
    }
}

/// A billion samples and more: many windows at once, each without conflict or gap.
#[test]
fn windows_of_planes_that_nobody_can_hold() {
    let mut random = Random::new(7);
    for (domain, radius) in
        [(Domain::unit(Boundary::Periodic), 8.4e-6), (domain([-1.0; 2], [1.0; 2], Boundary::Bounded), 3.9e-6)]
    {
        let options = Options::new(radius).domain(domain).seed(11);
        let plane = kept(1, &options);
        for _ in 0..100 {
            let rect = small_window(&mut random, &options, 60.0);
            let min = [0, 1].map(|axis| (rect.0[axis] - 3.0 * radius).max(domain.min[axis]));
            let max = [0, 1].map(|axis| (rect.1[axis] + 5.0 * radius).min(domain.max[axis]));
            let larger = plane.window(min, max).unwrap();
            assert!(plane.window(rect.0, rect.1).unwrap() == part_of(&larger, rect), "{rect:?}");
            let inner = Domain { min: rect.0, max: rect.1, boundary: Boundary::Bounded };
            assert_eq!(find_conflict(&inner, radius, &larger), None);
            assert_eq!(find_gap(&inner, radius + 3.0 * float_spacing(&domain), &larger), None);
        }
    }
}

#[test]
fn the_making_can_be_cancelled() {
    for options in [Options::new(0.002), Options::new(0.02)] {
        for (threads, limit) in [(1, 0.0), (1, 0.5), (4, 0.2), (4, 1.0)] {
            let told = Cell::new(0.0);
            let stop = |share| {
                assert!(told.replace(share) <= share);
                if share >= limit { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            let made = Plane::new(&Context::new(threads).unwrap(), &options, Some(&stop));
            assert!(matches!(made, Err(Error::Cancelled)), "{limit}");
        }
    }
}

#[test]
fn bad_planes_and_windows_are_refused_by_name() {
    let domain = domain([-1.0, 2.0], [1.0, 5.0], Boundary::Periodic);
    let good = Options::new(0.01).domain(domain);
    let context = Context::new(1).unwrap();
    // What is wrong with the options is said as by the whole.
    for options in [
        good.radius(0.0),
        good.radius(f64::NAN),
        good.leaf_size(5.9),
        good.domain(Domain { min: [f64::NAN; 2], ..domain }),
        good.domain(Domain { max: [-2.0; 2], ..domain }),
        good.radius(3.1e-5).leaf_size(1e30),
    ] {
        let refusal = Plane::new(&context, &options, None).err().unwrap().to_string();
        assert_eq!(refusal, sample(&context, &options, None).unwrap_err().to_string());
    }
    let refusal = Plane::new(&context, &good.radius(1e-5), None).err().unwrap().to_string();
    assert!(refusal.starts_with("radius: 1e-5 is below 3.0517578125e-5, 64 times the float spacing"), "{refusal}");
    // Tiled, and as a whole.
    for options in [good, good.radius(0.1)] {
        let plane = kept(1, &options);
        let refuse = |min, max| plane.window(min, max).unwrap_err();
        let (min, max) = ([-0.5, 2.5], [0.5, 3.5]);
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.000_000_1, 5.1] {
            for axis in 0..2 {
                let put = |mut corner: [f64; 2]| {
                    corner[axis] = bad;
                    corner
                };
                let error = refuse(put(min), max);
                assert!(matches!(error, Error::InvalidArgument { argument: "window_min", .. }), "{error}");
                let error = refuse(min, put(max));
                assert!(matches!(error, Error::InvalidArgument { argument: "window_max", .. }), "{error}");
            }
        }
        assert_eq!(refuse([-0.5, 1.9], max).to_string(), "window_min: [1] is 1.9, outside the domain 2 to 5");
        assert_eq!(refuse(max, min).to_string(), "window_max: [0] is -0.5, not above window_min 0.5");
        assert_eq!(refuse(min, min).to_string(), "window_max: [0] is -0.5, not above window_min -0.5");
    }
}

/// The limits count the samples that are made.
#[test]
fn windows_that_are_too_large_are_refused_before_work() {
    let options = Options::new(8.2e-6).domain(Domain::unit(Boundary::Bounded));
    let error = kept(1, &options).window([0.0; 2], [1.0, 0.5]).unwrap_err();
    assert!(matches!(error, Error::TooLarge { argument: "radius", .. }));
    assert!(error.to_string().contains("about 5.18e9 samples"), "{error}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_window_of_any_plane(
        corner in prop::array::uniform2(-4.0..4.0f64),
        height in -3.0..3.0f64,
        aspect in -3.0..3.0f64,
        factor in -5.9..-3.0f64,
        leaf_size in 6.0..60.0f64,
        periodic: bool,
        seed: u64,
    ) {
        let (height, aspect) = (height.exp(), aspect.exp());
        let boundary = BOUNDARIES[usize::from(!periodic)];
        let domain = domain(corner, [corner[0] + height * aspect, corner[1] + height], boundary);
        let options = Options::new(factor.exp() * domain.area().sqrt()).domain(domain).leaf_size(leaf_size).seed(seed);
        let (plane, whole, mut random) = (kept(1, &options), whole(&options), Random::new(seed));
        for _ in 0..12 {
            let rect = random_window(&mut random, &domain);
            prop_assert!(plane.window(rect.0, rect.1).unwrap() == part_of(&whole, rect), "{:?}, {:?}", options, rect);
            let rect = small_window(&mut random, &options, 100.0);
            prop_assert!(plane.window(rect.0, rect.1).unwrap() == part_of(&whole, rect), "{:?}, {:?}", options, rect);
        }
    }
}
