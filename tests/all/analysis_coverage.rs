//! Covering radius and gaps, in the plane and on surfaces, against grids of places and known holes.

use std::sync::Arc;

use azulejo::analysis::coverage::{coverage_2d, covering_radius_2d, surface_coverage, surface_covering_radius};
use azulejo::mesh::Mesh;
use azulejo::{Boundary, Context, Domain, Error, kdrt, maximal, psp};
use proptest::prelude::*;

use crate::common::hard_domains;
use crate::common::meshes::{self, Soup};
use crate::common::sets::{distance, random_points, unit_square};

const BOUNDARIES: [Boundary; 2] = [Boundary::Periodic, Boundary::Bounded];

fn context() -> Context {
    Context::new(2).unwrap()
}

fn gaps(domain: &Domain, points: &[[f32; 2]], radius: f64) -> usize {
    coverage_2d(&context(), domain, points, radius, None).unwrap().gaps
}

/// Connected parts of the places of a grid that are farther than a radius from all points, found by walking.
fn parts_of_a_grid(domain: &Domain, distances: &[Vec<f64>], radius: f64) -> usize {
    let (rows, columns) = (distances.len() as i32, distances[0].len() as i32);
    let periodic = domain.boundary == Boundary::Periodic;
    let mut open: Vec<Vec<bool>> = distances.iter().map(|row| row.iter().map(|&d| d > radius).collect()).collect();
    let mut parts = 0;
    for start in 0..rows * columns {
        let mut walk = vec![[start / columns, start % columns]];
        parts += usize::from(open[walk[0][0] as usize][walk[0][1] as usize]);
        while let Some([row, column]) = walk.pop() {
            let inside = (0..rows).contains(&row) && (0..columns).contains(&column);
            let [row, column] = [row.rem_euclid(rows), column.rem_euclid(columns)];
            if (inside || periodic) && std::mem::take(&mut open[row as usize][column as usize]) {
                walk.extend([[row + 1, column], [row - 1, column], [row, column + 1], [row, column - 1]]);
            }
        }
    }
    parts
}

/// Where a grid has as many parts for radii somewhat smaller and somewhat larger, hardly one is too small for it to be seen
/// and hardly a passage too narrow.
#[test]
fn gaps_of_random_sets_are_the_parts_that_a_walk_finds() {
    let steps = 200;
    let (mut clear, mut several) = (0, 0);
    for case in 0..60u64 {
        let boundary = BOUNDARIES[(case % 2) as usize];
        let domain = Domain { max: [if case % 3 == 0 { 3.0 } else { 1.0 }, 1.0], ..unit_square(boundary) };
        let stretch = |[x, y]: [f32; 2]| [x * domain.max[0] as f32, y];
        let points: Vec<_> = random_points(1 + case as usize / 2, case).into_iter().map(stretch).collect();
        let place = |row: usize, column: usize| {
            let at = |i: usize| if boundary == Boundary::Periodic { i as f32 } else { i as f32 * 200.0 / 199.0 };
            stretch([at(column) / steps as f32, at(row) / steps as f32])
        };
        let nearest = |row: usize, column: usize| {
            points.iter().map(|&p| distance(&domain, place(row, column), p)).fold(f64::INFINITY, f64::min)
        };
        let distances: Vec<Vec<f64>> = (0..steps).map(|row| (0..steps).map(|c| nearest(row, c)).collect()).collect();
        let farthest = covering_radius_2d(&context(), &domain, &points, None).unwrap();
        for share in [0.3, 0.5, 0.7, 0.9] {
            let (radius, step) = (share * farthest, domain.max[0] / 400.0);
            let parts = [-4.0, -2.0, -1.0, 0.0, 1.0, 2.0, 4.0]
                .map(|steps| parts_of_a_grid(&domain, &distances, radius + steps * step));
            if parts == [parts[0]; 7] {
                assert_eq!(gaps(&domain, &points, radius), parts[0], "{boundary:?} case {case}, radius {radius}");
                clear += 1;
                several += usize::from(parts[0] > 1);
            }
        }
        assert_eq!(gaps(&domain, &points, farthest), 0);
        // Two points on a torus have holes in pairs.
        let deepest = gaps(&domain, &points, 0.9999 * farthest);
        assert_eq!(deepest, if points.len() == 2 && boundary == Boundary::Periodic { 2 } else { 1 }, "case {case}");
    }
    assert!(clear > 60 && several > 15, "{clear} cases are clear, {several} have several gaps");
}

