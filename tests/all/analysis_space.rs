//! Sets in cuboids, measured: against all pairs, boxes that are halved, and lattices, whose figures are known.

use azulejo::analysis::coverage::{Coverage, coverage_3d, covering_radius_3d};
use azulejo::analysis::space::{SpaceFigures, figures_3d};
use azulejo::psp::TOLERANCE;
use azulejo::volume::{Options, sample};
use azulejo::{Boundary, Context, Domain, Error, Given};

use crate::common::random::Random;
use crate::common::volume_oracle::{HARD_CUBOIDS, distance, gap};
use crate::common::{BOUNDARIES, float_spacing};

fn context() -> Context {
    Context::new(1).unwrap()
}

fn coverage(domain: &Domain<3>, points: &[[f32; 3]], radius: f64) -> Coverage {
    coverage_3d(&context(), domain, points, radius, None).unwrap()
}

fn figures(domain: &Domain<3>, points: &[[f32; 3]], radius: f64) -> SpaceFigures {
    figures_3d(&context(), domain, points, radius, None).unwrap()
}

/// Random points of a domain, some of them at one place.
fn random_points(domain: &Domain<3>, count: usize, seed: u64) -> Vec<[f32; 3]> {
    let mut random = Random::new(seed);
    let mut place = || -> [f32; 3] {
        std::array::from_fn(|axis| {
            let x = (domain.min[axis] + f64::from(random.unit()) * (domain.max[axis] - domain.min[axis])) as f32;
            if f64::from(x) < domain.min[axis] {
                x.next_up()
            } else if f64::from(x) >= domain.max[axis] {
                x.next_down()
            } else {
                x
            }
        })
    };
    let mut points: Vec<_> = (0..count).map(|_| place()).collect();
    if count > 3 {
        points[count - 1] = points[1];
    }
    points
}

/// True if the covering radius is right to a billionth: some place is as far, to a millionth, and none is farther.
fn is_farthest(domain: &Domain<3>, points: &[[f32; 3]], found: f64) -> bool {
    // The oracle gives up boxes of a sixteenth of the float spacing.
    let coarse = (1e-6 * found).max(float_spacing(domain));
    gap(domain, found - coarse, points).is_some()
        && gap(domain, found * (1.0 + 2e-9), points).is_none()
        // A place that is as far, found from the covering radius alone.
        && gap(domain, found + coarse, points).is_none()
}

#[test]
fn covering_radii_are_those_of_boxes_that_are_halved() {
    for boundary in BOUNDARIES {
        for (case, (min, max, _)) in HARD_CUBOIDS.into_iter().enumerate() {
            let domain = Domain { min, max, boundary };
            for (count, seed) in [(1, 0), (2, 1), (5, 2), (40, 3), (150, 4)] {
                let points = random_points(&domain, count, seed + 10 * case as u64);
                let found = covering_radius_3d(&context(), &domain, &points, None).unwrap();
                assert!(is_farthest(&domain, &points, found), "{domain:?}, {count}: {found}");
                assert_eq!(figures(&domain, &points, 0.0).covering_radius, found);
            }
        }
    }
}

#[test]
fn figures_are_those_of_all_pairs() {
    for boundary in BOUNDARIES {
        for (case, (min, max, radius)) in HARD_CUBOIDS.into_iter().enumerate() {
            let domain = Domain { min, max, boundary };
            for count in [0, 1, 2, 7, 200] {
                let points = random_points(&domain, count, case as u64);
                let places: Vec<_> = points.iter().map(|point| point.map(f64::from)).collect();
                let to_other = |i: usize| {
                    let others = (0..count).filter(|&j| j != i).map(|j| distance(&domain, places[i], places[j]));
                    others.fold(f64::INFINITY, f64::min)
                };
                let nearest: Vec<f64> = (0..count).map(to_other).collect();
                let smallest = nearest.iter().copied().fold(f64::INFINITY, f64::min);
                let pairs = (0..count).flat_map(|i| (0..i).map(move |j| (i, j)));
                let conflicts = pairs.filter(|&(i, j)| distance(&domain, places[i], places[j]) < radius).count();
                let found = figures(&domain, &points, radius);
                let is_near = |found: f64, expected: f64| {
                    found == expected || (found - expected).abs() <= 1e-12 * (expected + float_spacing(&domain))
                };
                assert!(is_near(found.smallest, smallest), "{domain:?} {count}: {found:?}, not {smallest}");
                let mean = if count == 0 { f64::INFINITY } else { nearest.iter().sum::<f64>() / count as f64 };
                assert!(is_near(found.mean, mean), "{domain:?} {count}: {found:?}, not {mean}");
                assert_eq!((found.count, found.conflicts), (count, conflicts as u64), "{domain:?}");
                assert_eq!(figures(&domain, &points, 0.0).conflicts, 0);
                if count == 0 {
                    assert!(
                        [found.packed, found.rho(), found.relative_covering_radius()].iter().all(|x| x.is_infinite())
                    );
                }
            }
        }
    }
}

