//! Several classes in cuboids: distances, cover, shares, given samples, threads and bad input.

use azulejo::volume::{self, ClassesOptions, sample_classes};
use azulejo::{Boundary, Classes, Context, Domain, Given, Points};

use crate::common::random::Random;
use crate::common::{BOUNDARIES, float_spacing};

fn set(options: &ClassesOptions, classes: &Classes) -> Points<3> {
    sample_classes(&Context::new(1).unwrap(), options, classes, None).unwrap()
}

fn cuboid(max: [f64; 3], boundary: Boundary) -> Domain<3> {
    Domain { min: [0.0; 3], max, boundary }
}

/// The distance of two places, around the torus.
fn distance(domain: &Domain<3>, p: [f32; 3], q: [f32; 3]) -> f64 {
    let along = |axis: usize| {
        let way = (f64::from(p[axis]) - f64::from(q[axis])).abs();
        let period = domain.max[axis] - domain.min[axis];
        if domain.boundary == Boundary::Periodic { way.min((period - way).abs()) } else { way }
    };
    (0..3).map(|axis| along(axis) * along(axis)).sum::<f64>().sqrt()
}

/// All pairs; and for each class random places, and those halfway between samples, where gaps would be.
fn check(domain: &Domain<3>, classes: &Classes, given: &Given<3>, set: &Points<3>) {
    let (count, positions) = (classes.count(), &set.positions);
    assert!(set.classes.is_sorted() && set.classes.len() == positions.len() && set.ranks.is_empty());
    assert!(positions.iter().all(|p| (0..3).all(|k| (domain.min[k]..domain.max[k]).contains(&p[k].into()))));
    let class = |i: usize| set.classes[i] as usize;
    let clearance = |g: usize, class: usize| {
        given.clearances.map_or(classes.own(class), |clearances| clearances[g * count + class])
    };
    for i in 0..positions.len() {
        for j in 0..i {
            let (apart, radius) = (distance(domain, positions[i], positions[j]), classes.radius(class(i), class(j)));
            assert!(apart >= radius, "{i} and {j}, of {} and {}: {apart} < {radius}", class(i), class(j));
        }
        for (g, &at) in given.positions.iter().enumerate() {
            let apart = distance(domain, positions[i], at);
            assert!(apart >= clearance(g, class(i)), "{i} of {} and given {g}: {apart}", class(i));
        }
    }
    let mut random = Random::new(6);
    let tolerance = 7.0 * float_spacing(domain);
    for probe in 0..2000 {
        let anywhere = |k: usize| domain.min[k] + f64::from(random.unit()) * (domain.max[k] - domain.min[k]) * 0.9999;
        let place = match (probe % 2, positions.len()) {
            (1, many) if many > 0 => {
                let [p, q] = [positions[probe * 7 % many], positions[(probe * 7 + 1) % many]];
                [0, 1, 2].map(|k: usize| 0.5 * (p[k] + q[k]))
            }
            _ => [0, 1, 2].map(anywhere).map(|x| x as f32),
        };
        for of in 0..count {
            let by_sample = (0..positions.len())
                .any(|i| distance(domain, place, positions[i]) <= classes.radius(of, class(i)) + tolerance);
            let by_given = || {
                (0..given.positions.len())
                    .any(|g| distance(domain, place, given.positions[g]) <= clearance(g, of) + tolerance)
            };
            assert!(by_sample || by_given(), "{place:?} is open for {of}");
        }
    }
}

#[test]
fn classes_keep_their_distances_and_leave_nothing_open() {
    let matrices = [
        Classes::of_radii(&[0.2], 1.0),
        Classes::of_radii(&[0.25, 0.12, 0.18], 1.0),
        Classes::of_radii(&[0.2, 0.2, 0.13], 0.8),
        Classes::of_radii(&[0.22, 0.22, 0.22], 1.0),
        Classes::new(2, &[0.2, 0.0, 0.0, 0.15]),
        Classes::new(2, &[0.15, 0.3, 0.3, 0.15]),
        Classes::new(3, &[0.3, 0.1, 0.0, 0.1, 0.15, 0.5, 0.0, 0.5, 0.2]),
    ]
    .map(Result::unwrap);
    for boundary in BOUNDARIES {
        for (number, classes) in (0..).zip(&matrices) {
            for max in [[1.0, 0.8, 1.1], [2.0, 0.05, 0.7]] {
                let options = ClassesOptions::default().domain(cuboid(max, boundary)).seed(number);
                let set = set(&options, classes);
                check(&options.domain, classes, &Given::default(), &set);
                assert!(set.len() > 3);
            }
        }
    }
}

