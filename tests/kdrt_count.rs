//! Sets of exactly N samples against naive oracles.

mod common;

use std::ops::ControlFlow;

use azulejo::kdrt::{CountOptions, Counted, DEFAULT_LEAF_SIZE, sample_count};
use azulejo::{Boundary, Context, Domain, Error};
use common::{BOUNDARIES, check, domain, find_conflict, find_gap, float_spacing, hard_domains};
use proptest::prelude::*;

fn options(domain: Domain, count: u64, seed: u64) -> CountOptions {
    CountOptions { count, domain, leaf_size: DEFAULT_LEAF_SIZE, seed }
}

fn counted(domain: Domain, count: u64, seed: u64) -> Counted {
    sample_count(&Context::new(2).unwrap(), &options(domain, count, seed), None).unwrap()
}

/// As many as asked for, conflict-free at the radius of the report, and maximal if and only if the report says so.
fn check_report(domain: &Domain, count: u64, Counted { samples, report }: &Counted) {
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
        let square = Domain::unit(boundary);
        for domain in [square, domain([-3.0, 7.0], [27.0, 8.0], boundary)] {
            for count in (1..=30).chain([50, 77, 100]) {
                for seed in 0..8 {
                    let counted = counted(domain, count, seed);
                    check_report(&domain, count, &counted);
                    if !counted.report.is_maximal { println!("not maximal {count} {seed} {domain:?}"); }
                    assert!(count < 50 || counted.report.is_maximal, "{count} samples, seed {seed}");
                }
            }
        }
    }
}

#[test]
fn hard_domains_get_exact_counts() {
    for boundary in BOUNDARIES {
        for domain in hard_domains(boundary) {
            for (seed, count) in [(0, 1), (1, 7), (2, 60), (3, 999), (4, 9_000)] {
                let result = sample_count(&Context::new(2).unwrap(), &options(domain, count, seed), None);
                println!("{domain:?} {count}: {:?}", result.as_ref().map(|c| c.report));
                if let Ok(counted) = result {
                check_report(&domain, count, &counted);
                    }
            }
        }
    }
}

#[test]
fn tiled_domains_get_exact_counts_and_stay_maximal() {
    for boundary in BOUNDARIES {
        for (seed, count) in [(0, 12_345), (1, 12_346), (2, 40_001)] {
            let domain = domain([-0.7, 12.0], [0.4, 12.9], boundary);
            let counted = counted(domain, count, seed);
            assert!(counted.report.is_maximal);
            check_report(&domain, count, &counted);
        }
    }
    let counted = counted(Domain::unit(Boundary::Periodic), 200_000, 9);
    check_report(&Domain::unit(Boundary::Periodic), 200_000, &counted);
}
