//! Sets of cuboids and of the inside of meshes: whole, counted, ordered, around given samples, relaxed, with radii that vary,
//! for sizes and radii of all kinds.

#![no_main]

use azulejo_c::inside::*;
use azulejo_c::mesh::{azulejo_mesh, azulejo_mesh_create};
use azulejo_c::order::AZULEJO_ORDER_PROGRESSIVE;
use azulejo_c::points::azulejo_points;
use azulejo_c::volume::*;
use azulejo_c::volume_adaptive::*;
use azulejo_c::volume_relax::*;
use azulejo_core::{Boundary, Domain};
use azulejo_fuzz::calls::{Arrays, Owned, Patience, accepted, check_distances, context, create, report};
use azulejo_fuzz::input::Input;
use azulejo_fuzz::tolerance::float_spacing;
use azulejo_fuzz::varying::{Guest, radius_at};
use azulejo_fuzz::volume_oracle::{distance, gap_between, sample_in_ball};
use libfuzzer_sys::fuzz_target;

/// The most samples that are looked at in all pairs.
const MOST: f64 = 500.0;

fuzz_target!(|bytes: &[u8]| {
    let mut input = Input::new(bytes);
    let patience = Patience::new(if input.one_in(4) { input.below(50) } else { u32::MAX });
    match input.any::<u8>() % 8 {
        6 => adaptive(&mut input, &patience),
        kind if kind % 2 == 1 => inside(&mut input, &patience),
        _ => cuboid(&mut input, &patience),
    }
});

/// The centres and clearances of samples that stand already, in a box and around it.
fn given(domain: &Domain<3>, radius: f64, input: &mut Input) -> Vec<([f32; 3], f64)> {
    let count = if input.one_in(2) { input.below(6) } else { 0 };
    let coordinate = |axis: usize, input: &mut Input| {
        let [min, max] = [domain.min[axis], domain.max[axis]];
        (min + (max - min) * (f64::from(input.any::<u8>()) / 128.0 - 0.5)) as f32
    };
    let position = |input: &mut Input| std::array::from_fn(|axis| coordinate(axis, input));
    (0..count).map(|_| (position(input), radius * f64::from(input.below(5)) / 2.0)).collect()
}

fn positions(points: &Owned<azulejo_points>) -> Vec<[f32; 3]> {
    Arrays::of(points).positions.as_chunks::<3>().0.to_vec()
}

/// A cuboid, and a radius in parts of its shortest side.
fn box_and_radius(input: &mut Input) -> (Domain<3>, f64) {
    let min = std::array::from_fn(|_| f64::from(input.coordinate()));
    let sides: [f64; 3] = std::array::from_fn(|_| input.number());
    let radius = sides.into_iter().fold(f64::INFINITY, f64::min) * input.number() / 4.0;
    let max = std::array::from_fn(|axis| min[axis] + sides[axis]);
    let boundary = if input.one_in(2) { Boundary::Bounded } else { Boundary::Periodic };
    (Domain { min, max, boundary }, radius)
}

/// True for numbers with room for more samples than can be checked.
fn has_too_many(sides: [f64; 3], radius: f64) -> bool {
    sides.iter().map(|side| side / radius + 1.0).product::<f64>() > MOST
}

fn cuboid(input: &mut Input, patience: &Patience) {
    let (domain, radius) = box_and_radius(input);
    let Domain { min, max, boundary } = domain;
    if has_too_many(domain.extent(), radius) {
        return;
    }
    let given = given(&domain, radius, input);
    let (centres, clearances): (Vec<_>, Vec<_>) = given.iter().copied().unzip();
    let count = if input.one_in(4) { 1 + input.below(100) as usize } else { 0 };
    let options = azulejo_volume_options {
        boundary: u32::from(boundary == Boundary::Bounded),
        radius: if count == 0 { radius } else { 0.0 },
        count,
        domain_min: min,
        domain_max: max,
        seed: input.any(),
        order: u32::from(input.one_in(3)),
        quotient: [0.0, 1.05, 1.5][input.below(3) as usize],
        progress: Some(Patience::tell),
        progress_user: patience.user(),
        given_positions: centres.as_ptr().cast(),
        given_clearances: clearances.as_ptr(),
        given_count: given.len(),
        ..report(azulejo_volume_options_init)
    };
    let mut done = report(azulejo_volume_report_init);
    // SAFETY: the options have the size in their `struct_size`, and the arrays of given samples live.
    let set = create(|out| unsafe { azulejo_volume_sample(context(), &options, out, &raw mut done) });
    let Some(set) = set else { return };
    let (samples, ranks) = (positions(&set), Arrays::of(&set).ranks);
    assert_eq!(done.samples, samples.len() as u64);
    assert!(count == 0 || samples.len() == count, "{} samples, not {count}", samples.len());
    let is_ranked = options.order == AZULEJO_ORDER_PROGRESSIVE;
    assert_eq!(ranks.len(), if is_ranked { samples.len() } else { 0 });
    assert!(ranks.is_sorted_by(|a, b| a >= b), "ranks rise");
    for sample in &samples {
        assert!((0..3).all(|axis| (min[axis]..max[axis]).contains(&f64::from(sample[axis]))), "{sample:?} is outside");
    }
    let least = |later: usize, _| if is_ranked { f64::from(ranks[later]) } else { done.radius };
    check_distances(&samples, |a, b| [distance(&domain, a, b), 0.0, 0.0], least);
    let mut balls: Vec<_> = given.iter().map(|&(centre, clearance)| (centre.map(f64::from), clearance)).collect();
    balls.retain(|&(_, clearance)| clearance > 0.0);
    assert_eq!(sample_in_ball(&domain, &samples, &balls), None, "in a clearance");
    balls.extend(samples.iter().map(|sample| (sample.map(f64::from), done.covering_radius)));
    balls.iter_mut().for_each(|(_, radius)| *radius += 9.0 * float_spacing(&domain));
    assert_eq!(gap_between(&domain, &balls), None, "not within {}", done.covering_radius);
}

