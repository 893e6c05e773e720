//! Sets that are edited: strokes of a brush, given samples that come and go, undo and redo, held against the
//! definitions by plain checkers after every refill.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::{self, EditableSet, ProjectionOptions, Psp, RegionOptions};
use azulejo::{Context, Error, Given, Points, Region};

use crate::common::adaptive_oracle::{self as oracle, Ball, Field};
use crate::common::meshes::{self, Soup};
use crate::common::random::Random;
use crate::common::tolerance::tolerance;

fn mesh((positions, triangles): Soup) -> Arc<Mesh> {
    Arc::new(Mesh::new(positions, triangles).unwrap())
}

/// A maximal set to be edited.
fn set(mesh: &Arc<Mesh>, options: &ProjectionOptions) -> EditableSet {
    let mut psp = Psp::new(mesh, options).unwrap();
    psp.fill(&Context::new(1).unwrap(), None).unwrap();
    psp.into_editable()
}

/// The fault in a set that should be maximal around given balls, if there is one.
fn fault(mesh: &Mesh, samples: &Points<3>, radius: f64, cosine: f64, balls: &[Ball]) -> Option<String> {
    let radii = vec![radius; samples.len()];
    let conflict = oracle::conflict(samples, &radii, cosine).map(|pair| format!("conflict of {pair:?}"));
    let near = oracle::too_near(samples, balls).map(|index| format!("{index} is too near to a given sample"));
    let at = |_: [f64; 3]| radius;
    let field = Field::Function(&at, 0.0);
    let gap = oracle::gap_around(mesh, &field, samples, &radii, cosine, tolerance(mesh), balls);
    conflict.or(near).or(gap.map(|gap| format!("gap at {gap:?}")))
}

/// Each sample by its id, as bits.
fn by_id(samples: &Points<3>) -> BTreeMap<u64, (u32, [u32; 5])> {
    let row = |i: usize| {
        let ([x, y, z], [u, v]) = (samples.positions[i], samples.barycentrics[i]);
        (samples.ids[i], (samples.triangles[i], [x, y, z, u, v].map(f32::to_bits)))
    };
    (0..samples.len()).map(row).collect()
}

/// The samples without their ids.
fn places(samples: &Points<3>) -> Vec<(u32, [u32; 5])> {
    let mut places: Vec<_> = by_id(samples).into_values().collect();
    places.sort_unstable();
    places
}

fn region(random: &mut Random, at: [f32; 3], radius: f64) -> Region {
    let size = radius * f64::from(1.0 + 6.0 * random.unit());
    let [low, high] = [-1.0, 1.0].map(|side| at.map(|x| f64::from(x) + side * size));
    match (3.0 * random.unit()) as u32 {
        0 => Region::ball(at.map(f64::from), size),
        1 => Region::cuboid(low, high),
        _ => Region { max: [f64::INFINITY; 3], ..Region { radius: size, ..Region::ball(at.map(f64::from), size) } },
    }
}

