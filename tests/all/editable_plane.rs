//! Sets of the plane that are edited: strokes at seams and corners, given samples that come and go, undo and redo, held
//! against the definitions by plain checkers after every refill.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use azulejo::kdrt::{self, EditableSet, Options, Progressive};
use azulejo::{Boundary, Classes, Context, Domain, Error, Given, Points, Region, maximal};

use crate::common::random::Random;
use crate::common::tiled::tiled_radius;
use crate::common::{BOUNDARIES, distance, domain, float_spacing, hard_domains};
use crate::plane_given::fault;

fn context() -> Context {
    Context::new(1).unwrap()
}

/// Each sample by its id, as bits.
fn by_id(samples: &Points<2>) -> BTreeMap<u64, [u32; 2]> {
    assert_eq!(samples.ids.len(), samples.len());
    std::iter::zip(&samples.ids, &samples.positions).map(|(&id, at)| (id, at.map(f32::to_bits))).collect()
}

/// A position in space, of the image that is so many periods away.
fn image(domain: &Domain, position: [f64; 2], turns: [i32; 2]) -> [f64; 3] {
    let along = |axis: usize| position[axis] + f64::from(turns[axis]) * domain.extent()[axis];
    [along(0), along(1), 0.0]
}

/// All turns of a torus up to four, no turn of a bounded domain.
fn turns(domain: &Domain) -> impl Iterator<Item = [i32; 2]> + use<> {
    let most = if domain.boundary == Boundary::Periodic { 4 } else { 0 };
    (-most..=most).flat_map(move |y| (-most..=most).map(move |x| [x, y]))
}

/// True if an image of a position lies in the region's box, and one in its ball.
fn contains(domain: &Domain, region: &Region, position: [f32; 2]) -> bool {
    let images = || turns(domain).map(|turns| image(domain, position.map(f64::from), turns));
    let in_box = |p: [f64; 3]| (0..3).all(|axis| (region.min[axis]..=region.max[axis]).contains(&p[axis]));
    let in_ball = |p: [f64; 3]| {
        (0..3).map(|axis| (p[axis] - region.centre[axis]).powi(2)).sum::<f64>() <= region.radius * region.radius
    };
    images().any(in_box) && images().any(in_ball)
}

/// A region of some radii: around any place, a corner or an edge of the domain, sometimes an image of it; or none.
fn region(random: &mut Random, domain: &Domain, radius: f64) -> Region {
    let mut unit = || f64::from(random.unit());
    let mut at: [f64; 2] = std::array::from_fn(|axis| match (4.0 * unit()) as u32 {
        0 => domain.min[axis],
        1 => domain.max[axis],
        _ => domain.min[axis] + domain.extent()[axis] * unit(),
    });
    if domain.boundary == Boundary::Periodic && unit() < 0.3 {
        at = [at[0] + domain.extent()[0], at[1] - 2.0 * domain.extent()[1]];
    }
    let size = radius * (0.3 + 5.0 * unit() * unit());
    let [x, y] = at;
    let ball = Region::ball([x, y, 0.0], size);
    let [low, high] = [-size, size].map(|by| [x + by, y + by, by]);
    match (6.0 * unit()) as u32 {
        0 | 1 => ball,
        2 | 3 => Region::cuboid(low, high),
        4 => Region { min: [x - size, f64::NEG_INFINITY, 0.0], max: [x, f64::INFINITY, 0.0], ..ball },
        // Above the plane, and the ball so high that it has a small disk of it.
        _ if unit() < 0.5 => Region::cuboid([x, y, size], [x, y, size]),
        _ => Region::ball([x, y, 0.9 * size], size),
    }
}

