//! Several classes in the plane, from the definition: no conflict of any two classes, no place for another sample, and
//! the same in every part.

use azulejo::kdrt::{DEFAULT_QUOTIENT, Kind, Options, Plane, Progressive, sample};
use azulejo::{Boundary, Classes, Context, Domain, Error, Given, Points};

use crate::common::class_darts;
use crate::common::class_oracle::{Set, fault};
use crate::common::disks::{distance, find_gap};
use crate::common::sets::Random;
use crate::common::tiled;
use crate::common::windows::{self, random_window};
use crate::common::{BOUNDARIES, domain, float_spacing, hard_domains};

fn whole(options: &Options) -> Points<2> {
    sample(&Context::new(1).unwrap(), options, None).unwrap()
}

fn between(random: &mut Random, from: f64, to: f64) -> f64 {
    from + (to - from) * f64::from(random.unit())
}

/// A symmetric matrix of radii from `finest` to `spread` times as much; some pairs ignore each other, some keep more
/// than their own radii, some own radii are equal.
fn random_classes(random: &mut Random, count: usize, finest: f64, spread: f64) -> Classes {
    let mut own: Vec<f64> = (0..count).map(|_| finest * spread.powf(f64::from(random.unit()))).collect();
    for i in 1..count {
        if random.unit() < 0.4 {
            own[i] = own[i - 1];
        }
    }
    let mut radii = vec![0.0; count * count];
    for (i, j) in (0..count).flat_map(|i| (0..i).map(move |j| (i, j))) {
        let (less, more) = (own[i].min(own[j]), own[i].max(own[j]));
        let cross = match random.unit() {
            x if x < 0.2 => 0.0,
            x if x < 0.3 => 0.01 * less,
            x if x < 0.7 => between(random, 0.3, 1.0) * less,
            x if x < 0.9 => between(random, 0.3, 1.0) * more,
            _ => between(random, 1.0, 1.7) * more,
        };
        (radii[i * count + j], radii[j * count + i]) = (cross, cross);
    }
    (0..count).for_each(|i| radii[i * count + i] = own[i]);
    Classes::new(count, &radii).unwrap()
}

/// Samples in and around a domain, with clearances over several orders of magnitude and some of 0.
fn random_given(random: &mut Random, domain: &Domain, classes: &Classes, count: usize) -> Set {
    let mut given = Set::default();
    for i in 0..count {
        let place = [0, 1].map(|axis| {
            let wide = if i % 7 == 0 { 2.0 } else { 1.0 };
            let x = domain.min[axis] + domain.extent()[axis] * (0.5 + wide * (f64::from(random.unit()) - 0.5));
            x.clamp(-3e38, 3e38) as f32
        });
        given.0.push(place);
        for class in 0..classes.count() {
            let some = classes.own(class) * 10f64.powf(f64::from(random.unit()) * 3.0 - 2.0);
            given.1.push(if random.unit() < 0.2 { 0.0 } else { some });
        }
    }
    given
}

#[test]
fn the_oracle_notices_what_is_missing_moved_or_of_another_class() {
    let domain = domain([0.0; 2], [1.0; 2], Boundary::Periodic);
    let classes = Classes::of_radii(&[0.2, 0.1, 0.05], 1.0).unwrap();
    let set = whole(&Options::classes(&classes).domain(domain));
    let is_wrong = |change: &dyn Fn(&mut Points<2>)| {
        let mut changed = set.clone();
        change(&mut changed);
        fault(&domain, &classes, &Set::default(), &changed).is_some()
    };
    assert!(!is_wrong(&|_| ()));
    for i in 0..set.positions.len() {
        assert!(is_wrong(&|set| {
            set.positions.remove(i);
            set.classes.remove(i);
        }));
        // The first class covers everything alone.
        assert!(set.classes[i] == 0 || is_wrong(&|set| set.classes[i] = 0));
        let j = (i + 1) % set.positions.len();
        assert!(is_wrong(&|set| set.positions[i] = set.positions[j]));
    }
    let given = (vec![set.positions[0]], vec![0.01, 0.0, 0.0]);
    assert!(fault(&domain, &classes, &given, &set).is_some());
}

