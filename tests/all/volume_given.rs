//! Sets of cuboids around given samples, from the definitions: no conflict, all clearances kept, no gap.

use azulejo::volume::{Options, sample};
use azulejo::{Boundary, Context, Domain, Error, Given};

use crate::common::BOUNDARIES;
use crate::common::sets::Random;
use crate::common::volume_oracle::{HARD_CUBOIDS, check_around, gap_between, sample_in_ball};

/// Positions with their clearances.
type Set = (Vec<[f32; 3]>, Vec<f64>);

fn cuboid(min: [f64; 3], max: [f64; 3], boundary: Boundary) -> Domain<3> {
    Domain { min, max, boundary }
}

fn around(domain: Domain<3>, radius: f64, seed: u64, given: &Set) -> Vec<[f32; 3]> {
    let given = Given::with_clearances(&given.0, &given.1);
    let options = Options::new(radius).domain(domain).seed(seed).given(given);
    sample(&Context::new(1).unwrap(), &options, None).unwrap().0.positions
}

fn check(domain: &Domain<3>, radius: f64, given: &Set, samples: &[[f32; 3]]) {
    let given: Vec<_> = given.0.iter().copied().zip(given.1.iter().copied()).collect();
    check_around(domain, radius, &given, samples);
}

/// Samples in and around a cuboid, some in one place, with clearances over five orders of magnitude and some of 0.
fn random_given(random: &mut Random, domain: &Domain<3>, radius: f64, count: usize) -> Set {
    let mut given = Set::default();
    for i in 0..count {
        let place = [0, 1, 2].map(|axis: usize| {
            let wide = if i % 7 == 0 { 2.0 } else { 1.0 };
            let x = domain.min[axis] + domain.extent()[axis] * (0.5 + wide * (f64::from(random.unit()) - 0.5));
            x.clamp(-3e38, 3e38) as f32
        });
        let place = if i % 5 == 4 { given.0[i - 1] } else { place };
        let clearance = match i % 11 {
            0 => 0.0,
            _ => radius * 10f64.powf(f64::from(random.unit()) * 4.5 - 3.5) * if i % 3 == 0 { 1.0 } else { 0.3 },
        };
        given.0.push(place);
        given.1.push(clearance);
    }
    given
}

#[test]
fn hard_cuboids_around_samples_of_all_clearances() {
    let mut random = Random::new(1);
    for boundary in BOUNDARIES {
        for (min, max, radius) in HARD_CUBOIDS {
            for (seed, count) in [3, 40, 400].into_iter().enumerate() {
                let domain = cuboid(min, max, boundary);
                let given = random_given(&mut random, &domain, radius, count);
                check(&domain, radius, &given, &around(domain, radius, seed as u64, &given));
            }
        }
    }
}

#[test]
fn clearances_of_all_kinds() {
    for boundary in BOUNDARIES {
        let domain = cuboid([0.0; 3], [1.0, 0.9, 1.1], boundary);
        let (context, radius) = (Context::new(1).unwrap(), 0.07);
        let options = Options::new(radius).domain(domain);
        let free = sample(&context, &options, None).unwrap().0.positions;
        // Without effect.
        let nothing = (vec![[0.5; 3], [0.3, 0.4, 0.5]], vec![0.0, 0.0]);
        assert_eq!(around(domain, radius, 0, &nothing), free);
        let far = (vec![[50.0; 3]], vec![1.0]);
        assert!(boundary == Boundary::Periodic || around(domain, radius, 0, &far) == free);
        // Over everything.
        for clearance in [2.0, 1e30, 1e300, f64::MAX] {
            let all = (vec![[0.1; 3], [0.2; 3]], vec![clearance, 1e-3]);
            assert!(around(domain, radius, 0, &all).is_empty());
        }
        // The radius of the set, of one that is maximal: there is no place left.
        assert!(sample(&context, &options.given(Given::at(&free)), None).unwrap().0.is_empty());
        // A part of it: what is missing is filled.
        let half: Vec<_> = free.iter().copied().filter(|sample| sample[0] < 0.5).collect();
        let new = sample(&context, &options.given(Given::at(&half)), None).unwrap().0.positions;
        assert!(new.len() > free.len() / 3);
        let clearances = vec![radius; half.len()];
        check(&domain, radius, &(half, clearances), &new);
        // Large balls, whose surfaces are nearly flat, up to those that hold all but a corner.
        for clearance in [0.5, 3.0, 1e2, 1e4] {
            let centre = -clearance / 3f64.sqrt() + 0.8;
            let large = (vec![[centre as f32; 3]], vec![clearance]);
            let open = cuboid([0.0; 3], [1.0, 0.9, 1.1], Boundary::Bounded);
            let samples = around(open, radius, 3, &large);
            assert!(samples.len() > 100 && samples.len() < free.len(), "{} at {clearance}", samples.len());
            check(&open, radius, &large, &samples);
        }
        // Many in one place, and many tiny ones.
        let heap: Set = ((0..2000).map(|_| [0.25; 3]).collect(), (0..2000).map(|i| f64::from(i) * 1e-4).collect());
        check(&domain, radius, &heap, &around(domain, radius, 4, &heap));
        let mut random = Random::new(2);
        let place = |random: &mut Random| [random.unit(), random.unit(), random.unit()];
        let dust: Set = ((0..2000).map(|_| place(&mut random)).collect(), vec![1e-3 * radius; 2000]);
        check(&domain, radius, &dust, &around(domain, radius, 5, &dust));
    }
}

