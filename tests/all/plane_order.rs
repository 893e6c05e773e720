//! Progressive order in the plane: what holds for every prefix, from the definitions.

use std::ops::ControlFlow;

use azulejo::analysis::spectrum::{Periodogram, periodogram};
use azulejo::kdrt::{
    CountOptions, DEFAULT_QUOTIENT, Kind, Options, Plane, Progressive, sample, sample_count, sample_window,
};
use azulejo::{Boundary, Context, Domain, Error, Order, Points};

use crate::common::sets::Random;
use crate::common::windows::{Rect, between, random_window};
use crate::common::{BOUNDARIES, check, distance, domain, find_conflict, find_gap, float_spacing, hard_domains};

fn progressive(radius: f64, levels: Progressive, domain: Domain, seed: u64) -> Options<'static> {
    Options::progressive(radius, levels).domain(domain).seed(seed)
}

fn quotient(quotient: f64) -> Progressive {
    Progressive::new().quotient(quotient)
}

fn ranked(options: &Options) -> Points<2> {
    sample(&Context::new(1).unwrap(), options, None).unwrap()
}

/// The length below which nothing is promised of the covering of prefixes.
fn tolerance(domain: &Domain) -> f64 {
    6.0 * float_spacing(domain)
}

/// The fault in a prefix, if there is one.
fn fault(domain: &Domain, quotient: f64, set: &Points<2>, count: usize) -> Option<String> {
    fault_of(domain, quotient, &set.positions[..count], set.ranks[count - 1])
}

fn fault_of(domain: &Domain, quotient: f64, samples: &[[f32; 2]], rank: f32) -> Option<String> {
    let (count, rank) = (samples.len(), f64::from(rank));
    if let Some(pair) = find_conflict(domain, rank, samples) {
        return Some(format!("{pair:?} of the first {count} are closer than {rank:?}"));
    }
    let ratio = largest_ratio(quotient, count);
    let gap = find_gap(domain, ratio * rank + tolerance(domain), samples);
    gap.map(|gap| format!("{gap:?} is farther than {ratio} times {rank:?} from the first {count}"))
}

/// The largest ratio of the covering radius to the last rank that a prefix may have.
fn largest_ratio(quotient: f64, count: usize) -> f64 {
    if count < Order::FIRST_COUNT { quotient.powi(2).max(2.0) } else { quotient }
}

/// The number of samples of the coarsest level.
fn coarsest(set: &Points<2>) -> usize {
    set.ranks.partition_point(|&rank| rank == set.ranks[0])
}

/// Some prefixes from that of the coarsest level on, and the whole.
fn some_prefixes(random: &mut Random, set: &Points<2>, count: usize) -> Vec<usize> {
    let (first, last) = (coarsest(set) as f32, set.positions.len() as f32);
    let any = |random: &mut Random| (first * (last / first).powf(random.unit())) as usize;
    let mut prefixes: Vec<_> = (0..count).map(|_| any(random).clamp(first as usize, last as usize)).collect();
    prefixes.extend([first as usize, last as usize]);
    prefixes
}

/// A set of the radius, in order: ranks that never rise, and the faults of some prefixes.
fn check_set(random: &mut Random, options: &Options, prefixes: usize) -> Points<2> {
    let Kind::Progressive(radius, levels) = options.kind else { panic!("{options:?}") };
    let set = ranked(options);
    assert_eq!(set.positions.len(), set.ranks.len());
    assert!(set.ranks.is_sorted_by(|a, b| a >= b), "{options:?}");
    let diagonal = options.domain.extent()[0].hypot(options.domain.extent()[1]);
    assert!(set.ranks.iter().all(|&rank| f64::from(rank) >= radius.min(diagonal) * (1.0 - 1e-7)));
    check(&options.domain, radius, &set.positions);
    for count in some_prefixes(random, &set, prefixes) {
        assert_eq!(fault(&options.domain, levels.quotient, &set, count), None, "{options:?}");
    }
    set
}

