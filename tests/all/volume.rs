//! `volume` against naive oracles.

use std::f64::consts::TAU;

use azulejo::analysis::space::figures_3d;
use azulejo::volume::{Options, sample};
use azulejo::{Boundary, Context, Domain, Error, Given, MAXIMAL_DENSITY_IN_SPACE, Order};
use proptest::prelude::*;

use crate::common::random::Random;
use crate::common::volume_oracle::{HARD_CUBOIDS, check, conflict, gap};
use crate::common::{BOUNDARIES, float_spacing};

fn cuboid(min: [f64; 3], max: [f64; 3], boundary: Boundary) -> Domain<3> {
    Domain { min, max, boundary }
}

fn samples(domain: Domain<3>, radius: f64, seed: u64) -> Vec<[f32; 3]> {
    sample(&Context::new(1).unwrap(), &Options::new(radius).domain(domain).seed(seed), None).unwrap().0.positions
}

#[test]
fn hard_cuboids_are_sampled_without_conflict_or_gap() {
    for boundary in BOUNDARIES {
        for (min, max, radius) in HARD_CUBOIDS.into_iter().chain([([0.0; 3], [1.0; 3], 0.51)]) {
            for seed in 0..2 {
                let domain = cuboid(min, max, boundary);
                check(&domain, radius, &samples(domain, radius, seed));
            }
        }
    }
}

#[test]
fn a_radius_beyond_the_cuboid_gives_one_sample() {
    for boundary in BOUNDARIES {
        let domain = cuboid([-0.3, 4.0, 1e-9], [0.7, 4.1, 2e-9], boundary);
        for radius in [1.1, 1e3, 1e30] {
            let samples = samples(domain, radius, 4);
            assert_eq!(samples.len(), 1, "{boundary:?} {radius}");
            check(&domain, radius, &samples);
        }
    }
}

/// Thinner than the radius on one axis or two, each sample beside its own images on a torus: sets of a plane, with 68 samples
/// on a torus, and of a line, with 43.
#[test]
fn thin_cuboids_are_sampled() {
    for boundary in BOUNDARIES {
        for thickness in [2e-8, 1e-4, 0.01, 0.3] {
            let (slab, bar) = ([4.0, thickness, 3.0], [thickness, 0.5 * thickness, 20.0]);
            for (max, fewest, most) in [(slab, 60, 140), (bar, 35, 90)] {
                let domain = cuboid([0.0; 3], max, boundary);
                let samples = samples(domain, 0.35, 1);
                assert!((fewest..=most).contains(&samples.len()), "{} of thickness {thickness}", samples.len());
                check(&domain, 0.35, &samples);
            }
        }
    }
}

/// The mean power of a set at the frequencies between two bounds, in waves per radius, along the axes.
fn power_on_axes(positions: &[[f32; 3]], radius: f64, [from, to]: [f64; 2]) -> f64 {
    let waves: Vec<f64> = ((from / radius).ceil() as i32..(to / radius) as i32).map(f64::from).collect();
    let power = |axis: usize, wave: f64| {
        let sum = positions.iter().fold([0.0; 2], |[re, im], position| {
            let (sin, cos) = (TAU * wave * f64::from(position[axis])).sin_cos();
            [re + cos, im + sin]
        });
        (sum[0] * sum[0] + sum[1] * sum[1]) / positions.len() as f64
    };
    let total: f64 = (0..3).flat_map(|axis| waves.iter().map(move |&wave| power(axis, wave))).sum();
    total / (3 * waves.len()) as f64
}