/// A box whose corners are moved, at times so far that it crosses itself; it is closed all the same.
fn dented(input: &mut Input) -> Option<(Owned<azulejo_mesh>, Domain<3>)> {
    const FACES: [[u32; 4]; 6] = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let scale = input.number();
    let corner = |i: u8, input: &mut Input| -> [f32; 3] {
        std::array::from_fn(|axis| {
            let dent = if input.one_in(4) { input.any::<i8>() } else { input.any::<i8>() / 8 };
            (scale * (f64::from(i >> axis & 1) + f64::from(dent) / 128.0)) as f32
        })
    };
    let corners: Vec<[f32; 3]> = (0..8).map(|i| corner(i, input)).collect();
    let triangles: Vec<u32> = FACES.iter().flat_map(|&[a, b, c, d]| [a, b, c, a, c, d]).collect();
    let (start, indices) = (corners.as_ptr().cast(), triangles.as_ptr());
    // SAFETY: eight vertices, twelve triangles.
    let mesh = create(|out| unsafe { azulejo_mesh_create(start, 8, 12, indices, 12, out) })?;
    let end = |choose: fn(f32, f32) -> f32| -> [f64; 3] {
        std::array::from_fn(|axis| f64::from(corners.iter().map(|corner| corner[axis]).fold(corners[0][axis], choose)))
    };
    Some((mesh, Domain { min: end(f32::min), max: end(f32::max), boundary: Boundary::Bounded }))
}

fn inside(input: &mut Input, patience: &Patience) {
    let Some((mesh, domain)) = dented(input) else { return };
    let sides = domain.extent();
    let longest = sides.into_iter().fold(0.0, f64::max);
    let radius = longest * input.number() / 4.0;
    let tolerance = [0.0625, 0.5, 0.01][input.below(3) as usize];
    if has_too_many(sides, radius) {
        return;
    }
    let given = given(&domain, radius, input);
    let (centres, clearances): (Vec<_>, Vec<_>) = given.iter().copied().unzip();
    let count = if input.one_in(4) { 1 + input.below(60) as usize } else { 0 };
    let options = azulejo_volume_inside_options {
        surface: u32::from(input.one_in(3)),
        radius: if count == 0 { radius } else { 0.0 },
        count,
        tolerance: if input.one_in(16) { input.number() } else { tolerance },
        seed: input.any(),
        order: u32::from(input.one_in(3)),
        progress: Some(Patience::tell),
        progress_user: patience.user(),
        given_positions: centres.as_ptr().cast(),
        given_clearances: clearances.as_ptr(),
        given_count: given.len(),
        thickness: if input.one_in(2) { radius * input.number() } else { 0.0 },
        ..report(azulejo_volume_inside_options_init)
    };
    let mut done = report(azulejo_volume_inside_report_init);
    // SAFETY: the options have the size in their `struct_size`, and the arrays of given samples live.
    let sample = |out| unsafe { azulejo_volume_sample_inside(context(), mesh.get(), &options, out, &raw mut done) };
    let Some(set) = create(sample) else { return };
    let (samples, ranks) = (positions(&set), Arrays::of(&set).ranks);
    assert!(count == 0 || samples.len() == count, "{} samples, not {count}", samples.len());
    assert!(ranks.is_sorted_by(|a, b| a >= b), "ranks rise");
    let least = |later: usize, _| if ranks.is_empty() { done.radius } else { f64::from(ranks[later]) };
    check_distances(&samples, |a, b| [distance(&domain, a, b), 0.0, 0.0], least);
    let is_inside = contained(&mesh, &samples[done.surface_samples as usize..]);
    assert!(options.surface == 1 || is_inside.iter().all(|&inside| inside == 1), "a sample is outside");
    if samples.len() > 1 && input.one_in(4) {
        relaxed(&mesh, &samples, done.surface_samples as usize, &is_inside, input, patience);
    }
}

