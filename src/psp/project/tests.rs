//! The two engines against each other.

use std::collections::HashMap;

use glam::{DVec2, DVec3};

use crate::job::Context;
use crate::mesh::{Mesh, exact};
use crate::psp::options::{Engine, Priority, ProjectionOptions};
use crate::psp::project::candidates::Collector;
use crate::psp::project::global::GlobalProjection;
use crate::psp::project::projector::{Projector, frame};
use crate::psp::set::{Sample, SampleSet};

#[path = "../../../tests/all/common/meshes.rs"]
#[allow(dead_code)]
pub mod meshes;

/// The largest distance by which rounding may move a point against an edge, in diagonals of the mesh.
const ROUNDING: f64 = 2e-7;

/// All hits of an iteration with an engine, by projector and triangle.
fn hits(
    engine: Engine,
    mesh: &Mesh,
    radius: f64,
    projectors: &[Projector; 3],
    threads: usize,
) -> HashMap<(u32, u32), Vec<Sample>> {
    let options = ProjectionOptions::new(radius).engine(engine);
    let samples = &SampleSet::new(mesh, radius);
    let collector = Collector { mesh, samples, priority: Priority::Projector, projectors };
    let found = Context::new(threads)
        .unwrap()
        .run(None, |job| GlobalProjection::new(job, mesh, &options)?.project(job, projectors, &collector));
    let (candidates, counts) = found.unwrap();
    let mut all: HashMap<_, Vec<_>> = HashMap::new();
    for candidate in (0..candidates.len()).flat_map(|group| candidates.items(group)) {
        all.entry((candidate.rank, candidate.sample.triangle)).or_default().push(candidate.sample);
    }
    assert_eq!(all.values().map(Vec::len).sum::<usize>() as u64, counts.hits);
    all
}

/// A sample as its projector sees it.
fn seen(mesh: &Mesh, projector: &Projector, sample: &Sample) -> DVec2 {
    flat(projector, mesh.point_exact(sample.triangle, sample.barycentrics.map(f64::from)))
}

fn flat(projector: &Projector, place: DVec3) -> DVec2 {
    DVec2::new(projector.right.dot(place), projector.up.dot(place))
}

/// The longest edge of a triangle as its projector sees it, and the height above it.
fn size(mesh: &Mesh, projector: &Projector, triangle: u32) -> [f64; 2] {
    let [a, b, c] = mesh.corners(triangle).map(|corner| flat(projector, exact(corner)));
    let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
    [longest, (b - a).perp_dot(c - a).abs() / longest]
}

