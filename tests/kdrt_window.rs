//! Windows and streams of `kdrt` against the whole set: always the same floats in the same order.

mod common;
#[path = "common/sets.rs"]
#[allow(dead_code)]
mod sets;
#[path = "common/tiled.rs"]
mod tiled;
#[path = "common/windows.rs"]
mod windows;

use azulejo::kdrt::{DEFAULT_LEAF_SIZE, Options, sample, sample_stream, sample_window};
use azulejo::{Boundary, Context, Domain, Error};
use common::{BOUNDARIES, check, domain, find_conflict, find_gap, float_spacing, hard_domains};
use proptest::prelude::*;
use sets::Random;
use std::cell::Cell;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};
use tiled::tiled_radius;
use windows::{Rect, between, part_of, random_window};

fn window(options: &Options, (min, max): Rect) -> Vec<[f32; 2]> {
    sample_window(&Context::new(1).unwrap(), options, min, max, None).unwrap()
}

fn whole(options: &Options) -> Vec<[f32; 2]> {
    sample(&Context::new(2).unwrap(), options, None).unwrap()
}

/// Cuts a rectangle across, again and again.
fn random_partition(random: &mut Random, (min, max): Rect, cuts: u32, samples: &[[f32; 2]]) -> Vec<Rect> {
    let axis = usize::from(random.unit() < 0.5);
    // Half of the cuts go through a sample, if one can be had, which must be in one of the two windows.
    let through = f64::from(samples[(random.unit() * samples.len() as f32) as usize][axis]);
    let is_inside = |cut: f64| min[axis] < cut && cut < max[axis];
    let cut =
        if cuts.is_multiple_of(2) && is_inside(through) { through } else { between(random, min[axis], max[axis]) };
    if cuts == 0 || !is_inside(cut) {
        return vec![(min, max)];
    }
    let (mut end, mut start) = (max, min);
    end[axis] = cut;
    start[axis] = cut;
    let mut parts = random_partition(random, (min, end), cuts - 1, samples);
    parts.extend(random_partition(random, (start, max), cuts - 1, samples));
    parts
}

#[test]
fn windows_of_hard_domains_are_parts_of_the_whole() {
    let mut random = Random::new(1);
    for boundary in BOUNDARIES {
        for domain in hard_domains(boundary) {
            for (seed, leaf_size) in [(0, 6.0), (1, 9.5), (2, DEFAULT_LEAF_SIZE)] {
                let radius = tiled_radius(&domain, leaf_size).max(64.0 * float_spacing(&domain));
                let options = Options::new(radius).domain(domain).leaf_size(leaf_size).seed(seed);
                let whole = whole(&options);
                assert!(window(&options, (domain.min, domain.max)) == whole);
                for _ in 0..8 {
                    let rect = random_window(&mut random, &domain);
                    assert!(window(&options, rect) == part_of(&whole, rect), "{options:?}, {rect:?}");
                }
            }
        }
    }
}

/// Cells are as wide as the lattice allows, so a few are a lattice point wider than the others: a window need not have any.
#[test]
fn windows_without_the_widest_cells_are_parts_of_the_whole() {
    let domain = domain([0.0; 2], [0.44543627703057015, 0.024653297013654124], Boundary::Bounded);
    let options = Options::new(0.0008558173968672642).domain(domain).leaf_size(6.0).seed(379135351191757);
    let (whole, mut random) = (whole(&options), Random::new(6));
    for _ in 0..40 {
        let rect = random_window(&mut random, &domain);
        assert!(window(&options, rect) == part_of(&whole, rect), "{rect:?}");
    }
}

#[test]
fn windows_of_large_leaves_are_parts_of_the_whole() {
    let mut random = Random::new(2);
    for boundary in BOUNDARIES {
        for (leaf_size, side) in [(40.0, 210.0), (80.0, 330.0)] {
            let domain = domain([-0.2, 0.0], [1.1, 0.9], boundary);
            let options = Options::new(domain.area().sqrt() / side).domain(domain).leaf_size(leaf_size).seed(7);
            let whole = whole(&options);
            for _ in 0..4 {
                let rect = random_window(&mut random, &domain);
                assert!(window(&options, rect) == part_of(&whole, rect), "{rect:?}");
            }
        }
    }
}