/// The jamming limit in space, and the spectrum of darts that are thrown one after the other, 1.4 at its peak
/// (docs/design/volume.md). Columns of blocks would leave a power of 30.
#[test]
fn blocks_change_density_and_spectrum_little() {
    let radius = 0.025;
    let sets: Vec<_> = (0..2).map(|seed| samples(Domain::unit(Boundary::Periodic), radius, seed)).collect();
    for positions in &sets {
        let density = positions.len() as f64 * radius * radius * radius;
        assert!((density / MAXIMAL_DENSITY_IN_SPACE - 1.0).abs() < 0.005, "{density}");
    }
    let power = |band| sets.iter().map(|set| power_on_axes(set, radius, band)).sum::<f64>() / sets.len() as f64;
    let (low, peak) = (power([0.2, 0.5]), power([0.8, 1.2]));
    assert!(low < 0.4 && (0.7..2.6).contains(&peak), "{low} {peak}");
}

#[test]
fn seeds_and_not_threads_or_earlier_calls_decide() {
    for boundary in BOUNDARIES {
        let domain = cuboid([0.0; 3], [3.0, 1.1, 2.0], boundary);
        let first = samples(domain, 0.06, 1);
        assert_ne!(first, samples(domain, 0.06, 2));
        for threads in [2, 3] {
            let several = Context::new(threads).unwrap();
            let found = sample(&several, &Options::new(0.06).domain(domain).seed(1), None).unwrap();
            assert_eq!(first, found.0.positions);
        }
    }
}

/// Cubes that are just large enough to be tiled, alone and around samples, some of which lie deep inside leaves.
#[test]
fn tiled_cuboids_have_no_conflict_and_no_gap() {
    let (context, mut random, radius) = (Context::new(2).unwrap(), Random::new(5), 0.0288);
    for boundary in BOUNDARIES {
        let domain = Domain::unit(boundary);
        let options = Options::new(radius).domain(domain).seed(7).leaf_size(6.0);
        let made = |threads: usize, options: &Options| {
            sample(&Context::new(threads).unwrap(), options, None).unwrap().0.positions
        };
        let figures = |positions: &[[f32; 3]]| figures_3d(&context, &domain, positions, radius, None).unwrap();
        let farthest = |spacings: f64| radius + spacings * float_spacing(&domain);
        let positions = made(1, &options);
        let density = positions.len() as f64 / samples(domain, radius, 7).len() as f64;
        assert!((1.005..1.06).contains(&density), "{density}");
        let alone = figures(&positions);
        assert!(alone.conflicts == 0 && alone.covering_radius <= farthest(3.5), "{alone:?}");
        assert_eq!(made(3, &options), positions);
        assert_ne!(made(2, &options.seed(8)), positions);

        let given: Vec<[f32; 3]> = (0..60).map(|_| [0; 3].map(|_| random.unit())).collect();
        let around = made(2, &options.given(Given::at(&given)));
        let all = figures(&[&*around, &given].concat());
        // Given samples are not compared with each other.
        assert_eq!(all.conflicts, figures(&given).conflicts);
        assert!(all.covering_radius <= farthest(7.0), "{all:?}");
    }
}

#[test]
fn small_cuboids_are_not_tiled() {
    let domain = cuboid([0.0; 3], [1.0, 0.4, 2.0], Boundary::Periodic);
    let options = Options::new(0.05).domain(domain).leaf_size(6.0);
    assert_eq!(sample(&Context::new(1).unwrap(), &options, None).unwrap().0.positions, samples(domain, 0.05, 0));
}

#[test]
fn leaf_sizes_out_of_range_and_those_without_effect_are_refused() {
    let refused = |options: &Options| sample(&Context::new(1).unwrap(), options, None).unwrap_err().to_string();
    for leaf_size in [f64::NAN, f64::INFINITY, -20.0, 5.9, 1e-300] {
        let said = refused(&Options::new(0.1).leaf_size(leaf_size));
        assert_eq!(said, format!("leaf_size: {leaf_size:?} is neither 0 nor a finite number of at least 6 (radii)"));
    }
    let said = refused(&Options::by_count(10).leaf_size(20.0));
    assert_eq!(said, "leaf_size: 20.0 has no effect with a count");
    let said = refused(&Options::new(0.1).order(Order::Progressive).leaf_size(20.0));
    assert_eq!(said, "leaf_size: 20.0 has no effect in progressive order");
}

