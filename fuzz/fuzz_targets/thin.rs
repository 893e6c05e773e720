//! Clouds of all kinds, in the plane and in space, are thinned as the definitions say.

#![no_main]

use azulejo_c::order::AZULEJO_ORDER_PROGRESSIVE;
use azulejo_c::thin::*;
use azulejo_fuzz::calls::{Out, Owned, Patience, array, context, create};
use azulejo_fuzz::input::Input;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut input = Input::new(bytes);
    if input.one_in(2) { thinned::<3>(&mut input) } else { thinned::<2>(&mut input) }
});

fn thinned<const D: usize>(input: &mut Input) {
    let patience = Patience::new(if input.one_in(8) { input.below(8) } else { u32::MAX });
    let options = azulejo_thin_options {
        struct_size: size_of::<azulejo_thin_options>() as u32,
        order: if input.one_in(32) { input.any() } else { input.below(2) },
        radius: if input.one_in(2) { input.number() / 16.0 } else { 0.0 },
        count: if input.one_in(2) { input.below(70) as usize } else { 0 },
        seed: input.any(),
        progress: Some(Patience::tell),
        progress_user: patience.user(),
    };
    let dimensions = if input.one_in(64) { input.any() } else { D as u32 };
    let cloud = input.rows::<D>(60);
    // Coordinates of points of the given dimensions, if these are accepted.
    let count = if dimensions == 3 && D == 2 { cloud.len() / 2 } else { cloud.len() };
    let (start, options) = (cloud.as_ptr().cast(), &options);
    // SAFETY: the options have the size in their `struct_size`, and there are so many points.
    let call =
        |out: Out<_>| unsafe { azulejo_thin(context(), options, start, count, dimensions, out, std::ptr::null_mut()) };
    let Some(selection) = create(call) else { return };
    if dimensions == D as u32 {
        check(&cloud, options, &selection);
    }
}

/// Compares with naive selections.
fn check<const D: usize>(cloud: &[[f32; D]], options: &azulejo_thin_options, selection: &Owned<azulejo_selection>) {
    let length = selection.read(azulejo_selection_count);
    // SAFETY: the header says how long the arrays are; the selection lives.
    let (indices, ranks) = unsafe {
        (
            array(selection.read(azulejo_selection_indices), length),
            array(selection.read(azulejo_selection_ranks), length),
        )
    };
    let is_progressive = options.order == AZULEJO_ORDER_PROGRESSIVE;
    if !is_progressive && options.count == 0 {
        assert_eq!(indices, by_radius(cloud, options.radius));
        assert!(ranks.is_empty());
        return;
    }
    let most = if options.count > 0 { options.count } else { usize::MAX };
    // The seed chooses the first, which a selection in the order of the cloud does not tell: one of them it is.
    let firsts = if is_progressive { &indices[..length.min(1)] } else { indices };
    let is_expected = |&first: &u32| {
        let order = farthest_first(cloud, first, options.radius, most);
        let mut expected: Vec<u32> = order.iter().map(|&(index, _)| index).collect();
        if !is_progressive {
            expected.sort();
            return expected == indices && ranks.is_empty();
        }
        let are_ranks = order.iter().zip(ranks).all(|(&(_, square), &rank)| {
            let distance = square.sqrt();
            f64::from(rank) <= distance && (f64::from(rank.next_up()) > distance || rank == f32::INFINITY)
        });
        expected == indices && ranks.len() == length && are_ranks
    };
    assert!(cloud.is_empty() || firsts.iter().any(is_expected), "{indices:?} {ranks:?}");
}

/// The square of a distance. Roots of squares that differ may be equal.
fn square<const D: usize>(a: [f32; D], b: [f32; D]) -> f64 {
    std::iter::zip(a, b).map(|(a, b)| f64::from(a) - f64::from(b)).map(|x| x * x).sum()
}

/// Each point that no selected one before it is nearer to.
fn by_radius<const D: usize>(cloud: &[[f32; D]], radius: f64) -> Vec<u32> {
    let mut selected: Vec<u32> = Vec::new();
    for (index, &point) in (0..).zip(cloud) {
        if selected.iter().all(|&before| square(cloud[before as usize], point).sqrt() >= radius) {
            selected.push(index);
        }
    }
    selected
}

/// Each next point is the farthest from those before, the lowest index on ties, until there are as many as asked for or
/// none is as far as the radius. With the squares of the distances.
fn farthest_first<const D: usize>(cloud: &[[f32; D]], first: u32, radius: f64, most: usize) -> Vec<(u32, f64)> {
    let mut order = vec![(first, f64::INFINITY)];
    let mut left: Vec<(u32, f64)> =
        (0..cloud.len() as u32).filter(|&index| index != first).map(|index| (index, f64::INFINITY)).collect();
    let mut last = first;
    while order.len() < most {
        for (index, nearest) in &mut left {
            *nearest = nearest.min(square(cloud[last as usize], cloud[*index as usize]));
        }
        // The last of equal ones is the greatest: from behind, that is the first.
        let farthest = left.iter().enumerate().rev().max_by(|(_, a), (_, b)| a.1.total_cmp(&b.1));
        let Some((place, &next)) = farthest.filter(|(_, next)| next.1.sqrt() >= radius) else { break };
        order.push(next);
        left.remove(place);
        last = next.0;
    }
    order
}