#[test]
fn a_partition_into_windows_has_every_sample_once() {
    let mut random = Random::new(3);
    for boundary in BOUNDARIES {
        for (seed, extent) in [[1.0, 1.2], [12.0, 0.13], [0.15, 9.0]].into_iter().enumerate() {
            let domain = domain([0.3, -0.7], [0.3 + extent[0], -0.7 + extent[1]], boundary);
            let options = Options::new(tiled_radius(&domain, 6.0)).domain(domain).leaf_size(6.0).seed(seed as u64);
            let mut whole = whole(&options);
            let parts = random_partition(&mut random, (domain.min, domain.max), 6, &whole);
            assert!(parts.len() > 8);
            let mut samples: Vec<_> = parts.into_iter().flat_map(|part| window(&options, part)).collect();
            let order = |a: &[f32; 2], b: &[f32; 2]| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]));
            samples.sort_unstable_by(order);
            whole.sort_unstable_by(order);
            assert!(samples == whole, "{boundary:?}, {extent:?}");
            check(&domain, options.radius, &samples);
        }
    }
}

/// Corners, boundaries, lines through everything, and windows that hold one float.
#[test]
fn windows_at_the_edge_of_what_there_is() {
    for boundary in BOUNDARIES {
        let domain = domain([-3.3, 1.7], [-1.1, 3.3], boundary);
        let options = Options::new(tiled_radius(&domain, 6.0)).domain(domain).leaf_size(6.0).seed(4);
        let (whole, r, Domain { min, max, .. }) = (whole(&options), options.radius, domain);
        let spacing = float_spacing(&domain);
        let mut rects = vec![
            (min, min.map(|x| x + 0.4 * r)),
            (max.map(|x| x - 0.4 * r), max),
            (max.map(|x| x - 30.0 * r), max),
            ([min[0], max[1] - r], [min[0] + 9.0 * r, max[1]]),
            ([min[0], 2.5], [max[0], 2.5 + r]),
            ([-2.0, min[1]], [-2.0 + 0.2 * r, max[1]]),
            (min, min.map(|x| x + 1e-3 * spacing)),
            ([-2.0 + 0.2 * spacing, 2.0 + 0.2 * spacing], [-2.0 + 0.4 * spacing, 2.0 + 0.4 * spacing]),
        ];
        for &sample in whole.iter().step_by(97) {
            let sample = sample.map(f64::from);
            rects.push((sample, sample.map(|x| x + 0.5 * spacing)));
            rects.push((sample.map(|x| x - r), sample));
        }
        for (mut min, mut max) in rects {
            min = [0, 1].map(|axis| min[axis].max(domain.min[axis]));
            max = [0, 1].map(|axis| max[axis].min(domain.max[axis]));
            assert!(window(&options, (min, max)) == part_of(&whole, (min, max)), "{min:?} {max:?}");
        }
    }
}

#[test]
fn domains_that_are_not_tiled_have_windows_and_a_stream_too() {
    let mut random = Random::new(5);
    for boundary in BOUNDARIES {
        for (extent, radius) in [([1.0, 1.0], 0.02), ([1.0, 1.0], 5.0), ([1.0, 0.01], 0.02), ([1e-7, 40.0], 0.3)] {
            let domain = domain([0.5; 2], extent.map(|x| 0.5 + x), boundary);
            let options = Options::new(radius).domain(domain).seed(3);
            let whole = whole(&options);
            assert!(window(&options, (domain.min, domain.max)) == whole);
            assert!(streamed(1, &options) == std::slice::from_ref(&whole));
            for _ in 0..20 {
                let rect = random_window(&mut random, &domain);
                assert!(window(&options, rect) == part_of(&whole, rect), "{rect:?}");
            }
        }
    }
}

/// The parts of a stream.
fn streamed(threads: usize, options: &Options) -> Vec<Vec<[f32; 2]>> {
    let mut parts = Vec::new();
    let caller = std::thread::current().id();
    let visit = |samples: &[[f32; 2]]| {
        assert!(!samples.is_empty() && std::thread::current().id() == caller);
        parts.push(samples.to_vec());
        ControlFlow::Continue(())
    };
    sample_stream(&Context::new(threads).unwrap(), options, visit, None).unwrap();
    parts
}