#[test]
fn every_prefix_is_well_spread() {
    let mut random = Random::new(1);
    for boundary in BOUNDARIES {
        for (seed, quotient) in (0..).zip([DEFAULT_QUOTIENT, 1.02, 1.1, 2f64.powf(0.25), 1.5]) {
            let domain = domain([0.3, -0.4], [1.2, 0.5], boundary);
            let set = check_set(&mut random, &progressive(0.02, self::quotient(quotient), domain, seed), 12);
            assert_eq!(coarsest(&set), 1);
            // All of the first ones, and those where the levels begin to be close.
            for count in (1..30).chain(95..130) {
                assert_eq!(fault(&domain, quotient, &set, count), None);
            }
        }
    }
}

#[test]
fn every_prefix_of_hard_domains_is_well_spread() {
    let mut random = Random::new(2);
    for boundary in BOUNDARIES {
        for domain in hard_domains(boundary) {
            let radius = (domain.area() / 1500.0).sqrt().max(64.0 * float_spacing(&domain));
            check_set(&mut random, &progressive(radius, Progressive::new(), domain, 3), 4);
        }
        for (extent, radius) in [([1.0, 1.0], 5.0), ([1.0, 0.01], 0.02), ([1e-7, 40.0], 0.3), ([0.13, 4.0], 0.01)] {
            let domain = domain([0.5; 2], extent.map(|x| 0.5 + x), boundary);
            check_set(&mut random, &progressive(radius, quotient(1.3), domain, 4), 4);
        }
    }
}

/// The coarsest level is a set of KDRT, tiled or not.
#[test]
fn the_coarsest_radius_can_be_chosen() {
    let mut random = Random::new(3);
    for boundary in BOUNDARIES {
        for (radius, times) in [(0.015, 1.0), (0.0035, 2.0), (0.012, 7.3)] {
            let levels = quotient(2f64.powf(0.25)).coarsest(times * radius);
            let options = progressive(radius, levels, Domain::unit(boundary), 5);
            let set = check_set(&mut random, &options, 3);
            let first = coarsest(&set);
            assert!(f64::from(set.ranks[0]) <= times * radius && f64::from(set.ranks[0]) > times * radius * 0.9999999);
            check(&options.domain, times * radius, &set.positions[..first]);
            let any = options.kind(Kind::Plain(times * radius));
            let mut coarse = ranked(&any).positions;
            let mut prefix = set.positions[..first].to_vec();
            let by_place = |a: &[f32; 2], b: &[f32; 2]| a[1].total_cmp(&b[1]).then(a[0].total_cmp(&b[0]));
            coarse.sort_unstable_by(by_place);
            prefix.sort_unstable_by(by_place);
            assert!(coarse == prefix, "the coarsest level is the set of its radius");
        }
    }
}

/// An accepted sample has as its rank the distance to some sample, and of those that come earlier in the order none is
/// nearer.
#[test]
fn ranks_are_distances_to_other_samples() {
    for boundary in BOUNDARIES {
        let domain = domain([2.0, 3.0], [3.0, 4.5], boundary);
        let set = ranked(&progressive(0.04, Progressive::new(), domain, 6));
        for i in 1..set.positions.len() {
            let (sample, rank) = (set.positions[i], set.ranks[i]);
            let down = |distance: f64| {
                let near = distance as f32;
                if f64::from(near) > distance { near.next_down() } else { near }
            };
            let distances: Vec<_> = set.positions.iter().map(|&other| down(distance(&domain, sample, other))).collect();
            assert!(distances[..i].iter().all(|&distance| distance >= rank));
            assert!(distances.contains(&rank), "{i}: {rank:?}");
        }
    }
}