/// The cells along each side of a lattice.
const SIDE: usize = 6;

/// A lattice of the cube of side 6 by the places of a cell, multiples of 1/4.
fn lattice(of_cell: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let corners = (0..SIDE * SIDE * SIDE).map(|i| [i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE].map(|x| x as f32));
    corners.flat_map(|corner| of_cell.iter().map(move |place| [0, 1, 2].map(|k: usize| corner[k] + place[k]))).collect()
}

fn cube(boundary: Boundary) -> Domain<3> {
    Domain { min: [0.0; 3], max: [SIDE as f64; 3], boundary }
}

/// The simple, body-centred and face-centred lattice, centred in their cells.
fn lattices() -> [(Vec<[f32; 3]>, f64, f64); 3] {
    let [a, b] = [0.25, 0.75];
    [
        (lattice(&[[0.5; 3]]), 1.0, 0.75f64.sqrt()),
        (lattice(&[[a; 3], [b; 3]]), 0.75f64.sqrt(), 5f64.sqrt() / 4.0),
        (lattice(&[[a, a, a], [b, b, a], [b, a, b], [a, b, b]]), 0.5f64.sqrt(), 0.5),
    ]
}

#[test]
fn lattices_have_their_figures() {
    for (points, spacing, covering) in lattices() {
        let found = figures(&cube(Boundary::Periodic), &points, spacing * (1.0 + 1e-12));
        let packed = (2f64.sqrt() * 216.0 / points.len() as f64).cbrt();
        assert_eq!((found.smallest, found.count), (spacing, points.len()));
        assert!((found.mean - spacing).abs() < 1e-13 && (found.packed - packed).abs() < 1e-13, "{found:?}");
        assert!((found.rho() - spacing / packed).abs() < 1e-13, "{found:?}");
        let neighbours = if spacing == 1.0 {
            6
        } else if covering == 0.5 {
            12
        } else {
            8
        };
        assert_eq!(found.conflicts, (points.len() * neighbours / 2) as u64);
        assert_eq!(figures(&cube(Boundary::Periodic), &points, spacing).conflicts, 0);
        let is_exact =
            found.covering_radius > covering * (1.0 - 1e-9) && found.covering_radius <= covering * (1.0 + 1e-14);
        assert!(is_exact, "{found:?}, not {covering}");
        assert!((found.relative_covering_radius() - covering / packed).abs() < 1e-9);
    }
    let dense = figures(&cube(Boundary::Periodic), &lattices()[2].0, 0.0);
    assert!((dense.rho() - 1.0).abs() < 1e-14 && (dense.relative_covering_radius() - 0.5f64.sqrt()).abs() < 1e-8);
}

/// All holes of the simple lattice are equally deep, here a little more than a millionth of the radius beyond the rounding
/// that is allowed to samplers, or just within that.
#[test]
fn gaps_deeper_than_a_millionth_are_counted() {
    let (points, _, farthest) = lattices()[0].clone();
    for boundary in BOUNDARIES {
        let rounding = TOLERANCE * float_spacing(&cube(boundary));
        // Those at the faces, edges and corners, too, which are one around the torus.
        let all = if boundary == Boundary::Periodic { SIDE.pow(3) } else { (SIDE + 1).pow(3) };
        for (depth, gaps) in [(1.2e-6, all), (0.01, all), (-1e-9, 0), (-rounding, 0)] {
            let found = coverage(&cube(boundary), &points, farthest * (1.0 - depth) - rounding);
            assert_eq!(found.gaps, gaps, "{boundary:?}, depth {depth}");
        }
        // Holes meet where a face of the lattice is open, from its middle on.
        assert_eq!(coverage(&cube(boundary), &points, 0.67).gaps, 1, "all holes are one");
    }
}

/// Balls that are kept free are gaps: one in the middle, and one across the corner of a torus, of which a bounded cuboid has
/// an eighth.
#[test]
fn balls_that_are_kept_free_are_gaps() {
    for boundary in BOUNDARIES {
        let domain = Domain { min: [-3.0, 0.5, 7.0], max: [-2.0, 1.5, 8.5], boundary };
        let radius = 0.08;
        for balls in
            [vec![[-2.5, 1.0, 7.75]], vec![[-3.0, 0.5, 7.0]], vec![[-2.5, 1.0, 7.75], [-3.0, 0.5, 7.0]], vec![]]
        {
            let clearances = vec![3.0 * radius; balls.len()];
            let options = Options::new(radius).domain(domain).given(Given::with_clearances(&balls, &clearances));
            let samples = sample(&context(), &options, None).unwrap().0.positions;
            let found = coverage(&domain, &samples, radius);
            assert_eq!(found.gaps, balls.len(), "{boundary:?} {balls:?}: {found:?}");
            let is_deep = found.farthest >= 3.0 * radius;
            assert!(is_deep != balls.is_empty(), "{boundary:?} {balls:?}: {found:?}");
        }
    }
}