#[test]
fn a_stream_is_the_whole_in_parts_that_do_not_depend_on_the_threads() {
    for boundary in BOUNDARIES {
        let domain = domain([1e5, -3e4], [1e5 + 1234.5, -3e4 + 999.9], boundary);
        let options = Options::new(0.9).domain(domain).seed(1);
        let parts = streamed(1, &options);
        assert!(parts.len() > 10 && parts.iter().all(|part| part.len() < 55_000));
        for part in &parts {
            let extent = [0, 1].map(|axis| {
                let along = part.iter().map(|sample| f64::from(sample[axis]));
                along.clone().fold(f64::NEG_INFINITY, f64::max) - along.fold(f64::INFINITY, f64::min)
            });
            assert!(extent.iter().all(|&extent| extent < 275.0 * 0.9), "{extent:?}");
        }
        assert!(parts.concat() == whole(&options));
        assert!(parts == streamed(4, &options));
    }
}

#[test]
fn windows_do_not_depend_on_the_threads() {
    for boundary in BOUNDARIES {
        let options = Options::new(0.001).domain(Domain::unit(boundary)).seed(1);
        let [one, four] = [1, 4].map(|threads| {
            let context = Context::new(threads).unwrap();
            sample_window(&context, &options, [0.1, 0.2], [0.9, 0.97], None).unwrap()
        });
        assert!(one.len() > 400_000 && one == four);
    }
}

/// A billion samples and a hundred billion: they are never held, but any window is made at once.
#[test]
fn windows_of_planes_that_nobody_can_hold() {
    for (domain, radius) in [
        (Domain::unit(Boundary::Periodic), 2.6e-5),
        (Domain::unit(Boundary::Bounded), 8.2e-6),
        (domain([-1.0; 2], [1.0; 2], Boundary::Periodic), 3.9e-6),
    ] {
        let options = Options::new(radius).domain(domain).seed(11);
        let side = 50.0 * radius;
        for corner in [[0.7, 0.3], [0.123_456_789, 0.987_654_321], domain.min, domain.max.map(|x| x - side)] {
            let start = Instant::now();
            let rect = (corner, corner.map(|x| x + side));
            let samples = window(&options, rect);
            assert!(start.elapsed() < Duration::from_secs(2));
            assert!((1500..2200).contains(&samples.len()), "{}", samples.len());

            // As the middle of a larger window: without conflict or gap, and the same samples in it.
            let min = [0, 1].map(|axis| (corner[axis] - 7.0 * radius).max(domain.min[axis]));
            let max = [0, 1].map(|axis| (corner[axis] + side + 5.5 * radius).min(domain.max[axis]));
            let larger = window(&options, (min, max));
            assert!(part_of(&larger, rect) == samples);
            let inner = Domain { min: rect.0, max: rect.1, boundary: Boundary::Bounded };
            assert_eq!(find_conflict(&inner, radius, &larger), None);
            if corner[0] == 0.7 {
                assert_eq!(find_gap(&inner, radius + 3.0 * float_spacing(&domain), &larger), None);
            }

            let cut = corner.map(|x| x + 0.37 * side);
            let quarters = [
                (rect.0, cut),
                ([cut[0], rect.0[1]], [rect.1[0], cut[1]]),
                ([rect.0[0], cut[1]], [cut[0], rect.1[1]]),
                (cut, rect.1),
            ];
            for quarter in quarters {
                assert!(window(&options, quarter) == part_of(&samples, quarter));
            }
        }
    }
}