#[test]
fn given_samples_keep_a_clearance_from_each_class() {
    let classes = Classes::of_radii(&[0.2, 0.14, 0.14], 1.0).unwrap();
    let mut random = Random::new(9);
    let positions: Vec<[f32; 3]> = (0..30).map(|_| [0; 3].map(|_| random.unit() * 1.2 - 0.1)).collect();
    let clearances: Vec<f64> = (0..90).map(|_| f64::from(random.unit() * 0.3)).collect();
    for boundary in BOUNDARIES {
        for given in [Given::at(&positions), Given::with_clearances(&positions, &clearances)] {
            let options = ClassesOptions::default().domain(cuboid([1.0; 3], boundary)).given(given);
            check(&options.domain, &classes, &given, &set(&options, &classes));
        }
    }
}

/// Two and four classes of one radius; the first of unequal ones has the density that it has alone.
#[test]
fn equal_classes_have_equal_shares_and_the_largest_its_own() {
    for own in [&[0.06; 2][..], &[0.07; 4]] {
        let set = set(&ClassesOptions::default().seed(3), &Classes::of_radii(own, 1.0).unwrap());
        let share = |class: u32| set.classes.iter().filter(|&&of| of == class).count() as f64 / set.len() as f64;
        let shares: Vec<f64> = (0..own.len() as u32).map(share).collect();
        assert!(shares.iter().all(|share| (share * own.len() as f64 - 1.0).abs() < 0.03), "{shares:?}");
    }
    let set = set(&ClassesOptions::default(), &Classes::of_radii(&[0.05, 0.08], 1.0).unwrap());
    let first = set.classes.iter().filter(|&&class| class == 1).count() as f64;
    let alone = volume::sample(&Context::new(1).unwrap(), &volume::Options::new(0.08), None).unwrap().0.len() as f64;
    assert!((first / alone - 1.0).abs() < 0.03, "{first} of {alone}");
}

#[test]
fn threads_do_not_matter_and_seeds_do() {
    let classes = Classes::of_radii(&[0.06, 0.05, 0.05], 0.9).unwrap();
    let options = ClassesOptions::default().seed(5);
    let one = set(&options, &classes);
    for threads in [2, 3] {
        assert_eq!(sample_classes(&Context::new(threads).unwrap(), &options, &classes, None).unwrap(), one);
    }
    assert_ne!(set(&options.seed(6), &classes).positions, one.positions);
}

#[test]
fn bad_arguments_are_refused_by_name() {
    let options = ClassesOptions::default();
    let classes = |own: &[f64]| Classes::of_radii(own, 1.0).unwrap();
    let flat = cuboid([1.0, 1.0, 0.0], Boundary::Bounded);
    for (options, classes, said) in [
        (options.domain(flat), classes(&[0.1]), "domain_max: [2] is 0, not above domain_min"),
        (options, classes(&[0.1, 1e-7]), "radii: [1][1] is 1e-7, below 64 float spacings"),
        (options, classes(&[1e-4, 0.1]), "radii: they ask for about 7.3"),
        (options.given(Given::at(&[[0.5, f32::NAN, 0.5]])), classes(&[0.1]), "given_positions: [0] is [0.5, NaN, 0.5]"),
        (
            options.given(Given::with_clearances(&[[0.5; 3]], &[0.1])),
            classes(&[0.1, 0.2]),
            "given_clearances: 1 for 1 positions and 2 classes",
        ),
    ] {
        let called = |_| panic!("the work began");
        let error = sample_classes(&Context::new(1).unwrap(), &options, &classes, Some(&called)).unwrap_err();
        assert!(error.to_string().starts_with(said), "{error}");
    }
}
