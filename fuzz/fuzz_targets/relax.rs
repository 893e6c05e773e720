//! Points of all kinds are relaxed by all methods and in classes, and measured.

#![no_main]

use azulejo_c::analysis::*;
use azulejo_c::dcr::*;
use azulejo_c::domain::azulejo_plane_set;
use azulejo_core::{Boundary, Domain};
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
    // SAFETY: the options have the size in their `struct_size`, and there are so many points.
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
    if input.one_in(2) {
        in_classes(&options, &points, &mut input);
    }
});

/// Points of several classes stay in their order, and the figures of each class are those of its points.
fn in_classes(options: &azulejo_dcr_options, points: &[[f32; 2]], input: &mut Input) {
    let class_count = if input.one_in(16) { input.below(20) } else { 1 + input.below(4) };
    let class = |input: &mut Input| if input.one_in(128) { input.any() } else { input.below(class_count.max(1)) };
    let classes: Vec<u32> = points.iter().map(|_| class(input)).collect();
    let (xy, of, count) = (points.as_ptr().cast(), classes.as_ptr(), points.len());
    let mut report = report(azulejo_dcr_report_init);
    let (mut rho, mut coverage) = ([-1.0; 20], [-1.0; 20]);
    let (rho_of, coverage_of) = (rho.as_mut_ptr(), coverage.as_mut_ptr());
    // SAFETY: the options have the size in their `struct_size`; the arrays are as long as told, or longer.
    let call = |out: Out<_>| unsafe {
        azulejo_dcr_relax_classes(
            context(),
            options,
            xy,
            of,
            count,
            class_count,
            rho_of,
            coverage_of,
            out,
            &raw mut report,
        )
    };
    let Some(relaxed) = create(call) else { return };
    let (relaxed, _) = Arrays::of(&relaxed).positions.as_chunks::<2>();
    assert_eq!(relaxed.len(), count);
    relaxation::check(options, relaxed);
    if report.iterations == 0 {
        let bits = |points: &[[f32; 2]]| points.iter().flatten().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(relaxed), bits(points), "points without a step");
    }
    check_rho(options, relaxed, report.rho);
    for class in 0..class_count {
        let own: Vec<_> =
            relaxed.iter().zip(&classes).filter(|&(_, &of)| of == class).map(|(&point, _)| point).collect();
        check_rho(options, &own, rho[class as usize]);
        let coverage = coverage[class as usize];
        assert!(coverage > 0.0 && (own.is_empty() || coverage.is_finite()), "class {class} covers {coverage}");
    }
    assert!(rho[class_count as usize..].iter().all(|&rho| rho == -1.0), "{rho:?} of {class_count} classes");
}

/// Compares the relative smallest distance with that of all pairs.
fn check_rho(options: &azulejo_dcr_options, points: &[[f32; 2]], rho: f64) {
    let boundary = if options.boundary == 0 { Boundary::Periodic } else { Boundary::Bounded };
    let domain = Domain { min: options.domain_min, max: options.domain_max, boundary };
    let exact: Vec<[f64; 2]> = points.iter().map(|point| point.map(f64::from)).collect();
    let pairs = exact.iter().enumerate().flat_map(|(i, &a)| exact[..i].iter().map(move |&b| (a, b)));
    let distances = pairs.map(|(a, b)| domain.offset(a, b)).map(|[x, y]| (x * x + y * y).sqrt());
    let smallest = distances.fold(f64::INFINITY, f64::min) / domain.hexagonal_distance(points.len().max(1));
    let is_same = rho == smallest || (rho - smallest).abs() <= 1e-9 * smallest;
    assert!(is_same, "rho {rho}, {smallest} for {} points", points.len());
}

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
        // SAFETY: the array has the given length.
        let call = |out: Out<_>| unsafe { function(context(), &set, out) };
        if let Some(distance) = value(call) {
            assert!(distance >= 0.0 && (count < 2 || distance.is_finite()), "{distance} for {count} points");
        }
    }
    let cut = &points.as_flattened()[..2 * count / 3 * 3];
    // SAFETY: the array has the given length.
    let space = |out: Out<_>| unsafe { azulejo_space_smallest_distance(context(), cut.as_ptr(), cut.len() / 3, out) };
    assert!(value(space).is_none_or(|distance| distance >= 0.0));
}
