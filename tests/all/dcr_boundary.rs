//! DCR on bounded squares: sets along the boundary and on it.

use azulejo::dcr::{Neighbourhood, Options, Report, relax};
use azulejo::{Boundary, Context};

use crate::common::sets::{distance, nearest_distances, random_points, unit_square};

fn run(options: &Options, points: &[[f32; 2]]) -> (Vec<[f32; 2]>, Report) {
    relax(&Context::new(1).unwrap(), options, points, None).unwrap()
}

/// The distance of a point of the unit square from its boundary.
fn depth(point: &[f32; 2]) -> f64 {
    point.iter().map(|&x| f64::from(x.min(1.0 - x))).fold(1.0, f64::min)
}

#[test]
fn the_thesis_keeps_the_density_along_a_boundary() {
    let count = 1500;
    let domain = unit_square(Boundary::Bounded);
    let strip = 4.0 * domain.hexagonal_distance(count);
    for neighbourhood in [Neighbourhood::Delaunay, Neighbourhood::Nearest] {
        let options = Options::thesis(domain, neighbourhood);
        // Points are counted the less the deeper they lie, so that the rows along the boundary do not show.
        let (mut counted, mut spacing) = (0.0, [(0.0, 0); 2]);
        for seed in 0..3 {
            let (relaxed, _) = run(&options, &random_points(count, 70 + seed));
            for (point, nearest) in relaxed.iter().zip(nearest_distances(&domain, &relaxed)) {
                counted += (1.0 - depth(point) / strip).max(0.0) / (3.0 * count as f64);
                let (sum, number) = &mut spacing[usize::from(depth(point) < strip / 4.0)];
                (*sum, *number) = (*sum + nearest, *number + 1);
            }
        }
        // The same count of a constant density, from the integral of (1 - t / strip) 4 (1 - 2 t).
        let density = counted / (2.0 * strip - 4.0 / 3.0 * strip * strip);
        let mean = spacing.map(|(sum, number)| sum / f64::from(number));
        assert!((0.95..1.05).contains(&density), "{options:?}: density {density}");
        assert!((0.95..1.05).contains(&(mean[1] / mean[0])), "{options:?}: spacing {mean:?}");
    }
}

/// The density of points of the unit square in strips along its boundary, one to three times so wide, over that of all
/// that is deeper than four; and the mean of a value of the points in the narrowest over that inside.
fn strips_over_inside(width: f64, points: &[[f32; 2]], values: &[f64]) -> ([f64; 3], f64) {
    let mean_and_density = |holds: &dyn Fn(f64) -> bool, area: f64| {
        let of: Vec<f64> =
            points.iter().zip(values).filter(|(p, _)| holds(depth(p))).map(|(_, &value)| value).collect();
        [of.len() as f64 / area, of.iter().sum::<f64>() / of.len() as f64]
    };
    let strips = [1.0, 2.0, 3.0]
        .map(|strip| mean_and_density(&|depth| depth < strip * width, 1.0 - (1.0 - 2.0 * strip * width).powi(2)));
    let inside = mean_and_density(&|depth| depth >= 4.0 * width, (1.0 - 8.0 * width).powi(2));
    (strips.map(|strip| strip[0] / inside[0]), strips[0][1] / inside[1])
}

#[test]
fn the_boundary_of_a_bounded_square_is_neither_crowded_nor_empty() {
    let count = 2500;
    let domain = unit_square(Boundary::Bounded);
    let unit = domain.hexagonal_distance(count);
    // The tolerance of the density of a strip: a strip one spacing wide may contain a row more or less.
    let goals =
        [(Neighbourhood::Delaunay, 0.68f64, [0.06, 0.04, 0.035]), (Neighbourhood::Nearest, 0.9, [0.05, 0.07, 0.06])];
    for (neighbourhood, coverage, excess) in goals {
        let (mut densities, mut spacing, sets) = ([0.0; 3], 0.0, 6);
        for seed in 70..70 + sets {
            let (relaxed, report) = run(&Options::new(domain, neighbourhood), &random_points(count, seed));
            let (density, mean) = strips_over_inside(unit, &relaxed, &nearest_distances(&domain, &relaxed));
            densities = std::array::from_fn(|i| densities[i] + density[i] / sets as f64);
            spacing += mean / sets as f64;
            // No position on the boundary is covered worse than those inside may be.
            for step in 0..=400 {
                let along = step as f32 / 400.0;
                for place in [[along, 0.0], [along, 1.0], [0.0, along], [1.0, along]] {
                    let farness = relaxed.iter().map(|&p| distance(&domain, place, p)).fold(f64::INFINITY, f64::min);
                    assert!(
                        farness / unit <= coverage.min(report.relative_covering_radius + 1e-6),
                        "{place:?}: {}",
                        farness / unit
                    );
                }
            }
        }
        let is_even = densities.iter().zip(excess).all(|(density, excess)| (density - 1.0).abs() < excess);
        assert!(is_even, "{neighbourhood:?}: {densities:?}");
        assert!((0.98..1.06).contains(&spacing), "{neighbourhood:?}: {spacing}");
    }
    // What is measured sees a crowd and a gap.
    let all = random_points(count, 1);
    let without = |part: usize| {
        let kept = all.iter().enumerate().filter(|(i, p)| depth(p) >= unit || i % part > 0);
        kept.map(|(_, &p)| p).collect::<Vec<_>>()
    };
    assert!(strips_over_inside(unit, &without(5), &[1.0; 2500]).0[0] < 0.9);
    let twice: Vec<_> = all.iter().filter(|p| depth(p) < unit).chain(&all).copied().collect();
    assert!(strips_over_inside(unit, &twice, &[1.0; 5000]).0[0] > 1.7);
}

/// Two points beside each other on the boundary, and a third between them that can go neither out nor in: in 300 such
/// sets there were 11 in which waves of the density kept pushing it back. In corners one set in some hundreds has such
/// three.
#[test]
fn hardly_any_points_stay_in_conflict_at_a_boundary() {
    let count = 1000;
    let domain = unit_square(Boundary::Bounded);
    let unit = domain.hexagonal_distance(count);
    for (neighbourhood, conflict_radius, sets, in_conflict) in
        [(Neighbourhood::Delaunay, 0.85, 75, 1), (Neighbourhood::Nearest, 0.9, 10, 0)]
    {
        let rho = |seed| {
            let (relaxed, _) = run(&Options::new(domain, neighbourhood), &random_points(count, seed));
            nearest_distances(&domain, &relaxed).into_iter().fold(f64::INFINITY, f64::min) / unit
        };
        let below: Vec<_> = (500..500 + sets).map(rho).filter(|&rho| rho < conflict_radius).collect();
        assert!(below.len() <= in_conflict && below.iter().all(|&rho| rho > 0.82), "{neighbourhood:?}: {below:?}");
    }
}
