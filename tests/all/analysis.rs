//! Analysis against brute force.

use azulejo::analysis::bonds::bond_order;
use azulejo::analysis::coverage::{covering_radius_2d, surface_uncovered_fraction};
use azulejo::analysis::figures::figures_2d;
use azulejo::analysis::spacing::{nearest_distances_2d, rho, smallest_distance_2d, smallest_distance_3d};
use azulejo::analysis::triangles::{Triangle, TriangleStatistics, delaunay_triangles, triangle_statistics};
use azulejo::mesh::Mesh;
use azulejo::{Boundary, Context, Domain, Error};
use proptest::prelude::*;

use crate::common::sets::{Random, darts, distance, nearest_distances, random_points, unit_square};

const BOUNDARIES: [Boundary; 2] = [Boundary::Periodic, Boundary::Bounded];

fn context() -> Context {
    Context::new(2).unwrap()
}

fn close(a: f64, b: f64) -> bool {
    a == b || (a / b - 1.0).abs() < 1e-9
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn distances_in_the_plane_are_those_of_all_pairs(
        count in 0usize..60, seed: u64, width in 0.1f64..30.0, cluster in 0.001f32..1.0, periodic: bool
    ) {
        let domain = Domain { min: [-1.0, 2.0], max: [-1.0 + width, 3.0], boundary: BOUNDARIES[usize::from(!periodic)] };
        let place = |p: &[f32; 2]| [-1.0 + cluster * width as f32 * 0.999 * p[0], 2.0 + cluster * 0.999 * p[1]];
        let points: Vec<_> = random_points(count, seed).iter().map(place).collect();
        let expected = nearest_distances(&domain, &points);
        let found = nearest_distances_2d(&context(), &domain, &points, None).unwrap();
        prop_assert!(found.len() == count && found.iter().zip(&expected).all(|(&a, &b)| close(a, b)));
        let smallest = expected.into_iter().fold(f64::INFINITY, f64::min);
        prop_assert!(close(smallest_distance_2d(&context(), &domain, &points, None).unwrap(), smallest));
    }

    #[test]
    fn the_smallest_distance_in_space_is_that_of_all_pairs(
        count in 0usize..80, seed: u64, flat in 0usize..4, scale in prop::sample::select(vec![1e-30f32, 1e-3, 1.0, 1e20])
    ) {
        let mut random = Random::new(seed);
        let mut coordinate = |axis: usize| if axis < flat { scale } else { scale * (random.unit() - 0.5) };
        let positions: Vec<[f32; 3]> = (0..count).map(|_| [coordinate(0), coordinate(1), coordinate(2)]).collect();
        let mut smallest = f64::INFINITY;
        for (i, a) in positions.iter().enumerate() {
            for b in &positions[..i] {
                let squares: f64 = (0..3).map(|axis| (f64::from(a[axis]) - f64::from(b[axis])).powi(2)).sum();
                smallest = smallest.min(squares.sqrt());
            }
        }
        prop_assert!(close(smallest_distance_3d(&context(), &positions, None).unwrap(), smallest));
    }

    /// Against a fine grid of test points: none is farther than the covering radius, and one is nearly as far.
    #[test]
    fn the_covering_radius_is_that_of_the_farthest_point(count in 1usize..20, seed: u64, periodic: bool, thin: bool) {
        let domain = Domain { max: [if thin { 7.0 } else { 1.0 }, 1.0], ..unit_square(BOUNDARIES[usize::from(!periodic)]) };
        let stretch = |[x, y]: [f32; 2]| [x * domain.max[0] as f32, y];
        let points: Vec<_> = random_points(count, seed).into_iter().map(stretch).collect();
        let found = covering_radius_2d(&context(), &domain, &points, None).unwrap();
        let steps = 100;
        let at = |i: i32| i as f32 / steps as f32;
        let probes = (0..=steps).flat_map(|i| (0..=steps).map(move |j| stretch([at(i), at(j)])));
        let gap = |probe| points.iter().map(|&point| distance(&domain, probe, point)).fold(f64::INFINITY, f64::min);
        let farthest = probes.map(gap).fold(0.0, f64::max);
        let half_diagonal = 0.5 * (domain.max[0].hypot(1.0)) / f64::from(steps);
        prop_assert!(farthest <= found * (1.0 + 1e-6) && found <= farthest + half_diagonal, "{farthest} {found}");
    }
}

/// A hexagonal lattice of unit spacing on a torus.
fn hexagonal_lattice() -> (Domain, Vec<[f32; 2]>) {
    let row = 0.75f64.sqrt();
    let domain = Domain { min: [0.0; 2], max: [16.0, 18.0 * row], boundary: Boundary::Periodic };
    let at = |i: usize, j: usize| [i as f64 + 0.5 * (j % 2) as f64, j as f64 * row].map(|x| x as f32);
    (domain, (0..16 * 18).map(|k| at(k % 16, k / 16)).collect())
}