/// The library's own maximal sets, also in hard cuboids, have no gap and no conflict; without one sample nothing is nearer than
/// the radius to its place, by more than the tolerance only where floats are fine.
#[test]
fn maximal_sets_have_no_gap_and_no_conflict() {
    for boundary in BOUNDARIES {
        for (min, max, radius) in HARD_CUBOIDS {
            let domain = Domain { min, max, boundary };
            let mut samples = sample(&context(), &Options::new(radius).domain(domain), None).unwrap().0.positions;
            let found = figures(&domain, &samples, radius);
            assert_eq!((found.conflicts, coverage(&domain, &samples, radius).gaps), (0, 0), "{domain:?}");
            if found.count > 1 {
                assert!(figures(&domain, &samples, found.smallest * (1.0 + 1e-9)).conflicts > 0);
            }
            samples.swap_remove(samples.len() / 2);
            let found = coverage(&domain, &samples, radius);
            let is_fine = radius > 1000.0 * float_spacing(&domain);
            assert!(found.farthest >= radius && (found.gaps > 0 || !is_fine), "{domain:?}: {found:?}");
        }
    }
}

#[test]
fn few_points_have_the_coverage_of_their_boxes() {
    for boundary in BOUNDARIES {
        let domain = Domain { min: [0.0; 3], max: [4.0, 2.0, 1.0], boundary };
        assert_eq!(coverage(&domain, &[], 1.0), coverage(&domain, &[], 1e-30));
        assert!(coverage(&domain, &[], 1.0).farthest.is_infinite() && coverage(&domain, &[], 1.0).gaps == 1);
        let half_diagonal = 21f64.sqrt() / 2.0;
        let middle = [2.0, 1.0, 0.5];
        for points in [vec![middle], vec![middle; 50]] {
            // Both ends are open, and their middle is covered.
            let found = coverage(&domain, &points, 1.2);
            assert!((found.farthest / half_diagonal - 1.0).abs() < 1e-9, "{found:?}");
            assert_eq!(found.gaps, if boundary == Boundary::Periodic { 1 } else { 2 });
            assert_eq!(coverage(&domain, &points, half_diagonal).gaps, 0);
        }
        let corner = covering_radius_3d(&context(), &domain, &[[0.0; 3]], None).unwrap();
        let expected = if boundary == Boundary::Periodic { half_diagonal } else { 2.0 * half_diagonal };
        assert!((corner / expected - 1.0).abs() < 1e-9, "{corner}");
    }
}

#[test]
fn threads_change_nothing() {
    for boundary in BOUNDARIES {
        let domain = Domain { min: [0.0; 3], max: [2.0, 1.0, 1.0], boundary };
        let points = random_points(&domain, 1200, 5);
        let of = |threads| {
            let context = Context::new(threads).unwrap();
            let figures = figures_3d(&context, &domain, &points, 0.1, None).unwrap();
            let coverage = coverage_3d(&context, &domain, &points, 0.14, None).unwrap();
            assert!(figures.conflicts > 500 && coverage.gaps > 10, "{figures:?} {coverage:?}");
            format!("{figures:?} {coverage:?}")
        };
        let one = of(1);
        assert_eq!(one, of(2));
        assert_eq!(one, of(3));
    }
}

#[test]
fn bad_arguments_are_refused_by_name() {
    let domain = Domain::unit(Boundary::Periodic);
    let refused = |domain: Domain<3>, points: &[[f32; 3]], radius: f64| {
        let errors = [
            coverage_3d(&context(), &domain, points, radius, None).unwrap_err(),
            figures_3d(&context(), &domain, points, radius, None).unwrap_err(),
        ];
        errors.map(|error| match error {
            Error::InvalidArgument { argument, .. } => argument,
            error => panic!("{error}"),
        })
    };
    for radius in [f64::NAN, -1.0, f64::INFINITY] {
        assert_eq!(refused(domain, &[], radius), ["radius"; 2]);
    }
    assert!(coverage_3d(&context(), &domain, &[], 0.0, None).is_err());
    for point in [[0.0, 0.0, 1.0], [0.0, -1e-9, 0.0], [f32::NAN, 0.0, 0.0], [0.0, f32::INFINITY, 0.0]] {
        assert_eq!(refused(domain, &[[0.5; 3], point], 0.1), ["positions"; 2]);
        assert!(covering_radius_3d(&context(), &domain, &[point], None).is_err());
    }
    assert_eq!(refused(Domain { max: [1.0, 1.0, 0.0], ..domain }, &[], 0.1), ["domain_max"; 2]);
    let error = coverage_3d(&context(), &domain, &[[0.5; 3]], 1e-4, None).unwrap_err();
    assert!(matches!(error, Error::TooLarge { argument: "radius", .. }), "{error}");
}