/// For each point 1 if it lies inside a mesh.
fn contained(mesh: &Owned<azulejo_mesh>, points: &[[f32; 3]]) -> Vec<u8> {
    let mut is_inside = vec![0u8; points.len()];
    let (start, out) = (points.as_ptr().cast(), is_inside.as_mut_ptr());
    // SAFETY: both arrays have this length.
    assert!(accepted(unsafe { azulejo_mesh_contains(context(), mesh.get(), start, points.len(), out) }));
    is_inside
}

/// Values on a grid over a domain.
struct Grid {
    values: Vec<f32>,
    size: [usize; 3],
}

impl Grid {
    /// Up to 3 values along each axis, mostly from a radius to three times that.
    fn new(radius: f64, input: &mut Input) -> Self {
        let size = std::array::from_fn(|_| 1 + input.below(3) as usize);
        let value = |input: &mut Input| match input.one_in(64) {
            true => input.coordinate(),
            false => radius as f32 * (1.0 + f32::from(input.any::<u8>()) / 128.0),
        };
        Self { values: (0..size.iter().product()).map(|_| value(input)).collect(), size }
    }

    /// The mean of all values by their nearness along each axis.
    fn at(&self, domain: &Domain<3>, place: [f64; 3]) -> f64 {
        let [columns, rows, _] = self.size;
        let weight = |number: usize| {
            let node = [number % columns, number / columns % rows, number / columns / rows];
            let along = |axis: usize| (place[axis] - domain.min[axis]) / domain.extent()[axis];
            let apart = |axis: usize| along(axis) * (self.size[axis] - 1) as f64 - node[axis] as f64;
            (0..3).map(|axis| (1.0 - apart(axis).abs()).max(0.0)).product::<f64>()
        };
        (0..).zip(&self.values).map(|(number, &value)| weight(number) * f64::from(value)).sum()
    }

    /// More than the steepest slope.
    fn slope(&self, domain: &Domain<3>) -> f64 {
        let values = self.values.iter().map(|&value| f64::from(value));
        let range = values.clone().fold(0.0, f64::max) - values.fold(f64::INFINITY, f64::min);
        6.0 * range / domain.extent().into_iter().fold(f64::INFINITY, f64::min)
    }
}

