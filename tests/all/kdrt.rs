//! `kdrt` against naive oracles.

use std::ops::ControlFlow;

use azulejo::kdrt::{DEFAULT_LEAF_SIZE, Kind, Options, sample};
use azulejo::{Boundary, Context, Domain, Error, maximal};
use proptest::prelude::*;

use crate::common::tiled::tiled_radius;
use crate::common::{BOUNDARIES, check, domain, float_spacing, hard_domains};

fn samples(domain: Domain, radius: f64, leaf_size: f64, seed: u64) -> Vec<[f32; 2]> {
    sample(&Context::new(2).unwrap(), &Options::new(radius).domain(domain).leaf_size(leaf_size).seed(seed), None)
        .unwrap()
        .positions
}

#[test]
fn hard_domains_are_sampled_without_conflict_or_gap() {
    for boundary in BOUNDARIES {
        let mut tiled = 0;
        for domain in hard_domains(boundary) {
            for (seed, leaf_size) in [(0, 6.0), (1, 9.5), (2, DEFAULT_LEAF_SIZE)] {
                let radius = tiled_radius(&domain, leaf_size);
                if radius < 64.0 * float_spacing(&domain) {
                    continue; // So few floats lie in this one that only small leaves tile it.
                }
                tiled += 1;
                let samples = samples(domain, radius, leaf_size, seed);
                assert_ne!(samples.len(), maximal_count(domain, radius, seed), "not tiled: {domain:?}");
                check(&domain, radius, &samples);
            }
        }
        assert!(tiled >= 3 * hard_domains(boundary).len() - 1);
    }
}

fn maximal_count(domain: Domain, radius: f64, seed: u64) -> usize {
    maximal::sample(&Context::new(1).unwrap(), &maximal::Options::new(radius).domain(domain).seed(seed), None)
        .unwrap()
        .len()
}

#[test]
fn large_leaves_are_sampled_without_conflict_or_gap() {
    for boundary in BOUNDARIES {
        for (leaf_size, side) in [(40.0, 210.0), (80.0, 330.0)] {
            let domain = domain([-0.2, 0.0], [1.1, 0.9], boundary);
            let radius = domain.area().sqrt() / side;
            check(&domain, radius, &samples(domain, radius, leaf_size, 7));
        }
    }
}

#[test]
fn small_leaves_keep_the_promise_on_many_seeds() {
    for boundary in BOUNDARIES {
        let domain = domain([0.0; 2], [1.0, 1.3], boundary);
        for seed in 0..20 {
            check(&domain, 0.0093, &samples(domain, 0.0093, 6.0, seed));
        }
    }
}

#[test]
fn domains_that_are_too_small_to_tile_are_sampled_like_maximal() {
    for boundary in BOUNDARIES {
        for (extent, radius) in [([1.0, 1.0], 0.3), ([1.0, 1.0], 5.0), ([1.0, 0.01], 0.02), ([1.0, 1.0], 0.01)] {
            let domain = domain([0.0; 2], extent, boundary);
            let context = Context::new(1).unwrap();
            let expected = maximal::sample(&context, &maximal::Options::new(radius).domain(domain).seed(3), None)
                .unwrap()
                .positions;
            assert_eq!(samples(domain, radius, DEFAULT_LEAF_SIZE, 3), expected);
        }
        let domain = domain([0.0; 2], [1.0; 2], boundary);
        check(&domain, 0.008, &samples(domain, 0.008, f64::MAX, 3));
    }
}

/// Elimination and filling add samples at the seams, a share that falls as 1 / leaf size. Counts of unbiased sets of this
/// size scatter by about 0.003: bounds are three standard errors of the mean, which at 40r excludes none and twice as many.
#[test]
fn the_density_is_near_that_of_an_unbiased_set() {
    let sets = 40;
    for (leaf_size, excess) in [(6.0, 0.0148), (20.0, 0.0048), (40.0, 0.0025)] {
        let radius = 1.0 / 250.0;
        let domain = Domain::unit(Boundary::Periodic);
        let counts = (0..sets).map(|seed| samples(domain, radius, leaf_size, seed).len()).sum::<usize>();
        let density = counts as f64 / sets as f64 * radius * radius;
        let relative = density / 0.69656 - 1.0;
        assert!((relative - excess).abs() < 0.0015, "{density} at {leaf_size}r");
    }
}

#[test]
fn seeds_and_not_threads_or_earlier_calls_decide() {
    for boundary in BOUNDARIES {
        let options = Options::new(0.0025).domain(Domain::unit(boundary)).seed(1);
        let [one, four] = [1, 4].map(|threads| sample(&Context::new(threads).unwrap(), &options, None).unwrap());
        assert!(one == four);
        let context = Context::new(3).unwrap();
        assert!(one != sample(&context, &options.seed(2), None).unwrap());
        assert!(one != sample(&context, &options.leaf_size(21.0), None).unwrap());
        assert!(one == sample(&context, &options, Some(&|_| ControlFlow::Continue(()))).unwrap());
    }
}

#[test]
fn bad_arguments_are_refused_by_name() {
    let good = Options::new(0.01);
    let refuse = |options: Options| sample(&Context::new(1).unwrap(), &options, None).unwrap_err();
    for leaf_size in [5.999, 0.0, -20.0, f64::NAN, f64::INFINITY] {
        let error = refuse(good.leaf_size(leaf_size));
        assert!(matches!(error, Error::InvalidArgument { argument: "leaf_size", .. }), "{error}");
    }
    for radius in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
        let error = refuse(good.kind(Kind::Plain(radius)));
        assert!(matches!(error, Error::InvalidArgument { argument: "radius", .. }), "{error}");
    }
    let swapped = domain([1.0; 2], [0.0; 2], Boundary::Periodic);
    let error = refuse(good.domain(swapped));
    assert!(matches!(error, Error::InvalidArgument { argument: "domain_max", .. }), "{error}");
    let error = refuse(good.kind(Kind::Plain(8.346e-7)));
    assert!(matches!(error, Error::TooLarge { argument: "radius", .. }));
    assert!(error.to_string().contains("about 1.00e12 samples"), "{error}");
    let coarse = domain([1e7; 2], [1e7 + 1e4; 2], Boundary::Periodic);
    let error = refuse(good.kind(Kind::Plain(10.0)).domain(coarse));
    assert!(matches!(error, Error::InvalidArgument { argument: "radius", .. }), "{error}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_rectangle_radius_and_leaf_size(
        corner in prop::array::uniform2(-10.0..10.0f64),
        height in -3.0..3.0f64,
        aspect in -3.0..3.0f64,
        factor in -5.6..-3.0f64,
        leaf_size in 6.0..30.0f64,
        periodic: bool,
        seed: u64,
    ) {
        let (height, aspect) = (height.exp(), aspect.exp());
        let boundary = BOUNDARIES[usize::from(!periodic)];
        let domain = domain(corner, [corner[0] + height * aspect, corner[1] + height], boundary);
        let radius = factor.exp() * domain.area().sqrt();
        check(&domain, radius, &samples(domain, radius, leaf_size, seed));
    }
}
