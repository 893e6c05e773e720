//! Points of all kinds are relaxed by all methods, and measured.

#![no_main]

use azulejo_c::analysis::*;
use azulejo_c::dcr::*;
use azulejo_c::domain::azulejo_plane_set;
use azulejo_fuzz::calls::{Arrays, Out, Patience, context, create, report, value};
use azulejo_fuzz::input::Input;
use azulejo_fuzz::relaxation;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut input = Input::new(bytes);
    let patience = Patience::new(if input.one_in(4) { input.below(50) } else { u32::MAX });
    let options = relaxation::options(&mut input, &patience);
    let points = relaxation::points(&mut input, &options);
    let (xy, count) = (points.as_ptr().cast(), points.len());
    let mut report = report(azulejo_dcr_report_init);
    // SAFETY: the options are of the size that they say, and there are so many points.
    let call = |out: Out<_>| unsafe { azulejo_dcr_relax(context(), &options, xy, count, out, &raw mut report) };
    if let Some(relaxed) = create(call) {
        let (relaxed, _) = Arrays::of(&relaxed).positions.as_chunks::<2>();
        assert_eq!(relaxed.len(), count);
        relaxation::check(&options, relaxed);
        measure(&options, relaxed);
        assert!(report.iterations <= options.max_iterations && report.motion >= 0.0);
        relaxation::check_report(&options, relaxed, &report);
    }
    measure(&options, &points);
});

/// The figures of the header, which are finite where there are two points.
fn measure(options: &azulejo_dcr_options, points: &[[f32; 2]]) {
    let count = points.len();
    let set = azulejo_plane_set {
        struct_size: size_of::<azulejo_plane_set>() as u32,
        boundary: options.boundary,
        positions: points.as_ptr().cast(),
        count,
        domain_min: options.domain_min,
        domain_max: options.domain_max,
    };
    for function in [azulejo_plane_smallest_distance, azulejo_plane_covering_radius] {
        // SAFETY: the array is as long as told.
        let call = |out: Out<_>| unsafe { function(context(), &set, out) };
        if let Some(distance) = value(call) {
            assert!(distance >= 0.0 && (count < 2 || distance.is_finite()), "{distance} for {count} points");
        }
    }
    let cut = &points.as_flattened()[..2 * count / 3 * 3];
    // SAFETY: the array is as long as told.
    let space = |out: Out<_>| unsafe { azulejo_space_smallest_distance(context(), cut.as_ptr(), cut.len() / 3, out) };
    assert!(value(space).is_none_or(|distance| distance >= 0.0));
}
