//! Sets of the plane: whole, counted, windows, streams, merged, ordered, around given samples, for domains and radii of
//! all sizes.

#![no_main]

use std::ffi::c_void;
use std::ptr::null_mut;

use azulejo_c::kdrt::*;
use azulejo_c::kept::*;
use azulejo_c::maximal::*;
use azulejo_c::merge::*;
use azulejo_fuzz::calls::{Out, Patience, accepted, array, context, create, report};
use azulejo_fuzz::input::Input;
use azulejo_fuzz::plane::{Given, Set, any_options, check, check_coverage, check_covered, check_set, owned};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut input = Input::new(bytes);
    let patience = Patience::new(if input.one_in(4) { input.below(50) } else { u32::MAX });
    let Some(mut options) = any_options(&mut input, &patience) else { return };
    if input.one_in(4) {
        options.leaf_size = 6.0 * input.number();
    }
    let given = Given::any(&options, &mut input);
    let arranged = given.in_options(&in_order(&options, &mut input));
    match input.below(7) {
        0 => maximal(&options),
        1 => {
            // Refused around given samples.
            let request = if input.one_in(8) { arranged } else { Given::default().in_options(&arranged) };
            counted(&request, 1 + input.below(200));
        }
        2 => window(&arranged, &given, &patience, &mut input),
        3 => {
            // Refused in progressive order.
            let order = if input.one_in(8) { arranged.order } else { 0 };
            stream(&azulejo_kdrt_options { order, ..arranged }, &given, input.below(20));
        }
        4 => merge(&options, &mut input),
        _ => {
            let Some(set) = create_set(&arranged) else { return };
            check_set(&arranged, &given, &set);
            check_covered(&arranged, &given, &set);
        }
    }
});

/// Some sets are in progressive order, with levels of several quotients and a coarsest one of several radii.
fn in_order(options: &azulejo_kdrt_options, input: &mut Input) -> azulejo_kdrt_options {
    if !input.one_in(2) {
        return *options;
    }
    let quotient = [0.0, 1.05, 1.5][input.below(3) as usize];
    let coarsest = if input.one_in(4) { options.radius * 2.0 * input.number() } else { 0.0 };
    azulejo_kdrt_options { order: 1, quotient, coarsest, ..*options }
}

fn create_set(options: &azulejo_kdrt_options) -> Option<Set> {
    // SAFETY: the options have the size in their `struct_size`, and the arrays of given samples live.
    create(|out| unsafe { azulejo_kdrt_sample(context(), options, out, null_mut()) }).map(Set::of)
}

fn sample(options: &azulejo_kdrt_options) -> Option<Vec<[f32; 2]>> {
    // SAFETY: the options have the size in their `struct_size`.
    create(|out| unsafe { azulejo_kdrt_sample(context(), options, out, null_mut()) }).map(owned)
}

fn maximal(options: &azulejo_kdrt_options) {
    let &azulejo_kdrt_options { boundary, radius, domain_min, domain_max, seed, progress, progress_user, .. } = options;
    let struct_size = size_of::<azulejo_maximal_options>() as u32;
    let request = azulejo_maximal_options {
        struct_size,
        boundary,
        radius,
        domain_min,
        domain_max,
        seed,
        progress,
        progress_user,
    };
    // SAFETY: the options have the size in their `struct_size`.
    let Some(set) =
        create(|out| unsafe { azulejo_maximal_sample(context(), &request, out, std::ptr::null_mut()) }).map(Set::of)
    else {
        return;
    };
    check(options, &set.positions);
    check_covered(options, &Given::default(), &set);
}

fn counted(options: &azulejo_kdrt_options, count: u32) {
    let request = azulejo_kdrt_options { radius: 0.0, count: count as usize, measure_covering_radius: 1, ..*options };
    let mut report = report(azulejo_kdrt_report_init);
    // SAFETY: the structs have the sizes in their `struct_size`.
    let call = |out: Out<_>| unsafe { azulejo_kdrt_sample(context(), &request, out, &raw mut report) };
    let Some(set) = create(call).map(Set::of) else { return };
    assert_eq!(set.positions.len(), count as usize);
    check_coverage(&request, &set.positions, report.covering_radius);
    check_set(&azulejo_kdrt_options { radius: report.radius, ..request }, &Given::default(), &set);
}