#[test]
fn a_hexagonal_lattice_has_its_known_values() {
    let (domain, points) = hexagonal_lattice();
    let near = |a: f64, b: f64| (a - b).abs() < 1e-5;
    assert!(near(rho(&context(), &domain, &points, None).unwrap(), 1.0));
    assert!(near(smallest_distance_2d(&context(), &domain, &points, None).unwrap(), 1.0));
    assert!(near(covering_radius_2d(&context(), &domain, &points, None).unwrap(), (1.0f64 / 3.0).sqrt()));
    let statistics = triangle_statistics(&context(), &domain, &points, None).unwrap();
    assert_eq!(statistics.triangles, 2 * 16 * 18);
    assert_eq!((statistics.obtuse, statistics.below_30_degrees), (0.0, 0.0));
    assert!(near(statistics.edge_mean, 1.0) && near(statistics.edge_variation, 0.0));
    assert!(near(statistics.area_variation, 0.0));
}

#[test]
fn bonds_of_a_hexagonal_lattice_agree_and_those_of_random_points_do_not() {
    let order = |domain: &Domain, points: &[[f32; 2]]| bond_order(&context(), domain, points, None).unwrap();
    let (domain, points) = hexagonal_lattice();
    assert!((order(&domain, &points) - 1.0).abs() < 1e-5);
    for boundary in BOUNDARIES {
        let random = order(&unit_square(boundary), &random_points(20_000, 5));
        assert!((random - 0.365).abs() < 0.01, "{boundary:?}: {random}");
        assert_eq!(order(&unit_square(boundary), &[]), 0.0);
    }
    // Six neighbours, in the directions 0, α, π - α and their opposites.
    let domain = Domain { min: [0.0; 2], max: [6.0, 12.0], boundary: Boundary::Periodic };
    let points: Vec<_> = (0..24).map(|k| [(k % 6) as f32 + 0.5 * (k / 6 % 2) as f32, 3.0 * (k / 6) as f32]).collect();
    let expected = (2.0 + 4.0 * (6.0 * 6f64.atan()).cos()).abs() / 6.0;
    assert!((order(&domain, &points) - expected).abs() < 1e-9);
}

#[test]
fn triangles_of_random_points_have_the_known_shares() {
    // The density of an angle of a Poisson-Delaunay triangle (Miles 1970). A triangle has one obtuse angle at most.
    let density =
        |a: f64| 4.0 / (3.0 * std::f64::consts::PI) * a.sin() * ((std::f64::consts::PI - a) * a.cos() + a.sin());
    let right = std::f64::consts::FRAC_PI_2;
    let steps = 10_000;
    let width = right / f64::from(steps);
    let obtuse = 3.0 * (0..steps).map(|i| density(right + (f64::from(i) + 0.5) * width) * width).sum::<f64>();
    let sharp = (0..steps).map(|i| density((f64::from(i) + 0.5) * width / 3.0) * width / 3.0).sum::<f64>();
    for boundary in BOUNDARIES {
        let statistics =
            triangle_statistics(&context(), &unit_square(boundary), &random_points(20_000, 3), None).unwrap();
        assert!((statistics.obtuse - obtuse).abs() < 0.015, "{} {obtuse}", statistics.obtuse);
        assert!((statistics.angles_below_30_degrees - sharp).abs() < 0.01, "{statistics:?} {sharp}");
        assert!(statistics.triangles <= 40_000 && statistics.triangles > 39_000);
    }
    let quality =
        |points: &[[f32; 2]]| triangle_statistics(&context(), &unit_square(Boundary::Periodic), points, None).unwrap();
    let (random, thrown) = (quality(&random_points(1000, 4)), quality(&darts(1000, 4)));
    assert_eq!(random.triangles, 2000);
    assert!(thrown.obtuse < 0.5 * random.obtuse && thrown.edge_variation < 0.3 * random.edge_variation);
    assert!(thrown.below_30_degrees < 0.02 && random.below_30_degrees > 0.4);
}

