//! Exactly so many samples on a mesh: conflict-free at the radius that is reported, and covered within the bound.

use std::sync::Arc;

use azulejo::mesh::Mesh;
use azulejo::psp::{self, FlatOptions, Options, Report};
use azulejo::{Context, Error, Points};

use crate::common::meshes;
use crate::common::order_oracle;

fn mesh((positions, triangles): meshes::Soup) -> Arc<Mesh> {
    Arc::new(Mesh::new(positions, triangles).unwrap())
}

fn sample_on(threads: usize, mesh: &Arc<Mesh>, options: Options) -> (Points<3>, Report) {
    psp::sample(&Context::new(threads).unwrap(), mesh, &options, None).unwrap()
}

/// Everything that is said of a set of so many samples, and the largest ratio of its covering radius to its radius.
fn check(mesh: &Arc<Mesh>, count: usize, seed: u64, loosest: f64) -> Report {
    let options = Options::by_count(count).seed(seed);
    let (samples, report) = sample_on(1, mesh, options);
    assert_eq!((samples.len(), report.samples, samples.ranks.len()), (count, count as u64, 0));
    let (radius, coverage) = (report.radius, report.covering_radius.unwrap());
    assert!(count == 1 || radius > 0.0 && order_oracle::conflict(&samples, radius).is_none(), "{count}: {radius}");
    assert!(order_oracle::covers(mesh, &samples.positions, coverage), "{count}: {coverage}");
    assert!(coverage <= loosest * radius, "{count}: {}", coverage / radius);
    assert_eq!(report.accepted + report.conflicts + report.restart_conflicts, report.darts + report.hits);
    assert_eq!(samples, sample_on(3, mesh, options).0, "depends on the threads");
    report
}

const COUNTS: [usize; 12] = [1, 2, 3, 4, 5, 7, 10, 33, 100, 321, 1000, 4000];

#[test]
fn any_mesh_has_any_number_of_samples() {
    let part = |i: u32| meshes::placed(meshes::random_soup(u64::from(i), 1), 1e-3, 0.07 * f64::from(i));
    let soups = [
        meshes::plane(),
        meshes::sphere(),
        meshes::fine_torus(200, 100),
        meshes::sheets(0.02),
        meshes::random_soup(3, 12),
        meshes::needles(1e-6),
        meshes::slivers(),
        meshes::placed(meshes::torus(), 1.0, 3000.0),
        // Many tiny parts, alone and beside a large one.
        meshes::join((0..200).map(part)),
        meshes::join((0..200).map(part).chain([meshes::plane()])),
    ];
    for (seed, soup) in (0..).zip(soups) {
        let mesh = mesh(soup);
        COUNTS.into_iter().for_each(|count| _ = check(&mesh, count, seed, 1.1001));
    }
}

#[test]
fn every_small_count_and_many_seeds() {
    let torus = mesh(meshes::torus());
    (1..60).for_each(|count| _ = check(&torus, count, count as u64, 1.1001));
    (0..20).for_each(|seed| _ = check(&torus, 500, seed, 1.1001));
}

#[test]
fn large_counts_are_exact_projected_or_not() {
    let (fine, torus) = (mesh(meshes::fine_torus(400, 200)), mesh(meshes::torus()));
    check(&fine, 54_321, 0, 1.1001);
    let projected = check(&torus, 100_000, 1, 1.1001);
    assert!(projected.iterations == 1 && projected.hits > projected.samples / 2, "{projected:?}");
    assert_eq!(check(&mesh(meshes::fine_torus(600, 300)), 26_000, 2, 1.1001).iterations, 0);
    let context = Context::new(2).unwrap();
    let flat = |iterations| FlatOptions::new(0.0).count(30_000).iterations(iterations).sample(&context, &torus, None);
    let [by_default, darts] = [None, Some(0)].map(|iterations| flat(iterations).unwrap());
    assert_eq!([by_default.1.iterations, darts.1.iterations], [1, 0]);
    assert_eq!((by_default.0.len(), darts.0.len(), darts.1.hits), (30_000, 30_000, 0));
    let options = Options::by_count(30_000);
    assert_eq!(sample_on(1, &torus, options).0, by_default.0);
    assert_eq!(sample_on(1, &torus, options.projected(false)).0, darts.0);
}

#[test]
fn masked_parts_are_as_if_they_were_not_there() {
    let (positions, triangles) = meshes::torus();
    let mask: Vec<bool> = (0..triangles.len()).map(|i| i % 5 < 2).collect();
    let masked = Mesh::new(positions, triangles).unwrap().with_mask(mask.clone()).unwrap();
    let nothing = Arc::new(masked.clone().with_mask(vec![false; mask.len()]).unwrap());
    let masked = Arc::new(masked);
    [3, 200, 2000].into_iter().for_each(|count| _ = check(&masked, count, 4, 1.1001));
    let (samples, _) = sample_on(1, &masked, Options::by_count(2000));
    assert!(samples.triangles.iter().all(|&triangle| mask[triangle as usize]));
    let refused = psp::sample(&Context::new(1).unwrap(), &nothing, &Options::by_count(3), None);
    assert_eq!(refused.unwrap_err().to_string(), "count: 3, but the mesh's mask leaves no surface");
}

#[test]
fn what_cannot_be_had_is_refused() {
    let context = Context::new(1).unwrap();
    let refused = |mesh: &Arc<Mesh>, options: Options| psp::sample(&context, mesh, &options, None).unwrap_err();
    let plane = mesh(meshes::plane());
    let said = |options: Options| refused(&plane, options).to_string();
    assert_eq!(said(Options::by_count(0)), "count: 0 is not at least 1");
    let flat = |options: FlatOptions| options.count(9).sample(&context, &plane, None).unwrap_err().to_string();
    assert_eq!(flat(FlatOptions::new(0.1)), "count: 9 with radius 0.1; give one of the two");
    assert!(flat(FlatOptions::new(f64::NAN)).starts_with("count: "));
    assert_eq!(flat(FlatOptions::new(0.0).iterations(Some(2))), "iterations: 2; count requires iterations = 0");
    assert!(flat(FlatOptions::new(0.0).maximal(false).iterations(Some(0))).starts_with("maximal: "));
    assert!(matches!(refused(&plane, Options::by_count(1 << 40)), Error::TooLarge { .. }));
    // A mesh so far from the origin that floats carry a few hundred samples.
    let far = mesh(meshes::placed(meshes::plane(), 1.0, 16384.0));
    let said = refused(&far, Options::by_count(2000)).to_string();
    assert!(said.starts_with("count: 2000 samples are more than the mesh can carry: "), "{said}");
    check(&far, 50, 0, 1.1001);
}
