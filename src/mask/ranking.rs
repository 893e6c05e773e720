//! The ranks of one channel, by void and cluster (Ulichney 1993, §3 and 4).

use super::energy::{Energy, Size};
use super::tournament::{Extreme, Tournament};
use crate::rng::{Draw, Rng, hash};

/// The share of the pixels in the initial pattern, as a divisor: the paper advises about a tenth.
const INITIAL: usize = 10;

/// The rank of a pixel that has none yet.
const NONE: u32 = u32::MAX;

/// The step of the method that a channel is in.
enum Stage {
    /// The initial pattern is made even: its tightest cluster moves to the largest void, until it would stay.
    Settle { clusters: Tournament, voids: Tournament },
    /// Phase 1: the tightest cluster of the initial pattern gets the highest rank that is left, and is taken out.
    Remove { clusters: Tournament, rank: u32 },
    /// Phases 2 and 3: the largest void gets the next rank and is filled (`energy.rs` has the reason why both are one).
    Fill { voids: Tournament, rank: u32 },
    /// All pixels have ranks.
    Done,
}

/// A channel, of which some ranks are known.
pub struct Ranking<'a> {
    energy: Energy,
    /// The key that decides between pixels of equal energy.
    ties: Vec<u32>,
    stage: Stage,
    ranks: &'a mut [u32],
    /// The moves that made the initial pattern even.
    moves: u64,
    ones: u32,
}

impl<'a> Ranking<'a> {
    /// A channel with its random initial pattern, whose ranks will be in `ranks`.
    pub fn new(size: Size, sigma: f64, seed: u64, channel: u64, ranks: &'a mut [u32]) -> Self {
        let mut energy = Energy::new(size, sigma);
        let pixels = energy.pixels();
        let ties: Vec<u32> =
            (0..pixels as u64).map(|pixel| (hash(seed, Draw::Mask, &[channel, pixel]) >> 32) as u32).collect();
        // The first of a random permutation.
        ranks.iter_mut().zip(0..).for_each(|(rank, pixel)| *rank = pixel);
        let (ones, mut rng) = ((pixels / INITIAL).max(1), Rng::at(seed, Draw::Mask, &[channel]));
        for i in 0..ones {
            ranks.swap(i, i + rng.below((pixels - i) as u64) as usize);
            energy.set(ranks[i] as usize);
        }
        ranks.fill(NONE);
        let [clusters, voids] = [Extreme::Cluster, Extreme::Void].map(|of| Tournament::new(of, &energy, &ties));
        Self { energy, ties, stage: Stage::Settle { clusters, voids }, ranks, moves: 0, ones: ones as u32 }
    }

    /// The moves that made the initial pattern even.
    pub fn moves(&self) -> u64 {
        self.moves
    }

    /// The share of the work that is done, as far as it can be foreseen.
    pub fn share(&self) -> f64 {
        let (ones, pixels) = (f64::from(self.ones), self.ranks.len() as f64);
        let moves = self.moves as f64;
        match self.stage {
            // Nobody knows how many moves there will be; about as many as pixels that move.
            Stage::Settle { .. } => 0.25 * moves / (moves + ones),
            Stage::Remove { rank, .. } => 0.25 + 0.125 * (1.0 - f64::from(rank) / ones),
            Stage::Fill { rank, .. } => 0.375 + 0.625 * (f64::from(rank) - ones) / (pixels - ones),
            Stage::Done => 1.0,
        }
    }

