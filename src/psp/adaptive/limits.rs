//! What ends a call whose radius is not what the caller says of it, or asks for more than was estimated: a function can
//! give anything, and is seen at a few places only.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use crate::error::{Error, Result};
use crate::memory;
use crate::mesh::Mesh;

/// What is wrong with the radii. Of several failures the one at the first place counts, axis by axis, so that it does not
/// matter which is found first.
#[derive(Default)]
pub(super) struct Verdict {
    first: Mutex<Option<([f64; 3], Error)>>,
    is_given: AtomicBool,
}

impl Verdict {
    /// Adds a failure at a place.
    pub fn add(&self, place: [f64; 3], failure: Error) {
        let mut first = self.first.lock().unwrap_or_else(PoisonError::into_inner);
        if first.as_ref().is_none_or(|(other, _)| place < *other) {
            *first = Some((place, failure));
        }
        self.is_given.store(true, Ordering::Relaxed);
    }

    /// Whether there is a failure: the rest of the work is in vain.
    pub fn is_given(&self) -> bool {
        self.is_given.load(Ordering::Relaxed)
    }

    /// Fails where there is a failure.
    pub fn check(&self) -> Result<()> {
        let first = self.first.lock().unwrap_or_else(PoisonError::into_inner).take();
        first.map_or(Ok(()), |(_, failure)| Err(failure))
    }
}

/// So many pieces and samples there may be at least, ...
const FEWEST: f64 = 1e6;
/// ... and for each sample that was estimated and each triangle. Where radii are as steep as they can be there are about ten.
const FACTOR: f64 = 64.0;
/// Memory for each.
const BYTES: f64 = 150.0;

/// How many pieces of the surface and samples there may be: by far more than was estimated, but what memory holds.
pub(super) struct Quota {
    used: AtomicU64,
    limit: u64,
}

impl Quota {
    /// For so many samples, about.
    pub fn new(estimate: f64, mesh: &Mesh) -> Self {
        let limit = FEWEST + FACTOR * (estimate + mesh.triangles().len() as f64);
        let held = memory::available().map_or(f64::INFINITY, |bytes| bytes / BYTES);
        Self { used: AtomicU64::new(0), limit: limit.min(held) as u64 }
    }

    pub fn take(&self, count: u64) {
        self.used.fetch_add(count, Ordering::Relaxed);
    }

    pub fn is_exceeded(&self) -> bool {
        self.used.load(Ordering::Relaxed) > self.limit
    }

    /// Fails where it is exceeded, by what `argument` has asked for.
    pub fn check(&self, argument: &'static str) -> Result<()> {
        if !self.is_exceeded() {
            return Ok(());
        }
        let limit = self.limit;
        Err(Error::too_large(argument, format!("asks for more than {limit} samples, and for far fewer at first sight")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_failure_at_the_first_place_counts() {
        let places = [[0.5, 1.0, 2.0], [0.5, 0.25, 7.0], [0.5, 0.25, 8.0], [3.0, -1.0, 0.0]];
        for first in 0..4 {
            let verdict = Verdict::default();
            assert!(!verdict.is_given() && verdict.check().is_ok());
            for i in (first..4).chain(0..first) {
                verdict.add(places[i], Error::invalid("radius", i.to_string()));
            }
            assert!(verdict.is_given());
            assert_eq!(verdict.check().unwrap_err().to_string(), "radius: 1");
        }
    }

    #[test]
    fn a_quota_is_exceeded_by_one_more() {
        let quota = Quota { used: AtomicU64::new(0), limit: 1000 };
        quota.take(1000);
        assert!(quota.check("radius").is_ok());
        quota.take(1);
        let said = quota.check("radius").unwrap_err().to_string();
        assert!(quota.is_exceeded() && said.starts_with("radius: asks for more than 1000 samples"), "{said}");
    }
}