/// Floats below 1 are finer than the lattice, and periods are no multiples of its unit.
#[test]
fn given_floats_off_the_lattice_keep_their_clearance() {
    let mut random = Random::new(3);
    for boundary in BOUNDARIES {
        for round in 0..8 {
            let domain = cuboid([0.999_93, 0.999_920_1, 0.999_95], [1.000_070_03, 1.000_070_33, 1.000_05], boundary);
            let radius = 65.0 * f64::from(f32::EPSILON) * (1.0 + f64::from(random.unit()));
            let mut given = Set::default();
            for _ in 0..60 {
                let turn = if random.unit() < 0.1 { 0.0001 } else { 0.0 };
                given.0.push([0, 1, 2].map(|axis: usize| {
                    (domain.min[axis] + domain.extent()[axis] * f64::from(random.unit()) - turn) as f32
                }));
                given.1.push(radius * 2.0 * f64::from(random.unit()));
            }
            check(&domain, radius, &given, &around(domain, radius, round, &given));
        }
    }
}

#[test]
fn threads_do_not_matter() {
    let mut random = Random::new(4);
    for boundary in BOUNDARIES {
        let domain = cuboid([0.0; 3], [3.0, 1.1, 2.0], boundary);
        let given = random_given(&mut random, &domain, 0.06, 500);
        let first = around(domain, 0.06, 1, &given);
        let options = Options::new(0.06).domain(domain).seed(1).given(Given::with_clearances(&given.0, &given.1));
        for threads in [2, 3] {
            assert_eq!(first, sample(&Context::new(threads).unwrap(), &options, None).unwrap().0.positions);
        }
    }
}

#[test]
fn bad_samples_are_refused_by_their_index() {
    let positions = [[0.0; 3], [1.0, f32::INFINITY, 0.0]];
    let refuse = |given: Given<3>| {
        let error = sample(&Context::new(1).unwrap(), &Options::new(0.1).given(given), None).unwrap_err();
        assert!(matches!(error, Error::InvalidArgument { .. }), "{error}");
        error.to_string()
    };
    assert_eq!(refuse(Given::at(&positions)), "given_positions: [1] is [1.0, inf, 0.0], not finite");
    let with = |clearances| Given::with_clearances(&positions[..1], clearances);
    assert_eq!(refuse(with(&[])), "given_clearances: 0 for 1 positions");
    assert_eq!(refuse(with(&[-1.0])), "given_clearances: [0] is -1.0; it must be 0 or more and finite");
}

/// The oracle finds a clearance that is a little longer and one that is a little shorter than those of the set.
#[test]
fn the_oracles_can_fail() {
    let domain = cuboid([0.0; 3], [1.0; 3], Boundary::Periodic);
    let given: Set = (vec![[0.5; 3], [1.9, 0.1, -0.1]], vec![0.3, 0.2]);
    let samples = around(domain, 0.1, 2, &given);
    check(&domain, 0.1, &given, &samples);
    for i in 0..2 {
        let ball = |change: f64| (given.0[i].map(f64::from), given.1[i] + change);
        assert_eq!(sample_in_ball(&domain, &samples, &[ball(0.0)]), None);
        assert!(sample_in_ball(&domain, &samples, &[ball(0.02)]).is_some());
        let balls = |change| {
            let others = samples.iter().map(|sample| (sample.map(f64::from), 0.1 + 1e-6));
            others.chain([ball(change), (given.0[1 - i].map(f64::from), given.1[1 - i] + 1e-6)]).collect::<Vec<_>>()
        };
        assert!(gap_between(&domain, &balls(1e-6)).is_none() && gap_between(&domain, &balls(-0.1)).is_some());
    }
}