#[test]
fn bad_arguments_are_refused_by_name() {
    let refuse = |min: [f64; 3], max: [f64; 3], radius: f64| {
        let options = Options::new(radius).domain(cuboid(min, max, Boundary::Bounded));
        sample(&Context::new(1).unwrap(), &options, None).unwrap_err()
    };
    for radius in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
        let error = refuse([0.0; 3], [1.0; 3], radius);
        assert!(matches!(error, Error::InvalidArgument { argument: "radius", .. }), "{error}");
    }
    for (min, max, said) in [
        ([1.0, 0.0, 0.0], [0.0, 1.0, 1.0], "domain_max: [0] is 0, not above domain_min 1"),
        ([0.0; 3], [1.0, 1.0, 0.0], "domain_max: [2] is 0, not above domain_min 0"),
        ([0.0, 0.0, f64::NAN], [1.0; 3], "domain_min: [2] is NaN, not a finite float"),
        ([0.0; 3], [1.0, f64::INFINITY, 1.0], "domain_max: [1] is inf, not a finite float"),
        ([0.0, 0.0, -1e39], [1.0; 3], "domain_min: [2] is -1"),
        ([0.0; 3], [1.0, 1.0, 1e-120], "domain_max: the domain is 1e0 by 1e0 by 1e-120; all sides are at least"),
        ([0.0; 3], [1e20, 1.0, 1e-30], "domain_max: the domain is 1e20 by 1e0 by 1e-30; a side is at most 2^100"),
        ([1.0 + 1e-9, 1.0, 1.0], [1.0 + 2e-9, 2.0, 2.0], "domain_max: [0] is"),
    ] {
        let error = refuse(min, max, 0.1);
        assert!(matches!(error, Error::InvalidArgument { .. }) && error.to_string().starts_with(said), "{error}");
    }
    let error = refuse([0.0; 3], [1.0; 3], (0.73364f64 / 1e12).cbrt());
    assert!(matches!(error, Error::TooLarge { argument: "radius", .. }));
    assert!(error.to_string().contains("about 1.00e12 samples"), "{error}");
    // Floats too coarse: the spacing, and the radius that it allows.
    let error = refuse([1e7, 0.0, 0.0], [1e7 + 100.0, 100.0, 100.0], 10.0);
    assert!(error.to_string().contains("10.0 is below 64.0, 64 times the float spacing 1.0"), "{error}");
}

/// The oracles find one sample that is missing and one that is moved, wherever it is.
#[test]
fn the_oracles_can_fail() {
    for boundary in BOUNDARIES {
        let domain = cuboid([-0.3, 0.2, 5.0], [0.7, 1.3, 5.9], boundary);
        let radius = 0.3;
        let good = samples(domain, radius, 3);
        check(&domain, radius, &good);
        for i in 0..good.len() {
            let mut other = good.clone();
            other.remove(i);
            assert!(gap(&domain, radius, &other).is_some());
            // Beside the next one.
            other.push(good[(i + 1) % good.len()].map(|x| x + 1e-3));
            assert!(conflict(&domain, radius, &other).is_some());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_cuboid_and_radius(
        corner in prop::array::uniform3(-10.0..10.0f64),
        size in prop::array::uniform3(-3.0..3.0f64),
        factor in -2.1..1.0f64,
        periodic: bool,
        seed: u64,
    ) {
        let size = size.map(f64::exp);
        let radius = factor.exp() * (size[0] * size[1] * size[2]).cbrt();
        let max = std::array::from_fn(|axis| corner[axis] + size[axis]);
        let domain = cuboid(corner, max, BOUNDARIES[usize::from(!periodic)]);
        check(&domain, radius, &samples(domain, radius, seed));
    }
}
