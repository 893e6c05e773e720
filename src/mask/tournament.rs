//! The extreme pixel of a pattern: the one of least energy that is not set, or of most energy that is.
//!
//! A tree of minima over segments of consecutive pixels. A change of the pattern alters the energies of some hundred
//! pixels, but few of their segments ever come near to being the extreme one. So where energies can only have moved away
//! from the extreme, the minimum of a segment is left as it was, as a bound, and taken again when it is the least of
//! all. The pixel that is found is that of a full scan.

use super::energy::Energy;

/// The pixels of a segment.
const SEGMENT: usize = 32;

/// The key of a pixel that takes no part.
const OUT: u64 = u64::MAX;

/// The extreme that is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extreme {
    /// The pixel that is not set and has the least energy.
    Void,
    /// The pixel that is set and has the most energy.
    Cluster,
}

/// The tree of a pattern.
pub struct Tournament {
    extreme: Extreme,
    /// The least keys, by the usual numbers of a heap: the root is 1, the segments are the last half.
    keys: Vec<u64>,
    /// The segments whose keys are bounds.
    is_bound: Vec<bool>,
}

/// The keys of pixels, less for one that is nearer to the extreme; among equal energies the least tie is taken.
#[inline]
fn keys<'a>(
    extreme: Extreme,
    energy: &'a Energy,
    ties: &'a [u32],
    pixels: std::ops::Range<usize>,
) -> impl Iterator<Item = u64> + 'a {
    // The energies of clusters are complemented, so that the most is the least.
    let (part, flipped) = if extreme == Extreme::Void { (false, 0) } else { (true, u32::MAX) };
    let (pattern, energies) = (&energy.pattern()[pixels.clone()], &energy.energies()[pixels.clone()]);
    let key = move |((&is_set, &value), &tie): ((&bool, &u32), &u32)| {
        if is_set == part { u64::from(value ^ flipped) << 32 | u64::from(tie) } else { OUT }
    };
    pattern.iter().zip(energies).zip(&ties[pixels]).map(key)
}

impl Tournament {
    /// The tree of a pattern as it is. `ties` decide between pixels of equal energy; where they are equal too, the
    /// lowest pixel is taken.
    pub fn new(extreme: Extreme, energy: &Energy, ties: &[u32]) -> Self {
        let segments = energy.pixels().div_ceil(SEGMENT);
        let leaves = segments.next_power_of_two();
        let mut tournament = Self { extreme, keys: vec![OUT; 2 * leaves], is_bound: vec![false; leaves] };
        (0..segments).for_each(|segment| tournament.keys[leaves + segment] = tournament.least(energy, ties, segment));
        for node in (1..leaves).rev() {
            tournament.keys[node] = tournament.keys[2 * node].min(tournament.keys[2 * node + 1]);
        }
        tournament
    }

    fn pixels(energy: &Energy, segment: usize) -> std::ops::Range<usize> {
        segment * SEGMENT..((segment + 1) * SEGMENT).min(energy.pixels())
    }

    /// The least key of a segment.
    fn least(&self, energy: &Energy, ties: &[u32], segment: usize) -> u64 {
        keys(self.extreme, energy, ties, Self::pixels(energy, segment)).min().unwrap_or(OUT)
    }

    /// Takes note of the last change of the pattern: a pixel was set (true), or cleared.
    pub fn note(&mut self, energy: &Energy, ties: &[u32], was_set: bool) {
        let moves_away = was_set == (self.extreme == Extreme::Void);
        for &(from, to) in energy.altered() {
            for segment in from / SEGMENT..=(to - 1) / SEGMENT {
                if moves_away {
                    self.is_bound[segment] = true;
                } else {
                    self.renew(energy, ties, segment);
                }
            }
        }
    }

    /// Takes the minimum of a segment again.
    fn renew(&mut self, energy: &Energy, ties: &[u32], segment: usize) {
        self.is_bound[segment] = false;
        let mut node = self.is_bound.len() + segment;
        self.keys[node] = self.least(energy, ties, segment);
        while node > 1 {
            node /= 2;
            let least = self.keys[2 * node].min(self.keys[2 * node + 1]);
            if self.keys[node] == least {
                break;
            }
            self.keys[node] = least;
        }
    }

    /// The extreme pixel; `None` if no pixel takes part.
    pub fn find(&mut self, energy: &Energy, ties: &[u32]) -> Option<usize> {
        let leaves = self.is_bound.len();
        loop {
            let least = self.keys[1];
            if least == OUT {
                return None;
            }
            let mut node = 1;
            while node < leaves {
                node = 2 * node + usize::from(self.keys[2 * node] != least);
            }
            let segment = node - leaves;
            if !self.is_bound[segment] {
                let pixels = Self::pixels(energy, segment);
                let place = keys(self.extreme, energy, ties, pixels.clone()).position(|key| key == least);
                return place.map(|place| pixels.start + place);
            }
            self.renew(energy, ties, segment);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Draw, Rng};

    /// A full scan.
    fn scan(extreme: Extreme, energy: &Energy, ties: &[u32]) -> Option<usize> {
        (0..energy.pixels()).filter(|&p| energy.pattern()[p] == (extreme == Extreme::Cluster)).min_by_key(|&p| {
            let e = i64::from(energy.energies()[p]);
            (if extreme == Extreme::Void { e } else { -e }, ties[p], p)
        })
    }

    #[test]
    fn the_extreme_is_that_of_a_full_scan_after_every_change() {
        for (seed, size) in [[2, 2, 1], [33, 3, 1], [64, 32, 1], [29, 53, 1], [9, 8, 7]].into_iter().enumerate() {
            let mut rng = Rng::at(seed as u64, Draw::Darts, &[]);
            let mut energy = Energy::new(size, 1.3);
            // Few ties, so that the lowest pixel decides too.
            let ties: Vec<u32> = (0..energy.pixels()).map(|_| rng.below(3) as u32).collect();
            let mut trees = [Extreme::Void, Extreme::Cluster].map(|extreme| Tournament::new(extreme, &energy, &ties));
            for change in 0..600 {
                for tree in &mut trees {
                    assert_eq!(tree.find(&energy, &ties), scan(tree.extreme, &energy, &ties), "{size:?} {change}");
                }
                // Extreme pixels and random ones, more of one kind for a while.
                let pixel = match trees[change / 200 % 2].find(&energy, &ties) {
                    Some(extreme) if change % 3 == 0 => extreme,
                    _ => rng.below(energy.pixels() as u64) as usize,
                };
                let was_set = !energy.pattern()[pixel];
                if was_set {
                    energy.set(pixel)
                } else {
                    energy.clear(pixel)
                }
                trees.iter_mut().for_each(|tree| tree.note(&energy, &ties, was_set));
            }
            // Another tree of the pattern as it is agrees.
            for tree in &mut trees {
                assert_eq!(
                    Tournament::new(tree.extreme, &energy, &ties).find(&energy, &ties),
                    tree.find(&energy, &ties)
                );
            }
        }
    }
}
