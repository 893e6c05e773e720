//! The engines against each other: rays in packets of all widths, and the rasteriser, on hostile meshes, to the bit.

use std::collections::HashSet;
use std::sync::Arc;

use glam::DVec3;

use crate::job::Context;
use crate::mesh::{Mesh, exact};
use crate::psp::fill::Measures;
use crate::psp::given::GivenSamples;
use crate::psp::options::ProjectionOptions;
use crate::psp::project::local::tests::{cases, mesh};
use crate::psp::project::local::{LocalProjection, Pass, Projected, Torus, TraceSpace};
use crate::psp::project::tests::meshes;
use crate::psp::set::SampleSet;

/// The meshes of the other tests, and worse.
fn hostile() -> Vec<(&'static str, Arc<Mesh>, f64)> {
    let mut all = cases();
    let masked = mesh(meshes::fine_torus(200, 80));
    let mask = (0..masked.triangles().len()).map(|i| i % 3 != 0).collect();
    let (positions, triangles) = meshes::sphere();
    let steps = positions.into_iter().map(|[x, y, z]| [x, y, 0.01 * z]).collect();
    all.extend([
        ("masked", Arc::new(Mesh::clone(&masked).with_mask(mask).unwrap()), 0.02),
        ("very thin needles", mesh(meshes::needles(1e-5)), 1e-4),
        ("invisible needles", mesh(meshes::needles(1e-6)), 1e-4),
        ("flat", mesh((steps, triangles)), 0.02),
        ("many random triangles", mesh(meshes::random_soup(7, 2000)), 0.1),
        ("duplicates of random triangles", mesh(meshes::duplicated(meshes::random_soup(8, 30))), 0.04),
        ("tiny and far from the origin", mesh(meshes::placed(meshes::random_soup(9, 60), 1e-4, 1.0)), 4e-6),
        ("tiny", mesh(meshes::placed(meshes::slivers(), 1e-30, 0.0)), 1e-32),
        ("triangles far below the radius", mesh(meshes::fine_torus(200, 100)), 0.2),
        ("sheets nearer than the tolerance", mesh(meshes::sheets(1e-7)), 0.02),
        ("sheets at a float spacing", mesh(meshes::placed(meshes::sheets(1e-7), 1.0, 1.0)), 0.02),
    ]);
    all
}

/// The samples of an iteration by rays in packets of this width, or by the rasteriser, and the counts.
fn iterate(mesh: &Mesh, options: &ProjectionOptions<'static>, width: Option<usize>) -> (Vec<[u32; 6]>, Projected) {
    let mut samples = SampleSet::new(mesh, options.radius);
    let (measures, given) = (&Measures::of(mesh), &GivenSamples::none(mesh));
    let projected = Context::new(1).unwrap().run(None, |job| {
        let space = width.map(|width| TraceSpace::with_packets(job, mesh, width).map(Arc::new)).transpose()?;
        let pass = Pass { mesh, measures, given, options, iteration: 0 };
        LocalProjection { tori: Torus::kept(job)?, space }.advance(job, &pass, &mut samples)
    });
    let bits = samples.all().iter().map(|sample| {
        let ([x, y, z], [u, v]) = (sample.position.map(f32::to_bits), sample.barycentrics.map(f32::to_bits));
        [x, y, z, u, v, sample.triangle]
    });
    (bits.collect(), projected.unwrap())
}

/// The number of hits that only one of two engines has, and the largest distance of one from the edges of its triangle, in
/// diagonals of the mesh's box.
fn lost(mesh: &Mesh, one: &[[u32; 6]], other: &[[u32; 6]]) -> (usize, f64) {
    let [one, other] = [one, other].map(|set| set.iter().copied().collect::<HashSet<_>>());
    let (low, high) = mesh.bounds();
    let depth = |&[.., u, v, triangle]: &[u32; 6]| {
        let [a, b, c] = mesh.exact_corners(triangle);
        let [u, v] = [u, v].map(|x| f64::from(f32::from_bits(x)));
        let twice = (b - a).cross(c - a).length();
        let height = |share: f64, from: DVec3, to: DVec3| share * twice / from.distance(to);
        height(u, a, c).min(height(v, a, b)).min(height(1.0 - u - v, b, c)) / exact(low).distance(exact(high))
    };
    let depths: Vec<f64> = one.symmetric_difference(&other).map(depth).collect();
    (depths.len(), depths.into_iter().fold(0.0, f64::max))
}

/// Sets of hostile meshes by all engines, until so many rays were traced in packets of each width.
fn compare_engines(rays: u64) {
    let (mut traced, hostile, mut differ) = (0, hostile(), Vec::new());
    for seed in 0.. {
        for (name, mesh, radius) in &hostile {
            let radius = radius * [1.0, 0.6, 1.7][seed as usize % 3];
            let options = ProjectionOptions::new(radius).seed(seed);
            let (drawn, by_drawing) = iterate(mesh, &options, None);
            for width in [1, 4, 8, 16] {
                let (samples, by_rays) = iterate(mesh, &options, Some(width));
                let counts = |projected: &Projected| [projected.hits, projected.restart_conflicts];
                if samples != drawn || counts(&by_rays) != counts(&by_drawing) {
                    let (lost, depth) = lost(mesh, &samples, &drawn);
                    differ
                        .push(format!("{name}, seed {seed}, packets of {width}: {lost} of {}, {depth:e}", drawn.len()));
                }
                traced += by_rays.rays;
            }
        }
        if traced >= 4 * rays {
            break;
        }
    }
    assert!(differ.is_empty(), "{differ:#?}");
}

#[test]
#[cfg_attr(not(feature = "embree"), ignore = "one of them is Embree")]
fn packets_of_all_widths_give_the_bits_of_the_rasteriser() {
    compare_engines(100_000);
}

#[test]
#[ignore = "takes a minute: ten million rays in packets of each width"]
fn ten_million_rays_give_the_bits_of_the_rasteriser() {
    compare_engines(10_000_000);
}