#[test]
fn a_stretched_lattice_has_sharp_triangles_of_three_lengths() {
    // Isosceles triangles of base 1 and height 3, on a torus of 6 x 12.
    let domain = Domain { min: [0.0; 2], max: [6.0, 12.0], boundary: Boundary::Periodic };
    let points: Vec<_> = (0..24).map(|k| [(k % 6) as f32 + 0.5 * (k / 6 % 2) as f32, 3.0 * (k / 6) as f32]).collect();
    let statistics = triangle_statistics(&context(), &domain, &points, None).unwrap();
    let leg = (9.0 + 0.25f64).sqrt();
    let mean = (1.0 + 2.0 * leg) / 3.0;
    let variance = ((1.0 - mean).powi(2) + 2.0 * (leg - mean).powi(2)) / 3.0;
    assert_eq!((statistics.triangles, statistics.obtuse, statistics.below_30_degrees), (48, 0.0, 1.0));
    assert!(close(statistics.angles_below_30_degrees, 1.0 / 3.0));
    assert!(close(statistics.edge_mean, mean) && close(statistics.edge_variation, variance / (mean * mean)));
    assert!(statistics.area_variation < 1e-12);
}

#[test]
fn a_lattice_with_a_shifted_point_has_four_outlying_triangles() {
    let (domain, mut points) = hexagonal_lattice();
    let shift = 0.125;
    points[8 * 16 + 8][0] += shift as f32;
    let statistics = triangle_statistics(&context(), &domain, &points, None).unwrap();
    let count = 2.0 * 16.0 * 18.0;
    // Of the six triangles around the point two keep their height above the opposite edge.
    let (height, change) = (0.75f64.sqrt(), shift * 0.75f64.sqrt());
    let variation = 4.0 * (change / height).powi(2) / count;
    assert!((statistics.area_variation / variation - 1.0).abs() < 1e-4, "{statistics:?}");
    assert!(close(statistics.beyond_4_sigma, 4.0 / count), "{statistics:?}");
    assert_eq!((statistics.triangles, statistics.obtuse, statistics.angles_below_30_degrees), (576, 0.0, 0.0));
}

#[test]
fn triangles_tile_the_torus_and_a_square_but_for_its_border() {
    for count in [2, 3, 50, 1000] {
        let points = random_points(count, 12);
        let triangles = |boundary| delaunay_triangles(&context(), &unit_square(boundary), &points, None).unwrap();
        let area = |boundary| triangles(boundary).iter().map(|triangle| triangle.area()).sum::<f64>();
        assert_eq!(triangles(Boundary::Periodic).len(), 2 * count);
        assert!(close(area(Boundary::Periodic), 1.0), "{count}");
        let inside = |x: f64| (0.0..1.0).contains(&x);
        assert!(
            triangles(Boundary::Bounded).iter().all(|triangle| triangle
                .corners
                .as_flattened()
                .iter()
                .all(|&x| inside(x)))
        );
        assert!(area(Boundary::Bounded) < 1.0 && (count < 1000 || area(Boundary::Bounded) > 0.9));
        for triangle in triangles(Boundary::Periodic) {
            let [a, b, c] = triangle.edges();
            let longest = a.max(b).max(c);
            assert_eq!(triangle.is_obtuse(), 2.0 * longest * longest > a * a + b * b + c * c);
        }
    }
}

#[test]
fn empty_and_single_sets_have_answers() {
    for boundary in BOUNDARIES {
        let domain = unit_square(boundary);
        for points in [vec![], vec![[0.0, 0.0]]] {
            assert_eq!(smallest_distance_2d(&context(), &domain, &points, None).unwrap(), f64::INFINITY);
            let covering = if points.is_empty() { f64::INFINITY } else { 2f64.sqrt() };
            let covering = if boundary == Boundary::Periodic { covering / 2.0 } else { covering };
            assert!(close(covering_radius_2d(&context(), &domain, &points, None).unwrap(), covering));
            triangle_statistics(&context(), &domain, &points, None).unwrap();
        }
    }
    assert_eq!(smallest_distance_3d(&context(), &[], None).unwrap(), f64::INFINITY);
    assert_eq!(smallest_distance_3d(&context(), &[[1.0; 3]; 2], None).unwrap(), 0.0);
}

/// A unit square of two triangles in the plane z = 1, and a triangle of no area.
fn square() -> Mesh {
    let positions = vec![[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0, 1.0, 1.0]];
    Mesh::new(positions, vec![[0, 1, 2], [0, 0, 2], [0, 2, 3]]).unwrap()
}

#[test]
fn the_uncovered_share_of_a_square_is_that_outside_a_disk() {
    let uncovered = |samples: &[[f32; 3]], radius, threads| {
        let context = Context::new(threads).unwrap();
        surface_uncovered_fraction(&context, &square(), samples, radius, 100_000, 5, None).unwrap()
    };
    let outside = 1.0 - std::f64::consts::PI * 0.09;
    let one = uncovered(&[[0.5, 0.5, 1.0]], 0.3, 1);
    assert!((one - outside).abs() < 0.006, "{one} {outside}");
    assert_eq!(one, uncovered(&[[0.5, 0.5, 1.0]], 0.3, 4));
    let quarter = uncovered(&[[0.0, 0.0, 1.0], [0.0, 0.0, 1.0]], 0.3, 2);
    assert!((quarter - (3.0 + outside) / 4.0).abs() < 0.006, "{quarter}");
    assert_eq!(uncovered(&[], 0.3, 1), 1.0);
    assert_eq!(uncovered(&[[0.5, 0.5, 1.0]], 0.71, 1), 0.0);
    assert_eq!(uncovered(&[[0.5, 0.5, 2.0]], 0.99, 1), 1.0);
}

