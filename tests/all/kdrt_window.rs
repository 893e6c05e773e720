//! Windows and streams of `kdrt` against the whole set: always the same floats in the same order.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use azulejo::kdrt::{DEFAULT_LEAF_SIZE, Kind, Options, Plane, sample, sample_window};
use azulejo::{Boundary, Context, Domain, Error};
use proptest::prelude::*;

use crate::common::sets::Random;
use crate::common::tiled::tiled_radius;
use crate::common::windows::{Rect, between, part_of, random_window};
use crate::common::{BOUNDARIES, check, domain, find_conflict, find_gap, float_spacing, hard_domains};

/// A plane whose context is gone.
fn kept(threads: usize, options: &Options) -> Plane {
    Plane::new(&Context::new(threads).unwrap(), options, None).unwrap()
}

fn whole(options: &Options) -> Vec<[f32; 2]> {
    sample(&Context::new(2).unwrap(), options, None).unwrap().positions
}

/// A window of a plane that is not kept.
fn alone(options: &Options, (min, max): Rect) -> Vec<[f32; 2]> {
    sample_window(&Context::new(1).unwrap(), options, min, max, None).unwrap().positions
}

fn check_window(plane: &Plane, whole: &[[f32; 2]], (min, max): Rect) {
    assert!(plane.window(min, max).unwrap().positions == part_of(whole, (min, max)), "{min:?} {max:?}");
}

/// A window of a domain with sides of up to a length.
fn small_window(random: &mut Random, &Domain { min, max, .. }: &Domain, longest: f64) -> Rect {
    let mut rect = (min, max);
    for axis in 0..2 {
        rect.0[axis] = between(random, min[axis], max[axis]).min(max[axis].next_down());
        let side = between(random, 0.0, longest);
        rect.1[axis] = (rect.0[axis] + side).max(rect.0[axis].next_up()).min(max[axis]);
    }
    rect
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
                let (plane, whole) = (kept(1, &options), whole(&options));
                assert!(plane.whole(&Context::new(2).unwrap(), None).unwrap().positions == whole);
                check_window(&plane, &whole, (domain.min, domain.max));
                for _ in 0..20 {
                    check_window(&plane, &whole, random_window(&mut random, &domain));
                    check_window(&plane, &whole, small_window(&mut random, &domain, 20.0 * radius));
                }
                let rect = random_window(&mut random, &domain);
                assert!(alone(&options, rect) == part_of(&whole, rect), "{options:?}, {rect:?}");
            }
        }
    }
}

/// Cells are as wide as the lattice allows, so a few are a lattice point wider than the others: a window need not have any.
#[test]
fn windows_without_the_widest_cells_are_parts_of_the_whole() {
    let domain = domain([0.0; 2], [0.44543627703057015, 0.024653297013654124], Boundary::Bounded);
    let options = Options::new(0.0008558173968672642).domain(domain).leaf_size(6.0).seed(379135351191757);
    let (plane, whole, mut random) = (kept(1, &options), whole(&options), Random::new(6));
    for _ in 0..40 {
        check_window(&plane, &whole, random_window(&mut random, &domain));
    }
}

#[test]
fn windows_of_large_leaves_are_parts_of_the_whole() {
    let mut random = Random::new(2);
    for boundary in BOUNDARIES {
        for (leaf_size, side) in [(40.0, 210.0), (80.0, 330.0)] {
            let domain = domain([-0.2, 0.0], [1.1, 0.9], boundary);
            let options = Options::new(domain.area().sqrt() / side).domain(domain).leaf_size(leaf_size).seed(7);
            let (plane, whole) = (kept(1, &options), whole(&options));
            for _ in 0..4 {
                check_window(&plane, &whole, random_window(&mut random, &domain));
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
            let radius = 1.0 / 900.0;
            let options = Options::new(radius).domain(domain).leaf_size(leaf_size).seed(seed);
            let (plane, whole) = (kept(2, &options), whole(&options));
            for _ in 0..60 {
                check_window(&plane, &whole, small_window(&mut random, &domain, 260.0 * radius));
                check_window(&plane, &whole, small_window(&mut random, &domain, 60.0 * radius));
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
            let radius = tiled_radius(&domain, 6.0);
            let options = Options::new(radius).domain(domain).leaf_size(6.0).seed(seed as u64);
            let (plane, mut whole) = (kept(1, &options), whole(&options));
            let parts = random_partition(&mut random, (domain.min, domain.max), 6, &whole);
            assert!(parts.len() > 8);
            let mut samples: Vec<_> =
                parts.into_iter().flat_map(|(min, max)| plane.window(min, max).unwrap().positions).collect();
            let order = |a: &[f32; 2], b: &[f32; 2]| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]));
            samples.sort_unstable_by(order);
            whole.sort_unstable_by(order);
            assert!(samples == whole, "{boundary:?}, {extent:?}");
            check(&domain, radius, &samples);
        }
    }
}