#[test]
fn no_two_classes_conflict_and_none_can_take_another_sample() {
    let mut random = Random::new(1);
    for boundary in BOUNDARIES {
        for domain in hard_domains(boundary) {
            for count in [1, 2, 3, 5, 8, 16] {
                // From a few samples of the finest class to some hundreds, but no finer than floats carry.
                let area = (domain.area() * 10f64.powf(between(&mut random, -3.0, -0.5))).sqrt();
                let finest = area.max(64.0 * float_spacing(&domain));
                let spread = [1.0, 2.0, 8.0][count % 3];
                let classes = random_classes(&mut random, count, finest, spread);
                let options = Options::classes(&classes).domain(domain).leaf_size(6.0).seed(count as u64);
                let set = whole(&options);
                assert_eq!(fault(&domain, &classes, &Set::default(), &set), None, "{domain:?} {classes:?}");
                let given = random_given(&mut random, &domain, &classes, 12);
                let around = options.given(Given::with_clearances(&given.0, &given.1));
                let set = whole(&around);
                assert_eq!(fault(&domain, &classes, &given, &set), None, "{domain:?} {classes:?} {given:?}");
            }
        }
    }
}

/// The samples of a class by rows.
fn of_class(set: &Points<2>, class: u32) -> Vec<[f32; 2]> {
    let samples = set.positions.iter().zip(&set.classes).filter(|(_, of)| **of == class);
    samples.map(|(sample, _)| *sample).collect()
}

/// The domains in which the first class is tiled.
#[test]
fn a_lone_class_of_the_largest_radius_is_the_set_of_kdrt() {
    for (seed, boundary) in BOUNDARIES.into_iter().enumerate() {
        let domain = domain([0.3, -0.2], [1.5, 0.8], boundary);
        let radius = tiled::tiled_radius(&domain, 6.0);
        let classes = Classes::of_radii(&[0.8 * radius, radius, 0.8 * radius], 1.0).unwrap();
        let options = Options::classes(&classes).domain(domain).leaf_size(6.0).seed(seed as u64);
        let set = whole(&options);
        assert_eq!(fault(&domain, &classes, &Set::default(), &set), None);
        let mut expected =
            sample(&Context::new(1).unwrap(), &options.kind(Kind::Plain(radius)), None).unwrap().positions;
        expected.sort_unstable_by(|a, b| a[1].total_cmp(&b[1]).then(a[0].total_cmp(&b[0])));
        assert_eq!(of_class(&set, 1), expected);
    }
}

/// Samples of a set that lie in a window.
fn part_of(set: &Points<2>, (min, max): windows::Rect) -> (Vec<[f32; 2]>, Vec<u32>) {
    let inside = |sample: &[f32; 2]| {
        (0..2).all(|axis| min[axis] <= f64::from(sample[axis]) && f64::from(sample[axis]) < max[axis])
    };
    set.positions.iter().zip(&set.classes).filter(|(sample, _)| inside(sample)).unzip()
}

#[test]
fn windows_and_threads_make_the_same_set() {
    let (mut random, threads) = (Random::new(5), Context::new(2).unwrap());
    for boundary in BOUNDARIES {
        for (extent, seed) in [([1.0, 0.7], 0), ([5.0, 0.12], 1), ([0.3, 0.3], 2), ([1.3, 1.1], 3)] {
            let domain = domain([-0.21, 3.0], [extent[0] - 0.21, 3.0 + extent[1]], boundary);
            for count in [2, 3, 6] {
                let classes = match count {
                    // The first class is tiled in the larger domains.
                    3 => Classes::of_radii(&[0.0099, 0.005, 0.007], 1.0).unwrap(),
                    _ => random_classes(&mut random, count, 0.006, 3.0),
                };
                let given = random_given(&mut random, &domain, &classes, 40);
                let options = Options::classes(&classes).domain(domain).leaf_size(6.0).seed(seed);
                let options = options.given(Given::with_clearances(&given.0, &given.1));
                let set = whole(&options);
                assert!(sample(&threads, &options, None).unwrap() == set);
                let plane = Plane::new(&threads, &options, None).unwrap();
                let windows = (0..12).map(|_| random_window(&mut random, &domain));
                for window in windows.chain([(domain.min, domain.max)]) {
                    let found = plane.window(window.0, window.1).unwrap();
                    assert!(
                        (found.positions, found.classes) == part_of(&set, window),
                        "{window:?} {options:?} {classes:?}"
                    );
                }
            }
        }
    }
}

