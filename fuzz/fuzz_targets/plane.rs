//! Sets of the plane: whole, counted, windows, streams, merged, ordered, around given samples, for domains and radii of
//! all sizes.

#![no_main]

use std::ffi::c_void;
use std::ptr::null_mut;

use azulejo_c::kdrt::*;
use azulejo_c::kept::*;
use azulejo_c::maximal::*;
use azulejo_c::merge::*;
use azulejo_core::{Boundary, Domain};
use azulejo_fuzz::calls::{Arrays, Out, Patience, accepted, array, check_distances, context, create, report};
use azulejo_fuzz::input::Input;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut input = Input::new(bytes);
    let min = [input.coordinate(), input.coordinate()].map(f64::from);
    let sides = [input.number(), input.number()];
    let radius = sides[0].min(sides[1]) * input.number() / 16.0;
    // With hostile numbers nothing of this holds, and the calls refuse.
    if (sides[0] / radius + 2.0) * (sides[1] / radius + 2.0) > 1000.0 {
        return;
    }
    let patience = Patience::new(if input.one_in(4) { input.below(50) } else { u32::MAX });
    let options = azulejo_kdrt_options {
        struct_size: size_of::<azulejo_kdrt_options>() as u32,
        boundary: i32::from(input.one_in(2)),
        radius,
        domain_min: min,
        domain_max: [min[0] + sides[0], min[1] + sides[1]],
        leaf_size: if input.one_in(4) { 6.0 * input.number() } else { 6.0 },
        seed: input.any(),
        progress: Some(Patience::tell),
        progress_user: patience.user(),
        count: 0,
        measure_coverage: 0,
        order: 0,
        quotient: 0.0,
        coarsest: 0.0,
        given_positions: std::ptr::null(),
        given_clearances: std::ptr::null(),
        given_count: 0,
    };
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

fn domain(options: &azulejo_kdrt_options) -> Domain {
    let boundary = if options.boundary == 0 { Boundary::Periodic } else { Boundary::Bounded };
    Domain { min: options.domain_min, max: options.domain_max, boundary }
}

/// Some sets are in progressive order, with levels of several quotients and a coarsest one of several radii.
fn in_order(options: &azulejo_kdrt_options, input: &mut Input) -> azulejo_kdrt_options {
    if !input.one_in(2) {
        return *options;
    }
    let quotient = [0.0, 1.05, 1.5][input.below(3) as usize];
    let coarsest = if input.one_in(4) { options.radius * 2.0 * input.number() } else { 0.0 };
    azulejo_kdrt_options { order: 1, quotient, coarsest, ..*options }
}

/// Samples that stand already, with clearances if they have any.
#[derive(Default)]
struct Given {
    positions: Vec<[f32; 2]>,
    clearances: Option<Vec<f64>>,
}

impl Given {
    /// In the domain and around it, at times anywhere; with clearances about the radius, at times any.
    fn any(options: &azulejo_kdrt_options, input: &mut Input) -> Self {
        let count = if input.one_in(2) { input.below(20) } else { 0 };
        let hostile = input.one_in(16);
        let position = |input: &mut Input| -> [f32; 2] {
            std::array::from_fn(|axis| {
                let [min, max] = [options.domain_min[axis], options.domain_max[axis]];
                if hostile {
                    return input.coordinate();
                }
                (min + (max - min) * (f64::from(input.any::<u8>()) / 128.0 - 0.5)) as f32
            })
        };
        let positions = (0..count).map(|_| position(input)).collect();
        let clearance = |input: &mut Input| match input.below(8) {
            0 if hostile => input.number(),
            1 => 0.0,
            kind => options.radius * 2f64.powi(3 - kind as i32),
        };
        let clearances = (!input.one_in(4)).then(|| (0..count).map(|_| clearance(input)).collect());
        Self { positions, clearances }
    }

    fn in_options(&self, options: &azulejo_kdrt_options) -> azulejo_kdrt_options {
        azulejo_kdrt_options {
            given_positions: self.positions.as_ptr().cast(),
            given_clearances: self.clearances.as_ref().map_or(std::ptr::null(), |clearances| clearances.as_ptr()),
            given_count: self.positions.len(),
            ..*options
        }
    }

    /// Whether it can be told here where they are: far from a torus, its turns are only counted to rounding.
    fn are_near(&self, options: &azulejo_kdrt_options) -> bool {
        let sides = [0, 1].map(|axis| options.domain_max[axis] - options.domain_min[axis]);
        let is_near = |position: &[f32; 2]| (0..2).all(|axis| f64::from(position[axis]).abs() < 1e3 * sides[axis]);
        options.boundary == 1 || self.positions.iter().all(is_near)
    }

