//! `maximal` against naive oracles.

use azulejo::maximal::{Options, sample};
use azulejo::{Boundary, Context, Domain, Error};
use proptest::prelude::*;

use crate::common;
use crate::common::{BOUNDARIES, check, domain, find_conflict, find_gap, hard_domains};

fn samples(domain: Domain, radius: f64, seed: u64) -> Vec<[f32; 2]> {
    sample(&Context::new(1).unwrap(), &Options::new(radius).domain(domain).seed(seed), None).unwrap().positions
}

#[test]
fn hard_domains_are_sampled_without_conflict_or_gap() {
    for boundary in BOUNDARIES {
        for domain in hard_domains(boundary) {
            for factor in [0.04, 0.1, 0.3, 0.9] {
                let radius = factor * domain.area().sqrt();
                for seed in 0..3 {
                    check(&domain, radius, &samples(domain, radius, seed));
                }
            }
        }
    }
}

#[test]
fn a_radius_beyond_the_domain_gives_one_sample() {
    for boundary in BOUNDARIES {
        for domain in hard_domains(boundary) {
            for factor in [2.0, 1e3, 1e30] {
                let [width, height] = domain.extent();
                let radius = factor * (width + height);
                let samples = samples(domain, radius, 4);
                assert_eq!(samples.len(), 1, "{domain:?}");
                check(&domain, radius, &samples);
            }
        }
    }
}

/// Thinner than the radius: a row of samples, on a torus each beside its own images.
#[test]
fn domains_thinner_than_the_radius_are_sampled() {
    for boundary in BOUNDARIES {
        for thickness in [2e-8, 1e-4, 0.01, 0.3] {
            let domains = [([0.1, 0.0], [0.1 + thickness, 20.0]), ([0.0, 0.1], [20.0, 0.1 + thickness])];
            for (min, max) in domains {
                let domain = domain(min, max, boundary);
                for seed in 0..3 {
                    let samples = samples(domain, 0.35, seed);
                    assert!((25..=112).contains(&samples.len()), "{} of thickness {thickness}", samples.len());
                    check(&domain, 0.35, &samples);
                }
            }
        }
    }
}

/// The jamming limit of random sequential placement, 0.5470735 · 4/π (Zhang and Torquato 2013): a biased sampler does not
/// meet it. The variance of the number of samples is 0.06 of it, so that six million have a standard error of 0.00007.
#[test]
fn the_density_is_that_of_the_jamming_limit() {
    let (radius, seeds, context) = (0.0026, 60, Context::new(0).unwrap());
    let options = |seed| Options::new(radius).seed(seed);
    let count: usize = (0..seeds).map(|seed| sample(&context, &options(seed), None).unwrap().len()).sum();
    let density = count as f64 / seeds as f64 * radius * radius;
    assert!((density - 0.69656).abs() < 0.0002, "{density}");
}

/// The cells of the sampler (the smallest number of them across, with a diagonal below the radius) leave no trace.
#[test]
fn samples_are_uniform_across_the_cells_that_find_them() {
    let radius = 0.01;
    let cells = (2f64.sqrt() / radius * (1.0 + 1e-9)).ceil();
    let mut histogram = [[0u32; 16]; 2];
    for seed in 0..10 {
        for sample in samples(Domain::unit(Boundary::Periodic), radius, seed) {
            for axis in 0..2 {
                histogram[axis][((f64::from(sample[axis]) * cells).fract() * 16.0) as usize] += 1;
            }
        }
    }
    for counts in histogram {
        let expected = f64::from(counts.iter().sum::<u32>()) / 16.0;
        let chi2: f64 = counts.iter().map(|&count| (f64::from(count) - expected).powi(2) / expected).sum();
        assert!(chi2 < 45.0, "chi2 of 15 degrees of freedom: {chi2}");
    }
}