/// The fault in the ranks of a set in progressive order, if there is one: they fall in each class, and all samples
/// of a group up to a rank keep the promises of that rank.
fn fault_of_ranks(domain: &Domain, classes: &Classes, given: &Set, set: &Points<2>, quotient: f64) -> Option<String> {
    let all: Vec<_> =
        (0..set.len()).map(|i| (set.positions[i], set.classes[i] as usize, f64::from(set.ranks[i]))).collect();
    let rises = |pair: &[(_, usize, f64)]| pair[0].1 > pair[1].1 || pair[0].1 == pair[1].1 && pair[0].2 < pair[1].2;
    if all.windows(2).any(rises) {
        return Some("ranks or classes are out of order".into());
    }
    for class in 0..classes.count() {
        let own = classes.own(class);
        let ranks: Vec<f64> = all.iter().filter(|(_, other, _)| *other == class).map(|(_, _, rank)| *rank).collect();
        for count in [1, 2, 7, 30, 99, 100, 300].into_iter().filter(|&count| count <= ranks.len()) {
            let last = ranks[count - 1];
            let group: Vec<_> =
                all.iter().filter(|(_, other, rank)| classes.own(*other) == own && *rank >= last).collect();
            for (i, (a, of_a, _)) in group.iter().enumerate() {
                let is_near = |(b, of_b, _): &&&([f32; 2], usize, f64)| {
                    distance(domain, *a, *b) < classes.radius(*of_a, *of_b) * (last / own) * (1.0 - 1e-12)
                };
                if let Some(near) = group[..i].iter().find(is_near) {
                    return Some(format!("{a:?} of {of_a} is too near to {near:?} at rank {last}"));
                }
            }
            let loose = if count < 100 { 2f64.max(quotient * quotient) } else { quotient };
            let in_group = group.iter().map(|(at, of, _)| (*at, classes.radius(class, *of) * (loose * last / own)));
            let larger = all.iter().filter(|(_, other, _)| classes.own(*other) > own);
            let larger = larger.map(|(at, other, _)| (*at, classes.radius(class, *other)));
            let given = given.0.iter().enumerate().map(|(i, &at)| (at, given.1[i * classes.count() + class]));
            let (tolerance, smallest) = (6.0 * float_spacing(domain), float_spacing(domain) / 16.0);
            if let Some(gap) = find_gap(domain, in_group.chain(larger).chain(given), tolerance, smallest) {
                return Some(format!("{gap:?} is not covered for {count} samples of {class} at rank {last}"));
            }
        }
    }
    None
}

/// In progressive order a set is one of classes as any other, and each class is thinned by its ranks.
#[test]
fn every_class_is_thinned_by_its_ranks() {
    let mut random = Random::new(9);
    for boundary in BOUNDARIES {
        for (number, domain) in hard_domains(boundary).into_iter().enumerate() {
            for count in [1, 2, 3, 6] {
                let area = (domain.area() * 10f64.powf(between(&mut random, -2.7, -0.5))).sqrt();
                let finest = area.max(64.0 * float_spacing(&domain));
                let classes = random_classes(&mut random, count, finest, [1.0, 3.0][number % 2]);
                let levels = Progressive::new().quotient([DEFAULT_QUOTIENT, 1.4][count % 2]);
                let options = Options::of(Kind::ProgressiveClasses(&classes, levels)).domain(domain).seed(count as u64);
                let given = if count == 3 { random_given(&mut random, &domain, &classes, 9) } else { Set::default() };
                let set = whole(&options.given(Given::with_clearances(&given.0, &given.1)));
                assert_eq!(fault(&domain, &classes, &given, &set), None, "{domain:?} {classes:?}");
                let fault = fault_of_ranks(&domain, &classes, &given, &set, levels.quotient);
                assert_eq!(fault, None, "{domain:?} {classes:?}");
            }
        }
    }
}

#[test]
fn the_oracle_of_ranks_notices_what_is_not_as_they_say() {
    let domain = domain([0.0; 2], [1.0; 2], Boundary::Periodic);
    let classes = Classes::of_radii(&[0.1, 0.05, 0.05], 1.0).unwrap();
    let set = whole(&Options::of(Kind::ProgressiveClasses(&classes, Progressive::new())));
    let is_wrong = |change: &dyn Fn(&mut Points<2>)| {
        let mut changed = set.clone();
        change(&mut changed);
        fault_of_ranks(&domain, &classes, &Set::default(), &changed, DEFAULT_QUOTIENT).is_some()
    };
    assert!(!is_wrong(&|_| ()));
    assert!(is_wrong(&|set| set.ranks.swap(0, 20)));
    assert!(is_wrong(&|set| set.ranks.iter_mut().for_each(|rank| *rank *= 1.3)));
    assert!(is_wrong(&|set| set.ranks.iter_mut().for_each(|rank| *rank /= 2.1)));
    assert!(is_wrong(&|set| set.positions[3] = set.positions[4]));
}