/// Radii on a grid or by a function, in a cuboid or inside a mesh.
fn adaptive(input: &mut Input, patience: &Patience) {
    let mesh = if input.one_in(3) { dented(input) } else { None };
    let (domain, radius) = match &mesh {
        Some((_, domain)) => (*domain, domain.extent().into_iter().fold(0.0, f64::max) * input.number() / 4.0),
        None => box_and_radius(input),
    };
    let grid = Grid::new(radius, input);
    let is_small = grid.values.iter().any(|&value| value > 0.0 && f64::from(value) < radius / 2.0);
    if is_small || has_too_many(domain.extent(), radius) {
        return;
    }
    let guest = Guest::new(radius, f64::from(input.any::<u8>()) / 256.0, input);
    let (by_function, is_told_wrong, is_cuboid) = (input.one_in(2), input.one_in(8), mesh.is_none());
    let mut stated = [radius, 2.0 * radius, guest.slope()];
    if is_told_wrong {
        stated[input.below(3) as usize] = input.number();
    }
    let default: azulejo_volume_adaptive_options = report(azulejo_volume_adaptive_options_init);
    let options = azulejo_volume_adaptive_options {
        boundary: if is_cuboid { u32::from(domain.boundary == Boundary::Bounded) } else { default.boundary },
        domain_min: if is_cuboid { domain.min } else { default.domain_min },
        domain_max: if is_cuboid { domain.max } else { default.domain_max },
        grid_values: if by_function { std::ptr::null() } else { grid.values.as_ptr() },
        grid_size: if by_function { [0; 3] } else { grid.size },
        radius_function: by_function.then_some(radius_at),
        radius_function_user: guest.user(),
        smallest: if by_function { stated[0] } else { 0.0 },
        largest: if by_function { stated[1] } else { 0.0 },
        slope: if by_function { stated[2] } else { 0.0 },
        // Refused without a mesh.
        tolerance: if input.one_in(8) { input.number() } else { default.tolerance },
        seed: input.any(),
        progress: Some(Patience::tell),
        progress_user: patience.user(),
        ..default
    };
    let mut done = report(azulejo_volume_report_init);
    let of_mesh = mesh.as_ref().map_or(std::ptr::null(), |(mesh, _)| mesh.get().cast_const());
    // SAFETY: the options have the size in their `struct_size`, and so has the grid; the guest lives.
    let sample = |out| unsafe { azulejo_volume_adaptive_sample(context(), of_mesh, &options, out, &raw mut done) };
    let Some(set) = create(sample) else { return };
    let (samples, radii) = (positions(&set), Arrays::of(&set).radii);
    assert_eq!((done.samples, radii.len()), (samples.len() as u64, samples.len()));
    check_distances(&samples, |a, b| [distance(&domain, a, b), 0.0, 0.0], |i, j| 0.5 * (radii[i] + radii[j]));
    if let Some((mesh, _)) = &mesh {
        assert!(contained(mesh, &samples).iter().all(|&inside| inside == 1), "a sample is outside");
    }
    if by_function && (is_told_wrong || !guest.is_as_told()) {
        return;
    }
    let limit = 4.0 * domain.extent().into_iter().map(|side| side * side).sum::<f64>().sqrt();
    let at = |place| if by_function { guest.at(place) } else { grid.at(&domain, place) };
    for (sample, radius) in samples.iter().zip(radii) {
        let expected = at(sample.map(f64::from));
        let is_reduced = expected > 0.9 * limit && *radius > 0.9 * limit;
        assert!((radius - expected).abs() <= 1e-9 * expected || is_reduced, "{radius} at {sample:?}, not {expected}");
    }
    if is_cuboid {
        let slope = if by_function { guest.slope() } else { grid.slope(&domain) };
        let tolerance = 9.0 * float_spacing(&domain) * (1.0 + slope);
        for number in 0..7u32.pow(3) {
            let place = std::array::from_fn(|axis| {
                domain.min[axis] + domain.extent()[axis] * f64::from(number / 7u32.pow(axis as u32) % 7) / 7.0
            });
            let covers = |(sample, radius): (&[f32; 3], &f64)| {
                distance(&domain, place, sample.map(f64::from)) <= 0.5 * (radius + at(place)) + tolerance
            };
            assert!(samples.iter().zip(radii).any(covers), "{place:?} is not covered");
        }
    }
}

/// Relaxes samples: those of the surface stay or slide, those that were inside are so afterwards.
fn relaxed(
    mesh: &Owned<azulejo_mesh>,
    samples: &[[f32; 3]],
    on_surface: usize,
    was_inside: &[u8],
    input: &mut Input,
    patience: &Patience,
) {
    let slides = input.one_in(2);
    let is_sliding: Vec<u8> = (0..samples.len()).map(|i| u8::from(i < on_surface && slides)).collect();
    let is_fixed: Vec<u8> =
        (0..samples.len()).map(|i| u8::from(if i < on_surface { !slides } else { input.one_in(8) })).collect();
    let options = azulejo_relax_inside_options {
        max_iterations: input.below(12),
        seed: input.any(),
        progress: Some(Patience::tell),
        progress_user: patience.user(),
        fixed: is_fixed.as_ptr(),
        fixed_count: is_fixed.len(),
        sliding: is_sliding.as_ptr(),
        sliding_count: is_sliding.len(),
        ..report(azulejo_relax_inside_options_init)
    };
    let mut done = report(azulejo_volume_relax_report_init);
    let (start, count) = (samples.as_ptr().cast(), samples.len());
    // SAFETY: the options have the size in their `struct_size`, and the arrays the length of the samples.
    let relax =
        |out| unsafe { azulejo_volume_relax_inside(context(), mesh.get(), &options, start, count, out, &raw mut done) };
    let Some(set) = create(relax) else { return };
    let moved = positions(&set);
    assert_eq!(moved.len(), samples.len());
    for (i, (before, after)) in samples.iter().zip(&moved).enumerate() {
        assert!(is_fixed[i] == 0 || before == after, "{i} was fixed at {before:?} and is at {after:?}");
    }
    let is_inside = contained(mesh, &moved[on_surface..]);
    assert!(is_inside.iter().zip(was_inside).all(|(after, before)| after >= before), "a point has left the inside");
    check_distances(&moved, |a, b| std::array::from_fn(|axis| a[axis] - b[axis]), |_, _| done.smallest_distance);
}
