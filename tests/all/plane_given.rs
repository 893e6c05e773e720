//! Sets of the plane around given samples, from the definitions: no conflict, no gap, and the same in every part.

use std::ops::ControlFlow;

use azulejo::kdrt::{Kind, Options, Plane, Progressive, sample, sample_window};
use azulejo::{Boundary, Context, Domain, Error, Given, Order};

use crate::common;
use crate::common::disks::{distance, find_gap};
use crate::common::sets::{self, Random};
use crate::common::tiled::tiled_radius;
use crate::common::windows::{part_of, random_window};
use crate::common::{BOUNDARIES, domain, find_conflict, float_spacing, hard_domains};

/// Positions with their clearances.
pub type Set = (Vec<[f32; 2]>, Vec<f64>);

/// The fault in a set around given samples, if there is one.
pub fn fault(domain: &Domain, radius: f64, given: &Set, samples: &[[f32; 2]]) -> Option<String> {
    if let Some(pair) = find_conflict(domain, radius, samples) {
        return Some(format!("{pair:?} are closer than the radius {radius}"));
    }
    // A distance is computed with an error of its own where the period is rounded.
    for &sample in samples {
        let near = std::iter::zip(&given.0, &given.1).find(|&(&g, &c)| distance(domain, sample, g) < c * (1.0 - 1e-15));
        if let Some((g, c)) = near {
            return Some(format!("{sample:?} is {} from {g:?}, closer than {c}", distance(domain, sample, *g)));
        }
    }
    let tolerance = 6.0 * float_spacing(domain);
    let all =
        samples.iter().map(|&sample| (sample, radius)).chain(std::iter::zip(&given.0, &given.1).map(|(&g, &c)| (g, c)));
    let gap = find_gap(domain, all, tolerance, float_spacing(domain) / 16.0);
    gap.map(|gap| format!("{gap:?} is covered by nothing"))
}

/// Samples in and around a domain, some in one place, with clearances over five orders of magnitude and some of 0.
fn random_given(random: &mut Random, domain: &Domain, radius: f64, count: usize) -> Set {
    let mut given = Set::default();
    for i in 0..count {
        let place = [0, 1].map(|axis| {
            let (min, extent) = (domain.min[axis], domain.extent()[axis]);
            let wide = if i % 7 == 0 { 2.0 } else { 1.0 };
            let x = min + extent * (0.5 + wide * (f64::from(random.unit()) - 0.5));
            x.clamp(-3e38, 3e38) as f32
        });
        let place = if i % 5 == 4 { given.0[i - 1] } else { place };
        let clearance = match i % 11 {
            0 => 0.0,
            _ => radius * 10f64.powf(f64::from(random.unit()) * 4.5 - 3.0) * if i % 3 == 0 { 1.0 } else { 0.1 },
        };
        given.0.push(place);
        given.1.push(clearance);
    }
    given
}

fn around<'a>(options: Options<'_>, given: &'a Set) -> Options<'a> {
    let Kind::Plain(radius) = options.kind else { panic!("{options:?}") };
    Options::new(radius)
        .domain(options.domain)
        .leaf_size(options.leaf_size)
        .seed(options.seed)
        .given(Given::with_clearances(&given.0, &given.1))
}

fn whole(options: &Options) -> Vec<[f32; 2]> {
    sample(&Context::new(1).unwrap(), options, None).unwrap().positions
}

#[test]
fn sets_of_hard_domains_keep_clear_and_leave_no_gap() {
    let mut random = Random::new(1);
    for boundary in BOUNDARIES {
        for domain in hard_domains(boundary) {
            // Tiled, and made as a whole.
            let tiled = tiled_radius(&domain, 6.0).max(64.0 * float_spacing(&domain));
            for (radius, count) in [(tiled, 300), (3.0 * tiled, 40), (20.0 * tiled, 3)] {
                let given = random_given(&mut random, &domain, radius, count);
                let options = around(Options::new(radius).domain(domain).leaf_size(6.0).seed(count as u64), &given);
                let samples = whole(&options);
                assert_eq!(fault(&domain, radius, &given, &samples), None, "{options:?}");
            }
        }
    }
}

