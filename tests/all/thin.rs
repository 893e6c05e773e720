//! Thinning against naive oracles.

use azulejo::thin::{Options, Selection, thin};
use azulejo::{Context, Error, Order};

use crate::common::random::Random;
use crate::common::triangle::distance;

/// The definition: each point that no kept one before it is nearer to.
fn kept_by_radius<const D: usize>(cloud: &[[f32; D]], radius: f64) -> Vec<u32> {
    let mut kept: Vec<u32> = Vec::new();
    for (index, &point) in (0..).zip(cloud) {
        if !kept.iter().any(|&earlier| distance(cloud[earlier as usize], point) < radius) {
            kept.push(index);
        }
    }
    kept
}

/// The definition: each next point is the farthest from those before, the lowest index on ties. All points, with
/// distances.
fn farthest_first<const D: usize>(cloud: &[[f32; D]], first: u32) -> Vec<(u32, f64)> {
    let mut distances = vec![f64::INFINITY; cloud.len()];
    let mut order = Vec::new();
    let mut next = (first, f64::INFINITY);
    loop {
        order.push(next);
        let place = cloud[next.0 as usize];
        for (least, &point) in distances.iter_mut().zip(cloud) {
            *least = least.min(distance(point, place));
        }
        distances[next.0 as usize] = f64::NEG_INFINITY;
        for &(index, _) in &order {
            distances[index as usize] = f64::NEG_INFINITY;
        }
        let farthest = (0..).zip(&distances).filter(|(_, least)| **least >= 0.0);
        // The last of equal ones is the greatest: from behind, that is the first.
        let Some((index, &least)) = farthest.collect::<Vec<_>>().into_iter().rev().max_by(|a, b| a.1.total_cmp(b.1))
        else {
            return order;
        };
        next = (index, least);
    }
}

/// Selections that are known: by hand, of points on a line with two at one place and ties.
#[test]
fn the_oracles_are_those_of_known_clouds() {
    let line = [0.0, 1.0, 5.0, 1.0, 2.0, 10.0, 3.0].map(|x: f32| [x, 0.0]);
    for (radius, kept) in [
        (0.5, vec![0, 1, 2, 4, 5, 6]),
        (1.0, vec![0, 1, 2, 4, 5, 6]),
        (1.5, vec![0, 2, 4, 5]),
        (2.0, vec![0, 2, 4, 5]),
        (2.0001, vec![0, 2, 5]),
        (11.0, vec![0]),
    ] {
        assert_eq!(kept_by_radius(&line, radius), kept, "{radius}");
    }
    // Ranks along the line from its start; 1 and 3 at one place; of equal distances that of the lowest index first.
    let expected = [(0, f64::INFINITY), (5, 10.0), (2, 5.0), (4, 2.0), (1, 1.0), (6, 1.0), (3, 0.0)];
    assert_eq!(farthest_first(&line, 0), expected);
    assert_eq!(farthest_first(&line, 2)[..3], [(2, f64::INFINITY), (0, 5.0), (5, 5.0)]);
    // One point that moves is noticed.
    let mut moved = line;
    moved[4][0] = 2.75;
    assert_ne!(farthest_first(&moved, 0), expected);
    assert_ne!(kept_by_radius(&moved, 0.5), kept_by_radius(&line, 0.5));
}

/// Clouds of points of all kinds, each with a radius that keeps some of them.
fn clouds<const D: usize>(count: usize, seed: u64) -> Vec<(&'static str, Vec<[f32; D]>, f64)> {
    let mut random = Random::new(seed);
    let mut unit = || random.unit();
    let huge = |x: f32| 6.8e38f64.mul_add(f64::from(x), -3.4e38) as f32;
    let all = 0..count;
    vec![
        ("uniform", all.clone().map(|_| [(); D].map(|()| unit())).collect(), 0.13),
        ("heaps", all.clone().map(|i| [(); D].map(|()| (i % 5) as f32 + 1e-3 * unit())).collect(), 4e-4),
        ("few places", all.clone().map(|_| [(); D].map(|()| (4.0 * unit()).floor())).collect(), 1.5),
        ("one place", vec![[0.5; D]; count], 0.5),
        ("a diagonal", all.clone().map(|_| [unit(); D]).collect(), 0.02),
        ("along an axis", all.clone().map(|_| along_axis(unit(), || 3.0)).collect(), 0.01),
        ("a scan", all.clone().map(|i| along_axis(i as f32 / 50.0, &mut unit)).collect(), 0.3),
        ("a lattice", all.clone().map(on_lattice).collect(), 2.0),
        ("just apart", all.clone().map(|i| [(i % 9) as f32; D]).collect(), (D as f64).sqrt()),
        ("far away", all.clone().map(|_| [(); D].map(|()| 1e6 + unit())).collect(), 0.125),
        ("tiny", all.clone().map(|_| [(); D].map(|()| 1e-44 * unit())).collect(), 3e-45),
        ("huge", all.clone().map(|_| [(); D].map(|()| huge(unit()))).collect(), 1e38),
        ("all scales", all.clone().map(|_| [(); D].map(|()| 10f32.powf(60.0 * unit() - 30.0))).collect(), 1e-3),
        ("an outlier", all.map(|i| [(); D].map(|()| if i == 3 { 1e20 } else { unit() })).collect(), 0.2),
    ]
}