/// Corners, boundaries, lines through everything, and windows that hold one float or none.
#[test]
fn windows_at_the_edge_of_what_there_is() {
    for boundary in BOUNDARIES {
        // Tiled, and as a whole.
        for factor in [1.0, 1.5] {
            let domain = domain([-3.3, 1.7], [-1.1, 3.3], boundary);
            let r = factor * tiled_radius(&domain, 6.0);
            let options = Options::new(r).domain(domain).leaf_size(6.0).seed(4);
            let (plane, whole) = (kept(1, &options), whole(&options));
            let (spacing, Domain { min, max, .. }) = (float_spacing(&domain), domain);
            check(&domain, r, &plane.window(min, max).unwrap().positions);
            let mut rects = vec![
                (min, min.map(|x| x + 0.4 * r)),
                (max.map(|x| x - 0.4 * r), max),
                (max.map(|x| x - 30.0 * r), max),
                (max.map(|x| x.next_down()), max),
                (min, min.map(|x| x.next_up())),
                ([min[0], max[1] - r], [min[0] + 9.0 * r, max[1]]),
                (min, min.map(|x| x + 1e-3 * spacing)),
                ([min[0], 2.5], [max[0], 2.5 + 0.3 * r]),
                ([min[0], 2.5], [max[0], 2.5 + r]),
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
fn domains_that_are_not_tiled_have_windows_and_a_stream_too() {
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
                assert!(alone(&options, (domain.min, domain.max)) == whole);
                assert!(streamed(1, &options) == std::slice::from_ref(&whole));
                for _ in 0..40 {
                    check_window(&plane, &whole, random_window(&mut random, &domain));
                    check_window(&plane, &whole, small_window(&mut random, &domain, 5.0 * radius));
                }
            }
        }
    }
}

#[test]
fn threads_make_windows_of_one_plane_at_once() {
    for boundary in BOUNDARIES {
        for radius in [0.002, 0.02] {
            let domain = Domain::unit(boundary);
            let options = Options::new(radius).domain(domain).seed(6);
            let (plane, whole) = (kept(2, &options), whole(&options));
            std::thread::scope(|scope| {
                for seed in 0..4 {
                    let (plane, whole) = (&plane, &whole);
                    scope.spawn(move || {
                        let mut random = Random::new(seed);
                        for _ in 0..40 {
                            check_window(plane, whole, small_window(&mut random, &domain, 70.0 * radius));
                        }
                    });
                }
            });
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
    kept(1, options).stream(&Context::new(threads).unwrap(), visit, None).unwrap();
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
        let plane = kept(1, &options);
        let window = |(min, max): Rect| plane.window(min, max).unwrap().positions;
        let side = 50.0 * radius;
        for corner in [[0.7, 0.3], [0.123_456_789, 0.987_654_321], domain.min, domain.max.map(|x| x - side)] {
            let start = Instant::now();
            let rect = (corner, corner.map(|x| x + side));
            let samples = alone(&options, rect);
            assert!(start.elapsed() < Duration::from_secs(2));
            assert!((1500..2200).contains(&samples.len()), "{}", samples.len());

            // As the middle of a larger window: without conflict or gap, and the same samples in it.
            let min = [0, 1].map(|axis| (corner[axis] - 7.0 * radius).max(domain.min[axis]));
            let max = [0, 1].map(|axis| (corner[axis] + side + 5.5 * radius).min(domain.max[axis]));
            let larger = window((min, max));
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
                assert!(window(quarter) == part_of(&samples, quarter));
            }
        }
        // Many windows of one plane, each without conflict or gap.
        let mut random = Random::new(7);
        for _ in 0..60 {
            let rect = small_window(&mut random, &domain, 60.0 * radius);
            let min = [0, 1].map(|axis| (rect.0[axis] - 3.0 * radius).max(domain.min[axis]));
            let max = [0, 1].map(|axis| (rect.1[axis] + 5.0 * radius).min(domain.max[axis]));
            let larger = window((min, max));
            assert!(window(rect) == part_of(&larger, rect), "{rect:?}");
            let inner = Domain { min: rect.0, max: rect.1, boundary: Boundary::Bounded };
            assert_eq!(find_conflict(&inner, radius, &larger), None);
            assert_eq!(find_gap(&inner, radius + 3.0 * float_spacing(&domain), &larger), None);
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
        let plane = Plane::new(&context, &options, None).unwrap();
        for last in [1, 7] {
            let mut visits = 0;
            let visit = |_: &[[f32; 2]]| {
                visits += 1;
                if visits == last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            assert!(matches!(plane.stream(&context, visit, None), Err(Error::Cancelled)));
            assert_eq!(visits, last);
        }
    }
}

#[test]
fn bad_planes_and_windows_are_refused_by_name() {
    let domain = domain([-1.0, 2.0], [1.0, 5.0], Boundary::Periodic);
    let good = Options::new(0.01).domain(domain);
    let radius = |radius| good.kind(Kind::Plain(radius));
    let context = Context::new(1).unwrap();
    // What is wrong with the options is said as by the whole.
    for options in [
        radius(0.0),
        radius(f64::NAN),
        good.leaf_size(5.9),
        good.domain(Domain { min: [f64::NAN; 2], ..domain }),
        good.domain(Domain { max: [-2.0; 2], ..domain }),
        radius(3.1e-5).leaf_size(1e30),
    ] {
        let refusal = Plane::new(&context, &options, None).err().unwrap().to_string();
        let alone = sample_window(&context, &options, [-0.5, 2.5], [0.5, 3.5], None);
        assert_eq!(alone.unwrap_err().to_string(), refusal);
        assert_eq!(refusal, sample(&context, &options, None).unwrap_err().to_string());
    }
    let refusal = Plane::new(&context, &radius(1e-5), None).err().unwrap().to_string();
    assert!(refusal.starts_with("radius: 1e-5 is below 3.0517578125e-5, 64 times the float spacing"), "{refusal}");
    // Tiled, and as a whole.
    for options in [good, radius(0.1)] {
        let plane = kept(1, &options);
        let refuse = |min, max| {
            let error = plane.window(min, max).unwrap_err();
            let alone = sample_window(&context, &options, min, max, None).unwrap_err();
            assert_eq!(alone.to_string(), error.to_string());
            error
        };
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
    let context = Context::new(1).unwrap();
    for error in [
        sample_window(&context, &options, [0.0; 2], [1.0, 0.5], None).unwrap_err(),
        kept(1, &options).window([0.0; 2], [1.0, 0.5]).unwrap_err(),
    ] {
        assert!(matches!(error, Error::TooLarge { argument: "radius", .. }));
        assert!(error.to_string().contains("about 5.18e9 samples"), "{error}");
    }
    let error = kept(1, &options).whole(&context, None).unwrap_err();
    assert!(matches!(error, Error::TooLarge { argument: "radius", .. }), "{error}");
    // The whole would be made.
    let untiled = options.leaf_size(1e30);
    let error = sample_window(&context, &untiled, [0.0; 2], [1e-3; 2], None).unwrap_err();
    assert!(matches!(error, Error::TooLarge { argument: "radius", .. }), "{error}");
    let error = Plane::new(&context, &untiled, None).err().unwrap();
    assert!(matches!(error, Error::TooLarge { argument: "radius", .. }), "{error}");
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
        let radius = factor.exp() * domain.area().sqrt();
        let options = Options::new(radius).domain(domain).leaf_size(leaf_size).seed(seed);
        let (plane, whole, mut random) = (kept(1, &options), whole(&options), Random::new(seed));
        for _ in 0..12 {
            let rect = random_window(&mut random, &domain);
            prop_assert!(plane.window(rect.0, rect.1).unwrap().positions == part_of(&whole, rect), "{:?}, {:?}", options, rect);
            let rect = small_window(&mut random, &domain, 100.0 * radius);
            prop_assert!(plane.window(rect.0, rect.1).unwrap().positions == part_of(&whole, rect), "{:?}, {:?}", options, rect);
        }
    }
}