#[test]
fn bad_arguments_are_refused_by_name() {
    let argument = |result: Result<f64, Error>| match result {
        Err(Error::InvalidArgument { argument, .. }) => argument,
        other => panic!("not refused: {other:?}"),
    };
    let domain = unit_square(Boundary::Periodic);
    let none = Domain { max: [1.0, 0.0], ..domain };
    for points in [[[1.0, 0.5]], [[0.5, f32::NAN]]] {
        assert_eq!(argument(smallest_distance_2d(&context(), &domain, &points, None)), "positions");
        assert_eq!(argument(covering_radius_2d(&context(), &domain, &points, None)), "positions");
        assert_eq!(argument(triangle_statistics(&context(), &domain, &points, None).map(|s| s.obtuse)), "positions");
    }
    assert_eq!(argument(covering_radius_2d(&context(), &none, &[], None)), "domain_max");
    let infinite = [[0.0, f32::INFINITY, 0.0]];
    assert_eq!(argument(smallest_distance_3d(&context(), &infinite, None)), "positions");
    assert_eq!(argument(surface_uncovered_fraction(&context(), &square(), &infinite, 1.0, 1, 0, None)), "positions");
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(argument(surface_uncovered_fraction(&context(), &square(), &[], radius, 1, 0, None)), "radius");
    }
}

#[test]
fn triangles_of_space_are_measured_as_if_they_lay_in_the_plane() {
    let corners = [[1.0, 2.0, 3.0], [1.0, 2.0, 5.0], [1.0, 5.0, 2.0]];
    let triangle = Triangle::in_space(corners);
    assert!((triangle.area() - 3.0).abs() < 1e-12 && triangle.is_obtuse());
    let lengths = [2.0, 18f64.sqrt(), 10f64.sqrt()];
    assert!(triangle.edges().iter().zip(lengths).all(|(edge, length)| (edge - length).abs() < 1e-12));
    let flat = Triangle { corners: [[0.0, 0.0], [2.0, 0.0], [-1.0, 3.0]] };
    let [one, other] = [triangle, flat].map(|triangle| TriangleStatistics::of(&[triangle, flat]));
    assert!((one.edge_variation - other.edge_variation).abs() < 1e-12 && one.obtuse == 1.0);
}

/// The figures that the tests of relaxation and analysis compare with: of a lattice of which the distances are known.
#[test]
fn the_oracle_of_distances_notices_points_that_are_moved_and_domains_that_wrap() {
    let mut points: Vec<[f32; 2]> = (0..16).map(|i| [(i % 4) as f32 / 4.0, (i / 4) as f32 / 4.0]).collect();
    let [torus, square] = BOUNDARIES.map(unit_square);
    assert_eq!(nearest_distances(&torus, &points), [0.25; 16]);
    let diagonals = [torus, square].map(|domain| distance(&domain, points[0], points[15]) / 2f64.sqrt());
    assert!((diagonals[0] - 0.25).abs() < 1e-15 && (diagonals[1] - 0.75).abs() < 1e-15, "{diagonals:?}");
    points[3][0] += 0.125;
    let moved = nearest_distances(&torus, &points);
    assert_eq!([moved[0], moved[3], moved[2]], [0.125, 0.125, 0.25]);
    assert_eq!(nearest_distances(&square, &points)[0], 0.25);
}

/// Several calls find the same as each one alone.
#[test]
fn figures_are_those_of_the_calls_that_find_one() {
    let context = &Context::new(2).unwrap();
    for (count, boundary) in
        [(0, Boundary::Bounded), (1, Boundary::Periodic), (2, Boundary::Bounded), (500, Boundary::Periodic)]
    {
        let (points, domain) = (&random_points(count, 7)[..], &unit_square(boundary));
        let figures = figures_2d(context, domain, points, None).unwrap();
        assert_eq!(figures.nearest, nearest_distances_2d(context, domain, points, None).unwrap());
        assert_eq!(figures.covering_radius, covering_radius_2d(context, domain, points, None).unwrap());
        assert_eq!(figures.bond_order, bond_order(context, domain, points, None).unwrap());
        assert_eq!(figures.triangles, triangle_statistics(context, domain, points, None).unwrap());
    }
}
