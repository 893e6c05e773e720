//! Sets of exactly N samples against naive oracles.

use std::ops::ControlFlow;

use azulejo::kdrt::{CountOptions, CountReport, sample_count};
use azulejo::{Boundary, Context, Domain, Points};
use proptest::prelude::*;

use crate::common::{BOUNDARIES, check, domain, find_conflict, find_gap, float_spacing, hard_domains};

fn options(domain: Domain, count: u64, seed: u64) -> CountOptions {
    CountOptions::new(count).domain(domain).seed(seed)
}

fn counted(domain: Domain, count: u64, seed: u64) -> (Points<2>, CountReport) {
    sample_count(&Context::new(2).unwrap(), &options(domain, count, seed), None).unwrap()
}

/// As many as asked for, conflict-free at the radius of the report, and maximal if and only if the report says so.
fn check_report(domain: &Domain, count: u64, (points, report): &(Points<2>, CountReport)) {
    let samples = &points.positions;
    assert_eq!(samples.len() as u64, count);
    if report.is_maximal {
        check(domain, report.radius, samples);
    } else {
        assert_eq!(find_conflict(domain, report.radius, samples), None);
        assert!(find_gap(domain, report.radius + 3.0 * float_spacing(domain), samples).is_some());
    }
}

#[test]
fn few_samples_are_exactly_as_many_as_asked_for() {
    for boundary in BOUNDARIES {
        for domain in [Domain::unit(boundary), domain([-3.0, 7.0], [27.0, 8.0], boundary)] {
            for count in (1..=30).chain([50, 77, 100]) {
                for seed in 0..8 {
                    let counted = counted(domain, count, seed);
                    check_report(&domain, count, &counted);
                    assert!(count < 50 || counted.1.is_maximal, "{count} samples, seed {seed}");
                }
            }
        }
    }
}

#[test]
fn hard_domains_get_exact_counts() {
    for boundary in BOUNDARIES {
        for domain in hard_domains(boundary) {
            for (seed, count) in [(0, 1), (1, 7), (2, 60), (3, 999), (4, 8_000)] {
                let counted = counted(domain, count, seed);
                assert!(counted.1.is_maximal);
                check_report(&domain, count, &counted);
            }
        }
    }
}

#[test]
fn tiled_domains_get_exact_counts_and_stay_maximal() {
    for boundary in BOUNDARIES {
        let small = domain([-0.7, 12.0], [0.4, 12.9], boundary);
        let thin = domain([2.0, -7.0], [2.5, 8.0], boundary);
        for (seed, count, domain) in [(0, 12_345, small), (1, 12_346, thin), (2, 40_001, small)] {
            let counted = counted(domain, count, seed);
            assert!(counted.1.is_maximal);
            check_report(&domain, count, &counted);
        }
    }
    let square = Domain::unit(Boundary::Periodic);
    let counted = counted(square, 200_000, 9);
    assert!(counted.1.is_maximal);
    check_report(&square, 200_000, &counted);
}

/// The radius is that of the density, within what chance does to so many samples.
#[test]
fn the_radius_is_that_of_the_density() {
    for (count, tolerance) in [(1_000, 0.02), (50_000, 0.006)] {
        for seed in 0..5 {
            let radius = counted(Domain::unit(Boundary::Periodic), count, seed).1.radius;
            let density = count as f64 * radius * radius;
            assert!((density / 0.69656 - 1.004).abs() < tolerance, "{density}");
        }
    }
}

#[test]
fn seeds_and_not_threads_or_earlier_calls_decide() {
    for boundary in BOUNDARIES {
        for count in [3, 700, 60_000] {
            let options = options(Domain::unit(boundary), count, 1);
            let [one, four] =
                [1, 4].map(|threads| sample_count(&Context::new(threads).unwrap(), &options, None).unwrap());
            assert!(one == four);
            let context = Context::new(3).unwrap();
            let other = sample_count(&context, &options.seed(2), None).unwrap();
            assert!(one.0 != other.0);
            assert!(one == sample_count(&context, &options, Some(&|_| ControlFlow::Continue(()))).unwrap());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_rectangle_and_count(
        corner in prop::array::uniform2(-10.0..10.0f64),
        height in -3.0..3.0f64,
        aspect in -3.0..3.0f64,
        count in 0.0..9.5f64,
        leaf_size in 6.0..30.0f64,
        periodic: bool,
        seed: u64,
    ) {
        let (height, aspect, count) = (height.exp(), aspect.exp(), count.exp() as u64);
        let boundary = BOUNDARIES[usize::from(!periodic)];
        let domain = domain(corner, [corner[0] + height * aspect, corner[1] + height], boundary);
        let options = options(domain, count, seed).leaf_size(leaf_size);
        let counted = sample_count(&Context::new(2).unwrap(), &options, None).unwrap();
        check_report(&domain, count, &counted);
        prop_assert!(count < 50 || counted.1.is_maximal);
    }
}