#[test]
fn clearances_of_all_kinds() {
    for boundary in BOUNDARIES {
        let domain = domain([0.0; 2], [1.0, 0.9], boundary);
        let context = Context::new(1).unwrap();
        let radius = 0.008;
        let options = Options::new(radius).domain(domain).leaf_size(6.0);
        let free = whole(&options);
        // Without effect.
        let nothing = (vec![[0.5; 2], [0.3, 0.4]], vec![0.0, 0.0]);
        assert!(whole(&around(options, &nothing)) == free);
        let far = (vec![[50.0; 2]], vec![1.0]);
        assert!(boundary == Boundary::Periodic || whole(&around(options, &far)) == free);
        // Over everything.
        for clearance in [2.0, 1e30, 1e300, f64::MAX] {
            let all = (vec![[0.1; 2], [0.2; 2]], vec![clearance, 1e-3]);
            assert!(whole(&around(options, &all)).is_empty());
        }
        // The radius of the set, of one that is maximal: there is no place left.
        assert!(sample(&context, &options.given(Given::at(&free)), None).unwrap().is_empty());
        // A part of it: what is missing is filled.
        let half: Vec<_> = free.iter().copied().filter(|sample| sample[0] < 0.5).collect();
        let new = sample(&context, &options.given(Given::at(&half)), None).unwrap().positions;
        let clearances = vec![radius; half.len()];
        assert_eq!(fault(&domain, radius, &(half, clearances), &new), None);
        assert!(new.len() > free.len() / 3);
        // Many in one place, and many tiny ones.
        let mut random = Random::new(2);
        let heap: Set = ((0..3000).map(|_| [0.25; 2]).collect(), (0..3000).map(|i| f64::from(i) * 1e-5).collect());
        assert_eq!(fault(&domain, radius, &heap, &whole(&around(options, &heap))), None);
        let dust: Set = ((0..4000).map(|_| [random.unit(), random.unit()]).collect(), vec![1e-3 * radius; 4000]);
        let samples = whole(&around(options, &dust));
        assert_eq!(fault(&domain, radius, &dust, &samples), None);
    }
}

/// Floats below 1 are finer than the lattice, and the period is no multiple of its unit.
#[test]
fn given_floats_off_the_lattice_keep_their_clearance() {
    let mut random = Random::new(3);
    for boundary in BOUNDARIES {
        for round in 0..12 {
            // About 12,000 floats wide.
            let domain = domain([0.999_3, 0.999_201], [1.000_700_03, 1.000_703_3], boundary);
            let times = if round % 4 == 0 { 1.0 } else { 5.0 };
            let radius = times * 65.0 * float_spacing(&domain) * (1.0 + f64::from(random.unit()));
            let mut given = Set::default();
            for _ in 0..60 {
                given.0.push([0, 1].map(|axis| {
                    let side = 1e-6 + domain.extent()[axis] * f64::from(random.unit());
                    (domain.min[axis] + side - if random.unit() < 0.1 { 0.001 } else { 0.0 }) as f32
                }));
                given.1.push(radius * 2.0 * f64::from(random.unit()));
            }
            let options = around(Options::new(radius).domain(domain).leaf_size(6.0).seed(round), &given);
            let samples = whole(&options);
            assert_eq!(fault(&domain, radius, &given, &samples), None, "{round}");
        }
    }
}

#[test]
fn windows_planes_and_streams_are_parts_of_the_whole() {
    let mut random = Random::new(4);
    let context = Context::new(1).unwrap();
    for boundary in BOUNDARIES {
        for domain in hard_domains(boundary) {
            for times in [1.0, 4.0] {
                let radius = times * tiled_radius(&domain, 6.0).max(64.0 * float_spacing(&domain));
                let given = random_given(&mut random, &domain, radius, 100);
                let options = around(Options::new(radius).domain(domain).leaf_size(6.0).seed(5), &given);
                let whole = whole(&options);
                let plane = Plane::new(&context, &options, None).unwrap();
                for _ in 0..5 {
                    let rect = random_window(&mut random, &domain);
                    let expected = part_of(&whole, rect);
                    assert!(
                        sample_window(&context, &options, rect.0, rect.1, None).unwrap().positions == expected,
                        "{options:?}"
                    );
                    assert!(plane.window(rect.0, rect.1).unwrap().positions == expected);
                }
                let mut streamed = Vec::new();
                let visit = |part: &[[f32; 2]]| {
                    streamed.extend_from_slice(part);
                    ControlFlow::Continue(())
                };
                plane.stream(&context, visit, None).unwrap();
                assert!(streamed == whole);
                assert!(sample(&Context::new(3).unwrap(), &options, None).unwrap().positions == whole);
            }
        }
    }
}

#[test]
fn the_order_of_given_samples_does_not_matter() {
    let mut random = Random::new(5);
    for boundary in BOUNDARIES {
        let options = Options::new(0.01).domain(Domain::unit(boundary)).leaf_size(6.0);
        let mut given = random_given(&mut random, &options.domain, 0.01, 500);
        let first = whole(&around(options, &given));
        given.0.reverse();
        given.1.reverse();
        assert!(whole(&around(options, &given)) == first);
    }
}