fn along_axis<const D: usize>(x: f32, mut other: impl FnMut() -> f32) -> [f32; D] {
    std::array::from_fn(|axis| if axis == 0 { x } else { other() })
}

fn on_lattice<const D: usize>(i: usize) -> [f32; D] {
    std::array::from_fn(|axis| (i / 7usize.pow(axis as u32) % 7) as f32)
}

fn check<const D: usize>(count: usize, seed: u64) {
    let contexts = [1, 2, 3].map(|threads| Context::new(threads).unwrap());
    for (name, cloud, radius) in clouds::<D>(count, seed) {
        let what = format!("{name}, {count} points of {D} coordinates, seed {seed}");
        let thinned = |options: &Options| {
            let results = contexts.each_ref().map(|context| thin(context, options, &cloud, None).unwrap());
            assert!(results.iter().all(|result| *result == results[0]), "{what}: threads");
            results[0].clone()
        };
        let by_radius = thinned(&Options::by_radius(radius).seed(seed));
        assert_eq!(by_radius.indices, kept_by_radius(&cloud, radius), "{what}: radius");
        assert!(by_radius.ranks.is_empty());

        let all = thinned(&Options::progressive().seed(seed));
        let expected = farthest_first(&cloud, all.indices[0]);
        assert_eq!(all.indices, expected.iter().map(|&(index, _)| index).collect::<Vec<_>>(), "{what}: order");
        let is_rank = |rank: f32, distance: f64| {
            let rounded_down = f64::from(rank) <= distance && f64::from(rank.next_up()) > distance;
            rounded_down || rank == f32::INFINITY && distance == f64::INFINITY
        };
        assert!(std::iter::zip(&all.ranks, &expected).all(|(&rank, &(_, distance))| is_rank(rank, distance)), "{what}");
        assert_eq!(all.ranks.len(), count);

        // Stopped early, and in the order of the cloud.
        let part = (count / 3).max(1);
        for (given, kept) in [
            (Options::progressive().seed(seed).count(part), part),
            (Options::progressive().seed(seed).count(10 * count), count),
            (Options::progressive().seed(seed).radius(radius), reaching(&expected, radius, count)),
            (Options::progressive().seed(seed).radius(radius).count(part), reaching(&expected, radius, part)),
        ] {
            let Selection { indices, ranks, .. } = thinned(&given);
            assert_eq!(indices, all.indices[..kept], "{what}: {given:?}");
            assert_eq!(ranks, all.ranks[..kept], "{what}: {given:?}");
            if given.count > 0 {
                let sorted = thinned(&given.order(Order::Any));
                let mut indices = indices;
                indices.sort();
                assert_eq!(sorted.indices, indices, "{what}: {given:?}");
                assert!(sorted.ranks.is_empty());
            }
        }
    }
}

/// The number of points of the order that are at least `radius` apart, at most `count`.
fn reaching(order: &[(u32, f64)], radius: f64, count: usize) -> usize {
    order.iter().take_while(|&&(_, distance)| distance >= radius).count().min(count)
}

#[test]
fn the_points_are_those_of_the_definitions() {
    for seed in 0..6 {
        for count in [1, 2, 3, 16, 17, 100, 300] {
            check::<2>(count, seed);
            check::<3>(count, seed);
        }
    }
    check::<2>(2500, 99);
    check::<3>(2500, 98);
    check::<1>(700, 97);
    check::<5>(700, 96);
}

