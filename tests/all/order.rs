//! Sets of meshes in progressive order: every prefix is well spread, and sets of fewer samples are prefixes.

use std::sync::Arc;

use azulejo::analysis::spectrum::{Periodogram, periodogram};
use azulejo::mesh::Mesh;
use azulejo::psp::{self, FlatOptions, Options, Report};
use azulejo::{Boundary, Context, Domain, Order, Points};

use crate::common::meshes;
use crate::common::order_oracle::{conflict, covers, disorder};
use crate::common::random;
use crate::common::triangle::distance;

const QUOTIENT: f64 = 1.090_507_732_665_257_7;

fn mesh((positions, triangles): meshes::Soup) -> Arc<Mesh> {
    Arc::new(Mesh::new(positions, triangles).unwrap())
}

fn sample_on(threads: usize, mesh: &Arc<Mesh>, options: Options) -> (Points<3>, Report) {
    psp::sample(&Context::new(threads).unwrap(), mesh, &options, None).unwrap()
}

fn progressive(radius: f64) -> Options<'static> {
    Options::new(radius).order(Order::Progressive)
}

fn of_count(count: usize) -> Options<'static> {
    Options::by_count(count).order(Order::Progressive)
}

/// The first few counts, those where the levels begin to be close, and some more up to the last.
fn prefixes(count: usize, seed: u64) -> Vec<usize> {
    let mut random = random::Random::new(seed);
    let some = (0..12).map(|_| 1 + (f64::from(random.unit()) * count as f64) as usize);
    (1..8).chain([98, 100, 104, 112, 120]).chain(some).chain([count]).collect()
}

fn check(mesh: &Arc<Mesh>, radius: f64, quotient: f64, seed: u64) {
    let options = progressive(radius).quotient(quotient).seed(seed);
    let (samples, report) = sample_on(1, mesh, options);
    assert_eq!(samples, sample_on(3, mesh, options).0, "depends on the threads");
    assert_eq!(disorder(mesh, &samples, quotient, &prefixes(samples.len(), seed)), None);
    // The whole is a maximal set of the radius.
    let last = f64::from(*samples.ranks.last().unwrap());
    assert!(last >= radius * (1.0 - 1e-7), "{last}");
    assert!(covers(mesh, &samples.positions, radius));
    assert_eq!((report.radius, report.covering_radius, report.samples), (radius, Some(radius), samples.len() as u64));
    assert_eq!(report.accepted + report.conflicts, report.darts);
}

#[test]
fn every_prefix_is_well_spread_on_any_mesh() {
    for seed in 0..2 {
        check(&mesh(meshes::plane()), 0.04, QUOTIENT, seed);
        check(&mesh(meshes::sphere()), 0.15, QUOTIENT, seed);
        check(&mesh(meshes::fine_torus(200, 100)), 0.1, QUOTIENT, seed);
        check(&mesh(meshes::sheets(0.02)), 0.05, QUOTIENT, seed);
        check(&mesh(meshes::random_soup(seed, 12)), 0.08, QUOTIENT, seed);
        check(&mesh(meshes::needles(1e-6)), 0.01, QUOTIENT, seed);
        check(&mesh(meshes::slivers()), 0.02, QUOTIENT, seed);
        check(&mesh(meshes::placed(meshes::torus(), 1.0, 3000.0)), 0.1, QUOTIENT, seed);
        // Beside a large part many tiny ones.
        let part = |i: u32| meshes::placed(meshes::random_soup(u64::from(i), 1), 1e-3, 0.07 * f64::from(i));
        check(&mesh(meshes::join((0..40).map(part).chain([meshes::plane()]))), 0.05, QUOTIENT, seed);
    }
}

#[test]
fn every_quotient_keeps_its_promise() {
    let torus = mesh(meshes::torus());
    for quotient in [1.02, 1.2, 1.5] {
        check(&torus, 0.12, quotient, 7);
    }
}

#[test]
fn masked_parts_are_as_if_they_were_not_there() {
    let (positions, triangles) = meshes::torus();
    let mask: Vec<bool> = (0..triangles.len()).map(|i| i % 5 < 2).collect();
    let kept = triangles.iter().zip(&mask).filter(|(_, kept)| **kept).map(|(triangle, _)| *triangle).collect();
    let masked = Arc::new(Mesh::new(positions.clone(), triangles).unwrap().with_mask(mask.clone()).unwrap());
    check(&masked, 0.1, QUOTIENT, 1);
    let [a, b] = [masked.clone(), mesh((positions, kept))].map(|mesh| sample_on(1, &mesh, progressive(0.1)).0);
    assert_eq!((a.positions, a.ranks), (b.positions, b.ranks));
    let nothing = Arc::new((*masked).clone().with_mask(vec![false; mask.len()]).unwrap());
    assert_eq!(sample_on(1, &nothing, progressive(0.1)).0.len(), 0);
}

fn is_prefix(short: &Points<3>, long: &Points<3>) -> bool {
    long.positions.starts_with(&short.positions)
        && long.ranks.starts_with(&short.ranks)
        && long.triangles.starts_with(&short.triangles)
        && long.barycentrics.starts_with(&short.barycentrics)
        && long.normals.starts_with(&short.normals)
}

