//! Random choice among many items in proportion to their weights: of triangles by area, of cells by density.

use crate::rng::Rng;

/// The guide is moved back by a few roundings, so that it never passes the item that is picked.
const MARGIN: f64 = 1.0 - 4.0 * f64::EPSILON;

/// Weights of items, from which items are picked by the guide table method (Chen and Asau 1974): on average the item is
/// one step away from the guide's entry.
///
/// The item picked for a random number u is the first one whose running sum is above u times the total.
pub struct Weights {
    /// The sum of the weights up to each item, itself included.
    ends: Vec<f64>,
    /// For each of as many equal parts of the total, the first item that the part can reach.
    guide: Vec<u32>,
}

impl Weights {
    /// Prepares fewer than 2^32 weights, none negative. O(n).
    pub fn new(weights: Vec<f64>) -> Self {
        let (mut total, mut ends) = (0.0, weights);
        for end in &mut ends {
            total += *end;
            *end = total;
        }
        let (mut guide, mut first) = (Vec::with_capacity(ends.len()), 0);
        for part in 0..ends.len() {
            let start = part as f64 * (total / ends.len() as f64) * MARGIN;
            while first + 1 < ends.len() && ends[first] <= start {
                first += 1;
            }
            guide.push(first as u32);
        }
        Self { ends, guide }
    }

    /// The number of items.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// The sum of all weights.
    pub fn total(&self) -> f64 {
        self.ends.last().copied().unwrap_or(0.0)
    }

    /// A random item; there is at least one. O(1) on average.
    #[inline]
    pub fn pick(&self, rng: &mut Rng) -> u32 {
        self.pick_within(rng).0
    }

    /// A random item, and a place within its weight, from 0 up to the weight.
    #[inline(always)]
    pub fn pick_within(&self, rng: &mut Rng) -> (u32, f64) {
        self.within(rng.unit())
    }

    /// The item at a share of the total, from 0 up to 1.
    pub fn at(&self, share: f64) -> u32 {
        self.within(share).0
    }

    #[inline(always)]
    fn within(&self, share: f64) -> (u32, f64) {
        let last = self.ends.len() - 1;
        let mut item = self.guide[(share * self.ends.len() as f64) as usize] as usize;
        let place = share * self.total();
        while item < last && self.ends[item] <= place {
            item += 1;
        }
        let start = if item == 0 { 0.0 } else { self.ends[item - 1] };
        (item as u32, place - start)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Draw;

    /// Weights in ratios of up to 1e6, with zeros at both ends and between.
    fn weights() -> Vec<f64> {
        let weight = |i: u32| if i.is_multiple_of(3) { 0.0 } else { [1.0, 1e-6, 0.3, 7.0][i as usize % 4] };
        (0..100).map(weight).collect()
    }

    #[test]
    fn items_are_picked_in_proportion_to_their_weights() {
        let mut rng = Rng::at(5, Draw::Probe, &[]);
        let (weights, picks) = (Weights::new(weights()), 200_000);
        let mut picked = [0.0; 100];
        (0..picks).for_each(|_| picked[weights.pick(&mut rng) as usize] += 1.0);
        for (weight, picked) in self::weights().into_iter().zip(picked) {
            let expected = f64::from(picks) * weight / weights.total();
            assert!((picked - expected).abs() <= 5.0 * expected.sqrt(), "{picked} for {expected}");
        }
        assert_eq!((weights.len(), Weights::new(Vec::new()).total()), (100, 0.0));
    }

    #[test]
    fn the_guide_finds_what_a_search_finds() {
        let thirds = (1..1000).map(|i| 1.0 / f64::from(i)).collect();
        for weights in [weights(), thirds, vec![0.1; 777], vec![3.0]].map(Weights::new) {
            let mut rng = Rng::at(6, Draw::Probe, &[]);
            for _ in 0..10_000 {
                let place = rng.clone().unit() * weights.total();
                let expected = weights.ends.partition_point(|&end| end <= place).min(weights.len() - 1);
                let (item, within) = weights.pick_within(&mut rng);
                assert_eq!(item as usize, expected);
                assert!(within >= 0.0 && within <= place);
            }
        }
    }
}