#[test]
fn large_clouds_are_thinned_as_promised() {
    let mut random = Random::new(4);
    let cloud: Vec<[f32; 3]> = (0..60_000).map(|_| [(); 3].map(|()| random.unit())).collect();
    let context = Context::new(2).unwrap();
    let ordered = thin(&context, &Options::progressive().count(6_000), &cloud, None).unwrap();
    assert!(ordered.ranks.is_sorted_by(|a, b| a >= b));
    // Coarser than the last rank, nothing is left; and a prefix is what its last rank selects.
    let radius = f64::from(ordered.ranks[2_000]);
    let prefix = thin(&context, &Options::progressive().radius(radius), &cloud, None).unwrap();
    assert!(prefix.indices.len() > 2_000 && ordered.indices.starts_with(&prefix.indices));
    let apart = thin(&context, &Options::by_radius(0.05), &cloud, None).unwrap();
    assert_eq!(apart.indices, kept_by_radius(&cloud, 0.05));
}

#[test]
fn seeds_choose_the_first_point_and_nothing_else() {
    let mut random = Random::new(8);
    let cloud: Vec<[f32; 2]> = (0..500).map(|_| [random.unit(), random.unit()]).collect();
    let context = Context::new(1).unwrap();
    let select = |options: Options, seed| thin(&context, &options.seed(seed), &cloud, None).unwrap().indices;
    let firsts: Vec<u32> = (0..40).map(|seed| select(Options::progressive().count(1), seed)[0]).collect();
    let mut different = firsts.clone();
    different.sort();
    different.dedup();
    assert!(different.len() > 30, "{firsts:?}");
    assert_eq!(select(Options::by_radius(0.1), 1), select(Options::by_radius(0.1), 2));
}

#[test]
fn no_two_selected_points_are_closer_than_the_radius_of_the_selection() {
    let context = Context::new(1).unwrap();
    let (_, cloud, _) = clouds::<2>(500, 3).swap_remove(0);
    let smallest = |indices: &[u32]| {
        let pairs = indices.iter().enumerate().flat_map(|(i, &a)| indices[..i].iter().map(move |&b| (a, b)));
        pairs.map(|(a, b)| distance(cloud[a as usize], cloud[b as usize])).fold(f64::INFINITY, f64::min)
    };
    for options in [
        Options::by_count(40),
        Options::by_count(1),
        Options::progressive().count(70),
        Options::progressive().radius(0.1),
        Options::progressive(),
    ] {
        let selection = thin(&context, &options, &cloud, None).unwrap();
        assert_eq!(selection.radius, smallest(&selection.indices), "{options:?}");
    }
    let selection = thin(&context, &Options::by_radius(0.1), &cloud, None).unwrap();
    assert!(selection.radius == 0.1 && smallest(&selection.indices) >= 0.1);
    assert_eq!(thin(&context, &Options::by_radius(9.0), &cloud, None).unwrap().radius, f64::INFINITY);
}

#[test]
fn empty_clouds_are_empty_selections() {
    let context = Context::new(2).unwrap();
    for options in [Options::by_radius(1.0), Options::by_count(5), Options::progressive()] {
        assert_eq!(thin::<2>(&context, &options, &[], None).unwrap().indices, [] as [u32; 0]);
    }
}

#[test]
fn what_makes_no_sense_is_refused_by_name() {
    let context = Context::new(1).unwrap();
    let message = |options: Options, cloud: &[[f32; 3]]| match thin(&context, &options, cloud, None) {
        Err(error @ Error::InvalidArgument { .. }) => error.to_string(),
        other => panic!("{options:?}: {other:?}"),
    };
    for (options, expected) in [
        (Options::by_radius(0.0), "radius: 0, and so is count; give one of them, or ask for progressive order"),
        (Options::by_radius(-1.0), "radius: -1 is not a positive finite number"),
        (Options::by_radius(f64::NAN), "radius: NaN is not a positive finite number"),
        (Options::progressive().radius(f64::INFINITY), "radius: inf is not a positive finite number"),
    ] {
        assert_eq!(message(options, &[]), expected);
    }
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let cloud = [[0.0; 3], [1.0; 3], [2.0, bad, 2.0]];
        let said = message(Options::by_radius(1.0), &cloud);
        assert_eq!(said, format!("positions: point 2 is {:?}, not finite", cloud[2]));
    }
}
