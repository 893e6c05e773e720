//! Requests to relax points of the plane, for the targets that do, and what the results owe.

use azulejo_c::dcr::{AZULEJO_METHOD_THESIS, azulejo_dcr_options, azulejo_dcr_report};
use azulejo_core::{Boundary, Domain};

use crate::calls::Patience;
use crate::disks::{distance, find_gap};
use crate::input::Input;

/// Options of all kinds, with few steps.
pub fn options(input: &mut Input, patience: &Patience) -> azulejo_dcr_options {
    let min = [input.coordinate(), input.coordinate()].map(f64::from);
    let sides = [input.number(), input.number()];
    let method = u32::from(input.one_in(2));
    // The momentum method takes the defaults only.
    let is_thesis = method == AZULEJO_METHOD_THESIS || input.one_in(16);
    let mut number = |usual: f64, one_in: u8| if is_thesis && input.one_in(one_in) { input.number() } else { usual };
    let [conflict_radius, attraction_radius] = [number(0.95, 16), number(1.05, 16)];
    let [step, decay] = [number(0.05, 2), number(1.0, 8)];
    let mut choice = |choices: u32| if is_thesis { input.below(choices) } else { 0 };
    let [distribution, visits, convergence] = [choice(5), choice(2), choice(2)];
    let neighbours = if is_thesis && input.one_in(8) { input.any() } else { 6 };
    azulejo_dcr_options {
        struct_size: size_of::<azulejo_dcr_options>() as u32,
        boundary: u32::from(input.one_in(2)),
        domain_min: min,
        domain_max: [min[0] + sides[0], min[1] + sides[1]],
        neighbourhood: u32::from(input.one_in(2)),
        method,
        max_iterations: input.below(24),
        reserved: 0,
        seed: input.any(),
        tolerance: if input.one_in(8) { input.number() } else { -1.0 },
        progress: Some(Patience::tell),
        progress_user: patience.user(),
        conflict_radius,
        attraction_radius,
        step,
        decay,
        neighbours,
        distribution,
        visits,
        convergence,
    }
}

/// Points, mostly in the domain of the options.
pub fn points(input: &mut Input, options: &azulejo_dcr_options) -> Vec<[f32; 2]> {
    let hostile = input.one_in(4);
    let points = input.rows::<2>(60);
    if hostile { points } else { points.into_iter().map(|point| inside(options, point)).collect() }
}

/// A point moved into the domain, unless the domain is none.
fn inside(options: &azulejo_dcr_options, point: [f32; 2]) -> [f32; 2] {
    std::array::from_fn(|axis| {
        let (low, high) = (options.domain_min[axis], options.domain_max[axis]);
        let x = (low + (f64::from(point[axis]) / 8.0 + 0.5) * (high - low)) as f32;
        if (low..high).contains(&f64::from(x)) { x } else { low as f32 }
    })
}

/// Checks that the points lie in the domain.
pub fn check(options: &azulejo_dcr_options, points: &[[f32; 2]]) {
    for &point in points {
        let is_inside =
            |axis: usize| (options.domain_min[axis]..options.domain_max[axis]).contains(&f64::from(point[axis]));
        assert!(is_inside(0) && is_inside(1), "{point:?}");
    }
}

/// d_max: the distance of a hexagonal arrangement of so many points.
pub fn unit(options: &azulejo_dcr_options, count: usize) -> f64 {
    let [width, height] = [0, 1].map(|axis| options.domain_max[axis] - options.domain_min[axis]);
    (2.0 / 3f64.sqrt() * width * height / count as f64).sqrt()
}

/// The figures of a report are those of the points that are returned, where all of the domain is alike: the smallest
/// distance by all pairs, the covering radius by cutting the domain into pieces.
pub fn check_report(options: &azulejo_dcr_options, points: &[[f32; 2]], report: &azulejo_dcr_report) {
    if let Some(fault) = fault(options, points, report) {
        let (low, high, boundary) = (options.domain_min, options.domain_max, options.boundary);
        let (rho, coverage) = (report.rho, report.relative_covering_radius);
        panic!("{fault}: rho {rho}, coverage {coverage}, {low:?} to {high:?}, boundary {boundary}, {points:?}");
    }
}

