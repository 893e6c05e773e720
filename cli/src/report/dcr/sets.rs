//! What is relaxed, and by which methods.

use azulejo::dcr::{Neighbourhood, Options};
use azulejo::kdrt::{self, CountOptions};
use azulejo::{Context, Domain, Result};

/// The seed of the first set of each kind. No setting of a method was chosen by what sets of these seeds gave; who tunes
/// one takes others.
pub const FIRST_SEED: u64 = 31_000;

/// A method, with the options that it has unless one asks for others.
#[derive(Clone, Copy)]
pub struct Method {
    pub name: &'static str,
    pub neighbourhood: Neighbourhood,
    pub is_best: bool,
}

pub const METHODS: [Method; 4] = [
    Method { name: "best, Delaunay", neighbourhood: Neighbourhood::Delaunay, is_best: true },
    Method { name: "best, nearest", neighbourhood: Neighbourhood::Nearest, is_best: true },
    Method { name: "thesis, Delaunay", neighbourhood: Neighbourhood::Delaunay, is_best: false },
    Method { name: "thesis, nearest", neighbourhood: Neighbourhood::Nearest, is_best: false },
];

impl Method {
    pub fn options(&self, domain: Domain, seed: u64) -> Options {
        let options = if self.is_best { Options::new } else { Options::thesis };
        Options { seed, ..options(domain, self.neighbourhood) }
    }

    /// The file of its picture.
    pub fn picture(&self) -> String {
        format!("{}.png", self.name.replace(", ", "-").to_lowercase())
    }
}

/// What a set is before it is relaxed.
#[derive(Clone, Copy, PartialEq)]
pub enum Start {
    Random,
    /// A maximal Poisson-disk set.
    Kdrt,
}

pub const STARTS: [Start; 2] = [Start::Random, Start::Kdrt];

impl Start {
    pub fn name(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::Kdrt => "KDRT",
        }
    }

    /// So many points of a unit square.
    pub fn points(self, context: &Context, domain: Domain, count: usize, seed: u64) -> Result<Vec<[f32; 2]>> {
        match self {
            Self::Random => Ok(random_points(count, seed)),
            Self::Kdrt => {
                let leaf_size = kdrt::DEFAULT_LEAF_SIZE;
                let options = CountOptions { count: count as u64, domain, leaf_size, seed };
                Ok(kdrt::sample_count(context, &options, None)?.samples)
            }
        }
    }
}

/// Uniform random points of the unit square, by SplitMix64 (Steele, Lea and Flood 2014).
fn random_points(count: usize, seed: u64) -> Vec<[f32; 2]> {
    let mut state = seed;
    let mut unit = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 40) as f32 / (1u32 << 24) as f32
    };
    (0..count).map(|_| [unit(), unit()]).collect()
}