#[test]
fn seeds_and_not_threads_or_earlier_calls_decide() {
    let domain = domain([0.0; 2], [3.0, 1.1], Boundary::Bounded);
    let first = samples(domain, 0.05, 1);
    assert_ne!(first, samples(domain, 0.05, 2));
    let four = Context::new(4).unwrap();
    assert_eq!(first, sample(&four, &Options::new(0.05).domain(domain).seed(1), None).unwrap().positions);
}

#[test]
fn bad_arguments_are_refused_by_name() {
    let refuse = |min: [f64; 2], max: [f64; 2], radius: f64| {
        let options = Options::new(radius).domain(domain(min, max, Boundary::Bounded));
        sample(&Context::new(1).unwrap(), &options, None).unwrap_err()
    };
    for radius in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
        let error = refuse([0.0; 2], [1.0; 2], radius);
        assert!(matches!(error, Error::InvalidArgument { argument: "radius", .. }), "{error}");
    }
    for (min, max, name) in [
        ([1.0, 0.0], [0.0, 1.0], "domain_max"),
        ([0.0, 0.0], [1.0, 0.0], "domain_max"),
        ([f64::NAN, 0.0], [1.0, 1.0], "domain_min"),
        ([0.0, 0.0], [1.0, f64::INFINITY], "domain_max"),
        ([0.0, -1e39], [1.0, 1.0], "domain_min"),
    ] {
        let error = refuse(min, max, 0.1);
        assert!(matches!(error, Error::InvalidArgument { argument, .. } if argument == name), "{error}");
    }
    // 10^12 samples: the estimate, although floats would be too coarse as well.
    let error = refuse([0.0; 2], [1.0; 2], (0.69656f64 / 1e12).sqrt());
    assert!(matches!(error, Error::TooLarge { argument: "radius", .. }));
    assert!(error.to_string().contains("about 1.00e12 samples"), "{error}");
    // Floats too coarse: the spacing, and the radius that it allows.
    let error = refuse([1e7, 0.0], [1e7 + 100.0, 100.0], 10.0);
    assert!(matches!(error, Error::InvalidArgument { argument: "radius", .. }));
    assert!(error.to_string().contains("10.0 is below 64.0, 64 times the float spacing 1.0"), "{error}");
}

/// The oracles find one sample that is missing and one that is moved, wherever it is.
#[test]
fn the_oracles_can_fail() {
    for boundary in BOUNDARIES {
        let domain = domain([-0.3, 0.2], [0.7, 1.3], boundary);
        let radius = 0.09;
        let good = samples(domain, radius, 3);
        for i in 0..good.len() {
            let mut removed = good.clone();
            removed.remove(i);
            assert!(find_gap(&domain, radius, &removed).is_some());
            let mut moved = good.clone();
            let nearest = |a: &&[f32; 2], b: &&[f32; 2]| {
                common::distance(&domain, good[i], **a).total_cmp(&common::distance(&domain, good[i], **b))
            };
            let neighbour = good.iter().filter(|&&other| other != good[i]).min_by(nearest).unwrap();
            let inwards = common::distance(&domain, good[i], *neighbour) - radius + 1e-6;
            moved[i] = std::array::from_fn(|axis| {
                let along = domain.offset(good[i].map(f64::from), neighbour.map(f64::from))[axis];
                let length = common::distance(&domain, good[i], *neighbour);
                (f64::from(good[i][axis]) + along * inwards / length) as f32
            });
            assert!(find_conflict(&domain, radius, &moved).is_some());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_rectangle_and_radius(
        corner in prop::array::uniform2(-10.0..10.0f64),
        height in -3.0..3.0f64,
        aspect in -4.0..4.0f64,
        factor in -4.0..1.0f64,
        periodic: bool,
        seed: u64,
    ) {
        let (height, aspect) = (height.exp(), aspect.exp());
        let boundary = BOUNDARIES[usize::from(!periodic)];
        let domain = domain(corner, [corner[0] + height * aspect, corner[1] + height], boundary);
        let radius = factor.exp() * domain.area().sqrt();
        check(&domain, radius, &samples(domain, radius, seed));
    }
}