#[test]
fn a_maximal_set_has_no_gap_and_one_for_each_sample_that_is_taken_away() {
    for boundary in BOUNDARIES {
        let (radius, domain) = (0.02, unit_square(boundary));
        let mut samples =
            maximal::sample(&context(), &maximal::Options::new(radius).domain(domain).seed(3), None).unwrap().positions;
        let reach = radius + 1e-6;
        let whole = coverage_2d(&context(), &domain, &samples, reach, None).unwrap();
        assert_eq!(whole.gaps, 0);
        assert_eq!(whole.farthest, covering_radius_2d(&context(), &domain, &samples, None).unwrap());
        // Samples far from each other, one of them near the boundary.
        for (removed, place) in [[0.5, 0.5], [0.02, 0.1], [0.2, 0.99], [0.8, 0.8]].into_iter().enumerate() {
            let from = |sample: &[f32; 2]| distance(&domain, *sample, place);
            let nearest = (0..samples.len()).min_by(|&a, &b| from(&samples[a]).total_cmp(&from(&samples[b]))).unwrap();
            samples.swap_remove(nearest);
            let found = coverage_2d(&context(), &domain, &samples, reach, None).unwrap();
            // Other samples may cover the middle of the hole, and leave several gaps around it.
            assert!(found.farthest > reach && (removed + 1..5 * (removed + 1)).contains(&found.gaps), "{found:?}");
        }
    }
}

/// Four points of a square lattice lie on each empty circle; all gaps are of one depth.
#[test]
fn a_square_lattice_has_a_gap_in_each_square() {
    for boundary in BOUNDARIES {
        let points: Vec<_> = (0..64).map(|i| [(i % 8) as f32 / 8.0 + 0.0625, (i / 8) as f32 / 8.0 + 0.0625]).collect();
        let expected = if boundary == Boundary::Periodic { 64 } else { 49 + 28 + 4 };
        let half = 0.0625;
        assert_eq!(gaps(&unit_square(boundary), &points, 1.1 * half), expected);
        assert_eq!(gaps(&unit_square(boundary), &points, 0.9 * half), 1);
        assert_eq!(gaps(&unit_square(boundary), &points, 1.42 * half), 0);
        assert_eq!(gaps(&unit_square(boundary), &[], 1.0), 1);
        assert_eq!(gaps(&unit_square(boundary), &points[..1], 0.4), 1);
    }
}

/// All points in a corner: nearly all places are far from all of them, and the farthest lies in a large hole.
#[test]
fn a_cluster_is_as_far_away_as_its_nearest_point() {
    let points: Vec<_> = random_points(30_000, 6).iter().map(|point| point.map(|x| 0.02 * x)).collect();
    for (boundary, corner) in [(Boundary::Bounded, [1.0, 1.0]), (Boundary::Periodic, [0.51, 0.51])] {
        let domain = unit_square(boundary);
        let found = covering_radius_2d(&context(), &domain, &points, None).unwrap();
        let from_corner = points.iter().map(|&point| distance(&domain, corner, point)).fold(f64::INFINITY, f64::min);
        // On the torus the farthest place is about opposite of the middle of the cluster.
        let tolerance = if boundary == Boundary::Bounded { 1e-9 } else { 0.001 };
        assert!(found >= from_corner * (1.0 - 1e-9) && found <= from_corner + tolerance, "{found} {from_corner}");
        assert_eq!(gaps(&domain, &points, 0.5), 1);
    }
}