#[test]
fn a_set_is_a_prefix_of_those_with_half_the_radius() {
    for boundary in BOUNDARIES {
        for quotient in [DEFAULT_QUOTIENT, 2f64.powf(0.25), 2f64.sqrt()] {
            let domain = domain([-0.2, 0.1], [0.7, 1.4], boundary);
            let set = |radius| ranked(&progressive(radius, self::quotient(quotient), domain, 7));
            let sets = [1.0, 2.0, 8.0].map(|times| set(0.04 / times));
            for pair in sets.windows(2) {
                let count = pair[0].positions.len();
                assert!(pair[1].positions[..count] == pair[0].positions && pair[1].ranks[..count] == pair[0].ranks);
            }
        }
        // Sets of one coarsest radius share their levels.
        let levels = Progressive::new().coarsest(0.3);
        let sets = [0.013, 0.0077].map(|radius| ranked(&progressive(radius, levels, Domain::unit(boundary), 8)));
        let common = sets[0].ranks.partition_point(|&rank| f64::from(rank) >= 0.013 * DEFAULT_QUOTIENT);
        assert!(common > 2000 && sets[1].positions[..common] == sets[0].positions[..common]);
    }
}

/// The promise of a window of a set.
fn part_of(set: &Points<2>, (min, max): Rect) -> (Vec<[f32; 2]>, Vec<f32>) {
    let inside = |sample: &[f32; 2]| {
        (0..2).all(|axis| min[axis] <= f64::from(sample[axis]) && f64::from(sample[axis]) < max[axis])
    };
    let both = set.positions.iter().copied().zip(set.ranks.iter().copied());
    both.filter(|(sample, _)| inside(sample)).unzip()
}

fn check_windows(random: &mut Random, options: &Options, windows: usize) {
    let whole = ranked(options);
    let context = Context::new(1).unwrap();
    let plane = Plane::new(&context, options, None).unwrap();
    assert!(plane.whole(&context, None).unwrap() == whole);
    for _ in 0..windows {
        let rect = random_window(random, &options.domain);
        let expected = part_of(&whole, rect);
        let kept = plane.window(rect.0, rect.1).unwrap();
        assert!((&kept.positions, &kept.ranks) == (&expected.0, &expected.1), "kept: {options:?} {rect:?}");
        let alone = sample_window(&context, options, rect.0, rect.1, None).unwrap();
        assert!((alone.positions, alone.ranks) == expected, "{options:?} {rect:?}");
    }
}

#[test]
fn windows_are_parts_of_the_whole() {
    let mut random = Random::new(4);
    for boundary in BOUNDARIES {
        // From the largest coarsest radius to one that is tiled, in which a window depends on a small part.
        for (seed, times, quotient) in [(1, f64::INFINITY, 1.3), (2, 4.0, 2f64.powf(0.25)), (3, 1.3, 1.1)] {
            let domain = domain([-0.3, 2.0], [0.7, 3.2], boundary);
            let levels = self::quotient(quotient).coarsest(times * 0.0023);
            let options = progressive(0.0023, levels, domain, seed).leaf_size(6.0);
            check_windows(&mut random, &options, 4);
        }
        for domain in hard_domains(boundary) {
            let radius = (domain.area() / 6000.0).sqrt().max(64.0 * float_spacing(&domain));
            let levels = quotient(1.4);
            check_windows(&mut random, &progressive(radius, levels.coarsest(2.5 * radius), domain, 9), 2);
            check_windows(&mut random, &progressive(radius, levels, domain, 9), 1);
        }
        let thin = domain([0.5; 2], [0.53, 30.5], boundary);
        check_windows(&mut random, &progressive(0.004, quotient(1.5), thin, 10), 4);
    }
}

/// A plane of which only some levels are kept, and in which the margins of a window reach around the torus in coarse
/// levels.
#[test]
fn windows_of_a_large_plane_are_parts_of_the_whole() {
    let mut random = Random::new(5);
    for boundary in BOUNDARIES {
        let options = progressive(0.002, quotient(1.5), Domain::unit(boundary), 11);
        check_windows(&mut random, &options, 3);
    }
}