    /// Goes on by this many changes of the pattern, or to the end of a stage; true at the end of all.
    pub fn advance(&mut self, changes: usize) -> bool {
        for _ in 0..changes {
            let (energy, ties) = (&mut self.energy, &self.ties);
            match &mut self.stage {
                Stage::Settle { clusters, voids } => {
                    let cluster = clusters.find(energy, ties).expect("the pattern has pixels");
                    energy.clear(cluster);
                    [&mut *clusters, &mut *voids].into_iter().for_each(|tree| tree.note(energy, ties, false));
                    let void = voids.find(energy, ties).expect("the cluster was taken out");
                    energy.set(void);
                    [&mut *clusters, &mut *voids].into_iter().for_each(|tree| tree.note(energy, ties, true));
                    // A move to a void of less energy, or of an equal one and a lower tie, lowers the sum over all
                    // pairs, or that of the ties: so the moves have an end.
                    if void == cluster {
                        let clusters = Tournament::new(Extreme::Cluster, energy, ties);
                        self.stage = Stage::Remove { clusters, rank: self.ones };
                        return false;
                    }
                    self.moves += 1;
                }
                Stage::Remove { clusters, rank } if *rank > 0 => {
                    let cluster = clusters.find(energy, ties).expect("one pixel is left for each rank");
                    energy.clear(cluster);
                    clusters.note(energy, ties, false);
                    *rank -= 1;
                    self.ranks[cluster] = *rank;
                }
                Stage::Remove { .. } => {
                    // The pattern as it was.
                    (0..self.ranks.len()).filter(|&p| self.ranks[p] != NONE).for_each(|p| energy.set(p));
                    let voids = Tournament::new(Extreme::Void, energy, ties);
                    self.stage = Stage::Fill { voids, rank: self.ones };
                    return false;
                }
                Stage::Fill { voids, rank } => {
                    let Some(void) = voids.find(energy, ties) else {
                        self.stage = Stage::Done;
                        return true;
                    };
                    energy.set(void);
                    voids.note(energy, ties, true);
                    self.ranks[void] = *rank;
                    *rank += 1;
                }
                Stage::Done => return true,
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The ranks of a channel as the paper has them, from the definitions: every energy is summed again before each
    /// choice, each choice scans all pixels, and the third phase looks at the pixels that are not set.
    fn naive(size: Size, sigma: f64, seed: u64, channel: u64) -> Vec<u32> {
        let pixels: usize = size.iter().product();
        // The weight between two pixels, from their steps along the axes.
        let mut unit = Energy::new(size, sigma);
        unit.set(0);
        let place = |p: usize| [p % size[0], p / size[0] % size[1], p / size[0] / size[1]];
        let weight = |a: usize, b: usize| {
            let (a, b) = (place(a), place(b));
            let [x, y, z]: [usize; 3] = std::array::from_fn(|i| (a[i] + size[i] - b[i]) % size[i]);
            u64::from(unit.energies()[(z * size[1] + y) * size[0] + x])
        };
        let tie = |p: usize| (hash(seed, Draw::Mask, &[channel, p as u64]) >> 32) as u32;
        let energy = |of: &[bool], p: usize| (0..pixels).filter(|&q| of[q]).map(|q| weight(p, q)).sum::<u64>();
        let tightest = |of: &[bool]| {
            (0..pixels).filter(|&p| of[p]).min_by_key(|&p| (u64::MAX - energy(of, p), tie(p), p)).unwrap()
        };
        let largest_void =
            |of: &[bool]| (0..pixels).filter(|&p| !of[p]).min_by_key(|&p| (energy(of, p), tie(p), p)).unwrap();

        let (mut order, mut rng) = ((0..pixels).collect::<Vec<_>>(), Rng::at(seed, Draw::Mask, &[channel]));
        let ones = (pixels / 10).max(1);
        let mut initial = vec![false; pixels];
        for i in 0..ones {
            order.swap(i, i + rng.below((pixels - i) as u64) as usize);
            initial[order[i]] = true;
        }
        loop {
            let cluster = tightest(&initial);
            initial[cluster] = false;
            let void = largest_void(&initial);
            initial[void] = true;
            if void == cluster {
                break;
            }
        }
        let mut ranks = vec![NONE; pixels];
        let mut pattern = initial.clone();
        for rank in (0..ones).rev() {
            let cluster = tightest(&pattern);
            pattern[cluster] = false;
            ranks[cluster] = rank as u32;
        }
        pattern = initial;
        for rank in ones..pixels {
            let chosen = if rank < pixels.div_ceil(2) {
                largest_void(&pattern)
            } else {
                // The minority is what is not set.
                tightest(&pattern.iter().map(|&set| !set).collect::<Vec<_>>())
            };
            pattern[chosen] = true;
            ranks[chosen] = rank as u32;
        }
        ranks
    }

    fn ranks(size: Size, sigma: f64, seed: u64, channel: u64, changes: usize) -> Vec<u32> {
        let mut ranks = vec![0; size.iter().product()];
        let mut ranking = Ranking::new(size, sigma, seed, channel, &mut ranks);
        let mut share = 0.0;
        while !ranking.advance(changes) {
            assert!((share..=1.0).contains(&ranking.share()), "{share}, then {}", ranking.share());
            share = ranking.share();
        }
        assert!(ranking.advance(1) && ranking.share() == 1.0);
        ranks
    }

    #[test]
    fn ranks_are_those_of_the_paper() {
        let sizes =
            [[2, 2, 1], [2, 3, 1], [5, 5, 1], [16, 16, 1], [7, 13, 1], [31, 3, 1], [2, 2, 2], [5, 4, 7], [4, 4, 4]];
        for size in sizes {
            for seed in 0..6 {
                let sigma = [1.5, 1.9, 0.5, 4.0][seed as usize % 4];
                assert_eq!(
                    ranks(size, sigma, seed, seed % 3, 7),
                    naive(size, sigma, seed, seed % 3),
                    "{size:?} {seed}"
                );
            }
        }
    }

    #[test]
    fn ranks_do_not_depend_on_the_number_of_changes_at_a_time() {
        let all = ranks([24, 17, 1], 1.5, 3, 0, usize::MAX);
        assert_eq!(ranks([24, 17, 1], 1.5, 3, 0, 1), all);
        assert_eq!(ranks([24, 17, 1], 1.5, 3, 0, 50), all);
    }
}
