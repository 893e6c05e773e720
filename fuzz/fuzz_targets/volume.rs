//! Sets of cuboids and of the inside of meshes: whole, counted, ordered, around given samples, relaxed, for sizes and radii
//! of all kinds.

#![no_main]

use azulejo_c::inside::*;
use azulejo_c::mesh::{azulejo_mesh, azulejo_mesh_create};
use azulejo_c::order::AZULEJO_ORDER_PROGRESSIVE;
use azulejo_c::points::azulejo_points;
use azulejo_c::volume::*;
use azulejo_c::volume_relax::*;
use azulejo_core::{Boundary, Domain};
use azulejo_fuzz::calls::{Arrays, Owned, Patience, accepted, check_distances, context, create, report};
use azulejo_fuzz::input::Input;
use azulejo_fuzz::tolerance::float_spacing;
use azulejo_fuzz::volume_oracle::{distance, gap_between, sample_in_ball};
use libfuzzer_sys::fuzz_target;

/// The most samples that are looked at in all pairs.
const MOST: f64 = 500.0;

fuzz_target!(|bytes: &[u8]| {
    let mut input = Input::new(bytes);
    let patience = Patience::new(if input.one_in(4) { input.below(50) } else { u32::MAX });
    if input.one_in(2) { inside(&mut input, &patience) } else { cuboid(&mut input, &patience) }
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

fn cuboid(input: &mut Input, patience: &Patience) {
    let min = std::array::from_fn(|_| f64::from(input.coordinate()));
    let sides: [f64; 3] = std::array::from_fn(|_| input.number());
    let radius = sides.into_iter().fold(f64::INFINITY, f64::min) * input.number() / 4.0;
    if sides.iter().map(|side| side / radius + 1.0).product::<f64>() > MOST {
        return; // hostile numbers with room for more samples than can be checked
    }
    let max = std::array::from_fn(|axis| min[axis] + sides[axis]);
    let boundary = if input.one_in(2) { Boundary::Bounded } else { Boundary::Periodic };
    let domain = Domain { min, max, boundary };
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
    if sides.iter().map(|side| side / radius + 1.0).product::<f64>() > MOST {
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
    let solid = &samples[done.surface_samples as usize..];
    let mut is_inside = vec![0u8; solid.len()];
    let (start, out) = (solid.as_ptr().cast(), is_inside.as_mut_ptr());
    // SAFETY: both arrays have this length.
    assert!(accepted(unsafe { azulejo_mesh_contains(context(), mesh.get(), start, solid.len(), out) }));
    assert!(options.surface == 1 || is_inside.iter().all(|&inside| inside == 1), "a sample is outside");
    if samples.len() > 1 && input.one_in(4) {
        relaxed(&mesh, &samples, done.surface_samples as usize, &is_inside, input, patience);
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
    let mut is_inside = vec![0u8; was_inside.len()];
    let (start, out) = (moved[on_surface..].as_ptr().cast(), is_inside.as_mut_ptr());
    // SAFETY: both arrays have this length.
    assert!(accepted(unsafe { azulejo_mesh_contains(context(), mesh.get(), start, is_inside.len(), out) }));
    assert!(is_inside.iter().zip(was_inside).all(|(after, before)| after >= before), "a point has left the inside");
    check_distances(&moved, |a, b| std::array::from_fn(|axis| a[axis] - b[axis]), |_, _| done.smallest_distance);
}