/// A hole in a set is filled, and all samples outside stay.
#[test]
fn a_hole_is_filled_around_what_is_left() {
    for boundary in BOUNDARIES {
        let options = Options::new(0.01).domain(Domain::unit(boundary)).seed(6);
        let all = whole(&options);
        let left: Vec<_> = all.iter().copied().filter(|[x, y]| (x - 0.4).hypot(y - 0.6) > 0.1).collect();
        let new = sample(&Context::new(1).unwrap(), &options.given(Given::at(&left)), None).unwrap().positions;
        // A place that only a missing sample covered is within the radius of it.
        assert!(new.len() > 100 && new.iter().all(|[x, y]| (x - 0.4).hypot(y - 0.6) < 0.1101));
        common::check(&options.domain, 0.01, &[left, new].concat());
    }
}

/// Every prefix covers, with the given samples, and keeps clear of them.
#[test]
fn progressive_order_around_given_samples() {
    let mut random = Random::new(7);
    let context = Context::new(1).unwrap();
    for boundary in BOUNDARIES {
        for coarsest in [f64::INFINITY, 0.012] {
            let given = random_given(&mut random, &Domain::unit(boundary), 0.008, 150);
            let options = around(Options::new(0.008).domain(Domain::unit(boundary)).leaf_size(6.0).seed(8), &given);
            let levels = Progressive::new().coarsest(coarsest).quotient(1.2);
            let options = options.kind(Kind::Progressive(0.008, levels));
            let set = sample(&context, &options, None).unwrap();
            assert!(set.ranks.is_sorted_by(|a, b| a >= b));
            let first = set.ranks.partition_point(|&rank| rank == set.ranks[0]);
            let all = set.positions.len();
            for count in [first, (first + 20).min(all), all / 2, all] {
                let samples = &set.positions[..count];
                let rank = f64::from(set.ranks[count - 1]);
                assert_eq!(find_conflict(&options.domain, rank, samples), None);
                // Covered within the quotient times the rank, so conflicts are those of the whole.
                let ratio = if count < Order::FIRST_COUNT { 2.0 } else { 1.2 };
                let gap = fault(&options.domain, ratio * rank * (1.0 + 1e-6), &given, samples);
                assert!(gap.is_none_or(|fault| fault.contains("closer than the radius")), "{count}");
            }
            assert_eq!(fault(&options.domain, 0.008, &given, &set.positions), None);
            let rect = random_window(&mut random, &options.domain);
            let window = sample_window(&context, &options, rect.0, rect.1, None).unwrap();
            assert!(window.positions == part_of(&set.positions, rect));
        }
    }
}

/// The oracle sees a missing sample, one that was moved, and a given one that is missing or has another clearance.
#[test]
fn the_oracle_notices_what_is_wrong() {
    let mut random = Random::new(9);
    let domain = Domain::unit(Boundary::Periodic);
    let given: Set = (sets::random_points(60, 3), (0..60).map(|i| 0.002 * f64::from(i)).collect());
    let options = around(Options::new(0.03).domain(domain).seed(1), &given);
    let samples = whole(&options);
    assert_eq!(fault(&domain, 0.03, &given, &samples), None);
    let mut seen = [0; 4];
    for _ in 0..25 {
        let at = (random.unit() * samples.len() as f32) as usize;
        let (mut missing, mut moved) = (samples.clone(), samples.clone());
        missing.remove(at);
        moved[at] = [random.unit(), random.unit()];
        let other = 35 + (random.unit() * 25.0) as usize;
        let (mut fewer, mut wider) = (given.clone(), given.clone());
        fewer.0.remove(other);
        fewer.1.remove(other);
        wider.1[other] += 0.03;
        for (i, (given, samples)) in
            [(&given, &missing), (&given, &moved), (&fewer, &samples), (&wider, &samples)].into_iter().enumerate()
        {
            seen[i] += u32::from(fault(&domain, 0.03, given, samples).is_some());
        }
    }
    assert!(seen[0] >= 23 && seen[1] >= 23 && seen[2] >= 10 && seen[3] >= 20, "{seen:?}");
}

#[test]
fn what_is_out_of_range_is_refused_by_its_index() {
    let context = Context::new(1).unwrap();
    let options = Options::new(0.1);
    let positions = [[0.5; 2], [f32::NAN, 0.0]];
    for (given, said) in [
        (Given::at(&positions), "given_positions: [1]"),
        (Given::with_clearances(&positions[..1], &[-1.0]), "given_clearances: [0]"),
        (Given::with_clearances(&positions[..1], &[]), "given_clearances: 0 for 1"),
    ] {
        let refused = |result: Result<(), Error>| assert!(result.unwrap_err().to_string().starts_with(said));
        let options = options.given(given);
        refused(sample(&context, &options, None).map(|_| ()));
        refused(Plane::new(&context, &options, None).map(|_| ()));
        refused(sample_window(&context, &options, [0.0; 2], [1.0; 2], None).map(|_| ()));
    }
}
