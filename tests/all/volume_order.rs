//! Sets of cuboids in progressive order and of an exact count: every prefix from the definitions, and sets of fewer samples as
//! prefixes.

use azulejo::volume::{Options, Report, sample};
use azulejo::{Boundary, Context, Domain, Error, Given, Order, Points};

use crate::common::random::Random;
use crate::common::volume_oracle::{conflict, distance, gap, gap_between, sample_in_ball};
use crate::common::{BOUNDARIES, float_spacing};

const QUOTIENT: f64 = 1.090_507_732_665_257_7;

fn cuboid(min: [f64; 3], max: [f64; 3], boundary: Boundary) -> Domain<3> {
    Domain { min, max, boundary }
}

fn made(threads: usize, options: Options) -> (Points<3>, Report) {
    sample(&Context::new(threads).unwrap(), &options, None).unwrap()
}

/// The first few counts, those where the levels begin to be close, and some more up to the last.
fn prefixes(count: usize, seed: u64) -> Vec<usize> {
    let mut random = Random::new(seed);
    let some = (0..6).map(|_| 1 + (f64::from(random.unit()) * count as f64) as usize);
    (1..8).chain([98, 100, 104, 120]).chain(some).chain([count]).filter(|&prefix| prefix <= count).collect()
}

/// The fault in the order of samples around given ones, if there is one: in the ranks, the distances of each sample
/// from those before it, or the covering radius of some prefixes.
fn disorder(
    domain: &Domain<3>,
    points: &Points<3>,
    quotient: f64,
    given: &[([f32; 3], f64)],
    seed: u64,
) -> Option<String> {
    let Points { positions, ranks, .. } = points;
    if ranks.len() != positions.len() {
        return Some(format!("{} ranks for {} samples", ranks.len(), positions.len()));
    }
    let (places, tolerance) = (positions.iter().map(|p| p.map(f64::from)).collect::<Vec<_>>(), float_spacing(domain));
    for i in 1..ranks.len() {
        let nearest = places[..i].iter().map(|&p| distance(domain, p, places[i])).fold(f64::INFINITY, f64::min);
        if ranks[i] > ranks[i - 1] || f64::from(ranks[i]) > nearest {
            return Some(format!("{i}: rank {} after {}, {nearest} from the nearest", ranks[i], ranks[i - 1]));
        }
    }
    prefixes(ranks.len(), seed).into_iter().find_map(|prefix| {
        let ratio = if prefix < Order::FIRST_COUNT { quotient.powi(2).max(2.0) } else { quotient };
        let within = (ratio * f64::from(ranks[prefix - 1])).min(1e300) + 9.0 * tolerance;
        let samples = places[..prefix].iter().map(|&place| (place, within));
        let around = given.iter().map(|&(place, clearance)| (place.map(f64::from), clearance + 9.0 * tolerance));
        let gap = gap_between(domain, &samples.chain(around).collect::<Vec<_>>());
        gap.map(|gap| format!("the first {prefix} do not cover {gap:?} within {within}"))
    })
}

#[test]
fn every_prefix_of_any_cuboid_is_well_spread() {
    let cases = [
        ([0.0; 3], [1.0; 3], 0.1),
        ([-0.37, 0.11, -2.0], [1.91, 1.0 / 3.0, -1.1], 0.12),
        ([1e5, -3e4, 0.3], [1e5 + 12.5, -3e4 + 9.9, 5.0], 1.0),
        ([1.0; 3], [1.0000107; 3], 89.0 / f64::from(1 << 23)),
        ([-1e37, 1e36, 0.0], [1e38, 2e38, 1.5e38], 2e37),
        ([0.0; 3], [10.0, 0.1, 0.3], 0.25),
        ([0.0; 3], [2.5, 2.5, 0.1], 0.1),
    ];
    for boundary in BOUNDARIES {
        for (seed, (min, max, radius)) in (0..).zip(cases) {
            let domain = cuboid(min, max, boundary);
            let options = Options::new(radius).domain(domain).order(Order::Progressive).seed(seed);
            for quotient in [QUOTIENT, 1.5] {
                let (points, report) = made(1, options.quotient(quotient));
                assert_eq!(disorder(&domain, &points, quotient, &[], seed), None, "{domain:?} {quotient}");
                assert_eq!(points.ranks[0], f32::INFINITY);
                assert_eq!(conflict(&domain, radius, &points.positions), None);
                assert_eq!(gap(&domain, radius + 3.5 * float_spacing(&domain), &points.positions), None);
                assert_eq!((report.radius, report.covering_radius), (radius, radius));
            }
        }
    }
}