/// On a plane too large for `sample`; the stream starts at once and ends when its visitor says so.
#[test]
fn a_stream_of_a_plane_that_nobody_can_hold_can_be_left() {
    let options = Options::new(8.2e-6);
    for threads in [1, 4] {
        let context = Context::new(threads).unwrap();
        assert!(matches!(sample(&context, &options, None), Err(Error::TooLarge { argument: "radius", .. })));
        for last in [1, 7] {
            let mut visits = 0;
            let visit = |_: &[[f32; 2]]| {
                visits += 1;
                if visits == last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            assert!(matches!(sample_stream(&context, &options, visit, None), Err(Error::Cancelled)));
            assert_eq!(visits, last);
        }
    }
}

#[test]
fn calls_can_be_cancelled_at_any_time() {
    let options = Options::new(0.002);
    for threads in [1, 4] {
        let context = Context::new(threads).unwrap();
        for limit in [0.0, 0.02, 0.3, 1.0] {
            let told = Cell::new(0.0);
            let stop = |share| {
                assert!(told.replace(share) <= share);
                if share >= limit { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            let result = sample_window(&context, &options, [0.0; 2], [0.9; 2], Some(&stop));
            assert!(matches!(result, Err(Error::Cancelled)), "{limit}");
            told.set(0.0);
            let result = sample_stream(&context, &options, |_| ControlFlow::Continue(()), Some(&stop));
            assert!(matches!(result, Err(Error::Cancelled)), "{limit}");
        }
    }
}

#[test]
fn bad_windows_are_refused_by_name() {
    let domain = domain([-1.0, 2.0], [1.0, 5.0], Boundary::Periodic);
    let good = Options::new(0.01).domain(domain);
    let context = Context::new(1).unwrap();
    let refuse = |options: &Options, min, max| sample_window(&context, options, min, max, None).unwrap_err();
    let (min, max) = ([-0.5, 2.5], [0.5, 3.5]);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.000_000_1, 5.1] {
        for axis in 0..2 {
            let put = |mut corner: [f64; 2]| {
                corner[axis] = bad;
                corner
            };
            let error = refuse(&good, put(min), max);
            assert!(matches!(error, Error::InvalidArgument { argument: "window_min", .. }), "{error}");
            let error = refuse(&good, min, put(max));
            assert!(matches!(error, Error::InvalidArgument { argument: "window_max", .. }), "{error}");
        }
    }
    assert_eq!(refuse(&good, [-0.5, 1.9], max).to_string(), "window_min: [1] is 1.9, outside the domain 2 to 5");
    assert_eq!(refuse(&good, max, min).to_string(), "window_max: [0] is -0.5, not above window_min 0.5");
    let error = refuse(&good, min, [0.5, 2.5]);
    assert!(matches!(error, Error::InvalidArgument { argument: "window_max", .. }), "{error}");

    // What is wrong with the options is said as by the whole.
    for options in [
        good.radius(0.0),
        good.radius(f64::NAN),
        good.leaf_size(5.9),
        good.domain(Domain { min: [f64::NAN; 2], ..domain }),
        good.domain(Domain { max: [-2.0; 2], ..domain }),
    ] {
        let expected = sample(&context, &options, None).unwrap_err().to_string();
        assert_eq!(refuse(&options, min, max).to_string(), expected);
        let error = sample_stream(&context, &options, |_| panic!("visited"), None).unwrap_err();
        assert_eq!(error.to_string(), expected);
    }
    let coarse = good.radius(1e-5);
    let finest = "radius: 1e-5 is below 3.0517578125e-5, 64 times the float spacing";
    assert!(refuse(&coarse, [0.1, 2.1], [0.2, 2.2]).to_string().starts_with(finest));
}

/// The limits count the samples that are made.
#[test]
fn windows_that_are_too_large_are_refused_before_work() {
    let options = Options::new(8.2e-6).domain(Domain::unit(Boundary::Bounded));
    let context = Context::new(1).unwrap();
    let error = sample_window(&context, &options, [0.0; 2], [1.0, 0.5], None).unwrap_err();
    assert!(matches!(error, Error::TooLarge { argument: "radius", .. }));
    assert!(error.to_string().contains("about 5.18e9 samples"), "{error}");
    let untiled = options.leaf_size(1e30);
    let error = sample_window(&context, &untiled, [0.0; 2], [1e-3; 2], None).unwrap_err();
    assert!(matches!(error, Error::TooLarge { argument: "radius", .. }), "the whole would be made");
    let error = sample_stream(&context, &untiled, |_| panic!("visited"), None).unwrap_err();
    assert!(matches!(error, Error::TooLarge { argument: "radius", .. }));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_window_of_any_plane(
        corner in prop::array::uniform2(-4.0..4.0f64),
        height in -3.0..3.0f64,
        aspect in -3.0..3.0f64,
        factor in -5.6..-3.0f64,
        leaf_size in 6.0..60.0f64,
        periodic: bool,
        seed: u64,
    ) {
        let (height, aspect) = (height.exp(), aspect.exp());
        let boundary = BOUNDARIES[usize::from(!periodic)];
        let domain = domain(corner, [corner[0] + height * aspect, corner[1] + height], boundary);
        let options = Options::new(factor.exp() * domain.area().sqrt()).domain(domain).leaf_size(leaf_size).seed(seed);
        let (whole, mut random) = (whole(&options), Random::new(seed));
        for _ in 0..4 {
            let rect = random_window(&mut random, &domain);
            prop_assert!(window(&options, rect) == part_of(&whole, rect), "{:?}, {:?}", options, rect);
        }
    }
}
