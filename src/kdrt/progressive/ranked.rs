//! Samples in progressive order.

use crate::kdrt::progressive::Sample;
use crate::math::rounded_down;
use crate::plane::lattice::Lattice;

/// Samples of the plane with their ranks.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Ranked {
    /// The samples.
    pub samples: Vec<[f32; 2]>,
    /// The rank of each sample of a progressive set, rounded down to a float, in the units of the domain; empty for
    /// sets in any order.
    ///
    /// Ranks never rise. The first i samples are at least as far apart as the i-th rank, and no point of the domain is
    /// farther from them than the quotient times this rank, up to 6 float spacings at the largest coordinate; for less
    /// than [`Order::FIRST_COUNT`](crate::Order::FIRST_COUNT) samples than twice the rank, or the square of the
    /// quotient times it if that is more. The latter holds from the samples of the coarsest level on, which all have
    /// the rank of the first: its radius, or the diagonal of the domain if that is shorter. Then there is one of them
    /// only, and it holds for every prefix.
    pub ranks: Vec<f32>,
}

impl Ranked {
    /// Puts samples in order. Those of the coarsest level have the given rank.
    pub(super) fn in_order(lattice: &Lattice, coarsest: f64, mut samples: Vec<Sample>) -> Self {
        samples.sort_unstable_by(|a, b| {
            b.square.cmp(&a.square).then(a.point[1].cmp(&b.point[1])).then(a.point[0].cmp(&b.point[0]))
        });
        let rank = |square: i64| if square == i64::MAX { coarsest } else { lattice.length(square) };
        Self {
            ranks: samples.iter().map(|sample| rounded_down(rank(sample.square))).collect(),
            samples: samples.iter().map(|sample| lattice.position(sample.point)).collect(),
        }
    }

    /// Samples with their ranks, which are as many or none.
    pub fn new(samples: Vec<[f32; 2]>, ranks: Vec<f32>) -> Self {
        Self { samples, ranks }
    }

    /// Samples in any order.
    pub(crate) fn in_any_order(samples: Vec<[f32; 2]>) -> Self {
        Self { samples, ranks: Vec::new() }
    }

    /// Keeps the first samples.
    pub(super) fn truncate(&mut self, count: usize) {
        self.samples.truncate(count);
        self.ranks.truncate(count);
    }

    /// Keeps some samples.
    pub(super) fn retain(&mut self, is_kept: impl Fn([f32; 2]) -> bool) {
        let mut kept = self.samples.iter().map(|&sample| is_kept(sample));
        self.ranks.retain(|_| kept.next() == Some(true));
        self.samples.retain(|&sample| is_kept(sample));
    }
}