/// The distance of a sample from the boundary of its triangle, as its projector sees both.
fn depth(mesh: &Mesh, projector: &Projector, sample: &Sample) -> f64 {
    let corners = mesh.corners(sample.triangle).map(|corner| flat(projector, exact(corner)));
    let place = seen(mesh, projector, sample);
    let to_edge = |i: usize| {
        let (from, along) = (corners[i], corners[(i + 1) % 3] - corners[i]);
        let share = ((place - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        place.distance(from + share * along)
    };
    to_edge(0).min(to_edge(1)).min(to_edge(2))
}

/// The results of two engines on a mesh.
#[derive(Debug, Default)]
struct Comparison {
    /// Hits that both have, and hits that only one has.
    common: usize,
    alone: usize,
    /// The largest difference of their barycentrics, times the least height of the triangle; in diagonals, as the
    /// projectors see them.
    apart: f64,
    /// The largest distance from the boundary of its triangle of a hit that only one has; in diagonals, as the
    /// projectors see them.
    deep: f64,
}

/// Compares the engines on a mesh.
fn compare(mesh: &Mesh, radius: f64, seed: u64) -> Comparison {
    let (low, high) = mesh.bounds();
    let diagonal = exact(low).distance(exact(high));
    let projectors = Projector::all(frame(seed, 0, None), seed, 0);
    let [rays, raster] = [Engine::Embree, Engine::Rasteriser].map(|engine| hits(engine, mesh, radius, &projectors, 2));
    let mut result = Comparison::default();
    for (one, other, share) in [(&rays, &raster, 1), (&raster, &rays, 0)] {
        for (&(number, triangle), samples) in one {
            let projector = &projectors[number as usize];
            let [longest, height] = size(mesh, projector, triangle);
            for sample in samples {
                let place = seen(mesh, projector, sample);
                let others = other.get(&(number, triangle)).into_iter().flatten();
                let nearest =
                    others.map(|other| place.distance(seen(mesh, projector, other))).fold(f64::INFINITY, f64::min);
                // Rays are a radius apart.
                if nearest < 0.5 * radius {
                    result.common += share;
                    result.apart = result.apart.max(nearest / longest * height / diagonal);
                } else {
                    result.alone += 1;
                    result.deep = result.deep.max(depth(mesh, projector, sample) / diagonal);
                }
            }
        }
    }
    result
}

fn mesh((positions, triangles): meshes::Soup) -> Mesh {
    Mesh::new(positions, triangles).unwrap()
}

#[test]
#[cfg_attr(not(feature = "embree"), ignore = "one of them is Embree")]
fn both_engines_have_the_same_hits_but_at_edges() {
    let cases = [
        (mesh(meshes::torus()), 0.02),
        (mesh(meshes::fine_torus(800, 400)), 0.01),
        (mesh(meshes::sphere()), 0.01),
        (mesh(meshes::hall(6)), 0.03),
        (mesh(meshes::random_soup(3, 40)), 0.01),
        (mesh(meshes::sheets(0.01)), 0.015),
        (mesh(meshes::needles(1e-2)), 0.002),
        (mesh(meshes::needles(1e-3)), 0.001),
        (mesh(meshes::placed(meshes::torus(), 1e-3, 0.05)), 2e-5),
        (mesh(meshes::placed(meshes::sphere(), 1e30, 3e30)), 2e28),
        (mesh(meshes::duplicated(meshes::sphere())), 0.05),
    ];
    for (number, (mesh, radius)) in cases.iter().enumerate() {
        let found = compare(mesh, *radius, number as u64);
        assert!(found.common > 1000, "mesh {number}: {found:?}");
        assert!(found.apart < ROUNDING && found.deep < ROUNDING, "mesh {number}: {found:?}");
        assert!(found.alone <= found.common / 1000 + 1, "mesh {number}: {found:?}");
    }
}

#[test]
fn rasterised_hits_do_not_depend_on_the_threads_or_the_order_of_triangles() {
    let (positions, mut triangles) = meshes::fine_torus(60, 30);
    let forward = mesh((positions.clone(), triangles.clone()));
    let projectors = Projector::all(frame(5, 0, None), 5, 0);
    let expected = hits(Engine::Rasteriser, &forward, 0.02, &projectors, 1);
    let same = hits(Engine::Rasteriser, &forward, 0.02, &projectors, 3);
    triangles.reverse();
    let backward = hits(Engine::Rasteriser, &mesh((positions, triangles)), 0.02, &projectors, 2);
    let last = forward.triangles().len() as u32 - 1;
    for (&(number, triangle), samples) in &expected {
        let barycentrics = |samples: &[Sample]| {
            let mut all: Vec<_> = samples.iter().map(|sample| sample.barycentrics.map(f32::to_bits)).collect();
            all.sort_unstable();
            all
        };
        assert_eq!(barycentrics(samples), barycentrics(&same[&(number, triangle)]));
        assert_eq!(barycentrics(samples), barycentrics(&backward[&(number, last - triangle)]));
    }
    let count = |hits: &HashMap<_, Vec<Sample>>| hits.values().map(Vec::len).sum::<usize>();
    assert_eq!([count(&same), count(&backward)], [count(&expected); 2]);
}