#[test]
fn windows_and_threads_make_the_same_ordered_set() {
    let (mut random, threads) = (Random::new(6), Context::new(2).unwrap());
    for boundary in BOUNDARIES {
        let domain = domain([-0.21, 3.0], [0.79, 3.6], boundary);
        for (count, coarsest) in [(1, 0.08), (2, f64::INFINITY), (3, 0.1), (4, 0.06)] {
            let classes = random_classes(&mut random, count, 0.013, 3.0);
            let levels = Progressive::new().quotient(1.3).coarsest(coarsest);
            let options = Options::of(Kind::ProgressiveClasses(&classes, levels)).domain(domain);
            let set = whole(&options);
            assert!(sample(&threads, &options, None).unwrap() == set);
            assert_eq!(fault(&domain, &classes, &Set::default(), &set), None);
            let plane = Plane::new(&threads, &options, None).unwrap();
            for window in (0..6).map(|_| random_window(&mut random, &domain)).chain([(domain.min, domain.max)]) {
                let found = plane.window(window.0, window.1).unwrap();
                let (positions, classes) = part_of(&set, window);
                let ranks = set.positions.iter().zip(&set.ranks).filter(|(at, _)| positions.contains(at));
                assert!(found.ranks == ranks.map(|(_, rank)| *rank).collect::<Vec<_>>());
                assert!((found.positions, found.classes) == (positions, classes), "{window:?} {options:?}");
            }
        }
    }
}

#[test]
fn radii_beyond_the_domain_leave_one_sample_or_none() {
    for boundary in BOUNDARIES {
        let domain = domain([0.0; 2], [1.0, 0.01], boundary);
        // Either class keeps the other away.
        let classes = Classes::new(2, &[1e3, 1e6, 1e6, 1e3]).unwrap();
        assert_eq!(whole(&Options::classes(&classes).domain(domain)).positions.len(), 1);
        let classes = Classes::new(2, &[1e3, 0.0, 0.0, 1e2]).unwrap();
        let options = Options::classes(&classes).domain(domain);
        assert_eq!(whole(&options).classes, [0, 1]);
        let given = options.given(Given::with_clearances(&[[0.5, 0.0]], &[2.0, 0.0]));
        assert_eq!(whole(&given).classes, [1]);
        let given = options.given(Given::at(&[[0.5, 0.0]]));
        assert!(whole(&given).positions.is_empty());
        // Fine classes of equal radii that keep each other away over the whole domain.
        let classes = Classes::new(3, &[0.01, 3.0, 0.004, 3.0, 0.01, 0.0, 0.004, 0.0, 0.3]).unwrap();
        let set = whole(&Options::classes(&classes).domain(domain));
        assert_eq!(fault(&domain, &classes, &Set::default(), &set), None);
        assert!(of_class(&set, 0).is_empty() != of_class(&set, 1).is_empty());
    }
}

/// Of each class its share of the samples that it would have alone.
fn shares(own: &[f64], factor: f64) -> Vec<f64> {
    let classes = Classes::of_radii(own, factor).unwrap();
    let mut counts = vec![0; own.len()];
    for seed in 0..2 {
        let set = whole(&Options::classes(&classes).seed(seed));
        set.classes.iter().for_each(|&class| counts[class as usize] += 1);
    }
    let full = |own: f64| 2.0 * azulejo::MAXIMAL_DENSITY / (own * own);
    std::iter::zip(counts, own).map(|(count, &own)| f64::from(count) / full(own)).collect()
}

/// The figures of an earlier implementation by other means.
#[test]
fn classes_have_the_shares_that_are_known() {
    let near = |shares: &[f64], expected: &[f64]| {
        let is_near = std::iter::zip(shares, expected).all(|(share, expected)| (share / expected - 1.0).abs() < 0.04);
        assert!(is_near, "{shares:?} for {expected:?}");
    };
    near(&shares(&[0.04, 0.02, 0.01], 1.0), &[1.0, 0.82, 0.82]);
    near(&shares(&[0.012; 3], 1.0), &[0.79; 3]);
    near(&shares(&[0.012; 3], 0.85), &[0.90; 3]);
    near(&shares(&[0.012; 3], 0.7), &[0.95; 3]);
    near(&shares(&[0.012, 0.9 * 0.012], 1.0), &[1.0, 0.68]);
}

