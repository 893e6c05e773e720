//! DCR on bounded squares: what the border does to a set, along it and on it.

#[path = "common/sets.rs"]
#[allow(dead_code)]
mod sets;

use azulejo::dcr::{Neighbourhood, Options, Report, relax};
use azulejo::{Boundary, Context};
use sets::{distance, nearest_distances, random_points, unit_square};

fn run(options: &Options, points: &[[f32; 2]]) -> (Vec<[f32; 2]>, Report) {
    relax(&Context::new(1).unwrap(), options, points, None).unwrap()
}

/// The distance of a point of the unit square from its border.
fn depth(point: &[f32; 2]) -> f64 {
    point.iter().map(|&x| f64::from(x.min(1.0 - x))).fold(1.0, f64::min)
}

#[test]
fn the_thesis_keeps_the_density_along_a_border() {
    let count = 1500;
    let domain = unit_square(Boundary::Bounded);
    let strip = 4.0 * domain.hexagonal_distance(count);
    for neighbourhood in [Neighbourhood::Delaunay, Neighbourhood::Nearest] {
        let options = Options::thesis(domain, neighbourhood);
        // Points are counted the less the deeper they lie, lest the rows along the border show.
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

/// The density of points of the unit square in the strip along its border, over that of all that is deeper than four
/// strips; and the mean of a value of the points in the one over that in the other.
fn strip_over_inside(width: f64, points: &[[f32; 2]], values: &[f64]) -> [f64; 2] {
    let mean_and_density = |holds: &dyn Fn(f64) -> bool, area: f64| {
        let of: Vec<f64> =
            points.iter().zip(values).filter(|(p, _)| holds(depth(p))).map(|(_, &value)| value).collect();
        [of.len() as f64 / area, of.iter().sum::<f64>() / of.len() as f64]
    };
    let strip = mean_and_density(&|depth| depth < width, 1.0 - (1.0 - 2.0 * width).powi(2));
    let inside = mean_and_density(&|depth| depth >= 4.0 * width, (1.0 - 8.0 * width).powi(2));
    [strip[0] / inside[0], strip[1] / inside[1]]
}

#[test]
fn the_border_of_a_bounded_square_is_neither_crowded_nor_empty() {
    let count = 2500;
    let domain = unit_square(Boundary::Bounded);
    let unit = domain.hexagonal_distance(count);
    for (neighbourhood, coverage) in [(Neighbourhood::Delaunay, 0.68f64), (Neighbourhood::Nearest, 0.9)] {
        let (mut sum, sets) = ([0.0; 2], 6);
        for seed in 70..70 + sets {
            let (relaxed, report) = run(&Options::new(domain, neighbourhood), &random_points(count, seed));
            let ratios = strip_over_inside(unit, &relaxed, &nearest_distances(&domain, &relaxed));
            sum = std::array::from_fn(|i| sum[i] + ratios[i] / sets as f64);
            // No place on the border is worse off than one inside may be.
            for step in 0..=400 {
                let along = step as f32 / 400.0;
                for place in [[along, 0.0], [along, 1.0], [0.0, along], [1.0, along]] {
                    let farness = relaxed.iter().map(|&p| distance(&domain, place, p)).fold(f64::INFINITY, f64::min);
                    assert!(farness / unit <= coverage.min(report.coverage + 1e-6), "{place:?}: {}", farness / unit);
                }
            }
        }
        let [density, spacing] = sum;
        assert!((0.95..1.05).contains(&density), "{neighbourhood:?}: {density}");
        assert!((0.98..1.04).contains(&spacing), "{neighbourhood:?}: {spacing}");
    }
    // What is measured sees a crowd and a gap.
    let all = random_points(count, 1);
    let without = |part: usize| {
        let kept = all.iter().enumerate().filter(|(i, p)| depth(p) >= unit || i % part > 0);
        kept.map(|(_, &p)| p).collect::<Vec<_>>()
    };
    assert!(strip_over_inside(unit, &without(5), &[1.0; 2500])[0] < 0.9);
    let twice: Vec<_> = all.iter().filter(|p| depth(p) < unit).chain(&all).copied().collect();
    assert!(strip_over_inside(unit, &twice, &[1.0; 5000])[0] > 1.7);
}