/// A session of random edits on 1 and on 3 threads. After each refill the set is maximal around what is given, and all
/// that was not erased is as it was, with its id.
fn session(options: &Options, make: impl Fn() -> EditableSet, seed: u64, steps: usize) {
    let (mut sets, domain) = ([(); 2].map(|()| make()), options.domain);
    let contexts = [1, 3].map(|threads| Context::new(threads).unwrap());
    let radius = sets[0].radius();
    let mut random = Random::new(seed);
    let mut given: BTreeMap<u64, ([f32; 2], f64)> = (0..)
        .zip(options.given.positions.iter().copied())
        .map(|(id, at)| (id, (at, options.given.clearance(id as usize, radius))))
        .collect();
    let mut known = by_id(&sets[0].samples());
    let mut next = known.len() as u64;
    for step in 0..steps {
        for _ in 0..=(2.0 * random.unit()) as usize {
            let current = sets[0].samples();
            let pick = |random: &mut Random| (random.unit() * current.len() as f32) as usize % current.len().max(1);
            let mut erased = Vec::new();
            match (5.0 * random.unit()) as u32 {
                0 | 1 => {
                    let region = if step == 3 { Region::EVERYWHERE } else { region(&mut random, &domain, radius) };
                    erased = sets.each_mut().map(|set| set.erase(&region).unwrap()).to_vec();
                    let inside = current.positions.iter().filter(|&&at| contains(&domain, &region, at)).count();
                    assert_eq!(erased[0].len(), inside, "{region:?}");
                }
                2 if !current.is_empty() => {
                    let mut ids: Vec<u64> = (0..5).map(|_| current.ids[pick(&mut random)]).collect();
                    ids.sort_unstable();
                    ids.dedup();
                    erased = sets.each_mut().map(|set| set.erase_ids(&ids).unwrap()).to_vec();
                    assert_eq!(erased[0].ids, ids);
                }
                3 if !current.is_empty() => {
                    let position = current.positions[pick(&mut random)].map(|x| x + 0.3 * radius as f32);
                    let clearance = radius * f64::from(4.0 * random.unit());
                    let added =
                        Given::with_clearances(std::slice::from_ref(&position), std::slice::from_ref(&clearance));
                    let results = sets.each_mut().map(|set| set.add_given(added).unwrap());
                    assert_eq!(results[0].0, results[1].0);
                    assert!(given.insert(results[0].0, (position, clearance)).is_none());
                    erased = results.map(|(_, erased)| erased).to_vec();
                    let near = current.positions.iter().filter(|&&at| distance(&domain, at, position) < clearance);
                    assert_eq!(erased[0].len(), near.count());
                }
                _ => {
                    let Some(&id) = given.keys().next() else { continue };
                    sets.iter_mut().for_each(|set| set.remove_given(&[id]).unwrap());
                    given.remove(&id);
                }
            }
            if let [one, other] = &erased[..] {
                assert_eq!(one, other);
                for (id, sample) in by_id(one) {
                    assert_eq!(known.remove(&id), Some(sample));
                }
            }
            assert_eq!(by_id(&sets[0].samples()), known);
        }
        let [added, again] = [0, 1].map(|i| sets[i].refill(&contexts[i], step as u64, None).unwrap());
        assert_eq!(added, again, "depends on the number of threads");
        for (id, sample) in by_id(&added) {
            assert!(id >= next && known.insert(id, sample).is_none());
        }
        next += added.len() as u64;
        let samples = sets[0].samples();
        assert_eq!((by_id(&samples), samples.len()), (known.clone(), sets[0].len()), "what stands stays as it is");
        let balls = given.values().copied().unzip();
        assert_eq!(fault(&domain, radius, &balls, &samples.positions), None, "step {step} of {domain:?}, {radius}");
    }
}

/// A session that begins with a set of the library.
fn session_of_sample(options: &Options, seed: u64, steps: usize) {
    session(options, || EditableSet::sample(&context(), options, None).unwrap(), seed, steps);
}

#[test]
fn every_refill_makes_the_set_maximal_and_leaves_the_rest_alone() {
    for boundary in BOUNDARIES {
        for (seed, domain) in (0..).zip(hard_domains(boundary)) {
            let radius = (2.0 * tiled_radius(&domain, 6.0)).max(64.0 * float_spacing(&domain));
            session_of_sample(&Options::new(radius).domain(domain).seed(seed), seed, 8);
        }
        // Several tiles, and on the torus one that wraps along one axis alone.
        let given: Vec<[f32; 2]> = (0..20).map(|i| [0.05 * i as f32, 0.5 + 0.1 * i as f32]).collect();
        let clearances: Vec<f64> = (0..20).map(|i| 0.01 * f64::from(i)).collect();
        let around = Given::with_clearances(&given, &clearances);
        let square = domain([0.0; 2], [1.0, 0.9], boundary);
        session_of_sample(&Options::new(0.012).domain(square).given(around).seed(1), 20, 8);
        session_of_sample(&Options::new(0.012).domain(domain([0.0; 2], [3.0, 0.2], boundary)), 21, 8);
        session_of_sample(&Options::new(0.012).domain(domain([0.0; 2], [0.015, 2.0], boundary)), 22, 8);
        // Narrower than the radius, and as a whole smaller than it.
        session_of_sample(&Options::new(0.3).domain(domain([0.0; 2], [0.2, 3.0], boundary)), 23, 8);
        session_of_sample(&Options::new(3.0).domain(domain([0.0; 2], [0.7, 1.0], boundary)), 24, 8);
    }
}