/// A window is the whole set, filtered, and the same of a kept plane.
fn window(options: &azulejo_kdrt_options, given: &Given, patience: &Patience, input: &mut Input) {
    let [low, high] = [0, 1]
        .map(|_| -> [f64; 2] { std::array::from_fn(|axis| options.domain_min[axis] + f64::from(input.coordinate())) });
    // SAFETY: the options have the size in their `struct_size`, and the corners two numbers each.
    let call = |out: Out<_>| unsafe {
        azulejo_kdrt_sample_window(context(), options, low.as_ptr(), high.as_ptr(), out, std::ptr::null_mut())
    };
    let Some(part) = create(call).map(Set::of) else { return };
    check_set(options, given, &part);
    patience.again(u32::MAX);
    // SAFETY: the options have the size in their `struct_size`.
    let plane = create(|out: Out<_>| unsafe { azulejo_kdrt_create(context(), options, out) });
    let handle = plane.as_ref().map_or(std::ptr::null(), |plane| plane.get().cast_const());
    // SAFETY: the corners are two numbers each.
    let call = |out: Out<_>| unsafe { azulejo_kdrt_window(handle, low.as_ptr(), high.as_ptr(), out) };
    assert_eq!(create(call).map(Set::of).as_ref(), Some(&part));
    // The same samples, seen from the corner.
    let (mut seen, mut count) = (vec![[-1f32; 2]; part.positions.len()], 0);
    let (positions, none) = (seen.as_mut_ptr().cast(), std::ptr::null_mut());
    // SAFETY: the corners are two numbers each, and there is room for so many samples.
    let status = unsafe {
        azulejo_kdrt_window_into(
            handle,
            low.as_ptr(),
            high.as_ptr(),
            positions,
            none,
            std::ptr::null_mut(),
            seen.len(),
            &raw mut count,
        )
    };
    assert!(accepted(status) && count == seen.len());
    let is_inside = |point: &[f32; 2]| (0..2).all(|axis| (0.0..=high[axis] - low[axis]).contains(&point[axis].into()));
    assert!(seen.iter().all(is_inside));
    let Some(mut whole) = create_set(options) else { panic!("a window without the whole") };
    check_covered(options, given, &whole);
    if options.boundary == 1
        || (0..2).all(|axis| low[axis] >= options.domain_min[axis] && high[axis] <= options.domain_max[axis])
    {
        whole.keep(|point| (0..2).all(|axis| (low[axis]..high[axis]).contains(&f64::from(point[axis]))));
        assert_eq!(part, whole);
    }
}

/// A visitor that stops after a while. The parts are the whole set, in its order, or what came of it.
struct Visitor {
    left: u32,
    samples: Vec<[f32; 2]>,
}

unsafe extern "C-unwind" fn visit(user: *mut c_void, positions: *const f32, count: usize) -> u32 {
    // SAFETY: `stream` leads here with this user, the library with so many samples.
    let (visitor, xy) = unsafe { (&mut *user.cast::<Visitor>(), array(positions, 2 * count)) };
    visitor.samples.extend(xy.as_chunks::<2>().0);
    visitor.left = visitor.left.saturating_sub(1);
    u32::from(visitor.left == 0)
}

fn stream(options: &azulejo_kdrt_options, given: &Given, visits: u32) {
    let mut visitor = Visitor { left: visits, samples: Vec::new() };
    // SAFETY: the options have the size in their `struct_size`, and the visitor lives.
    let status = unsafe {
        azulejo_kdrt_stream(context(), options, Some(visit), (&raw mut visitor).cast(), std::ptr::null_mut())
    };
    let is_whole = accepted(status);
    // Without the callback that may have lost its patience.
    let Some(whole) = create_set(&azulejo_kdrt_options { progress: None, ..*options }) else {
        assert!(!is_whole && visitor.samples.is_empty(), "a stream without the whole");
        return;
    };
    check_set(options, given, &whole);
    check_covered(options, given, &whole);
    assert!(whole.positions.starts_with(&visitor.samples), "a stream that is not the whole");
    assert!(!is_whole || visitor.samples.len() == whole.positions.len(), "a stream that lacks samples");
}

fn merge(options: &azulejo_kdrt_options, input: &mut Input) {
    let &azulejo_kdrt_options { boundary, radius, domain_min, domain_max, seed, progress, progress_user, .. } = options;
    let struct_size = size_of::<azulejo_kdrt_merge_options>() as u32;
    let request = azulejo_kdrt_merge_options {
        struct_size,
        boundary,
        radius,
        domain_min,
        domain_max,
        seed,
        progress,
        progress_user,
        maximal_pieces: 0,
        reserved: 0,
    };
    let middle = domain_min[0] + (domain_max[0] - domain_min[0]) * f64::from(input.any::<u8>()) / 256.0;
    let halves = [(domain_min, [middle, domain_max[1]]), ([middle, domain_min[1]], domain_max)];
    let samples = halves.map(|(min, max)| {
        if input.one_in(4) {
            return input.rows::<2>(30); // mostly too close to each other
        }
        let half = azulejo_kdrt_options { domain_min: min, domain_max: max, boundary: 1, ..*options };
        sample(&half).unwrap_or_default()
    });
    let fixed = if input.one_in(2) { input.rows::<2>(4) } else { Vec::new() };
    let piece = |i: usize| {
        let ((min, max), samples) = (halves[i], &samples[i]);
        azulejo_kdrt_merge_piece { positions: samples.as_ptr().cast(), count: samples.len(), min, max }
    };
    let pieces = [piece(0), piece(1)];
    // SAFETY: all arrays have the given lengths.
    let call = |out: Out<_>| unsafe {
        azulejo_kdrt_merge(
            context(),
            &request,
            pieces.as_ptr(),
            2,
            size_of::<azulejo_kdrt_merge_piece>(),
            fixed.as_ptr().cast(),
            fixed.len(),
            out,
            null_mut(),
        )
    };
    let Some(set) = create(call).map(Set::of) else { return };
    check(options, &set.positions);
    let bits = |points: &[[f32; 2]]| points.iter().flatten().map(|x| x.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&set.positions[..fixed.len()]), bits(&fixed), "fixed points come first, bit by bit");
    check_covered(options, &Given::default(), &set);
}