/// Threads walk over one plane, which keeps what their windows made: on straight lines, back and forth, and far away.
#[test]
fn windows_do_not_depend_on_those_before() {
    for boundary in BOUNDARIES {
        let radius = 0.0025;
        let options = progressive(radius, quotient(1.4), Domain::unit(boundary), 12);
        let (whole, plane) = (ranked(&options), Plane::new(&Context::new(2).unwrap(), &options, None).unwrap());
        std::thread::scope(|scope| {
            for seed in 0..3 {
                let (whole, plane) = (&whole, &plane);
                scope.spawn(move || {
                    let mut random = Random::new(seed);
                    let side = 20.0 * radius;
                    let mut corner = [0.0; 2];
                    for step in 0..60 {
                        corner = match step % 12 {
                            0 => corner.map(|_| between(&mut random, 0.0, 1.0 - side)),
                            turn => [corner[0] + if turn < 8 { side } else { -0.6 * side }, corner[1] + 0.1 * side],
                        };
                        let corner = corner.map(|x| x.clamp(0.0, 1.0 - side));
                        let rect = (corner, corner.map(|x| x + side));
                        let window = plane.window(rect.0, rect.1).unwrap();
                        assert!((window.positions, window.ranks) == part_of(whole, rect), "{boundary:?} {rect:?}");
                    }
                });
            }
        });
    }
}

#[test]
fn the_samples_do_not_depend_on_the_threads() {
    for boundary in BOUNDARIES {
        for coarsest in [f64::INFINITY, 0.009] {
            let levels = Progressive::new().coarsest(coarsest);
            let options = progressive(0.003, levels, domain([0.0; 2], [1.0, 0.9], boundary), 12);
            let [one, three] = [1, 3].map(|threads| {
                let context = Context::new(threads).unwrap();
                let counted = CountOptions::new(70_000).domain(options.domain).levels(Some(Progressive::new()));
                let window = sample_window(&context, &options, [0.1, 0.2], [0.3, 0.9], None).unwrap();
                (sample(&context, &options, None).unwrap(), window, sample_count(&context, &counted, None).unwrap())
            });
            assert!(one == three);
        }
    }
}

#[test]
fn exact_counts_are_nested_prefixes() {
    let context = Context::new(1).unwrap();
    for boundary in BOUNDARIES {
        for extent in [[1.0, 1.0], [6.0, 0.11], [0.02, 9.0]] {
            let domain = domain([0.25, 0.5], [0.25 + extent[0], 0.5 + extent[1]], boundary);
            let options = CountOptions::new(1).domain(domain).seed(13).levels(Some(Progressive::new()));
            let counted = |count| sample_count(&context, &options.count(count), None).unwrap();
            let (largest, _) = counted(3000);
            for count in [1, 2, 3, 10, 99, 1000, 2999, 3000] {
                let (set, report) = counted(count);
                assert_eq!((set.positions.len() as u64, set.ranks.len() as u64), (count, count));
                assert!(largest.positions[..count as usize] == set.positions);
                assert!(largest.ranks[..count as usize] == set.ranks);
                let last = *set.ranks.last().unwrap();
                assert_eq!(report.radius, f64::from(last));
                assert_eq!(fault_of(&domain, DEFAULT_QUOTIENT, &set.positions, last), None);
            }
        }
    }
}

/// The oracle sees a sample that is missing, one that was moved, and a rank that is too large.
#[test]
fn the_oracle_notices_changed_prefixes() {
    let domain = Domain::unit(Boundary::Periodic);
    let set = ranked(&progressive(0.03, Progressive::new(), domain, 14));
    let mut random = Random::new(6);
    let (mut gaps, mut moved) = (0, 0);
    for _ in 0..30 {
        let mut changed = set.clone();
        let at = 1 + (random.unit() * (set.positions.len() - 2) as f32) as usize;
        changed.positions.remove(at);
        changed.ranks.remove(at);
        // The whole set is maximal for its radius, too.
        gaps += u32::from(find_gap(&domain, 0.03 + tolerance(&domain), &changed.positions).is_some());
        let mut changed = set.clone();
        changed.positions[at] = [random.unit(), random.unit()];
        moved += u32::from(fault(&domain, DEFAULT_QUOTIENT, &changed, at + 1).is_some());
        let mut changed = set.clone();
        changed.ranks[at] *= 1.2;
        assert!(fault(&domain, DEFAULT_QUOTIENT, &changed, at + 1).is_some());
    }
    assert!(gaps >= 28 && moved >= 28, "{gaps} {moved}");
}