/// Blocks that were filled at once, one beside the finished other, would give 2 % more samples.
#[test]
fn classes_are_as_dense_as_by_darts_one_after_the_other() {
    let near = |what: &str, found: f64, expected: f64| {
        assert!((found / expected - 1.0).abs() < 0.01, "{what}: {found} samples for {expected}");
    };
    // Wide enough for blocks, not for tiles, which are for one class alone.
    let radius = 0.008;
    let per_class = |own: &[f64], factor: f64| {
        let own: Vec<f64> = own.iter().map(|own| own * radius).collect();
        let classes = Classes::of_radii(&own, factor).unwrap();
        let sets = (0..4).map(|seed| whole(&Options::classes(&classes).seed(seed)));
        let count = |set: &Points<2>, class| set.classes.iter().filter(|&&other| other == class).count() as f64;
        let counts = |set: Points<2>| (0..own.len() as u32).map(|class| count(&set, class)).collect::<Vec<_>>();
        let counts: Vec<_> = sets.map(counts).collect();
        (0..own.len()).map(|class| counts.iter().map(|counts| counts[class]).sum::<f64>() / 4.0).collect::<Vec<_>>()
    };
    let alone = azulejo::MAXIMAL_DENSITY / (radius * radius);
    for (class, count) in per_class(&[1.0, 1.0], 0.0).into_iter().enumerate() {
        near(&format!("{class} of two that ignore each other"), count, alone);
    }
    // The set of all classes is denser, so a smaller torus is enough by darts.
    let domain = domain([0.0; 2], [1.0; 2], Boundary::Periodic);
    let mut random = Random::new(5);
    for (own, factor) in [(&[1.0, 1.0][..], 1.0), (&[1.0; 3], 0.7)] {
        let coarse: Vec<f64> = own.iter().map(|own| 0.06 * own).collect();
        let classes = Classes::of_radii(&coarse, factor).unwrap();
        let rounds = 20;
        let total: usize = (0..rounds).map(|_| class_darts::darts(&domain, &classes, &mut random).len()).sum();
        let expected = total as f64 / f64::from(rounds) * (0.06 / radius).powi(2);
        near(&format!("{own:?} by {factor}"), per_class(own, factor).iter().sum(), expected);
    }
}

#[test]
fn one_class_is_the_set_of_its_radius() {
    for boundary in BOUNDARIES {
        for radius in [0.005, 0.03, 2.0] {
            let classes = Classes::new(1, &[radius]).unwrap();
            let options = Options::classes(&classes).domain(Domain::unit(boundary)).leaf_size(6.0).seed(4);
            let set = whole(&options);
            assert_eq!(set.positions, whole(&options.kind(Kind::Plain(radius))).positions);
            assert_eq!(set.classes, vec![0; set.positions.len()]);
            let plane = Plane::new(&Context::new(1).unwrap(), &options, None).unwrap();
            assert_eq!(plane.window([0.0; 2], [1.0; 2]).unwrap(), set);
        }
    }
}

#[test]
fn what_classes_cannot_have_is_refused() {
    let context = Context::new(1).unwrap();
    let classes = Classes::of_radii(&[0.1, 0.05], 1.0).unwrap();
    let said = |options: &Options| {
        let error = sample(&context, options, None).unwrap_err().to_string();
        assert_eq!(Plane::new(&context, options, None).err().unwrap().to_string(), error);
        error
    };
    let options = Options::classes(&classes);
    let given = options.given(Given::with_clearances(&[[0.5; 2]], &[0.1]));
    assert_eq!(said(&given), "given_clearances: 1 for 1 positions and 2 classes");
    let fine = Classes::of_radii(&[0.1, 1e-7], 1.0).unwrap();
    assert!(said(&Options::classes(&fine)).starts_with("radii: 1e-7 is below"));
    let far = options.domain(domain([0.0; 2], [1.0, f64::INFINITY], Boundary::Bounded));
    assert!(said(&far).starts_with("domain_max: "));
    let plane = Plane::new(&context, &options, None).unwrap();
    let streamed = plane.stream(&context, |_| panic!("visited"), None);
    assert!(matches!(streamed, Err(Error::InvalidArgument { argument: "classes", .. })));
    // More samples than can be held are refused where they are asked for.
    let many = Classes::of_radii(&[1.0, 4e-6], 1.0).unwrap();
    let options = Options::classes(&many);
    let error = sample(&context, &options, None).unwrap_err().to_string();
    assert!(error.contains("4e-6") || error.starts_with("radi"), "{error}");
    let plane = Plane::new(&context, &options, None).unwrap();
    assert!(!plane.window([0.5; 2], [0.5001; 2]).unwrap().positions.is_empty());
    assert!(plane.window([0.5; 2], [1.5; 2]).unwrap_err().to_string().starts_with("window_max: "));
}