#[test]
fn many_seeds_of_small_sets() {
    for seed in 0..60 {
        let boundary = BOUNDARIES[seed as usize % 2];
        let mut random = Random::new(seed + 100);
        let size = [(); 2].map(|()| 0.1 + 3.0 * f64::from(random.unit()));
        session_of_sample(
            &Options::new(0.08).domain(domain([-1.3, 0.2], [-1.3 + size[0], 0.2 + size[1]], boundary)).seed(seed),
            seed,
            5,
        );
    }
}

/// Darts of any floats, most of which are no points of the lattice.
fn darts(random: &mut Random, domain: &Domain, radius: f64, count: usize) -> Vec<[f32; 2]> {
    let mut positions: Vec<[f32; 2]> = Vec::new();
    for _ in 0..count {
        let at = [0, 1].map(|axis: usize| (domain.min[axis] + domain.extent()[axis] * f64::from(random.unit())) as f32);
        let inside = (0..2).all(|axis| (domain.min[axis]..domain.max[axis]).contains(&f64::from(at[axis])));
        if inside && positions.iter().all(|&other| distance(domain, other, at) >= radius) {
            positions.push(at);
        }
    }
    positions
}

#[test]
fn positions_of_the_caller_stay_as_they_are() {
    let mut random = Random::new(5);
    for boundary in BOUNDARIES {
        for (seed, domain) in (0..).zip([
            domain([0.0; 2], [1.0; 2], boundary),
            domain([-0.1, 0.01], [0.0, 0.13], boundary),
            domain([-1e-3; 2], [1.0 / 3.0, 0.1], boundary),
            domain([0.999_3, 0.999_201], [1.000_700_03, 1.000_703_3], boundary),
        ]) {
            let radius = (domain.extent()[0] / 23.0).max(65.0 * float_spacing(&domain));
            let positions = darts(&mut random, &domain, radius, 400);
            let options = Options::new(radius).domain(domain).seed(seed);
            let set = EditableSet::of(&options, &positions).unwrap();
            assert_eq!((set.samples().positions, set.domain(), set.seed()), (positions.clone(), domain, seed));
            session(&options, || EditableSet::of(&options, &positions).unwrap(), seed, 6);
        }
    }
    // A set of another call, zeros of both signs, and none at all.
    let options = Options::new(0.05).seed(3);
    let context = context();
    let mut positions = maximal::sample(&context, &maximal::Options::new(0.05).seed(9), None).unwrap().positions;
    let mut set = EditableSet::of(&options, &positions).unwrap();
    assert!(set.refill(&context, 1, None).unwrap().is_empty());
    positions.retain(|&at| distance(&options.domain, at, [0.0; 2]) > 0.06);
    positions.push([-0.0, 0.0]);
    session(&options, || EditableSet::of(&options, &positions).unwrap(), 30, 4);
    session(&options, || EditableSet::of(&options, &[]).unwrap(), 31, 4);
}

#[test]
fn redo_repeats_a_stroke_bit_for_bit_and_undo_takes_it_back() {
    let context = Context::new(2).unwrap();
    for boundary in BOUNDARIES {
        let options = Options::new(0.01).domain(domain([0.0; 2], [1.0; 2], boundary));
        let mut set = EditableSet::sample(&context, &options, None).unwrap();
        assert_eq!(set.samples().positions, kdrt::sample(&context, &options, None).unwrap().positions);
        let (before, brush) = (set.samples(), Region::ball([0.02, 0.97, 0.0], 0.1));
        let erased = set.erase(&brush).unwrap();
        let first = set.refill(&context, 7, None).unwrap();
        assert!(erased.len() > 60 && first.len() > 60 && erased.positions != first.positions);

        // Undo, another stroke over the same region, undo, and the first stroke again.
        let undo = |set: &mut EditableSet, added: &Points<2>| {
            set.erase_ids(&added.ids).unwrap();
            set.restore(&erased).unwrap();
            assert_eq!(set.samples(), before);
            assert_eq!(set.erase(&brush).unwrap(), erased);
        };
        undo(&mut set, &first);
        let other = set.refill(&context, 8, None).unwrap();
        assert!(other.positions != first.positions);
        undo(&mut set, &other);
        let redone = set.refill(&context, 7, None).unwrap();
        assert!(redone.positions == first.positions);
        assert!(redone.ids.iter().all(|id| !other.ids.contains(id) && !first.ids.contains(id)));
        assert!(set.refill(&context, 7, None).unwrap().is_empty());
    }
}