/// A session of random edits on 1 and on 3 threads. After each refill the set is maximal around what is given, and all
/// that was not erased is as it was, with its id.
fn session(mesh: &Arc<Mesh>, options: &ProjectionOptions, seed: u64, steps: usize) {
    let &ProjectionOptions { radius, cosine, .. } = options;
    let mut sets = [(); 2].map(|()| set(mesh, options));
    let contexts = [1, 3].map(|threads| Context::new(threads).unwrap());
    let (mut random, mut given) = (Random::new(seed), BTreeMap::<u64, Ball>::new());
    for (id, &position) in (0..).zip(options.given.positions) {
        given.insert(id, (position.map(f64::from), options.given.clearance(id as usize, radius)));
    }
    let mut known = by_id(&sets[0].samples());
    let mut next = known.len() as u64;
    for step in 0..steps {
        for _ in 0..=(2.0 * random.unit()) as usize {
            let current = sets[0].samples();
            let pick = |random: &mut Random| (random.unit() * current.len() as f32) as usize % current.len().max(1);
            let mut erased = Vec::new();
            match (4.0 * random.unit()) as u32 {
                0 => {
                    let at = current.positions[pick(&mut random)];
                    let region = region(&mut random, at, radius);
                    erased = sets.each_mut().map(|set| set.erase(&region).unwrap()).to_vec();
                    let inside = current.positions.iter().filter(|&&position| region.contains(position)).count();
                    assert!(erased[0].len() == inside && inside > 0);
                }
                1 => {
                    let mut ids: Vec<u64> = (0..5).map(|_| current.ids[pick(&mut random)]).collect();
                    ids.sort_unstable();
                    ids.dedup();
                    erased = sets.each_mut().map(|set| set.erase_ids(&ids).unwrap()).to_vec();
                    assert_eq!(erased[0].ids, ids);
                }
                2 => {
                    let position = current.positions[pick(&mut random)].map(|x| x + 0.3 * radius as f32);
                    let clearance = radius * f64::from(3.0 * random.unit());
                    let added =
                        Given::with_clearances(std::slice::from_ref(&position), std::slice::from_ref(&clearance));
                    let results = sets.each_mut().map(|set| set.add_given(added).unwrap());
                    assert_eq!(results[0].0, results[1].0);
                    assert!(given.insert(results[0].0, (position.map(f64::from), clearance)).is_none());
                    erased = results.map(|(_, erased)| erased).to_vec();
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
        let refilled = [0, 1].map(|i| sets[i].refill(&contexts[i], step as u64, None).unwrap());
        assert_eq!(refilled[0].0, refilled[1].0, "depends on the number of threads");
        let (added, report) = &refilled[0];
        for (id, sample) in by_id(added) {
            assert!(id >= next && known.insert(id, sample).is_none());
        }
        next += added.len() as u64;
        let samples = sets[0].samples();
        assert_eq!(by_id(&samples), known, "what stands stays as it is");
        assert_eq!((report.samples, report.accepted), (samples.len() as u64, added.len() as u64));
        assert_eq!(report.darts, report.accepted + report.conflicts);
        let balls: Vec<Ball> = given.values().copied().collect();
        assert_eq!(fault(mesh, &samples, radius, cosine, &balls), None, "step {step}");
    }
}

#[test]
fn every_refill_makes_the_set_maximal_and_leaves_the_rest_alone() {
    let around: Vec<[f32; 3]> = (0..20).map(|i| [1.0 + 0.02 * i as f32, 0.1, 0.05]).collect();
    let clearances: Vec<f64> = (0..20).map(|i| 0.02 * f64::from(i)).collect();
    let options = ProjectionOptions::new(0.1).seed(4);
    session(&mesh(meshes::torus()), &options, 1, 12);
    session(&mesh(meshes::torus()), &options.given(Given::with_clearances(&around, &clearances)), 2, 12);
    // A plane of two triangles, which are cut into pieces; needles; a soup; walls of which each side counts alone.
    session(&mesh(meshes::plane()), &ProjectionOptions::new(0.03), 3, 10);
    session(&mesh(meshes::needles(1e-5)), &ProjectionOptions::new(0.02), 4, 6);
    session(&mesh(meshes::random_soup(5, 60)), &ProjectionOptions::new(0.05), 5, 8);
    session(&mesh(meshes::sheets(0.01)), &ProjectionOptions::new(0.05).cosine(0.0), 6, 8);
    session(&mesh(meshes::placed(meshes::torus(), 1e-3, 7.0)), &ProjectionOptions::new(2e-4), 7, 6);
    // Triangles far smaller than the radius, of which a stroke touches few: its samples covered others beside it.
    let fine = mesh(meshes::fine_torus(120, 60));
    (9..17).for_each(|seed| session(&fine, &ProjectionOptions::new(0.2), seed, 12));
}

#[test]
fn a_large_set_is_edited_by_cubes() {
    session(&mesh(meshes::fine_torus(200, 100)), &ProjectionOptions::new(0.015), 8, 4);
}

#[test]
fn redo_repeats_a_stroke_bit_for_bit_and_undo_takes_it_back() {
    let (mesh, context) = (mesh(meshes::torus()), Context::new(2).unwrap());
    let mut set = set(&mesh, &ProjectionOptions::new(0.05));
    let (before, brush) = (set.samples(), Region::ball([1.0, 0.0, 0.4], 0.35));
    let erased = set.erase(&brush).unwrap();
    let (first, _) = set.refill(&context, 7, None).unwrap();
    assert!(erased.len() > 40 && first.len() > 40 && places(&erased) != places(&first));

    // Undo, another stroke over the same region, undo, and the first stroke again.
    let undo = |set: &mut EditableSet, added: &Points<3>| {
        set.erase_ids(&added.ids).unwrap();
        set.restore(&erased).unwrap();
        assert_eq!(set.samples(), before);
        assert_eq!(set.erase(&brush).unwrap(), erased);
    };
    undo(&mut set, &first);
    let (other, _) = set.refill(&context, 8, None).unwrap();
    assert!(places(&other) != places(&first));
    undo(&mut set, &other);
    let (redone, _) = set.refill(&context, 7, None).unwrap();
    assert!(places(&redone) == places(&first));
    assert!(redone.ids.iter().all(|id| !other.ids.contains(id) && !first.ids.contains(id)));
    let (nothing, _) = set.refill(&context, 7, None).unwrap();
    assert!(nothing.is_empty());
}

#[test]
fn a_set_that_is_not_full_is_filled_by_the_first_refill() {
    let (mesh, context) = (mesh(meshes::torus()), Context::new(1).unwrap());
    let mut set = Psp::new(&mesh, &ProjectionOptions::new(0.1)).unwrap().into_editable();
    assert!(set.is_empty() && set.samples().is_empty());
    set.refill(&context, 1, None).unwrap();
    assert!(set.len() > 300);
    assert_eq!(fault(&mesh, &set.samples(), 0.1, -1.0, &[]), None);
    let (added, _) = set.refill(&context, 2, None).unwrap();
    assert!(added.is_empty(), "nothing was erased");
}

#[test]
fn a_cancelled_refill_adds_nothing_and_can_be_repeated() {
    let (mesh, context) = (mesh(meshes::torus()), Context::new(2).unwrap());
    let mut sets = [(); 2].map(|()| set(&mesh, &ProjectionOptions::new(0.03)));
    sets.iter_mut().for_each(|set| assert!(set.erase(&Region::EVERYWHERE).unwrap().len() > 3000));
    let stop = |_: f64| ControlFlow::Break(());
    assert!(matches!(sets[0].refill(&context, 1, Some(&stop)), Err(Error::Cancelled)));
    assert_eq!((sets[0].len(), sets[0].samples().len()), (0, 0));
    let [one, other] = sets.each_mut().map(|set| set.refill(&context, 1, None).unwrap().0);
    assert_eq!(one, other, "ids included");
}

#[test]
fn what_cannot_be_done_is_refused_and_changes_nothing() {
    let mesh = mesh(meshes::torus());
    let mut set = set(&mesh, &ProjectionOptions::new(0.1));
    let before = set.samples();
    let said = |error: Error| error.to_string();
    let count = before.len() as u64;
    assert_eq!(said(set.erase_ids(&[1, 2, 1]).unwrap_err()), "ids: 1 is listed twice");
    let reason = format!("ids: [1] is {count}, which no sample of the set has");
    assert_eq!(said(set.erase_ids(&[0, count]).unwrap_err()), reason);
    assert_eq!(said(set.remove_given(&[0]).unwrap_err()), "ids: [0] is 0, which no given sample has");
    assert!(said(set.erase(&Region::ball([0.0; 3], f64::NAN)).unwrap_err()).starts_with("region: radius is NaN"));
    let nowhere = [[f32::NAN; 3]];
    assert!(said(set.add_given(Given::at(&nowhere)).unwrap_err()).starts_with("given_positions: [0]"));
    assert_eq!(set.samples(), before);

    // What stands is not put back a second time; nor is what a sample or a given one keeps out.
    assert_eq!(said(set.restore(&before).unwrap_err()), "points: [0] stands already, with the id 0");
    let erased = set.erase_ids(&[3]).unwrap();
    let mut moved = erased.clone();
    moved.positions[0][0] += 0.5;
    assert!(said(set.restore(&moved).unwrap_err()).starts_with("points: [0] is not a sample of this set"));
    let plain = Points { ids: Vec::new(), ..erased.clone() };
    assert_eq!(said(set.restore(&plain).unwrap_err()), "points: are not samples of a set that is edited");
    let (given, _) = set.add_given(Given::at(&erased.positions)).unwrap();
    assert_eq!(said(set.restore(&erased).unwrap_err()), "points: [0] conflicts with given sample 0");
    set.remove_given(&[given]).unwrap();
    set.restore(&erased).unwrap();
    assert_eq!(set.samples(), before);
    assert_eq!(said(set.restore(&erased).unwrap_err()), "points: [0] stands already, with the id 3");
    let fourth = set.erase_ids(&[4]).unwrap();
    let other = Points { ids: vec![3], ..fourth.clone() };
    assert_eq!(said(set.restore(&other).unwrap_err()), "points: [0] stands already, with the id 3");
    let twice = [0, 0];
    let double = Points {
        positions: twice.map(|i| fourth.positions[i]).to_vec(),
        triangles: twice.map(|i| fourth.triangles[i]).to_vec(),
        barycentrics: twice.map(|i| fourth.barycentrics[i]).to_vec(),
        ids: vec![4, 4],
        ..Points::default()
    };
    assert_eq!(said(set.restore(&double).unwrap_err()), "points: [1] conflicts with sample 4");
}

/// Each place in the region is covered, nothing far outside is touched, and the result is the same for any threads.
#[test]
fn a_region_is_sampled_alone() {
    let around: Vec<[f32; 3]> = (0..40).map(|i| [0.9 + 0.02 * i as f32, 0.1, 0.35]).collect();
    let clearances: Vec<f64> = (0..40).map(|i| 0.003 * f64::from(i)).collect();
    let given = Given::with_clearances(&around, &clearances);
    let balls: Vec<Ball> = std::iter::zip(&around, &clearances).map(|(p, &c)| (p.map(f64::from), c)).collect();
    for (soup, radius) in [(meshes::fine_torus(200, 100), 0.02), (meshes::torus(), 0.05), (meshes::plane(), 0.03)] {
        let mesh = mesh(soup);
        let region = Region { min: [f64::NEG_INFINITY, 0.0, f64::NEG_INFINITY], ..Region::ball([1.0, 0.1, 0.3], 0.5) };
        let options = RegionOptions::new(radius).seed(3).given(given);
        let [(samples, report), (again, _)] = [1, 3].map(|threads| {
            psp::sample_region(&Context::new(threads).unwrap(), &mesh, &region, &options, None).unwrap()
        });
        assert_eq!(samples, again, "depends on the number of threads");
        assert!(samples.len() > 50 && samples.ids.is_empty() && report.samples == samples.len() as u64);
        let radii = vec![radius; samples.len()];
        assert_eq!(oracle::conflict(&samples, &radii, -1.0), None);
        assert_eq!(oracle::too_near(&samples, &balls), None);
        let near = Region { min: region.min.map(|x| x - 6.0 * radius), radius: 0.5 + 6.0 * radius, ..region };
        assert!(samples.positions.iter().all(|&position| near.contains(position)));
        // Places of the region, held against all samples and given ones.
        let (mut random, mut inside) = (Random::new(9), 0);
        for _ in 0..20_000 {
            let triangle = (random.unit() * mesh.triangles().len() as f32) as u32;
            let (u, v) = (random.unit(), random.unit());
            let place = mesh.point(triangle, if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] });
            if region.contains(place) {
                let within = |position: &[f32; 3], reach: f64| {
                    (0..3).map(|i| (f64::from(position[i]) - f64::from(place[i])).powi(2)).sum::<f64>().sqrt() <= reach
                };
                let tolerance = tolerance(&mesh);
                let own = samples.positions.iter().any(|position| within(position, radius + tolerance));
                let given = std::iter::zip(&around, &clearances).any(|(position, &reach)| within(position, reach));
                assert!(own || given, "{place:?}");
                inside += 1;
            }
        }
        assert!(inside > 300, "{inside}");
    }
    let mesh = mesh(meshes::torus());
    let refused = |region: Region, options: RegionOptions| {
        psp::sample_region(&Context::new(1).unwrap(), &mesh, &region, &options, None).unwrap_err().to_string()
    };
    assert!(refused(Region::ball([0.0; 3], -1.0), RegionOptions::new(0.1)).starts_with("region: radius is -1.0"));
    assert!(refused(Region::EVERYWHERE, RegionOptions::new(0.0)).starts_with("radius: 0"));
    assert!(refused(Region::EVERYWHERE, RegionOptions::new(0.1).cosine(2.0)).starts_with("cosine: 2"));
}