fn mesh((positions, triangles): Soup) -> Mesh {
    Mesh::new(positions, triangles).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Against a grid of places on each triangle: none is farther than the covering radius, and one is nearly as far.
    #[test]
    fn the_covering_radius_of_a_soup_is_that_of_its_farthest_place(seed: u64, triangles in 1u32..6, count in 1usize..30) {
        let mesh = mesh(meshes::random_soup(seed, triangles));
        let samples: Vec<_> = random_points(count, seed).iter().map(|&[x, y]| [x, y, x * y]).collect();
        let found = surface_covering_radius(&context(), &mesh, &samples, None).unwrap();
        let steps = 60;
        let mut farthest: f64 = 0.0;
        for triangle in 0..triangles {
            for (i, j) in (0..=steps).flat_map(|i| (0..=steps - i).map(move |j| (i, j))) {
                let place = mesh.point(triangle, [i, j].map(|k| k as f32 / steps as f32)).map(f64::from);
                let squared = |sample: &[f32; 3]| (0..3).map(|k| (place[k] - f64::from(sample[k])).powi(2)).sum::<f64>();
                farthest = farthest.max(samples.iter().map(squared).fold(f64::INFINITY, f64::min).sqrt());
            }
        }
        prop_assert!(farthest <= found * (1.0 + 1e-6) && found <= farthest + 3f64.sqrt() / f64::from(steps));
        prop_assert_eq!(surface_coverage(&context(), &mesh, &samples, found, None).unwrap().gaps, 0);
        let coverage = surface_coverage(&Context::new(1).unwrap(), &mesh, &samples, 0.99 * found, None).unwrap();
        prop_assert!(coverage.gaps > 0 && coverage.farthest == found);
    }
}

#[test]
fn a_flat_surface_is_covered_as_the_plane_is() {
    let domain = unit_square(Boundary::Bounded);
    let mut points =
        maximal::sample(&context(), &maximal::Options::new(0.03).domain(domain).seed(9), None).unwrap().positions;
    points.retain(|&point| {
        [[0.2, 0.2], [0.8, 0.3], [0.5, 1.0]].iter().all(|&hole| distance(&domain, point, hole) > 0.04)
    });
    let samples: Vec<_> = points.iter().map(|&[x, y]| [x, y, 0.0]).collect();
    let plane = mesh(meshes::plane());
    let radius = surface_covering_radius(&context(), &plane, &samples, None).unwrap();
    let flat = covering_radius_2d(&context(), &domain, &points, None).unwrap();
    assert!((radius - flat).abs() < 1e-8 * flat, "{radius} {flat}");
    let [on_mesh, in_plane] = [
        surface_coverage(&context(), &plane, &samples, 0.03 + 1e-6, None).unwrap(),
        coverage_2d(&context(), &domain, &points, 0.03 + 1e-6, None).unwrap(),
    ];
    assert_eq!((on_mesh.gaps, on_mesh.farthest), (3, radius));
    assert!(in_plane.gaps >= 3);
}

#[test]
fn a_maximal_set_on_a_torus_has_no_gap_and_holes_in_it_are_counted() {
    let (radius, torus) = (0.1, Arc::new(mesh(meshes::torus())));
    let options = psp::Options::new(radius).seed(5);
    let samples = psp::sample(&context(), &torus, &options, None).unwrap().0.positions;
    let reach = radius + 1e-6;
    let coverage = surface_coverage(&context(), &torus, &samples, reach, None).unwrap();
    assert!(coverage.gaps == 0 && coverage.farthest > 0.9 * radius, "{coverage:?}");
    let holes = [[1.4f32, 0.0, 0.0], [-1.4, 0.0, 0.0], [0.0, 1.0, 0.4]];
    let far = |sample: &[f32; 3], hole: [f32; 3]| {
        (0..3).map(|axis| (sample[axis] - hole[axis]).powi(2)).sum::<f32>().sqrt() > 0.15
    };
    let mut left = samples.clone();
    for (i, hole) in holes.into_iter().enumerate() {
        let before = left.len();
        left.retain(|sample| far(sample, hole));
        assert!(left.len() < before);
        let coverage = surface_coverage(&context(), &torus, &left, reach, None).unwrap();
        assert!(coverage.gaps == i + 1 && coverage.farthest > 1.1 * radius, "{coverage:?}");
    }
}

