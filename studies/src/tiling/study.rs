//! The context of the sections.

use std::time::Instant;

use azulejo::{Context, MAXIMAL_DENSITY, Result};

use crate::files::Files;
use crate::verdict::Mean;
use azulejo_cli::summary::Summary;
use azulejo_cli::text::rounded;

pub struct Study<'a> {
    pub context: &'a Context,
    /// The files of the page.
    pub files: &'a Files,
    /// True if few and small sets suffice.
    pub quick: bool,
}

impl Study<'_> {
    /// The first in a full run, the second in a quick one.
    pub fn effort<T>(&self, full: T, quick: T) -> T {
        if self.quick { quick } else { full }
    }
}

/// A figure of a set or of something else that is measured.
pub type Figure<T> = fn(&T) -> f64;

/// The result of a call, and its seconds.
pub fn timed<T>(call: impl FnOnce() -> Result<T>) -> Result<(T, f64)> {
    let start = Instant::now();
    let result = call()?;
    Ok((result, start.elapsed().as_secs_f64()))
}

/// The least of some times and their range, in a unit that is `scale` times smaller than a second.
pub fn times(seconds: &[f64], scale: f64) -> String {
    let Summary { low, high, .. } = Summary::of(seconds);
    format!("{} (to {})", rounded(scale * low, 3), rounded(scale * high, 3))
}

/// By how many percent sets are denser than an unbiased maximal one.
pub fn excess(samples: usize, radius: f64) -> f64 {
    100.0 * (samples as f64 * radius * radius / MAXIMAL_DENSITY - 1.0)
}

/// The mean of a figure over some items.
pub fn mean_of<T>(of: &[T], figure: impl Fn(&T) -> f64) -> Mean {
    Mean::of(&of.iter().map(figure).collect::<Vec<_>>())
}
