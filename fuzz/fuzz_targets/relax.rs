//! Points of all kinds are relaxed by all methods, and measured.

#![no_main]

use azulejo_c::analysis::*;
use azulejo_c::dcr::*;
use azulejo_fuzz::calls::{Arrays, Out, Patience, context, create, value};
use azulejo_fuzz::input::Input;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut input = Input::new(bytes);
    let patience = Patience::new(if input.one_in(4) { input.below(50) } else { u32::MAX });
    let options = options(&mut input, &patience);
    let hostile = input.one_in(4);
    let mut points = input.rows::<2>(60);
    if !hostile {
        points.iter_mut().for_each(|point| *point = inside(&options, *point));
    }
    let (xy, count) = (points.as_ptr().cast(), points.len());
    let mut report = std::mem::MaybeUninit::uninit();
    // SAFETY: the options are of the size that they say, and there are so many points.
    let call = |out: Out<_>| unsafe { azulejo_dcr_relax(context(), &options, xy, count, out, Some(&mut report)) };
    if let Some(relaxed) = create(call) {
        let (relaxed, _) = Arrays::of(&relaxed).positions.as_chunks::<2>();
        assert_eq!(relaxed.len(), count);
        measure(&options, relaxed);
        // SAFETY: the call succeeded.
        let report: azulejo_dcr_report = unsafe { report.assume_init() };
        assert!(report.iterations <= options.max_iterations && report.motion >= 0.0 && report.rho >= 0.0);
    }
    measure(&options, &points);
});

fn options(input: &mut Input, patience: &Patience) -> azulejo_dcr_options {
    let min = [input.coordinate(), input.coordinate()].map(f64::from);
    let sides = [input.number(), input.number()];
    let mut thesis = |usual: f64| if input.one_in(16) { input.number() } else { usual };
    let [conflict_radius, attraction_radius, step] = [thesis(0.95), thesis(1.05), thesis(0.1)];
    azulejo_dcr_options {
        struct_size: size_of::<azulejo_dcr_options>() as u32,
        boundary: i32::from(input.one_in(2)),
        domain_min: min,
        domain_max: [min[0] + sides[0], min[1] + sides[1]],
        neighbourhood: i32::from(input.one_in(2)),
        max_iterations: input.below(24),
        seed: input.any(),
        conflict_radius,
        attraction_radius,
        step,
        tolerance: if input.one_in(8) { input.number() } else { -1.0 },
        neighbours: if input.one_in(8) { input.any() } else { 6 },
        distribution: input.any::<i32>().rem_euclid(5),
        progress: Some(Patience::tell),
        progress_user: patience.user(),
        method: i32::from(input.one_in(2)),
        reserved: 0,
        visits: i32::from(input.one_in(2)),
        convergence: i32::from(input.one_in(4)),
        decay: if input.one_in(8) { input.number() } else { 1.0 },
    }
}

/// A point moved into the domain, unless the domain is none.
fn inside(options: &azulejo_dcr_options, point: [f32; 2]) -> [f32; 2] {
    std::array::from_fn(|axis| {
        let (low, high) = (options.domain_min[axis], options.domain_max[axis]);
        let x = (low + (f64::from(point[axis]) / 8.0 + 0.5) * (high - low)) as f32;
        if (low..high).contains(&f64::from(x)) { x } else { low as f32 }
    })
}

/// The figures of the header, which are finite where there are two points.
fn measure(options: &azulejo_dcr_options, points: &[[f32; 2]]) {
    let (xy, count) = (points.as_ptr().cast(), points.len());
    let (min, max) = (options.domain_min.as_ptr(), options.domain_max.as_ptr());
    for function in [azulejo_plane_smallest_distance, azulejo_plane_covering_radius] {
        // SAFETY: the arrays are as long as told.
        let call = |out: Out<_>| unsafe { function(context(), xy, count, min, max, options.boundary, out) };
        if let Some(distance) = value(call) {
            assert!(distance >= 0.0 && (count < 2 || distance.is_finite()), "{distance} for {count} points");
        }
    }
    let cut = &points.as_flattened()[..2 * count / 3 * 3];
    // SAFETY: the array is as long as told.
    let space = |out: Out<_>| unsafe { azulejo_space_smallest_distance(context(), cut.as_ptr(), cut.len() / 3, out) };
    assert!(value(space).is_none_or(|distance| distance >= 0.0));
}
