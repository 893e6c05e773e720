//! Requests to relax points of the plane, for the targets that do.

use azulejo_c::dcr::{AZULEJO_METHOD_THESIS, azulejo_dcr_options};

use crate::calls::Patience;
use crate::input::Input;

/// Options of all kinds, with few steps.
pub fn options(input: &mut Input, patience: &Patience) -> azulejo_dcr_options {
    let min = [input.coordinate(), input.coordinate()].map(f64::from);
    let sides = [input.number(), input.number()];
    let method = i32::from(input.one_in(2));
    // The momentum method takes the defaults only.
    let is_thesis = method == AZULEJO_METHOD_THESIS || input.one_in(16);
    let mut number = |usual: f64, one_in: u8| if is_thesis && input.one_in(one_in) { input.number() } else { usual };
    let [conflict_radius, attraction_radius] = [number(0.95, 16), number(1.05, 16)];
    let [step, decay] = [number(0.05, 2), number(1.0, 8)];
    let mut choice = |choices: i32| if is_thesis { input.any::<i32>().rem_euclid(choices) } else { 0 };
    let [distribution, visits, convergence] = [choice(5), choice(2), choice(2)];
    let neighbours = if is_thesis && input.one_in(8) { input.any() } else { 6 };
    azulejo_dcr_options {
        struct_size: size_of::<azulejo_dcr_options>() as u32,
        boundary: i32::from(input.one_in(2)),
        domain_min: min,
        domain_max: [min[0] + sides[0], min[1] + sides[1]],
        neighbourhood: i32::from(input.one_in(2)),
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

/// What is returned lies in the domain.
pub fn check(options: &azulejo_dcr_options, points: &[[f32; 2]]) {
    for &point in points {
        let is_inside =
            |axis: usize| (options.domain_min[axis]..options.domain_max[axis]).contains(&f64::from(point[axis]));
        assert!(is_inside(0) && is_inside(1), "{point:?}");
    }
}