#[test]
fn an_order_around_given_samples_keeps_their_clearances() {
    let mut random = Random::new(5);
    for boundary in BOUNDARIES {
        let domain = cuboid([0.0, -1.0, 2.0], [1.0, 0.2, 3.0], boundary);
        for seed in 0..3 {
            let given: Vec<_> = (0..20)
                .map(|_| {
                    let place =
                        [0, 1, 2].map(|axis: usize| (domain.min[axis] - 0.1 + 1.4 * f64::from(random.unit())) as f32);
                    (place, 0.3 * f64::from(random.unit()))
                })
                .collect();
            let (positions, clearances): (Vec<_>, Vec<_>) = given.iter().copied().unzip();
            let around = Given::with_clearances(&positions, &clearances);
            let balls: Vec<_> = given.iter().map(|&(place, clearance)| (place.map(f64::from), clearance)).collect();
            let options = Options::new(0.1).domain(domain).given(around).seed(seed).order(Order::Progressive);
            let (points, _) = made(1, options);
            assert!(points.len() > 300, "{}", points.len());
            assert_eq!(disorder(&domain, &points, QUOTIENT, &given, seed), None);
            assert_eq!(sample_in_ball(&domain, &points.positions, &balls), None);
            assert_eq!(points, made(3, options).0);
            // A count beside them.
            let (points, report) = made(1, Options::by_count(400).domain(domain).given(around).seed(seed));
            assert_eq!(points.len(), 400);
            check_count(&domain, &points.positions, &report, &given);
        }
    }
}

/// All promises of a report: no two samples nearer than the radius, nothing open beyond the covering radius.
fn check_count(domain: &Domain<3>, samples: &[[f32; 3]], report: &Report, given: &[([f32; 3], f64)]) {
    assert_eq!(conflict(domain, report.radius, samples), None, "{report:?}");
    let balls: Vec<_> = given.iter().map(|&(place, clearance)| (place.map(f64::from), clearance)).collect();
    assert_eq!(sample_in_ball(domain, samples, &balls), None);
    let (within, tolerance) = (report.covering_radius, 9.0 * float_spacing(domain));
    let all = samples.iter().map(|sample| (sample.map(f64::from), within + tolerance));
    let balls = balls.iter().map(|&(place, clearance)| (place, clearance + tolerance));
    assert_eq!(gap_between(domain, &all.chain(balls).collect::<Vec<_>>()), None, "{report:?}");
}

#[test]
fn counts_are_exact_and_close_to_maximal() {
    for boundary in BOUNDARIES {
        for (min, max) in [
            ([0.0; 3], [1.0; 3]),
            ([-3.0, 0.5, 1e3], [-2.0, 0.9, 1e3 + 2.0]),
            ([0.0; 3], [5.0, 5.0, 0.01]),
            ([0.0; 3], [0.01, 0.02, 3.0]),
        ] {
            let domain = cuboid(min, max, boundary);
            for count in [1, 2, 3, 7, 20, 99, 600] {
                for seed in 0..2 {
                    let options = Options::by_count(count).domain(domain).seed(seed);
                    let (points, report) = made(1, options);
                    assert!(points.len() == count && points.ranks.is_empty());
                    check_count(&domain, &points.positions, &report, &[]);
                    assert!(count < 90 || report.covering_radius <= 1.1 * report.radius, "{report:?}");
                }
            }
        }
    }
    // A large set, whose radius the density of maximal sets gives.
    let (points, report) = made(2, Options::by_count(20_000));
    let density = points.len() as f64 * report.radius.powi(3);
    assert!(points.len() == 20_000 && (0.62..0.75).contains(&density), "{density}");
    assert!(report.covering_radius <= 1.1 * report.radius);
}