#[test]
fn sets_of_fewer_samples_are_prefixes() {
    for mesh in [mesh(meshes::torus()), mesh(meshes::random_soup(5, 9)), mesh(meshes::plane())] {
        let (long, report) = sample_on(1, &mesh, of_count(3000).seed(3));
        assert_eq!((long.len(), report.samples), (3000, 3000));
        assert_eq!(report.radius, f64::from(long.ranks[2999]));
        assert!(report.covering_radius.unwrap() <= QUOTIENT * report.radius * (1.0 + 1e-7));
        assert_eq!(disorder(&mesh, &long, QUOTIENT, &prefixes(3000, 3)), None);
        for count in [1, 2, 3, 10, 100, 777, 2999] {
            let (short, report) = sample_on(1, &mesh, of_count(count).seed(3));
            assert!(short.len() == count && is_prefix(&short, &long), "{count}");
            let ratio = if count < Order::FIRST_COUNT { 2.0 } else { QUOTIENT };
            assert!(report.covering_radius.unwrap() <= ratio * report.radius * (1.0 + 1e-7), "{report:?}");
        }
        // Of two radii, the levels above both are shared; those of few samples are twice as long as the next.
        for (radii, above) in [([0.08, 0.11], 2.0), ([0.04, 0.055], QUOTIENT)] {
            let [fine, coarse] = radii.map(|radius| sample_on(1, &mesh, progressive(radius).seed(3)).0);
            let shared = fine.ranks.iter().take_while(|&&rank| f64::from(rank) >= radii[1] * above).count();
            assert!(shared > 2 && fine.positions[..shared] == coarse.positions[..shared]);
            assert!(
                fine.positions[..shared] == long.positions[..shared] && fine.ranks[..shared] == long.ranks[..shared]
            );
        }
    }
}

/// So many samples that cubes of space are filled by themselves.
#[test]
fn large_sets_nest_and_are_spread_as_well() {
    let mesh = mesh(meshes::torus());
    let [long, short] = [60_000, 33_333].map(|count| sample_on(2, &mesh, of_count(count)).0);
    assert!(long.len() == 60_000 && short.len() == 33_333 && is_prefix(&short, &long));
    assert!(long.ranks.is_sorted_by(|a, b| a >= b));
    assert_eq!(long, sample_on(1, &mesh, of_count(60_000)).0);
    for prefix in [20_000, 28_000, 47_000, 60_000] {
        let (positions, rank) = (&long.positions[..prefix], f64::from(long.ranks[prefix - 1]));
        let samples = Points { positions: positions.to_vec(), ..Points::<3>::default() };
        assert_eq!(conflict(&samples, rank), None);
        assert!(covers(&mesh, positions, QUOTIENT * rank), "{prefix}");
    }
}

#[test]
fn the_oracle_notices_ranks_that_are_swapped_and_samples_that_are_missing() {
    let mesh = mesh(meshes::torus());
    let (samples, _) = sample_on(1, &mesh, progressive(0.1));
    let all: Vec<usize> = (1..200).collect();
    let disorder = |samples: &Points<3>| disorder(&mesh, samples, QUOTIENT, &all);
    assert_eq!(disorder(&samples), None);
    let mut swapped = samples.clone();
    swapped.ranks.swap(40, 90);
    assert!(disorder(&swapped).is_some());
    let mut raised = samples.clone();
    let nearest = (0..50).map(|i| distance(samples.positions[i], samples.positions[50])).fold(f64::INFINITY, f64::min);
    raised.ranks[50] = (nearest as f32).next_up();
    assert!(disorder(&raised).is_some());
    let mut lacking = samples.clone();
    lacking.positions.remove(20);
    lacking.ranks.remove(20);
    assert!(disorder(&lacking).is_some());
    let mut turned = samples;
    turned.positions.swap(10, 150);
    assert!(disorder(&turned).is_some());
}

#[test]
fn what_does_not_go_with_the_order_is_refused() {
    let mesh = mesh(meshes::plane());
    let said = |options: Options| {
        let refused = psp::sample(&Context::new(1).unwrap(), &mesh, &options, None);
        refused.unwrap_err().to_string()
    };
    let flat = |options: FlatOptions| {
        let refused = options.order(Order::Progressive).sample(&Context::new(1).unwrap(), &mesh, None);
        refused.unwrap_err().to_string()
    };
    let options = FlatOptions::new(0.1);
    assert_eq!(flat(options.iterations(Some(1))), "iterations: 1; progressive order requires iterations = 0");
    assert!(flat(options.maximal(false).iterations(Some(0))).starts_with("maximal: "));
    for quotient in [1.0, 1.019, 1.51, f64::NAN] {
        assert!(said(progressive(0.1).quotient(quotient)).starts_with("quotient: "), "{quotient}");
    }
    assert!(said(progressive(0.0)).starts_with("radius: "));
    assert!(said(progressive(1e-9)).starts_with("radius: "));
}

/// The samples of a square mesh by their spectra. Levels that add few samples to one had 3 to 4 decibels.
#[test]
fn prefixes_have_no_preferred_directions() {
    let (square, context) = (mesh(meshes::plane()), Context::new(1).unwrap());
    let sets: Vec<_> = (0..8).map(|seed| sample_on(1, &square, of_count(480).seed(seed)).0).collect();
    for count in [240, 480] {
        let size = 2 * (2.1 * (count as f64).sqrt()) as usize + 1;
        let spectrum = |set: &Points<3>| {
            let flat: Vec<_> = set.positions[..count].iter().map(|&[x, y, _]| [x, y]).collect();
            periodogram(&context, &Domain::unit(Boundary::Bounded), &flat, size, None).unwrap()
        };
        let mean = Periodogram::mean(&sets.iter().map(spectrum).collect::<Vec<_>>()).unwrap();
        let contrast = mean.contrast(mean.frequency_step()[0], 0.5..2.0).unwrap();
        let anisotropy = 10.0 * (contrast * sets.len() as f64).log10();
        assert!(anisotropy.abs() < 1.2, "{anisotropy:+.2} dB: {count} samples");
    }
}