#[test]
fn a_cancelled_refill_adds_nothing_and_can_be_repeated() {
    let context = Context::new(2).unwrap();
    let options = Options::new(0.01);
    let mut sets = [(); 2].map(|()| EditableSet::sample(&context, &options, None).unwrap());
    sets.iter_mut().for_each(|set| assert!(set.erase(&Region::EVERYWHERE).unwrap().len() > 6000));
    let stop = |done: f64| if done > 0.5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    assert!(matches!(sets[0].refill(&context, 1, Some(&stop)), Err(Error::Cancelled)));
    assert_eq!((sets[0].len(), sets[0].samples().len()), (0, 0));
    let [one, other] = sets.each_mut().map(|set| set.refill(&context, 1, None).unwrap());
    assert_eq!(one, other, "ids included");
    assert!((6900..7150).contains(&one.len()), "{}", one.len());
}

#[test]
fn what_cannot_be_done_is_refused_and_changes_nothing() {
    let (options, context) = (Options::new(0.1), context());
    let said = |error: Error| error.to_string();
    let refused = |options: &Options, positions: &[[f32; 2]]| said(EditableSet::of(options, positions).err().unwrap());
    let ordered = Options::progressive(0.1, Progressive::new());
    let order = "order: progressive; a set that is edited has samples in any order";
    assert_eq!(refused(&ordered, &[]), order);
    assert_eq!(said(EditableSet::sample(&context, &ordered, None).err().unwrap()), order);
    let classes = Classes::new(2, &[0.1, 0.15, 0.15, 0.2]).unwrap();
    let reason = "classes: 2; a set that is edited has one radius and no classes";
    assert_eq!(refused(&Options::classes(&classes), &[]), reason);
    assert!(refused(&Options::new(f64::NAN), &[]).starts_with("radius: NaN"));
    assert_eq!(refused(&options.leaf_size(9.0), &[]), "leaf_size: 9.0 with positions; it must be 20.0");
    assert!(refused(&options, &[[0.5; 2], [1.5, 0.5]]).starts_with("positions: point 1 is (1.5, 0.5), outside"));
    let near = [[0.95, 0.5], [0.5; 2], [0.03, 0.5]];
    assert_eq!(refused(&options, &near), "positions: [2] is closer to [0] than the radius 0.1");
    let given = options.given(Given::at(&near[..1]));
    assert_eq!(refused(&given, &near[1..]), "positions: [1] is closer to a given sample than its clearance");

    let mut set = EditableSet::sample(&context, &options, None).unwrap();
    let before = set.samples();
    let count = before.len() as u64;
    assert_eq!(said(set.erase_ids(&[1, 2, 1]).unwrap_err()), "ids: 1 is listed twice");
    let reason = format!("ids: [1] is {count}, which no sample of the set has");
    assert_eq!(said(set.erase_ids(&[0, count]).unwrap_err()), reason);
    assert_eq!(said(set.remove_given(&[0]).unwrap_err()), "ids: [0] is 0, which no given sample has");
    assert!(said(set.erase(&Region::ball([0.0; 3], f64::NAN)).unwrap_err()).starts_with("region: radius is NaN"));
    assert!(said(set.add_given(Given::at(&[[f32::NAN; 2]])).unwrap_err()).starts_with("given_positions: [0]"));
    assert_eq!(set.samples(), before);

    assert_eq!(said(set.restore(&before).unwrap_err()), "points: [0] stands already, with the id 0");
    let erased = set.erase_ids(&[3]).unwrap();
    let outside = Points { positions: vec![[1.5; 2]], ..erased.clone() };
    assert!(said(set.restore(&outside).unwrap_err()).starts_with("points: [0] is not a sample of this set"));
    let plain = Points { ids: Vec::new(), ..erased.clone() };
    assert_eq!(said(set.restore(&plain).unwrap_err()), "points: are not samples of a set that is edited");
    let (given, _) = set.add_given(Given::at(&erased.positions)).unwrap();
    assert_eq!(said(set.restore(&erased).unwrap_err()), "points: [0] conflicts with given sample 0");
    set.remove_given(&[given]).unwrap();
    set.restore(&erased).unwrap();
    assert_eq!(set.samples(), before);
    let double = Points { positions: [erased.positions[0]; 2].to_vec(), ids: vec![3, 3], ..Points::default() };
    set.erase_ids(&[3]).unwrap();
    assert_eq!(said(set.restore(&double).unwrap_err()), "points: [1] conflicts with sample 3");
}