#[test]
fn sets_of_fewer_samples_are_prefixes() {
    for boundary in BOUNDARIES {
        let domain = cuboid([0.0, 0.0, -1.0], [1.0, 0.7, 0.3], boundary);
        let ordered = |options: Options<'static>| options.domain(domain).seed(3).order(Order::Progressive);
        let (most, _) = made(1, ordered(Options::by_count(1500)));
        assert_eq!(disorder(&domain, &most, QUOTIENT, &[], 3), None);
        for count in [1, 2, 50, 100, 101, 700, 1499] {
            let (fewer, report) = made(2, ordered(Options::by_count(count)));
            assert_eq!((fewer.positions.len(), &fewer.positions[..]), (count, &most.positions[..count]));
            assert_eq!(fewer.ranks, most.ranks[..count]);
            check_count(&domain, &fewer.positions, &report, &[]);
        }
        // Sets of two radii share the levels above both.
        let [(coarse, _), (fine, _)] = [0.13, 0.08].map(|radius| made(1, ordered(Options::new(radius))));
        let shared = coarse.ranks.iter().filter(|&&rank| f64::from(rank) >= 0.13 * QUOTIENT).count();
        assert!(shared > 100, "{shared}");
        assert_eq!(coarse.positions[..shared], fine.positions[..shared]);
        assert_eq!(coarse.ranks[..shared], fine.ranks[..shared]);
    }
}

#[test]
fn bad_requests_are_refused_by_name() {
    let refuse = |options: Options, said: &str| {
        let error = sample(&Context::new(1).unwrap(), &options, None).unwrap_err();
        assert!(error.to_string().starts_with(said), "{error}");
        error
    };
    let ordered = Options::new(0.2).order(Order::Progressive);
    for quotient in [f64::NAN, 1.0, 1.6] {
        refuse(ordered.quotient(quotient), "quotient: ");
    }
    refuse(Options::by_count(0), "count: 0 is not at least 1");
    let few = cuboid([1.0; 3], [1.00001; 3], Boundary::Periodic);
    let error =
        refuse(Options::by_count(10_000).domain(few), "count: 10000 samples are more than the domain can carry");
    assert!(matches!(error, Error::InvalidArgument { .. }));
    refuse(Options::by_count(10_000).domain(few).order(Order::Progressive), "count: 10000 samples are more than");
    let positions = [[0.5; 3]];
    refuse(Options::by_count(5).given(Given::at(&positions)), "given_clearances: are required with a count");
    let all = Given::with_clearances(&positions, &[2.0]);
    refuse(Options::by_count(5).given(all), "count: 5, but given samples cover all of the domain");
    refuse(Options::by_count(5).given(all).order(Order::Progressive), "count: 5, but given samples cover");
    if usize::BITS == 64 {
        let error = refuse(Options::by_count(1 << 33), "count: 8589934592; the limit is");
        assert!(matches!(error, Error::TooLarge { .. }));
    }
}

/// The oracle finds ranks that are too long, samples out of order and prefixes that leave gaps.
#[test]
fn the_oracle_can_fail() {
    let domain = cuboid([0.0; 3], [1.0; 3], Boundary::Periodic);
    let (good, _) = made(1, Options::new(0.15).order(Order::Progressive));
    let disorder = |points: &Points<3>| disorder(&domain, points, QUOTIENT, &[], 0);
    assert_eq!(disorder(&good), None);
    let with = |change: &dyn Fn(&mut Points<3>)| {
        let mut points = good.clone();
        change(&mut points);
        disorder(&points)
    };
    assert!(with(&|points| points.ranks[40] = points.ranks[39]).is_some_and(|fault| fault.starts_with("40: rank")));
    assert!(with(&|points| points.positions.swap(5, 150)).is_some());
    assert!(with(&|points| points.ranks.truncate(20)).is_some());
    let late = with(&|points| points.ranks[100..].iter_mut().for_each(|rank| *rank *= 0.8));
    assert!(late.is_some_and(|fault| fault.contains("do not cover")));
}
