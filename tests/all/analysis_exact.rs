//! Covering radii to a billionth, and gaps however shallow: against every circle through three points, and grids, whose
//! covering radius is known.

use azulejo::analysis::coverage::{coverage_2d, covering_radius_2d, surface_coverage, surface_covering_radius};
use azulejo::mesh::Mesh;
use azulejo::psp::TOLERANCE;
use azulejo::{Boundary, Context, Domain};

use crate::common::sets::{distance, random_points, unit_square};

const BOUNDARIES: [Boundary; 2] = [Boundary::Periodic, Boundary::Bounded];

fn context() -> Context {
    Context::new(1).unwrap()
}

/// Too small by less than a billionth, and not too large but for rounding.
fn is_exact(found: f64, expected: f64) -> bool {
    found > expected * (1.0 - 1e-9) && found <= expected * (1.0 + 1e-14)
}

/// The place that is as far from three points, if there is one.
fn circumcentre([a, b, c]: [[f64; 2]; 3]) -> Option<[f64; 2]> {
    let ([bx, by], [cx, cy]) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let twice = 2.0 * (bx * cy - by * cx);
    let (b2, c2) = (bx * bx + by * by, cx * cx + cy * cy);
    (twice != 0.0).then(|| [a[0] + (cy * b2 - by * c2) / twice, a[1] + (bx * c2 - cx * b2) / twice])
}

/// The farthest places of the unit square are the centres of circles through three points or images of them, or lie on the
/// boundary as far from two points, or in a corner: all of these are tried.
fn naive_covering_radius(domain: &Domain, points: &[[f32; 2]]) -> f64 {
    let turns: &[f64] = if domain.boundary == Boundary::Periodic { &[-1.0, 0.0, 1.0] } else { &[0.0] };
    let shifts = turns.iter().flat_map(|&x| turns.iter().map(move |&y| [x, y]));
    let images: Vec<[f64; 2]> = shifts
        .flat_map(|[x, y]| points.iter().map(move |&point| [f64::from(point[0]) + x, f64::from(point[1]) + y]))
        .collect();
    let count = images.len();
    let mut places = vec![[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]];
    for i in 0..count {
        for j in 0..i {
            let (a, b) = (images[i], images[j]);
            for (axis, side) in [(0, 0.0), (0, 1.0), (1, 0.0), (1, 1.0)] {
                // |place - a| = |place - b| where one coordinate is the side's.
                let across = 1 - axis;
                let [da, db] = [a, b].map(|p| (side - p[axis]).powi(2) + p[across] * p[across]);
                let mut place = [side; 2];
                place[across] = (da - db) / (2.0 * (a[across] - b[across]));
                places.push(place);
            }
            places.extend((0..j).filter_map(|k| circumcentre([a, b, images[k]])));
        }
    }
    let is_inside = |place: &&[f64; 2]| place.iter().all(|x| (0.0..=1.0).contains(x));
    let nearest = |place: &[f64; 2]| {
        let of = |p: &[f64; 2]| (p[0] - place[0]).hypot(p[1] - place[1]);
        images.iter().map(of).fold(f64::INFINITY, f64::min)
    };
    places.iter().filter(is_inside).map(nearest).fold(0.0, f64::max)
}

#[test]
fn covering_radii_are_those_of_the_largest_empty_circle() {
    for boundary in BOUNDARIES {
        let domain = unit_square(boundary);
        for seed in 0..20 {
            let points = random_points(1 + seed as usize % if boundary == Boundary::Periodic { 7 } else { 20 }, seed);
            let (found, expected) = (
                covering_radius_2d(&context(), &domain, &points, None).unwrap(),
                naive_covering_radius(&domain, &points),
            );
            assert!(is_exact(found, expected), "{boundary:?} {seed}: {found:?}, not {expected:?}");
        }
    }
}

/// The centres of the squares of a grid of so many points, at places that floats have.
const SIDE: usize = 16;

fn grid() -> Vec<[f32; 2]> {
    let at = |i: usize| (i as f32 + 0.5) / SIDE as f32;
    (0..SIDE * SIDE).map(|i| [at(i % SIDE), at(i / SIDE)]).collect()
}

/// All gaps of a grid are equally deep, here a little more than a millionth of the spacing beyond the rounding that is
/// allowed to samplers, or just within that.
#[test]
fn gaps_deeper_than_a_millionth_are_counted_in_the_plane() {
    let (spacing, farthest, rounding) = (1.0 / SIDE as f64, 0.5f64.sqrt() / SIDE as f64, TOLERANCE * 0.5f64.powi(24));
    for boundary in BOUNDARIES {
        let domain = unit_square(boundary);
        let count = if boundary == Boundary::Periodic { SIDE * SIDE } else { (SIDE + 1) * (SIDE + 1) };
        for (depth, gaps) in [(1.1e-6, count), (1e-4, count), (-1e-9, 0), (-rounding / spacing, 0)] {
            let radius = farthest - depth * spacing - rounding;
            let found = coverage_2d(&context(), &domain, &grid(), radius, None).unwrap();
            assert!(is_exact(found.farthest, farthest), "{boundary:?}: {found:?}");
            assert_eq!(found.gaps, gaps, "{boundary:?}, depth {depth}");
        }
        assert!(distance(&domain, grid()[0], [0.0; 2]) == farthest);
    }
}

#[test]
fn gaps_deeper_than_a_millionth_are_counted_on_a_mesh() {
    let corners = vec![[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [1.0, 1.0, 2.0], [0.0, 1.0, 2.0]];
    let mesh = Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
    let positions: Vec<[f32; 3]> = grid().iter().map(|&[x, y]| [x, y, 2.0]).collect();
    let (farthest, rounding) = (0.5f64.sqrt() / SIDE as f64, TOLERANCE * 0.5f64.powi(23));
    assert!(is_exact(surface_covering_radius(&context(), &mesh, &positions, None).unwrap(), farthest));
    let all = (SIDE + 1) * (SIDE + 1);
    for (depth, gaps) in [(1.1e-6, all), (1e-4, all), (-1e-9, 0), (-rounding / farthest, 0)] {
        let radius = farthest * (1.0 - depth) - rounding;
        let found = surface_coverage(&context(), &mesh, &positions, radius, None).unwrap();
        assert!(is_exact(found.farthest, farthest), "{found:?}");
        assert_eq!(found.gaps, gaps, "depth {depth}");
    }
}

/// The distance to one sample is largest in a corner of a triangle.
#[test]
fn covering_radii_of_one_sample_are_distances_to_corners() {
    let numbers = random_points(120, 3);
    for triangle in numbers.chunks(6) {
        let [a, b, c, sample] = [0, 1, 2, 3].map(|i| [triangle[i][0], triangle[i][1], triangle[4 + i % 2][i / 2]]);
        let mesh = Mesh::new(vec![a, b, c], vec![[0, 1, 2]]).unwrap();
        let square =
            |p: [f32; 3]| (0..3).map(|axis| (f64::from(p[axis]) - f64::from(sample[axis])).powi(2)).sum::<f64>();
        let expected = [a, b, c].map(square).into_iter().fold(0.0, f64::max).sqrt();
        let found = surface_covering_radius(&context(), &mesh, &[sample], None).unwrap();
        assert!(is_exact(found, expected), "{found:?}, not {expected:?}");
    }
}