#[test]
fn sets_without_samples_and_bad_arguments_have_answers() {
    let plane = mesh(meshes::plane());
    let coverage = |samples: &[[f32; 3]], radius| surface_coverage(&context(), &plane, samples, radius, None);
    let none = coverage(&[], 0.1).unwrap();
    assert_eq!((none.farthest, none.gaps), (f64::INFINITY, 1));
    let far = coverage(&[[0.0, 0.0, 9.0]], 0.5).unwrap();
    assert!((far.farthest - 83f64.sqrt()).abs() < 1e-7 && far.gaps == 1);
    let masked = plane.clone().with_mask(vec![false; 2]).unwrap();
    assert_eq!(surface_coverage(&context(), &masked, &[], 0.1, None).unwrap().gaps, 0);
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(coverage(&[], radius), Err(Error::InvalidArgument { argument: "radius", .. })));
        let flat = coverage_2d(&context(), &unit_square(Boundary::Bounded), &[], radius, None);
        assert!(matches!(flat, Err(Error::InvalidArgument { argument: "radius", .. })));
    }
    let infinite = [[0.0, f32::NAN, 0.0]];
    assert!(matches!(coverage(&infinite, 1.0), Err(Error::InvalidArgument { argument: "positions", .. })));
    // A surface of ten trillion gaps.
    assert!(matches!(coverage(&[[0.0; 3]], 1e-7), Err(Error::TooLarge { argument: "radius", .. })));
}

/// The library's own sets, at their own radius, wherever coordinates are large beside it: none has a gap, and without
/// one of their samples each has.
#[test]
fn maximal_sets_have_no_gap_and_have_one_without_a_sample() {
    let context = context();
    for (number, domain) in BOUNDARIES.into_iter().flat_map(hard_domains).enumerate() {
        let [width, height] = domain.extent();
        let radius = (width * height).sqrt() / 12.0;
        let options = kdrt::Options::new(radius).domain(domain).seed(number as u64);
        let Ok(points) = kdrt::sample(&context, &options, None) else { continue };
        let mut positions = points.positions;
        assert_eq!(gaps(&domain, &positions, radius), 0, "{domain:?}");
        positions.swap_remove(number % positions.len());
        assert!(gaps(&domain, &positions, radius) > 0, "{domain:?}");
    }
    let torus = || meshes::fine_torus(40, 20);
    for (number, (positions, triangles)) in [
        torus(),
        meshes::placed(torus(), 1e-3, 7.0),
        meshes::placed(torus(), 1e-15, 0.0),
        meshes::placed(torus(), 1e15, 0.0),
        meshes::placed(torus(), 1.0, -3000.0),
        meshes::needles(1e-4),
        meshes::random_soup(3, 40),
    ]
    .into_iter()
    .enumerate()
    {
        let mesh = Arc::new(Mesh::new(positions, triangles).unwrap());
        let radius = (mesh.area() / 400.0).sqrt();
        let options = psp::Options::new(radius).seed(number as u64);
        let (points, _) = psp::sample(&context, &mesh, &options, None).unwrap();
        let mut positions = points.positions;
        let counted = |positions: &[[f32; 3]]| surface_coverage(&context, &mesh, positions, radius, None).unwrap().gaps;
        assert_eq!(counted(&positions), 0, "mesh {number}");
        positions.swap_remove(number % positions.len());
        assert!(counted(&positions) > 0, "mesh {number}");
    }
}