/// The figure that is not true, if there is one.
fn fault(options: &azulejo_dcr_options, points: &[[f32; 2]], report: &azulejo_dcr_report) -> Option<String> {
    let boundary = if options.boundary == 0 { Boundary::Periodic } else { Boundary::Bounded };
    let domain = Domain { min: options.domain_min, max: options.domain_max, boundary };
    let unit = unit(options, points.len());
    let pairs = (0..points.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let smallest = pairs.map(|(i, j)| distance(&domain, points[i], points[j])).fold(f64::INFINITY, f64::min);
    let largest = domain.min.iter().chain(&domain.max).fold(0.0, |most: f64, x| x.abs().max(most));
    // Distances are computed in f64, coverage of places that are rounded to floats.
    let (rounding, spacing) = (1e-9 * smallest + 1e-12 * largest, 4.0 * f64::from(f32::EPSILON) * largest);
    if points.len() > 1
        && ((report.smallest_distance - smallest).abs() > rounding || (report.rho * unit - smallest).abs() > rounding)
    {
        return Some(format!("the smallest distance is {smallest}, {} times {unit}", smallest / unit));
    }
    if points.is_empty() {
        return None;
    }
    let (coverage, slack) =
        (report.relative_covering_radius * unit, 1e-6 * (1.0 + report.relative_covering_radius) * unit + spacing);
    let gap = |radius: f64| find_gap(&domain, points.iter().map(|&point| (point, radius)), 0.0, slack / 16.0);
    if let Some(gap) = gap(coverage + slack) {
        return Some(format!("{gap:?} is farther than {coverage} from all points"));
    }
    let is_less = coverage > slack && gap(coverage - slack).is_none();
    is_less.then(|| format!("less than {coverage} is enough"))
}

#[cfg(test)]
mod tests {
    use azulejo_c::dcr::{azulejo_dcr_options_init, azulejo_dcr_report_init};

    use super::*;
    use crate::calls::report;

    #[test]
    fn points_that_are_missing_or_moved_and_figures_that_are_not_true_are_noticed() {
        for boundary in [0, 1] {
            let options = azulejo_dcr_options { boundary, ..report(azulejo_dcr_options_init) };
            let at = |i: usize| (i as f32 + 0.5) / 7.0;
            let points: Vec<[f32; 2]> = (0..49).map(|i| [at(i % 7), at(i / 7)]).collect();
            let unit = (2.0 / 3f64.sqrt() / 49.0).sqrt();
            let told = |distance: f64, covering_radius: f64| azulejo_dcr_report {
                smallest_distance: distance,
                rho: distance / unit,
                relative_covering_radius: covering_radius / unit,
                ..report(azulejo_dcr_report_init)
            };
            let smallest = (0..49).flat_map(|i| (0..i).map(move |j| (i, j)));
            let smallest = smallest.map(|(i, j)| {
                let between = |axis: usize| f64::from(points[i][axis]) - f64::from(points[j][axis]);
                between(0).hypot(between(1))
            });
            let (smallest, coverage) = (smallest.fold(f64::INFINITY, f64::min), 0.5f64.sqrt() / 7.0);
            let says = |points: &[[f32; 2]], distance, coverage| fault(&options, points, &told(distance, coverage));
            assert_eq!(says(&points, smallest, coverage), None);
            for factor in [0.9999, 1.0001] {
                assert!(says(&points, factor * smallest, coverage).is_some());
                assert!(says(&points, smallest, factor * coverage).is_some());
            }
            for index in 0..49 {
                let (mut fewer, mut moved) = (points.clone(), points.clone());
                fewer.remove(index);
                moved[index] = moved[index].map(|x| x + 0.01);
                assert!(says(&fewer, smallest, coverage).is_some() && says(&moved, smallest, coverage).is_some());
            }
        }
    }
}
