//! The order of the hits of a packet.

use std::mem;

use crate::trace::ray::Hit;

/// A place for a hit.
const NO_HIT: Hit = Hit { ray: 0, triangle: 0, uv: [0.0; 2], t: 0.0 };

/// Appends what `finish` makes of the hits of one packet, ordered by lane, `t` and triangle and without repetitions: a
/// triangle that is met twice is met at the same `t`.
pub(super) fn settle<const LANES: usize>(found: &[Hit], finish: impl Fn(&Hit) -> Hit, hits: &mut Vec<Hit>) {
    // By lanes first. Then most packets are in order, since Embree goes from near to far.
    let mut places = [0; LANES];
    found.iter().for_each(|hit| places[hit.ray as usize % LANES] += 1);
    let start = hits.len();
    let mut end = start;
    for place in &mut places {
        end += mem::replace(place, end);
    }
    hits.resize(end, NO_HIT);
    for hit in found {
        let place = &mut places[hit.ray as usize % LANES];
        hits[*place] = finish(hit);
        *place += 1;
    }
    // The bits of floats above zero are in the order of the floats.
    let key = |hit: &Hit| ((hit.ray as u64) << 32 | hit.t.to_bits() as u64, hit.triangle);
    if !hits[start..].is_sorted_by(|a, b| key(a) < key(b)) {
        let mut unsettled = hits.split_off(start);
        unsettled.sort_unstable_by_key(key);
        unsettled.dedup_by_key(|hit| (hit.ray, hit.triangle));
        hits.append(&mut unsettled);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hits_are_ordered_and_repetitions_dropped() {
        let hit = |ray, t, triangle| Hit { ray, triangle, uv: [0.0; 2], t };
        let expected =
            [hit(0, 0.5, 9), hit(0, 0.5, 10), hit(0, 2.0, 1), hit(1, f32::MIN_POSITIVE, 1), hit(1, 30.0, 10)];
        for order in [&[3, 1, 4, 0, 1, 2, 0, 3], &[0, 1, 2, 3, 3, 3, 4, 4], &[3, 0, 4, 0, 1, 1, 1, 2]] {
            let found = order.map(|i: usize| expected[i]);
            let before = hit(7, 1.0, 1);
            let mut hits = vec![before];
            settle::<2>(&found, |hit| Hit { t: 2.0 * hit.t, ..*hit }, &mut hits);
            assert_eq!(hits[0], before);
            assert_eq!(hits[1..], expected.map(|hit| Hit { t: 2.0 * hit.t, ..hit }));
        }
    }
}