#[test]
fn what_is_out_of_range_is_refused_by_name() {
    let context = Context::new(1).unwrap();
    let good = progressive(0.1, Progressive::new(), Domain::unit(Boundary::Periodic), 0);
    let levels = |levels| good.kind(Kind::Progressive(0.1, levels));
    let argument = |result: Result<(), Error>| match result {
        Err(Error::InvalidArgument { argument, .. }) => argument,
        other => panic!("{other:?}"),
    };
    for (bad, name) in [
        (levels(quotient(1.01)), "quotient"),
        (levels(quotient(1.51)), "quotient"),
        (levels(quotient(f64::NAN)), "quotient"),
        (levels(Progressive::new().coarsest(0.05)), "coarsest"),
        (levels(Progressive::new().coarsest(f64::NAN)), "coarsest"),
        (good.kind(Kind::Progressive(0.0, Progressive::new())), "radius"),
        (good.leaf_size(5.0), "leaf_size"),
    ] {
        assert_eq!(argument(sample(&context, &bad, None).map(|_| ())), name);
        assert_eq!(argument(Plane::new(&context, &bad, None).map(|_| ())), name);
        assert_eq!(argument(sample_window(&context, &bad, [0.0; 2], [1.0; 2], None).map(|_| ())), name);
    }
    let visit = |_: &[[f32; 2]]| ControlFlow::Continue(());
    let plane = Plane::new(&context, &good, None).unwrap();
    assert_eq!(argument(plane.stream(&context, visit, None)), "order");
    let counted = |levels| CountOptions::new(5).levels(Some(levels));
    assert_eq!(
        argument(sample_count(&context, &counted(Progressive::new().coarsest(0.1)), None).map(|_| ())),
        "coarsest"
    );
    assert_eq!(argument(sample_count(&context, &counted(quotient(2.0)), None).map(|_| ())), "quotient");
    assert_eq!(argument(sample_count(&context, &counted(Progressive::new()).count(0), None).map(|_| ())), "count");
}

/// The anisotropy of the mean spectrum of some prefixes, in decibels over that of isotropic sets.
fn anisotropy(domain: &Domain, prefixes: &[&[[f32; 2]]]) -> f64 {
    let context = Context::new(1).unwrap();
    let size = 2 * (2.1 * (prefixes[0].len() as f64).sqrt()) as usize + 1;
    let spectra: Vec<_> = prefixes.iter().map(|set| periodogram(&context, domain, set, size, None).unwrap()).collect();
    let mean = Periodogram::mean(&spectra).unwrap();
    let contrast = mean.contrast(mean.frequency_step()[0], 0.5..2.0).unwrap();
    10.0 * (contrast * prefixes.len() as f64).log10()
}

/// Levels that begin with one sample and add few, or double them, put these in symmetric places: the prefixes here had
/// 3 to 15 decibels.
#[test]
fn prefixes_have_no_preferred_directions() {
    for (quotient, height) in [
        (DEFAULT_QUOTIENT, 1.0),
        (2f64.powf(1.0 / 16.0), 1.0),
        (2f64.powf(0.25), 1.0),
        (2f64.sqrt(), 1.0),
        (1.42, 1.0),
        (DEFAULT_QUOTIENT, 0.5),
    ] {
        let domain = domain([0.0; 2], [1.0, height], Boundary::Periodic);
        let radius = (domain.area() * 0.6 / 1000.0).sqrt();
        let sets: Vec<_> =
            (0..8).map(|seed| ranked(&progressive(radius, self::quotient(quotient), domain, seed))).collect();
        for count in [240, 480, 850] {
            let prefixes: Vec<_> = sets.iter().map(|set| &set.positions[..count]).collect();
            let found = anisotropy(&domain, &prefixes);
            assert!(found.abs() < 1.2, "{found:+.2} dB: {count} samples, quotient {quotient}, height {height}");
        }
    }
}