    /// Whether `is` holds for all of them, of the distance of a place and the clearance.
    fn all(&self, options: &azulejo_kdrt_options, place: [f64; 2], is: impl Fn(f64, f64) -> bool) -> bool {
        self.positions.iter().enumerate().all(|(i, position)| {
            let clearance = self.clearances.as_ref().map_or(options.radius, |clearances| clearances[i]);
            is(length(wrapped_offset(options, position.map(f64::from), place)), clearance)
        })
    }
}

fn length([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}

/// The shortest offset of two places; on a torus wherever they are.
fn wrapped_offset(options: &azulejo_kdrt_options, a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    std::array::from_fn(|axis| {
        let (offset, side) = (a[axis] - b[axis], options.domain_max[axis] - options.domain_min[axis]);
        if options.boundary == 0 { offset - side * (offset / side).round() } else { offset }
    })
}

/// Six float spacings at the largest coordinate.
fn tolerance(options: &azulejo_kdrt_options) -> f64 {
    let corners = options.domain_min.iter().chain(&options.domain_max);
    6.0 * f64::from(f32::EPSILON) * corners.fold(0.0, |most: f64, x| x.abs().max(most))
}

/// Positions, and ranks where they are in progressive order.
#[derive(Debug, PartialEq)]
struct Set {
    positions: Vec<[f32; 2]>,
    ranks: Vec<f32>,
}

impl Set {
    fn of(points: Box<azulejo_c::points::azulejo_points>) -> Self {
        let ranks = Arrays::of(&points).ranks.to_vec();
        Self { positions: owned(points), ranks }
    }

    fn keep(&mut self, is_kept: impl Fn(&[f32; 2]) -> bool) {
        let kept: Vec<bool> = self.positions.iter().map(is_kept).collect();
        let mut of_ranks = kept.iter();
        self.ranks.retain(|_| *of_ranks.next().expect("a rank for each sample"));
        let mut of_positions = kept.iter();
        self.positions.retain(|_| *of_positions.next().expect("one for each"));
    }
}

fn create_set(options: &azulejo_kdrt_options) -> Option<Set> {
    // SAFETY: the options are of the size that they say, and the arrays of given samples live.
    create(|out| unsafe { azulejo_kdrt_sample(context(), options, out, null_mut()) }).map(Set::of)
}

/// Distances of samples and to given ones; ranks that fall, and distances of every prefix by its last rank.
fn check_set(options: &azulejo_kdrt_options, given: &Given, set: &Set) {
    check(options, Some(set.positions.clone()));
    let slack = if options.boundary == 0 { tolerance(options) } else { 0.0 }; // of wrapping given samples
    for sample in set.positions.iter().filter(|_| given.are_near(options)) {
        let is_clear = given.all(options, sample.map(f64::from), |distance, clearance| distance >= clearance - slack);
        assert!(is_clear, "{sample:?} is too close to a given sample");
    }
    assert_eq!(set.ranks.len(), if options.order == 1 { set.positions.len() } else { 0 });
    assert!(set.ranks.is_sorted_by(|a, b| a >= b), "ranks rise");
    if options.order == 1 {
        let domain = domain(options);
        check_distances(&set.positions, |a, b| domain.offset(a, b), |i, _| set.ranks[i].into());
    }
}

/// Places of a lattice are covered, those of an ordered set by each of some prefixes, too.
fn check_covered(options: &azulejo_kdrt_options, given: &Given, set: &Set) {
    if !given.are_near(options) {
        return;
    }
    let quotient = if options.quotient > 0.0 { options.quotient } else { 2f64.powf(0.125) };
    let coarsest = set.ranks.iter().take_while(|&&rank| rank == set.ranks[0]).count();
    // Of less than 100 samples the quotient is larger.
    let quotient_of = |count: usize| if count < 100 { 2f64.max(quotient * quotient) } else { quotient };
    let of_prefix = |count: usize| (count, quotient_of(count) * f64::from(set.ranks[count - 1]));
    let prefixes = (coarsest.max(1)..set.ranks.len()).step_by(7).map(of_prefix);
    for (count, radius) in prefixes.chain([(set.positions.len(), options.radius)]) {
        for i in 0..64 {
            let place: [f64; 2] = std::array::from_fn(|axis| {
                let side = options.domain_max[axis] - options.domain_min[axis];
                options.domain_min[axis] + side * (f64::from([i % 8, i / 8][axis]) + 0.5) / 8.0
            });
            let reach = |distance: f64, radius: f64| distance <= radius + tolerance(options);
            let by_sample = set.positions[..count]
                .iter()
                .any(|sample| reach(length(wrapped_offset(options, sample.map(f64::from), place)), radius));
            let by_given = !given.all(options, place, |distance, clearance| !reach(distance, clearance));
            assert!(by_sample || by_given, "{place:?} is not covered by the first {count}");
        }
    }
}

/// No two samples are too close, and all are in the domain.
fn check(options: &azulejo_kdrt_options, samples: Option<Vec<[f32; 2]>>) {
    let (Some(samples), domain) = (samples, domain(options)) else { return };
    check_distances(&samples, |a, b| domain.offset(a, b), |_, _| options.radius);
    let inside = |x: f32, axis| (domain.min[axis]..domain.max[axis]).contains(&f64::from(x));
    assert!(samples.iter().all(|&[x, y]| inside(x, 0) && inside(y, 1)));
}

fn owned(points: Box<azulejo_c::points::azulejo_points>) -> Vec<[f32; 2]> {
    Arrays::of(&points).positions.as_chunks::<2>().0.to_vec()
}

fn sample(options: &azulejo_kdrt_options) -> Option<Vec<[f32; 2]>> {
    // SAFETY: the options are of the size that they say.
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
    // SAFETY: the options are of the size that they say.
    check(options, create(|out| unsafe { azulejo_maximal_sample(context(), &request, out) }).map(owned));
}

fn counted(options: &azulejo_kdrt_options, count: u32) {
    let request = azulejo_kdrt_options { radius: 0.0, count: count as usize, measure_coverage: 1, ..*options };
    let mut report = report(azulejo_kdrt_report_init);
    // SAFETY: the structs are of the sizes that they say.
    let call = |out: Out<_>| unsafe { azulejo_kdrt_sample(context(), &request, out, &raw mut report) };
    let Some(set) = create(call).map(Set::of) else { return };
    assert_eq!(set.positions.len(), count as usize);
    assert!(report.coverage > 0.0);
    check_set(&azulejo_kdrt_options { radius: report.radius, ..request }, &Given::default(), &set);
}

/// A window is the whole set, filtered, and the same of a kept plane.
fn window(options: &azulejo_kdrt_options, given: &Given, patience: &Patience, input: &mut Input) {
    let [low, high] = [0, 1]
        .map(|_| -> [f64; 2] { std::array::from_fn(|axis| options.domain_min[axis] + f64::from(input.coordinate())) });
    // SAFETY: the options are of the size that they say, and the corners two numbers each.
    let call =
        |out: Out<_>| unsafe { azulejo_kdrt_sample_window(context(), options, low.as_ptr(), high.as_ptr(), out) };
    let Some(part) = create(call).map(Set::of) else { return };
    check_set(options, given, &part);
    patience.again(u32::MAX);
    // SAFETY: the options are of the size that they say.
    let plane = create(|out: Out<_>| unsafe { azulejo_kdrt_create(context(), options, out) });
    // SAFETY: the corners are two numbers each.
    let call = |out: Out<_>| unsafe { azulejo_kdrt_window(plane.as_deref(), low.as_ptr(), high.as_ptr(), out) };
    assert_eq!(create(call).map(Set::of).as_ref(), Some(&part));
    azulejo_kdrt_free(plane);
    let Some(mut whole) = create_set(options) else { panic!("a window without the whole") };
    if options.boundary == 1
        || (0..2).all(|axis| low[axis] >= options.domain_min[axis] && high[axis] <= options.domain_max[axis])
    {
        whole.keep(|point| (0..2).all(|axis| (low[axis]..high[axis]).contains(&f64::from(point[axis]))));
        assert_eq!(part, whole);
    }
}

/// A visitor that stops after a while.
struct Visitor {
    left: u32,
    samples: Vec<[f32; 2]>,
}

unsafe extern "C-unwind" fn visit(user: *mut c_void, xy: *const f32, count: usize) -> i32 {
    // SAFETY: `stream` leads here with this user, the library with so many samples.
    let (visitor, xy) = unsafe { (&mut *user.cast::<Visitor>(), array(xy, 2 * count)) };
    visitor.samples.extend(xy.as_chunks::<2>().0);
    visitor.left = visitor.left.saturating_sub(1);
    i32::from(visitor.left == 0)
}

fn stream(options: &azulejo_kdrt_options, given: &Given, visits: u32) {
    let mut visitor = Visitor { left: visits, samples: Vec::new() };
    // SAFETY: the options are of the size that they say, and the visitor lives.
    let status = unsafe { azulejo_kdrt_stream(context(), options, Some(visit), (&raw mut visitor).cast()) };
    accepted(status);
    check_set(options, given, &Set { positions: visitor.samples, ranks: Vec::new() });
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
        azulejo_kdrt_merge_piece { xy: samples.as_ptr().cast(), count: samples.len(), min, max }
    };
    let pieces = [piece(0), piece(1)];
    // SAFETY: all arrays are as long as told.
    let call = |out: Out<_>| unsafe {
        azulejo_kdrt_merge(context(), &request, pieces.as_ptr(), 2, fixed.as_ptr().cast(), fixed.len(), out, null_mut())
    };
    let Some(set) = create(call).map(Set::of) else { return };
    check(options, Some(set.positions.clone()));
    let bits = |points: &[[f32; 2]]| points.iter().flatten().map(|x| x.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&set.positions[..fixed.len()]), bits(&fixed), "fixed points come first, bit by bit");
    check_covered(options, &Given::default(), &set);
}
