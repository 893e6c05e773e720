//! The samplers that are shown.

use azulejo::dcr::relax;
use azulejo::kdrt::DEFAULT_LEAF_SIZE;
use azulejo::{Boundary, Context, Domain, Result};

use super::Effort;
use crate::dcr::sets::{METHODS, Method};
use crate::kdrt;
use crate::reference;

/// A sampler.
#[derive(Clone, Copy)]
pub enum Sampler {
    Random,
    Jittered,
    Halton,
    /// The flat quadtree, unbiased and maximal (Ebeida et al. 2012), and its tiled double.
    Maximal,
    Kdrt,
    /// Random points after DCR.
    Relaxed(Method),
}

/// Samplers that make points, and the methods that relax random ones.
pub const SAMPLERS: [Sampler; 5] =
    [Sampler::Random, Sampler::Jittered, Sampler::Halton, Sampler::Maximal, Sampler::Kdrt];
pub const RELAXED: [Sampler; METHODS.len()] = {
    let [a, b, c, d] = METHODS;
    [Sampler::Relaxed(a), Sampler::Relaxed(b), Sampler::Relaxed(c), Sampler::Relaxed(d)]
};

impl Sampler {
    pub fn name(self) -> String {
        match self {
            Self::Random => "random".to_owned(),
            Self::Jittered => "jittered".to_owned(),
            Self::Halton => "Halton".to_owned(),
            Self::Maximal => "flat quadtree".to_owned(),
            Self::Kdrt => "KDRT".to_owned(),
            Self::Relaxed(method) => format!("DCR, {}", method.name),
        }
    }

    /// The number of its sets.
    pub fn sets(self, effort: &Effort) -> u64 {
        match self {
            Self::Relaxed(method) if method.is_thesis => effort.slow_sets,
            _ => effort.sets,
        }
    }

    /// A set of `side` by `side` points of the unit torus, or about as many. Of Halton's sequence, sets of other seeds
    /// are other parts.
    pub fn sample(self, context: &Context, side: usize, seed: u64) -> Result<Vec<[f32; 2]>> {
        let count = side * side;
        match self {
            Self::Random => Ok(reference::random(count, seed)),
            Self::Jittered => Ok(reference::jittered(side, seed)),
            Self::Halton => Ok(reference::halton(seed * count as u64, count)),
            Self::Maximal => kdrt::Sampler::Maximal.sample(context, count as f64, seed),
            Self::Kdrt => kdrt::Sampler::Leaves(DEFAULT_LEAF_SIZE).sample(context, count as f64, seed),
            Self::Relaxed(method) => {
                let options = method.options(Domain::unit(Boundary::Periodic), seed);
                Ok(relax(context, &options, &reference::random(count, seed), None)?.0)
            }
        }
    }
}
